//! From the segments of the divided profile to the rows of the sheet.

use foldmotion_geometry::Division;
use foldmotion_pattern::{
    FacetModel, Folding, PatternError, ProfileModel, Unit, UnitSheet, clash_figure, common_flap,
    own_cases,
};
use foldmotion_solver::{CreaseGroup, Ease, ScheduleStep, Stage};

use super::input::Input;
use super::motion::{refuse_crease_names, steps};
use super::profile::{EQUAL_ROWS, curve, division};
use super::unit::{Purpose, pattern_error, require_moderate, unit, unit_width};
use crate::scene::{CaseChoice, UnequalChoice};
use crate::{SceneSource, StudyError};

/// The default λ of a common flap, below 1 so that the lowest rows are split like the others.
const COMMON_LAMBDA: f64 = 0.9;

/// In a facet narrower than this part of its length, the bars of a middle node are nearly collinear: soft bars do not hold it
/// between the long sides, and no equilibrium is found.
const NARROW: f64 = 0.1 * (1.0 - 1e-9);

/// The sheet on the segments of `division`.
pub(crate) fn units(
    input: &Input<'_>,
    built_in: Option<&ProfileModel>,
    division: &Division,
    columns: usize,
    purpose: Purpose,
) -> Result<UnitSheet, StudyError> {
    let rows = row_units(input, built_in, division, columns)?;
    if purpose == Purpose::Fold {
        require_moderate(input, &rows, columns, folding(input))?;
    }
    let sheet = match folding(input) {
        Folding::Waterbomb => UnitSheet::with_rows(&rows, columns),
        Folding::Map => UnitSheet::map_folded(&rows, columns),
    };
    let sheet = sheet.map_err(|e| match e {
        PatternError::RowsClash { .. } => input.error("sheet.unequal", e.to_string()),
        e => pattern_error(input, &e),
    })?;
    let model = facet_model(input, &sheet);
    Ok(sheet.with_facet_model(model))
}

fn facet_model(input: &Input<'_>, sheet: &UnitSheet) -> FacetModel {
    // The units of a map are stacked, and middle nodes in their facets make the stack jam.
    let is_split = folding(input) == Folding::Map || sheet.narrowest_facet() < NARROW;
    let default = if is_split { FacetModel::OneDiagonal } else { FacetModel::Symmetric };
    input.scene.material.facet_model.unwrap_or(default)
}

fn folding(input: &Input<'_>) -> Folding {
    input.scene.sheet.folding.unwrap_or_default()
}

/// The unit of each row.
fn row_units(
    input: &Input<'_>,
    built_in: Option<&ProfileModel>,
    division: &Division,
    columns: usize,
) -> Result<Vec<Unit>, StudyError> {
    let scene = &input.scene.sheet;
    let height = division.mean_length;
    if division.max_residual <= EQUAL_ROWS {
        let unit = unit(input, built_in, height, columns)?;
        return Ok(vec![unit; division.points.len() - 1]);
    }
    if !matches!(scene.case, None | Some(CaseChoice::Auto)) {
        let message = "rows of unequal height each have their own case; omit it, or divide into equal lengths";
        return Err(input.error("sheet.case", message));
    }
    let width = unit_width(input, built_in, height, columns)?;
    let heights: Vec<f64> = division.points.windows(2).map(|p| p[0].distance(p[1])).collect();
    let rows = if scene.unequal == Some(UnequalChoice::CommonFlap) {
        let lambda = scene.lambda.unwrap_or(COMMON_LAMBDA);
        common_flap(width, &heights, lambda, scene.offset)
    } else {
        refuse_flap_keys(input)?;
        own_cases(width, &heights)
    };
    rows.map_err(|e| pattern_error(input, &e))
}

/// Refuses λ and d, which apply only to case SII and to a common flap.
fn refuse_flap_keys(input: &Input<'_>) -> Result<(), StudyError> {
    let scene = &input.scene.sheet;
    let given =
        [("sheet.lambda", scene.lambda.is_some()), ("sheet.offset", scene.offset.is_some())];
    match given.into_iter().find(|&(_, given)| given) {
        Some((key, _)) => {
            let message = "does not apply to rows in their own cases; omit it, or set unequal = \"common-flap\"";
            Err(input.error(key, message))
        }
        None => Ok(()),
    }
}

/// The steps of the scene. Default for a map: first the columns fold, then the rows.
pub(crate) fn steps_of(
    input: &Input<'_>,
    units: &UnitSheet,
) -> Result<Vec<ScheduleStep>, StudyError> {
    refuse_crease_names(input)?;
    let steps = steps(input)?;
    let is_timed = steps.iter().any(|step| step.stage == Stage::Fold);
    let is_map = units.folding == Folding::Map;
    if !is_map || is_timed || units.rows == 1 || units.columns == 1 {
        return Ok(steps);
    }
    let half = |creases, from| ScheduleStep {
        stage: Stage::Fold,
        creases,
        rows: None,
        columns: None,
        from,
        to: from + 0.5,
        ease: Ease::Linear,
    };
    let map = [half(CreaseGroup::Columns, 0.0), half(CreaseGroup::Rows, 0.5)];
    Ok(steps.into_iter().chain(map).collect())
}

/// A drawing (SVG) of one column of the sheet in which each row has the creases of its own case, with marks where those of
/// neighbouring rows do not meet (figure 10 of the paper); `None` if the rows are equal.
///
/// # Errors
/// Those of [`Study::resolve`](crate::Study::resolve), except for rows that clash.
pub fn clash_drawing(source: &SceneSource) -> Result<Option<String>, StudyError> {
    let scene = source.scene()?;
    let input = Input::new(source, &scene);
    let curve = curve(&input)?;
    let division = division(&input, &curve)?.division;
    if division.max_residual <= EQUAL_ROWS {
        return Ok(None);
    }
    let columns =
        input.count("sheet.columns", scene.sheet.columns, curve.model.map(|m| m.columns.e))?;
    let rows = row_units(&input, curve.model, &division, columns)?;
    clash_figure(&rows).map(Some).map_err(|e| pattern_error(&input, &e))
}
