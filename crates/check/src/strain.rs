//! How much the sheet is stretched and how much its facets are bent.

use foldmotion_pattern::{Assignment, Sheet};
use glam::DVec3;
use serde::Serialize;

/// The bar strain |l / l₀ − 1|, over all edges.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BarStrain {
    /// The largest bar strain of any edge.
    pub peak: f64,
    /// The index of the edge with the largest strain.
    pub peak_edge: usize,
    /// The mean bar strain over all edges.
    pub mean: f64,
}

/// The bar strain of every edge relative to its length in the crease pattern; zeros for a sheet without edges.
///
/// `positions`: one for each vertex. Precondition: no edge of the crease pattern has length 0.
pub fn bar_strain(sheet: &Sheet, positions: &[DVec3]) -> BarStrain {
    let mut strain = BarStrain { peak: 0.0, peak_edge: 0, mean: 0.0 };
    for (index, edge) in sheet.edges.iter().enumerate() {
        let [i, j] = edge.vertices.map(|v| v as usize);
        let rest_length = sheet.vertices[i].distance(sheet.vertices[j]);
        let value = (positions[i].distance(positions[j]) / rest_length - 1.0).abs();
        strain.mean += value;
        if value > strain.peak {
            (strain.peak, strain.peak_edge) = (value, index);
        }
    }
    strain.mean /= sheet.edges.len().max(1) as f64;
    strain
}

/// How far quadrilaterals are bent along the diagonal that splits them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FacetBending {
    /// The largest |fold angle| of an edge inside a facet, in radians.
    pub peak_rad: f64,
    /// The index of the edge with the largest bend; `None` if no edge lies inside a facet.
    pub peak_edge: Option<usize>,
}

impl FacetBending {
    /// The largest bend, in degrees.
    pub fn peak_deg(&self) -> f64 {
        self.peak_rad.to_degrees()
    }
}

/// The largest bend of any facet. `positions`: one for each vertex.
pub fn facet_bending(sheet: &Sheet, positions: &[DVec3]) -> FacetBending {
    let angles = sheet.fold_angles(positions);
    let mut bending = FacetBending { peak_rad: 0.0, peak_edge: None };
    for (index, (edge, angle)) in sheet.edges.iter().zip(angles).enumerate() {
        let (Assignment::Facet, Some(angle)) = (edge.assignment, angle) else {
            continue;
        };
        if bending.peak_edge.is_none() || angle.abs() > bending.peak_rad {
            bending = FacetBending { peak_rad: angle.abs(), peak_edge: Some(index) };
        }
    }
    bending
}

#[cfg(test)]
mod tests {
    use foldmotion_pattern::{CreaseKind, Edge};
    use glam::DVec2;

    use super::*;

    /// A unit square split along its diagonal.
    fn square(assignment: Assignment) -> Sheet {
        let edge = |v: u32, w: u32, assignment, faces| Edge {
            vertices: [v, w],
            assignment,
            kind: CreaseKind::Facet,
            row: 0,
            column: 0,
            faces,
        };
        let border = |v, w, face| edge(v, w, Assignment::Border, [Some(face), None]);
        Sheet {
            vertices: vec![DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y],
            edges: vec![
                border(0, 1, 0),
                border(1, 2, 0),
                border(2, 3, 1),
                border(3, 0, 1),
                edge(0, 2, assignment, [Some(1), Some(0)]),
            ],
            faces: vec![[0, 1, 2], [0, 2, 3]],
            face_facets: vec![0, 0],
            facets: Vec::new(),
            unit_length: 1.0,
        }
    }

    #[test]
    fn strain_is_the_relative_change_of_length() {
        let sheet = square(Assignment::Facet);
        let unstrained = bar_strain(&sheet, &sheet.planar());
        assert_eq!((unstrained.peak, unstrained.mean), (0.0, 0.0));
        let scaled: Vec<_> = sheet.planar().iter().map(|p| p * 0.9).collect();
        let strain = bar_strain(&sheet, &scaled);
        assert!((strain.peak - 0.1).abs() < 1e-15 && (strain.mean - 0.1).abs() < 1e-15);
        let mut pulled = sheet.planar();
        pulled[3].y = 1.5;
        let strain = bar_strain(&sheet, &pulled);
        assert_eq!(strain.peak_edge, 3);
        assert!((strain.peak - 0.5).abs() < 1e-15);
        let other = 1.25f64.sqrt() - 1.0;
        assert!((strain.mean - (0.5 + other) / 5.0).abs() < 1e-15);
    }

    #[test]
    fn bending_is_measured_inside_facets_and_not_at_creases() {
        let bend: f64 = 0.3;
        let sheet = square(Assignment::Facet);
        let mut bent = sheet.planar();
        let half = DVec3::new(0.5, 0.5, 0.0);
        let height = bent[3] - half;
        bent[3] = half + height * bend.cos() + DVec3::Z * (height.length() * bend.sin());
        let bending = facet_bending(&sheet, &bent);
        assert!((bending.peak_rad - bend).abs() < 1e-15 && bending.peak_edge == Some(4));
        assert!((bending.peak_deg() - bend.to_degrees()).abs() < 1e-12);
        let creased = facet_bending(&square(Assignment::Valley), &bent);
        assert_eq!((creased.peak_rad, creased.peak_edge), (0.0, None));
    }
}
