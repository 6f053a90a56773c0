//! Targets against closed forms.

use foldmotion_pattern::{CreaseKind, Edge};
use foldmotion_solver::{CreaseGroup, Ease, Schedule, ScheduleStep, Stage};

use crate::{Shelter, row_step, shelter, step};

/// The edges of the hinges, in the order of the schedule.
fn hinges(shelter: &Shelter) -> Vec<Edge> {
    let edges = shelter.units.sheet.edges.iter().copied();
    edges.filter(Edge::is_hinge).collect()
}

fn targets(schedule: &Schedule, stage: Stage, s: f64) -> Vec<f64> {
    let mut targets = vec![f64::NAN; schedule.hinge_count()];
    schedule.targets(stage, s, &mut targets);
    targets
}

fn end_angles(shelter: &Shelter) -> [Vec<f64>; 2] {
    [targets(&shelter.uniform, Stage::Unfold, 0.0), targets(&shelter.uniform, Stage::Fold, 1.0)]
}

#[test]
fn named_creases_wait_move_with_their_ease_and_stay_while_the_others_follow_the_ramp() {
    let shelter = shelter();
    let [deployed, compact] = end_angles(&shelter);
    for (ease, quarter) in [(Ease::Linear, 0.25), (Ease::Smooth, 0.156_25)] {
        let named = |stage| ScheduleStep {
            rows: Some([1, 2]),
            ease,
            ..step(stage, CreaseGroup::Rows, 0.25, 0.75)
        };
        let schedule = shelter
            .uniform
            .clone()
            .with_steps(&shelter.units.sheet, &[named(Stage::Unfold), named(Stage::Fold)])
            .unwrap();
        let shares = [
            (0.0, 0.0),
            (0.125, 0.0),
            (0.25, 0.0),
            (0.375, quarter),
            (0.5, 0.5),
            (0.625, 1.0 - quarter),
            (0.75, 1.0),
            (0.875, 1.0),
            (1.0, 1.0),
        ];
        for (s, share) in shares {
            let unfold = targets(&schedule, Stage::Unfold, s);
            let fold = targets(&schedule, Stage::Fold, s);
            for (hinge, edge) in hinges(&shelter).iter().enumerate() {
                let is_row = edge.kind == CreaseKind::Row;
                let share = if is_row { share } else { s };
                // Quarters of the way are exact in binary: no tolerance.
                assert_eq!(fold[hinge], compact[hinge] * share, "{ease:?} {s} {hinge}");
                assert_eq!(unfold[hinge], deployed[hinge] * (1.0 - share), "{ease:?}");
            }
        }
    }
    assert!(deployed.iter().any(|a| a.abs() > 0.5) && compact.iter().any(|a| a.abs() > 3.0));
}

/// A group of creases and the kinds that belong to it.
type Group = (CreaseGroup, fn(CreaseKind) -> bool);

#[test]
fn a_step_names_creases_by_kind_row_and_column() {
    let shelter = shelter();
    let uniform = targets(&shelter.uniform, Stage::Fold, 0.5);
    let groups: [Group; 5] = [
        (CreaseGroup::All, |_| true),
        (CreaseGroup::Rows, |kind| kind == CreaseKind::Row),
        (CreaseGroup::Diagonals, |kind| kind == CreaseKind::Diagonal),
        (CreaseGroup::Verticals, |kind| kind == CreaseKind::Vertical),
        (CreaseGroup::Pads, |kind| kind == CreaseKind::Pad),
    ];
    for (group, is_of_group) in groups {
        for (rows, columns) in [(None, None), (Some([1, 2]), None), (Some([1, 1]), Some([0, 0]))] {
            let late = ScheduleStep { rows, columns, ..step(Stage::Fold, group, 0.5, 1.0) };
            let schedule = shelter.uniform.clone();
            let schedule = schedule.with_steps(&shelter.units.sheet, &[late]).unwrap();
            let waiting = targets(&schedule, Stage::Fold, 0.5);
            let lies_in = |range: Option<[u32; 2]>, place: u32| {
                range.is_none_or(|[first, last]| first <= place && place <= last)
            };
            for (hinge, edge) in hinges(&shelter).iter().enumerate() {
                let is_named = edge.is_crease()
                    && is_of_group(edge.kind)
                    && lies_in(rows, edge.row)
                    && lies_in(columns, edge.column);
                let expected = if is_named { 0.0 } else { uniform[hinge] };
                assert_eq!(waiting[hinge], expected, "{group:?} {rows:?} {edge:?}");
            }
            // The other stage is as it was.
            assert_eq!(
                targets(&schedule, Stage::Unfold, 0.3),
                targets(&shelter.uniform, Stage::Unfold, 0.3)
            );
        }
    }
}

