//! The seam of a closed chain: that it opens, and how to open it.

use glam::{DMat2, DVec2};

use super::certificate::{Sweep, SweepVerdict};
use super::chain::Chain;

/// How far the ends are taken apart at first, in mean segments, and how often that is halved at most.
const OPENING: f64 = 0.25;
const MOST_HALVINGS: i32 = 40;
/// Distances computed to certify an opening, at most.
const BUDGET: u64 = 20_000_000;

/// Up to which fraction of a sweep the first and the last segment, together at its start, are known to part.
///
/// Seen from the first segment, of direction e, the other end moves by g(u), and the last segment, of direction f, turns.
/// Take a unit vector m with m·e, m·f and −m·g′/|g′| all at least μ > 0. As long as m·f ≥ 0 and m·g′ < 0, the first segment
/// lies on the side m·x ≥ 0 of its end and the last one, which runs towards g, on the side m·x < 0. f turns at the rate
/// |ψ_n|, the sum of all changes, and |g″| ≤ Σ l_k ψ_k², where ψ_k is that up to segment k. 0 where there is no such m, or
/// the ends are already apart.
pub(super) fn seam_opens_until(chain: &Chain, from: &[f64], change: &[f64], rounding: f64) -> f64 {
    let points = chain.points(from);
    let last = points.len() - 1;
    if points[last].length() > rounding {
        return 0.0;
    }
    let mut turned = 0.0;
    let mut curvature = 0.0;
    let mut velocity = DVec2::ZERO;
    for (k, segment) in points.windows(2).enumerate() {
        if k > 0 {
            turned += change[k - 1];
        }
        velocity += (segment[1] - segment[0]).perp() * turned;
        curvature += chain.lengths[k] * turned * turned;
    }
    let [e, f] = [points[1] - points[0], points[last] - points[last - 1]].map(DVec2::normalize);
    let Some(opening) = (-velocity).try_normalize() else {
        return 0.0;
    };
    let least = |m: DVec2| m.dot(e).min(m.dot(f)).min(m.dot(opening));
    let bisectors = [e + f, f + opening, opening + e];
    let share = bisectors
        .into_iter()
        .filter_map(DVec2::try_normalize)
        .map(least)
        .fold(0.0, f64::max);
    if share <= 0.0 {
        return 0.0;
    }
    let parts_until = share * velocity.length() / curvature;
    0.5 * parts_until.min(share / turned.abs()).min(1.0)
}

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
