//! The limits of the machine: f64 operations and bytes per second, for each number of threads.

use std::hint::black_box;

use foldmotion_solver::dynamic::instruction_set;
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

use crate::sample::median_seconds;

/// The limits for one number of threads.
pub(crate) struct Ceiling {
    pub(crate) pool: ThreadPool,
    /// Fused additions and multiplications per second, on numbers in registers.
    pub(crate) operations: f64,
    /// Bytes per second read and written by a ← b + s c over arrays much larger than the caches.
    pub(crate) bytes: f64,
}

/// The length of each array of the triad: 128 MB.
const NUMBERS: usize = 16 << 20;
/// The number of iterations of the loop of fused operations.
const ROUNDS: usize = 20_000_000;
/// The number of independent sums in the loop, which hide the latency.
const SUMS: usize = 12;

/// The limits for one thread and for all.
pub(crate) fn measure() -> Result<Vec<Ceiling>, ThreadPoolBuildError> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let mut counts = vec![1, cores];
    counts.dedup();
    counts.into_iter().map(ceiling).collect()
}

pub(crate) fn print(ceilings: &[Ceiling]) {
    println!("\n### The machine\n");
    println!("{}\n", instruction_set());
    println!("| threads | Gflop/s (fused, in registers) | GB/s (triad) |");
    println!("| --- | --- | --- |");
    for ceiling in ceilings {
        println!(
            "| {} | {:.1} | {:.1} |",
            ceiling.pool.current_num_threads(),
            ceiling.operations * 1e-9,
            ceiling.bytes * 1e-9
        );
    }
}

fn ceiling(threads: usize) -> Result<Ceiling, ThreadPoolBuildError> {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build()?;
    let operations = pool.install(|| {
        let mut operations = 0;
        let seconds = median_seconds(3, || {
            let workers = (0..threads).into_par_iter().with_max_len(1);
            operations = workers.map(|_| Arch::new().dispatch(FusedSums)).sum::<usize>();
        });
        operations as f64 / seconds
    });
    let bytes = pool.install(|| {
        let [mut a, b, c] = [0.0, 1.0, 2.0].map(|number| vec![number; NUMBERS]);
        let part = NUMBERS / threads;
        let seconds = median_seconds(5, || {
            let parts = a.par_chunks_mut(part).zip(b.par_chunks(part)).zip(c.par_chunks(part));
            parts.for_each(|((a, b), c)| {
                for ((a, b), c) in a.iter_mut().zip(b).zip(c) {
                    *a = b + 0.5 * c;
                }
            });
            black_box(&mut a);
        });
        (3 * size_of::<f64>() * NUMBERS) as f64 / seconds
    });
    Ok(Ceiling { pool, operations, bytes })
}

struct FusedSums;

impl WithSimd for FusedSums {
    /// The number of operations.
    type Output = usize;

    #[expect(clippy::inline_always, reason = "compiled for the machine's vectors")]
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> usize {
        let factor = simd.splat_f64s(black_box(0.999));
        let term = simd.splat_f64s(black_box(1e-3));
        let mut sums = [simd.splat_f64s(black_box(1.0)); SUMS];
        for _round in 0..ROUNDS / SUMS {
            for sum in &mut sums {
                *sum = simd.mul_add_e_f64s(*sum, factor, term);
            }
        }
        let mut total = 0.0;
        for sum in sums {
            total += simd.reduce_sum_f64s(sum);
        }
        black_box(total);
        2 * (ROUNDS / SUMS) * SUMS * S::F64_LANES
    }
}
