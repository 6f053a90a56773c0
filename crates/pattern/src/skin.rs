//! What a compact sheet touches its two skin planes with.
//!
//! In the compact state the boundary vertices lie on the upper plane z = 0 and the mid vertices on the lower plane z =
//! −a. Case S meets the upper plane with whole facets and the lower one with edges and vertices only; case SII meets
//! both with facets, to which a skin can be bonded (section 3 of the paper, figures 4h and 5f).

use std::collections::BTreeSet;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::{Case, CreaseKind, Folding, UnitSheet};

/// The features that lie on one skin plane.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SkinPlane {
    /// Facets that lie in the plane.
    pub facets: usize,
    /// Creases and borders that lie in the plane beside those facets: lines of contact.
    pub edges: usize,
    /// Vertices in the plane beside those facets and edges: points of contact.
    pub vertices: usize,
    /// The area of the facets, projected onto the plane.
    pub area: f64,
    /// That area over the plane's rectangle, x·y of the compact box; 0 where the box is flat.
    pub share: f64,
}

/// Both skin planes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Skin {
    /// z = 0.
    pub upper: SkinPlane,
    /// z = −a.
    pub lower: SkinPlane,
}

impl UnitSheet {
    /// What `positions`, a compact state, touches the planes z = 0 and z = −a with; a feature touches where all its
    /// vertices are within `tolerance`.
    ///
    /// Preconditions: one position for each vertex, in the position of [`Self::compact`], and `tolerance` < a/2. `None`
    /// for the unmodified rectangle and a map, whose compact states have no such planes.
    pub fn skin(&self, positions: &[DVec3], tolerance: f64) -> Option<Skin> {
        if self.folding == Folding::Map {
            return None;
        }
        let extents = self.closed_form()?.extents;
        let plane = |z: f64| self.skin_plane(positions, z, tolerance, extents[0] * extents[1]);
        Some(Skin { upper: plane(0.0), lower: plane(-self.unit.flap) })
    }

    /// The areas on the upper and the lower plane in closed form: the top pads of U^O rows are the side pads, those of
    /// U^E rows the centre pads, h long; the bottom pads are the others, h − 2a long. With Σ over the rows of a kind,
    ///
    /// upper = Nc·(2s·Σ_O h + 2d·Σ_E h),  lower = Nc·(2d·Σ_O (h − 2a) + 2s·Σ_E (h − 2a)).
    ///
    /// `None` for the unmodified rectangle and for a map.
    pub fn skin_areas(&self) -> Option<[f64; 2]> {
        if self.unit.case == Case::Plain || self.folding == Folding::Map {
            return None;
        }
        let (side, centre) = (2.0 * self.unit.side_pad, self.unit.centre_pad);
        let mut areas = [0.0; 2];
        for row in 0..self.rows {
            let height = self.row_height(row);
            let (top, bottom) = if row % 2 == 0 { (side, centre) } else { (centre, side) };
            areas[0] += top * height;
            if self.row_units[row].split {
                areas[1] += bottom * (height - 2.0 * self.unit.flap);
            }
        }
        Some(areas.map(|area| area * self.columns as f64))
    }

