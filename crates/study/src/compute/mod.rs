//! Computes, checks and refines a motion.
//!
//! The verdict is about straight paths between frames. If a penetration is shallower than the straight paths may deviate from
//! the computed motion, or a pair could not be decided, the computed motion itself may be free of collisions: the engine then
//! runs again and records more frames there.

mod check;
pub(crate) mod engine;
pub(crate) mod fold_angles;
pub(crate) mod folded;
pub(crate) mod jam;
pub(crate) mod layers;
pub(crate) mod outcome;
pub(crate) mod path;
pub(crate) mod preview;
pub(crate) mod series;
pub(crate) mod stop;
pub(crate) mod symmetry;

use std::time::Instant;

use foldmotion_check::{Verdict, straying};
use foldmotion_pattern::{Frame, Motion};
use foldmotion_solver::Budget;

use self::engine::{EngineRun, StageSummary};
use self::fold_angles::FoldAngleReport;
use self::folded::{Findings, Folded};
use self::jam::JamReport;
use self::layers::{FoundState, LayerOrderReport, are_flat};
use self::outcome::{Outcome, OutcomeInput};
use self::path::PathReport;
use self::stop::StopCause;
use self::symmetry::SymmetryReport;
use crate::resolve::budget::MotionBudget;
use crate::resolve::subject::Subject;
use crate::{Phase, Study, StudyError, Watch};

/// The largest number of refinements; each divides the deviation of the paths by 16.
const MOST_ROUNDS: usize = 4;
/// The largest number of frames added by all refinements: if the whole motion is open, each refinement would quadruple them.
const MOST_ADDED: usize = 20_000;
/// The number of parts into which a refinement divides an interval.
const PARTS: usize = 4;
/// The safety factor of the estimated deviation: estimates as low as half of the true value were observed.
const LARGEST_STRAY: f64 = 2.0;
/// The shortest interval, in motion time, that is divided.
const SHORTEST: f64 = 1e-9;

/// A run of the engine with its check.
struct CheckedRun {
    computed: EngineRun,
    motion: Motion,
    findings: Findings,
    /// The deviation of the straight path after each frame from the computed motion.
    strays: Vec<f64>,
}

impl CheckedRun {
    /// Whether the budget ended this run before the end of `earlier`.
    fn is_cut_short(&self, earlier: &Self) -> bool {
        let end = |checked_run: &Self| checked_run.motion.frames.last().map_or(0.0, |f| f.time);
        let is_spent = |stage: &StageSummary| {
            stage.stop.is_some_and(|stop| stop.reason != StopCause::NoEquilibrium)
        };
        end(self) < end(earlier) && self.computed.stages.iter().any(is_spent)
    }
}

/// The wall-clock seconds of all runs.
#[derive(Debug, Clone, Copy, Default)]
struct Seconds {
    engine: f64,
    check: f64,
}

impl Study {
    /// Folds and checks, with more frames where the first ones leave the verdict open. Writes no files.
    ///
    /// A motion that did not converge or jammed is returned as far as it came.
    ///
    /// # Errors
    /// [`StudyError::Solver`], [`StudyError::Check`], and [`StudyError::Interrupted`] if `watch` stopped it.
    pub fn compute(&self, watch: &dyn Watch) -> Result<Folded, StudyError> {
        let budget = self.budget.map_or(Budget::Standard, MotionBudget::start);
        let mut extra_times = self.subject.times_of_interest();
        let initial = extra_times.len();
        let mut seconds = Seconds::default();
        let mut rounds = 0;
        let mut checked_run = self.checked_run(&extra_times, budget, watch, &mut seconds)?;
        loop {
            let more = self.times_between(&checked_run);
            let added = extra_times.len() - initial;
            let is_spent = rounds == MOST_ROUNDS || added + more.len() > MOST_ADDED;
            if more.is_empty() || is_spent {
                return Ok(self.folded(checked_run, rounds, added, seconds));
            }
            let before = extra_times.len();
            extra_times.extend(more);
            let refined = self.checked_run(&extra_times, budget, watch, &mut seconds)?;
            if refined.is_cut_short(&checked_run) {
                // The budget ended the refined run early, so the earlier run is the result.
                let added = before - initial;
                return Ok(self.folded(checked_run, rounds, added, seconds));
            }
            checked_run = refined;
            rounds += 1;
        }
    }

    /// Folds and checks once, with additional frames at `extra_times`.
    fn checked_run(
        &self,
        extra_times: &[f64],
        budget: Budget,
        watch: &dyn Watch,
        spent: &mut Seconds,
    ) -> Result<CheckedRun, StudyError> {
        let start = self.subject.start_time();
        let (mut computed, seconds) = timed(|| {
            self.fold(extra_times, budget, &|moment| {
                watch.state(moment);
                watch.progress(Phase::Fold, (moment.time - start) / (2.0 - start))
            })
        })?;
        spent.engine += seconds;
        let motion = self.place(std::mem::take(&mut computed.frames));
        let progress = |phase, done| watch.progress(phase, done);
        let (findings, seconds) = timed(|| self.check(&motion, &computed, &progress))?;
        spent.check += seconds;
        Ok(CheckedRun { strays: straying(&motion.frames), computed, motion, findings })
    }

