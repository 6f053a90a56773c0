//! Runs a study: fold, check, report, record.

use std::io::Write as _;
use std::time::Instant;

use foldmotion_check::{CheckError, Checker, CollisionReport};
use foldmotion_pattern::{LayerOrder, Motion};
use foldmotion_solver::Snapshot;

use crate::engine::Computed;
use crate::folded::{Findings, Folded};
use crate::recording::{FilmSizes, Recording, Space, size_words};
use crate::report::SecondsReport;
use crate::results::{Destination, Maker, REPORT, Results, is_picture, write_error};
use crate::scene::OutputChoice;
use crate::{Report, Study, StudyError};

/// A part of a run, as progress names it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// Reading a scene, a pattern or a motion.
    Read,
    /// The engine.
    Fold,
    /// The collision check.
    Check,
    /// The second proof of a certificate.
    Verify,
    /// Films and files.
    Record,
}

impl Phase {
    /// Its name on the screen.
    pub fn name(self) -> &'static str {
        match self {
            Self::Read => "read",
            Self::Fold => "fold",
            Self::Check => "check",
            Self::Verify => "verify",
            Self::Record => "record",
        }
    }
}

/// Told how much of a phase is done, from 0 to 1; answers whether to go on.
pub type Progress<'a> = &'a (dyn Fn(Phase, f64) -> bool + Sync);

/// Watches a run. Whoever only wants its progress gives a [`Progress`].
pub trait Watch: Sync {
    /// Told how much of a phase is done, from 0 to 1; answers whether to go on.
    fn progress(&self, phase: Phase, done: f64) -> bool;

    /// Told that the engine has come to a state, some hundred times a second for a small sheet. Its positions are worked
    /// out where they are asked for. They lie where the engine has them: [`Subject::show`](crate::Subject::show) moves
    /// them to where they are shown.
    fn state(&self, moment: &Snapshot<'_>) {
        let _ = moment;
    }
}

impl<F: Fn(Phase, f64) -> bool + Sync> Watch for F {
    fn progress(&self, phase: Phase, done: f64) -> bool {
        self(phase, done)
    }
}

/// FOLD's `file_creator` and the report's `version` name this.
pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Bytes of an entry of `faceOrders` at most on average.
const BYTES_AN_ORDER: u64 = 20;

