//! Runs a study: fold, check, report, record.

use std::io::Write as _;
use std::path::Path;
use std::time::Instant;

use foldmotion_check::{CheckError, Checker, CollisionReport, FittedBox};
use foldmotion_pattern::{LayerOrder, Motion};

use crate::engine::Computed;
use crate::report::SecondsReport;
use crate::results::{REPORT, Results, write_error};
use crate::scene::OutputChoice;
use crate::series::FrameFigures;
use crate::{Report, Study, StudyError};

/// A part of a run, as progress names it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// Reading a motion file.
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

/// FOLD's `file_creator` and the report's `version` name this.
pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Bytes of an entry of `faceOrders` at most on average.
const BYTES_AN_ORDER: u64 = 20;

/// What was found out about a motion.
pub(crate) struct Checked {
    pub(crate) collision: CollisionReport,
    /// The order of the triangles that coincide, by the index of the frame.
    pub(crate) layer_orders: Vec<(usize, LayerOrder)>,
    pub(crate) series: Vec<FrameFigures>,
    pub(crate) compact: FittedBox,
}

impl Study {
    /// Folds, checks, reports and records; writes the results into `folder` and returns the report.
    ///
    /// A motion that did not converge or jammed is kept and reported as far as it came.
    ///
    /// # Errors
    /// [`StudyError`] of the step that failed; the folder is then as it was.
    pub fn run(&self, folder: &Path, progress: Progress<'_>) -> Result<Report, StudyError> {
        let started = Instant::now();
        let mut results = Results::create(folder)?;
        self.require_space(&results)?;
        let folded = self.fold_and_check(progress)?;
        let (_, record_seconds) = timed(|| self.record(&folded, &mut results, progress))?;
        let seconds = SecondsReport {
            check: folded.check_seconds,
            record: record_seconds,
            total: started.elapsed().as_secs_f64(),
        };
        let report = self.report(&folded, seconds, results.written());
        results.write(REPORT, |out| {
            out.write_all(report.to_json().as_bytes())
                .map_err(|e| write_error(folder, REPORT, e))
        })?;
        results.publish()?;
        Ok(report)
    }

    fn require_space(&self, results: &Results) -> Result<(), StudyError> {
        let available = results.available()?;
        let orders =
            BYTES_AN_ORDER * self.subject.compact_order().map_or(0, LayerOrder::len) as u64;
        let size = |frames| {
            let fold = if self.recording.has(OutputChoice::Fold) {
                Motion::fold_file_size(self.subject.sheet(), frames) + orders
            } else {
                0
            };
            fold + self.recording.space(self.subject.sheet(), frames)
        };
        let needed = size(self.frames);
        if needed <= available {
            return Ok(());
        }
        let a_frame = (size(self.frames) - size(0))
            .div_ceil(self.frames as u64)
            .max(1);
        let frames = (available.saturating_sub(size(0)) / a_frame) as usize;
        Err(StudyError::DiskTooSmall {
            path: results.folder().to_owned(),
            needed,
            available,
            frames,
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
    ) -> Result<Checked, StudyError> {
        let (collision, layer_orders) = self.judge(motion, progress)?;
        let last = motion.frames.last().map_or(&[][..], |f| &f.positions);
        Ok(Checked {
            series: self.series(motion, computed, &collision.separation_series),
            compact: self.subject.measured_box(last),
            collision,
            layer_orders,
        })
    }

    /// The verdict, and the order of the layers at every frame that has some.
    ///
    /// The order is claimed as the motion file will claim it, so that its check gives the same certificate. In the
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
            let mut order = judged.layer_order();
            let is_last = index + 1 == motion.frames.len();
            if is_last && frame.time == 2.0 && judged.is_clean() {
                for (f, g, sign) in motion.compact_order.iter() {
                    if order.sign(f, g).is_none() {
                        order.insert(f, g, sign);
                    }
                }
            }
            judged.claim(&order, &|triangle| triangle);
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
