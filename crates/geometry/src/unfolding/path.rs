//! The path of the turns along which a chain is straightened.

use super::certificate::{Sweep, SweepVerdict};
use super::chain::{Chain, sums};
use super::descent::{Waypoint, descend};
use super::opening::open_seam;
use crate::GeometryError;

/// A straight piece of the path keeps this share of the smallest distance on the descent.
const KEPT: f64 = 0.5;
/// The largest number of distances computed to certify one piece.
const BUDGET: u64 = 4_000_000;

/// The turns of a chain, piecewise linear in a progress from 0 to 1.
#[derive(Debug, Clone, PartialEq)]
pub struct TurnPath {
    /// The progress at each knot, strictly increasing from 0 to 1.
    pub progress: Vec<f64>,
    /// The turns at each knot, in radians: first those of the chain, finally all 0.
    pub turns: Vec<Vec<f64>>,
    /// The number of steps of the descent that it was made from.
    pub steps: usize,
}

impl TurnPath {
    /// The turns at `progress`, which is clamped to [0, 1].
    pub fn at(&self, progress: f64) -> Vec<f64> {
        let next =
            self.progress.partition_point(|&p| p <= progress).clamp(1, self.progress.len() - 1);
        let [start, end] = [next - 1, next].map(|k| self.progress[k]);
        let share = ((progress - start) / (end - start)).clamp(0.0, 1.0);
        let pair = self.turns[next - 1].iter().zip(&self.turns[next]);
        pair.map(|(a, b)| a * (1.0 - share) + b * share).collect()
    }
}

/// Straightens `chain` without a crossing, by descent of the energy (see the module documentation).
///
/// The seam of a closed chain is opened first. The descent ends once the headings lie within less than half a turn;
/// from there all turns are scaled to 0. Only as many of its states are kept as are needed for the straight pieces
/// between them to be certified clear, with half the clearance that the descent had there. Every piece of the path is
/// proved clear in the sense of [`super::certify`], is a step of the descent, or is the scaling at the end. The
/// progress is proportional to the largest change of a heading relative to the mean heading.
///
/// Moving the chain rigidly, scaling it or reflecting it (with opposite turns) does not change the result, except for
/// rounding, which the descent amplifies. Cost: about n² for each step; 100 segments of a double spiral take some
/// hundred steps.
///
/// # Errors
/// [`GeometryError::SeamClosed`] if the ends of a closed chain could not be separated,
/// [`GeometryError::NotStraightened`] if the descent was ended by rounding: layers closer than about 1e-5 of a segment.
pub fn straighten(chain: &Chain) -> Result<TurnPath, GeometryError> {
    let start = chain.turns().to_vec();
    let mut knots = Vec::new();
    let opened = if chain.is_closed() {
        let opened = open_seam(chain).ok_or(GeometryError::SeamClosed)?;
        knots.push(start);
        opened
    } else {
        start
    };
    let waypoints = descend(chain, opened)?;
    let steps = waypoints.len() - 1;
    knots.extend(thinned(chain, waypoints));
    let straight = vec![0.0; chain.turns().len()];
    if knots.last() != Some(&straight) || knots.len() == 1 {
        knots.push(straight);
    }
    Ok(TurnPath { progress: progress(chain, &knots), turns: knots, steps })
}

/// As few of the states as possible such that the straight pieces between them are certified.
fn thinned(chain: &Chain, waypoints: Vec<Waypoint>) -> Vec<Vec<f64>> {
    let last = waypoints.len() - 1;
    let is_clear = |from: usize, to: usize| {
        let least = waypoints[from..=to].iter().fold(f64::INFINITY, |a, w| a.min(w.clearance));
        let sweep = Sweep::new(chain, &waypoints[from].turns, &waypoints[to].turns);
        let clearance = if least.is_finite() { KEPT * least } else { 0.0 };
        sweep.run(clearance, BUDGET) == SweepVerdict::Clear
    };
    let mut kept = vec![0];
    let mut from = 0;
    while from < last {
        // The next state is reached by a step; distances are doubled until one fails, then the states in between are
        // tried.
        let (mut reached, mut ahead) = (from + 1, 2);
        while from + ahead <= last && is_clear(from, from + ahead) {
            reached = from + ahead;
            ahead *= 2;
        }
        let mut beyond = (from + ahead).min(last + 1);
        while beyond - reached > 1 {
            let middle = reached.midpoint(beyond);
            if is_clear(from, middle) {
                reached = middle;
            } else {
                beyond = middle;
            }
        }
        kept.push(reached);
        from = reached;
    }
    let is_kept = |k: &usize| kept.binary_search(k).is_ok();
    let numbered = waypoints.into_iter().enumerate();
    numbered.filter(|(k, _)| is_kept(k)).map(|(_, w)| w.turns).collect()
}

/// The progress at each knot, proportional to the largest change of a heading relative to the mean heading.
fn progress(chain: &Chain, knots: &[Vec<f64>]) -> Vec<f64> {
    let changes: Vec<f64> = knots
        .windows(2)
        .map(|pair| {
            let change: Vec<f64> = pair[0].iter().zip(&pair[1]).map(|(a, b)| b - a).collect();
            let headings = sums(&change);
            let weighted = headings.iter().zip(&chain.lengths).map(|(h, l)| h * l);
            let mean = weighted.sum::<f64>() / chain.segment_count() as f64;
            // Knots that differ only by the frame still count as distinct.
            headings.iter().fold(1e-9, |a: f64, h| a.max((h - mean).abs()))
        })
        .collect();
    let sums = sums(&changes);
    let total = sums[sums.len() - 1];
    sums.into_iter().map(|sum| sum / total).collect()
}
