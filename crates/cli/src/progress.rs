//! Progress on stderr: a bar on a terminal, plain lines elsewhere.

use std::io::{IsTerminal as _, Write as _};
use std::sync::Mutex;

use indicatif::{ProgressBar, ProgressStyle};

/// Plain lines come at these steps of a phase.
const PLAIN_STEPS: u32 = 4;

/// Reports how much of which phase is done.
#[derive(Debug)]
pub(crate) struct Reporter {
    bar: Option<ProgressBar>,
    quiet: bool,
    /// The phase and the plain step last told.
    told: Mutex<Option<(&'static str, u32)>>,
}

impl Reporter {
    /// Silent where `quiet`.
    pub(crate) fn new(quiet: bool) -> Self {
        let terminal = std::io::stderr().is_terminal();
        let bar = (terminal && !quiet).then(|| {
            let bar = ProgressBar::new(1000);
            if let Ok(style) =
                ProgressStyle::with_template("{msg:>12} [{bar:40}] {percent:>3} %  {elapsed}")
            {
                bar.set_style(style.progress_chars("=> "));
            }
            bar
        });
        Self {
            bar,
            quiet,
            told: Mutex::new(None),
        }
    }

    /// Tells the user that `done` (0 to 1) of the phase or part `name` is done.
    #[expect(clippy::cast_sign_loss, reason = "clamped to [0, 1]")]
    pub(crate) fn report(&self, name: &'static str, done: f64) {
        if let Some(bar) = &self.bar {
            bar.set_message(name);
            bar.set_position((done.clamp(0.0, 1.0) * 1000.0).round() as u64);
            return;
        }
        if self.quiet {
            return;
        }
        let step = (done.clamp(0.0, 1.0) * f64::from(PLAIN_STEPS)).floor() as u32;
        // A poisoned lock only means that another report panicked; there is nothing to protect.
        let mut told = self
            .told
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
        if told.is_none_or(|(p, s)| p != name || s < step) {
            *told = Some((name, step));
            let _ = writeln!(std::io::stderr(), "{} {} %", name, 100 * step / PLAIN_STEPS);
        }
    }

    /// Clears the bar.
    pub(crate) fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
