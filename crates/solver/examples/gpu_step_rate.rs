//! Prints how many nodes a GPU steps in a second, and the share of its memory's rate that this takes.
//!
//! `cargo run --release -p foldmotion-solver --features gpu --example gpu_step_rate`: sheets of
//! 1 813, 30 351 and 1 000 807 nodes.
#![expect(clippy::print_stdout, reason = "an example prints its table")]

use std::time::Instant;

use foldmotion_pattern::{Case, Unit, UnitSheet};
use foldmotion_solver::dynamic::State;
use foldmotion_solver::dynamic::gpu::{Gpu, GpuState};
use foldmotion_solver::{Material, Model};

/// Units along each side of the sheets.
const SIDES: [usize; 3] = [24, 100, 577];
/// Node-steps of a timed run, about.
const NODE_STEPS: usize = 20_000_000;
/// Timed runs; the median is printed.
const RUNS: usize = 3;
/// Bytes copied to find the memory's rate: more than a cache holds, no more than every GPU lets a buffer have.
const COPIED: u64 = 128 << 20;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let gpu = Gpu::new()?;
    let kind = if gpu.is_software() { ", in software" } else { "" };
    let copy_rate = gpu.copy_rate(COPIED)?;
    println!("{}{kind}: copies {:.1} GB/s, read and written", gpu.name(), copy_rate * 1e-9);
    println!(
        "nodes, million node-steps/s, bytes a node-step, share of the copy's rate, bytes a node held"
    );
    for side in SIDES {
        let units = UnitSheet::new(Unit::new(Case::E, 1.0, 1.0, None, None)?, side, side)?;
        let model = Model::new(&units.sheet, &Material::default())?;
        let positions = model.to_model(&units.sheet.planar());
        let dt = 0.5 * State::at_rest(&model, &positions).stable_time_step();
        let mut state = GpuState::at_rest(&gpu, &model, &positions)?;
        state.set_targets(&vec![0.1; model.hinges.len()]);
        let nodes = model.node_count();
        let seconds = seconds_a_step(&mut state, (NODE_STEPS / nodes).max(5), dt)?;
        let bytes = state.step_bytes() as f64;
        println!(
            "{nodes:8} {:8.2} {:6.0} {:6.1} % {:6.0}",
            nodes as f64 / seconds * 1e-6,
            bytes / nodes as f64,
            100.0 * bytes / seconds / copy_rate,
            state.memory_bytes() as f64 / nodes as f64
        );
    }
    Ok(())
}

/// The median over the runs; reading the totals waits for the last step.
fn seconds_a_step(
    state: &mut GpuState<'_>,
    steps: usize,
    dt: f64,
) -> Result<f64, foldmotion_solver::SolverError> {
    state.step(2, dt, 1.0, 0.0)?;
    state.totals()?;
    let mut seconds = [0.0; RUNS];
    for run in &mut seconds {
        let start = Instant::now();
        state.go_on(steps)?;
        state.totals()?;
        *run = start.elapsed().as_secs_f64() / steps as f64;
    }
    seconds.sort_by(f64::total_cmp);
    Ok(seconds[RUNS / 2])
}
