//! A lower bound of the distance of two triangles over an interval.

use glam::DVec3;

use crate::closest::{Closest, closest};
use crate::follow::SHORTEST_STEP;
use crate::moving_pair::{MovingPair, OnPlane, PairPose};
use crate::path::Path;

/// The result of the search for an instant at which a pair is nearer than a limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum DistanceProof {
    /// The pair is never nearer than the limit.
    Kept,
    /// The pair is nearer than the limit at this instant.
    Nearer { time: f64, distance: f64 },
    /// Neither could be shown within the budget.
    Unproved,
}

/// The unit direction from A to B along which they are apart most clearly; 0 if they intersect.
///
/// Along the line of closest points the gap is the distance, unless that line is ill-conditioned: rounding of the
/// points turns it, and if several features are equally near, the points may belong to the wrong one. Then one or two
/// of the six edges, which should be level along the line, are made level, all combinations in turn, and the direction
/// with the widest gap is returned.
fn clearest(pose: &PairPose, closest: &Closest, slack: f64) -> DVec3 {
    let line = (closest.on_b - closest.on_a).normalize_or_zero();
    let gap = -pose.overlap(line);
    if gap >= closest.distance() - slack {
        return line;
    }
    let (mut best, mut widest) = (line, gap);
    let mut keep = |direction: DVec3| {
        let gap = -pose.overlap(direction);
        if gap > widest {
            (best, widest) = (direction, gap);
        }
    };
    let edge = |k: usize| {
        let corners = if k < 3 { &pose.a } else { &pose.b };
        corners[(k + 1) % 3] - corners[k % 3]
    };
    for i in 0..6 {
        keep(levelled(line, &[edge(i)]));
        for j in 0..i {
            let level = levelled(line, &[edge(j), edge(i)]);
            keep(level);
            keep(-level);
        }
    }
    best
}

/// The direction turned so that one or two edges are level along it, to within rounding of their lengths.
///
/// The longer edge comes first; of the other, however nearly parallel it is, the component normal to it remains.
fn levelled(direction: DVec3, edges: &[DVec3]) -> DVec3 {
    let mut sorted = edges.to_vec();
    sorted.sort_by(|p, q| q.length_squared().total_cmp(&p.length_squared()));
    let mut basis: Vec<DVec3> = Vec::with_capacity(2);
    for edge in sorted {
        basis.extend(without(without(edge, &basis), &basis).try_normalize());
    }
    let turned = match basis[..] {
        [u, v] => u.cross(v),
        _ => without(without(direction, &basis), &basis),
    };
    turned.normalize_or_zero()
}

fn without(v: DVec3, basis: &[DVec3]) -> DVec3 {
    basis.iter().fold(v, |v, u| v - *u * u.dot(v))
}

/// Searches the interval for an instant at which the triangles are nearer than `limit`, or proves that there is none.
///
/// Between two instants, the direction moves straight from the one along which the triangles are clearest at the first
/// to that at the second, or stays at one of them. The Bernstein coefficients bound the gap along it from below, and so
/// the distance.
pub(crate) fn keeps_distance(moving: &MovingPair, limit: f64, budget: u32) -> DistanceProof {
    let none = OnPlane { a: [false; 3], b: [false; 3] };
    let measure = |pose: &PairPose| {
        let found = closest(pose);
        let distance = found.distance();
        let direction = clearest(pose, &found, 0.1 * (distance - limit).max(0.0));
        (distance, direction)
    };
    let (mut time, mut step) = (0.0, 1.0);
    let mut pose = moving.at(0.0);
    let mut here = measure(&pose);
    for _ in 0..budget {
        if here.0 < limit {
            return DistanceProof::Nearer { time, distance: here.0 };
        }
        if time >= 1.0 {
            return DistanceProof::Kept;
        }
        let end = moving.at(time + step);
        let there = measure(&end);
        if there.0 < limit {
            (time, here) = (time + step, there);
            continue;
        }
        let part = moving.part(&pose, &end);
        let (d0, d1) = (here.1, there.1);
        let is_kept = [(d0, d1), (d0, d0), (d1, d1)]
            .into_iter()
            .any(|(from, to)| Path::straight(from, to).bound(&part, none).gap >= limit);
        if is_kept {
            time += step;
            (pose, here) = (end, there);
            if step < 1.0 && (time / (2.0 * step)).fract() == 0.0 {
                step *= 2.0;
            }
        } else if step > SHORTEST_STEP {
            step *= 0.5;
        } else {
            return DistanceProof::Unproved;
        }
    }
    DistanceProof::Unproved
}

#[cfg(test)]
mod tests {
    use super::*;
    use foldmotion_random::Random;

    #[test]
    fn a_distance_that_is_kept_is_kept_at_every_sampled_instant_and_a_nearer_instant_is_found() {
        let mut random = Random::new(9);
        let mut kept = 0;
        for _ in 0..200 {
            let mut triangle = |shift: f64| [(); 3].map(|()| random.vector() + DVec3::X * shift);
            let (start, end) = ([triangle(0.0), triangle(2.0)], [triangle(0.0), triangle(2.0)]);
            let moving = MovingPair::new(start, end, 0);
            let distance = |k: u32| closest(&moving.at(f64::from(k) / 500.0)).distance();
            let least = (0..=500).map(distance).fold(f64::INFINITY, f64::min);
            assert_ne!(keeps_distance(&moving, least + 1e-3, 100_000), DistanceProof::Kept);
            if least > 0.05 {
                kept += 1;
                let answer = keeps_distance(&moving, least - 0.02, 100_000);
                assert_eq!(answer, DistanceProof::Kept, "{least}");
            }
        }
        assert!(kept > 50, "{kept}");
    }
}
