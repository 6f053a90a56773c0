//! Sheet, profile, division and pattern in the report.

use std::fmt::Write as _;

use foldmotion_geometry::DivisionMethod;
use foldmotion_pattern::{Unit, UnitSheet};
use glam::DVec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::compact::BoxReport;
use crate::resolve::flat_folding::{FlatFoldingFault, faults};
use crate::scene::UnfoldChoice;
use crate::{Study, Unfolding, UnitStudy};

/// The most vertices listed that cannot fold flat.
const MOST_FAULTS: usize = 20;

/// A row of its own height.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RowReport {
    /// The case of the row: E, T, S or SII.
    pub case: String,
    /// The height h of the row, in `length_unit`.
    pub height: f64,
}

/// A sheet folded like a map.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MapReport {
    /// The number of layers of the stack, Nr·Nc.
    pub layers: usize,
    /// The height of the stack, layers times `material.thickness`; null if the sheet has no thickness.
    pub stack_height: Option<f64>,
    /// The compact box of the same sheet folded unit by unit; null if it has no closed form.
    pub waterbomb: Option<BoxReport>,
}

/// The unit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct UnitReport {
    /// The width w of the unit, in `length_unit`.
    pub width: f64,
    /// The height h of the unit; the mean if rows differ.
    pub height: f64,
    /// The width a of a flap, in `length_unit`.
    pub flap: f64,
    /// The width s of a side pad, in `length_unit`.
    pub side_pad: f64,
    /// The width 2d of the centre pad, in `length_unit`.
    pub centre_pad: f64,
}

/// The curve Γ.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ProfileReport {
    /// The origin of the profile: the source of a built-in profile, or the key or file of the scene.
    pub source: String,
    /// Whether the profile returns to its start.
    pub closed: bool,
}

/// Distances of Γ from the divided polygon.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FitReport {
    /// The largest distance of Γ from the polygon.
    pub largest: f64,
    /// The mean distance over the length of Γ.
    pub mean: f64,
}

/// The division of Γ (equations 1 and 2).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DivisionReport {
    /// The method that divided the profile.
    pub method: DivisionMethod,
    /// |R_max|: the largest residual of equation 1.
    pub max_residual: f64,
    /// |R_ave|: the mean residual of equation 1.
    pub mean_residual: f64,
    /// The distances of Γ from the divided polygon.
    pub fit: FitReport,
    /// The number of iterations of the division.
    pub iterations: usize,
    /// Wall-clock seconds that the division took.
    pub seconds: f64,
    /// The vertices (x, z) of the divided polygon.
    pub points: Vec<[f64; 2]>,
}

/// The pattern check.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PatternReport {
    /// Whether the angles around every interior vertex sum to 360 degrees.
    pub developable: bool,
    /// Whether every interior vertex can fold flat by itself: an even number of creases, alternate angles that sum to 180
    /// degrees, mountains and valleys that differ by two. Whether the whole sheet folds flat is another question.
    pub flat_foldable: bool,
    /// The number of vertices of the sheet.
    pub vertex_count: usize,
    /// The number of facets of the crease pattern.
    pub facet_count: usize,
    /// The number of triangles of the sheet as computed.
    pub face_count: usize,
    /// The interior vertices, grouped by type and number of creases.
    pub vertices: Vec<VertexReport>,
    /// The vertices of an imported pattern that cannot fold flat, the worst first: the first twenty. Empty for a sheet of
    /// units.
    #[serde(default)]
    pub not_flat_foldable: Vec<FlatFoldingFault>,
}

/// Interior vertices of one type.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct VertexReport {
    /// The type of the vertices: I, J, K, split, pad, grid or imported.
    #[serde(rename = "type")]
    pub kind: String,
    /// The number of creases that meet at the vertex.
    pub degree: usize,
    /// The number of vertices in this group.
    pub count: usize,
    /// Mountain creases minus valley creases: +2 or −2 if a vertex folds flat (Maekawa).
    pub mountains_minus_valleys: i32,
    /// The sum of the sector angles, in degrees.
    pub angle_sum_deg: f64,
    /// The sums of alternate sector angles in degrees, the smaller first; null for an odd number of creases.
    pub alternate_sums_deg: Option<[f64; 2]>,
    /// Whether all vertices of the group are developable.
    pub developable: bool,
    /// Whether all vertices of the group can fold flat by themselves.
    pub flat_foldable: bool,
}

