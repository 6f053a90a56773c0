//! On which side of a line a point lies, exactly.
//!
//! Source: Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast robust geometric predicates".

use glam::DVec2;
use robust::{Coord, orient2d};

/// The sign of twice the area of the triangle a, b, c: positive where it turns left. The sign is exact.
pub(super) fn side(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let [a, b, c] = [a, b, c].map(|p| Coord { x: p.x, y: p.y });
    orient2d(a, b, c)
}

/// Whether two segments cross at a point inside both.
pub(super) fn cross([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    // Four comparisons settle the case of boxes that lie apart.
    let apart = a.max(b).cmplt(c.min(d)).any() || c.max(d).cmplt(a.min(b)).any();
    let opposite = |s: f64, t: f64| (s > 0.0 && t < 0.0) || (s < 0.0 && t > 0.0);
    !apart && opposite(side(a, b, c), side(a, b, d)) && opposite(side(c, d, a), side(c, d, b))
}

/// How far a point lies from a segment, and where along it the nearest point is, 0 at the first end and 1 at the other.
pub(super) fn from_segment([a, b]: [DVec2; 2], p: DVec2) -> (f64, f64) {
    let along = b - a;
    let share = ((p - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    (p.distance(a + along * share), share)
}
