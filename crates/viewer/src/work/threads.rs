//! The threads of workers.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::thread::{Builder, JoinHandle, available_parallelism, sleep};
use std::time::{Duration, Instant};

use super::WorkError;

/// How long a dropped worker is waited for: long enough for most to end, too short to be felt.
const JOIN_TIMEOUT: Duration = Duration::from_millis(100);

/// Starts a thread called `name`.
pub(super) fn start(
    name: &str,
    work: impl FnOnce() + Send + 'static,
) -> Result<JoinHandle<()>, WorkError> {
    let started = Builder::new().name(name.to_owned()).spawn(work);
    started.map_err(|e| WorkError::Thread {
        message: e.to_string(),
    })
}

/// Does `work` with one thread less than there are cores, so that the window has one.
///
/// Every piece of work has threads of its own: one that runs long would keep another waiting.
pub(super) fn in_thread_pool<T: Send>(
    work: impl FnOnce() -> Result<T, WorkError> + Send,
) -> Result<T, WorkError> {
    let cores = available_parallelism().map_or(1, usize::from);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(cores.saturating_sub(1).max(1))
        .thread_name(|index| format!("foldmotion work {index}"))
        .build()
        .map_err(|e| WorkError::Thread {
            message: e.to_string(),
        })?;
    pool.install(|| catch_panic(work))
}

/// Does `work`; a panic in it is an error.
pub(super) fn catch_panic<T>(work: impl FnOnce() -> Result<T, WorkError>) -> Result<T, WorkError> {
    // What a panic leaves half done is dropped with the work.
    catch_unwind(AssertUnwindSafe(work))
        .unwrap_or_else(|payload| Err(WorkError::of_panic(payload.as_ref())))
}

/// Waits a little for a thread that was told to stop, so that it can clean up; goes on without it where it takes longer.
pub(super) fn join_briefly(thread: Option<JoinHandle<()>>) {
    let Some(thread) = thread else { return };
    let started = Instant::now();
    while !thread.is_finished() && started.elapsed() < JOIN_TIMEOUT {
        sleep(Duration::from_millis(1));
    }
    if thread.is_finished() {
        // Its panics are catch_panic inside.
        let _ = thread.join();
    }
}
