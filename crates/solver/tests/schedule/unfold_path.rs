//! A path of the row creases: its targets, its errors, and both engines on it.

use foldmotion_pattern::{CreaseKind, Frame};
use foldmotion_solver::dynamic::{DynamicOptions, run};
use foldmotion_solver::quasi_static::{QuasiStaticOptions, run_quasi_static};
use foldmotion_solver::{
    CreaseGroup, Ease, Material, Model, Schedule, ScheduleStep, SolverError, Stage, UnfoldPath,
};

use crate::{Shelter, shelter, step};

/// Of the shelter, whose boundaries start at 1.1.
fn path(progress: &[f64], between: &[[f64; 2]]) -> UnfoldPath {
    let start = std::iter::once([1.1, 1.1]);
    let angles = start.chain(between.iter().copied()).chain([[0.0; 2]]);
    UnfoldPath { progress: progress.to_vec(), angles: angles.map(Vec::from).collect() }
}

/// Bends the other way on its way to flat.
fn to_and_fro() -> UnfoldPath {
    path(&[0.0, 0.3, 0.6, 1.0], &[[1.4, -0.2], [-0.5, 0.4]])
}

fn following(shelter: &Shelter, path: UnfoldPath) -> Result<Schedule, SolverError> {
    let schedule = shelter.uniform.clone();
    schedule.with_unfold_path(&shelter.units.sheet, path)
}

/// A hinge of each boundary.
fn hinges(shelter: &Shelter) -> [usize; 2] {
    let edges = shelter.units.sheet.edges.iter().filter(|e| e.is_hinge());
    let places: Vec<_> =
        edges.map(|e| (e.is_crease() && e.kind == CreaseKind::Row, e.row)).collect();
    [1, 2].map(|row| places.iter().position(|&p| p == (true, row)).unwrap())
}

#[test]
fn a_path_straight_from_the_deployed_angles_to_flat_is_the_uniform_ramp() {
    let shelter = shelter();
    let schedule = following(&shelter, path(&[0.0, 1.0], &[])).unwrap();
    for stage in Stage::ALL {
        for hinge in 0..schedule.hinge_count() {
            for s in [0.0, 0.1, 0.5, 0.77, 1.0] {
                let [a, b] = [&schedule, &shelter.uniform].map(|x| x.target(stage, hinge, s));
                assert!((a - b).abs() < 1e-15, "{hinge} at {s}: {a} {b}");
            }
        }
    }
}

#[test]
fn row_creases_follow_the_path_through_its_knots_and_exactly_to_its_ends() {
    let shelter = shelter();
    let schedule = following(&shelter, to_and_fro()).unwrap();
    let [first, second] = hinges(&shelter);
    let at = |hinge, s| schedule.target(Stage::Unfold, hinge, s);
    for hinge in 0..schedule.hinge_count() {
        assert_eq!(at(hinge, 0.0), shelter.uniform.target(Stage::Unfold, hinge, 0.0));
        assert_eq!(at(hinge, 1.0), 0.0);
    }
    let expected = [(0.15, 1.25, 0.45), (0.3, 1.4, -0.2), (0.6, -0.5, 0.4), (0.8, -0.25, 0.2)];
    for (s, a, b) in expected {
        assert!((at(first, s) - a).abs() < 1e-15 && (at(second, s) - b).abs() < 1e-15, "{s}");
    }
}

#[test]
fn a_step_times_the_progress_along_the_path() {
    let shelter = shelter();
    let schedule = following(&shelter, to_and_fro()).unwrap();
    let late =
        ScheduleStep { ease: Ease::Smooth, ..step(Stage::Unfold, CreaseGroup::Rows, 0.5, 1.0) };
    let timed = schedule.clone().with_steps(&shelter.units.sheet, &[late]).unwrap();
    for hinge in hinges(&shelter) {
        for s in [0.0, 0.3, 0.5, 0.6, 0.9, 1.0] {
            let u = ((s - 0.5) * 2.0f64).clamp(0.0, 1.0);
            let progress = u * u * (3.0 - 2.0 * u);
            let expected = schedule.target(Stage::Unfold, hinge, progress);
            assert!((timed.target(Stage::Unfold, hinge, s) - expected).abs() < 1e-14);
        }
    }
}

#[test]
fn both_engines_hold_the_sheet_on_the_path_and_unfold_it() {
    let shelter = shelter();
    let model = Model::new(&shelter.units.sheet, &Material::default()).unwrap();
    let schedule = following(&shelter, to_and_fro()).unwrap();
    let dynamic = DynamicOptions { frames: 40, ..DynamicOptions::default() };
    let quasi_static = QuasiStaticOptions {
        frames: 40,
        stages: vec![Stage::Unfold],
        ..QuasiStaticOptions::default()
    };
    let dynamic = run(&model, &schedule, &shelter.deployed, &dynamic, &|_| true).unwrap();
    let start = &shelter.deployed;
    let quasi_static =
        run_quasi_static(&model, &schedule, start, &quasi_static, &|_| true).unwrap();
    for (frames, tolerance) in [(dynamic.frames, 1e-2), (quasi_static.frames, 1e-6)] {
        let unfolding: Vec<&Frame> = frames.iter().filter(|f| f.time <= 1.0).collect();
        assert!(unfolding.len() >= 21);
        for frame in unfolding {
            let positions = model.to_model(&frame.positions);
            let mut angles = vec![0.0; model.hinges.len()];
            model.follow_angles(&positions, &mut angles);
            for (hinge, angle) in angles.iter().enumerate() {
                let off = angle - schedule.target(Stage::Unfold, hinge, frame.time);
                assert!(off.abs() < tolerance, "hinge {hinge} at {}: {off}", frame.time);
            }
        }
    }
}

#[test]
fn a_path_with_bad_numbers_is_refused_with_what_is_wrong() {
    let shelter = shelter();
    let error_of = |path| following(&shelter, path).unwrap_err();
    for progress in
        [[0.1, 0.5, 1.0], [0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [0.0, 0.5, 0.9], [0.0, f64::NAN, 1.0]]
    {
        let error = error_of(path(&progress, &[[1.0; 2]]));
        assert!(matches!(error, SolverError::PathProgress { .. }), "{progress:?}: {error}");
    }
    for progress in [&[][..], &[0.0], &[0.0, 0.5, 1.0]] {
        assert!(matches!(error_of(path(progress, &[])), SolverError::Count { .. }), "{progress:?}");
    }
    let between = |angle| path(&[0.0, 0.5, 1.0], &[[angle, 0.0]]);
    assert!(matches!(error_of(between(f64::NAN)), SolverError::NotFinite { index: 1, .. }));
    assert!(matches!(error_of(between(6.5)), SolverError::AngleOutOfRange { index: 1, .. }));
    let mut astray = path(&[0.0, 1.0], &[]);
    astray.angles[0][1] = 1.0;
    let error = error_of(astray.clone());
    assert!(matches!(error, SolverError::PathEnds { ends: [1.0, 0.0], .. }), "{error}");
    astray.angles[0] = vec![1.1; 2];
    astray.angles[1][0] = 0.1;
    assert!(matches!(error_of(astray.clone()), SolverError::PathEnds { .. }));
    astray.angles[1].pop();
    assert!(matches!(error_of(astray), SolverError::Count { .. }));
    let short = UnfoldPath { progress: vec![0.0, 1.0], angles: vec![vec![1.1], vec![0.0]] };
    assert!(matches!(error_of(short), SolverError::Count { expected: 2, found: 1, .. }));
}