impl Study {
    /// Folds, checks, reports and records; writes the results into `folder` and returns the report.
    ///
    /// A motion that did not converge or jammed is kept and reported as far as it came.
    ///
    /// # Errors
    /// [`StudyError`] of the step that failed; the folder is then as it was.
    pub fn run<'a>(
        &self,
        destination: impl Into<Destination<'a>>,
        progress: Progress<'_>,
    ) -> Result<Report, StudyError> {
        let started = Instant::now();
        let results = self.open_results(destination.into(), progress)?;
        let folded = self.compute(&progress)?;
        self.finish(&folded, results, started, progress)
    }

    /// Writes the results of `folded`, computed by [`Self::compute`], into `folder`, as [`Self::run`] does.
    ///
    /// # Errors
    /// [`StudyError`] of the file that failed; the folder is then as it was.
    pub fn write<'a>(
        &self,
        folded: &Folded,
        destination: impl Into<Destination<'a>>,
        progress: Progress<'_>,
    ) -> Result<Report, StudyError> {
        let now = Instant::now();
        let started = now.checked_sub(folded.duration()).unwrap_or(now);
        let results = self.open_results(destination.into(), progress)?;
        self.finish(folded, results, started, progress)
    }

    /// The folder of results, where nothing stands in their way and the disk can hold them.
    fn open_results(
        &self,
        destination: Destination<'_>,
        progress: Progress<'_>,
    ) -> Result<Results, StudyError> {
        let results = Results::open(destination, Maker::Run, Some(REPORT))?;
        results.require_clear(&|name| name == REPORT || self.recording.plans(name))?;
        self.require_space(&results, progress)?;
        Ok(results)
    }

    /// The rest of a run that began at `started`.
    fn finish(
        &self,
        folded: &Folded,
        mut results: Results,
        started: Instant,
        progress: Progress<'_>,
    ) -> Result<Report, StudyError> {
        let folder = results.folder().to_owned();
        let (sha256, record_seconds) =
            timed(|| self.record(&self.recording, folded, &mut results, progress))?;
        let seconds = SecondsReport {
            check: folded.check_seconds,
            record: record_seconds,
            total: started.elapsed().as_secs_f64(),
        };
        let aside = results.set_aside();
        let mut report = self.report(folded, seconds, results.written());
        results.write(REPORT, |out| {
            out.write_all(report.to_json().as_bytes())
                .map_err(|e| write_error(&folder, REPORT, e))
        })?;
        let has_pictures = self.recording.has(OutputChoice::Png);
        report.published = results.publish(Some(&sha256), &|file| {
            file.of.as_deref() != Some(&sha256) || has_pictures && is_picture(&file.name)
        })?;
        report.published.aside = aside;
        Ok(report)
    }

    /// Bytes of the files of `recording` for a motion of `frames` frames: at most, or about, where `films` are known.
    pub(crate) fn space(
        &self,
        recording: &Recording,
        frames: usize,
        films: Option<FilmSizes>,
    ) -> Space {
        let sheet = self.subject.sheet();
        let orders =
            BYTES_AN_ORDER * self.subject.compact_order().map_or(0, LayerOrder::len) as u64;
        let mut space = recording.space(sheet, frames, films);
        if recording.has(OutputChoice::Fold) {
            let fold = Motion::fold_file_size(sheet, frames) + orders;
            space.add(OutputChoice::Fold, fold);
        }
        space
    }

    /// The same, measured on a few pictures where the bound of the films exceeds what is free.
    pub(crate) fn space_in(
        &self,
        results: &Results,
        recording: &Recording,
        frames: usize,
        progress: Progress<'_>,
    ) -> Result<Space, StudyError> {
        let bound = self.space(recording, frames, None);
        if bound.total() <= results.available()? || !recording.has_films() {
            return Ok(bound);
        }
        let films = recording.sample_films(&self.subject.known_states(), progress)?;
        Ok(self.space(recording, frames, Some(films)))
    }

    fn require_space(&self, results: &Results, progress: Progress<'_>) -> Result<(), StudyError> {
        let needed = self.space_in(results, &self.recording, self.frames, progress)?;
        let available = results.available()?;
        if needed.total() <= available {
            return Ok(());
        }
        let least = self.space(&self.recording, 2, None).total();
        let most = self.space(&self.recording, self.frames, None).total();
        // What does not depend on the frames may be less than its bound.
        let rest = needed.total().saturating_sub(most - least);
        let a_frame = (most - least).div_ceil(self.frames as u64 - 1).max(1);
        let frames = 2 + (available.saturating_sub(rest) / a_frame) as usize;
        let frames = (frames - frames % 2).min(self.frames - 2);
        let remedy = if rest <= available && frames >= 2 {
            format!("set motion.frames to {frames} or less")
        } else {
            needed.remedy()
        };
        Err(StudyError::DiskTooSmall {
            path: results.folder().to_owned(),
            needed: size_words(needed.total()),
            parts: needed.words(),
            available: size_words(available),
            remedy,
        })
    }

    /// The motion where it is shown.
    pub(crate) fn place(&self, computed: &Computed) -> Motion {
        let mut frames = computed.frames.clone();
        self.subject.place(&mut frames);
        Motion {
            sheet: self.subject.sheet().clone(),
            frames,
            compact_order: self.subject.compact_order().cloned().unwrap_or_default(),
        }
    }

    pub(crate) fn check(
        &self,
        motion: &Motion,
        computed: &Computed,
        progress: Progress<'_>,
    ) -> Result<Findings, StudyError> {
        let (collision, layer_orders) = self.judge(motion, progress)?;
        Ok(Findings {
            series: self.series(motion, computed, &collision.separation_series),
            collision,
            layer_orders,
        })
    }

    /// The verdict, and the order of the layers at every frame that has some.
    ///
    /// Where the check stops early, later frames get no order. The order is claimed as the motion file will claim it, so that its check gives the same certificate. In the
    /// compact frame of a motion without penetration, layers a gap apart lie in the exact order.
    fn judge(
        &self,
        motion: &Motion,
        progress: Progress<'_>,
    ) -> Result<(CollisionReport, Vec<(usize, LayerOrder)>), StudyError> {
        let mut orders = Vec::new();
        let mut checker: Option<Checker<'_>> = None;
        for (index, frame) in motion.frames.iter().enumerate() {
            if !progress(Phase::Check, index as f64 / motion.frames.len() as f64) {
                return Err(CheckError::Cancelled { intervals: index }.into());
            }
            let mut judged = match checker {
                Some(mut checker) => {
                    checker.advance(frame)?;
                    checker
                }
                None => Checker::new(&motion.sheet, frame, &self.collision)?,
            };
            if judged.is_stopped() {
                checker = Some(judged);
                break;
            }
            let mut order = judged.layer_order();
            let is_last = index + 1 == motion.frames.len();
            if is_last && frame.time == 2.0 && judged.is_clean() {
                for (f, g, sign) in judged.without_false(&motion.compact_order).iter() {
                    if order.sign(f, g).is_none() {
                        order.insert(f, g, sign);
                    }
                }
            }
            judged.claim(&order, &|triangle| triangle)?;
            if !order.is_empty() {
                orders.push((index, order));
            }
            checker = Some(judged);
        }
        progress(Phase::Check, 1.0);
        let checker = checker.ok_or(CheckError::NoFrames)?;
        Ok((checker.finish(), orders))
    }
}

pub(crate) fn timed<T>(
    work: impl FnOnce() -> Result<T, StudyError>,
) -> Result<(T, f64), StudyError> {
    let started = Instant::now();
    work().map(|value| (value, started.elapsed().as_secs_f64()))
}
