//! Two triangles at one instant, and their overlap along a direction.

use std::f64::consts::FRAC_1_SQRT_2;

use glam::DVec3;

use super::Limits;

/// Directions at an angle whose sine is below this count as equal.
const PARALLEL: f64 = 1e-6;

/// What an [`Axis`] is built from, which tells which vertices meet along it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Feature {
    /// Normal to triangle A: a facet of A and a corner of B.
    NormalA,
    /// Normal to triangle B: a facet of B and a corner of A.
    NormalB,
    /// Normal to edge i of A and edge j of B (edge i runs from corner i to corner i + 1).
    Edges(u8, u8),
    /// In the plane of A, normal to this edge.
    SideA(u8),
    /// In the plane of B, normal to this edge.
    SideB(u8),
    /// Anything else: a bisector, a coordinate axis, an axis carried over from the previous instant.
    Free,
}

/// A unit direction and the overlap along it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    /// The unit direction d of the axis.
    pub direction: DVec3,
    /// max d·a − min d·b: negative if A lies below B along d.
    pub overlap: f64,
    /// The feature that the direction is built from.
    pub feature: Feature,
}

/// Triangles A and B at one instant.
///
/// `shared` corners (0, 1 or 2) are the same vertices of the sheet and come first, in the same order, in both.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairPose {
    /// The positions of the corners of A.
    pub a: [DVec3; 3],
    /// The positions of the corners of B.
    pub b: [DVec3; 3],
    /// The number of leading corners that are the same vertices.
    pub shared: usize,
}

