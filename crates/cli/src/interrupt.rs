//! Ctrl-C and other requests to end: work stops at its next report of progress, and after a second wherever it is.

use std::io::Write as _;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use foldmotion_study::{StudyError, discard_unfinished_results};

use crate::{FAILED, Failure};

/// How long work may take to stop by itself.
const PATIENCE: Duration = Duration::from_millis(500);

/// Set by Ctrl-C.
static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Whether to go on.
pub(crate) fn may_go_on() -> bool {
    !INTERRUPTED.load(Ordering::Relaxed)
}

/// Watches for requests to end.
///
/// # Errors
/// Where the system does not let it.
pub(crate) fn watch() -> Result<(), Failure> {
    ctrlc::set_handler(|| {
        let is_first = !INTERRUPTED.swap(true, Ordering::Relaxed);
        if is_first {
            thread::spawn(|| {
                thread::sleep(PATIENCE);
                end();
            });
        }
    })
    .map_err(|e| Failure {
        message: format!("Ctrl-C cannot be watched: {e}"),
        status: FAILED,
    })
}

/// Ends the process between two files at most: results that are being moved into place get there.
fn end() -> ! {
    discard_unfinished_results();
    // Nothing is left to do where even stderr is closed.
    let _ = writeln!(std::io::stderr(), "foldmotion: {}", StudyError::Interrupted);
    std::process::exit(FAILED.into());
}
