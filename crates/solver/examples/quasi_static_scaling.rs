//! Prints the time of one Newton iteration for strips of growing length and for square sheets, and the fitted exponent.
//!
//! `cargo run --release -p foldmotion-solver --example quasi_static_scaling`
#![expect(clippy::print_stdout, reason = "an example prints its table")]

use std::time::Instant;

use foldmotion_pattern::{Case, Unit, UnitSheet};
use foldmotion_solver::quasi_static::{QuasiStaticOptions, run_quasi_static};
use foldmotion_solver::{Material, Model, Schedule, Stage};

/// The compact angles are scaled by this, so that a few iterations reach the end.
const SHARE: f64 = 1e-7;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let strips = [(50, 2), (500, 2), (2_000, 2), (8_000, 2)];
    let squares = [(10, 10), (20, 20), (40, 40), (80, 80)];
    for (name, sizes) in [("strips of 2 columns", strips), ("square sheets", squares)] {
        println!("{name}: rows, nodes, seconds an iteration");
        let mut points = Vec::new();
        for (rows, columns) in sizes {
            let (nodes, seconds) = measure(rows, columns)?;
            println!("{rows:6} {nodes:8} {seconds:10.6}");
            points.push(((nodes as f64).ln(), seconds.ln()));
        }
        println!("  grows like nodes^{:.2}", slope(&points));
    }
    Ok(())
}

/// The number of nodes, and the mean time of an iteration: assembly, factorisation, solution and line search.
fn measure(rows: usize, columns: usize) -> Result<(usize, f64), Box<dyn std::error::Error>> {
    let sheet = UnitSheet::new(Unit::new(Case::S, 1.6, 1.0, None, None)?, rows, columns)?;
    let model = Model::new(&sheet.sheet, &Material::default())?;
    let compact: Vec<f64> = sheet.compact_angles().iter().map(|a| a * SHARE).collect();
    let schedule = Schedule::uniform(&sheet.sheet, &vec![0.0; compact.len()], &compact)?;
    let options = QuasiStaticOptions {
        stages: vec![Stage::Fold],
        frames: 4,
        ..QuasiStaticOptions::default()
    };
    let planar = sheet.sheet.planar();
    let start = Instant::now();
    let run = run_quasi_static(&model, &schedule, &planar, &options, &|_| true)?;
    let seconds = start.elapsed().as_secs_f64();
    Ok((model.node_count(), seconds / run.factorisations as f64))
}

/// The slope of the line of least squares.
fn slope(points: &[(f64, f64)]) -> f64 {
    let count = points.len() as f64;
    let (sx, sy) = points.iter().fold((0.0, 0.0), |(x, y), p| (x + p.0, y + p.1));
    let (mx, my) = (sx / count, sy / count);
    let products: f64 = points.iter().map(|p| (p.0 - mx) * (p.1 - my)).sum();
    let squares: f64 = points.iter().map(|p| (p.0 - mx) * (p.0 - mx)).sum();
    products / squares
}
