//! How much the sheet is stretched and its facets are bent.

use foldmotion_pattern::{Assignment, Sheet};
use glam::DVec3;
use serde::Serialize;

/// Bar strain |l / l₀ − 1| over all edges.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BarStrain {
    /// The largest.
    pub peak: f64,
    /// The edge that has it.
    pub peak_edge: usize,
    /// The mean over the edges.
    pub mean: f64,
}

/// The bar strain of every edge against its length in the crease pattern; zeros for a sheet without edges.
///
/// `positions`: one a vertex. Precondition: no edge of the crease pattern has length 0.
pub fn bar_strain(sheet: &Sheet, positions: &[DVec3]) -> BarStrain {
    let mut strain = BarStrain {
        peak: 0.0,
        peak_edge: 0,
        mean: 0.0,
    };
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
    /// The edge that has it, if any edge lies inside a facet.
    pub peak_edge: Option<usize>,
}

impl FacetBending {
    /// The largest bend in degrees.
    pub fn peak_deg(&self) -> f64 {
        self.peak_rad.to_degrees()
    }
}

/// The largest bend of a facet. `positions`: one a vertex.
pub fn facet_bending(sheet: &Sheet, positions: &[DVec3]) -> FacetBending {
    let angles = sheet.fold_angles(positions);
    let mut bending = FacetBending {
        peak_rad: 0.0,
        peak_edge: None,
    };
    for (index, (edge, angle)) in sheet.edges.iter().zip(angles).enumerate() {
        let (Assignment::Facet, Some(angle)) = (edge.assignment, angle) else {
            continue;
        };
        if bending.peak_edge.is_none() || angle.abs() > bending.peak_rad {
            bending = FacetBending {
                peak_rad: angle.abs(),
                peak_edge: Some(index),
            };
        }
    }
    bending
}
