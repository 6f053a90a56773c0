//! Folds E, T, S, SII and plain sheets with the dynamic engine and prints what it took.
//!
//! `cargo run --release -p foldmotion-solver --example dynamic_folds [rows columns]`

#![expect(clippy::print_stdout, reason = "an example that prints its table")]

use std::error::Error;
use std::time::Instant;

use foldmotion_geometry::RigidMotion;
use foldmotion_pattern::{Case, Facing, Unit, UnitSheet};
use foldmotion_solver::dynamic::{DynamicOptions, run};
use foldmotion_solver::{Material, Model, Schedule};
use glam::{DVec2, DVec3};

fn main() -> Result<(), Box<dyn Error>> {
    let sizes: Vec<usize> =
        std::env::args().skip(1).map(|a| a.parse()).collect::<Result<_, _>>()?;
    let sizes = match sizes[..] {
        [rows, columns] => vec![(rows, columns)],
        _ => vec![(3, 2), (7, 3), (7, 5)],
    };
    println!(
        "case   size   nodes   steps (unfold fold)  seconds  Mnode-steps/s  strain %    rms/h residual angle error frames"
    );
    for (rows, columns) in sizes {
        for unit in [
            Unit::new(Case::E, 1.0, 1.0, None, None)?,
            Unit::new(Case::T, 0.7, 1.0, None, None)?,
            Unit::new(Case::S, 1.6, 1.0, None, None)?,
            Unit::new(Case::SII, 1.6, 1.0, Some(0.7), None)?,
            Unit::new(Case::Plain, 0.7, 1.0, None, None)?,
        ] {
            fold(unit, rows, columns)?;
        }
    }
    Ok(())
}

fn fold(unit: Unit, rows: usize, columns: usize) -> Result<(), Box<dyn Error>> {
    let units = UnitSheet::new(unit, rows, columns)?;
    let arch = arch(rows);
    let model = Model::new(&units.sheet, &Material::default())?;
    let deployed_angles = units.deployed_angles(&arch, Facing::Left)?;
    let schedule = Schedule::uniform(&units.sheet, &deployed_angles, units.compact_angles())?;
    let start = units.deployed(&arch, Facing::Left)?;
    let begin = Instant::now();
    let run = run(&model, &schedule, &start, &DynamicOptions::default(), &|_| true)?;
    let seconds = begin.elapsed().as_secs_f64();
    let strain = |positions: &[DVec3]| {
        let strains = model.strains(&model.to_model(positions));
        strains.into_iter().map(f64::abs).fold(0.0, f64::max)
    };
    let peak = run.frames.iter().map(|frame| strain(&frame.positions)).fold(0.0, f64::max);
    let last = run.frames.last().map_or(&start, |frame| &frame.positions);
    let rate = run.steps as f64 * model.node_count() as f64 / seconds / 1e6;
    let [unfold, fold] = [run.stages[0], run.stages[1]];
    println!(
        "{:5} {rows:3} × {columns:<3} {:5} {:8} {:8} {seconds:8.2} {rate:8.2} {:8.2} {:10.1e} {:8.0e} {:8.0e} {}",
        unit.case.name(),
        model.node_count(),
        unfold.steps,
        fold.steps,
        100.0 * peak,
        rms(last, &units.compact()),
        unfold.residual.max(fold.residual),
        fold.fold_angle_error,
        run.frames.len(),
    );
    Ok(())
}

/// The root mean square distance after the best rigid motion.
fn rms(positions: &[DVec3], exact: &[DVec3]) -> f64 {
    let motion = RigidMotion::best_fit(positions, exact);
    let pairs = positions.iter().zip(exact);
    let squares: f64 = pairs.map(|(p, q)| motion.apply(*p).distance_squared(*q)).sum();
    (squares / exact.len() as f64).sqrt()
}

/// A polygon of unit segments that rises and falls as a shelter does.
fn arch(rows: usize) -> Vec<DVec2> {
    let slope = |row: usize| 1.2 - 2.4 * row as f64 / (rows as f64 - 1.0).max(1.0);
    let mut points = vec![DVec2::ZERO];
    for row in 0..rows {
        points.push(points[row] + DVec2::from_angle(slope(row)));
    }
    points
}
