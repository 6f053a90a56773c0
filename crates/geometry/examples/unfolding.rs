//! Measures the steps and seconds needed to straighten Fermat spirals, by number of segments.
//!
//! `cargo run --release -p foldmotion-geometry --example unfolding -- 100 200 400`

use std::time::Instant;

use foldmotion_geometry::unfolding::{Chain, certify, straighten};
use glam::DVec2;

#[expect(clippy::print_stdout, reason = "an example prints")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    for count in std::env::args().skip(1) {
        let count: i32 = count.parse()?;
        let points: Vec<DVec2> = (-count / 2..=count / 2).map(|k| spiral(k, count / 2)).collect();
        let chain = Chain::new(&points, false)?;
        let started = Instant::now();
        let uniform = certify(&chain, chain.turns(), &vec![0.0; chain.turns().len()]);
        println!("{count} segments, uniform: {uniform:?} in {:.2?}", started.elapsed());
        let started = Instant::now();
        let path = straighten(&chain)?;
        println!(
            "{count} segments, energy: {} steps, {} knots in {:.2?}",
            path.steps,
            path.turns.len(),
            started.elapsed()
        );
    }
    Ok(())
}

/// Point k of r = √θ, both arms to θ = 6π at k = ±half, at equal steps of arc length up to O(1/θ²).
fn spiral(k: i32, half: i32) -> DVec2 {
    let share = f64::from(k.abs()) / f64::from(half);
    let angle = 6.0 * std::f64::consts::PI * share.powf(2.0 / 3.0);
    DVec2::from_angle(angle) * angle.sqrt() * f64::from(k.signum())
}
