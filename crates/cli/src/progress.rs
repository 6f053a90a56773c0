//! Progress on stderr: a bar on a terminal, plain lines elsewhere.

use std::io::{IsTerminal as _, Write as _};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::thread;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// Plain lines come at these steps of a phase.
const PLAIN_STEPS: u32 = 4;

/// A plain line comes after this time too, that long work is seen to go on.
const HEARTBEAT: Duration = Duration::from_secs(10);

/// How often the bar shows the time.
const TICK: Duration = Duration::from_millis(200);

/// Reports how much of which phase is done.
#[derive(Debug)]
pub(crate) struct Reporter {
    bar: Option<ProgressBar>,
    /// What was told in plain lines; none where none are.
    told: Option<Arc<Mutex<Told>>>,
}

/// What was told last.
#[derive(Debug)]
struct Told {
    started: Instant,
    phase: Option<&'static str>,
    /// The plain step of the phase.
    step: u32,
    /// How much of the phase is done, from 0 to 1.
    done: f64,
    at: Instant,
}

impl Reporter {
    /// Silent where `quiet`.
    pub(crate) fn new(quiet: bool) -> Self {
        if quiet {
            return Self {
                bar: None,
                told: None,
            };
        }
        if std::io::stderr().is_terminal() {
            return Self {
                bar: Some(bar()),
                told: None,
            };
        }
        let now = Instant::now();
        let told = Arc::new(Mutex::new(Told {
            started: now,
            phase: None,
            step: 0,
            done: 0.0,
            at: now,
        }));
        let watched = Arc::downgrade(&told);
        thread::spawn(move || beat(&watched));
        Self {
            bar: None,
            told: Some(told),
        }
    }

    /// Tells the user that `done` (0 to 1) of the phase or part `name` is done.
    #[expect(clippy::cast_sign_loss, reason = "clamped to [0, 1]")]
    pub(crate) fn report(&self, name: &'static str, done: f64) {
        let done = done.clamp(0.0, 1.0);
        if let Some(bar) = &self.bar {
            bar.set_message(name);
            bar.set_position((done * 1000.0).round() as u64);
        }
        let Some(told) = &self.told else { return };
        let mut told = lock(told);
        let step = (done * f64::from(PLAIN_STEPS)).floor() as u32;
        told.done = done;
        if told.phase != Some(name) || told.step < step {
            (told.phase, told.step, told.at) = (Some(name), step, Instant::now());
            let _ = writeln!(std::io::stderr(), "{} {} %", name, 100 * step / PLAIN_STEPS);
        }
    }

    /// Clears the bar, and tells nothing more.
    pub(crate) fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
        if let Some(told) = &self.told {
            lock(told).phase = None;
        }
    }
}

fn bar() -> ProgressBar {
    let bar = ProgressBar::new(1000);
    let template = "{msg:>12} [{bar:40}] {percent:>3} %  {elapsed}";
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style.progress_chars("=> "));
    }
    bar.enable_steady_tick(TICK);
    bar
}

/// Tells where the work is whenever nothing was told for a while, as long as it goes on.
fn beat(told: &Weak<Mutex<Told>>) {
    loop {
        thread::sleep(HEARTBEAT / 10);
        let Some(told) = told.upgrade() else { return };
        let mut told = lock(&told);
        if let Some(phase) = told.phase.filter(|_| told.at.elapsed() >= HEARTBEAT) {
            told.at = Instant::now();
            let (percent, seconds) = (100.0 * told.done, told.started.elapsed().as_secs());
            let _ = writeln!(
                std::io::stderr(),
                "{phase} {percent:.0} %, {seconds} s so far"
            );
        }
    }
}

fn lock(told: &Mutex<Told>) -> MutexGuard<'_, Told> {
    // A poisoned lock only means that another report panicked; there is nothing to protect.
    told.lock().unwrap_or_else(PoisonError::into_inner)
}