    fn skin_plane(&self, positions: &[DVec3], z: f64, tolerance: f64, rectangle: f64) -> SkinPlane {
        let sheet = &self.sheet;
        let is_on = |v: &u32| (positions[*v as usize].z - z).abs() <= tolerance;
        let on_plane: Vec<bool> =
            sheet.facets.iter().map(|facet| facet.polygon.iter().all(is_on)).collect();
        let is_flat = |face: &Option<u32>| {
            face.is_some_and(|face| on_plane[sheet.face_facets[face as usize] as usize])
        };
        let area = sheet
            .faces
            .iter()
            .zip(&sheet.face_facets)
            .filter(|&(_, &facet)| on_plane[facet as usize])
            .map(|(face, _)| {
                let [a, b, c] = face.map(|v| positions[v as usize].truncate());
                (b - a).perp_dot(c - a).abs() / 2.0
            })
            .sum::<f64>();
        let lines: Vec<[u32; 2]> = sheet
            .edges
            .iter()
            .filter(|e| e.kind != CreaseKind::Facet && !e.faces.iter().any(is_flat))
            .map(|e| e.vertices)
            .filter(|ends| ends.iter().all(is_on))
            .collect();
        let in_facets = sheet.facets.iter().zip(&on_plane).filter(|(_, on)| **on);
        let covered: BTreeSet<u32> = in_facets
            .flat_map(|(facet, _)| facet.polygon.iter().copied())
            .chain(lines.iter().flatten().copied())
            .collect();
        let all = (0..self.pattern_vertices() as u32).filter(is_on).count();
        SkinPlane {
            facets: on_plane.iter().filter(|&&on| on).count(),
            edges: lines.len(),
            vertices: all - covered.len(),
            area,
            share: if rectangle > 0.0 { area / rectangle } else { 0.0 },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Unit;

    fn sheet(case: Case, width: f64, lambda: Option<f64>, offset: Option<f64>) -> UnitSheet {
        let h = 1.3;
        let unit = Unit::new(case, width * h, h, lambda, offset).unwrap();
        UnitSheet::new(unit, 5, 3).unwrap()
    }

    fn exact(sheet: &UnitSheet) -> Skin {
        sheet.skin(&sheet.compact(), 1e-12).unwrap()
    }

    #[test]
    fn the_area_on_either_plane_is_its_closed_form() {
        for sheet in [
            sheet(Case::E, 1.0, None, None),
            sheet(Case::T, 0.6, None, None),
            sheet(Case::S, 1.6, None, None),
            sheet(Case::SII, 1.6, Some(0.7), None),
            sheet(Case::SII, 2.5, Some(0.3), Some(0.0)),
            sheet(Case::SII, 2.5, Some(0.3), Some(0.2)),
        ] {
            let skin = exact(&sheet);
            let closed = sheet.skin_areas().unwrap();
            for (found, expected) in [skin.upper.area, skin.lower.area].into_iter().zip(closed) {
                assert!(
                    (found - expected).abs() < 1e-12,
                    "{:?}: {found} != {expected}",
                    sheet.unit
                );
            }
        }
    }

    #[test]
    fn s_lies_on_the_upper_plane_with_facets_and_on_the_lower_one_with_ridges_and_points() {
        let skin = exact(&sheet(Case::S, 1.6, None, None));
        // Three even rows of 2 border pads and 2 double ones; two odd rows with as many ridges.
        assert_eq!((skin.upper.facets, skin.lower.facets), (3 * 4, 0));
        assert_eq!(skin.lower.edges, 2 * 4);
        // The mid vertices of even rows, one for each column, are separate.
        assert_eq!(skin.lower.vertices, 3 * 3);
        assert_eq!(skin.lower.area, 0.0);
        assert!(skin.upper.share > 0.0 && skin.lower.share == 0.0);
    }

    #[test]
    fn sii_lies_on_both_planes_with_facets() {
        let skin = exact(&sheet(Case::SII, 1.6, Some(0.7), None));
        // Top pads: P strips (4) in even rows, Q strips (3) in odd ones; bottom pads the other way round.
        assert_eq!((skin.upper.facets, skin.lower.facets), (3 * 4 + 2 * 3, 3 * 3 + 2 * 4));
        assert!(skin.upper.area > 0.0 && skin.lower.area > 0.0);
        assert!(skin.upper.share < 1.0 && skin.lower.share < skin.upper.share);
    }

    #[test]
    fn a_vertex_lifted_off_the_plane_takes_its_facets_with_it() {
        let sheet = sheet(Case::SII, 1.6, Some(0.7), None);
        let mut positions = sheet.compact();
        let pad = sheet.sheet.facets.iter().find(|f| f.kind == crate::FacetKind::TopPad).unwrap();
        positions[pad.polygon[0] as usize].z += 0.01;
        let lifted = sheet.skin(&positions, 1e-3).unwrap();
        assert!(lifted.upper.area < exact(&sheet).upper.area - 1e-3);
    }

    #[test]
    fn the_unmodified_rectangle_has_no_skin_planes() {
        let sheet = sheet(Case::Plain, 1.6, None, None);
        assert_eq!(sheet.skin(&sheet.compact(), 1e-9), None);
        assert_eq!(sheet.skin_areas(), None);
    }
}
