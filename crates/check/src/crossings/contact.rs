//! Contacts: time intervals in which two simplices are within reach of each other.

use foldmotion_geometry::collide::{
    Limits, MovingPair, Passage, contact_times, corners_are_within, feature_distance,
};

use super::cell::{Cell, IntervalEnds};
use super::topology::Topology;

/// The state of a cell in an interval between frames.
#[derive(Debug)]
pub(super) struct CellState {
    pub(super) passages: Vec<Passage>,
    /// Whether rounding hides a passage, or the contact times are unknown.
    pub(super) is_unsure: bool,
    /// A lower bound of the distance at the end of the interval, a length; 0 if the simplices are within reach there.
    pub(super) distance: f64,
    /// Whether the simplices are within reach at the end of the interval.
    pub(super) is_near: bool,
    /// The contact times, as shares of the interval; empty until they are computed.
    pub(super) times: Vec<[f64; 2]>,
}

/// What enters the equation of a contact once it ends.
#[derive(Debug, Clone)]
pub(super) struct Contact {
    pub(super) number: u64,
    /// The motion time at which the contact begins.
    pub(super) since: f64,
    /// The motion time of the last passage; `None` if there was none.
    pub(super) passed: Option<f64>,
    /// The signed number of passages so far.
    pub(super) sum: i64,
    /// The unknown numbers of turns, with their signs.
    pub(super) terms: Vec<(u32, i64)>,
}

/// The part of a contact that lies in one interval between frames.
#[derive(Debug)]
pub(super) struct ContactInterval {
    /// The first and the last instant, as shares of the interval.
    pub(super) times: [f64; 2],
    /// Whether the contact lasts at the end of the interval.
    pub(super) is_open: bool,
    pub(super) contact: Contact,
}

impl Contact {
    pub(super) fn new(number: u64, since: f64) -> Self {
        Self { number, since, passed: None, sum: 0, terms: Vec::new() }
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
        let distance = if corners_are_within(&pose, reach) { 0.0 } else { feature_distance(&pose) };
        Self {
            is_unsure: passages.is_none(),
            passages: passages.unwrap_or_default(),
            distance,
            is_near: distance <= reach,
            times: Vec::new(),
        }
    }

    /// Finds the contact times. They include the ends of the interval exactly if the frames there show a contact.
    pub(super) fn time(&mut self, pair: &MovingPair, reach: f64, limits: &Limits) {
        let found = contact_times(pair, reach, limits);
        self.is_unsure |= found.is_none();
        let mut times = found.unwrap_or_default();
        hold(&mut times, 0.0, || feature_distance(&pair.start) <= reach);
        hold(&mut times, 1.0, || self.is_near);
        self.times = times;
    }

    /// The contact times, merged with those of the cells on the rim and with the times of passages.
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

/// Makes the contact times include an end of the interval if the frame there shows a contact.
fn hold(times: &mut Vec<[f64; 2]>, end: f64, is_near: impl Fn() -> bool) {
    if !times.iter().any(|t| t.contains(&end)) && is_near() {
        times.push([end; 2]);
        times.sort_by(|p, q| p[0].total_cmp(&q[0]));
    }
}
