//! The quasi-static engine without contact: exact ends, balanced frames, the same bits on any number of threads.
#![expect(clippy::unwrap_used, reason = "a test stops where a value is missing")]

use foldmotion_geometry::RigidMotion;
use foldmotion_pattern::{Case, Facing, Unit, UnitSheet};
use foldmotion_solver::quasi_static::{
    QuasiStaticOptions, QuasiStaticRun, SnapControl, StopReason, force_scale, run_quasi_static,
};
use foldmotion_solver::{
    HingeKind, Material, Model, Schedule, Snapshot, SolverError, Stage, dynamic,
};
use glam::{DVec2, DVec3};

struct Scene {
    sheet: UnitSheet,
    deployed: Vec<DVec3>,
    model: Model,
    schedule: Schedule,
}

/// A sheet deployed along half a circle, driven to `share` of its compact angles.
fn scene(case: Case, rows: usize, columns: usize, material: &Material, share: f64) -> Scene {
    let unit = match case {
        Case::T => Unit::new(case, 0.7, 1.0, None, None),
        Case::S => Unit::new(case, 1.6, 1.0, None, None),
        Case::SII => Unit::new(case, 1.6, 1.0, Some(0.7), None),
        Case::E | Case::Plain => Unit::new(case, 1.0, 1.0, None, None),
    };
    let sheet = UnitSheet::new(unit.unwrap(), rows, columns).unwrap();
    let turn = std::f64::consts::PI / rows as f64;
    let mut polygon = vec![DVec2::ZERO];
    for row in 0..rows {
        let direction = DVec2::from_angle(std::f64::consts::FRAC_PI_2 - turn * (row as f64 + 0.5));
        polygon.push(polygon[row] + direction);
    }
    let deployed = sheet.deployed(&polygon, Facing::Left).unwrap();
    let angles = sheet.deployed_angles(&polygon, Facing::Left).unwrap();
    let compact: Vec<f64> = sheet.compact_angles().iter().map(|a| a * share).collect();
    let schedule = Schedule::uniform(&sheet.sheet, &angles, &compact).unwrap();
    let model = Model::new(&sheet.sheet, material).unwrap();
    Scene { sheet, deployed, model, schedule }
}

fn axial(axial_stiffness: f64) -> Material {
    Material { axial_stiffness, ..Material::default() }
}

fn run(scene: &Scene, options: &QuasiStaticOptions) -> QuasiStaticRun {
    run_quasi_static(&scene.model, &scene.schedule, &scene.deployed, options, &|_| true).unwrap()
}

fn frames(frames: usize) -> QuasiStaticOptions {
    QuasiStaticOptions { frames, ..QuasiStaticOptions::default() }
}

/// The root mean square distance after the best rigid fit.
fn misfit(a: &[DVec3], b: &[DVec3]) -> f64 {
    let motion = RigidMotion::best_fit(a, b);
    let squares = a.iter().zip(b).map(|(&p, &q)| motion.apply(p).distance_squared(q));
    (squares.sum::<f64>() / a.len() as f64).sqrt()
}

#[test]
fn every_case_ends_in_its_exact_compact_state_whatever_its_stiffness() {
    for case in [Case::E, Case::T, Case::S, Case::SII] {
        for stiffness in [20.0, 2_000.0, 20_000.0] {
            let scene = scene(case, 3, 2, &axial(stiffness), 1.0);
            let run = run(&scene, &frames(60));
            assert!(run.is_complete(), "{case:?} {stiffness}: {:?}", run.stages);
            let last = run.frames.last().unwrap();
            assert_eq!(last.time, 2.0);
            let rms = misfit(&last.positions, &scene.sheet.compact());
            assert!(rms < 1e-9, "{case:?} {stiffness}: {rms}");
        }
    }
}

#[test]
fn a_stiff_sheet_of_seven_by_five_ends_in_its_exact_compact_state() {
    let scene = scene(Case::S, 7, 5, &axial(20_000.0), 1.0);
    let run = run(&scene, &frames(120));
    let rms = misfit(&run.frames.last().unwrap().positions, &scene.sheet.compact());
    assert!(run.is_complete() && rms < 1e-9, "{rms} {:?}", run.stages);
}

