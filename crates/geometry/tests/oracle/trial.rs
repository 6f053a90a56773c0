//! Tests of kernels: their answers compared with those of the oracle, counted by class.

use std::fmt;

use foldmotion_geometry::collide::{
    Impact, ImpactSearch, Limits, MovingPair, Outcome, PairPose, Side, certify, edge_edge,
    vertex_facet,
};
use rayon::prelude::*;

use super::{
    contact::{Path, Query, are_deeper_than},
    queries::{Class, queries_of, query, start_in_contact, triangles},
};

/// Whether features may meet, according to a kernel.
pub(crate) type Kernel = fn(&Query) -> bool;

/// The results for the queries of a class.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Tally {
    pub(crate) queries: u64,
    pub(crate) meets: u64,
    pub(crate) said_to_meet: u64,
    /// Queries that meet, but are said never to.
    pub(crate) false_negatives: u64,
    /// Queries that never meet, but are not said so.
    pub(crate) false_positives: u64,
}

/// The results for the triangle pairs of a class.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct PairTally {
    pub(crate) pairs: u64,
    pub(crate) meets: u64,
    pub(crate) free: u64,
    pub(crate) touching: u64,
    pub(crate) crossed: u64,
    pub(crate) undecided: u64,
    /// Pairs that meet, but are certified free.
    pub(crate) free_but_meeting: u64,
    /// Pairs deeper than τ at some instant, but certified.
    pub(crate) passed_but_deep: u64,
    /// Pairs never within 2 τ, but not certified free.
    pub(crate) clear_but_refused: u64,
    /// Pairs among those that are undecided.
    pub(crate) clear_but_undecided: u64,
}

/// The kernels of this crate, with impacts at distance 0.
pub(crate) fn kernel(query: &Query) -> bool {
    may_meet(query, 0.0)
}

/// Whether features may come within the separation, according to the kernels of this crate.
pub(crate) fn may_meet(query: &Query, separation: f64) -> bool {
    answer(query, separation) != Impact::Never
}

/// The answer of the kernels of this crate.
pub(crate) fn answer(query: &Query, separation: f64) -> Impact {
    let search = ImpactSearch { separation, ..ImpactSearch::default() };
    match *query {
        Query::VertexFacet(vertex, facet) => vertex_facet(vertex, facet, &search),
        Query::EdgeEdge(a, b) => edge_edge(a, b, &search),
    }
}

impl Tally {
    pub(crate) fn count(mut self, query: &Query, kernel: Kernel) -> Self {
        let (meets, said) = (query.meets(), kernel(query));
        self.queries += 1;
        self.meets += u64::from(meets);
        self.said_to_meet += u64::from(said);
        self.false_negatives += u64::from(meets && !said);
        self.false_positives += u64::from(!meets && said);
        self
    }

    pub(crate) fn plus(self, other: Self) -> Self {
        Self {
            queries: self.queries + other.queries,
            meets: self.meets + other.meets,
            said_to_meet: self.said_to_meet + other.said_to_meet,
            false_negatives: self.false_negatives + other.false_negatives,
            false_positives: self.false_positives + other.false_positives,
        }
    }
}

/// Tests a kernel on queries `0..count` of a class.
pub(crate) fn try_queries(class: Class, count: u64, kernel: Kernel) -> Tally {
    (0..count)
        .into_par_iter()
        .fold(Tally::default, |tally, number| tally.count(&query(class, number), kernel))
        .reduce(Tally::default, Tally::plus)
}

/// Tests a kernel and the certificate on triangle pairs `0..count` of a class: fifteen queries each.
pub(crate) fn try_pairs(class: Class, count: u64, kernel: Kernel) -> (Tally, PairTally) {
    let none = || (Tally::default(), PairTally::default());
    (0..count)
        .into_par_iter()
        .fold(none, |(tally, pairs), number| {
            let both = triangles(class, number);
            let queries = queries_of(&both);
            let own = queries.iter().fold(Tally::default(), |t, q| t.count(q, kernel));
            let meets = own.meets > 0 || start_in_contact(&both);
            (tally.plus(own), pairs.count(&both, &queries, meets))
        })
        .reduce(none, |(t, p), (u, q)| (t.plus(u), p.plus(q)))
}

