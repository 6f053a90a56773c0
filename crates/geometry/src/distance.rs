//! Distances between points, segments and triangles, with the points where they are attained.

use glam::DVec3;

/// The closest points of two sets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Closest {
    /// Their distance, a length; 0 if the sets intersect.
    pub distance: f64,
    /// The closest point of the first set.
    pub on_a: DVec3,
    /// The closest point of the second set.
    pub on_b: DVec3,
}

/// A point of each set.
#[derive(Clone, Copy)]
struct Points {
    squared: f64,
    on_a: DVec3,
    on_b: DVec3,
}

impl Points {
    fn between(on_a: DVec3, on_b: DVec3) -> Self {
        Self { squared: on_a.distance_squared(on_b), on_a, on_b }
    }

    fn flipped(self) -> Self {
        Self { on_a: self.on_b, on_b: self.on_a, ..self }
    }

    fn keep_nearer(&mut self, other: Self) {
        if other.squared < self.squared {
            *self = other;
        }
    }
}

impl From<Points> for Closest {
    fn from(points: Points) -> Self {
        Self { distance: points.on_a.distance(points.on_b), on_a: points.on_a, on_b: points.on_b }
    }
}

/// Segments count as nearly parallel if the squared sine of their angle is below this; triangles count as slivers if (2
/// area / longest²)² is.
const NEARLY_PARALLEL: f64 = 1e-4;

/// The point of a segment nearest to `point`.
fn on_segment(point: DVec3, [from, to]: [DVec3; 2]) -> DVec3 {
    let along = to - from;
    let squared = along.length_squared();
    let t = (point - from).dot(along);
    if t >= squared && squared > 0.0 {
        to
    } else if t > 0.0 {
        from + along * (t / squared)
    } else {
        from
    }
}

/// The closest points of segments `a` and `b`.
///
/// Ericson 2005, "Real-Time Collision Detection", section 5.1.9. Its parameters lose accuracy by 1 / sin² of the angle,
/// so segments at an angle below a hundredth are handled differently. Segments without length and parallel segments are
/// allowed. The distance is that of the points returned, and off by at most about a hundred roundings of the lengths.
pub fn segment_segment(a: [DVec3; 2], b: [DVec3; 2]) -> Closest {
    of_segments(a, b).into()
}

fn of_segments(a: [DVec3; 2], b: [DVec3; 2]) -> Points {
    let (u, v, w) = (a[1] - a[0], b[1] - b[0], a[0] - b[0]);
    let (uu, uv, vv, uw, vw) = (u.dot(u), u.dot(v), v.dot(v), u.dot(w), v.dot(w));
    let determinant = uu * vv - uv * uv;
    if determinant > NEARLY_PARALLEL * uu * vv {
        let mut s = ((uv * vw - uw * vv) / determinant).clamp(0.0, 1.0);
        let t = (uv * s + vw) / vv;
        let t_inside = t.clamp(0.0, 1.0);
        if t != t_inside {
            s = ((uv * t_inside - uw) / uu).clamp(0.0, 1.0);
        }
        return Points::between(a[0] + u * s, b[0] + v * t_inside);
    }
    // The closest of the four ends above the other segment, and of the points where the lines are closest.
    let on_a = |along: f64| a[0] + u * share(along, uu);
    let on_b = |along: f64| b[0] + v * share(along, vv);
    let mut closest = Points::between(a[0], on_b(vw));
    closest.keep_nearer(Points::between(a[1], on_b(vw + uv)));
    closest.keep_nearer(Points::between(on_a(-uw), b[0]));
    closest.keep_nearer(Points::between(on_a(uv - uw), b[1]));
    if uu >= vv {
        if let Some(t) = where_crossed(u, v, w) {
            closest.keep_nearer(Points::between(on_a(uv * t - uw), b[0] + v * t));
        }
    } else if let Some(s) = where_crossed(v, u, -w) {
        closest.keep_nearer(Points::between(a[0] + u * s, on_b(uv * s + vw)));
    }
    closest
}

