//! The size of the unit that the current scene would have, w and h, known even if no draft can be made of the scene.

use foldmotion_pattern::{Case, PatternError, Unit};
use foldmotion_study::scene::{CaseChoice, DivisionMethod};
use foldmotion_study::{Draft, ProfileModel};

use super::curve::{columns_case, model};
use super::form::Form;

/// λ used for case SII if the scene gives none.
pub(super) const USUAL_LAMBDA: f64 = 0.7;

/// The size of a unit and the numbers of rows and columns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct UnitSize {
    /// Width w; `None` if case and profile require a width and the scene gives none.
    pub(super) width: Option<f64>,
    /// Height h: the mean of all rows.
    pub(super) height: f64,
    /// Number of rows Nr.
    pub(super) rows: usize,
    /// Number of columns Nc.
    pub(super) columns: usize,
}

impl UnitSize {
    /// The size in another case; `None` if the scene does not determine the height of rows.
    pub(super) fn of(form: &Form<'_>, case: Option<CaseChoice>) -> Option<Self> {
        let scene = &form.scene;
        let built_in = model(scene);
        let rows = rows(form, built_in)?;
        let columns = positive(scene.sheet.columns)
            .or_else(|| built_in.map(|model| model.columns.of(columns_case(case))))?;
        let height = height(form, built_in, rows)?;
        let width = match (scene.sheet.width, case, built_in) {
            (Some(width), _, _) => Some(width / columns as f64),
            (None, None | Some(CaseChoice::E | CaseChoice::Auto), _) => Some(height),
            (None, _, Some(model)) => Some(model.columns.e as f64 * height / columns as f64),
            (None, _, None) => None,
        };
        Some(Self { width, height, rows, columns })
    }

    /// The unit in a case; `None` if the width is not known.
    pub(super) fn unit(
        &self,
        case: Case,
        lambda: Option<f64>,
        offset: Option<f64>,
    ) -> Option<Result<Unit, PatternError>> {
        let (lambda, offset) = match case {
            Case::SII => (lambda.or(Some(USUAL_LAMBDA)), offset),
            _ => (None, None),
        };
        Some(Unit::new(case, self.width?, self.height, lambda, offset))
    }

    /// Why w/h rules out a case, if it does.
    pub(super) fn contradiction(&self, case: Case) -> Option<String> {
        match self.unit(case, None, None)? {
            Err(error @ PatternError::CaseContradictsUnit { .. }) => Some(error.to_string()),
            _ => None,
        }
    }
}

fn rows(form: &Form<'_>, built_in: Option<&ProfileModel>) -> Option<usize> {
    let drafted = || Some(form.draft.and_then(Draft::units)?.units.rows);
    let splits = form.scene.division.method == Some(DivisionMethod::DouglasPeucker)
        && form.scene.division.tolerance.is_some();
    if splits {
        return drafted();
    }
    positive(form.scene.sheet.rows).or_else(|| built_in.map(|model| model.rows)).or_else(drafted)
}

/// The height h, the mean of all rows: from the length of the polygon if that is known, otherwise from the last
/// division.
fn height(form: &Form<'_>, built_in: Option<&ProfileModel>, rows: usize) -> Option<f64> {
    let length = form.scene.profile.length.or_else(|| built_in.map(ProfileModel::length));
    let height = match length {
        Some(length) => length / rows as f64,
        None => form.draft.and_then(Draft::units)?.division.mean_length,
    };
    (height > 0.0 && height.is_finite()).then_some(height)
}

fn positive(count: Option<i64>) -> Option<usize> {
    usize::try_from(count?).ok().filter(|&count| count > 0)
}