#[test]
fn a_long_strip_that_holds_its_face_angles_ends_in_its_exact_compact_state_in_few_iterations() {
    // Long strips bend softly: any flaw in the Hessian shows as tens of iterations a load step, or none that converges.
    for case in [Case::S, Case::SII] {
        let scene = scene(case, 17, 2, &Material::ORIGAMI_SIMULATOR, 1.0);
        let run = run(&scene, &frames(120));
        assert!(run.is_complete(), "{case:?}: {:?}", run.stages);
        let last = &run.frames.last().unwrap().positions;
        let rms = misfit(last, &scene.sheet.compact());
        assert!(rms < 1e-9, "{case:?}: {rms}");
        let fold = run.stages.last().unwrap();
        assert!(
            fold.iterations < 8 * fold.load_steps,
            "{case:?}: {} iterations in {} load steps",
            fold.iterations,
            fold.load_steps
        );
    }
}

#[test]
fn the_sheet_is_planar_between_the_stages_and_unfolding_does_not_strain_it() {
    let scene = scene(Case::SII, 7, 2, &axial(2_000.0), 1.0);
    let run = run(&scene, &frames(40));
    let planar = run.frames.iter().find(|f| f.time == 1.0).unwrap();
    assert!(misfit(&planar.positions, &scene.sheet.sheet.planar()) < 1e-9);
    for frame in run.frames.iter().take_while(|f| f.time <= 1.0) {
        let strains = scene.model.strains(&scene.model.to_model(&frame.positions));
        let peak = strains.iter().fold(0.0, |m: f64, s| m.max(s.abs()));
        assert!(peak < 1e-9, "t = {}: {peak}", frame.time);
    }
}

#[test]
fn every_frame_lies_at_its_instant_and_is_in_balance() {
    let scene = scene(Case::S, 3, 2, &axial(200.0), 1.0);
    let options = frames(40);
    let run = run(&scene, &options);
    let model = &scene.model;
    let mut targets = vec![0.0; model.hinges.len()];
    let mut angles = vec![0.0; model.hinges.len()];
    scene.schedule.targets(Stage::Unfold, 0.0, &mut angles);
    assert_eq!(run.frames.len(), 41);
    let mut worst: f64 = 0.0;
    for (k, frame) in run.frames.iter().enumerate() {
        assert!((frame.time - k as f64 / 20.0).abs() < 1e-15);
        let stage = if frame.time <= 1.0 { Stage::Unfold } else { Stage::Fold };
        scene.schedule.targets(stage, frame.time - stage.start_time(), &mut targets);
        let positions = model.to_model(&frame.positions);
        model.follow_angles(&positions, &mut angles);
        let mut gradient = vec![DVec3::ZERO; positions.len()];
        model.gradient(&positions, &angles, &targets, &mut gradient);
        let force = gradient.iter().map(|g| g.length()).fold(0.0, f64::max);
        assert!(
            force < 2.0 * options.tolerance * force_scale(model),
            "t = {}: {force}",
            frame.time
        );
        let figures = run.figures[k];
        let energy = model.energy_by_kind(&positions, &angles, &targets);
        assert!((figures.energy.total() - energy.total()).abs() < 1e-12);
        worst = worst.max(energy.total());
    }
    assert!(worst > 1e-3, "the sheet is strained on the way: {worst}");
}

#[test]
fn load_steps_between_frames_are_recorded_where_asked() {
    let scene = scene(Case::T, 7, 3, &axial(2_000.0), 1.0);
    let every = QuasiStaticOptions { record_load_steps: true, ..frames(24) };
    let run = run(&scene, &every);
    let steps: usize = run.stages.iter().map(|s| s.load_steps).sum();
    assert_eq!(run.frames.len(), steps + 1);
    assert!(run.frames.windows(2).all(|f| f[0].time < f[1].time));
}

