//! Opens the seam of a closed chain.

use glam::{DMat2, DVec2};

use super::certificate::{Sweep, SweepVerdict};
use super::chain::Chain;

/// The distance by which the ends are first separated, in mean segments, and the largest number of times it is halved.
const OPENING: f64 = 0.25;
const MOST_HALVINGS: i32 = 40;
/// The largest number of distances computed to certify an opening.
const BUDGET: u64 = 20_000_000;

/// The turns of a closed chain with its ends apart, reached by a certified sweep from its own turns.
///
/// The last end is moved along −(e + f), the sum of the directions of the first and the last segment, by the change of
/// the turns with the smallest sum of squares, Jᵀ(JJᵀ)⁻¹δ with J the derivative of that end with respect to the turns,
/// as far as the sweep is certified clear. `None` if not even an opening of 2⁻⁴⁰ quarter segments is clear, as at a
/// cusp of angle 0.
pub(super) fn open_seam(chain: &Chain) -> Option<Vec<f64>> {
    let points = chain.points(chain.turns());
    let last = points.len() - 1;
    let [e, f] = [points[1] - points[0], points[last] - points[last - 1]].map(DVec2::normalize);
    let goal = -(e + f).try_normalize()?;
    let columns: Vec<DVec2> =
        points[1..last].iter().map(|&joint| (points[last] - joint).perp()).collect();
    let gram = columns.iter().fold(DMat2::ZERO, |sum, &c| sum + DMat2::from_cols(c * c.x, c * c.y));
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
