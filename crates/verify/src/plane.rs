//! Convex polygons in a plane.

use glam::{DVec2, DVec3};

/// Sides of a difference of triangles that are shorter than this share of its size come from corners separated by
/// rounding.
const ROUNDING: f64 = 1e-10;

/// A coordinate system in the plane of a triangle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Plane {
    origin: DVec3,
    axes: [DVec3; 2],
    pub(crate) normal: DVec3,
}

impl Plane {
    /// The plane of a triangle seen from its front; `None` if the triangle has no area.
    pub(crate) fn of(triangle: &[DVec3; 3]) -> Option<Self> {
        let [p, q, r] = *triangle;
        let normal = (q - p).cross(r - p).try_normalize()?;
        let x = (q - p).try_normalize()?;
        Some(Self { origin: p, axes: [x, normal.cross(x)], normal })
    }

    pub(crate) fn height(&self, p: DVec3) -> f64 {
        self.normal.dot(p - self.origin)
    }

    /// The projection of a point along the normal.
    pub(crate) fn seen(&self, p: DVec3) -> DVec2 {
        let p = p - self.origin;
        let [x, y] = self.axes;
        DVec2::new(x.dot(p), y.dot(p))
    }

    /// The projection of a triangle along the normal, counter-clockwise.
    pub(crate) fn triangle(&self, corners: &[DVec3; 3]) -> [DVec2; 3] {
        let [p, q, r] = corners.map(|p| self.seen(p));
        if (q - p).perp_dot(r - p) < 0.0 { [p, r, q] } else { [p, q, r] }
    }
}

/// How far two counter-clockwise triangles overlap: the shortest push that separates them, or the smallest width of one
/// of them if that is less; at most 0 if they are apart.
///
/// The pushes that do not separate A and B are the differences { a − b }, a convex polygon spanned by those of the
/// corners; the shortest push that does is the distance of 0 from its boundary.
pub(crate) fn overlap(a: &[DVec2; 3], b: &[DVec2; 3]) -> f64 {
    let differences = a.iter().flat_map(|&p| b.iter().map(move |&q| p - q));
    let rim = hull(differences.collect());
    let size = rim.iter().map(|p| p.length()).fold(0.0, f64::max);
    let sides = (0..rim.len()).map(|i| (rim[i], rim[(i + 1) % rim.len()]));
    let inside = sides
        .filter(|(p, q)| p.distance(*q) > ROUNDING * size)
        .map(|(p, q)| (q - p).normalize().perp_dot(-p));
    let push = inside.fold(f64::INFINITY, f64::min);
    push.min(least_width(a)).min(least_width(b))
}

/// The convex hull, counter-clockwise from the leftmost point (Andrew 1979).
fn hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|p, q| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)));
    let mut rim = chain(points.iter());
    let upper = chain(points.iter().rev());
    rim.pop();
    rim.extend(&upper[..upper.len().saturating_sub(1)]);
    rim
}

/// The points of one half of the hull: those at which the chain turns left.
fn chain<'a>(points: impl Iterator<Item = &'a DVec2>) -> Vec<DVec2> {
    let mut kept: Vec<DVec2> = Vec::new();
    for &p in points {
        while let [.., u, v] = kept[..]
            && (v - u).perp_dot(p - v) <= 0.0
        {
            kept.pop();
        }
        kept.push(p);
    }
    kept
}

/// The smallest width of a counter-clockwise convex polygon, perpendicular to one of its sides; 0 if it has no area.
pub(crate) fn least_width(polygon: &[DVec2]) -> f64 {
    let sides = (0..polygon.len()).map(|i| (polygon[i], polygon[(i + 1) % polygon.len()]));
    let across = sides.filter_map(|(p, q)| {
        let along = (q - p).try_normalize()?;
        let heights = polygon.iter().map(|&r| along.perp_dot(r - p));
        Some(heights.fold(0.0, f64::max))
    });
    let least = across.fold(f64::INFINITY, f64::min);
    if least.is_finite() { least } else { 0.0 }
}

