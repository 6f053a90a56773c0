//! A sheet held in the hand: a thread that keeps it moving.

use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::{JoinHandle, sleep};
use std::time::{Duration, Instant};

use foldmotion_solver::dynamic::{Interaction, Pull};
use foldmotion_study::Study;
use glam::DVec3;

use super::lock::lock;
use super::threads::{part_from, spread, start};
use super::{Live, Wake, WorkError};

/// How fast the motion time follows the one asked for, a second.
const SPEED: f64 = 1.5;
/// How long the sheet moves before it is shown, and until it moves on.
const TICK: Duration = Duration::from_millis(8);
/// Steps between two looks at the clock.
const STEPS: usize = 40;

/// A sheet that follows a hand in the background. Dropping it lets it go.
#[derive(Debug)]
pub(crate) struct Hold {
    shared: Arc<Shared>,
    live: Live,
    thread: Option<JoinHandle<()>>,
}

/// How a held sheet is.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Held {
    /// The motion time it has reached.
    pub(crate) time: f64,
    /// Whether it has come to rest.
    pub(crate) is_at_rest: bool,
    /// How often it ran away and was taken back to its last sound state.
    pub(crate) mishaps: u32,
    /// The largest angle by which a crease misses its target, radians.
    pub(crate) fold_angle_error: f64,
}

#[derive(Debug)]
struct Shared {
    wish: Mutex<Wish>,
    wished: Condvar,
    held: Mutex<Held>,
    error: Mutex<Option<WorkError>>,
    wake: Wake,
}

/// What the hand wants.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Wish {
    /// Counts the wishes.
    serial: u64,
    aim: f64,
    pull: Option<Pull>,
    is_over: bool,
}

impl Hold {
    /// Takes the sheet of `study` in the hand: at motion time `time` in the state `positions` (one a vertex, in the sheet's
    /// unit), or in the state in which its motion starts.
    pub(crate) fn start(study: Arc<Study>, from: Option<(f64, Vec<DVec3>)>, wake: Wake) -> Self {
        let (time, positions) = from.unwrap_or_else(|| {
            let subject = &study.subject;
            (subject.start_time(), subject.start().into_owned())
        });
        let wish = Wish {
            serial: 0,
            aim: time,
            pull: None,
            is_over: false,
        };
        let held = Held {
            time,
            ..Held::default()
        };
        let shared = Arc::new(Shared {
            wish: Mutex::new(wish),
            wished: Condvar::new(),
            held: Mutex::new(held),
            error: Mutex::new(None),
            wake,
        });
        let live = Live::default();
        let (kept, shown) = (Arc::clone(&shared), live.clone());
        let thread = start("foldmotion hand", move || {
            if let Err(error) = spread(|| kept.keep(&study, time, &positions, &shown)) {
                kept.fail(error);
            }
        });
        let thread = thread.map_err(|error| shared.fail(error)).ok();
        Self {
            shared,
            live,
            thread,
        }
    }

    /// Asks for a motion time.
    pub(crate) fn aim(&self, time: f64) {
        self.shared.want(|wish| wish.aim = time);
    }

    /// Pulls `vertex` towards `point`, in the sheet's unit, or lets go.
    pub(crate) fn pull(&self, pull: Option<(u32, DVec3)>) {
        let pull = pull.map(|(vertex, point)| Pull { vertex, point });
        self.shared.want(|wish| wish.pull = pull);
    }

    /// Where the sheet is.
    pub(crate) fn live(&self) -> &Live {
        &self.live
    }

    /// How it is.
    pub(crate) fn held(&self) -> Held {
        *lock(&self.shared.held)
    }

    /// Why it moves no more, if it failed; none if that was taken before.
    pub(crate) fn take_error(&self) -> Option<WorkError> {
        lock(&self.shared.error).take()
    }
}

impl Shared {
    /// Takes note of a wish; one that changes nothing does not wake a sheet at rest.
    fn want(&self, change: impl FnOnce(&mut Wish)) {
        let mut wish = lock(&self.wish);
        let before = *wish;
        change(&mut wish);
        if *wish == before {
            return;
        }
        wish.serial += 1;
        drop(wish);
        self.wished.notify_one();
    }

    fn fail(&self, error: WorkError) {
        *lock(&self.error) = Some(error);
        self.wake.now();
    }

    /// The present wish; at rest waits for another one than `known`.
    fn next(&self, is_at_rest: bool, known: u64) -> Wish {
        let mut wish = lock(&self.wish);
        while is_at_rest && wish.serial == known && !wish.is_over {
            let waited = self.wished.wait(wish);
            wish = waited.unwrap_or_else(PoisonError::into_inner);
        }
        *wish
    }

