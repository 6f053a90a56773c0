//! Polygons of the screen, added and subtracted.
//!
//! All are rounded to one grid of integers, about a 2⁻²⁶th of the picture wide, on which the operations are exact:
//! neighbours stay neighbours and no input fails (`i_overlay`; snap rounding).

use glam::DVec2;
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay::ShapeType;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::overlay::FloatOverlay;
use i_overlay::i_float::adapter::FloatPointAdapter;
use i_overlay::i_float::float::rect::FloatRect;

/// Points closer than this are one, in pixels.
const SAME_POINT: f64 = 1e-7;

/// Closed rings; nothing is filled twice and rings of holes run in the opposite direction.
pub(crate) type Rings = Vec<Vec<DVec2>>;

/// The part of the screen in which polygons are added and subtracted.
pub(crate) struct Plane {
    grid: FloatPointAdapter<[f64; 2], i32>,
}

impl Plane {
    /// The plane that holds all `points`; `None` if they are not finite.
    pub(crate) fn new(points: impl Iterator<Item = DVec2>) -> Option<Self> {
        let (mut low, mut high) = (DVec2::ZERO, DVec2::ZERO);
        for (k, point) in points.enumerate() {
            low = if k == 0 { point } else { low.min(point) };
            high = if k == 0 { point } else { high.max(point) };
        }
        let rect = FloatRect::new(low.x, high.x, low.y, high.y).ok()?;
        let grid = FloatPointAdapter::new_conservative(rect);
        Some(Self { grid })
    }

    /// The union of `parts`, which all run in the same direction.
    pub(crate) fn union(&self, parts: &[Vec<DVec2>]) -> Rings {
        let corners = parts.iter().map(Vec::len).sum();
        let mut overlay = FloatOverlay::with_adapter(self.grid.clone(), corners);
        let mut ring = Vec::new();
        for points in parts {
            ring.clear();
            ring.extend(points.iter().map(DVec2::to_array));
            overlay = overlay.unsafe_add_contour(&ring, ShapeType::Subject);
        }
        let shapes = overlay.overlay(OverlayRule::Subject, FillRule::NonZero);
        let shapes = shapes.into_iter();
        let rings = shapes.flatten();
        rings.map(|ring| ring.into_iter().map(DVec2::from).collect()).collect()
    }
}

/// Twice the signed area inside `ring`.
pub(crate) fn doubled_area(ring: &[DVec2]) -> f64 {
    let Some(&first) = ring.first() else {
        return 0.0;
    };
    let pairs = ring.windows(2);
    pairs.map(|pair| (pair[0] - first).perp_dot(pair[1] - first)).sum()
}

/// The length of the closed `ring`.
pub(crate) fn perimeter(ring: &[DVec2]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(a, b)| a.distance(*b)).sum()
}

/// Keeps of the convex polygon `ring` where `value`, which is linear, is not negative (Sutherland and Hodgman 1974).
pub(super) fn cut(ring: &mut Vec<DVec2>, value: impl Fn(DVec2) -> f64) {
    let values: Vec<f64> = ring.iter().map(|&p| value(p)).collect();
    if values.iter().all(|&v| v >= 0.0) {
        return;
    }
    let mut kept = Vec::with_capacity(ring.len() + 1);
    for (i, &p) in ring.iter().enumerate() {
        let j = (i + 1) % ring.len();
        let [v, w] = [values[i], values[j]];
        if v >= 0.0 {
            kept.push(p);
        }
        if (v >= 0.0) != (w >= 0.0) {
            // From the same end in either direction, so that neighbours get the same point.
            kept.push(if v >= 0.0 {
                p + (ring[j] - p) * (v / (v - w))
            } else {
                ring[j] + (p - ring[j]) * (w / (w - v))
            });
        }
    }
    *ring = kept;
}