/// x / y clamped to [0, 1]; 0 if y is 0.
fn share(x: f64, y: f64) -> f64 {
    if y > 0.0 { (x / y).clamp(0.0, 1.0) } else { 0.0 }
}

/// The parameter in (0, 1) at which the second of two nearly parallel segments crosses the first, seen along their
/// common normal; `None` if it does not.
///
/// u, v: their directions; w: from the start of the second to that of the first; u is the longer. Let f be the part of
/// v normal to u. The crossing is at (w − v t)·f = 0: t is off by a rounding over |f|, but v·f t only by a rounding.
fn where_crossed(u: DVec3, v: DVec3, w: DVec3) -> Option<f64> {
    let uu = u.length_squared();
    if uu == 0.0 {
        return None;
    }
    let once = v - u * (u.dot(v) / uu);
    let across = once - u * (u.dot(once) / uu);
    let squared = across.length_squared();
    let t = w.dot(across);
    (t > 0.0 && t < squared).then(|| t / squared)
}

/// The part of v normal to the unit vector `along`, to within a rounding of |v| even if it is small.
pub(crate) fn normal_part(v: DVec3, along: DVec3) -> DVec3 {
    let once = v - along * along.dot(v);
    once - along * along.dot(once)
}

/// A triangle with quantities that are needed several times.
struct Facet {
    corners: [DVec3; 3],
    /// The vectors from each corner to the next.
    sides: [DVec3; 3],
    normal: DVec3,
    /// The squared length of the normal.
    squared: f64,
    /// Whether the triangle is so thin that its normal is lost to rounding.
    is_sliver: bool,
}

impl Facet {
    fn new(corners: &[DVec3; 3]) -> Self {
        let [p, q, r] = *corners;
        let sides = [q - p, r - q, p - r];
        let normal = sides[0].cross(-sides[2]);
        let squared = normal.length_squared();
        let [x, y, z] = sides.map(DVec3::length_squared);
        let longest = x.max(y).max(z);
        Self {
            corners: *corners,
            sides,
            normal,
            squared,
            is_sliver: squared <= NEARLY_PARALLEL * longest * longest,
        }
    }

    fn edges(&self) -> [[DVec3; 2]; 3] {
        let [p, q, r] = self.corners;
        [[p, q], [q, r], [r, p]]
    }

    /// The foot of `point` on the plane, if it is inside the triangle; for a sliver, the nearest point of the section
    /// through the foot parallel to the longest edge.
    fn foot_inside(&self, point: DVec3) -> Option<DVec3> {
        if self.is_sliver {
            return self.foot_in_sliver(point);
        }
        let height = self.normal.dot(point - self.corners[0]) / self.squared;
        let foot = point - self.normal * height;
        let is_inside =
            |i: usize| self.sides[i].cross(foot - self.corners[i]).dot(self.normal) >= 0.0;
        (is_inside(0) && is_inside(1) && is_inside(2)).then_some(foot)
    }

    /// The lowest of three corners that all lie on one side of the plane, if it is above the facet, and its foot. Then
    /// no points are closer, because the gap along the normal equals their distance.
    fn facing(&self, corners: &[DVec3; 3]) -> Option<Points> {
        if self.is_sliver {
            return None;
        }
        let heights = corners.map(|p| self.normal.dot(p - self.corners[0]));
        let [x, y, z] = heights;
        let (low, high) = (x.min(y).min(z), x.max(y).max(z));
        let least = if low > 0.0 {
            low
        } else if high < 0.0 {
            high
        } else {
            return None;
        };
        let mut lowest = (0..3).filter(|&i| heights[i] == least).map(|i| corners[i]);
        lowest.find_map(|corner| Some(Points::between(corner, self.foot_inside(corner)?)))
    }

    /// A point of a sliver: the distance of the foot from the longest edge is uncertain, but along the edge the point
    /// is the nearest.
    fn foot_in_sliver(&self, point: DVec3) -> Option<DVec3> {
        self.section(point).map(|section| on_segment(point, section))
    }

