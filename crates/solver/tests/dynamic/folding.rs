//! Whole runs of the dynamic engine.

use std::sync::atomic::{AtomicUsize, Ordering};

use crate::sheets::{deployed, hinge, scaled_units, units};
use foldmotion_geometry::RigidMotion;
use foldmotion_pattern::{Assignment, Case, UnitSheet};
use foldmotion_solver::dynamic::{DynamicOptions, Run, StageOutcome, StageStatus, State, run};
use foldmotion_solver::{Material, Model, Schedule, Snapshot, SolverError, Stage};
use glam::DVec3;

fn fold(units: &UnitSheet, options: &DynamicOptions) -> Run {
    let model = Model::new(&units.sheet, &Material::default()).unwrap();
    let (start, schedule) = deployed(units);
    run(&model, &schedule, &start, options, &|_| true).unwrap()
}

fn coarse() -> DynamicOptions {
    DynamicOptions { frames: 24, ..DynamicOptions::default() }
}

/// Root mean square distance after the best rigid motion.
fn rms(positions: &[DVec3], exact: &[DVec3]) -> f64 {
    let motion = RigidMotion::best_fit(positions, exact);
    let pairs = positions.iter().zip(exact);
    let squares: f64 = pairs.map(|(p, q)| motion.apply(*p).distance_squared(*q)).sum();
    (squares / exact.len() as f64).sqrt()
}

#[test]
fn every_case_passes_through_the_flat_sheet_and_reaches_the_exact_compact_state() {
    for case in [Case::E, Case::T, Case::S, Case::SII, Case::Plain] {
        let units = units(case, 3, 2);
        let run = fold(&units, &coarse());
        assert!(run.stages.iter().all(StageOutcome::is_converged), "{case:?}: {:?}", run.stages);
        let last = run.frames.last().unwrap();
        let error = rms(&last.positions, &units.compact());
        assert!(error < 1e-7, "{case:?}: compact within {error}");
        let planar = run.frames.iter().find(|frame| frame.time == 1.0).unwrap();
        let error = rms(&planar.positions, &units.sheet.planar());
        assert!(error < 1e-6, "{case:?}: planar within {error}");
        for outcome in &run.stages {
            assert!(outcome.residual <= 1e-8 && outcome.fold_angle_error < 1e-6, "{outcome:?}");
        }
        let model = Model::new(&units.sheet, &Material::default()).unwrap();
        let strains = run.frames.iter().flat_map(|f| model.strains(&f.positions));
        let peak = strains.map(f64::abs).fold(0.0, f64::max);
        assert!(peak > 0.01 && peak < 0.12, "{case:?}: peak strain {peak}");
    }
}

#[test]
fn frames_lie_at_the_stated_times_and_rise_strictly() {
    let units = units(Case::S, 2, 1);
    let run = fold(&units, &coarse());
    let times: Vec<f64> = run.frames.iter().map(|f| f.time).collect();
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]), "{times:?}");
    for k in 0..=24 {
        let time = 2.0 * f64::from(k) / 24.0;
        assert!(times.iter().any(|t| (t - time).abs() < 1e-12), "{time} is missing");
    }
    assert_eq!((times[0], *times.last().unwrap()), (0.0, 2.0));
    assert_eq!(run.frames[0].positions, deployed(&units).0);
    assert_eq!(run.steps, run.stages.iter().map(|s| s.steps).sum::<u64>());
}

#[test]
fn settling_that_moves_the_sheet_is_recorded_step_by_step() {
    let lagging = DynamicOptions { ramp_tolerance: f64::INFINITY, ramp_steps: 1, ..coarse() };
    let units = units(Case::E, 3, 2);
    let run = fold(&units, &lagging);
    assert!(run.stages.iter().all(StageOutcome::is_converged));
    for stage in Stage::ALL {
        let end = stage.start_time() + 1.0;
        let inside = |t: f64| t > end - 1.0 / 12.0 && t <= end;
        let path: Vec<_> = run.frames.iter().filter(|f| inside(f.time)).collect();
        assert!(path.len() > 5, "{stage:?}: {} states", path.len());
        for pair in path.windows(2).skip(1) {
            let displacement = pair[0].positions.iter().zip(&pair[1].positions);
            let longest = displacement.map(|(p, q)| p.distance(*q)).fold(0.0, f64::max);
            // A state every 0.02, and at most one update's displacement more.
            assert!(longest < 0.06, "{stage:?}: a node went {longest} unseen");
        }
    }
}

