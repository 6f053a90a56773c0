//! The unit of a sheet: its case and its sizes, and limits of the number of units.

use foldmotion_pattern::{Case, Folding, PatternError, ProfileModel, Unit, UnitSheet};

use super::input::Input;
use crate::StudyError;
use crate::scene::CaseChoice;

/// The largest number of units of a sheet that is folded, which needs some 10 GB.
const MOST_FOLDED: usize = 1_000_000;
/// The largest number of entries of the compact layer order, which needs about 1 GB.
pub(crate) const MOST_ORDERED: usize = 50_000_000;

/// The purpose of a sheet, which determines its largest size.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// To be displayed or cut.
    Show,
    /// To be folded and checked as well.
    Fold,
}

pub(crate) fn too_many_layers(input: &Input<'_>) -> StudyError {
    let message = format!(
        "more than {} pairs of facets would coincide in the compact state, too many to check; use fewer columns, or a \
         case whose columns lie side by side (S, SII)",
        MOST_ORDERED / 2
    );
    input.error("sheet.columns", message)
}

/// Refuses a sheet that is too large for the memory, or that has too many layers to check, before it is laid out.
pub(crate) fn require_moderate(
    input: &Input<'_>,
    units: &[Unit],
    columns: usize,
    folding: Folding,
) -> Result<(), StudyError> {
    let rows = units.len();
    if rows.saturating_mul(columns) > MOST_FOLDED {
        let message = format!(
            "{rows} x {columns} units are more than {MOST_FOLDED}, the largest number that can be folded; use fewer columns or rows"
        );
        return Err(input.error("sheet.columns", message));
    }
    let Some(&unit) = units.first().filter(|&first| units.iter().all(|unit| unit == first)) else {
        return Ok(());
    };
    match UnitSheet::count_compact_order(unit, rows, columns, folding) {
        Some(count) if count > MOST_ORDERED as f64 => Err(too_many_layers(input)),
        _ => Ok(()),
    }
}

/// The case of the scene, for the default number of columns; E if w/h decides.
pub(crate) fn requested_case(input: &Input<'_>) -> Case {
    let choice = input.scene.sheet.case.and_then(CaseChoice::case);
    choice.unwrap_or(Case::E)
}

/// The unit, from W, Nc and h.
pub(crate) fn unit(
    input: &Input<'_>,
    built_in: Option<&ProfileModel>,
    height: f64,
    columns: usize,
) -> Result<Unit, StudyError> {
    let scene = &input.scene.sheet;
    let choice = scene.case.and_then(CaseChoice::case);
    let width = unit_width(input, built_in, height, columns)?;
    let case = choice.unwrap_or_else(|| Case::auto(width, height, scene.lambda));
    // If w/h decides on E or T, λ and d are not used.
    let is_unused = choice.is_none() && matches!(case, Case::E | Case::T);
    let [lambda, offset] = [scene.lambda, scene.offset].map(|value| value.filter(|_| !is_unused));
    Unit::new(case, width, height, lambda, offset).map_err(|e| pattern_error(input, &e))
}

/// The width w, from W and Nc or from the (mean) height of the rows. A built-in profile has the width W of case E in all cases.
pub(crate) fn unit_width(
    input: &Input<'_>,
    built_in: Option<&ProfileModel>,
    height: f64,
    columns: usize,
) -> Result<f64, StudyError> {
    let scene = &input.scene.sheet;
    match (scene.width, scene.case.unwrap_or(CaseChoice::Auto)) {
        (Some(width), _) => Ok(input.length("sheet.width", width)? / columns as f64),
        (None, CaseChoice::E | CaseChoice::Auto) => Ok(height),
        (None, _) if let Some(model) = built_in => {
            Ok(model.columns.e as f64 * height / columns as f64)
        }
        (None, _) => {
            let message =
                "is missing: only in case E it follows from the height of the rows, W = Nc·h";
            Err(input.error("sheet.width", message))
        }
    }
}

pub(crate) fn pattern_error(input: &Input<'_>, error: &PatternError) -> StudyError {
    let key = match error {
        PatternError::CountOutOfRange { name: "columns", .. } => "sheet.columns",
        PatternError::CountOutOfRange { .. } | PatternError::WrongPolygon { .. } => "sheet.rows",
        PatternError::LambdaOutOfRange { .. }
        | PatternError::CommonFlapOutOfRange { .. }
        | PatternError::KeyWithoutCase { key: "lambda", .. } => "sheet.lambda",
        PatternError::OffsetOutOfRange { .. } | PatternError::KeyWithoutCase { .. } => {
            "sheet.offset"
        }
        PatternError::CaseContradictsUnit { .. } if input.scene.sheet.width.is_some() => {
            "sheet.width"
        }
        PatternError::CaseContradictsUnit { .. } => "sheet.case",
        _ => "sheet.width",
    };
    input.error(key, error.to_string())
}