    /// Keeps the sheet moving until it is let go.
    fn keep(
        &self,
        study: &Study,
        time: f64,
        start: &[DVec3],
        live: &Live,
    ) -> Result<(), WorkError> {
        let stages = study.subject.stages();
        let mut hand = Interaction::new(&study.model, &study.schedule, stages, start, time)?;
        let (mut aim, mut serial, mut is_at_rest) = (hand.time(), 0, false);
        loop {
            let wish = self.next(is_at_rest, serial);
            if wish.is_over {
                return Ok(());
            }
            if wish.serial != serial {
                serial = wish.serial;
                hand.pull(wish.pull);
            }
            let started = Instant::now();
            if wish.aim.is_finite() && aim != wish.aim {
                let most = SPEED * TICK.as_secs_f64();
                aim += (wish.aim - aim).clamp(-most, most);
                hand.aim(aim);
            }
            self.tick(&mut hand, started);
            is_at_rest = hand.is_at_rest() && (aim == wish.aim || !wish.aim.is_finite());
            self.show(&hand, is_at_rest, live);
            sleep(TICK.saturating_sub(started.elapsed()));
        }
    }

    /// Moves the sheet for a while.
    fn tick(&self, hand: &mut Interaction<'_>, started: Instant) {
        while started.elapsed() < TICK && !hand.is_at_rest() {
            if hand.advance(STEPS).is_err() {
                lock(&self.held).mishaps += 1;
                // The hand has let go; what it wanted before must not take hold again.
                lock(&self.wish).pull = None;
                self.wake.now();
            }
        }
    }

    fn show(&self, hand: &Interaction<'_>, is_at_rest: bool, live: &Live) {
        let mut held = lock(&self.held);
        held.time = hand.time();
        held.is_at_rest = is_at_rest;
        held.fold_angle_error = hand.fold_angle_error();
        drop(held);
        if is_at_rest {
            live.show_last(hand.time(), hand.positions());
            self.wake.now();
        } else if live.show(hand.time(), || hand.positions()) {
            self.wake.soon();
        }
    }
}

impl Drop for Hold {
    fn drop(&mut self) {
        self.shared.want(|wish| wish.is_over = true);
        part_from(self.thread.take());
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

    fn settled(hold: &Hold, time: f64) -> Arc<Vec<DVec3>> {
        wait(|| {
            let held = hold.held();
            held.is_at_rest && held.time == time
        });
        wait(|| hold.live().newer(0).is_some_and(|state| state.time == time));
        hold.live().newer(0).unwrap().positions
    }

    #[test]
    fn a_held_sheet_follows_the_time_asked_for_and_a_pull() {
        let study = study();
        let hold = Hold::start(Arc::clone(&study), None, Wake::new(|| {}));
        let start = settled(&hold, 0.0);
        hold.aim(2.0);
        settled(&hold, 2.0);
        assert!(hold.held().fold_angle_error < 1e-2);
        assert_eq!(hold.held().mishaps, 0);
        assert!(hold.take_error().is_none());
        hold.aim(1.5);
        let middle = settled(&hold, 1.5);
        let point = middle[0] + DVec3::Z * study.subject.sheet().unit_length;
        hold.pull(Some((0, point)));
        wait(|| {
            hold.live().newer(0).unwrap().positions[0].distance(point)
                < 0.99 * middle[0].distance(point)
        });
        hold.pull(None);
        assert_eq!(start.len(), settled(&hold, 1.5).len());
    }

    #[test]
    fn a_sheet_at_rest_is_not_woken_by_the_same_wish_again() {
        let hold = Hold::start(study(), None, Wake::new(|| {}));
        settled(&hold, 0.0);
        let wished = || lock(&hold.shared.wish).serial;
        let before = wished();
        hold.aim(0.0);
        hold.pull(None);
        assert_eq!(wished(), before);
        hold.aim(0.25);
        assert_eq!(wished(), before + 1);
    }

    #[test]
    fn a_sheet_is_taken_up_in_any_state_and_a_wrong_one_is_an_error() {
        let study = study();
        let folded = study.compute(&|_, _| true).unwrap();
        let frame = folded.motion.frames[30].clone();
        let from = Some((frame.time, frame.positions.clone()));
        let hold = Hold::start(Arc::clone(&study), from, Wake::new(|| {}));
        let settled = settled(&hold, frame.time);
        let apart = settled.iter().zip(&frame.positions);
        let apart = apart.map(|(p, q)| p.distance(*q)).fold(0.0, f64::max);
        assert!(apart < 0.05 * study.subject.sheet().unit_length, "{apart}");
        let hold = Hold::start(study, Some((0.5, vec![DVec3::ZERO])), Wake::new(|| {}));
        wait(|| hold.take_error().is_some());
    }
}
