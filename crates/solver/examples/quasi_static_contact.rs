//! Folds one sheet with contact and prints what it took and how close it ends to the exact compact state.
//!
//! `cargo run --release -p foldmotion-solver --example quasi_static_contact CASE ROWS COLUMNS AXIAL GAP FRAMES`
#![expect(clippy::print_stdout, reason = "an example prints its table")]

use std::time::Instant;

use foldmotion_geometry::RigidMotion;
use foldmotion_pattern::{Case, Facing, PatternError, Unit, UnitSheet};
use foldmotion_solver::quasi_static::{Contact, QuasiStaticOptions, run_quasi_static};
use foldmotion_solver::{Material, Model, Schedule};
use glam::{DVec2, DVec3};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let text = |i: usize, default: &str| arguments.get(i).map_or(default, |a| a).to_string();
    let case = match text(0, "S").as_str() {
        "E" => Case::E,
        "T" => Case::T,
        "SII" => Case::SII,
        "plain" => Case::Plain,
        _ => Case::S,
    };
    let (rows, columns): (usize, usize) = (text(1, "7").parse()?, text(2, "5").parse()?);
    let axial_stiffness: f64 = text(3, "20").parse()?;
    let gap: f64 = text(4, "1e-3").parse()?;
    let frames: usize = text(5, "240").parse()?;
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
    let options = QuasiStaticOptions {
        frames,
        contact: (gap > 0.0).then_some(Contact { gap, ..Contact::default() }),
        ..QuasiStaticOptions::default()
    };
    let start = Instant::now();
    let run = run_quasi_static(&model, &schedule, &deployed, &options, &|_| true)?;
    let seconds = start.elapsed().as_secs_f64();
    let last = run.frames.last().ok_or("no frames")?;
    let exact = sheet.compact();
    let motion = RigidMotion::best_fit(&last.positions, &exact);
    let fitted: Vec<DVec3> = last.positions.iter().map(|&p| motion.apply(p)).collect();
    let squares: f64 = fitted.iter().zip(&exact).map(|(&p, &q)| p.distance_squared(q)).sum();
    let extents = |p: &[DVec3]| {
        p.iter().copied().reduce(DVec3::max).unwrap_or_default()
            - p.iter().copied().reduce(DVec3::min).unwrap_or_default()
    };
    let strain = run
        .frames
        .iter()
        .flat_map(|f| model.strains(&model.to_model(&f.positions)))
        .fold(0.0, |m: f64, s| m.max(s.abs()));
    println!(
        "{} {rows}x{columns} axial {axial_stiffness} gap {gap}: {seconds:.2} s, t = {}, rms {:.2e}, peak strain {strain:.2e}",
        case.name(),
        last.time,
        (squares / exact.len() as f64).sqrt()
    );
    println!("  extents {} exact {}", extents(&fitted), extents(&exact));
    for stage in &run.stages {
        println!("  {stage:?}");
    }
    println!("  last {:?} jam {:?}", run.figures.last(), run.jam);
    println!(
        "  factorisations {} analyses {} frames {} gap {:?} {:?}",
        run.factorisations,
        run.analyses,
        run.frames.len(),
        run.gap_reached,
        run.effort
    );
    Ok(())
}

fn unit(case: Case) -> Result<Unit, PatternError> {
    match case {
        Case::T => Unit::new(case, 0.7, 1.0, None, None),
        Case::S => Unit::new(case, 1.6, 1.0, None, None),
        Case::SII => Unit::new(case, 1.6, 1.0, Some(0.7), None),
        Case::Plain => Unit::new(case, 2.5, 1.0, None, None),
        Case::E => Unit::new(case, 1.0, 1.0, None, None),
    }
}