/// τ is a millionth of the extent.
pub(crate) fn limits_of(triangles: &[[Path; 3]; 2]) -> Limits {
    let corners = triangles.iter().flatten().flatten();
    let extent = corners.map(|p| p.length()).fold(0.0, f64::max);
    Limits { tolerance: 1e-6 * extent, margin: Limits::margin_for(extent), budget: 4000 }
}

/// The pair in the form that the certificate takes.
pub(crate) fn moving([a, b]: &[[Path; 3]; 2]) -> MovingPair {
    let pose =
        |end: usize| PairPose { a: a.map(|path| path[end]), b: b.map(|path| path[end]), shared: 0 };
    MovingPair::new(pose(0), pose(1))
}

impl PairTally {
    fn count(mut self, both: &[[Path; 3]; 2], queries: &[Query], meets: bool) -> Self {
        let (pair, limits) = (moving(both), limits_of(both));
        self.pairs += 1;
        self.meets += u64::from(meets);
        // `None`: deeper than τ at the start, which is a crossing.
        let outcome =
            Side::at_start(&pair.start, &limits).map(|side| certify(&pair, &side, &limits));
        let (mut passed, mut free, mut undecided) = (false, false, false);
        match outcome {
            Some(Outcome::Passed(passage)) => {
                passed = true;
                free = !passage.in_contact || passage.clearance > 0.0;
                self.free += u64::from(free);
                self.touching += u64::from(!free);
            }
            Some(Outcome::Undecided { .. }) => {
                undecided = true;
                self.undecided += 1;
            }
            Some(Outcome::Crossed(_)) | None => self.crossed += 1,
        }
        self.free_but_meeting += u64::from(meets && free);
        let is_deep = || {
            let deep = |eighths| are_deeper_than(limits.tolerance, &both[0], &both[1], eighths);
            (0..=8).any(deep)
        };
        self.passed_but_deep += u64::from(passed && meets && is_deep());
        let near = 2.0 * limits.tolerance;
        if !meets && !free && !queries.iter().any(|q| may_meet(q, near)) {
            self.clear_but_refused += 1;
            self.clear_but_undecided += u64::from(undecided);
        }
        self
    }

    pub(crate) fn plus(self, other: Self) -> Self {
        Self {
            pairs: self.pairs + other.pairs,
            meets: self.meets + other.meets,
            free: self.free + other.free,
            touching: self.touching + other.touching,
            crossed: self.crossed + other.crossed,
            undecided: self.undecided + other.undecided,
            free_but_meeting: self.free_but_meeting + other.free_but_meeting,
            passed_but_deep: self.passed_but_deep + other.passed_but_deep,
            clear_but_refused: self.clear_but_refused + other.clear_but_refused,
            clear_but_undecided: self.clear_but_undecided + other.clear_but_undecided,
        }
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let never = self.queries - self.meets;
        let rate = 100.0 * self.false_positives as f64 / never.max(1) as f64;
        write!(
            f,
            "{:>9} {:>9} {:>9} {:>4} {:>9} {rate:>8.4}",
            self.queries, self.meets, self.said_to_meet, self.false_negatives, self.false_positives
        )
    }
}

impl fmt::Display for PairTally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{:>7} {:>7} {:>7} {:>8} {:>7} {:>9} {:>5} {:>5} {:>7} {:>9}",
            self.pairs,
            self.meets,
            self.free,
            self.touching,
            self.crossed,
            self.undecided,
            self.free_but_meeting,
            self.passed_but_deep,
            self.clear_but_refused,
            self.clear_but_undecided
        )
    }
}
