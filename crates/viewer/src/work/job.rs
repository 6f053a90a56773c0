//! A background job: its progress, its result, and stopping it.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;

use foldmotion_study::Phase;

use super::lock::lock;
use super::threads::{in_thread_pool, join_briefly, start};
use super::{RepaintSignal, WorkError};

/// The progress of a job.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Progress {
    /// The current phase; `None` before the job has begun.
    pub(crate) phase: Option<Phase>,
    /// The fraction of the phase that is done, from 0 to 1.
    pub(crate) done: f64,
}

/// A background job with a result `T`. Dropping it stops it.
#[derive(Debug)]
pub(crate) struct Job<T> {
    shared: Arc<Shared<T>>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Debug)]
struct Shared<T> {
    progress: Mutex<Progress>,
    is_stopped: AtomicBool,
    outcome: Mutex<Option<Result<T, WorkError>>>,
    is_done: AtomicBool,
    repaint: RepaintSignal,
}

/// Reports the progress of a job; returns whether to continue.
pub(super) type Report<'a> = &'a (dyn Fn(Phase, f64) -> bool + Sync);

impl<T: Send + 'static> Job<T> {
    /// Starts `work` on threads of its own.
    pub(super) fn start(
        name: &str,
        repaint: RepaintSignal,
        work: impl FnOnce(Report<'_>) -> Result<T, WorkError> + Send + 'static,
    ) -> Self {
        let shared = Arc::new(Shared {
            progress: Mutex::default(),
            is_stopped: AtomicBool::new(false),
            outcome: Mutex::new(None),
            is_done: AtomicBool::new(false),
            repaint,
        });
        let working = Arc::clone(&shared);
        let thread = start(name, move || {
            let report = |phase, done| working.report(phase, done);
            let outcome = in_thread_pool(|| work(&report));
            working.finish(outcome);
        });
        let thread = thread.map_err(|error| shared.finish(Err(error))).ok();
        Self { shared, thread }
    }
}

impl<T> Shared<T> {
    fn report(&self, phase: Phase, done: f64) -> bool {
        *lock(&self.progress) = Progress { phase: Some(phase), done: done.clamp(0.0, 1.0) };
        self.repaint.send_limited();
        !self.is_stopped.load(Ordering::Relaxed)
    }

    fn finish(&self, outcome: Result<T, WorkError>) {
        *lock(&self.outcome) = Some(outcome);
        self.is_done.store(true, Ordering::Release);
        self.repaint.send();
    }
}

impl<T> Job<T> {
    pub(crate) fn progress(&self) -> Progress {
        *lock(&self.shared.progress)
    }

    pub(crate) fn is_done(&self) -> bool {
        self.shared.is_done.load(Ordering::Acquire)
    }

    /// Asks the job to stop; its result is then [`WorkError::Stopped`].
    pub(crate) fn stop(&self) {
        self.shared.is_stopped.store(true, Ordering::Relaxed);
    }

    /// The result, once the job has ended; `None` if it was taken before.
    pub(crate) fn take(&self) -> Option<Result<T, WorkError>> {
        lock(&self.shared.outcome).take()
    }
}

impl<T> Drop for Job<T> {
    fn drop(&mut self) {
        self.stop();
        join_briefly(self.thread.take());
    }
}

#[cfg(test)]
pub(super) mod tests {
    use std::thread::sleep;
    use std::time::{Duration, Instant};

    use super::*;

    /// Waits until `is_so`, with a time limit.
    pub(in crate::work) fn wait(is_so: impl Fn() -> bool) {
        let started = Instant::now();
        while !is_so() {
            assert!(started.elapsed() < Duration::from_mins(2), "it never came");
            sleep(Duration::from_millis(1));
        }
    }

    fn quiet() -> RepaintSignal {
        RepaintSignal::new(|| {})
    }

    #[test]
    fn a_job_reports_progress_requests_repaints_and_gives_its_result_once() {
        let woken = Arc::new(AtomicBool::new(false));
        let seen = Arc::clone(&woken);
        let repaint = RepaintSignal::new(move || seen.store(true, Ordering::Relaxed));
        let job = Job::start("job", repaint, |report| {
            assert!(report(Phase::Check, 0.25));
            Ok(7)
        });
        wait(|| job.is_done());
        assert_eq!(job.progress().phase, Some(Phase::Check));
        assert_eq!(job.progress().done, 0.25);
        assert!(matches!(job.take(), Some(Ok(7))));
        assert!(job.take().is_none() && job.is_done());
        assert!(woken.load(Ordering::Relaxed));
    }

    #[test]
    fn a_panic_is_an_error_with_its_message() {
        let job: Job<()> = Job::start("job", quiet(), |_| panic!("out of {}", "luck"));
        wait(|| job.is_done());
        let text = job.take().unwrap().unwrap_err().to_string();
        assert!(text.contains("out of luck"), "{text}");
    }

    #[test]
    fn a_job_that_is_stopped_or_dropped_ends() {
        let endless = |report: Report<'_>| {
            while report(Phase::Fold, 0.0) {
                sleep(Duration::from_millis(1));
            }
            Err::<(), _>(WorkError::Stopped)
        };
        let job = Job::start("job", quiet(), endless);
        job.stop();
        wait(|| job.is_done());
        assert!(matches!(job.take(), Some(Err(WorkError::Stopped))));
        let job = Job::start("job", quiet(), endless);
        let shared = Arc::clone(&job.shared);
        drop(job);
        wait(|| shared.is_done.load(Ordering::Relaxed));
    }
}
