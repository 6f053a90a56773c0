//! The closed form of a thick sheet: the exact compact state with the thickness of the layers that meet in it.

use foldmotion_pattern::CompactBox;
use glam::{DVec2, DVec3};

use super::BoxReport;
use crate::Study;

/// A facet is perpendicular to an axis, and two lie in one plane, to this share of the unit length.
const ROUNDING: f64 = 1e-6;

impl Study {
    /// The closed form of the compact state with, along each axis, the thickness times the layers that meet; `None`
    /// without `material.thickness`, without a closed form, and for a map, whose closed form has its thickness.
    ///
    /// Extents are those of the middle surfaces of the layers: m layers that lie on each other add (m − 1) thicknesses.
    pub(super) fn thick_closed_form(&self) -> Option<BoxReport> {
        let thickness = self.thickness?;
        let units = self.subject.units().filter(|study| study.units.map_layers().is_none())?;
        let closed_form: CompactBox = self.subject.closed_form()?;
        let sheet = &units.units.sheet;
        let met = layers_met(&units.units.compact(), &sheet.faces, sheet.unit_length);
        let extents: [f64; 3] =
            std::array::from_fn(|axis| closed_form.extents[axis] + thickness * met[axis] as f64);
        let [x, y, z] = extents;
        Some(BoxReport { extents, area: x * z, volume: x * y * z })
    }
}

/// Along each axis, how many facets lie directly on another one, at most, on a line parallel to the axis.
fn layers_met(positions: &[DVec3], faces: &[[u32; 3]], unit_length: f64) -> [usize; 3] {
    std::array::from_fn(|axis| {
        let flat: Vec<FlatFacet> = faces
            .iter()
            .filter_map(|face| {
                FlatFacet::new(face.map(|v| positions[v as usize]), axis, unit_length)
            })
            .collect();
        let met = |at: &FlatFacet| {
            let centre = (at.corners[0] + at.corners[1] + at.corners[2]) / 3.0;
            let over = flat.iter().filter(|facet| facet.covers(centre));
            let mut heights: Vec<f64> = over.map(|facet| facet.height).collect();
            let count = heights.len();
            heights.sort_by(f64::total_cmp);
            heights.dedup_by(|a, b| *a - *b <= ROUNDING * unit_length);
            count - heights.len()
        };
        flat.iter().map(met).max().unwrap_or(0)
    })
}

/// A triangle perpendicular to an axis, seen along it.
struct FlatFacet {
    corners: [DVec2; 3],
    height: f64,
}

impl FlatFacet {
    fn new(corners: [DVec3; 3], axis: usize, unit_length: f64) -> Option<Self> {
        let heights = corners.map(|p| p[axis]);
        let spread = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max)
            - heights.iter().copied().fold(f64::INFINITY, f64::min);
        let seen = corners.map(|p| DVec2::new(p[(axis + 1) % 3], p[(axis + 2) % 3]));
        (spread <= ROUNDING * unit_length).then_some(Self { corners: seen, height: heights[0] })
    }

    /// Whether `point` lies inside, by its three signed areas.
    fn covers(&self, point: DVec2) -> bool {
        let [a, b, c] = self.corners;
        let areas = [(a, b), (b, c), (c, a)].map(|(p, q)| (q - p).perp_dot(point - p));
        areas.iter().all(|&area| area > 0.0) || areas.iter().all(|&area| area < 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_are_counted_where_they_lie_on_each_other_and_only_there() {
        let v = DVec3::new;
        let triangle = |y: f64, x: f64| [v(x, y, 0.0), v(x + 1.0, y, 0.0), v(x, y, 1.0)];
        // Three on each other at y = 0, one above them at y = 2, two elsewhere.
        let stack = [(0.0, 0.0), (0.0, 0.1), (0.0, 0.05), (2.0, 0.0), (0.0, 5.0), (0.0, 5.1)];
        let positions: Vec<DVec3> = stack.iter().flat_map(|&(y, x)| triangle(y, x)).collect();
        let faces: Vec<[u32; 3]> = (0..6).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        assert_eq!(layers_met(&positions, &faces, 1.0), [0, 2, 0]);
    }
}
