//! Opens the seam of a closed chain.

use glam::{DMat2, DVec2};

use super::certificate::{Sweep, SweepVerdict};
use super::chain::Chain;

/// How far the ends are taken apart at first, in mean segments, and how often that is halved at most.
const OPENING: f64 = 0.25;
const MOST_HALVINGS: i32 = 40;
/// Distances computed to certify an opening, at most.
const BUDGET: u64 = 20_000_000;

/// The turns of a closed chain with its ends apart, reached by a certified sweep from its own.
///
/// The last end is drawn away along −(e + f), the sum of the directions of the first and the last segment, by the least
/// change of the turns in the sense of squares, Jᵀ(JJᵀ)⁻¹δ with J the derivative of that end by the turns; as far as it is
/// certified clear. None where no opening of 2⁻⁴⁰ quarter segments is, as at a cusp of no angle.
pub(super) fn open_seam(chain: &Chain) -> Option<Vec<f64>> {
    let points = chain.points(chain.turns());
    let last = points.len() - 1;
    let [e, f] = [points[1] - points[0], points[last] - points[last - 1]].map(DVec2::normalize);
    let goal = -(e + f).try_normalize()?;
    let columns: Vec<DVec2> = points[1..last]
        .iter()
        .map(|&joint| (points[last] - joint).perp())
        .collect();
    let gram = columns.iter().fold(DMat2::ZERO, |sum, &c| {
        sum + DMat2::from_cols(c * c.x, c * c.y)
    });
    let multiplier = gram.inverse() * goal;
    let direction: Vec<f64> = columns.iter().map(|c| c.dot(multiplier)).collect();
    (0..MOST_HALVINGS).find_map(|halvings| {
        let share = OPENING * 0.5f64.powi(halvings);
        let opened: Vec<f64> = chain
            .turns()
            .iter()
            .zip(&direction)
            .map(|(turn, change)| turn + share * change)
            .collect();
        let verdict = Sweep::new(chain, chain.turns(), &opened).run(0.0, BUDGET);
        (verdict == SweepVerdict::Clear).then_some(opened)
    })
}
