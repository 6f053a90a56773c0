//! A worker that only handles the latest request.

use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use super::lock::lock;
use super::threads::{catch_panic, join_briefly, start};
use super::{RepaintSignal, WorkError};

/// Turns requests `I` into results `O`. A request that arrives while it is busy replaces those that are waiting.
#[derive(Debug)]
pub(super) struct LatestWorker<I, O> {
    shared: Arc<Shared<I, O>>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Debug)]
struct Shared<I, O> {
    slots: Mutex<Slots<I, O>>,
    requested: Condvar,
    repaint: RepaintSignal,
}

#[derive(Debug)]
struct Slots<I, O> {
    request: Option<(u64, I)>,
    result: Option<(u64, Result<O, WorkError>)>,
    is_working: bool,
    is_stopped: bool,
}

impl<I: Send + 'static, O: Send + 'static> LatestWorker<I, O> {
    /// Handles requests with `work`, after no newer request has arrived for `delay`.
    pub(super) fn new(
        name: &str,
        delay: Duration,
        repaint: RepaintSignal,
        work: impl Fn(I) -> Result<O, WorkError> + Send + 'static,
    ) -> Self {
        let shared = Arc::new(Shared {
            slots: Mutex::new(Slots {
                request: None,
                result: None,
                is_working: false,
                is_stopped: false,
            }),
            requested: Condvar::new(),
            repaint,
        });
        let working = Arc::clone(&shared);
        let thread = start(name, move || {
            while let Some((serial, request)) = working.next(delay) {
                let result = catch_panic(|| work(request));
                working.finish(serial, result);
            }
        });
        let thread = thread.map_err(|error| shared.finish(0, Err(error))).ok();
        Self { shared, thread }
    }

    /// Submits a request, replacing the one that is waiting.
    pub(super) fn submit(&self, serial: u64, request: I) {
        lock(&self.shared.slots).request = Some((serial, request));
        self.shared.requested.notify_one();
    }

    /// The last result, with the serial number of its request; `None` if it was taken before.
    pub(super) fn take(&self) -> Option<(u64, Result<O, WorkError>)> {
        lock(&self.shared.slots).result.take()
    }

    /// Whether a result is still to come.
    pub(super) fn is_busy(&self) -> bool {
        let slots = lock(&self.shared.slots);
        slots.is_working || slots.request.is_some()
    }
}

impl<I, O> Shared<I, O> {
    /// Waits for a request and the delay after it; `None` when the worker is to stop.
    fn next(&self, delay: Duration) -> Option<(u64, I)> {
        let mut slots = lock(&self.slots);
        loop {
            if slots.is_stopped {
                return None;
            }
            let Some((serial, _)) = &slots.request else {
                let waited = self.requested.wait(slots);
                slots = waited.unwrap_or_else(PoisonError::into_inner);
                continue;
            };
            let serial = *serial;
            if !delay.is_zero() {
                let waited = self.requested.wait_timeout(slots, delay);
                let (woken, timeout) = waited.unwrap_or_else(PoisonError::into_inner);
                slots = woken;
                if !timeout.timed_out() {
                    continue;
                }
            }
            if slots.request.as_ref().is_some_and(|(s, _)| *s == serial) && !slots.is_stopped {
                slots.is_working = true;
                return slots.request.take();
            }
        }
    }

    fn finish(&self, serial: u64, result: Result<O, WorkError>) {
        let mut slots = lock(&self.slots);
        slots.is_working = false;
        slots.result = Some((serial, result));
        drop(slots);
        self.repaint.send();
    }
}

impl<I, O> Drop for LatestWorker<I, O> {
    fn drop(&mut self) {
        lock(&self.shared.slots).is_stopped = true;
        self.shared.requested.notify_one();
        join_briefly(self.thread.take());
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;

    use super::super::job::tests::wait;
    use super::*;

    #[test]
    fn of_requests_that_arrive_while_it_is_busy_only_the_last_is_handled() {
        let (go, may) = channel::<()>();
        let (heard, hears) = channel::<u32>();
        let latest = LatestWorker::new(
            "latest",
            Duration::ZERO,
            RepaintSignal::new(|| {}),
            move |q: u32| {
                heard.send(q).unwrap();
                may.recv().unwrap();
                Ok(q * 2)
            },
        );
        latest.submit(1, 10);
        assert_eq!(hears.recv(), Ok(10));
        (2..=9).for_each(|serial| latest.submit(serial, 10 * serial as u32));
        assert!(latest.is_busy());
        go.send(()).unwrap();
        assert_eq!(hears.recv(), Ok(90));
        go.send(()).unwrap();
        wait(|| !latest.is_busy());
        assert!(matches!(latest.take(), Some((9, Ok(180)))));
        assert!(latest.take().is_none());
    }

    #[test]
    fn after_a_panic_the_next_request_is_handled() {
        let latest = LatestWorker::new(
            "latest",
            Duration::from_millis(1),
            RepaintSignal::new(|| {}),
            |q: u32| {
                assert!(q != 1, "one is too few");
                Ok(q)
            },
        );
        latest.submit(1, 1);
        wait(|| !latest.is_busy());
        let (_, result) = latest.take().unwrap();
        assert!(result.unwrap_err().to_string().contains("one is too few"));
        latest.submit(2, 2);
        wait(|| !latest.is_busy());
        assert!(matches!(latest.take(), Some((2, Ok(2)))));
    }
}
