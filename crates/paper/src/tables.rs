//! Tables 1 and 2, and the boxes that need no simulation.

use std::time::Instant;

use foldmotion_geometry::{Aabb, DivisionOptions, divide};
use foldmotion_pattern::{Case, find_model, models};
use glam::DVec3;

use super::printed::{TABLE_1, TABLE_2};
use super::record::{CaseRow, CountRow, DivisionRow, PrintedCounts, PrintedDivision};
use super::targets::{CASES, sheet};
use crate::PaperError;
use foldmotion_study::UnitStudy;
use foldmotion_study::report::BoxReport;

/// The number of divisions of which the shortest time is taken.
const TIMED: usize = 5;

/// Table 1: the division of each profile, timed.
pub(super) fn table1() -> Result<Vec<DivisionRow>, PaperError> {
    let mut rows = Vec::with_capacity(TABLE_1.len());
    for printed in &TABLE_1 {
        let model = find_model(printed.model).ok_or_else(|| PaperError::model(printed.model))?;
        let profile = model.profile().map_err(|e| PaperError::geometry(model.name, e))?;
        let options = DivisionOptions::default();
        let mut seconds = f64::INFINITY;
        let mut divided = None;
        for _ in 0..TIMED {
            let started = Instant::now();
            let division = divide(&profile, model.rows, &options)
                .map_err(|e| PaperError::geometry(model.name, e))?;
            seconds = seconds.min(started.elapsed().as_secs_f64());
            divided = Some(division);
        }
        rows.extend(divided.map(|division| DivisionRow {
            model: model.name.to_owned(),
            rows: model.rows,
            columns: model.columns.e,
            max_residual: division.max_residual,
            mean_residual: division.mean_residual,
            seconds,
            paper: PrintedDivision {
                rows: printed.rows,
                columns: printed.columns,
                max_residual: printed.max_residual,
                mean_residual: printed.mean_residual,
                seconds: printed.seconds,
            },
        }));
    }
    Ok(rows)
}

/// Table 2, and our columns for the profiles that it omits.
pub(super) fn table2() -> Vec<CountRow> {
    let row = |model: &foldmotion_pattern::ProfileModel| CountRow {
        model: model.name.to_owned(),
        rows: model.rows,
        columns: [model.columns.e, model.columns.t, model.columns.s],
        paper: TABLE_2.iter().find(|printed| printed.model == model.name).map(|printed| {
            PrintedCounts {
                figure: printed.figure.to_owned(),
                rows: printed.rows,
                columns: printed.columns,
            }
        }),
    };
    models().iter().map(row).collect()
}

/// The closed form and the exact box of nine profiles in four cases.
pub(super) fn cases() -> Result<Vec<CaseRow>, PaperError> {
    let mut rows = Vec::with_capacity(models().len() * CASES.len());
    for model in models() {
        for case in CASES {
            let study = sheet(model.name, case)?;
            // Only the unmodified rectangle has no closed form.
            rows.extend(case_row(model.name, &study));
        }
    }
    Ok(rows)
}

fn case_row(model: &str, study: &UnitStudy) -> Option<CaseRow> {
    let units = &study.units;
    Some(CaseRow {
        model: model.to_owned(),
        case: units.unit.case.name().to_owned(),
        rows: units.rows,
        columns: units.columns,
        columns_ours: units.unit.case != Case::E && !TABLE_2.iter().any(|row| row.model == model),
        unit_width: units.unit.width / units.unit.height,
        closed_form: study.closed_form?.into(),
        exact: box_of(&units.compact()),
        simulated: None,
        simulated_error: None,
        verdict: None,
        motion: None,
        certificate: None,
    })
}

/// The box of a state, along the axes.
fn box_of(positions: &[DVec3]) -> BoxReport {
    let extents = Aabb::around(positions.iter().copied()).extents();
    BoxReport {
        extents: extents.into(),
        area: extents.x * extents.z,
        volume: extents.x * extents.y * extents.z,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_and_columns_are_those_the_paper_prints() {
        for (row, printed) in table1().unwrap().iter().zip(&TABLE_1) {
            assert_eq!(row.model, printed.model);
            assert_eq!([row.rows, row.columns], [printed.rows, printed.columns]);
        }
        let table2 = table2();
        let printed: Vec<_> = table2.iter().filter_map(|r| Some((r, r.paper.as_ref()?))).collect();
        assert_eq!(printed.len(), TABLE_2.len());
        for (row, paper) in printed {
            assert_eq!((row.rows, row.columns), (paper.rows, paper.columns), "{}", row.model);
        }
    }

    #[test]
    fn no_residual_is_above_the_papers_or_1e_13() {
        for row in table1().unwrap() {
            let limit = row.paper.max_residual.min(1e-13);
            assert!(row.max_residual <= limit, "{}: {:e}", row.model, row.max_residual);
            assert!(row.mean_residual <= row.paper.mean_residual, "{}", row.model);
        }
    }

    #[test]
    fn exact_boxes_are_the_closed_forms_within_1e_12() {
        let rows = cases().unwrap();
        assert_eq!(rows.len(), 36);
        for row in rows {
            let pairs = [
                (row.exact.extents[0], row.closed_form.extents[0]),
                (row.exact.extents[1], row.closed_form.extents[1]),
                (row.exact.extents[2], row.closed_form.extents[2]),
                (row.exact.area, row.closed_form.area),
                (row.exact.volume, row.closed_form.volume),
            ];
            for (exact, closed) in pairs {
                let error = (exact - closed).abs() / if closed == 0.0 { 1.0 } else { closed };
                assert!(error < 1e-12, "{} {}: {exact} {closed}", row.model, row.case);
            }
            let is_flat = matches!(row.case.as_str(), "E" | "T");
            assert_eq!(row.closed_form.volume == 0.0, is_flat, "{} {}", row.model, row.case);
        }
    }

    #[test]
    fn every_case_of_a_target_is_deployed_on_the_same_polygon_over_the_same_width() {
        for model in models() {
            let [first, others @ ..] = CASES.map(|case| sheet(model.name, case).unwrap());
            let corners =
                |study: &UnitStudy| Aabb::around(study.deployed.iter().copied()).extents();
            for study in others {
                assert_eq!(study.division.points, first.division.points);
                let difference = (corners(&study) - corners(&first)).abs().max_element();
                assert!(difference < 1e-12, "{}: {difference}", model.name);
            }
        }
    }
}
