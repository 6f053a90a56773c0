//! How far a pair can move on before it comes too close: additive continuous collision detection.
//!
//! Li, Kaufman, Jiang 2021, "Codimensional incremental potential contact", algorithm 1: two primitives at distance D
//! cannot come closer than g in a time (D − g) / l, l a bound of their relative speed; advancing by nine tenths of
//! that over and over approaches the instant at which a tenth of the separation is left, never passing it. Most pairs
//! need none of that: along a fixed direction the separation of two convex sets whose corners move on straight lines is a
//! concave function of time, so if the direction between the closest points at the start still separates them at the
//! end, it does all the way.

use glam::DVec3;

use super::pair::ContactPair;

/// The share of the separation that a step leaves.
const KEPT: f64 = 0.1;
/// Advances before the time reached is taken as the limit.
const MAX_ADVANCES: usize = 500;

/// The largest t ≤ `limit` for which the pair keeps a tenth of its separation over `gap` while its corners `x` move
/// to x + t d. Conservative: the true limit is never passed, but for rounding.
pub(super) fn step_limit(
    pair: &ContactPair,
    gap: f64,
    x: &[DVec3; 4],
    d: &[DVec3; 4],
    limit: f64,
) -> f64 {
    let speed = pair.speed(d);
    let closest = pair.closest(x);
    let start = closest.distance - gap;
    if start > speed * limit {
        return limit;
    }
    if start <= 0.0 {
        return 0.0;
    }
    let end = std::array::from_fn(|i| x[i] + d[i] * limit);
    if pair.separation_along(closest.apart / closest.distance, &end) >= gap + KEPT * start {
        return limit;
    }
    let mut time = 0.0;
    let mut separation = start;
    for _advance in 0..MAX_ADVANCES {
        let next = time + (1.0 - KEPT) * separation / speed;
        if next >= limit {
            return limit;
        }
        let moved = std::array::from_fn(|i| x[i] + d[i] * next);
        separation = pair.closest(&moved).distance - gap;
        if separation < KEPT * start {
            return time;
        }
        time = next;
    }
    time
}

#[cfg(test)]
mod tests {
    use super::super::pair::PairKind;
    use super::*;

    /// Random numbers in [−1, 1).
    fn numbers(seed: u64) -> impl FnMut() -> f64 {
        let mut random = fastrand::Rng::with_seed(seed);
        move || 2.0 * random.f64() - 1.0
    }

    #[test]
    fn no_sampled_instant_before_the_limit_comes_closer_than_the_gap() {
        let mut number = numbers(7);
        let mut vector = || DVec3::new(number(), number(), number());
        let gap = 0.02;
        let (mut limited, mut late) = (0, 0);
        for trial in 0..600 {
            let kind = if trial % 2 == 0 { PairKind::VertexFacet } else { PairKind::EdgeEdge };
            let pair = ContactPair::new(kind, [0, 1, 2, 3], [0, 1], gap, 1.0);
            let x: [DVec3; 4] = std::array::from_fn(|_| vector());
            let d: [DVec3; 4] = std::array::from_fn(|_| vector() * 2.0);
            let at = |t: f64| -> f64 {
                let moved = std::array::from_fn(|i| x[i] + d[i] * t);
                pair.closest(&moved).distance - gap
            };
            let start = at(0.0);
            if start <= 0.0 {
                continue;
            }
            let limit = step_limit(&pair, gap, &x, &d, 1.0);
            for k in 0..=1000 {
                let t = limit * f64::from(k) / 1000.0;
                assert!(at(t) >= 0.1 * start - 1e-12, "{kind:?} {trial} at {t} of {limit}");
            }
            if limit < 1.0 {
                limited += 1;
                // Not over-cautious: soon after the limit the separation does fall to a fifth.
                let soon = (0..=1000)
                    .any(|k| at((limit + 0.1 * f64::from(k) / 1000.0).min(1.0)) < 0.2 * start);
                late += usize::from(!soon);
            }
        }
        assert!(limited > 50, "only {limited} pairs met");
        assert!(late * 10 < limited, "{late} of {limited} limits were far too early");
    }
}
