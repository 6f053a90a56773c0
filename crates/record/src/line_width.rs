//! Lines as wide as facets allow.

use foldmotion_pattern::Sheet;
use glam::{DVec2, DVec3};

use crate::Camera;

/// The widest line as a part of the height of facets: much more of it would be ink than paper.
const PART: f64 = 0.12;

/// The narrowest line as a part of the widest one requested: narrower ones are not seen.
const LEAST: f64 = 0.25;

/// The width of lines over `sheet` with its vertices at `positions`, seen by `camera`, in pixels: `widest`, or less
/// where facets are so small or so slanted that lines would cover them.
///
/// The height of facets is the mean height of the projected triangles over their longest edges, weighted by their
/// areas, because that is what is seen of them. It changes as smoothly as the sheet moves.
///
/// Precondition: one position for each vertex.
pub fn line_width(sheet: &Sheet, positions: &[DVec3], camera: &Camera, widest: f64) -> f64 {
    let points: Vec<DVec2> = (positions.iter()).map(|&p| camera.project(p).truncate()).collect();
    let (mut area, mut moment) = (0.0, 0.0);
    for face in &sheet.faces {
        let [a, b, c] = face.map(|v| points[v as usize]);
        let doubled = (b - a).perp_dot(c - a).abs();
        let longest = [b - a, c - b, a - c].map(DVec2::length);
        let longest = longest.into_iter().fold(0.0, f64::max);
        if longest > 0.0 {
            area += doubled;
            moment += doubled * doubled / longest;
        }
    }
    if area > 0.0 { (PART * moment / area).clamp(LEAST * widest, widest) } else { widest }
}

#[cfg(test)]
mod tests {
    use foldmotion_pattern::{Case, Unit, UnitSheet};

    use super::*;
    use crate::View;

    #[test]
    fn lines_narrow_with_the_facets_down_to_a_floor() {
        let unit = Unit::new(Case::E, 1.0, 1.0, None, None).unwrap();
        let sheet = UnitSheet::new(unit, 3, 2).unwrap().sheet;
        let flat = sheet.planar();
        let camera = Camera::fit(View::Top, [DVec3::ZERO, DVec3::X], [1, 1], 0.0).unwrap();
        assert_eq!(camera.scale(), 1.0);
        let width = |pixels: DVec2| {
            let stretch = pixels.extend(1.0);
            let positions: Vec<DVec3> = flat.iter().map(|&p| stretch * p).collect();
            line_width(&sheet, &positions, &camera, 2.0)
        };
        assert_eq!(width(DVec2::splat(200.0)), 2.0, "large facets");
        assert_eq!(width(DVec2::splat(1.0)), 0.5, "specks");
        assert_eq!(width(DVec2::ZERO), 2.0, "nothing to judge by");
        let (some, half) = (width(DVec2::splat(20.0)), width(DVec2::splat(10.0)));
        assert!(some < 2.0 && (half / some - 0.5).abs() < 1e-12, "{some} {half}");
        let slanted = width(DVec2::new(20.0, 8.0));
        assert!(slanted < some, "{slanted}");
    }
}
