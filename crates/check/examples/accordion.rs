//! Measures the speed of the collision check on an accordion of 400 triangles, folded in 240 intervals while it turns
//! in space.
//!
//! `cargo run --release -p foldmotion-check --example accordion`
#![expect(clippy::print_stdout, reason = "an example that reports")]

#[path = "../tests/collision/sheets.rs"]
#[expect(dead_code, reason = "shared with the tests, which use more of it")]
mod sheets;

use std::time::Instant;

use foldmotion_check::{CheckError, CollisionOptions, collisions};

fn main() -> Result<(), CheckError> {
    for gap in [1e-1, 1e-3, 1e-5, 0.0] {
        let motion = sheets::accordion(20, 10, 240, gap, 2.0);
        let started = Instant::now();
        let report = collisions(&motion, &CollisionOptions::default(), &|_| true)?;
        let seconds = started.elapsed().as_secs_f64();
        let tested = report.pairs_tested.total();
        println!(
            "gap {gap:e}: {:?} in {seconds:.2} s, {tested} pairs ({:.2e} a second), {:?}, separation {:?}, {} undecided",
            report.verdict,
            tested as f64 / seconds,
            report.decided_by,
            report.min_separation.map(|s| (s.distance, s.time)),
            report.undecided.len(),
        );
    }
    Ok(())
}
