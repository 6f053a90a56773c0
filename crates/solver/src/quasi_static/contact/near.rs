//! Which of the candidates are within reach of each other, followed from state to state.

use glam::DVec3;

use super::super::configuration::largest;
use super::pair::ContactPair;

/// Pairs within this many gaps are near.
const WITHIN: f64 = 2.0;
/// By how much of the moves the bounds are lowered further, so that rounding never leaves one too high.
const ROUNDING: f64 = 1e-9;

/// Bounds of the distances of candidates at one state, and the candidates within reach there.
///
/// A distance falls by at most twice the largest move of a node: far pairs are measured again only when the moves add
/// up to what keeps them out of reach.
#[derive(Default)]
pub(super) struct NearPairs {
    positions: Vec<DVec3>,
    /// No candidate is closer than this.
    pub(super) least: Vec<f64>,
    pub(super) active: Vec<u32>,
}

impl NearPairs {
    /// The bounds `least` at `positions`.
    pub(super) fn new(positions: &[DVec3], least: Vec<f64>, pairs: &[ContactPair]) -> Self {
        let near = pairs.iter().zip(&least).enumerate();
        let active = near
            .filter(|(_, (pair, least))| **least < WITHIN * pair.gap)
            .map(|(index, _)| index as u32)
            .collect();
        Self { positions: positions.to_vec(), least, active }
    }

    /// Makes the bounds hold at `positions`.
    pub(super) fn move_to(&mut self, pairs: &[ContactPair], positions: &[DVec3]) {
        if self.positions == positions && self.least.len() == pairs.len() {
            return;
        }
        let fall = if self.least.len() == pairs.len() {
            let moves: Vec<DVec3> =
                positions.iter().zip(&self.positions).map(|(&x, &old)| x - old).collect();
            2.0 * largest(&moves) * (1.0 + ROUNDING) + ROUNDING * ROUNDING
        } else {
            self.least.clear();
            self.least.resize(pairs.len(), 0.0);
            0.0
        };
        self.active.clear();
        for (index, (pair, least)) in pairs.iter().zip(&mut self.least).enumerate() {
            *least -= fall;
            let within = WITHIN * pair.gap;
            if *least < within {
                *least = pair.closest(&pair.corners(positions)).distance;
                if *least < within {
                    self.active.push(index as u32);
                }
            }
        }
        self.positions.clear();
        self.positions.extend_from_slice(positions);
    }
}
