//! Progress on stderr: a bar on a terminal, plain lines elsewhere.

use std::io::{IsTerminal as _, Write as _};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::thread;
use std::time::{Duration, Instant};

use foldmotion_study::Phase;
use indicatif::{ProgressBar, ProgressStyle};

use crate::interrupt::should_continue;

/// A phase is reported in this many lines.
const PLAIN_STEPS: u32 = 4;

/// A line is printed after this time in any case, to show that work continues.
const HEARTBEAT: Duration = Duration::from_secs(4);

/// How often the bar shows the time.
const TICK: Duration = Duration::from_millis(200);

/// Reports on stderr which share of a phase is done.
#[derive(Debug)]
pub(crate) struct Reporter {
    bar: Option<ProgressBar>,
    /// What the last line said; `None` if no lines are printed.
    last: Option<Arc<Mutex<LastLine>>>,
}

/// What the last line said, and what has been done since.
#[derive(Debug)]
struct LastLine {
    started: Instant,
    phase: Option<&'static str>,
    phase_started: Instant,
    /// The number of the line within its phase, from 0 to [`PLAIN_STEPS`].
    step: u32,
    /// The share of the phase that is done, from 0 to 1.
    done: f64,
    at: Instant,
}

impl Reporter {
    /// A reporter that prints nothing if `quiet`.
    pub(crate) fn new(quiet: bool) -> Self {
        if quiet {
            return Self { bar: None, last: None };
        }
        if std::io::stderr().is_terminal() {
            return Self { bar: Some(bar()), last: None };
        }
        let now = Instant::now();
        let last = Arc::new(Mutex::new(LastLine {
            started: now,
            phase: None,
            phase_started: now,
            step: 0,
            done: 0.0,
            at: now,
        }));
        let watched = Arc::downgrade(&last);
        thread::spawn(move || repeat(&watched));
        Self { bar: None, last: Some(last) }
    }

    /// Reports that the share `done` (0 to 1) of the phase or part `name` is done.
    #[expect(clippy::cast_sign_loss, reason = "clamped to [0, 1]")]
    pub(crate) fn report(&self, name: &'static str, done: f64) {
        let done = done.clamp(0.0, 1.0);
        if let Some(bar) = &self.bar {
            if bar.message() != name {
                bar.set_message(name);
                bar.reset_eta();
            }
            bar.set_position((done * 1000.0).round() as u64);
        }
        let Some(last) = &self.last else { return };
        let mut last = lock(last);
        let step = (done * f64::from(PLAIN_STEPS)).floor() as u32;
        last.done = done;
        if last.phase != Some(name) {
            last.phase_started = Instant::now();
        }
        if last.phase != Some(name) || last.step < step {
            (last.phase, last.step, last.at) = (Some(name), step, Instant::now());
            let _ = writeln!(std::io::stderr(), "{} {} %", name, 100 * step / PLAIN_STEPS);
        }
    }

    /// Reports the phases of a study; returns whether to continue.
    pub(crate) fn progress(&self) -> impl Fn(Phase, f64) -> bool + Sync + '_ {
        |phase, done| {
            self.report(phase.name(), done);
            should_continue()
        }
    }

    /// Clears the bar; nothing is printed from then on.
    pub(crate) fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
        if let Some(last) = &self.last {
            lock(last).phase = None;
        }
    }
}

fn bar() -> ProgressBar {
    let bar = ProgressBar::new(1000);
    let template =
        "{msg:>12} [{bar:40}] {percent:>3} %  {elapsed}, about {eta} to the end of this phase";
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style.progress_chars("=> "));
    }
    bar.enable_steady_tick(TICK);
    bar
}

/// Prints a line whenever none was printed for [`HEARTBEAT`], until the reporter is dropped.
fn repeat(last: &Weak<Mutex<LastLine>>) {
    loop {
        thread::sleep(HEARTBEAT / 10);
        let Some(last) = last.upgrade() else { return };
        let mut last = lock(&last);
        if let Some(phase) = last.phase.filter(|_| last.at.elapsed() >= HEARTBEAT) {
            last.at = Instant::now();
            let (percent, seconds) = (100.0 * last.done, last.started.elapsed().as_secs());
            let left = match left(last.done, last.phase_started.elapsed()) {
                Some(left) => format!(", about {} s to the end of this phase", left.as_secs()),
                None => String::new(),
            };
            let _ =
                writeln!(std::io::stderr(), "{phase} {percent:.0} %, {seconds} s elapsed{left}");
        }
    }
}

/// The time left to a phase of which the share `done` took `elapsed`, if it goes on like that; `None` before it is under
/// way.
fn left(done: f64, elapsed: Duration) -> Option<Duration> {
    Duration::try_from_secs_f64(elapsed.as_secs_f64() * (1.0 - done) / done).ok()
}

fn lock(last: &Mutex<LastLine>) -> MutexGuard<'_, LastLine> {
    // A poisoned lock only means that another report panicked; there is nothing to protect.
    last.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_left_is_that_of_a_phase_that_goes_on_as_it_began() {
        let elapsed = Duration::from_secs(30);
        assert_eq!(left(0.25, elapsed), Some(Duration::from_secs(90)));
        assert_eq!(left(1.0, elapsed), Some(Duration::ZERO));
        assert_eq!(left(0.0, elapsed), None);
    }
}
