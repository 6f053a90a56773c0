//! Requests to repaint the window when there is something new to show.

use std::fmt;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use super::lock::lock;

/// The shortest interval between limited requests: shorter than a frame of any screen.
const SPACING: Duration = Duration::from_micros(8_333);

/// Requests a repaint of the window. Clones share the limit.
#[derive(Clone)]
pub(crate) struct RepaintSignal {
    call: Arc<dyn Fn() + Send + Sync>,
    last: Arc<Mutex<Option<Instant>>>,
}

impl RepaintSignal {
    /// Requests repaints by `call`.
    pub(crate) fn new(call: impl Fn() + Send + Sync + 'static) -> Self {
        Self { call: Arc::new(call), last: Arc::default() }
    }

    /// Requests a repaint.
    pub(crate) fn send(&self) {
        *lock(&self.last) = Some(Instant::now());
        (self.call)();
    }

    /// Requests a repaint unless the last request was less than a hundredth of a second ago. For updates that are
    /// followed by others soon.
    pub(crate) fn send_limited(&self) {
        let now = Instant::now();
        let mut last = lock(&self.last);
        if last.is_some_and(|last| now - last < SPACING) {
            return;
        }
        *last = Some(now);
        drop(last);
        (self.call)();
    }
}

impl fmt::Debug for RepaintSignal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("RepaintSignal").finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    #[test]
    fn limited_requests_have_a_bounded_rate_and_others_always_repaint() {
        let count = Arc::new(AtomicUsize::new(0));
        let counted = Arc::clone(&count);
        let repaint = RepaintSignal::new(move || {
            counted.fetch_add(1, Ordering::Relaxed);
        });
        let started = Instant::now();
        for _ in 0..10_000 {
            repaint.clone().send_limited();
        }
        let most = started.elapsed().as_micros() / SPACING.as_micros() + 1;
        let often = count.load(Ordering::Relaxed);
        assert!((1..=most as usize).contains(&often), "{often} of {most}");
        repaint.send();
        repaint.send();
        assert_eq!(count.load(Ordering::Relaxed), often + 2);
    }
}