pub(super) fn highest(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

pub(super) fn lowest(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}

/// max a − min b: how far the numbers `a` extend above the numbers `b`.
pub(super) fn overlap_of(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    highest(a) - lowest(b)
}

/// By how much the corners that are not shared are apart: all of A's below, all of B's above, the shared ones between.
///
/// If two corners are shared, their edge must be normal to the direction, to within `limits.tolerance / 1000`.
pub(super) fn gap_of(a: &[f64; 3], b: &[f64; 3], shared: usize, limits: &Limits) -> f64 {
    if shared == 0 {
        return -overlap_of(a, b);
    }
    let (low, high) = (lowest(&a[..shared]), highest(&a[..shared]));
    if high - low > 1e-3 * limits.tolerance {
        return f64::NEG_INFINITY;
    }
    (low - highest(&a[shared..])).min(lowest(&b[shared..]) - high)
}

impl PairPose {
    /// The corners of both triangles projected onto `direction`.
    pub(super) fn projections(&self, direction: DVec3) -> ([f64; 3], [f64; 3]) {
        let project = |p: DVec3| direction.dot(p);
        (self.a.map(project), self.b.map(project))
    }

    /// max d·a − min d·b over the corners: how far A extends beyond the start of B along d. Precondition: |d| = 1.
    pub fn overlap(&self, direction: DVec3) -> f64 {
        let (a, b) = self.projections(direction);
        overlap_of(&a, &b)
    }

    /// How far the triangles are apart along d, not counting what they share; not positive if they are not.
    pub fn gap(&self, direction: DVec3, limits: &Limits) -> f64 {
        let (a, b) = self.projections(direction);
        gap_of(&a, &b, self.shared, limits)
    }

    /// The depth: the smallest overlap over all unit directions, with the axis at which it is attained; for triangles
    /// that are apart, an axis that separates them.
    ///
    /// The overlap along d is the support function of the Minkowski difference A − B. If that polytope contains the
    /// origin, the support function has its minima over the unit sphere at face normals, which are ±n_A, ±n_B and
    /// ±(edge of A × edge of B) (Gottschalk, Lin and Manocha 1996), so the depth is exact. If it does not, one of them
    /// separates, or an in-plane edge normal if the triangles are coplanar.
    pub fn depth(&self) -> Axis {
        let mut deepest =
            Axis { direction: DVec3::X, overlap: self.overlap(DVec3::X), feature: Feature::Free };
        self.visit_axes(|axis| {
            if axis.overlap < deepest.overlap {
                deepest = axis;
            }
        });
        deepest
    }

    /// Every candidate axis with an overlap of at most `limit`.
    ///
    /// Every component of the set { d : overlap ≤ limit } contains one of them (for 0 ≤ limit): its minimum is a face
    /// normal of A − B or separates the triangles.
    pub fn axes_within(&self, limit: f64, limits: &Limits) -> Vec<Axis> {
        let mut axes = Vec::with_capacity(16);
        let mut inner = DVec3::ZERO;
        self.visit_axes(|axis| {
            if axis.overlap <= limits.margin {
                inner += axis.direction;
            }
            if axis.overlap <= limit {
                axes.push(axis);
            }
        });
        // Around shared corners the separating directions form a cone. The face normals form its rim, and their sum
        // lies inside.
        if self.shared > 0 {
            let bisector = (self.shared == 2).then(|| self.bisector()).flatten();
            for direction in bisector.into_iter().chain(inner.try_normalize()) {
                let overlap = self.overlap(direction);
                if overlap <= limit {
                    axes.push(Axis { direction, overlap, feature: Feature::Free });
                }
            }
        }
        axes
    }

    /// For triangles that share an edge, the direction perpendicular to it from the apex of A towards that of B; `None`
    /// if it is undefined.
    pub fn bisector(&self) -> Option<DVec3> {
        let edge = (self.a[1] - self.a[0]).try_normalize()?;
        let across = |apex: DVec3| {
            let r = apex - self.a[0];
            (r - edge * edge.dot(r)).try_normalize()
        };
        let towards = across(self.b[2])? - across(self.a[2])?;
        (towards - edge * edge.dot(towards)).try_normalize()
    }

    fn visit_axes(&self, mut visit: impl FnMut(Axis)) {
        let edge = |t: &[DVec3; 3], i: usize| t[(i + 1) % 3] - t[i];
        let edges_a = [0, 1, 2].map(|i| edge(&self.a, i));
        let edges_b = [0, 1, 2].map(|i| edge(&self.b, i));
        let normal_a = edges_a[0].cross(edges_a[1]);
        let normal_b = edges_b[0].cross(edges_b[1]);
        let mut both_ways = |direction: DVec3, feature: Feature| {
            let Some(direction) = direction.try_normalize() else {
                return;
            };
            let (a, b) = self.projections(direction);
            visit(Axis { direction, overlap: overlap_of(&a, &b), feature });
            visit(Axis { direction: -direction, overlap: overlap_of(&b, &a), feature });
        };
        both_ways(normal_a, Feature::NormalA);
        both_ways(normal_b, Feature::NormalB);
        for (i, &ea) in edges_a.iter().enumerate() {
            both_ways(ea.cross(normal_a), Feature::SideA(i as u8));
            for (j, &eb) in edges_b.iter().enumerate() {
                both_ways(ea.cross(eb), Feature::Edges(i as u8, j as u8));
            }
        }
        for (j, &eb) in edges_b.iter().enumerate() {
            both_ways(eb.cross(normal_b), Feature::SideB(j as u8));
        }
        if normal_a == DVec3::ZERO && normal_b == DVec3::ZERO {
            // Both triangles have shrunk to segments, at an instant between frames; parallel segments have no other
            // normals.
            let longest = edges_a
                .into_iter()
                .chain(edges_b)
                .reduce(|p, q| if q.length_squared() > p.length_squared() { q } else { p });
            if let Some(along) = longest.and_then(DVec3::try_normalize) {
                let (u, v) = along.any_orthonormal_pair();
                let apart = self.b[0] - self.a[0];
                for direction in [u, v, apart - along * along.dot(apart)] {
                    both_ways(direction, Feature::Free);
                }
            }
        }
    }
}

/// `direction` turned along with a triangle that moves from `from` to `to`: the heights of the corners along it and its
/// component along the normal are kept. `None` if the triangle has no area at either end.
pub(super) fn turned_along(direction: DVec3, from: &[DVec3; 3], to: &[DVec3; 3]) -> Option<DVec3> {
    let (e1, e2) = (from[1] - from[0], from[2] - from[0]);
    let (f1, f2) = (to[1] - to[0], to[2] - to[0]);
    let normal = e1.cross(e2).try_normalize()?;
    let cross = f1.cross(f2);
    let squared = cross.length_squared();
    if squared == 0.0 {
        return None;
    }
    let in_plane = f2.cross(cross) * direction.dot(e1) + cross.cross(f1) * direction.dot(e2);
    (in_plane / squared + cross * (direction.dot(normal) / squared.sqrt())).try_normalize()
}

/// Whether the arc between two unit directions stays within the tolerance.
pub(super) fn are_linked(p: &Axis, q: &Axis, limits: &Limits) -> bool {
    let cosine = p.direction.dot(q.direction);
    let highest = highest_between(p.overlap, q.overlap, cosine);
    cosine > -0.98 && highest <= limits.tolerance - limits.margin
}

/// An upper bound of the overlaps along the arc between two unit directions, from those at its ends and its cosine.
///
/// For d(s) = (1 − s) d_1 + s d_2 the overlap along d(s), not normalised, is convex in s and so below its chord, the
/// height of a fixed vector along d(s). At angle φ of the arc that is x cos φ + y sin φ, which is largest at an end, or
/// √(x² + y²) if it rises at one end and falls at the other.
fn highest_between(start: f64, end: f64, cosine: f64) -> f64 {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    if sine < PARALLEL {
        return start.max(end);
    }
    let rise = (end - start * cosine) / sine;
    if rise > 0.0 && rise * cosine < start * sine { start.hypot(rise) } else { start.max(end) }
}

/// A lower bound of |d(s)| for d(s) between `from` and `to`; `None` if they are more than 90° apart.
pub(super) fn shortest_between(from: DVec3, to: DVec3) -> Option<f64> {
    let cosine = from.dot(to);
    let shortest = f64::midpoint(1.0, cosine).max(0.0).sqrt();
    (shortest > FRAC_1_SQRT_2).then_some(shortest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distance::triangle_triangle;
    use foldmotion_random::Random;

    #[test]
    fn no_overlap_on_an_arc_is_above_the_bound_from_its_ends() {
        let mut random = Random::new(14);
        let mut tight = 0;
        for _ in 0..2000 {
            let pose = PairPose { a: random.triangle(1.0), b: random.triangle(1.0), shared: 0 };
            let [u, v] = [(); 2].map(|()| random.vector().normalize_or(DVec3::X));
            let bound = highest_between(pose.overlap(u), pose.overlap(v), u.dot(v));
            let sampled = (0..=100).map(|k| u.lerp(v, f64::from(k) / 100.0));
            let sampled = sampled.filter_map(DVec3::try_normalize);
            let highest = sampled.map(|d| pose.overlap(d)).fold(f64::MIN, f64::max);
            assert!(highest <= bound + 1e-12, "{highest} {bound}");
            tight += u32::from(highest > bound - 1e-3);
        }
        assert!(tight > 500, "{tight}");
    }

    /// The smallest overlap found by random descent from many directions.
    fn brute_force_depth(pose: &PairPose, random: &mut Random) -> f64 {
        let mut least = f64::INFINITY;
        for _ in 0..30 {
            let mut at = random.vector().normalize_or(DVec3::X);
            let mut best = pose.overlap(at);
            let mut reach = 1.0;
            for _ in 0..1500 {
                let d = (at + random.vector() * reach).normalize_or(DVec3::X);
                let overlap = pose.overlap(d);
                if overlap < best {
                    (best, at) = (overlap, d);
                } else {
                    reach = (reach * 0.99).max(1e-5);
                }
            }
            least = least.min(best);
        }
        least
    }

    #[test]
    fn the_depth_of_crossing_triangles_is_the_least_overlap_over_all_directions() {
        let mut random = Random::new(21);
        let mut crossing = 0;
        while crossing < 60 {
            let pose = PairPose { a: random.triangle(1.0), b: random.triangle(1.0), shared: 0 };
            if triangle_triangle(&pose.a, &pose.b).distance > 0.0 {
                continue;
            }
            crossing += 1;
            let (depth, brute) = (pose.depth().overlap, brute_force_depth(&pose, &mut random));
            assert!(depth <= brute + 1e-12, "{depth} > {brute}");
            assert!(depth >= brute - 2e-3, "{depth} < {brute}");
        }
    }

    #[test]
    fn the_depth_is_positive_exactly_where_triangles_meet() {
        let mut random = Random::new(22);
        let mut met = 0;
        for _ in 0..2000 {
            let pose = PairPose {
                a: random.triangle(1.0),
                b: random.triangle(1.0).map(|p| p + DVec3::new(0.3, 0.2, 0.4)),
                shared: 0,
            };
            let distance = triangle_triangle(&pose.a, &pose.b).distance;
            let depth = pose.depth().overlap;
            met += usize::from(distance == 0.0);
            assert_eq!(distance > 1e-12, depth < -1e-12, "{distance} {depth}");
            assert!(-depth <= distance + 1e-12, "a gap is a lower bound");
        }
        assert!((200..1800).contains(&met), "both cases are tested: {met}");
    }

    #[test]
    fn coplanar_triangles_side_by_side_are_apart_and_on_each_other_have_no_depth() {
        let a = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let pose = |shift: DVec3| PairPose { a, b: a.map(|p| p + shift), shared: 0 };
        assert!(pose(DVec3::X * 1.5).depth().overlap < -0.3);
        assert!(pose(DVec3::X * 0.1).depth().overlap.abs() < 1e-15);
    }

    #[test]
    fn a_fold_past_half_a_turn_is_as_deep_as_the_overlap_of_its_facets_is_high() {
        // Facets folded onto each other: the highest common point of the tents over the crease has height 0.5.
        for past in [1e-3, 1e-5] {
            let pose = PairPose {
                a: [DVec3::ZERO, DVec3::X, DVec3::Y],
                b: [DVec3::ZERO, DVec3::X, DVec3::new(1.0, f64::cos(past), -f64::sin(past))],
                shared: 2,
            };
            let mut from_below = f64::INFINITY;
            pose.visit_axes(|axis| {
                if axis.direction.z > 0.9 {
                    from_below = from_below.min(axis.overlap);
                }
            });
            let expected = 0.5 * past;
            assert!((from_below - expected).abs() < 0.01 * expected);
        }
    }

    #[test]
    fn a_direction_turns_along_with_a_rigid_triangle() {
        let mut random = Random::new(23);
        for _ in 0..50 {
            let (axis, d) = (random.vector().normalize(), random.vector().normalize());
            let rotation = glam::DQuat::from_axis_angle(axis, random.number() * 3.0);
            let (from, shift) = (random.triangle(1.0), random.vector());
            let to = from.map(|p| rotation * p + shift);
            let turned = turned_along(d, &from, &to).unwrap();
            assert!(turned.distance(rotation * d) < 1e-10);
        }
    }
}
