//! Long work on a thread of its own, while the calling thread listens to Ctrl-C and reports progress.

use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use foldmotion_study::{Phase, Progress, StudyError};
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::error::{bad_input, exception, failed};

/// How often the calling thread listens.
const TICK: Duration = Duration::from_millis(50);

/// The stack of the working thread, that of a main thread.
const STACK: usize = 8 << 20;

/// The most threads that may be asked for, as on the command line.
const MOST_THREADS: usize = 1024;

/// How a caller wants long work to be done.
pub(crate) struct Supervision {
    /// A function that is called with the name of a phase and the share of it that is done; `False` stops the work.
    progress: Option<Py<PyAny>>,
    /// The threads to use; `None` for one a core.
    pool: Option<ThreadPool>,
}

/// What the working thread has reported last, and whether it is to stop.
#[derive(Default)]
struct Reports {
    latest: Mutex<Option<(Phase, f64)>>,
    is_stopped: AtomicBool,
}

impl Reports {
    fn report(&self, phase: Phase, done: f64) -> bool {
        *self.latest.lock().unwrap_or_else(PoisonError::into_inner) = Some((phase, done));
        !self.is_stopped.load(Ordering::Relaxed)
    }

    fn take(&self) -> Option<(Phase, f64)> {
        self.latest.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

impl Supervision {
    /// Refuses what cannot be used before any work is done.
    pub(crate) fn new(
        py: Python<'_>,
        progress: Option<Bound<'_, PyAny>>,
        threads: Option<usize>,
    ) -> PyResult<Self> {
        if progress.as_ref().is_some_and(|function| !function.is_callable()) {
            return Err(bad_input(py, "progress: expected a function of a phase and a share"));
        }
        let pool = match threads {
            None => None,
            Some(count @ 1..=MOST_THREADS) => {
                Some(ThreadPoolBuilder::new().num_threads(count).build().map_err(failed)?)
            }
            Some(count) => {
                let message = format!("threads = {count}: expected a number between 1 and 1024");
                return Err(bad_input(py, message));
            }
        };
        Ok(Self { progress: progress.map(Bound::unbind), pool })
    }

    /// Does `job` without the interpreter's lock. An exception of Ctrl-C or of `progress` stops it and is raised.
    pub(crate) fn run<T: Send>(
        &self,
        py: Python<'_>,
        job: impl FnOnce(Progress<'_>) -> Result<T, StudyError> + Send,
    ) -> PyResult<T> {
        let reports = Reports::default();
        let progress = |phase: Phase, done: f64| reports.report(phase, done);
        let work = || match &self.pool {
            Some(pool) => pool.install(|| job(&progress)),
            None => job(&progress),
        };
        let (outcome, stop) = py.detach(|| {
            thread::scope(|scope| {
                let (ended, end) = channel::<()>();
                let worker = thread::Builder::new().stack_size(STACK).spawn_scoped(scope, || {
                    let _ended = ended;
                    work()
                });
                let worker = worker.map_err(failed)?;
                let mut stop = None;
                while end.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout) {
                    if stop.is_none() {
                        stop = Python::attach(|py| self.listen(py, &reports)).err();
                        reports.is_stopped.store(stop.is_some(), Ordering::Relaxed);
                    }
                }
                let outcome = worker.join().unwrap_or_else(|panic| resume_unwind(panic));
                Ok::<_, PyErr>((outcome, stop))
            })
        })?;
        // What began before the work ended is heard, and the last report is passed on.
        stop.map_or_else(|| self.listen(py, &reports), Err)?;
        outcome.map_err(|error| exception(py, &error))
    }

    /// Raises what Ctrl-C or the progress function raises.
    fn listen(&self, py: Python<'_>, reports: &Reports) -> PyResult<()> {
        py.check_signals()?;
        let (Some(progress), Some((phase, done))) = (&self.progress, reports.take()) else {
            return Ok(());
        };
        let answer = progress.bind(py).call1((phase.name(), done))?;
        if answer.is_none() || answer.is_truthy()? {
            return Ok(());
        }
        Err(exception(py, &StudyError::Interrupted))
    }
}
