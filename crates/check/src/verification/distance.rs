//! A lower bound of the distance of two triangles over an interval.

use glam::DVec3;

use super::closest::{Closest, closest};
use super::path::{OnPlane, Path};
use super::span::{Pose, Span};
use super::walk::SHORTEST_STEP;

/// How often a direction is levelled.
const LEVELLINGS: usize = 6;

/// What came of the search for a pair nearer than asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Nearness {
    /// Never nearer.
    Kept,
    /// Nearer at this instant.
    Nearer { time: f64, distance: f64 },
    /// Neither was found in the budget.
    Unproved,
}

/// The unit direction from A to B along which they lie apart most clearly; 0 where they meet.
///
/// Along the line of closest points the gap is the distance, unless that line is ill known: a rounding of the points
/// turns it, and where features tie they may be those of the wrong one. Then corners that should be level lie lower or
/// higher than the closest points, by what the gap falls short: all within twice that are made level.
fn clearest(pose: &Pose, closest: &Closest, slack: f64) -> DVec3 {
    let mut best = (closest.on_b - closest.on_a).normalize_or_zero();
    let mut gap = -pose.overlap(best);
    for _ in 0..LEVELLINGS {
        let short = closest.distance() - gap;
        if short <= slack {
            break;
        }
        let tries = [2.0, 1.2, 16.0].map(|factor| levelled(pose, best, factor * short));
        let gaps = tries.map(|direction| -pose.overlap(direction));
        let next = if gaps[1] > gaps[0] { 1 } else { 0 };
        let next = if gaps[2] > gaps[next] { 2 } else { next };
        if gaps[next] <= gap {
            break;
        }
        (best, gap) = (tries[next], gaps[next]);
    }
    best
}

/// The direction turned so that the corners of A within `depth` of its highest are level, and those of B of its lowest.
fn levelled(pose: &Pose, direction: DVec3, depth: f64) -> DVec3 {
    let height = |p: &DVec3| direction.dot(*p - pose.a[0]);
    let top = pose.a.iter().map(height).fold(f64::NEG_INFINITY, f64::max);
    let bottom = pose.b.iter().map(height).fold(f64::INFINITY, f64::min);
    let mut level = Vec::with_capacity(6);
    for (corners, extreme) in [(&pose.a, top), (&pose.b, bottom)] {
        let near = |i: usize| (height(&corners[i]) - extreme).abs() <= depth;
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            if near(i) && near(j) {
                level.push(corners[j] - corners[i]);
            }
        }
    }
    level.sort_by(|p, q| q.length_squared().total_cmp(&p.length_squared()));
    let mut basis: Vec<DVec3> = Vec::with_capacity(2);
    for edge in level {
        // Of a third direction nothing is left but rounding; two are kept.
        let rest = without(without(edge, &basis), &basis);
        if basis.len() < 2 && rest.length() > 1e-14 * edge.length() {
            basis.extend(rest.try_normalize());
        }
    }
    let turned = if let [u, v] = basis[..] {
        let normal = u.cross(v);
        normal * normal.dot(direction).signum()
    } else {
        without(without(direction, &basis), &basis)
    };
    turned.normalize_or_zero()
}

fn without(v: DVec3, basis: &[DVec3]) -> DVec3 {
    basis.iter().fold(v, |v, u| v - *u * u.dot(v))
}

/// Searches the interval for an instant at which the triangles are nearer than `limit`, or proves that there is none.
///
/// Between two instants the direction goes straight from the one along which they are clearest to the other, or rests
/// on one of them; the Bernstein coefficients bound the gap along it from below, and so the distance.
pub(super) fn keeps_distance(span: &Span, limit: f64, budget: u32) -> Nearness {
    let none = OnPlane {
        a: [false; 3],
        b: [false; 3],
    };
    let measure = |pose: &Pose| {
        let found = closest(pose);
        let distance = found.distance();
        let direction = clearest(pose, &found, 0.1 * (distance - limit).max(0.0));
        (distance, direction)
    };
    let (mut time, mut step) = (0.0, 1.0);
    let mut pose = span.at(0.0);
    let mut here = measure(&pose);
    for _ in 0..budget {
        if here.0 < limit {
            return Nearness::Nearer {
                time,
                distance: here.0,
            };
        }
        if time >= 1.0 {
            return Nearness::Kept;
        }
        let end = span.at(time + step);
        let there = measure(&end);
        if there.0 < limit {
            (time, here) = (time + step, there);
            continue;
        }
        let part = span.part(&pose, &end);
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
            return Nearness::Unproved;
        }
    }
    Nearness::Unproved
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::*;

    #[test]
    fn a_distance_that_is_kept_is_kept_at_every_sampled_instant_and_a_nearer_instant_is_found() {
        let mut random = Random::new(9);
        let mut kept = 0;
        for _ in 0..200 {
            let mut triangle = |shift: f64| [(); 3].map(|()| random.vector() + DVec3::X * shift);
            let (start, end) = (
                [triangle(0.0), triangle(2.0)],
                [triangle(0.0), triangle(2.0)],
            );
            let span = Span::new(start, end, 0);
            let distance = |k: u32| closest(&span.at(f64::from(k) / 500.0)).distance();
            let least = (0..=500).map(distance).fold(f64::INFINITY, f64::min);
            assert_ne!(keeps_distance(&span, least + 1e-3, 100_000), Nearness::Kept);
            if least > 0.05 {
                kept += 1;
                let answer = keeps_distance(&span, least - 0.02, 100_000);
                assert_eq!(answer, Nearness::Kept, "{least}");
            }
        }
        assert!(kept > 50, "{kept}");
    }
}