#[test]
fn every_crease_begins_and_ends_its_stage_at_the_stages_angles_whatever_the_steps() {
    let shelter = shelter();
    let [deployed, compact] = end_angles(&shelter);
    let zero = vec![0.0; deployed.len()];
    let times = [0.0, 1e-6, 0.1, 1.0 / 3.0, 0.7, 1.0 - 1e-5, 1.0];
    for (index, &from) in times.iter().enumerate() {
        for &to in &times[index + 1..] {
            for ease in [Ease::Linear, Ease::Smooth] {
                let eased = |row| ScheduleStep { ease, ..row_step(row, from, to) };
                let rows =
                    ScheduleStep { ease, ..step(Stage::Unfold, CreaseGroup::Rows, from, to) };
                if to - from < 1e-6 {
                    continue;
                }
                let schedule = shelter
                    .uniform
                    .clone()
                    .with_steps(&shelter.units.sheet, &[eased(0), rows, eased(2)])
                    .unwrap();
                assert_eq!(targets(&schedule, Stage::Unfold, 0.0), deployed);
                assert_eq!(targets(&schedule, Stage::Unfold, 1.0), zero);
                assert_eq!(targets(&schedule, Stage::Fold, 0.0), zero);
                assert_eq!(targets(&schedule, Stage::Fold, 1.0), compact);
                for (hinge, edge) in hinges(&shelter).iter().enumerate() {
                    if edge.is_crease() && edge.row != 1 {
                        assert_eq!(schedule.target(Stage::Fold, hinge, to), compact[hinge]);
                        assert_eq!(schedule.target(Stage::Fold, hinge, from), 0.0);
                    }
                }
            }
        }
    }
}

#[test]
fn targets_are_continuous_and_never_turn_back() {
    let shelter = shelter();
    let smooth = ScheduleStep { ease: Ease::Smooth, ..row_step(1, 0.2, 0.6) };
    let schedule = shelter
        .uniform
        .clone()
        .with_steps(&shelter.units.sheet, &[row_step(0, 0.0, 0.4), smooth, row_step(2, 0.4, 1.0)])
        .unwrap();
    let samples = 4000;
    // At most π in 0.4 of the stage, eased at 3/2 of that.
    let most = 1.5 * std::f64::consts::PI / 0.4 / f64::from(samples);
    let mut before = targets(&schedule, Stage::Fold, 0.0);
    for index in 1..=samples {
        let now = targets(&schedule, Stage::Fold, f64::from(index) / f64::from(samples));
        for (a, b) in before.iter().zip(&now) {
            assert!((b - a).abs() <= most * (1.0 + 1e-9), "{a} {b}");
            assert!(b.abs() >= a.abs() - 1e-15, "{a} {b}");
        }
        before = now;
    }
}

#[test]
fn no_steps_or_steps_that_say_the_same_leave_the_uniform_ramp() {
    let shelter = shelter();
    let with = |steps: &[ScheduleStep]| {
        let schedule = shelter.uniform.clone();
        schedule.with_steps(&shelter.units.sheet, steps).unwrap()
    };
    assert_eq!(with(&[]), shelter.uniform);
    assert_eq!(with(&[step(Stage::Fold, CreaseGroup::All, 0.0, 1.0)]), shelter.uniform);
    let stepped = with(&[row_step(1, 0.0, 0.5)]);
    assert_ne!(stepped, shelter.uniform);
    // Steps given before are forgotten.
    assert_eq!(stepped.with_steps(&shelter.units.sheet, &[]).unwrap(), shelter.uniform);
}
