//! Convex polygons in the plane.

use glam::DVec2;

/// A convex polygon, counter-clockwise, with its bounding box.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Convex {
    pub(super) corners: Vec<DVec2>,
    pub(super) low: DVec2,
    pub(super) high: DVec2,
}

impl Convex {
    pub(super) fn new(corners: Vec<DVec2>) -> Self {
        let bound = |merge: fn(DVec2, DVec2) -> DVec2| corners.iter().copied().reduce(merge);
        let [low, high] = [bound(DVec2::min), bound(DVec2::max)].map(Option::unwrap_or_default);
        Self { corners, low, high }
    }

    /// Whether it has any area.
    pub(super) fn is_empty(&self) -> bool {
        self.corners.len() < 3
    }

    /// The mean of the corners, a point inside.
    pub(super) fn middle(&self) -> DVec2 {
        self.corners.iter().sum::<DVec2>() / self.corners.len().max(1) as f64
    }

    /// Each side, from its start to its end.
    fn sides(&self) -> impl Iterator<Item = [DVec2; 2]> + '_ {
        let count = self.corners.len();
        (0..count).map(move |i| [self.corners[i], self.corners[(i + 1) % count]])
    }

    /// The extent along a direction.
    pub(super) fn span(&self, direction: DVec2) -> [f64; 2] {
        let heights = self.corners.iter().map(|p| p.dot(direction));
        heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], h| [low.min(h), high.max(h)])
    }

    /// Whether the two overlap by more than `width` in every direction.
    ///
    /// It is enough to look along the normals of the sides: they are those of the difference of the two.
    pub(super) fn overlaps(&self, other: &Self, width: f64) -> bool {
        let is_near =
            self.low.cmplt(other.high - width).all() && other.low.cmplt(self.high - width).all();
        is_near
            && self.sides().chain(other.sides()).all(|[p, q]| {
                let Some(normal) = (q - p).perp().try_normalize() else {
                    return true;
                };
                let ([a, b], [c, d]) = (self.span(normal), other.span(normal));
                b.min(d) - a.max(c) > width
            })
    }

    /// The common part of the two, cut side by side (Sutherland and Hodgman 1974).
    pub(super) fn common(&self, other: &Self) -> Self {
        let mut corners = self.corners.clone();
        for [from, to] in other.sides() {
            corners = left_of(&corners, from, to);
        }
        Self::new(corners)
    }

    /// The part of the line from `start` along the unit vector `along` that runs inside, as distances from `start`;
    /// `None` unless the polygon reaches farther than `width` to both sides of the line.
    pub(super) fn chord(&self, start: DVec2, along: DVec2, width: f64) -> Option<[f64; 2]> {
        let heights: Vec<f64> = self.corners.iter().map(|&p| along.perp_dot(p - start)).collect();
        let [low, high] = self.span(along.perp()).map(|h| h - start.dot(along.perp()));
        if low > -width || high < width {
            return None;
        }
        let mut reach = [f64::INFINITY, f64::NEG_INFINITY];
        for (i, &p) in self.corners.iter().enumerate() {
            let j = (i + 1) % self.corners.len();
            let (h, k) = (heights[i], heights[j]);
            if (h < 0.0) != (k < 0.0) {
                let at = p.lerp(self.corners[j], h / (h - k)) - start;
                let at = at.dot(along);
                reach = [reach[0].min(at), reach[1].max(at)];
            }
        }
        Some(reach)
    }
}

/// The part of a convex polygon to the left of the line from `from` to `to`.
fn left_of(polygon: &[DVec2], from: DVec2, to: DVec2) -> Vec<DVec2> {
    let height = |p: DVec2| (to - from).perp_dot(p - from);
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, &p) in polygon.iter().enumerate() {
        let q = polygon[(i + 1) % polygon.len()];
        let (h, k) = (height(p), height(q));
        if h >= 0.0 {
            kept.push(p);
        }
        if (h > 0.0 && k < 0.0) || (h < 0.0 && k > 0.0) {
            kept.push(p.lerp(q, h / (h - k)));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(at: [f64; 2]) -> Convex {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        Convex::new(corners.map(|c| DVec2::from(c) + DVec2::from(at)).to_vec())
    }

    #[test]
    fn squares_overlap_by_the_smaller_of_the_two_shifts() {
        let overlap = |shift, width| square([0.0; 2]).overlaps(&square(shift), width);
        assert!(overlap([0.5, 0.75], 0.249) && !overlap([0.5, 0.75], 0.251));
        assert!(!overlap([1.0, 0.0], 1e-12) && !overlap([3.0, 0.0], 0.0));
    }

    #[test]
    fn the_common_part_of_two_shifted_squares_is_a_rectangle() {
        let common = square([0.0; 2]).common(&square([0.5, 0.75]));
        assert_eq!([common.low, common.high], [DVec2::new(0.5, 0.75), DVec2::ONE]);
        assert!(square([0.0; 2]).common(&square([2.0, 0.0])).is_empty());
    }

    #[test]
    fn a_line_along_a_side_has_no_chord_and_one_across_has_its_length() {
        let chord = |y| square([0.0; 2]).chord(DVec2::new(-2.0, y), DVec2::X, 1e-9);
        assert_eq!(chord(0.0), None);
        assert_eq!(chord(1.0), None);
        let [from, to] = chord(0.5).unwrap();
        assert!((from - 2.0).abs() < 1e-12 && (to - 3.0).abs() < 1e-12);
    }
}
