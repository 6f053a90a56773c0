//! The state of a run in progress, for callers that show it.

use std::fmt;

use glam::DVec3;

/// The present state of a run.
///
/// The positions are computed on request, so that a run that nobody watches does not compute them.
pub struct Snapshot<'a> {
    /// The motion time reached.
    pub time: f64,
    positions: &'a dyn Fn() -> Vec<DVec3>,
}

impl<'a> Snapshot<'a> {
    pub(crate) fn new(time: f64, positions: &'a dyn Fn() -> Vec<DVec3>) -> Self {
        Self { time, positions }
    }

    /// One position a vertex, in the sheet's unit. In a search for equilibrium the state it has come to, from which it
    /// may yet turn back.
    pub fn positions(&self) -> Vec<DVec3> {
        (self.positions)()
    }
}

impl fmt::Debug for Snapshot<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut debug = f.debug_struct("Snapshot");
        debug.field("time", &self.time).finish_non_exhaustive()
    }
}

/// Called with the state of a run; returns whether to continue.
pub type Watcher<'a> = &'a (dyn Fn(&Snapshot<'_>) -> bool + Sync);
