//! Descent of the energy by steps that provably do not cross anything.
//!
//! A step changes all turns linearly by s·δ. For every pair of segments i < j, its length s is limited by the larger of
//! two bounds on how much they can approach each other:
//!
//! - s V_ij along the chain (see the certificate);
//! - the displacement of their points in a frame that turns with the mean heading and moves with the mean point: a
//!   point with velocity a_p moves by at most s |a_p| + s² b / 2, with b = Σ l_k ψ_k² and ψ_k the change of heading of
//!   segment k in that frame.
//!
//! Half of the distance of the two is allowed, so that they are still apart after the step.

use std::f64::consts::PI;

use glam::DVec2;

use super::certificate::Sweep;
use super::chain::{Chain, segment_distance, sums};
use super::energy::{energy, energy_and_gradient};
use crate::GeometryError;

/// The share of a distance, and of the turn remaining to ±π, that a step may use.
const ALLOWED: f64 = 0.5;
/// A step must achieve this share of the descent that its slope predicts (Armijo).
const SUFFICIENT: f64 = 1e-4;
/// The first attempt at a step is this many times as long as the previous step.
const GROWTH: f64 = 2.0;
/// Steps that turn the joints by less than this, in radians (root of the sum of squares), are lost in rounding.
const SHORTEST: f64 = 1e-14;
/// The largest number of steps.
const MOST_STEPS: usize = 100_000;

/// A state of the descent.
#[derive(Debug, Clone)]
pub(super) struct Waypoint {
    pub(super) turns: Vec<f64>,
    /// The smallest distance of segments that are not neighbours, in mean segments.
    pub(super) clearance: f64,
}

/// The states from `turns` to the first one whose headings all lie within less than half a turn.
///
/// # Errors
/// [`GeometryError::NotStraightened`] if rounding ends the descent before that, or the number of steps is insufficient.
pub(super) fn descend(chain: &Chain, turns: Vec<f64>) -> Result<Vec<Waypoint>, GeometryError> {
    let mut waypoints = Vec::new();
    let mut turns = turns;
    let mut length = f64::INFINITY;
    while !Chain::is_monotone(&turns) {
        let points = chain.points(&turns);
        let (before, gradient) = energy_and_gradient(&points);
        let squared: f64 = gradient.iter().map(|g| g * g).sum();
        let moved = |length: f64| -> Vec<f64> {
            turns.iter().zip(&gradient).map(|(t, g)| t - length * g).collect()
        };
        let limit = limit(chain, &turns, &points, &gradient);
        length = limit.length.min(GROWTH * length);
        let next = loop {
            let next = moved(length);
            if energy(&chain.points(&next)) <= before - SUFFICIENT * length * squared {
                break next;
            }
            length *= 0.5;
            let is_lost = !length.is_finite() || length * squared.sqrt() < SHORTEST;
            if is_lost || waypoints.len() >= MOST_STEPS {
                return Err(GeometryError::NotStraightened {
                    steps: waypoints.len(),
                    clearance: limit.clearance,
                });
            }
        };
        waypoints.push(Waypoint {
            turns: std::mem::replace(&mut turns, next),
            clearance: limit.clearance,
        });
    }
    let clearance = clearance(&chain.points(&turns));
    waypoints.push(Waypoint { turns, clearance });
    Ok(waypoints)
}

/// The limit of a step.
struct Limit {
    length: f64,
    clearance: f64,
}

fn limit(chain: &Chain, turns: &[f64], points: &[DVec2], gradient: &[f64]) -> Limit {
    let direction: Vec<f64> = turns.iter().zip(gradient).map(|(t, g)| t - g).collect();
    let sweep = Sweep::new(chain, turns, &direction);
    let motion = Motion::new(chain, points, gradient);
    let mut limit = Limit { length: f64::INFINITY, clearance: f64::INFINITY };
    let count = chain.segment_count();
    for i in 0..count {
        for j in i + 2..count {
            let distance = segment_distance([points[i], points[i + 1]], [points[j], points[j + 1]]);
            let allowed = ALLOWED * distance;
            let along_chain = allowed / sweep.approach([i, j]);
            // The square root is skipped if it cannot matter.
            if along_chain < limit.length {
                limit.length = limit.length.min(along_chain.max(motion.reach([i, j], allowed)));
            }
            limit.clearance = limit.clearance.min(distance);
        }
    }
    for (turn, change) in turns.iter().zip(gradient) {
        limit.length = limit.length.min(ALLOWED * (PI - turn.abs()) / change.abs());
    }
    limit
}

/// The motion of the points as the turns change at the rates of the gradient, in the frame of the module documentation.
struct Motion {
    /// The larger speed of the two ends of each segment.
    speeds: Vec<f64>,
    /// The bound b of the module documentation.
    curvature: f64,
}

impl Motion {
    fn new(chain: &Chain, points: &[DVec2], rates: &[f64]) -> Self {
        let turned = sums(rates);
        let length = chain.arcs[chain.segment_count()];
        let weighted = turned.iter().zip(&chain.lengths).map(|(t, l)| t * l);
        let mean = weighted.sum::<f64>() / length;
        let mut velocity = DVec2::ZERO;
        let mut velocities = vec![velocity];
        let mut curvature = 0.0;
        for (k, segment) in points.windows(2).enumerate() {
            let rate = turned[k] - mean;
            velocity += (segment[1] - segment[0]).perp() * rate;
            velocities.push(velocity);
            curvature += chain.lengths[k] * rate * rate;
        }
        let mean = velocities.iter().sum::<DVec2>() / velocities.len() as f64;
        let speeds: Vec<f64> = velocities.iter().map(|v| (v - mean).length()).collect();
        Self { speeds: speeds.windows(2).map(|s| s[0].max(s[1])).collect(), curvature }
    }

    /// The longest step in which a pair approaches by no more than `allowed`: the root of s (a_i + a_j) + s² b = allowed.
    fn reach(&self, [i, j]: [usize; 2], allowed: f64) -> f64 {
        let speed = self.speeds[i] + self.speeds[j];
        let root = (speed * speed + 4.0 * self.curvature * allowed).sqrt();
        2.0 * allowed / (speed + root)
    }
}

/// The smallest distance of segments that are not neighbours; infinite if there are none.
pub(super) fn clearance(points: &[DVec2]) -> f64 {
    let count = points.len() - 1;
    let pairs = (0..count).flat_map(|i| (i + 2..count).map(move |j| [i, j]));
    let distance = |[i, j]: [usize; 2]| {
        segment_distance([points[i], points[i + 1]], [points[j], points[j + 1]])
    };
    pairs.map(distance).fold(f64::INFINITY, f64::min)
}
