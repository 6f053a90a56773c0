//! Tests of the verdict and its second proof: their answers compared with the truth.

use std::fmt;

use foldmotion_check::{CheckError, CollisionOptions, CollisionReport, Verdict, collisions};
use foldmotion_pattern::Motion;
use foldmotion_verify::verify;
use rayon::prelude::*;

use super::completion::{as_motion, triangles};
use crate::{
    oracle::{
        contact::Query,
        queries::{queries_of, start_in_contact},
        trial::may_meet,
    },
    recorded::file::{QueryFile, Recorded},
};

/// A function that judges a motion.
pub(crate) type Judge = fn(&Motion) -> Result<CollisionReport, CheckError>;

/// The verdict of the first proof.
pub(crate) fn judge(motion: &Motion) -> Result<CollisionReport, CheckError> {
    collisions(motion, &CollisionOptions::default(), &|_| true)
}

/// An error in the answers to a query converted to a motion.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Failure {
    pub(crate) file: String,
    /// The first line of the query in its file.
    pub(crate) line: usize,
    pub(crate) completion: u64,
    pub(crate) kind: FailureKind,
    pub(crate) detail: String,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FailureKind {
    /// The triangles meet, but the verdict is free.
    FreeButMeeting,
    /// The triangles never meet, but the verdict is penetrating.
    PenetratingButApart,
    /// The triangles stay farther apart than 1.1 τ, but the verdict is touching.
    TouchingButApart,
    /// The triangles come nearer than the smallest separation stated, by more than a thousandth and 0.02 τ.
    SeparationTooLarge,
    /// The second proof finds a statement of the report false.
    Refuted,
    /// The second proof leaves a statement open.
    Unproved,
    /// The motion was refused.
    Refused,
}

/// The results for the queries of a file, as motions.
#[derive(Debug, Clone, Default)]
pub(crate) struct Tally {
    /// The number of motions whose triangles meet.
    pub(crate) meets: u32,
    pub(crate) free: u32,
    pub(crate) touching: u32,
    pub(crate) penetrating: u32,
    pub(crate) undecided: u32,
    pub(crate) verified: u32,
    pub(crate) failures: Vec<Failure>,
}

/// Tests a judge, and the second proof of its reports, on the queries of a file, each completed in `completions` ways.
pub(crate) fn try_motions(file: &QueryFile, completions: u64, judge: Judge) -> Tally {
    let one = |recorded| try_completions(&file.name, recorded, completions, judge);
    let tallies: Vec<Tally> = file.queries.par_iter().map(one).collect();
    tallies.into_iter().fold(Tally::default(), Tally::plus)
}

/// Tests a judge on one query.
pub(crate) fn try_completions(
    file: &str,
    recorded: &Recorded,
    completions: u64,
    judge: Judge,
) -> Tally {
    let each = (0..completions).map(|k| try_motion(file, recorded, k, judge));
    each.fold(Tally::default(), Tally::plus)
}

fn try_motion(file: &str, recorded: &Recorded, completion: u64, judge: Judge) -> Tally {
    let failure = |(kind, detail)| Failure {
        file: file.to_owned(),
        line: recorded.line,
        completion,
        kind,
        detail,
    };
    let motion = as_motion(&recorded.query, completion);
    let report = match judge(&motion) {
        Ok(report) => report,
        Err(error) => {
            let failures = vec![failure((FailureKind::Refused, error.to_string()))];
            return Tally { failures, ..Tally::default() };
        }
    };
    let truth = Truth::of(recorded, completion);
    let verification = verify(&motion, &report);
    let refuted = verification.refuted.first().map(|r| format!("{r:?}"));
    let unproved = verification.unproved.first().map(|u| format!("{u:?}"));
    let by_second = refuted
        .map(|detail| (FailureKind::Refuted, detail))
        .or_else(|| unproved.map(|detail| (FailureKind::Unproved, detail)));
    let all = truth.failures(&motion, &report).into_iter().chain(by_second);
    let is = |verdict: Verdict| u32::from(report.verdict == verdict);
    Tally {
        meets: u32::from(truth.meets),
        free: is(Verdict::Free),
        touching: is(Verdict::Touching),
        penetrating: is(Verdict::Penetrating),
        undecided: is(Verdict::Undecided),
        verified: u32::from(verification.is_verified()),
        failures: all.map(failure).collect(),
    }
}

/// The truth about two moving triangles.
struct Truth {
    queries: Vec<Query>,
    /// Whether they share a point at some instant.
    meets: bool,
}

impl Truth {
    fn of(recorded: &Recorded, completion: u64) -> Self {
        let both = triangles(&recorded.query, completion);
        let queries = queries_of(&both);
        let meets = recorded.meets || start_in_contact(&both) || queries.iter().any(Query::meets);
        Self { queries, meets }
    }

    /// Whether the triangles may come within a distance, up to the rounding of the kernels.
    fn come_within(&self, distance: f64) -> bool {
        self.meets || self.queries.iter().any(|query| may_meet(query, distance))
    }

    /// The errors of a report, compared with the truth.
    fn failures(&self, motion: &Motion, report: &CollisionReport) -> Vec<(FailureKind, String)> {
        let unit = motion.sheet.unit_length;
        let tolerance = report.tolerance * unit;
        let mut kinds = match report.verdict {
            Verdict::Free if self.meets => vec![FailureKind::FreeButMeeting],
            Verdict::Penetrating if !self.meets => vec![FailureKind::PenetratingButApart],
            Verdict::Touching if !self.come_within(1.1 * tolerance) => {
                vec![FailureKind::TouchingButApart]
            }
            _ => Vec::new(),
        };
        let separation = report.min_separation.map_or(0.0, |s| s.distance * unit);
        let surely_below = 0.999 * separation - 0.02 * tolerance;
        if surely_below > 0.0 && self.come_within(surely_below) {
            kinds.push(FailureKind::SeparationTooLarge);
        }
        let detail = format!("{:?}, {:?}", report.verdict, report.min_separation);
        kinds.into_iter().map(|kind| (kind, detail.clone())).collect()
    }
}

impl Tally {
    /// The number of errors of a kind.
    pub(crate) fn count(&self, kind: FailureKind) -> usize {
        self.failures.iter().filter(|f| f.kind == kind).count()
    }

    pub(crate) fn plus(mut self, other: Self) -> Self {
        self.failures.extend(other.failures);
        Self {
            meets: self.meets + other.meets,
            free: self.free + other.free,
            touching: self.touching + other.touching,
            penetrating: self.penetrating + other.penetrating,
            undecided: self.undecided + other.undecided,
            verified: self.verified + other.verified,
            failures: self.failures,
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { file, line, completion, kind, detail } = self;
        write!(f, "{file}:{line} completion {completion} {kind:?}: {detail}")
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{:>7} {:>7} {:>6} {:>6} {:>5} {:>4} {:>4} {:>4} {:>4} {:>8} {:>7} {:>8} {:>7}",
            self.meets,
            self.free,
            self.touching,
            self.penetrating,
            self.undecided,
            self.count(FailureKind::FreeButMeeting),
            self.count(FailureKind::PenetratingButApart),
            self.count(FailureKind::TouchingButApart),
            self.count(FailureKind::SeparationTooLarge),
            self.verified,
            self.count(FailureKind::Refuted),
            self.count(FailureKind::Unproved),
            self.count(FailureKind::Refused),
        )
    }
}
