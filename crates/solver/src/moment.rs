//! A run as it goes: the sheet's present state, for whoever watches.

use std::fmt;

use glam::DVec3;

/// The present state of a run.
///
/// The positions are worked out when they are asked for: a run that nobody watches pays nothing for them.
pub struct Moment<'a> {
    /// The motion time reached.
    pub time: f64,
    positions: &'a dyn Fn() -> Vec<DVec3>,
}

impl<'a> Moment<'a> {
    pub(crate) fn new(time: f64, positions: &'a dyn Fn() -> Vec<DVec3>) -> Self {
        Self { time, positions }
    }

    /// One position a vertex, in the sheet's unit. In a search for equilibrium the state it has come to, from which it may
    /// yet turn back.
    pub fn positions(&self) -> Vec<DVec3> {
        (self.positions)()
    }
}

impl fmt::Debug for Moment<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut debug = f.debug_struct("Moment");
        debug.field("time", &self.time).finish_non_exhaustive()
    }
}

/// Told how a run goes; answers whether to go on.
pub type Watcher<'a> = &'a (dyn Fn(&Moment<'_>) -> bool + Sync);
