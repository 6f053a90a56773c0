//! Pairs of facets judged a second by the collision check.

use std::error::Error;

use foldmotion_check::{CollisionOptions, collisions};
use foldmotion_pattern::{Case, Motion};
use foldmotion_solver::quasi_static::{QuasiStaticOptions, run_quasi_static};
use foldmotion_solver::{Material, Model, Stage};

use crate::sample::median_seconds;
use crate::sheets::{flat_to_compact, sheet};

const ROWS: [usize; 3] = [7, 35, 100];
const COLUMNS: usize = 5;
const SAMPLES: usize = 3;

pub(crate) fn print() -> Result<(), Box<dyn Error>> {
    println!("\n### Collision check\n");
    println!(
        "Flat to compact without contact, 121 frames, case E, all threads, medians of {SAMPLES}\n"
    );
    println!("| sheet | triangles | seconds | million pairs a second | near pairs a second |");
    println!("| --- | --- | --- | --- | --- |");
    for rows in ROWS {
        let units = sheet(Case::E, rows, COLUMNS)?;
        let model = Model::new(&units.sheet, &Material::default())?;
        let options =
            QuasiStaticOptions { stages: vec![Stage::Fold], ..QuasiStaticOptions::default() };
        let schedule = flat_to_compact(&units)?;
        let run = run_quasi_static(&model, &schedule, &units.sheet.planar(), &options, &|_| true)?;
        let motion = Motion {
            frames: run.frames,
            compact_order: units.compact_order(),
            sheet: units.sheet.clone(),
        };
        let options = CollisionOptions::default();
        let mut report = collisions(&motion, &options, &|_| true);
        let seconds = median_seconds(SAMPLES, || {
            report = collisions(&motion, &options, &|_| true);
        });
        let decided = report?.decided_by;
        let near = decided.axis_at_rest + decided.turning_axis + decided.search;
        let pairs = near + decided.boxes;
        println!(
            "| {rows} × {COLUMNS} | {} | {seconds:.3} | {:.0} | {:.0} |",
            motion.sheet.faces.len(),
            pairs as f64 / seconds * 1e-6,
            near as f64 / seconds,
        );
    }
    Ok(())
}
