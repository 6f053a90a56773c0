//! A proof that the seam of a closed chain opens during a sweep.

use glam::DVec2;

use super::chain::Chain;

/// The fraction of a sweep up to which the first and the last segment, which coincide in a point at its start, are
/// known to separate.
///
/// Seen from the first segment, of direction e, the other end moves by g(u), and the last segment, of direction f,
/// turns. Take a unit vector m such that m·e, m·f and −m·g′/|g′| are all at least μ > 0. As long as m·f ≥ 0 and m·g′ <
/// 0, the first segment lies on the side m·x ≥ 0 of its end, and the last one, which runs towards g, on the side m·x <
/// 0. f turns at the rate |ψ_n|, the sum of all changes, and |g″| ≤ Σ l_k ψ_k², where ψ_k is the sum up to segment k.
/// The result is 0 if there is no such m, or if the ends are already apart.
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
    let share =
        bisectors.into_iter().filter_map(DVec2::try_normalize).map(least).fold(0.0, f64::max);
    if share <= 0.0 {
        return 0.0;
    }
    let parts_until = share * velocity.length() / curvature;
    0.5 * parts_until.min(share / turned.abs()).min(1.0)
}
