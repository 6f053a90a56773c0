//! Refinement: more frames where the recorded ones do not decide what the computed motion does.
//!
//! The verdict speaks of straight paths between frames. Where one leaves the computed motion further than facets
//! overlap on it, or could not be decided, the motion itself may be clear: the engine then runs again and records
//! more frames there.

use foldmotion_check::{CollisionReport, Verdict, straying};
use foldmotion_pattern::Frame;

use crate::folded::Folded;
use crate::report::PathReport;
use crate::run::timed;
use crate::{Phase, Study, StudyError, Watch};

/// Runs of the engine with more frames, at most; each divides the straying of a path by 16.
const MOST_ROUNDS: usize = 4;
/// Frames added in all rounds together, at most: where motions are open all along, each round would quadruple them.
const MOST_ADDED: usize = 20_000;
/// Parts an interval is divided into.
const PARTS: usize = 4;
/// Straight paths may stray this many times as far as is estimated of them: the estimate was seen to be half of what it
/// should be.
const LARGEST_STRAY: f64 = 2.0;
/// Shorter intervals are not divided.
const SHORTEST: f64 = 1e-9;

impl Study {
    /// Folds and checks, with more frames where the first ones leave the verdict open; writes nothing.
    ///
    /// A motion that did not converge or jammed is a result too, as far as it came.
    ///
    /// # Errors
    /// [`StudyError::Solver`], [`StudyError::Check`], and [`StudyError::Interrupted`] where `watch` ended it.
    pub fn compute(&self, watch: &dyn Watch) -> Result<Folded, StudyError> {
        let mut extra_times = self.subject.times_of_interest();
        let asked = extra_times.len();
        let start = self.subject.start_time();
        let (mut engine_seconds, mut check_seconds) = (0.0, 0.0);
        let mut rounds = 0;
        loop {
            let (computed, seconds) = timed(|| {
                self.fold(&extra_times, &|moment| {
                    watch.state(moment);
                    watch.progress(Phase::Fold, (moment.time - start) / (2.0 - start))
                })
            })?;
            engine_seconds += seconds;
            let motion = self.place(&computed);
            let progress = |phase, done| watch.progress(phase, done);
            let (findings, seconds) = timed(|| self.check(&motion, &computed, &progress))?;
            check_seconds += seconds;
            let strays = straying(&motion.frames);
            let more = self.times_between(&findings.collision, &motion.frames, &strays);
            let added = extra_times.len() - asked;
            let is_spent = rounds == MOST_ROUNDS || added + more.len() > MOST_ADDED;
            if more.is_empty() || is_spent {
                let path = self.path_report(&motion.frames, &strays, rounds, added);
                let last = motion.frames.last().map_or(&[][..], |f| &f.positions);
                return Ok(Folded {
                    compact: self.subject.measured_box(last),
                    computed,
                    motion,
                    findings,
                    path,
                    engine_seconds,
                    check_seconds,
                });
            }
            extra_times.extend(more);
            rounds += 1;
        }
    }

    /// Times at which frames are missing: within intervals that could not be decided, or, where every penetration is
    /// shallower than the straight paths may stray there, within theirs.
    fn times_between(
        &self,
        collision: &CollisionReport,
        frames: &[Frame],
        strays: &[f64],
    ) -> Vec<f64> {
        if !matches!(collision.verdict, Verdict::Undecided | Verdict::Penetrating) {
            return Vec::new();
        }
        let height = self.subject.sheet().unit_length;
        let mut open: Vec<usize> = collision.undecided.iter().map(|u| u.frame).collect();
        // Layers out of order are shown by their frame alone; more frames come where facets passed through.
        let passed = collision
            .penetrations
            .iter()
            .filter(|p| p.conflict.is_none());
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
            refinements: rounds,
            added_frames: added,
            straying: largest.map(|(stray, _)| stray / self.subject.sheet().unit_length),
            straying_t: largest.map(|(_, frame)| frame.time),
        }
    }
}
