//! Axis-aligned boxes.

use glam::DVec3;

/// The points x with `min` ≤ x ≤ `max` in every coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aabb {
    /// The smallest coordinates of the box.
    pub min: DVec3,
    /// The largest coordinates of the box.
    pub max: DVec3,
}

impl Aabb {
    /// The box that contains no point: the neutral element of [`Aabb::union`].
    pub const EMPTY: Self = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    /// The smallest box that contains the points.
    pub fn around(points: impl IntoIterator<Item = DVec3>) -> Self {
        points
            .into_iter()
            .fold(Self::EMPTY, |hull, p| Self { min: hull.min.min(p), max: hull.max.max(p) })
    }

    /// The smallest box that contains both.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The box with every face moved outwards by `radius`, rounded outwards.
    #[must_use]
    pub fn inflated(&self, radius: f64) -> Self {
        let down = |x: f64| (x - radius).next_down();
        let up = |x: f64| (x + radius).next_up();
        Self {
            min: DVec3::new(down(self.min.x), down(self.min.y), down(self.min.z)),
            max: DVec3::new(up(self.max.x), up(self.max.y), up(self.max.z)),
        }
    }

    /// Whether the closed boxes share a point.
    pub fn overlaps(&self, other: &Self) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }

    /// The squared distance between the boxes; 0 if they share a point.
    pub fn distance_squared(&self, other: &Self) -> f64 {
        let gap = (self.min - other.max).max(other.min - self.max);
        gap.max(DVec3::ZERO).length_squared()
    }

    /// The length of the diagonal; not positive for the empty box.
    pub fn diagonal(&self) -> f64 {
        let extents = self.extents();
        if extents.min_element() < 0.0 { 0.0 } else { extents.length() }
    }

    /// The side lengths.
    pub fn extents(&self) -> DVec3 {
        self.max - self.min
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_overlap_where_their_distance_is_zero() {
        let unit = Aabb::around([DVec3::ZERO, DVec3::ONE]);
        let beside = Aabb::around([DVec3::new(1.0, 0.5, 0.5), DVec3::new(2.0, 2.0, 2.0)]);
        let away = Aabb::around([DVec3::new(4.0, 5.0, 0.0), DVec3::new(5.0, 6.0, 1.0)]);
        assert!(unit.overlaps(&beside));
        assert_eq!(unit.distance_squared(&beside), 0.0);
        assert!(!unit.overlaps(&away));
        assert_eq!(unit.distance_squared(&away), 25.0);
        assert!(!unit.overlaps(&Aabb::EMPTY));
    }

    #[test]
    fn inflating_never_loses_a_point_to_rounding() {
        let point = DVec3::new(0.1, -1e9, 3.0);
        let inflated = Aabb::around([point]).inflated(1e-9);
        assert!(inflated.min.cmplt(point).all() && inflated.max.cmpgt(point).all());
    }
}
