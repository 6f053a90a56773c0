//! Seconds from the flat sheet to the compact state.

use std::error::Error;
use std::time::Instant;

use foldmotion_pattern::{Case, Frame};
use foldmotion_solver::dynamic::{self, DynamicOptions};
use foldmotion_solver::quasi_static::{QuasiStaticOptions, run_quasi_static};
use foldmotion_solver::{Material, Model, Stage};

use crate::sample::median_seconds;
use crate::sheets::{flat_to_compact, sheet};

const ROWS: [usize; 3] = [7, 35, 100];
const COLUMNS: usize = 5;
const SAMPLES: usize = 3;
/// What takes longer is measured once.
const LONG_SECONDS: f64 = 5.0;

pub(crate) fn print() -> Result<(), Box<dyn Error>> {
    println!("\n### Flat to compact\n");
    println!(
        "Without contact, 240 frames, medians of {SAMPLES}, above {LONG_SECONDS} s one run; the last column is the largest difference of a fold angle from \
         that of the compact state\n"
    );
    println!("| engine | case | sheet | nodes | seconds | steps or iterations | radians |");
    println!("| --- | --- | --- | --- | --- | --- | --- |");
    for case in [Case::E, Case::SII] {
        for rows in ROWS {
            row("dynamic", case, rows, |problem| {
                let options =
                    DynamicOptions { stages: vec![Stage::Fold], ..DynamicOptions::default() };
                let run = dynamic::run(
                    &problem.model,
                    &problem.schedule,
                    &problem.flat,
                    &options,
                    &|_| true,
                )?;
                Ok((run.frames, run.steps))
            })?;
            row("quasi-static", case, rows, |problem| {
                let options = QuasiStaticOptions {
                    stages: vec![Stage::Fold],
                    ..QuasiStaticOptions::default()
                };
                let run = run_quasi_static(
                    &problem.model,
                    &problem.schedule,
                    &problem.flat,
                    &options,
                    &|_| true,
                )?;
                let iterations = run.stages.iter().map(|stage| stage.iterations as u64).sum();
                Ok((run.frames, iterations))
            })?;
        }
    }
    Ok(())
}

struct Problem {
    model: Model,
    schedule: foldmotion_solver::Schedule,
    flat: Vec<glam::DVec3>,
}

type Folded = Result<(Vec<Frame>, u64), foldmotion_solver::SolverError>;

fn row(
    engine: &str,
    case: Case,
    rows: usize,
    fold: impl Fn(&Problem) -> Folded,
) -> Result<(), Box<dyn Error>> {
    let units = sheet(case, rows, COLUMNS)?;
    let problem = Problem {
        model: Model::new(&units.sheet, &Material::default())?,
        schedule: flat_to_compact(&units)?,
        flat: units.sheet.planar(),
    };
    let started = Instant::now();
    let mut last = fold(&problem);
    let mut seconds = started.elapsed().as_secs_f64();
    if seconds < LONG_SECONDS {
        seconds = median_seconds(SAMPLES, || last = fold(&problem));
    }
    let (frames, steps) = last?;
    let positions = &frames.last().ok_or("no frames")?.positions;
    let mut angles: Vec<f64> = problem
        .model
        .hinges
        .iter()
        .map(|hinge| units.compact_angles()[hinge.edge as usize])
        .collect();
    let targets = angles.clone();
    problem.model.follow_angles(&problem.model.to_model(positions), &mut angles);
    let errors = angles.iter().zip(&targets).map(|(a, t)| (a - t).abs());
    println!(
        "| {engine} | {} | {rows} × {COLUMNS} | {} | {seconds:.3} | {steps} | {:.0e} |",
        case.name(),
        problem.model.node_count(),
        errors.fold(0.0, f64::max)
    );
    Ok(())
}