/// The part of a convex polygon inside a counter-clockwise triangle.
pub(crate) fn within(polygon: &[DVec2], triangle: &[DVec2; 3]) -> Vec<DVec2> {
    let mut left = polygon.to_vec();
    for i in 0..3 {
        let (from, side) = (triangle[i], triangle[(i + 1) % 3] - triangle[i]);
        let mut cut = Vec::with_capacity(left.len() + 1);
        let heights: Vec<f64> = left.iter().map(|&p| side.perp_dot(p - from)).collect();
        for (k, (&p, &h)) in left.iter().zip(&heights).enumerate() {
            let next = (k + 1) % left.len();
            if h >= 0.0 {
                cut.push(p);
            }
            if h * heights[next] < 0.0 {
                cut.push(p + (left[next] - p) * (h / (h - heights[next])));
            }
        }
        left = cut;
    }
    left
}

/// A counter-clockwise triangle with its sides moved inward: shrunk about the centre of its inscribed circle. A
/// triangle that is too small for that becomes a point.
pub(crate) fn inset(triangle: &[DVec2; 3], by: f64) -> [DVec2; 3] {
    let [p, q, r] = *triangle;
    let (a, b, c) = (q.distance(r), r.distance(p), p.distance(q));
    let around = a + b + c;
    let centre = (p * a + q * b + r * c) / around;
    let radius = (q - p).perp_dot(r - p) / around;
    let share = (1.0 - by / radius).max(0.0);
    triangle.map(|corner| centre + (corner - centre) * share)
}

/// Whether a point lies inside a counter-clockwise triangle, or outside by at most `beyond`.
pub(crate) fn holds(triangle: &[DVec2; 3], point: DVec2, beyond: f64) -> bool {
    (0..3).all(|i| {
        let side = triangle[(i + 1) % 3] - triangle[i];
        side.perp_dot(point - triangle[i]) >= -beyond * side.length()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use foldmotion_random::Random;

    fn triangle(random: &mut Random) -> [DVec2; 3] {
        let corners = [(); 3].map(|()| random.vector());
        let plane = Plane { origin: DVec3::ZERO, axes: [DVec3::X, DVec3::Y], normal: DVec3::Z };
        plane.triangle(&corners)
    }

    #[test]
    fn a_push_as_long_as_the_overlap_parts_the_triangles_in_some_direction_and_a_shorter_one_in_none()
     {
        let mut random = Random::new(21);
        let mut parted = 0;
        for _ in 0..300 {
            let (a, b) = (triangle(&mut random), triangle(&mut random));
            let depth = overlap(&a, &b);
            if depth < 0.05 || depth >= least_width(&a).min(least_width(&b)) {
                continue;
            }
            parted += 1;
            let area = |push: f64| {
                let turned = (0..720).map(|k| DVec2::from_angle(f64::from(k).to_radians() / 2.0));
                let areas = turned.map(|d| least_width(&within(&b.map(|p| p + d * push), &a)));
                areas.fold(f64::INFINITY, f64::min)
            };
            assert!(area(depth * 0.99) > 0.0, "{depth}");
            assert!(area(depth * 1.001) <= 1e-3, "{depth}");
        }
        assert!(parted > 50, "{parted}");
    }

    #[test]
    fn the_same_triangle_twice_overlaps_by_its_least_width_and_neighbours_by_nothing() {
        let a = [DVec2::ZERO, DVec2::X, DVec2::Y];
        assert!((overlap(&a, &a) - std::f64::consts::FRAC_1_SQRT_2).abs() < 1e-12);
        let beside = [DVec2::X, DVec2::ONE, DVec2::Y];
        assert!(overlap(&a, &beside).abs() < 1e-12);
        assert!(overlap(&a, &a.map(|p| p + DVec2::ONE)) < -0.1);
    }

    #[test]
    fn an_inset_triangle_lies_inside_by_the_inset() {
        let mut random = Random::new(22);
        for _ in 0..100 {
            let a = triangle(&mut random);
            let smaller = inset(&a, 1e-4);
            assert!(smaller.iter().all(|&p| holds(&a, p, -0.99e-4)) || least_width(&a) < 1e-3);
            assert!(!smaller.iter().all(|&p| holds(&a, p, -1.01e-4)));
        }
    }
}
