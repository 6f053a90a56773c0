//! Ctrl-C and other requests to end: work stops at its next report of progress, and after half a second in any case.

use std::io::Write as _;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use foldmotion_study::{StudyError, discard_unfinished_results};

use crate::{FAILED, Failure};

/// The time in which work may stop by itself.
const GRACE_PERIOD: Duration = Duration::from_millis(500);

/// Whether a request to end has come.
static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Whether work should continue.
pub(crate) fn should_continue() -> bool {
    !INTERRUPTED.load(Ordering::Relaxed)
}

/// Starts to watch for requests to end.
///
/// # Errors
/// The system does not allow it.
pub(crate) fn watch() -> Result<(), Failure> {
    ctrlc::set_handler(|| {
        let is_first = !INTERRUPTED.swap(true, Ordering::Relaxed);
        if is_first {
            thread::spawn(|| {
                thread::sleep(GRACE_PERIOD);
                end();
            });
        }
    })
    .map_err(|e| Failure { message: format!("Ctrl-C cannot be watched: {e}"), status: FAILED })
}

/// Ends the process, but not while results are moved into place.
fn end() -> ! {
    discard_unfinished_results();
    // If even stderr is closed, nothing can be reported.
    let _ = writeln!(std::io::stderr(), "foldmotion: {}", StudyError::Interrupted);
    std::process::exit(FAILED.into());
}
