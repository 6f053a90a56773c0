//! The sheets that are measured.

use foldmotion_pattern::{Case, PatternError, Unit, UnitSheet};
use foldmotion_solver::{Schedule, SolverError};

/// A sheet of case E or SII with h = 1.
pub(crate) fn sheet(case: Case, rows: usize, columns: usize) -> Result<UnitSheet, PatternError> {
    let unit = match case {
        Case::SII => Unit::new(case, 1.6, 1.0, Some(0.7), None)?,
        _ => Unit::new(Case::E, 1.0, 1.0, None, None)?,
    };
    UnitSheet::new(unit, rows, columns)
}

/// From the flat sheet to the compact state, all creases alike.
pub(crate) fn flat_to_compact(units: &UnitSheet) -> Result<Schedule, SolverError> {
    let flat = vec![0.0; units.sheet.edges.len()];
    Schedule::uniform(&units.sheet, &flat, units.compact_angles())
}
