//! Equal division: the nine profiles of table 1, and how the cost grows with the number of segments.
//!
//! `cargo bench -p foldmotion-pattern`

#![expect(clippy::unwrap_used, reason = "a bench stops where a profile is broken")]

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use foldmotion_geometry::{DivisionOptions, divide};
use foldmotion_pattern::find_model;

fn main() {
    divan::main();
}

/// Rows as in table 1.
#[divan::bench(args = [
    "shelter", "chair", "rolling-paper", "fermat-spiral", "omega", "mushroom", "whale", "airfoil",
    "bunny",
])]
fn table_1(bencher: Bencher<'_, '_>, name: &str) {
    let model = find_model(name).unwrap();
    let profile = model.profile().unwrap();
    let options = DivisionOptions::default();
    bencher.bench(|| divide(black_box(&profile), model.rows, &options));
}

/// Linear: the throughput in segments a second stays the same.
#[divan::bench(args = [100, 1_000, 10_000, 100_000])]
fn omega_in_segments(bencher: Bencher<'_, '_>, segments: usize) {
    let profile = find_model("omega").unwrap().profile().unwrap();
    let options = DivisionOptions::default();
    bencher
        .counter(ItemsCount::new(segments))
        .bench(|| divide(black_box(&profile), segments, &options));
}