    fn folded(
        &self,
        checked_run: CheckedRun,
        rounds: usize,
        added: usize,
        seconds: Seconds,
    ) -> Folded {
        let frames = &checked_run.motion.frames;
        let last = frames.last().map_or(&[][..], |f| &f.positions);
        let sheet = self.subject.sheet();
        let jam = checked_run.computed.jam.as_ref();
        let jam = jam.map(|jam| JamReport::new(jam, &self.subject));
        let stop = checked_run.computed.stages.iter().find_map(|stage| stage.stop);
        let without_contact = checked_run.computed.error_without_contact;
        let fold_angles = FoldAngleReport {
            mean_error_without_contact_deg: without_contact.map(f64::to_degrees),
            ..FoldAngleReport::new(sheet, last, self.subject.end_angles())
        };
        let outcome = Outcome::of(&OutcomeInput {
            end: frames.last().map_or(0.0, |frame| frame.time),
            jam: jam.as_ref(),
            stop: stop.as_ref(),
            fold_angles: &fold_angles,
            collision: &checked_run.findings.collision,
            sheet,
        });
        Folded {
            compact: self.subject.measured_box(last),
            layer_order: self.layer_order(&outcome),
            outcome,
            jam,
            stop,
            fold_angles,
            symmetry: match self.subject {
                Subject::Units(_) => SymmetryReport::all(&checked_run.motion),
                Subject::Imported(_) => Vec::new(),
            },
            path: self.path_report(frames, &checked_run.strays, rounds, added),
            computed: checked_run.computed,
            motion: checked_run.motion,
            findings: checked_run.findings,
            engine_seconds: seconds.engine,
            check_seconds: seconds.check,
            threads: rayon::current_num_threads(),
        }
    }

    /// What is known of the flat state of a pattern that is to fold flat, if its motion did not reach its end.
    fn layer_order(&self, outcome: &Outcome) -> Option<LayerOrderReport> {
        let imported = &self.subject.imported()?.imported;
        let targets = self.subject.end_angles();
        let is_asked = !outcome.is_at_end() && are_flat(targets);
        is_asked.then(|| FoundState::find(imported, targets).report)
    }

    /// The times of additional frames: within the intervals that could not be decided and, if every penetration is shallower
    /// than the possible deviation of the paths, within the intervals of the penetrations.
    fn times_between(&self, checked_run: &CheckedRun) -> Vec<f64> {
        let collision = &checked_run.findings.collision;
        let (frames, strays) = (&checked_run.motion.frames, &checked_run.strays);
        if !matches!(collision.verdict, Verdict::Undecided | Verdict::Penetrating) {
            return Vec::new();
        }
        let height = self.subject.sheet().unit_length;
        let mut open: Vec<usize> = collision.undecided.iter().map(|u| u.frame).collect();
        // Layers out of order are shown by one frame, so more frames would not help.
        let passed = collision.penetrations.iter().filter(|p| p.conflict.is_none());
        for penetration in passed {
            let k = penetration.frame;
            let is_of_a_frame = penetration.passed <= frames[k].time;
            let is_certain = strays
                .get(k)
                .is_none_or(|&stray| penetration.depth * height > LARGEST_STRAY * stray);
            if is_of_a_frame || is_certain {
                return Vec::new();
            }
            open.push(k);
        }
        open.sort_unstable();
        open.dedup();
        let parts = open.into_iter().filter_map(|k| {
            let (from, to) = (frames[k].time, frames.get(k + 1)?.time);
            let inner = move |part| from + (to - from) * part as f64 / PARTS as f64;
            (to - from > SHORTEST).then(|| (1..PARTS).map(inner))
        });
        parts.flatten().collect()
    }

    fn path_report(
        &self,
        frames: &[Frame],
        strays: &[f64],
        rounds: usize,
        added: usize,
    ) -> PathReport {
        let largest = strays
            .iter()
            .zip(frames)
            .max_by(|a, b| a.0.total_cmp(b.0))
            .filter(|(stray, _)| stray.is_finite());
        PathReport {
            frames: frames.len(),
            end_t: frames.last().map_or(0.0, |frame| frame.time),
            refinements: rounds,
            added_frames: added,
            straying: largest.map(|(stray, _)| stray / self.subject.sheet().unit_length),
            straying_t: largest.map(|(_, frame)| frame.time),
        }
    }
}

pub(crate) fn timed<T>(
    work: impl FnOnce() -> Result<T, StudyError>,
) -> Result<(T, f64), StudyError> {
    let started = Instant::now();
    work().map(|value| (value, started.elapsed().as_secs_f64()))
}
