//! The intervals between frames, and what is found in them.

use std::collections::BTreeMap;

use glam::DVec3;

use super::cell::Cell;
use super::contact::CellState;
use super::evidence::CrossingEvidence;

/// An interval with the vertices moved into general position.
#[derive(Debug)]
pub(super) struct MovedInterval {
    pub(super) times: [f64; 2],
    pub(super) positions: [Vec<DVec3>; 2],
    pub(super) states: BTreeMap<Cell, CellState>,
}

/// A passage that no push undoes.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SheetCrossing {
    /// The pairs of triangles that contain the features that meet, the smaller index first.
    pub(crate) pairs: Vec<[u32; 2]>,
    pub(crate) evidence: CrossingEvidence,
    /// The motion time at which the contact begins.
    pub(crate) since: f64,
    /// The motion time of the last passage during the contact.
    pub(crate) passed: f64,
}

/// What was found in an interval.
#[derive(Debug, Default)]
pub(crate) struct Found {
    pub(crate) crossings: Vec<SheetCrossing>,
    /// Pairs of triangles with a passage that rounding hides.
    pub(crate) unsure: Vec<[u32; 2]>,
}

/// Two frames, and the pairs of triangles to count in.
#[derive(Clone, Copy)]
pub(crate) struct Interval<'a> {
    pub(crate) times: [f64; 2],
    /// The positions at both frames, relative to the same origin.
    pub(crate) positions: [&'a [DVec3]; 2],
    /// The pairs that may be within τ of each other.
    pub(crate) near: &'a [[u32; 2]],
    /// Whether a pair is excluded from the counts.
    pub(crate) is_lost: &'a (dyn Fn([u32; 2]) -> bool + Sync),
}

impl MovedInterval {
    pub(super) fn at(&self, t: f64) -> f64 {
        let [start, end] = self.times;
        start + (end - start) * t
    }
}