    /// The index of the longest edge, and the part of the next edge normal to it.
    fn long_edge(&self) -> (usize, DVec3) {
        let length = |i: usize| self.sides[i].length_squared();
        let longest = (1..3).fold(0, |i, j| if length(j) > length(i) { j } else { i });
        let along = self.sides[longest].try_normalize().unwrap_or(DVec3::ZERO);
        let height = normal_part(-self.sides[(longest + 2) % 3], along);
        (longest, height)
    }

    /// The normal; for a sliver, the one that is normal to the longest edge to within rounding. Its length is
    /// arbitrary.
    fn normal_to_long_edge(&self) -> DVec3 {
        if !self.is_sliver {
            return self.normal;
        }
        let (longest, height) = self.long_edge();
        self.sides[longest].cross(height)
    }

    /// The section parallel to the longest edge at the distance of the foot of `point`.
    fn section(&self, point: DVec3) -> Option<[DVec3; 2]> {
        let (longest, height) = self.long_edge();
        let [from, to, apex] = [0, 1, 2].map(|k| self.corners[(longest + k) % 3]);
        let squared = height.length_squared();
        if squared == 0.0 {
            return None;
        }
        let share = share((point - from).dot(height), squared);
        Some([from, to].map(|end| end + (apex - end) * share))
    }

    /// The point at which the segment crosses the triangle; for a sliver, a point of each.
    fn crossing(&self, [from, to]: [DVec3; 2]) -> Option<Points> {
        let normal = self.normal_to_long_edge();
        let height = |end: DVec3| normal.dot(end - self.corners[0]);
        let (s, t) = (height(from), height(to));
        if s == 0.0 || t == 0.0 || (s > 0.0) == (t > 0.0) {
            return None;
        }
        let point = from.lerp(to, s / (s - t));
        if !self.is_sliver {
            return self.foot_inside(point).map(|_| Points::between(point, point));
        }
        let met = of_segments([from, to], self.section(point)?);
        let far = from.distance(self.corners[0]) + to.distance(self.corners[0]);
        let is_met = met.squared <= (8.0 * f64::EPSILON * far).powi(2);
        Some(if is_met { Points::between(met.on_a, met.on_a) } else { met })
    }
}

/// The point itself and the point of a triangle closest to it; a triangle without area is treated as its edges.
pub(crate) fn point_triangle(point: DVec3, triangle: &[DVec3; 3]) -> Closest {
    let facet = Facet::new(triangle);
    let foot = facet.foot_inside(point).into_iter();
    let on_rim = facet.edges().into_iter().map(|edge| on_segment(point, edge));
    let nearest = foot.chain(on_rim).min_by(|p, q| {
        let squared = |r: &DVec3| point.distance_squared(*r);
        squared(p).total_cmp(&squared(q))
    });
    Points::between(point, nearest.unwrap_or(triangle[0])).into()
}

