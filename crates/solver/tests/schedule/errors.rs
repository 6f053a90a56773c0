//! Steps that cannot be followed.

use foldmotion_pattern::{Case, Unit, UnitSheet};
use foldmotion_solver::{CreaseGroup, ScheduleStep, SolverError, Stage};

use crate::{row_step, shelter, step};

/// The error of `bad` after a good step.
fn error(bad: ScheduleStep) -> SolverError {
    let shelter = shelter();
    let good = step(Stage::Unfold, CreaseGroup::All, 0.0, 0.5);
    shelter.uniform.with_steps(&shelter.units.sheet, &[good, bad]).unwrap_err()
}

#[test]
fn a_time_outside_the_stage_is_refused_with_its_value() {
    for value in [-0.1, 1.000_001, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let from = error(row_step(0, value, 1.0)).to_string();
        assert!(from.starts_with(&format!("step 1 of the schedule: from is {value};")), "{from}");
        let to = error(row_step(0, 0.0, value)).to_string();
        assert!(to.contains(&format!("to is {value}; it must lie between 0 and 1")), "{to}");
    }
}

#[test]
fn a_step_that_ends_before_it_begins_is_refused_with_both_times() {
    for (from, to) in [(0.5, 0.5), (0.7, 0.2), (1.0, 0.0), (0.5, 0.500_000_9)] {
        let error = error(row_step(0, from, to));
        let expected = SolverError::StepDuration { step: 1, from, to, minimum: 1e-6 };
        assert_eq!(error, expected);
        assert!(error.to_string().contains(&format!("from {from} to {to}")), "{error}");
    }
}

#[test]
fn rows_and_columns_beyond_the_sheet_are_refused_with_how_many_it_has() {
    let all = step(Stage::Fold, CreaseGroup::All, 0.0, 1.0);
    for [first, last] in [[0, 3], [3, 3], [2, 1], [0, u32::MAX]] {
        let rows = Some([first, last]);
        let expected = SolverError::StepRange { step: 1, what: "rows", first, last, count: 3 };
        assert_eq!(error(ScheduleStep { rows, ..all }), expected);
    }
    for columns in [[0, 2], [2, 2], [1, 0]] {
        let columns = Some(columns);
        let message = error(ScheduleStep { columns, ..all }).to_string();
        assert!(message.contains("the sheet has 2 columns"), "{message}");
    }
    let [rows, columns] = [Some([0, 2]), Some([0, 1])];
    let whole = ScheduleStep { rows, columns, ..all };
    let shelter = shelter();
    let schedule = shelter.uniform.clone();
    assert_eq!(schedule.with_steps(&shelter.units.sheet, &[whole]).unwrap(), shelter.uniform);
}

#[test]
fn a_step_that_names_no_crease_is_refused() {
    // No boundary lies above the first row.
    let none =
        ScheduleStep { rows: Some([0, 0]), ..step(Stage::Fold, CreaseGroup::Rows, 0.0, 1.0) };
    assert_eq!(error(none), SolverError::StepNamesNone { step: 1 });
}

#[test]
fn steps_that_move_the_same_crease_are_refused_with_both_and_the_edge() {
    let shelter = shelter();
    let sheet = &shelter.units.sheet;
    // One after the other in time, and yet no crease could say which of them it follows before and after.
    let steps = [
        step(Stage::Unfold, CreaseGroup::All, 0.0, 0.5),
        row_step(0, 0.0, 0.5),
        step(Stage::Fold, CreaseGroup::Diagonals, 0.5, 1.0),
    ];
    let schedule = shelter.uniform.clone();
    let error = schedule.with_steps(sheet, &steps).unwrap_err();
    let SolverError::StepsOverlap { steps, stage, edge } = error else {
        panic!("{error}");
    };
    assert_eq!((steps, stage), ([1, 2], "fold"));
    assert_eq!(sheet.edges[edge].row, 0);
    assert_eq!(sheet.edges[edge].kind, foldmotion_pattern::CreaseKind::Diagonal);
    let error = error.to_string();
    assert!(error.contains("overlap") && error.contains(&format!("edge {edge}")), "{error}");
}

#[test]
fn a_schedule_of_another_sheet_is_refused() {
    let unit = Unit::new(Case::S, 1.6, 1.0, None, None).unwrap();
    let other = UnitSheet::new(unit, 4, 2).unwrap();
    let error = shelter().uniform.with_steps(&other.sheet, &[]).unwrap_err();
    assert!(matches!(error, SolverError::Count { .. }), "{error}");
}
