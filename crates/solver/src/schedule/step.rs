//! A step of the schedule: which creases move when.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use foldmotion_pattern::{Assignment, CreaseKind, Edge, Sheet};

use super::Stage;
use super::timing::{Ease, Timing};
use crate::SolverError;

/// The shortest step, in stage-local time.
const MIN_DURATION: f64 = 1e-6;

/// Creases named by their position in the unit, or by whether they are mountains or valleys.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum CreaseGroup {
    /// Every crease.
    #[default]
    All,
    /// On the boundaries between rows.
    Rows,
    /// Between flaps and tucks.
    Diagonals,
    /// Between columns, of a map.
    Columns,
    /// Along corner and mid lines.
    Verticals,
    /// Beside and across pads.
    Pads,
    /// Mountain creases.
    Mountains,
    /// Valley creases.
    Valleys,
}

impl CreaseGroup {
    fn contains(self, edge: &Edge) -> bool {
        let kind = edge.kind;
        match self {
            Self::All => true,
            Self::Rows => kind == CreaseKind::Row,
            Self::Columns => kind == CreaseKind::Column,
            Self::Diagonals => kind == CreaseKind::Diagonal,
            Self::Verticals => kind == CreaseKind::Vertical,
            Self::Pads => kind == CreaseKind::Pad,
            Self::Mountains => edge.assignment == Assignment::Mountain,
            Self::Valleys => edge.assignment == Assignment::Valley,
        }
    }
}

/// Some creases of a sheet, and the part of a stage in which they move.
///
/// They are held at the angle with which the stage starts until `from`, move to that with which it ends between
/// `from` and `to`, and are held there. In `unfold` only row creases have an angle to leave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScheduleStep {
    /// The stage of the motion.
    pub stage: Stage,
    /// The creases that the step folds.
    pub creases: CreaseGroup,
    /// Those of these rows only, first and last, counted from 0 ([`Edge::row`]: a crease between two rows belongs to
    /// the later one); none: of every row.
    pub rows: Option<[u32; 2]>,
    /// Those of these columns only, first and last, counted from 0 ([`Edge::column`]: a crease between two columns
    /// belongs to the one with the smaller index); none: of every column.
    pub columns: Option<[u32; 2]>,
    /// The stage-local time, in [0, 1], at which they begin to move.
    pub from: f64,
    /// The stage-local time, in [0, 1], at which they arrive; at least 1e-6 after `from`.
    pub to: f64,
    /// The course of the fold angles between start and end.
    pub ease: Ease,
}

impl ScheduleStep {
    /// Whether the step moves `edge`.
    pub(super) fn names(&self, edge: &Edge) -> bool {
        let within = |range: Option<[u32; 2]>, place| {
            range.is_none_or(|[first, last]| (first..=last).contains(&place))
        };
        edge.is_hinge()
            && edge.is_crease()
            && self.creases.contains(edge)
            && within(self.rows, edge.row)
            && within(self.columns, edge.column)
    }

    pub(super) fn timing(&self) -> Timing {
        Timing { from: self.from, to: self.to, ease: self.ease }
    }

    /// The first error in the numbers of the step, whose index is `step`.
    pub(super) fn check(&self, step: usize, sheet: &Sheet) -> Result<(), SolverError> {
        for (name, value) in [("from", self.from), ("to", self.to)] {
            if !(0.0..=1.0).contains(&value) {
                return Err(SolverError::StepTime { step, name, value });
            }
        }
        if self.to - self.from < MIN_DURATION {
            return Err(SolverError::StepDuration {
                step,
                from: self.from,
                to: self.to,
                minimum: MIN_DURATION,
            });
        }
        let count = |place: fn(&foldmotion_pattern::Facet) -> u32| {
            sheet.facets.iter().map(|f| place(f) + 1).max().unwrap_or(0)
        };
        for (what, range, count) in [
            ("rows", self.rows, count(|facet| facet.row)),
            ("columns", self.columns, count(|facet| facet.column)),
        ] {
            match range {
                Some([first, last]) if first > last || last >= count => {
                    return Err(SolverError::StepRange { step, what, first, last, count });
                }
                _ => {}
            }
        }
        Ok(())
    }
}