#[test]
fn both_engines_settle_in_the_same_strained_shape() {
    // Half the compact angles fit together nowhere: the sheet ends bent and strained.
    let scene = scene(Case::S, 3, 2, &Material::default(), 0.5);
    let statically = run(&scene, &frames(40));
    let options = dynamic::DynamicOptions {
        frames: 40,
        tolerance: 1e-10,
        ..dynamic::DynamicOptions::default()
    };
    let dynamically =
        dynamic::run(&scene.model, &scene.schedule, &scene.deployed, &options, &|_| true).unwrap();
    let last = &statically.frames.last().unwrap().positions;
    let other = &dynamically.frames.last().unwrap().positions;
    assert!(misfit(last, other) < 1e-6, "{}", misfit(last, other));
    let strain = statically.figures.last().unwrap().energy.bars;
    assert!(strain > 1e-6, "the shape is strained: {strain}");
}

#[test]
fn the_result_is_bitwise_the_same_on_any_number_of_threads() {
    let scene = scene(Case::E, 3, 2, &axial(2_000.0), 1.0);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| run(&scene, &frames(24)))
    };
    assert_eq!(on(1), on(4));
}

#[test]
fn folds_are_followed_past_half_a_turn() {
    // One crease driven to 200°: nothing else can give way to it.
    let mut scene = scene(Case::E, 1, 1, &axial(2_000.0), 1.0);
    let compact: Vec<f64> =
        scene.sheet.compact_angles().iter().map(|a| a * 200.0 / 180.0).collect();
    let deployed = vec![0.0; compact.len()];
    scene.schedule = Schedule::uniform(&scene.sheet.sheet, &deployed, &compact).unwrap();
    let run = run(&scene, &frames(60));
    assert!(run.is_complete());
    let model = &scene.model;
    let mut angles = vec![0.0; model.hinges.len()];
    for frame in &run.frames {
        model.follow_angles(&model.to_model(&frame.positions), &mut angles);
    }
    let furthest = model.hinges.iter().zip(&angles);
    let furthest = furthest
        .filter(|(hinge, _)| hinge.kind == HingeKind::Crease)
        .map(|(_, angle)| angle.abs())
        .fold(0.0, f64::max);
    assert!(furthest > std::f64::consts::PI + 0.1, "{furthest}");
}

#[test]
fn a_search_without_enough_iterations_keeps_what_was_reached_and_says_where_it_ended() {
    // This sheet snaps, which takes hundreds of iterations.
    let scene = scene(Case::T, 7, 5, &axial(2_000.0), 1.0);
    let hasty = QuasiStaticOptions { max_iterations: 2, stages: vec![Stage::Fold], ..frames(24) };
    let planar = scene.sheet.sheet.planar();
    let run = run_quasi_static(&scene.model, &scene.schedule, &planar, &hasty, &|_| true).unwrap();
    assert!(!run.is_complete());
    let failed = run.stages.last().unwrap();
    assert!(!failed.converged && failed.residual > 0.0 && failed.shortened_steps > 0);
    assert!(failed.reached < 2.0);
    assert_eq!(run.frames.last().unwrap().time, failed.reached);
    let stop = failed.stop.unwrap();
    assert_eq!(stop.reason, StopReason::NoEquilibrium);
    assert!(stop.residual > stop.tolerance, "{stop:?}");
    assert!(stop.step > 0.0 && stop.step < 1.0 / 120.0, "{stop:?}");
}

#[test]
fn a_sheet_that_passes_through_its_snap_ends_where_the_one_that_settles_ends() {
    let scene = scene(Case::T, 7, 5, &axial(2_000.0), 1.0);
    let planar = scene.sheet.sheet.planar();
    let fold = |snap_control| {
        let options = QuasiStaticOptions { snap_control, stages: vec![Stage::Fold], ..frames(24) };
        run_quasi_static(&scene.model, &scene.schedule, &planar, &options, &|_| true).unwrap()
    };
    let [settled, passed] = [SnapControl::Settle, SnapControl::PassThrough].map(fold);
    let end = |run: &QuasiStaticRun| run.frames.last().unwrap().positions.clone();
    assert!(settled.is_complete() && passed.is_complete());
    assert!(misfit(&end(&settled), &end(&passed)) < 1e-4);
    let snaps = &passed.stages[0].snaps;
    assert!(snaps.iter().all(|snap| snap.is_over && snap.energy_released > 0.0), "{snaps:?}");
    assert!(!snaps.is_empty());
}