/// Drops corners that coincide with the one before: an edge of no length has no side.
pub(super) fn tidy(ring: &mut Vec<DVec2>) {
    ring.dedup_by(|b, a| a.distance(*b) < SAME_POINT);
    while ring.len() > 1 && ring[0].distance(ring[ring.len() - 1]) < SAME_POINT {
        ring.pop();
    }
}

/// The parts of the convex polygon `piece` outside the convex polygon `hole`, both along growing angles, the hole tidy:
/// convex, and without those that are not larger than `least` in doubled area.
pub(super) fn outside(piece: Vec<DVec2>, hole: &[DVec2], least: f64, parts: &mut Rings) {
    let side = |k: usize| {
        let (a, b) = (hole[k], hole[(k + 1) % hole.len()]);
        let normal = (b - a).normalize_or_zero().perp();
        move |p: DVec2| normal.dot(p - a)
    };
    let is_apart = |k: usize| piece.iter().all(|&p| side(k)(p) <= 0.0);
    if (0..hole.len()).any(is_apart) {
        parts.push(piece);
        return;
    }
    let mut rest = piece;
    for k in 0..hole.len() {
        let inside = side(k);
        let mut part = rest.clone();
        cut(&mut part, |p| -inside(p));
        if doubled_area(&part) > least {
            parts.push(part);
        }
        cut(&mut rest, inside);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(low: f64, high: f64) -> Vec<DVec2> {
        [(low, low), (high, low), (high, high), (low, high)].map(DVec2::from).to_vec()
    }

    fn area(rings: &[Vec<DVec2>]) -> f64 {
        0.5 * rings.iter().map(|ring| doubled_area(ring)).sum::<f64>()
    }

    #[test]
    fn a_hole_is_cut_out_and_filled_again() {
        let plane = Plane::new(square(0.0, 10.0).into_iter()).unwrap();
        let (all, inner) = (square(0.0, 10.0), square(2.0, 4.0));
        let mut parts = Vec::new();
        outside(all.clone(), &inner, 0.0, &mut parts);
        assert_eq!(parts.len(), 4);
        assert!((area(&parts) - 96.0).abs() < 1e-12);
        let holed = plane.union(&parts);
        assert_eq!(holed.len(), 2, "{holed:?}");
        assert!((area(&holed).abs() - 96.0).abs() < 1e-4);
        parts.push(inner.clone());
        let whole = plane.union(&parts);
        assert_eq!(whole.len(), 1);
        assert!((area(&whole).abs() - 100.0).abs() < 1e-4, "{whole:?}");
        for (piece, hole, left) in [(&all, square(10.0, 12.0), 1), (&inner, all.clone(), 0)] {
            let mut parts = Vec::new();
            outside(piece.clone(), &hole, 0.0, &mut parts);
            assert_eq!(parts.len(), left, "beside and within");
        }
    }

    #[test]
    fn corners_that_coincide_do_not_hide_what_a_hole_cuts_out() {
        let mut hole = square(2.0, 4.0);
        hole.insert(1, hole[0]);
        hole.push(hole[0] + 1e-12);
        tidy(&mut hole);
        assert_eq!(hole, square(2.0, 4.0));
        let mut parts = Vec::new();
        outside(square(0.0, 10.0), &hole, 0.0, &mut parts);
        assert!((area(&parts) - 96.0).abs() < 1e-12);
    }

    #[test]
    fn points_that_are_not_finite_have_no_plane() {
        assert!(Plane::new([DVec2::NAN].into_iter()).is_none());
        assert!(Plane::new([DVec2::ZERO, DVec2::INFINITY].into_iter()).is_none());
        assert!(Plane::new(std::iter::empty()).is_some());
    }

    #[test]
    fn a_line_cuts_a_square_in_the_ratio_of_its_place() {
        let mut ring = square(0.0, 1.0);
        cut(&mut ring, |p| 0.25 - p.x);
        assert!((0.5 * doubled_area(&ring) - 0.25).abs() < 1e-15);
        cut(&mut ring, |p| p.x - 0.5);
        assert!(ring.is_empty());
    }
}
