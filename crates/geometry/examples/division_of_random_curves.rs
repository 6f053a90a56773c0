//! Measures how often equal division succeeds on random curves with sharp turns, and its longest time.
//!
//! `cargo run --release -p foldmotion-geometry --example division_of_random_curves [CURVES]`: curves of 4 to 9 control
//! points in a square, open and closed, in 3 to 60 segments; those that cross themselves are skipped.

#![expect(clippy::print_stdout, reason = "it prints its figures")]

use std::time::Instant;

use foldmotion_geometry::{Closure, DivisionOptions, GeometryError, Profile, divide};
use glam::DVec2;

/// A linear congruential generator (Knuth 1997, *The Art of Computer Programming* 2, section 3.3.4): the same curves every time.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    #[expect(clippy::cast_sign_loss, reason = "a share of a count is not negative")]
    fn below(&mut self, limit: usize) -> usize {
        (self.unit() * limit as f64) as usize
    }
}

fn main() -> Result<(), GeometryError> {
    let curves = std::env::args().nth(1).and_then(|n| n.parse().ok());
    let mut random = Random(1);
    let (mut divided, mut stalled, mut slowest) = (0_u32, Vec::new(), 0.0_f64);
    for curve in 0..curves.unwrap_or(4000_u32) {
        let points: Vec<_> =
            (0..4 + random.below(6)).map(|_| DVec2::new(random.unit(), random.unit())).collect();
        let closure = [Closure::Open, Closure::Corner, Closure::Smooth][random.below(3)];
        let segments = 3 + random.below(58);
        let profile = Profile::new(&points, closure)?;
        let started = Instant::now();
        match divide(&profile, segments, &DivisionOptions::default()) {
            Ok(division) => {
                divided += 1;
                slowest = slowest.max(started.elapsed().as_secs_f64());
                if !division.converged() {
                    stalled.push((curve, closure, segments, division.max_residual));
                }
            }
            // Equal divisions of a simple curve are known to cross only once they are found.
            Err(GeometryError::PolygonCrosses { .. }) => divided += 1,
            Err(_) => {}
        }
    }
    let share = 100.0 * stalled.len() as f64 / f64::from(divided);
    println!(
        "{divided} simple curves, {} not divided: {share:.3} %; slowest {slowest:.3} s",
        stalled.len()
    );
    for (curve, closure, segments, residual) in stalled {
        println!("curve {curve}, {closure:?}, {segments} segments: |R_max| = {residual:.1e}");
    }
    Ok(())
}
