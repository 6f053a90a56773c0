//! The closest approach of two moving triangles.

use glam::DVec3;

use super::{Limits, MovingPair, PairPose, moving::Leaf};
use crate::distance::{Closest, triangle_triangle};

/// The shortest step: motions over it are far below τ / 100.
const SHORTEST_STEP: f64 = 1.0 / (1u64 << 34) as f64;

/// An instant of closest approach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Approach {
    /// t in [0, 1].
    pub time: f64,
    /// The distance and where it is attained.
    pub closest: Closest,
}

/// What was found nearer than a bound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Approaches {
    /// The nearest instant found; none where none is nearer than the bound.
    pub nearest: Option<Approach>,
    /// Whether the budget sufficed to bound the distance from below at all times.
    pub is_complete: bool,
}

/// The closest approach over t in [0, 1], if it is nearer than `bound`.
///
/// The distance is attained, so it is an upper bound of the minimum; where the search is complete the minimum is
/// smaller by at most the larger of τ / 100 and a ten thousandth of it. Between the instants at which the exact distance is taken, the
/// gap along the line of closest points bounds it from below.
pub fn closest_approach(pair: &MovingPair, bound: f64, limits: &Limits) -> Approaches {
    let mut search = Search { best: None, bound };
    let mut here = search.measure(0.0, &pair.start);
    let mut pose = pair.start;
    let (mut time, mut step) = (0.0, 1.0);
    for _ in 0..limits.budget {
        if time >= 1.0 || search.bound <= 0.0 {
            break;
        }
        let end = pair.at(time + step);
        let there = search.measure(time + step, &end);
        let enough = enough_clearance(search.bound, limits);
        if least_distance(&pose, &end, &here, &there, limits) >= enough || step <= SHORTEST_STEP {
            time += step;
            (pose, here) = (end, there);
            if (time / (2.0 * step)).fract() == 0.0 && step < 1.0 {
                step *= 2.0;
            }
        } else {
            step *= 0.5;
        }
    }
    Approaches {
        nearest: search.best,
        is_complete: time >= 1.0 || search.bound <= 0.0,
    }
}

/// A lower bound of the distance that makes a search below `bound` pointless, to the precision promised.
pub fn enough_clearance(bound: f64, limits: &Limits) -> f64 {
    bound - (0.01 * limits.tolerance).max(1e-4 * bound)
}

struct Search {
    best: Option<Approach>,
    bound: f64,
}

impl Search {
    fn measure(&mut self, time: f64, pose: &PairPose) -> Closest {
        let closest = triangle_triangle(&pose.a, &pose.b);
        if closest.distance < self.bound {
            self.bound = closest.distance;
            self.best = Some(Approach { time, closest });
        }
        closest
    }
}

/// A lower bound of the distance between two instants whose closest points are known.
fn least_distance(
    from: &PairPose,
    to: &PairPose,
    here: &Closest,
    there: &Closest,
    limits: &Limits,
) -> f64 {
    let towards = |closest: &Closest| (closest.on_b - closest.on_a).try_normalize();
    let (Some(d0), Some(d1)): (Option<DVec3>, Option<DVec3>) = (towards(here), towards(there))
    else {
        return 0.0;
    };
    let leaf = Leaf { from, to };
    leaf.least_gap(d0, d1, limits)
        .max(leaf.least_gap_at_rest(d0, limits))
        .max(leaf.least_gap_at_rest(d1, limits))
        - limits.margin
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collide::random::Random;

    const LIMITS: Limits = Limits {
        tolerance: 1e-6,
        margin: 1e-13,
        budget: 20_000,
    };

    #[test]
    fn the_closest_approach_is_what_dense_sampling_finds() {
        let mut random = Random::new(41);
        for _ in 0..80 {
            let mut pose = || PairPose {
                a: random.triangle(1.0),
                b: random.triangle(1.0).map(|p| p + DVec3::X * 1.5),
                shared: 0,
            };
            let (start, end) = (pose(), pose());
            let pair = MovingPair { start, end };
            let found = closest_approach(&pair, f64::INFINITY, &LIMITS);
            assert!(found.is_complete);
            let approach = found.nearest.unwrap();
            let sampled = (0..=2000)
                .map(|k| pair.at(f64::from(k) / 2000.0))
                .map(|p| triangle_triangle(&p.a, &p.b).distance)
                .fold(f64::INFINITY, f64::min);
            let (least, slack) = (approach.closest.distance, 1e-8 + 2e-4 * sampled);
            assert!(least <= sampled + slack, "{least} {sampled}");
            // Corners move by at most 4 in 2000 steps between samples.
            assert!(least >= sampled - 8e-3, "{least} {sampled}");
            let there = pair.at(approach.time);
            assert_eq!(triangle_triangle(&there.a, &there.b).distance, least);
        }
    }

    #[test]
    fn a_pair_farther_than_the_bound_is_left_out() {
        let a = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let pose = PairPose {
            a,
            b: a.map(|p| p + DVec3::Z),
            shared: 0,
        };
        let pair = MovingPair {
            start: pose,
            end: pose,
        };
        let nearest = |bound: f64| closest_approach(&pair, bound, &LIMITS).nearest;
        assert!(nearest(0.9).is_none() && nearest(1.1).is_some());
    }
}
