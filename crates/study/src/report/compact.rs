//! The compact state in the report, compared with its closed form.

use foldmotion_check::{FittedBox, relative_error};
use foldmotion_geometry::{Number, RigidMotion};
use foldmotion_pattern::{CompactBox, Frame, SkinPlane};
use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{FoldAngleReport, Outcome};
use crate::Study;

/// A vertex lies on a skin plane if it is within this distance, in units of a; the contact gap requires some.
const SKIN_TOLERANCE: f64 = 0.05;

/// A larger error of an extent is explained: relative to its closed form, or in h if that is 0.
const LARGE_ERROR: f64 = 0.01;

/// A bounding box.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BoxReport {
    /// The extents along the growing direction, the width and the flaps.
    pub extents: [f64; 3],
    /// The area of the box seen along the width, x·z.
    pub area: f64,
    /// The volume x·y·z of the bounding box.
    pub volume: f64,
}

/// The compact state that was reached, compared with the exact one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CompactReport {
    /// Measured after the rigid motion that best fits the exact compact state; for an imported pattern along its
    /// principal axes, from the longest spread to the shortest.
    pub extents: [f64; 3],
    /// The area of the box seen along the width, x·z.
    pub area: f64,
    /// The volume x·y·z of the bounding box.
    pub volume: f64,
    /// The root mean square distance of the vertices from the exact compact state, in units of h; null for an
    /// imported pattern.
    pub rms_to_exact: Option<f64>,
    /// The differences from the closed form, or from the thick one if the sheet has a thickness; null if the case has
    /// none.
    pub relative_error: Option<ErrorReport>,
    /// Why the box differs from the closed form, if an extent does by more than one hundredth (of h if the closed
    /// form is 0).
    pub explanation: Option<String>,
    /// What touches the two skin planes after the same rigid motion; null if the case has none.
    pub skin: Option<SkinReport>,
}

/// What a compact sheet has in its two skin planes: the upper one with the boundary vertices, and the lower one at the
/// distance a below it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SkinReport {
    /// A vertex lies on a plane if it is within this distance, in units of the flap width a.
    pub tolerance: f64,
    /// What the computed state has in the upper plane.
    pub upper: SkinPlaneReport,
    /// What the computed state has in the lower plane.
    pub lower: SkinPlaneReport,
    /// What the exact compact state has in the upper plane.
    pub exact_upper: SkinPlaneReport,
    /// What the exact compact state has in the lower plane.
    pub exact_lower: SkinPlaneReport,
}

/// The parts of the sheet in a skin plane.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SkinPlaneReport {
    /// The number of facets that lie in the plane.
    pub facets: usize,
    /// The number of edges in the plane that do not belong to those facets.
    pub edges: usize,
    /// The number of vertices in the plane that do not belong to those facets and edges.
    pub vertices: usize,
    /// The total area of the facets in the plane.
    pub area: f64,
    /// That area divided by x·y of the compact box in closed form; 0 if the box is flat.
    pub share: f64,
}

/// Differences from the closed form, each divided by it or, if it is 0, by h, h² or h³.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ErrorReport {
    /// The relative errors of the three extents.
    pub extents: [f64; 3],
    /// The relative error of the area x·z.
    pub area: f64,
    /// The relative error of the volume x·y·z.
    pub volume: f64,
}

impl From<CompactBox> for BoxReport {
    fn from(b: CompactBox) -> Self {
        Self { extents: b.extents, area: b.area, volume: b.volume }
    }
}

impl From<&FittedBox> for BoxReport {
    fn from(b: &FittedBox) -> Self {
        Self { extents: b.extents.into(), area: b.area, volume: b.volume }
    }
}

impl ErrorReport {
    /// The errors of a box against the extents of its closed form, for units of the height `h`.
    pub fn new(measured: &FittedBox, closed_form: [f64; 3], h: f64) -> Self {
        let error = relative_error(measured, closed_form.into(), h);
        Self { extents: error.extents.into(), area: error.area, volume: error.volume }
    }
}

impl From<SkinPlane> for SkinPlaneReport {
    fn from(plane: SkinPlane) -> Self {
        let SkinPlane { facets, edges, vertices, area, share } = plane;
        Self { facets, edges, vertices, area, share }
    }
}

impl Study {
    pub(super) fn compact_report(
        &self,
        measured: &FittedBox,
        thick: Option<&BoxReport>,
        last: Option<&Frame>,
    ) -> CompactReport {
        let h = self.subject.sheet().unit_length;
        let closed_form = self.subject.closed_form();
        let thick = thick.map(|form| form.extents);
        let extents = thick.or(closed_form.map(|form| form.extents));
        let error = extents.map(|extents| ErrorReport::new(measured, extents, h));
        CompactReport {
            extents: measured.extents.into(),
            area: measured.area,
            volume: measured.volume,
            rms_to_exact: measured.rms_to_exact.map(|rms| rms / h),
            relative_error: error,
            explanation: None,
            skin: last.and_then(|frame| self.skin_report(&frame.positions)),
        }
    }

    pub(super) fn skin_report(&self, positions: &[DVec3]) -> Option<SkinReport> {
        let units = &self.subject.units()?.units;
        let exact = units.compact();
        let fit = RigidMotion::best_fit(positions, &exact);
        let fitted: Vec<DVec3> = positions.iter().map(|&p| fit.apply(p)).collect();
        let tolerance = SKIN_TOLERANCE * units.unit.flap;
        let (measured, exact) = (units.skin(&fitted, tolerance)?, units.skin(&exact, tolerance)?);
        Some(SkinReport {
            tolerance: SKIN_TOLERANCE,
            upper: measured.upper.into(),
            lower: measured.lower.into(),
            exact_upper: exact.upper.into(),
            exact_lower: exact.lower.into(),
        })
    }
}

impl CompactReport {
    /// Why an extent differs from the closed form by more than [`LARGE_ERROR`].
    pub(super) fn explanation(
        &self,
        outcome: &Outcome,
        fold_angles: &FoldAngleReport,
        gap_reached: Option<f64>,
    ) -> Option<String> {
        let error = self.relative_error?;
        let is_large = |axis: &usize| error.extents[*axis].abs() > LARGE_ERROR;
        let axes: Vec<&str> = (0..3).filter(is_large).map(|axis| ["x", "y", "z"][axis]).collect();
        if axes.is_empty() {
            return None;
        }
        let axes = axes.join(", ");
        if !outcome.is_at_end() {
            return Some(format!(
                "{axes}: the sheet did not reach its compact state; this is the box of the last state reached"
            ));
        }
        let gap = gap_reached.map_or_else(
            || "without contact".to_owned(),
            |gap| format!("every layer keeps a gap of {:.3} h from the next", Number(gap)),
        );
        Some(format!(
            "{axes}: {gap}, and {}, which adds up over the length of the sheet",
            fold_angles.words()
        ))
    }
}
