//! Which of the candidates are within reach of each other, followed from state to state.

use glam::DVec3;

use super::super::configuration::largest;
use super::pair::ContactPair;

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
    active: Vec<u32>,
}

impl NearPairs {
    /// The pairs within reach at `positions`, in order. Precondition: the same pairs since this was made.
    pub(super) fn active<'a>(
        &'a mut self,
        pairs: &'a [ContactPair],
        positions: &[DVec3],
    ) -> impl Iterator<Item = &'a ContactPair> {
        self.move_to(pairs, positions);
        self.active.iter().map(|&index| &pairs[index as usize])
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
            let within = pair.gap + pair.reach;
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
