//! Stepped schedules in the dynamic engine.

use foldmotion_geometry::RigidMotion;
use foldmotion_solver::dynamic::{DynamicOptions, StageOutcome, run};
use foldmotion_solver::{CreaseGroup, Ease, Material, Model, ScheduleStep, Stage};
use glam::DVec3;

use crate::{row_step, shelter, step};

/// Root mean square distance after the best rigid motion.
fn rms(positions: &[DVec3], exact: &[DVec3]) -> f64 {
    let motion = RigidMotion::best_fit(positions, exact);
    let pairs = positions.iter().zip(exact);
    let squares: f64 = pairs.map(|(p, q)| motion.apply(*p).distance_squared(*q)).sum();
    (squares / exact.len() as f64).sqrt()
}

fn reaches_compact(name: &str, steps: &[ScheduleStep]) {
    let shelter = shelter();
    let model = Model::new(&shelter.units.sheet, &Material::default()).unwrap();
    let schedule = shelter.uniform.with_steps(&shelter.units.sheet, steps).unwrap();
    let options = DynamicOptions { frames: 24, ..DynamicOptions::default() };
    let run = run(&model, &schedule, &shelter.deployed, &options, &|_| true).unwrap();
    assert!(run.stages.iter().all(StageOutcome::is_converged), "{name}: {:?}", run.stages);
    let last = &run.frames[run.frames.len() - 1].positions;
    let error = rms(last, &shelter.units.compact());
    assert!(error < 1e-6, "{name}: compact within {error}");
    let times: Vec<f64> = run.frames.iter().map(|frame| frame.time).collect();
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]), "{times:?}");
    for k in 0..=options.frames {
        let time = 2.0 * k as f64 / options.frames as f64;
        let is_there = times.iter().any(|t| (t - time).abs() < 1e-12);
        assert!(is_there, "{name}: {time} is missing");
    }
}

/// Neighbouring rows share creases: strictly one after the other, the sheet does not settle on the way.
#[test]
fn rows_one_a_little_after_the_other_reach_the_exact_compact_state() {
    let rows = [row_step(0, 0.0, 0.9), row_step(1, 0.05, 0.95), row_step(2, 0.1, 1.0)];
    reaches_compact("rows in turn", &rows.map(|row| ScheduleStep { ease: Ease::Smooth, ..row }));
}

#[test]
fn diagonals_first_reaches_the_exact_compact_state() {
    let unfold =
        ScheduleStep { rows: Some([1, 1]), ..step(Stage::Unfold, CreaseGroup::Rows, 0.0, 0.4) };
    let fold = |creases, from, to| step(Stage::Fold, creases, from, to);
    let steps =
        [unfold, fold(CreaseGroup::Diagonals, 0.0, 0.6), fold(CreaseGroup::Verticals, 0.3, 1.0)];
    reaches_compact("diagonals first", &steps);
}