#[test]
fn a_stage_without_enough_iterations_keeps_what_was_reached_and_says_where_it_ended() {
    let scene = scene(Case::T, 7, 5, &axial(2_000.0), 1.0);
    let whole = run(&scene, &frames(24));
    assert!(whole.is_complete() && whole.stages.iter().all(|stage| stage.stop.is_none()));
    let short = QuasiStaticOptions { iterations_a_step: 2, ..frames(24) };
    let ended = run(&scene, &short);
    assert!(!ended.is_complete());
    let stage = ended.stages.last().unwrap();
    let stop = stage.stop.unwrap();
    assert_eq!(stop.reason, StopReason::OutOfIterations);
    assert!(stop.residual > stop.tolerance && stop.step > 0.0, "{stop:?}");
    assert_eq!(stage.iterations, 240);
    assert_eq!(ended.frames.last().unwrap().time, stage.reached);
    // Until then nothing differs.
    let earlier = &ended.frames[..ended.frames.len() - 1];
    assert_eq!(earlier, &whole.frames[..earlier.len()]);
}

#[test]
fn input_that_does_not_fit_is_refused_with_its_evidence() {
    let scene = scene(Case::E, 1, 1, &Material::default(), 1.0);
    let go = |start: &[DVec3], options: &QuasiStaticOptions| {
        run_quasi_static(&scene.model, &scene.schedule, start, options, &|_| true).unwrap_err()
    };
    for odd in [0, 1, 7] {
        let error = go(&scene.deployed, &frames(odd));
        assert!(matches!(error, SolverError::Frames { frames, .. } if frames == odd));
    }
    let tolerance = QuasiStaticOptions { tolerance: f64::NAN, ..frames(2) };
    let error = go(&scene.deployed, &tolerance);
    assert!(matches!(error, SolverError::Option { name: "tolerance", .. }));
    let error = go(&scene.deployed[1..], &frames(2));
    assert!(matches!(error, SolverError::Count { .. }));
    let mut broken = scene.deployed.clone();
    broken[3].y = f64::INFINITY;
    let error = go(&broken, &frames(2));
    assert!(matches!(error, SolverError::NotFinite { index: 3, .. }));
}

#[test]
fn the_caller_can_end_the_run() {
    let scene = scene(Case::E, 1, 1, &Material::default(), 1.0);
    let stop = |moment: &Snapshot<'_>| moment.time < 0.5;
    let error = run_quasi_static(&scene.model, &scene.schedule, &scene.deployed, &frames(8), &stop)
        .unwrap_err();
    assert_eq!(error, SolverError::Cancelled { time: 0.5 });
}

#[test]
fn times_asked_for_are_recorded_once_and_lie_on_the_same_path() {
    let scene = scene(Case::E, 3, 1, &Material::default(), 1.0);
    let plain = QuasiStaticOptions { frames: 8, ..QuasiStaticOptions::default() };
    let asked = QuasiStaticOptions {
        extra_times: vec![1.7, 0.1, 1.0, 1.25, 1.7 + 1e-14, 0.0, 2.0, -0.3, 2.5],
        ..plain.clone()
    };
    let times = |run: &QuasiStaticRun| run.frames.iter().map(|f| f.time).collect::<Vec<_>>();
    let (plain, asked) = (run(&scene, &plain), run(&scene, &asked));
    let expected = [0.0, 0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.7, 1.75, 2.0];
    assert_eq!(times(&asked), expected);
    for frame in &plain.frames {
        let twin = asked.frames.iter().find(|f| f.time == frame.time).unwrap();
        let drift = RigidMotion::best_fit(&frame.positions, &twin.positions);
        for (p, q) in frame.positions.iter().zip(&twin.positions) {
            let p = drift.apply(*p);
            assert!(p.distance(*q) < 1e-6, "{} {p} {q}", frame.time);
        }
    }
}