/// How stage unfold moves the row creases.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct UnfoldReport {
    /// The path taken: uniform or energy.
    pub method: UnfoldChoice,
    /// The path that the scene requests: uniform, energy or auto.
    pub asked: UnfoldChoice,
    /// Whether the divided profile was proved not to cross itself on this path.
    pub certified: bool,
    /// Where uniform scaling makes the profile cross itself first, as a part of the stage; null if it does not, or if
    /// that was not examined.
    pub crosses_at: Option<f64>,
    /// The steps of the descent that found the path; null if uniform.
    pub steps: Option<usize>,
    /// The straight pieces to which the path was reduced; null if uniform.
    pub pieces: Option<usize>,
}

impl MapReport {
    /// The line of the table.
    pub(super) fn line(&self, unit: &str) -> String {
        let mut line = format!("map          {} layers", self.layers);
        // Writing into a string cannot fail.
        if let Some(height) = self.stack_height {
            let _ = write!(line, ", {height:.6} {unit} high");
        }
        if let Some(BoxReport { extents: [x, y, z], .. }) = &self.waterbomb {
            let _ = write!(line, "; folded unit by unit {x:.6} x {y:.6} x {z:.6} {unit}");
        }
        line
    }
}

impl From<&Unit> for UnitReport {
    fn from(unit: &Unit) -> Self {
        Self {
            width: unit.width,
            height: unit.height,
            flap: unit.flap,
            side_pad: unit.side_pad,
            centre_pad: unit.centre_pad,
        }
    }
}

impl UnfoldReport {
    /// A line for the terminal.
    pub(super) fn line(&self) -> String {
        let certified = if self.certified {
            "the profile was proved not to cross itself"
        } else {
            "not proved free of crossings"
        };
        let crosses = self.crosses_at.map_or_else(String::new, |share| {
            format!(" (uniform scaling crosses at t = {share:.4})")
        });
        format!("unfold: {}, {certified}{crosses}", self.method.name())
    }
}

impl Study {
    pub(super) fn map_report(&self, sheet: &UnitSheet) -> Option<MapReport> {
        let layers = sheet.map_layers()?;
        Some(MapReport {
            layers,
            stack_height: self.thickness.map(|thickness| layers as f64 * thickness),
            waterbomb: sheet.waterbomb_box().map(BoxReport::from),
        })
    }

    pub(super) fn pattern_report(&self) -> PatternReport {
        let check = self.subject.pattern_check();
        let sheet = self.subject.sheet();
        let imported = self.subject.imported();
        let faults = imported.map(|study| faults(&study.imported, &study.pattern));
        let mut faults = faults.unwrap_or_default();
        faults.truncate(MOST_FAULTS);
        let vertices = check.groups().into_iter().map(|g| VertexReport {
            kind: g.kind.name().to_owned(),
            degree: g.degree,
            mountains_minus_valleys: g.mountains_minus_valleys,
            count: g.count,
            angle_sum_deg: g.angle_sum.to_degrees(),
            alternate_sums_deg: g.alternate_sums.map(|s| s.map(f64::to_degrees)),
            developable: g.developable,
            flat_foldable: g.flat_foldable,
        });
        PatternReport {
            developable: check.is_developable(),
            flat_foldable: check.is_flat_foldable(),
            vertex_count: sheet.vertices.len(),
            facet_count: sheet.facets.len(),
            face_count: sheet.faces.len(),
            vertices: vertices.collect(),
            not_flat_foldable: faults,
        }
    }
}

pub(super) fn row_reports(sheet: &UnitSheet) -> Option<Vec<RowReport>> {
    let row = |unit: &Unit| RowReport { case: unit.case.name().to_owned(), height: unit.height };
    let rows = sheet.row_units().iter().map(row);
    (!sheet.has_equal_rows()).then(|| rows.collect())
}

pub(super) fn profile_report(study: &UnitStudy) -> ProfileReport {
    ProfileReport { source: study.profile_source.clone(), closed: study.profile.is_closed() }
}

pub(super) fn division_report(study: &UnitStudy) -> DivisionReport {
    DivisionReport {
        method: study.division_method,
        fit: FitReport { largest: study.fit.largest, mean: study.fit.mean },
        max_residual: study.division.max_residual,
        mean_residual: study.division.mean_residual,
        iterations: study.division.iterations,
        seconds: study.division_seconds,
        points: study.division.points.iter().map(DVec2::to_array).collect(),
    }
}

pub(super) fn unfold_report(unfolding: &Unfolding) -> UnfoldReport {
    let path = unfolding.path.as_ref();
    UnfoldReport {
        method: unfolding.method(),
        asked: unfolding.requested,
        certified: unfolding.certified,
        crosses_at: unfolding.crosses_at,
        steps: path.map(|path| path.steps),
        pieces: path.map(|path| path.turns.len() - 1),
    }
}
