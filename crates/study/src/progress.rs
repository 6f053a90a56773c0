//! What a run tells while it is under way.

use foldmotion_solver::Snapshot;

/// A part of a run, as progress names it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// Reading a scene, a pattern or a motion.
    Read,
    /// The engine.
    Fold,
    /// The collision check.
    Check,
    /// The second proof of a certificate.
    Verify,
    /// Films and files.
    Record,
}

impl Phase {
    /// Its name on the screen.
    pub fn name(self) -> &'static str {
        match self {
            Self::Read => "read",
            Self::Fold => "fold",
            Self::Check => "check",
            Self::Verify => "verify",
            Self::Record => "record",
        }
    }
}

/// Told how much of a phase is done, from 0 to 1; answers whether to go on.
pub type Progress<'a> = &'a (dyn Fn(Phase, f64) -> bool + Sync);

/// Watches a run. Whoever only wants its progress gives a [`Progress`].
pub trait Watch: Sync {
    /// Told how much of a phase is done, from 0 to 1; answers whether to go on.
    fn progress(&self, phase: Phase, done: f64) -> bool;

    /// Told that the engine has come to a state, some hundred times a second for a small sheet. Its positions are worked
    /// out where they are asked for. They lie where the engine has them: [`Subject::show`](crate::Subject::show) moves
    /// them to where they are shown.
    fn state(&self, moment: &Snapshot<'_>) {
        let _ = moment;
    }
}

impl<F: Fn(Phase, f64) -> bool + Sync> Watch for F {
    fn progress(&self, phase: Phase, done: f64) -> bool {
        self(phase, done)
    }
}
