//! The direction along which two triangles are apart most clearly at an instant.
//!
//! For triangles that are apart, the largest gap min d·b − max d·a over all unit directions is their distance, attained
//! along the line of closest points. Closest points tie to within rounding if a corner passes an edge near its end;
//! along the line from the wrong one, the gap is smaller by as much as √ε of a length. Directions built from features
//! do not have that problem: the component along what a direction must be normal to is subtracted twice, so that it
//! stays normal to within rounding, whatever the angle between edges and the height of slivers.

use glam::DVec3;

use super::{Limits, PairPose};
use crate::distance::{Closest, normal_part};

/// A unit direction with A below and B above, and the gap along it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Clearest {
    pub(super) direction: DVec3,
    pub(super) gap: f64,
}

impl Clearest {
    /// Taken from the closest points, and from all features if the gap along those falls short of the distance by more
    /// than `slack`. `None` if the triangles intersect.
    ///
    /// Precondition: the triangles share no corner.
    pub(super) fn of(
        pose: &PairPose,
        closest: &Closest,
        slack: f64,
        limits: &Limits,
    ) -> Option<Self> {
        let line = closest.on_b - closest.on_a;
        let mut best = Self { direction: line.try_normalize()?, gap: f64::NEG_INFINITY };
        best.gap = pose.gap(best.direction, limits);
        if best.gap < closest.distance - slack {
            visit_directions(pose, |direction| {
                let gap = pose.gap(direction, limits);
                if gap > best.gap {
                    best = Self { direction, gap };
                }
            });
        }
        Some(best)
    }
}

/// Visits the unit directions that may separate most clearly, by the features that meet along them: two corners, a
/// corner and an edge, a corner and a facet, two edges.
fn visit_directions(pose: &PairPose, mut visit: impl FnMut(DVec3)) {
    let mut give = |direction: DVec3, is_either_way: bool| {
        if let Some(direction) = direction.try_normalize() {
            visit(direction);
            if is_either_way {
                visit(-direction);
            }
        }
    };
    let edges = |t: &[DVec3; 3]| [0, 1, 2].map(|i| (t[i], (t[(i + 1) % 3] - t[i])));
    let (edges_a, edges_b) = (edges(&pose.a), edges(&pose.b));
    for p in pose.a {
        for q in pose.b {
            give(q - p, false);
        }
    }
    for (edges, others, sign) in [(&edges_a, &pose.b, 1.0), (&edges_b, &pose.a, -1.0)] {
        let units = edges.map(|(from, edge)| (from, edge.try_normalize().unwrap_or(DVec3::ZERO)));
        for (from, along) in units {
            for &corner in others {
                give(normal_part(corner - from, along) * sign, false);
            }
        }
        give(common_normal(edges[0].1, edges[1].1), true);
        give(common_normal(edges[1].1, edges[2].1), true);
    }
    for (_, u) in edges_a {
        for (_, v) in edges_b {
            give(common_normal(u, v), true);
        }
    }
}

/// u × v over |u|, normal to both to within rounding even if they are nearly parallel; 0 if they are parallel.
fn common_normal(u: DVec3, v: DVec3) -> DVec3 {
    let (long, short) = if u.length_squared() >= v.length_squared() { (u, v) } else { (v, u) };
    let along = long.try_normalize().unwrap_or(DVec3::ZERO);
    let across = normal_part(short, along).try_normalize().unwrap_or(DVec3::ZERO);
    along.cross(across)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distance::triangle_triangle;
    use foldmotion_random::Random;

    const LIMITS: Limits = Limits { tolerance: 1e-6, margin: 1e-14, budget: 1 };

    fn clearest(pose: &PairPose, slack: f64) -> (f64, Option<Clearest>) {
        let closest = triangle_triangle(&pose.a, &pose.b);
        let found = Clearest::of(pose, &closest, slack, &LIMITS);
        (closest.distance, found)
    }

    #[test]
    fn the_gap_is_the_distance_of_slivers_and_of_edges_nearly_parallel() {
        let mut random = Random::new(51);
        let mut apart = 0;
        for case in 0..4000 {
            let thin = 10f64.powi(-(case % 11));
            let scale = |p: DVec3| DVec3::new(p.x, p.y * thin, p.z);
            let lift = DVec3::Z * 10f64.powi(-(case % 6));
            let flat = DVec3::new(1.0, 1.0, thin);
            let pose = PairPose {
                a: random.triangle(1.0).map(scale),
                b: random.triangle(1.0).map(|p| scale(p) * flat + lift),
                shared: 0,
            };
            let (distance, found) = clearest(&pose, 0.0);
            let Some(found) = found.filter(|_| distance > 1e-7) else {
                continue;
            };
            apart += 1;
            assert!(found.gap <= distance + 1e-14, "{case}");
            assert!(found.gap >= distance - 1e-11, "{case}: {} of {distance}", found.gap);
        }
        assert!(apart > 1000, "{apart}");
    }

    #[test]
    fn a_tie_of_corner_and_edge_does_not_cost_the_gap() {
        let x = 17e-6;
        let pose = PairPose {
            a: [
                DVec3::new(0.1, -0.4, -0.1),
                DVec3::new(-0.1, 0.6, -0.1),
                DVec3::new(-0.1, 1.0, -0.5),
            ],
            b: [
                DVec3::new(0.1, -0.4 - x, -0.1 - 3.3e-11),
                DVec3::new(0.1, -0.4 - x, 0.5),
                DVec3::new(0.1, -1.0, 0.4),
            ],
            shared: 0,
        };
        let (distance, all) = clearest(&pose, 0.0);
        assert!(all.unwrap().gap > distance - 1e-13);
    }
}
