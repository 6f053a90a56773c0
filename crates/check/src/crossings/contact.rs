//! Contacts: stretches of time in which two simplices are within reach of each other.

use foldmotion_geometry::collide::{
    Limits, MovingPair, Passage, contact_times, corners_are_within, feature_distance,
};

use super::cell::{Cell, IntervalEnds};
use super::topology::Topology;

/// A cell in an interval.
#[derive(Debug)]
pub(super) struct CellState {
    pub(super) passages: Vec<Passage>,
    /// Whether rounding hides a passage, or when they are within reach.
    pub(super) is_unsure: bool,
    /// A lower bound at the frame at the end; 0 where the simplices are within reach.
    pub(super) distance: f64,
    /// Whether the simplices are within reach at the frame at the end.
    pub(super) is_near: bool,
    /// When they are within reach, as shares of the interval; empty until asked for.
    pub(super) times: Vec<[f64; 2]>,
}

/// What is balanced when a contact ends.
#[derive(Debug, Clone)]
pub(super) struct Contact {
    pub(super) number: u64,
    /// The motion time at which it begins.
    pub(super) since: f64,
    /// The motion time of the last passage.
    pub(super) passed: Option<f64>,
    /// The signed number of passages.
    pub(super) sum: i64,
    /// Unknown numbers of turns, with their signs.
    pub(super) terms: Vec<(u32, i64)>,
}

/// A contact in an interval.
#[derive(Debug)]
pub(super) struct ContactInterval {
    /// Shares of the interval.
    pub(super) times: [f64; 2],
    /// Whether it lasts at the frame at the end.
    pub(super) is_open: bool,
    pub(super) contact: Contact,
}

impl Contact {
    pub(super) fn new(number: u64, since: f64) -> Self {
        Self {
            number,
            since,
            passed: None,
            sum: 0,
            terms: Vec::new(),
        }
    }
}

impl ContactInterval {
    pub(super) fn overlaps(&self, [from, to]: [f64; 2]) -> bool {
        self.times[0] <= to && from <= self.times[1]
    }
}

impl CellState {
    pub(super) fn new(cell: Cell, topology: &Topology, ends: IntervalEnds<'_>, reach: f64) -> Self {
        let pose = cell.moving(topology, ends).end;
        let passages = cell.passages(topology, ends);
        let distance = if corners_are_within(&pose, reach) {
            0.0
        } else {
            feature_distance(&pose)
        };
        Self {
            is_unsure: passages.is_none(),
            passages: passages.unwrap_or_default(),
            distance,
            is_near: distance <= reach,
            times: Vec::new(),
        }
    }

    /// Finds the times of contact; they end at the end of the interval exactly where the frame shows a contact.
    pub(super) fn time(&mut self, pair: &MovingPair, reach: f64, limits: &Limits) {
        let found = contact_times(pair, reach, limits);
        self.is_unsure |= found.is_none();
        let mut times = found.unwrap_or_default();
        hold(&mut times, 0.0, || feature_distance(&pair.start) <= reach);
        hold(&mut times, 1.0, || self.is_near);
        self.times = times;
    }

    /// The times of contact, joined with those of the cells on the rim and the times of passages.
    pub(super) fn all_times<'a>(&self, rim: impl Iterator<Item = &'a Self>) -> Vec<[f64; 2]> {
        if self.times == [[0.0, 1.0]] {
            return self.times.clone();
        }
        let instants = self.passages.iter().map(|p| p.times);
        let mut all: Vec<[f64; 2]> = self.times.iter().copied().chain(instants).collect();
        all.extend(rim.flat_map(|state| state.times.iter().copied()));
        all.sort_by(|p, q| p[0].total_cmp(&q[0]));
        let mut joined: Vec<[f64; 2]> = Vec::with_capacity(all.len());
        for [from, to] in all {
            match joined.last_mut() {
                Some(last) if last[1] >= from => last[1] = last[1].max(to),
                _ => joined.push([from, to]),
            }
        }
        joined
    }
}

/// Makes the times hold the end of the interval at which the frame shows a contact.
fn hold(times: &mut Vec<[f64; 2]>, end: f64, is_near: impl Fn() -> bool) {
    if !times.iter().any(|t| t.contains(&end)) && is_near() {
        times.push([end; 2]);
        times.sort_by(|p, q| p[0].total_cmp(&q[0]));
    }
}