/// The closest points of two triangles.
///
/// The minimum over the six corners above the other facet and the nine pairs of edges; 0 if an edge crosses a facet.
/// Triangles without area are treated as their edges. The distance is that of the points returned, for slivers too; if
/// features tie to within rounding, the points are those of any of them.
pub fn triangle_triangle(a: &[DVec3; 3], b: &[DVec3; 3]) -> Closest {
    let (a, b) = (Facet::new(a), Facet::new(b));
    if let Some(points) = a.facing(&b.corners) {
        return points.flipped().into();
    }
    if let Some(points) = b.facing(&a.corners) {
        return points.into();
    }
    let mut closest = Points::between(a.corners[0], b.corners[0]);
    for edge_a in a.edges() {
        for edge_b in b.edges() {
            closest.keep_nearer(of_segments(edge_a, edge_b));
        }
    }
    for (one, other, is_flipped) in [(&a, &b, false), (&b, &a, true)] {
        let directed = |found: Points| if is_flipped { found.flipped() } else { found };
        for corner in one.corners {
            if let Some(foot) = other.foot_inside(corner) {
                closest.keep_nearer(directed(Points::between(corner, foot)));
            }
        }
        for edge in one.edges() {
            if let Some(meeting) = other.crossing(edge) {
                closest.keep_nearer(directed(meeting));
            }
        }
    }
    closest.into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use foldmotion_random::Random;

    fn sampled(a: &[DVec3; 3], b: &[DVec3; 3], n: i32) -> f64 {
        let points = |t: &[DVec3; 3]| {
            let t = *t;
            (0..=n)
                .flat_map(move |i| (0..=n - i).map(move |j| (i, j)))
                .map(move |(i, j)| {
                    let (u, v) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(n));
                    t[0] + (t[1] - t[0]) * u + (t[2] - t[0]) * v
                })
                .collect::<Vec<_>>()
        };
        let (pa, pb) = (points(a), points(b));
        pa.iter()
            .flat_map(|&p| pb.iter().map(move |&q| p.distance(q)))
            .fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn the_distance_of_triangles_agrees_with_dense_sampling_from_above() {
        let mut random = Random::new(3);
        for case in 0..60 {
            let a = random.triangle(1.0);
            let mut b = random.triangle(1.0);
            if case % 3 == 0 {
                b = b.map(|p| p + DVec3::Z * 1.5);
            }
            if case % 5 == 0 {
                b = b.map(|p| DVec3::new(p.x, p.y, a[0].z)); // coplanar corner
            }
            let n = 24;
            let closest = triangle_triangle(&a, &b);
            let dense = sampled(&a, &b, n);
            assert!(closest.distance <= dense + 1e-14, "{case}: {} > {dense}", closest.distance);
            // The samples lie within 2 · (longest edge) / n of every point.
            assert!(closest.distance >= dense - 4.0 * 3.5 / f64::from(n), "{case}");
            assert!(closest.on_a.distance(closest.on_b) <= closest.distance + 1e-15);
        }
    }

    #[test]
    fn the_closest_points_lie_on_their_triangles() {
        let mut random = Random::new(4);
        for _ in 0..200 {
            let (a, b) = (random.triangle(1.0), random.triangle(1.0));
            let closest = triangle_triangle(&a, &b);
            for (triangle, point) in [(&a, closest.on_a), (&b, closest.on_b)] {
                let degenerate = [point, point, point];
                assert!(triangle_triangle(triangle, &degenerate).distance < 1e-12);
            }
        }
    }

    #[test]
    fn a_point_is_as_far_from_a_triangle_as_a_triangle_shrunk_to_it() {
        let mut random = Random::new(5);
        for case in 0..400 {
            let mut triangle = random.triangle(1.0);
            if case % 4 == 0 {
                triangle[2] = triangle[0].midpoint(triangle[1]) + random.vector() * 1e-9;
            }
            let point = random.vector() * 1.5;
            let found = point_triangle(point, &triangle);
            let expected = triangle_triangle(&[point; 3], &triangle).distance;
            assert!((found.distance - expected).abs() < 1e-13, "{case}");
            assert_eq!(found.on_a, point);
        }
    }

    #[test]
    fn known_distances_hold() {
        let a = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let above = a.map(|p| p * 0.25 + DVec3::new(0.1, 0.1, 0.7));
        assert!((triangle_triangle(&a, &above).distance - 0.7).abs() < 1e-15);
        let through =
            [DVec3::new(0.2, 0.2, -1.0), DVec3::new(0.2, 0.2, 1.0), DVec3::new(5.0, 5.0, 0.0)];
        assert_eq!(triangle_triangle(&a, &through).distance, 0.0);
        let inside = a.map(|p| p * 0.2 + DVec3::new(0.1, 0.1, 0.0));
        assert_eq!(triangle_triangle(&a, &inside).distance, 0.0);
        let parallel = segment_segment([DVec3::ZERO, DVec3::X], [DVec3::Y, DVec3::Y + DVec3::X]);
        assert_eq!(parallel.distance, 1.0);
        let point = segment_segment([DVec3::Z; 2], [DVec3::ZERO; 2]);
        assert_eq!(point.distance, 1.0);
    }
}
