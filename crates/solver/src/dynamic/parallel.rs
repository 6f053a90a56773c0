//! When a pass is worth its threads.

use rayon::prelude::*;

/// Sheets below this many nodes are stepped on one thread: a pass over fewer lasts some hundred microseconds, of which
/// waking other threads four times a step would take a fair share.
pub(super) const MIN_NODES: usize = 4_000;

/// Elements a thread takes at a time.
const CHUNK: usize = 512;

/// Overwrites every entry of `out` by `write(index, entry)`, on all threads where `is_parallel`.
///
/// Every entry is written by one thread from shared input, so the result does not depend on their number.
pub(super) fn fill<T: Send>(
    is_parallel: bool,
    out: &mut [T],
    write: impl Fn(usize, &mut T) + Sync + Send,
) {
    if is_parallel {
        out.par_iter_mut()
            .with_min_len(CHUNK)
            .enumerate()
            .for_each(|(index, entry)| write(index, entry));
    } else {
        for (index, entry) in out.iter_mut().enumerate() {
            write(index, entry);
        }
    }
}
