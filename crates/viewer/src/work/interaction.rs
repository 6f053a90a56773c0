//! Moving the sheet by sheet: a thread in which it follows the user.

use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::{JoinHandle, sleep};
use std::time::{Duration, Instant};

use foldmotion_solver::dynamic::{InteractiveSheet, Pull};
use foldmotion_study::Study;
use glam::DVec3;

use super::lock::lock;
use super::threads::{in_thread_pool, join_briefly, start};
use super::{RepaintSignal, StateFeed, WorkError};

/// The largest change of the motion time per second.
const SPEED: f64 = 1.5;
/// The interval between states that are shown.
const TICK: Duration = Duration::from_millis(8);
/// Steps of the engine between two looks at the clock.
const STEPS: usize = 40;

/// A sheet that follows the user in the background. Dropping it ends the interaction.
#[derive(Debug)]
pub(crate) struct Interaction {
    shared: Arc<Shared>,
    states: StateFeed,
    thread: Option<JoinHandle<()>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct InteractionStatus {
    /// The current motion time.
    pub(crate) time: f64,
    /// Whether the sheet has come to rest.
    pub(crate) is_at_rest: bool,
    /// How often the sheet became unstable and was reset to its last stable state.
    pub(crate) resets: u32,
    /// The largest difference of a fold angle from its target, radians.
    pub(crate) fold_angle_error: f64,
}

#[derive(Debug)]
struct Shared {
    request: Mutex<Request>,
    requested: Condvar,
    status: Mutex<InteractionStatus>,
    error: Mutex<Option<WorkError>>,
    repaint: RepaintSignal,
}

/// What the user wants the sheet to do.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Request {
    /// Counts the requests.
    serial: u64,
    target_time: f64,
    pull: Option<Pull>,
    is_stopped: bool,
}

impl Interaction {
    /// Starts at motion time and positions `from` (one position per vertex, in the sheet's unit), or in the first state
    /// of the motion of `study`.
    pub(crate) fn start(
        study: Arc<Study>,
        from: Option<(f64, Vec<DVec3>)>,
        repaint: RepaintSignal,
    ) -> Self {
        let (time, positions) = from.unwrap_or_else(|| {
            let subject = &study.subject;
            (subject.start_time(), subject.start().into_owned())
        });
        let request = Request { serial: 0, target_time: time, pull: None, is_stopped: false };
        let status = InteractionStatus { time, ..InteractionStatus::default() };
        let shared = Arc::new(Shared {
            request: Mutex::new(request),
            requested: Condvar::new(),
            status: Mutex::new(status),
            error: Mutex::new(None),
            repaint,
        });
        let states = StateFeed::default();
        let (working, shown) = (Arc::clone(&shared), states.clone());
        let thread = start("foldmotion interaction", move || {
            if let Err(error) = in_thread_pool(|| working.run(&study, time, &positions, &shown)) {
                working.fail(error);
            }
        });
        let thread = thread.map_err(|error| shared.fail(error)).ok();
        Self { shared, states, thread }
    }

    /// Requests a motion time.
    pub(crate) fn set_target_time(&self, time: f64) {
        self.shared.change_request(|request| request.target_time = time);
    }

    /// Pulls `vertex` towards `point`, in the sheet's unit, or releases it.
    pub(crate) fn pull(&self, pull: Option<(u32, DVec3)>) {
        let pull = pull.map(|(vertex, point)| Pull { vertex, point });
        self.shared.change_request(|request| request.pull = pull);
    }

    pub(crate) fn states(&self) -> &StateFeed {
        &self.states
    }

    pub(crate) fn status(&self) -> InteractionStatus {
        *lock(&self.shared.status)
    }

    /// The error that ended the interaction; `None` if there is none or it was taken before.
    pub(crate) fn take_error(&self) -> Option<WorkError> {
        lock(&self.shared.error).take()
    }
}

impl Shared {
    /// Changes the request; a change without effect does not wake a sheet at rest.
    fn change_request(&self, change: impl FnOnce(&mut Request)) {
        let mut request = lock(&self.request);
        let before = *request;
        change(&mut request);
        if *request == before {
            return;
        }
        request.serial += 1;
        drop(request);
        self.requested.notify_one();
    }

    fn fail(&self, error: WorkError) {
        *lock(&self.error) = Some(error);
        self.repaint.send();
    }

    /// The current request; at rest, waits until it differs from number `known`.
    fn next(&self, is_at_rest: bool, known: u64) -> Request {
        let mut request = lock(&self.request);
        while is_at_rest && request.serial == known && !request.is_stopped {
            let waited = self.requested.wait(request);
            request = waited.unwrap_or_else(PoisonError::into_inner);
        }
        *request
    }

