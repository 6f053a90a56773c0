//! Whether every contact of two rigid bodies in relative translation can be undone by a small displacement.
//!
//! A contact can be undone if a path near the given one meets nothing. Displaced paths have one of a few displacements
//! at each waypoint and are straight between them; the waypoints that are reached without contact are followed from one
//! to the next. A path that is found is a proof, because contact is decided exactly. If no path is found, the scene
//! counts as penetrating, provided that the displacements were many: 26 directions with lengths up to 2 τ at waypoints
//! four times as dense, and out of the wedges between polygons at an edge, which may be too narrow for any of the 26.

use glam::DVec3;

use super::{
    distance::{swept_distance, to_f64},
    exact::{Convex, Point, UNIT, minus, plus},
    rigid::TOLERANCE,
};

/// The directions of a displacement within the angle between two polygons: nearer to one, in the middle, nearer to the
/// other.
const SHARES: [f64; 3] = [0.25, 0.5, 0.75];

/// Two rigid bodies of convex polygons; the second is displaced along straight paths.
#[derive(Debug, Clone)]
pub(crate) struct Bodies {
    pub(crate) still: Vec<Convex>,
    pub(crate) moving: Vec<Convex>,
    pub(crate) path: Vec<Point>,
}

/// A displacement in integers.
fn displacement(direction: DVec3, length: f64) -> Point {
    let along = direction.normalize_or_zero() * (length * UNIT as f64);
    along.to_array().map(|c| c.round() as i64)
}

/// The displacements of a length, zero first.
pub(crate) fn displacements(length: f64) -> Vec<Point> {
    let signs = [0.0, -1.0, 1.0];
    let directions =
        signs.iter().flat_map(|&x| signs.iter().flat_map(move |&y| signs.map(|z| [x, y, z])));
    directions.map(|d| displacement(DVec3::from_array(d), length)).collect()
}

/// The directions that lead from the common edges of two polygons into the angle between them.
fn into_wedges(polygons: &[Convex]) -> Vec<DVec3> {
    let mut directions = Vec::new();
    for (i, p) in polygons.iter().enumerate() {
        for q in &polygons[..i] {
            let both = p.corners.iter().filter(|c| q.corners.contains(c));
            if let [a, b] = *both.collect::<Vec<_>>() {
                let [d, e] = [p, q].map(|polygon| inward(polygon, *a, *b));
                directions.extend(SHARES.map(|share| d.lerp(e, share)));
            }
        }
    }
    directions
}

/// The direction from an edge of a polygon into it, perpendicular to the edge.
fn inward(polygon: &Convex, a: Point, b: Point) -> DVec3 {
    let along = to_f64(minus(b, a)).normalize_or_zero();
    let middle: DVec3 = polygon.corners.iter().map(|&c| to_f64(minus(c, a))).sum();
    (middle - along * along.dot(middle)).normalize_or_zero()
}

impl Bodies {
    /// The smallest distance over the whole path.
    pub(crate) fn distance(&self) -> f64 {
        let mut least = f64::INFINITY;
        for ends in self.windows() {
            for p in &self.still {
                for q in &self.moving {
                    least = least.min(swept_distance(p, q, ends[0], ends[1]));
                }
            }
        }
        least
    }

    /// Consecutive waypoints; a path of one waypoint stays there.
    fn windows(&self) -> Vec<[Point; 2]> {
        if let [only] = *self.path.as_slice() {
            return vec![[only, only]];
        }
        self.path.windows(2).map(|w| [w[0], w[1]]).collect()
    }

    /// Zero, and displacements of some lengths out of the wedges that each of the bodies has, or back into them.
    pub(crate) fn along_wedges(&self, lengths: &[f64]) -> Vec<Point> {
        let all = [&self.still, &self.moving].map(|polygons| into_wedges(polygons));
        let signed = all.into_iter().flatten().flat_map(|d| [d, -d]);
        let long = signed.flat_map(|d| lengths.iter().map(move |&length| displacement(d, length)));
        std::iter::once([0; 3]).chain(long).collect()
    }

    /// Whether a path with one of these displacements at each waypoint, with `density` times as many waypoints, meets
    /// nothing.
    pub(crate) fn can_be_undone(&self, choices: &[Point], density: i64) -> bool {
        let radius = choices.iter().map(|&d| to_f64(d).length()).fold(0.0, f64::max);
        let mut reached = vec![true; choices.len()];
        for [from, to] in self.windows() {
            let at = |k: i64| [0, 1, 2].map(|i| from[i] + (to[i] - from[i]) * k / density);
            for k in 0..density {
                reached = self.advance([at(k), at(k + 1)], radius, choices, &reached);
                if !reached.contains(&true) {
                    return false;
                }
            }
        }
        true
    }

    fn advance(
        &self,
        [from, to]: [Point; 2],
        radius: f64,
        choices: &[Point],
        reached: &[bool],
    ) -> Vec<bool> {
        let mut near = Vec::new();
        for p in &self.still {
            for q in &self.moving {
                if swept_distance(p, q, from, to) < radius + TOLERANCE {
                    near.push((p, q));
                }
            }
        }
        if near.is_empty() {
            return vec![true; choices.len()];
        }
        let is_clear = |i: usize, j: usize| {
            let ends = [plus(from, choices[i]), plus(to, choices[j])];
            reached[i] && !near.iter().any(|(p, q)| p.meets(q, ends[0], ends[1]))
        };
        (0..choices.len())
            .map(|j| is_clear(j, j) || (0..choices.len()).any(|i| is_clear(i, j)))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle::part::sixteenths;

    /// A plate that moves into a fold of 7° until its tip is `beyond` τ behind the crease, and out again.
    fn tip_in_a_fold(beyond: f64) -> Bodies {
        let polygon =
            |corners: &[Point]| Convex::new(corners.iter().map(|p| p.map(sixteenths)).collect());
        let panel = |z: i64| polygon(&[[0, -16, 0], [0, 16, 0], [-16, 16, z], [-16, -16, z]]);
        let at = |share: f64| displacement(DVec3::new(16.0, 0.0, -5.0), share);
        Bodies {
            still: vec![panel(4), panel(6)],
            moving: vec![polygon(&[[0, 0, 0], [-32, 8, 10], [-32, -8, 10]])],
            path: vec![at(-1.0), at(beyond * TOLERANCE), at(-1.0)],
        }
    }

    #[test]
    fn a_sharp_fold_lets_a_tip_out_along_itself_only() {
        let bodies = tip_in_a_fold(0.5);
        for length in [0.5, 0.7, 0.9, 2.0] {
            assert!(!bodies.can_be_undone(&displacements(length * TOLERANCE), 4));
        }
        assert!(bodies.can_be_undone(&bodies.along_wedges(&[0.9 * TOLERANCE]), 1));
    }

    #[test]
    fn a_tip_deeper_than_the_push_is_not_let_out() {
        let bodies = tip_in_a_fold(1.2);
        let pushes = [0.3, 0.6, 0.9].map(|length| length * TOLERANCE);
        assert!(!bodies.can_be_undone(&bodies.along_wedges(&pushes), 4));
        assert!(bodies.can_be_undone(&bodies.along_wedges(&[1.4 * TOLERANCE]), 1));
    }

    #[test]
    fn without_a_push_nothing_that_meets_is_undone() {
        let mut bodies = tip_in_a_fold(0.5);
        assert!(!bodies.can_be_undone(&[[0; 3]], 4));
        bodies.path.pop();
        bodies.path.pop();
        assert!(bodies.can_be_undone(&[[0; 3]], 4));
    }
}