#[test]
fn the_result_is_the_same_for_any_number_of_threads_bit_for_bit() {
    let units = units(Case::S, 40, 26);
    let model = Model::new(&units.sheet, &Material::default()).unwrap();
    assert!(model.node_count() > 4_000, "large enough to run in parallel");
    let (start, _) = deployed(&units);
    let steps_on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut state = State::at_rest(&model, &model.to_model(&start));
            state.set_targets(&vec![0.3; model.hinges.len()]);
            let dt = 0.9 * state.stable_time_step();
            for _ in 0..25 {
                state.step(dt).unwrap();
            }
            (state.positions(), state.angles())
        })
    };
    let one = steps_on(1);
    assert_eq!(one, steps_on(2));
    assert_eq!(one, steps_on(3));
    let (_, angles) = one;
    assert!(angles.iter().any(|a| a.abs() > 1e-3), "the sheet moved");
}

#[test]
fn a_run_repeats_bit_for_bit() {
    let units = units(Case::T, 2, 1);
    assert_eq!(fold(&units, &coarse()), fold(&units, &coarse()));
}

#[test]
fn the_unit_of_length_does_not_change_the_shape() {
    let options = coarse();
    let one = fold(&scaled_units(Case::SII, 2, 1, 1.0), &options);
    let large = fold(&scaled_units(Case::SII, 2, 1, 1024.0), &options);
    // A power of two scales without rounding, so even the last bit agrees.
    assert_eq!(one.frames.len(), large.frames.len());
    for (a, b) in one.frames.iter().zip(&large.frames) {
        let scaled: Vec<_> = a.positions.iter().map(|p| *p * 1024.0).collect();
        assert_eq!(scaled, b.positions, "t = {}", a.time);
    }
    let thousand = fold(&scaled_units(Case::SII, 2, 1, 1000.0), &options);
    let last = |run: &Run| run.frames.last().unwrap().positions.clone();
    let shrunk: Vec<_> = last(&thousand).into_iter().map(|p| p / 1000.0).collect();
    assert!(rms(&shrunk, &last(&one)) < 1e-6);
}

#[test]
fn a_fold_past_half_a_turn_is_followed() {
    let sheet = hinge(Assignment::Valley, 1.0, 0.9, 0.7);
    let model = Model::new(&sheet, &Material::default()).unwrap();
    let target = 3.5;
    let compact = [target, f64::NAN, f64::NAN, f64::NAN, f64::NAN];
    let schedule = Schedule::uniform(&sheet, &[0.0; 5], &compact).unwrap();
    let run = run(&model, &schedule, &sheet.planar(), &coarse(), &|_| true).unwrap();
    let last = &run.frames.last().unwrap().positions;
    let exact = crate::sheets::folded_hinge(&sheet, target);
    assert!((last[2].distance(last[3]) - exact[2].distance(exact[3])).abs() < 1e-6);
    assert!(run.stages[1].fold_angle_error < 1e-7, "{:?}", run.stages[1]);
}

#[test]
fn a_run_out_of_steps_ends_there_and_says_so_with_its_evidence() {
    let units = units(Case::S, 3, 2);
    let whole = fold(&units, &coarse());
    for step_budget in [0, 200, 2_000] {
        let options = DynamicOptions { step_budget, ..coarse() };
        let run = fold(&units, &options);
        let last = run.stages.last().unwrap();
        assert_eq!(last.status, StageStatus::OutOfSteps, "{step_budget}");
        assert!(last.residual > last.tolerance, "{last:?}");
        let frame = run.frames.last().unwrap();
        assert_eq!(frame.time, last.reached);
        assert!(last.reached > 0.0 && last.reached < 2.0, "{last:?}");
        // Not a frozen sheet that is recorded to the end: what came before is that of the whole run, bit for bit.
        let earlier = &run.frames[..run.frames.len() - 1];
        assert_eq!(earlier, &whole.frames[..earlier.len()]);
    }
}

#[test]
fn a_run_can_be_cancelled_and_says_where() {
    let units = units(Case::E, 2, 1);
    let model = Model::new(&units.sheet, &Material::default()).unwrap();
    let (start, schedule) = deployed(&units);
    let calls = AtomicUsize::new(0);
    let until = |moment: &Snapshot<'_>| {
        calls.fetch_add(1, Ordering::Relaxed);
        moment.time < 1.25
    };
    let error = run(&model, &schedule, &start, &coarse(), &until).unwrap_err();
    assert!(matches!(error, SolverError::Cancelled { time } if (1.25..1.4).contains(&time)));
    assert!(calls.into_inner() > 10);
}