    /// Moves the sheet until the interaction ends.
    fn run(
        &self,
        study: &Study,
        time: f64,
        start: &[DVec3],
        states: &StateFeed,
    ) -> Result<(), WorkError> {
        let stages = study.subject.stages();
        let mut sheet = InteractiveSheet::new(&study.model, &study.schedule, stages, start, time)?;
        let (mut target_time, mut serial, mut is_at_rest) = (sheet.time(), 0, false);
        loop {
            let request = self.next(is_at_rest, serial);
            if request.is_stopped {
                return Ok(());
            }
            if request.serial != serial {
                serial = request.serial;
                sheet.pull(request.pull);
            }
            let started = Instant::now();
            if request.target_time.is_finite() && target_time != request.target_time {
                let most = SPEED * TICK.as_secs_f64();
                target_time += (request.target_time - target_time).clamp(-most, most);
                sheet.aim(target_time);
            }
            self.tick(&mut sheet, started);
            is_at_rest = sheet.is_at_rest()
                && (target_time == request.target_time || !request.target_time.is_finite());
            self.show(&sheet, is_at_rest, states);
            sleep(TICK.saturating_sub(started.elapsed()));
        }
    }

    /// Advances the engine for one interval.
    fn tick(&self, sheet: &mut InteractiveSheet<'_>, started: Instant) {
        while started.elapsed() < TICK && !sheet.is_at_rest() {
            if sheet.advance(STEPS).is_err() {
                lock(&self.status).resets += 1;
                // The engine has released the vertex; the old request must not grab it again.
                lock(&self.request).pull = None;
                self.repaint.send();
            }
        }
    }

    fn show(&self, sheet: &InteractiveSheet<'_>, is_at_rest: bool, states: &StateFeed) {
        let mut status = lock(&self.status);
        status.time = sheet.time();
        status.is_at_rest = is_at_rest;
        status.fold_angle_error = sheet.fold_angle_error();
        drop(status);
        if is_at_rest {
            states.publish(sheet.time(), sheet.positions());
            self.repaint.send();
        } else if states.publish_limited(sheet.time(), || sheet.positions()) {
            self.repaint.send_limited();
        }
    }
}

impl Drop for Interaction {
    fn drop(&mut self) {
        self.shared.change_request(|request| request.is_stopped = true);
        join_briefly(self.thread.take());
    }
}

#[cfg(test)]
mod tests {
    use super::super::job::tests::wait;
    use super::super::run::tests::source;
    use super::*;

    fn study() -> Arc<Study> {
        Arc::new(Study::resolve(&source("")).unwrap())
    }

    fn settled(interaction: &Interaction, time: f64) -> Arc<Vec<DVec3>> {
        wait(|| {
            let status = interaction.status();
            status.is_at_rest && status.time == time
        });
        wait(|| interaction.states().latest().is_some_and(|state| state.time == time));
        interaction.states().latest().unwrap().positions
    }

    #[test]
    fn the_sheet_follows_the_requested_time_and_a_pull() {
        let study = study();
        let interaction = Interaction::start(Arc::clone(&study), None, RepaintSignal::new(|| {}));
        let start = settled(&interaction, 0.0);
        interaction.set_target_time(2.0);
        settled(&interaction, 2.0);
        assert!(interaction.status().fold_angle_error < 1e-2);
        assert_eq!(interaction.status().resets, 0);
        assert!(interaction.take_error().is_none());
        interaction.set_target_time(1.5);
        let middle = settled(&interaction, 1.5);
        let point = middle[0] + DVec3::Z * study.subject.sheet().unit_length;
        interaction.pull(Some((0, point)));
        wait(|| {
            interaction.states().latest().unwrap().positions[0].distance(point)
                < 0.99 * middle[0].distance(point)
        });
        interaction.pull(None);
        assert_eq!(start.len(), settled(&interaction, 1.5).len());
    }

    #[test]
    fn a_sheet_at_rest_is_not_woken_by_the_same_request() {
        let interaction = Interaction::start(study(), None, RepaintSignal::new(|| {}));
        settled(&interaction, 0.0);
        let requested = || lock(&interaction.shared.request).serial;
        let before = requested();
        interaction.set_target_time(0.0);
        interaction.pull(None);
        assert_eq!(requested(), before);
        interaction.set_target_time(0.25);
        assert_eq!(requested(), before + 1);
    }

    #[test]
    fn an_interaction_starts_in_any_state_and_a_wrong_one_is_an_error() {
        let study = study();
        let folded = study.compute(&|_, _| true).unwrap();
        let frame = folded.motion.frames[30].clone();
        let from = Some((frame.time, frame.positions.clone()));
        let interaction = Interaction::start(Arc::clone(&study), from, RepaintSignal::new(|| {}));
        let settled = settled(&interaction, frame.time);
        let apart = settled.iter().zip(&frame.positions);
        let apart = apart.map(|(p, q)| p.distance(*q)).fold(0.0, f64::max);
        assert!(apart < 0.05 * study.subject.sheet().unit_length, "{apart}");
        let interaction =
            Interaction::start(study, Some((0.5, vec![DVec3::ZERO])), RepaintSignal::new(|| {}));
        wait(|| interaction.take_error().is_some());
    }
}
