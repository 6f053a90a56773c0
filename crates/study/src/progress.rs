//! Progress reports.

use foldmotion_solver::Snapshot;

/// A part of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// Reading a scene, a pattern or a motion.
    Read,
    /// Computing the motion.
    Fold,
    /// Checking for collisions.
    Check,
    /// Verifying a certificate by the second proof.
    Verify,
    /// Writing films and files.
    Record,
}

impl Phase {
    /// The name of the phase in messages.
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

/// A function that is called with a phase and the share of it that is done, from 0 to 1; returns whether to continue.
pub type Progress<'a> = &'a (dyn Fn(Phase, f64) -> bool + Sync);

/// Observes a run. A [`Progress`] is an observer that ignores the states.
pub trait Watch: Sync {
    /// Called with the share of a phase that is done, from 0 to 1; returns whether to continue.
    fn progress(&self, phase: Phase, done: f64) -> bool;

    /// Called with each state of the engine, some hundred times a second for a small sheet. Its positions are computed on
    /// demand, in the frame of reference of the engine; [`Subject::show`](crate::Subject::show) moves them to where they
    /// are displayed.
    fn state(&self, moment: &Snapshot<'_>) {
        let _ = moment;
    }
}

impl<F: Fn(Phase, f64) -> bool + Sync> Watch for F {
    fn progress(&self, phase: Phase, done: f64) -> bool {
        self(phase, done)
    }
}
