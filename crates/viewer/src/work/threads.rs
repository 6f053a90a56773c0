//! Threads of background workers.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::thread::{Builder, JoinHandle, available_parallelism, sleep};
use std::time::{Duration, Instant};

use super::WorkError;
use crate::error::panic_message;

/// How long to wait for a worker that was dropped: long enough for most to end, too short to be noticed.
const JOIN_TIMEOUT: Duration = Duration::from_millis(100);

/// Starts a thread called `name`.
pub(super) fn start(
    name: &str,
    work: impl FnOnce() + Send + 'static,
) -> Result<JoinHandle<()>, WorkError> {
    let started = Builder::new().name(name.to_owned()).spawn(work);
    started.map_err(|e| WorkError::Thread { message: e.to_string() })
}

/// Runs `work` in a pool with one thread fewer than there are cores, which leaves one for the window.
///
/// Every job has its own pool, so that a long job does not delay another.
pub(super) fn in_thread_pool<T: Send>(
    work: impl FnOnce() -> Result<T, WorkError> + Send,
) -> Result<T, WorkError> {
    let cores = available_parallelism().map_or(1, usize::from);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(cores.saturating_sub(1).max(1))
        .thread_name(|index| format!("foldmotion work {index}"))
        .build()
        .map_err(|e| WorkError::Thread { message: e.to_string() })?;
    pool.install(|| catch_panic(work))
}

/// Runs `work` and turns a panic into an error.
pub(super) fn catch_panic<T>(work: impl FnOnce() -> Result<T, WorkError>) -> Result<T, WorkError> {
    // Whatever a panic leaves unfinished is dropped with `work`.
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|payload| {
        let message = panic_message(payload.as_ref());
        Err(WorkError::Panic { message })
    })
}

/// Waits briefly for a thread that was asked to stop, so that it can clean up.
pub(super) fn join_briefly(thread: Option<JoinHandle<()>>) {
    let Some(thread) = thread else { return };
    let started = Instant::now();
    while !thread.is_finished() && started.elapsed() < JOIN_TIMEOUT {
        sleep(Duration::from_millis(1));
    }
    if thread.is_finished() {
        // Panics are caught inside the thread.
        let _ = thread.join();
    }
}
