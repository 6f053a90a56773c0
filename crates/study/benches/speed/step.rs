//! Node-steps a second of the dynamic engine against the number of nodes.

use std::error::Error;

use foldmotion_pattern::Case;
use foldmotion_solver::dynamic::{State, StepCost};
use foldmotion_solver::{Material, Model};
use glam::DVec3;

use crate::machine::Ceiling;
use crate::sample::{exponent, median_seconds};
use crate::sheets::sheet;

/// Rows and columns: 126, 1 743, 30 351, 100 467 and a million nodes.
const SIZES: [(usize, usize); 4] = [(7, 5), (105, 5), (100, 100), (182, 182)];
const LARGE: (usize, usize) = (577, 577);
/// Node-steps in a sample, and samples.
const NODE_STEPS: usize = 6_000_000;
const SAMPLES: usize = 7;

/// What is switched on in a step.
const KINDS: [(&str, f64, f64); 3] = [
    ("bars and hinges", 0.0, 0.0),
    ("with dampers", 1.0, 0.0),
    ("with dampers and face angles", 1.0, 0.2),
];

/// A sheet without and with springs at the angles of its triangles.
struct Sheets {
    models: [Model; 2],
    flat: Vec<DVec3>,
}

pub(crate) fn print(ceilings: &[Ceiling], is_large: bool) -> Result<(), Box<dyn Error>> {
    let sizes = SIZES.iter().copied().chain(is_large.then_some(LARGE));
    let sheets: Vec<Sheets> = sizes
        .map(|(rows, columns)| {
            let units = sheet(Case::E, rows, columns)?;
            let model = |face_angle_stiffness| {
                let material = Material { face_angle_stiffness, ..Material::default() };
                Model::new(&units.sheet, &material)
            };
            Ok::<_, Box<dyn Error>>(Sheets {
                models: [model(0.0)?, model(0.2)?],
                flat: units.sheet.planar(),
            })
        })
        .collect::<Result<_, _>>()?;
    println!("\n### Dynamic engine: a step\n");
    println!(
        "Million node-steps a second, f64, medians of {SAMPLES}; in brackets the share of the lower ceiling (f: operations, \
         m: memory)\n"
    );
    println!("| nodes | threads | {} | scaling | bytes a node |", KINDS.map(|k| k.0).join(" | "));
    println!("| --- | --- | --- | --- | --- | --- | --- |");
    let mut points = vec![Vec::new(); ceilings.len()];
    for pair in &sheets {
        let mut single = f64::INFINITY;
        for (ceiling, points) in ceilings.iter().zip(&mut points) {
            let mut cells = Vec::new();
            let mut cost = None;
            for (_, damping, face_angles) in KINDS {
                let model = &pair.models[usize::from(face_angles > 0.0)];
                let (seconds, step_cost) =
                    ceiling.pool.install(|| seconds_a_step(model, &pair.flat, damping));
                let rate = model.node_count() as f64 / seconds;
                if cells.is_empty() {
                    cells.push(format!(
                        "{:.1} ({})",
                        rate * 1e-6,
                        share(rate, &step_cost, ceiling)
                    ));
                    points.push((model.node_count() as f64, seconds));
                    cost = Some((seconds, step_cost));
                } else {
                    cells.push(format!("{:.1}", rate * 1e-6));
                }
            }
            let Some((seconds, cost)) = cost else {
                continue;
            };
            if ceiling.pool.current_num_threads() == 1 {
                single = seconds;
            }
            println!(
                "| {} | {} | {} | {:.2} | {:.0} |",
                cost.nodes,
                ceiling.pool.current_num_threads(),
                cells.join(" | "),
                single / seconds,
                cost.memory / cost.nodes as f64
            );
        }
    }
    println!();
    for (ceiling, points) in ceilings.iter().zip(&points) {
        println!(
            "{} threads: seconds a step grow as nodes^{:.2}.",
            ceiling.pool.current_num_threads(),
            exponent(points)
        );
    }
    Ok(())
}

/// Of a damped oscillation about the flat sheet, and what the step costs.
fn seconds_a_step(model: &Model, flat: &[DVec3], damping: f64) -> (f64, StepCost) {
    let mut state = State::at_rest(model, flat);
    state.set_targets(&vec![0.05; model.hinges.len()]);
    state.damping = damping;
    let dt = 0.5 * state.stable_time_step();
    let steps = NODE_STEPS.div_ceil(model.node_count());
    let mut is_stable = true;
    let seconds = median_seconds(SAMPLES, || {
        is_stable &= (0..steps).all(|_| state.step(dt).is_ok());
    });
    assert!(is_stable, "half the stable time step is stable");
    (seconds / steps as f64, state.step_cost())
}

/// The share of the ceiling that is lower at this number of operations and bytes.
fn share(rate: f64, cost: &StepCost, ceiling: &Ceiling) -> String {
    let nodes = cost.nodes as f64;
    let by_operations = rate * cost.operations / nodes / ceiling.operations;
    let by_bytes = rate * cost.bytes / nodes / ceiling.bytes;
    format!("f {:.0} %, m {:.0} %", 100.0 * by_operations, 100.0 * by_bytes)
}
