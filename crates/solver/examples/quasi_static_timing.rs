//! Prints how long the quasi-static engine takes over sheets of each case, and how well it ends.
//!
//! `cargo run --release -p foldmotion-solver --example quasi_static_timing [rows ...]`
#![expect(clippy::print_stdout, reason = "an example prints its table")]

use std::time::Instant;

use foldmotion_geometry::RigidMotion;
use foldmotion_pattern::{Case, Facing, PatternError, Unit, UnitSheet};
use foldmotion_solver::quasi_static::{QuasiStaticOptions, run_quasi_static};
use foldmotion_solver::{Material, Model, Schedule};
use glam::{DVec2, DVec3};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let rows: Vec<usize> = std::env::args().skip(1).map(|a| a.parse()).collect::<Result<_, _>>()?;
    let rows = if rows.is_empty() { vec![7, 35] } else { rows };
    println!(
        "case rows axial  nodes  seconds  load steps  shortened  iterations  factors  residual  rms"
    );
    for &rows in &rows {
        for case in [Case::E, Case::T, Case::S, Case::SII] {
            for axial_stiffness in [20.0, 2_000.0, 20_000.0] {
                measure(case, rows, 5, axial_stiffness)?;
            }
        }
    }
    Ok(())
}

fn unit(case: Case) -> Result<Unit, PatternError> {
    match case {
        Case::T => Unit::new(case, 0.7, 1.0, None, None),
        Case::S => Unit::new(case, 1.6, 1.0, None, None),
        Case::SII => Unit::new(case, 1.6, 1.0, Some(0.7), None),
        Case::E | Case::Plain => Unit::new(case, 1.0, 1.0, None, None),
    }
}

fn measure(
    case: Case,
    rows: usize,
    columns: usize,
    axial_stiffness: f64,
) -> Result<(), Box<dyn std::error::Error>> {
    let sheet = UnitSheet::new(unit(case)?, rows, columns)?;
    // An arch: the rows turn by half a circle in all.
    let turn = std::f64::consts::PI / rows as f64;
    let mut polygon = vec![DVec2::ZERO];
    for row in 0..rows {
        let direction = DVec2::from_angle(std::f64::consts::FRAC_PI_2 - turn * (row as f64 + 0.5));
        polygon.push(polygon[row] + direction);
    }
    let deployed = sheet.deployed(&polygon, Facing::Left)?;
    let material = Material { axial_stiffness, ..Material::default() };
    let model = Model::new(&sheet.sheet, &material)?;
    let angles = sheet.deployed_angles(&polygon, Facing::Left)?;
    let schedule = Schedule::uniform(&sheet.sheet, &angles, sheet.compact_angles())?;
    let start = Instant::now();
    let run =
        run_quasi_static(&model, &schedule, &deployed, &QuasiStaticOptions::default(), &|_| true)?;
    let seconds = start.elapsed().as_secs_f64();
    let last = run.frames.last().ok_or("no frames")?;
    let rms = misfit(&last.positions, &sheet.compact());
    let sum = |f: fn(&foldmotion_solver::quasi_static::StageOutcome) -> usize| -> Vec<usize> {
        run.stages.iter().map(f).collect()
    };
    println!(
        "{:4} {rows:4} {axial_stiffness:6} {:6} {seconds:7.2} {:?} {:?} {:?} {} {:.1e} {rms:.1e} t={}",
        case.name(),
        model.node_count(),
        sum(|s| s.load_steps),
        sum(|s| s.shortened_steps),
        sum(|s| s.iterations),
        run.factorisations,
        run.stages.iter().map(|s| s.residual).fold(0.0, f64::max),
        last.time,
    );
    Ok(())
}

/// The root mean square distance after the best rigid fit.
fn misfit(a: &[DVec3], b: &[DVec3]) -> f64 {
    let motion = RigidMotion::best_fit(a, b);
    let squares: f64 = a.iter().zip(b).map(|(&p, &q)| motion.apply(p).distance_squared(q)).sum();
    (squares / a.len() as f64).sqrt()
}
