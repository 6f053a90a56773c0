//! The latest state of a sheet that moves in the background.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use glam::DVec3;

use super::lock::lock;

/// The shortest interval between states that are kept: shorter than a frame of any screen.
const SPACING: Duration = Duration::from_millis(8);
/// The interval over which states are counted.
const WINDOW: Duration = Duration::from_secs(1);

/// A state of the sheet.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SheetState {
    pub(crate) serial: u64,
    pub(crate) time: f64,
    /// One position per vertex, in the sheet's unit.
    pub(crate) positions: Arc<Vec<DVec3>>,
}

/// Where a worker publishes the latest state of the sheet. Clones share it.
#[derive(Debug, Clone, Default)]
pub(crate) struct StateFeed(Arc<Mutex<Inner>>);

#[derive(Debug, Default)]
struct Inner {
    state: Option<SheetState>,
    /// When the latest states were published.
    times: VecDeque<Instant>,
}

impl StateFeed {
    /// The latest state, if there is one.
    pub(crate) fn latest(&self) -> Option<SheetState> {
        lock(&self.0).state.clone()
    }

    /// The number of states in the last second.
    pub(crate) fn rate(&self) -> usize {
        let now = Instant::now();
        let inner = lock(&self.0);
        let recent = inner.times.iter().filter(|&&time| now - time < WINDOW);
        recent.count()
    }

    /// Publishes a state unless the last one is too recent; only then are `positions` computed. Returns whether it did.
    pub(super) fn publish_limited(
        &self,
        time: f64,
        positions: impl FnOnce() -> Vec<DVec3>,
    ) -> bool {
        let now = Instant::now();
        let is_due = |inner: &Inner| inner.times.back().is_none_or(|last| now - *last >= SPACING);
        if !is_due(&lock(&self.0)) {
            return false;
        }
        // The lock is not held here, so that the window does not wait for a large sheet.
        self.publish(time, positions());
        true
    }

    /// Publishes a state.
    pub(super) fn publish(&self, time: f64, positions: Vec<DVec3>) {
        let now = Instant::now();
        let mut inner = lock(&self.0);
        let serial = inner.state.as_ref().map_or(0, |state| state.serial) + 1;
        inner.state = Some(SheetState { serial, time, positions: Arc::new(positions) });
        let is_old = |first: &Instant| now - *first >= WINDOW;
        while inner.times.front().is_some_and(is_old) {
            inner.times.pop_front();
        }
        inner.times.push_back(now);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_are_numbered_bounded_in_rate_and_counted() {
        let states = StateFeed::default();
        assert!(states.latest().is_none() && states.rate() == 0);
        let started = Instant::now();
        let mut shown = 0_u64;
        while shown < 5 {
            shown += u64::from(states.publish_limited(shown as f64, || vec![DVec3::X]));
        }
        assert!(started.elapsed() >= 4 * SPACING);
        let state = states.latest().unwrap();
        assert_eq!((state.serial, state.time), (5, 4.0));
        assert!(states.rate() <= 5);
    }
}
