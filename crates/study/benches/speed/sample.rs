//! Times and fits.

use std::time::Instant;

/// The median of the seconds that `count` calls of `work` take.
pub(crate) fn median_seconds(count: usize, mut work: impl FnMut()) -> f64 {
    let mut seconds: Vec<f64> = (0..count)
        .map(|_| {
            let started = Instant::now();
            work();
            started.elapsed().as_secs_f64()
        })
        .collect();
    seconds.sort_by(f64::total_cmp);
    seconds[count / 2]
}

/// The exponent p of the power law y ~ xᵖ that fits `points` best in their logarithms.
pub(crate) fn exponent(points: &[(f64, f64)]) -> f64 {
    let logarithms = points.iter().map(|(x, y)| (x.ln(), y.ln()));
    let count = points.len() as f64;
    let (sum_x, sum_y) = logarithms.clone().fold((0.0, 0.0), |(a, b), (x, y)| (a + x, b + y));
    let (mean_x, mean_y) = (sum_x / count, sum_y / count);
    let products: f64 = logarithms.clone().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    let squares: f64 = logarithms.map(|(x, _)| (x - mean_x) * (x - mean_x)).sum();
    products / squares
}