#[test]
fn input_that_does_not_fit_is_refused() {
    let units = units(Case::E, 2, 1);
    let model = Model::new(&units.sheet, &Material::default()).unwrap();
    let (start, schedule) = deployed(&units);
    let refused = |start: &[DVec3], options: &DynamicOptions| {
        run(&model, &schedule, start, options, &|_| true).unwrap_err().to_string()
    };
    let good = DynamicOptions::default();
    assert!(refused(&start[1..], &good).contains("start positions were given"));
    let mut lost = start.clone();
    lost[3].z = f64::NAN;
    assert!(refused(&lost, &good).contains("start position of vertex 3"));
    for frames in [0, 1, 7, usize::MAX - 1] {
        let options = DynamicOptions { frames, ..good.clone() };
        let message = refused(&start, &options);
        assert!(message.starts_with(&format!("{frames} frames were requested")), "{message}");
    }
    for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let options = DynamicOptions { tolerance, ..good.clone() };
        assert!(refused(&start, &options).contains("tolerance"));
    }
    let options = DynamicOptions { ramp_steps: 0, ..good.clone() };
    assert!(refused(&start, &options).contains("ramp_steps is 0"));
    let other = crate::sheets::units(Case::E, 3, 1);
    let (_, longer) = deployed(&other);
    let error = run(&model, &longer, &start, &good, &|_| true).unwrap_err();
    assert!(matches!(error, SolverError::Count { what: "scheduled hinges", .. }));
}

#[test]
fn a_sheet_that_starts_torn_apart_diverges_with_its_node() {
    let units = units(Case::E, 2, 1);
    let model = Model::new(&units.sheet, &Material::default()).unwrap();
    let (mut start, schedule) = deployed(&units);
    start[4] += DVec3::splat(1e6);
    let error = run(&model, &schedule, &start, &coarse(), &|_| true).unwrap_err();
    assert!(matches!(error, SolverError::Diverged { .. }), "{error}");
}

#[test]
fn a_schedule_takes_creases_from_their_deployed_angle_over_zero_to_the_compact_one() {
    let units = units(Case::S, 2, 1);
    let (_, schedule) = deployed(&units);
    let model = Model::new(&units.sheet, &Material::default()).unwrap();
    for (hinge, record) in model.hinges.iter().enumerate() {
        let compact = units.compact_angles()[record.edge as usize];
        assert_eq!(schedule.target(Stage::Unfold, hinge, 1.0), 0.0);
        assert_eq!(schedule.target(Stage::Fold, hinge, 0.0), 0.0);
        assert_eq!(schedule.target(Stage::Fold, hinge, 0.25), 0.25 * compact);
        assert_eq!(schedule.target(Stage::Fold, hinge, 2.0), compact);
    }
    let edges = units.sheet.edges.len();
    let flat = vec![0.0; edges];
    let short = Schedule::uniform(&units.sheet, &flat[1..], &flat).unwrap_err();
    assert!(matches!(short, SolverError::Count { what: "deployed angles", .. }));
    let huge = Schedule::uniform(&units.sheet, &flat, &vec![7.0; edges]).unwrap_err();
    assert!(matches!(huge, SolverError::AngleOutOfRange { .. }));
    let lost = Schedule::uniform(&units.sheet, &flat, &vec![f64::NAN; edges]).unwrap_err();
    assert!(matches!(lost, SolverError::NotFinite { .. }));
}

#[test]
fn times_asked_for_are_recorded_once_among_the_frames() {
    let units = units(Case::E, 2, 1);
    let asked = DynamicOptions { extra_times: vec![1.7, 0.1, 1.0, 0.0, 2.5], ..coarse() };
    let times = |run: &Run| run.frames.iter().map(|f| f.time).collect::<Vec<_>>();
    let (plain, asked) = (times(&fold(&units, &coarse())), times(&fold(&units, &asked)));
    let count = |t: f64| asked.iter().filter(|time| (**time - t).abs() < 1e-9).count();
    for time in plain.iter().chain(&[0.1, 1.7]) {
        assert_eq!(count(*time), 1, "{time}");
    }
    assert!(asked.windows(2).all(|t| t[0] < t[1]));
    assert_eq!(asked.len(), plain.len() + 2);
}
