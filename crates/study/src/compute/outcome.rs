//! The outcome of a run, which heads every report.

use foldmotion_check::{CollisionReport, Verdict};
use foldmotion_pattern::Sheet;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fold_angles::FoldAngleReport;
use super::jam::JamReport;
use super::stop::StopReport;

/// How a motion ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum OutcomeKind {
    /// It reached its end without passing through itself, every crease near its target.
    Folded,
    /// Layers in contact keep it from its end.
    Jammed,
    /// The engine found no further equilibrium, or its budget ended first.
    Stopped,
    /// It was run to its end, but not into an equilibrium near the targets of its creases.
    NotConverged,
    /// It reached its end, but passes through itself on the way.
    Collides,
    /// It reached its end, but whether it passes through itself was not decided.
    Undecided,
}

/// How a motion ended, with the reason.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Outcome {
    /// How the motion ended. If several apply, the first of jammed, stopped, not-converged, undecided, collides.
    pub kind: OutcomeKind,
    /// The motion time of the event; for folded and not-converged, that of the last state.
    pub t: f64,
    /// The reason, in a sentence for people.
    pub reason: String,
}

impl Outcome {
    /// The exit status: 0 folded, 1 collides, 3 anything else.
    pub fn status(&self) -> u8 {
        match self.kind {
            OutcomeKind::Folded => 0,
            OutcomeKind::Collides => 1,
            _ => 3,
        }
    }

    /// Whether the motion reached its end.
    pub fn is_at_end(&self) -> bool {
        matches!(self.kind, OutcomeKind::Folded | OutcomeKind::Collides | OutcomeKind::Undecided)
    }

    /// The kind in words, with the motion time of the event.
    pub fn headline(&self) -> String {
        let at = |word: &str| format!("{word} at t = {:.4}", self.t);
        match self.kind {
            OutcomeKind::Folded => "folded".to_owned(),
            OutcomeKind::Jammed => at("jammed"),
            OutcomeKind::Stopped => at("stopped"),
            OutcomeKind::NotConverged => "did not converge".to_owned(),
            OutcomeKind::Collides => at("collides"),
            OutcomeKind::Undecided => at("undecided"),
        }
    }

    /// The headline with the reason, on one line.
    pub fn line(&self) -> String {
        format!("{}: {}", self.headline(), self.reason)
    }

    /// Derives the outcome from the findings about a motion.
    pub(crate) fn of(input: &OutcomeInput<'_>) -> Self {
        let (kind, t, reason) = input.outcome();
        Self { kind, t, reason }
    }
}

/// What an outcome depends on.
pub(crate) struct OutcomeInput<'a> {
    /// The motion time of the last state.
    pub(crate) end: f64,
    pub(crate) jam: Option<&'a JamReport>,
    pub(crate) stop: Option<&'a StopReport>,
    pub(crate) fold_angles: &'a FoldAngleReport,
    pub(crate) collision: &'a CollisionReport,
    pub(crate) sheet: &'a Sheet,
}

impl OutcomeInput<'_> {
    fn outcome(&self) -> (OutcomeKind, f64, String) {
        let so_far = self.verdict_so_far();
        if let Some(jam) = self.jam {
            let reason = format!("{}; {}; {so_far}", self.fold_angles.words(), jam.words());
            return (OutcomeKind::Jammed, jam.t, reason);
        }
        if let Some(stop) = self.stop {
            let reason = format!("{}; {so_far}", stop.words());
            return (OutcomeKind::Stopped, stop.t, reason);
        }
        if !self.fold_angles.is_folded() {
            let words = self.fold_angles.words();
            let reason = format!("the sheet is in equilibrium, but {words}; {so_far}");
            return (OutcomeKind::NotConverged, self.end, reason);
        }
        let undecided = || self.collision.undecided.iter().map(|u| u.time);
        let t = match self.collision.verdict {
            Verdict::Undecided => undecided().min_by(f64::total_cmp),
            _ => self.collision.first.as_ref().map(|first| first.time),
        };
        let kind = match self.collision.verdict {
            Verdict::Free | Verdict::Touching => OutcomeKind::Folded,
            Verdict::Penetrating => OutcomeKind::Collides,
            Verdict::Undecided => OutcomeKind::Undecided,
        };
        (kind, t.unwrap_or(self.end), self.verdict_words())
    }

    /// The verdict on a motion that did not reach its end.
    fn verdict_so_far(&self) -> String {
        let words = self.verdict_words();
        match &self.collision.first {
            Some(first) => format!("{words} (first at t = {:.4})", first.time),
            None => format!("up to that point, {words}"),
        }
    }

    /// The verdict of the collision check, in words.
    fn verdict_words(&self) -> String {
        let c = self.collision;
        match c.verdict {
            Verdict::Free => {
                "no two facets come within the tolerance of each other (free)".to_owned()
            }
            Verdict::Touching => {
                "facets touch, but none passes through another (touching)".to_owned()
            }
            Verdict::Penetrating => {
                let [a, b] = c.first.as_ref().map_or([0, 0], |first| {
                    first.faces.map(|f| self.sheet.face_facets[f as usize])
                });
                format!(
                    "facet {a} passes through facet {b}, {} pairs of triangles in all (penetrating)",
                    c.penetrations.len()
                )
            }
            Verdict::Undecided => format!(
                "whether {} pairs of triangles pass through each other was not decided (undecided)",
                c.undecided.len()
            ),
        }
    }
}
