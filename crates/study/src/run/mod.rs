//! Runs a study: fold, check, report, record.

mod space;

use std::time::Instant;

use crate::compute::folded::Folded;
use crate::compute::timed;
use crate::report::SecondsReport;
use crate::results::{Command, Destination, REPORT, Results};
use crate::{Progress, Report, Study, StudyError};

impl Study {
    /// Folds, checks, reports and records; writes the results into `destination` and returns the report.
    ///
    /// A motion that did not converge or jammed is reported as far as it came.
    ///
    /// # Errors
    /// [`StudyError`] of the step that failed; the folder is then unchanged.
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

    /// Writes the results of `folded`, computed by [`Self::compute`], into `destination`, as [`Self::run`] does.
    ///
    /// # Errors
    /// [`StudyError`] of the file that failed; the folder is then unchanged.
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

    /// Opens the output folder, after checks for conflicting files and for space.
    fn open_results(
        &self,
        destination: Destination<'_>,
        progress: Progress<'_>,
    ) -> Result<Results, StudyError> {
        let results = Results::open(destination, Command::Run, Some(REPORT))?;
        results.require_clear(&|name| name == REPORT || self.recording.plans(name))?;
        self.require_space(&results, progress)?;
        Ok(results)
    }

    /// Records and reports the results of a run that began at `started`.
    fn finish(
        &self,
        folded: &Folded,
        mut results: Results,
        started: Instant,
        progress: Progress<'_>,
    ) -> Result<Report, StudyError> {
        let (sha256, record_seconds) =
            timed(|| self.record(&self.recording, folded, &mut results, progress))?;
        let seconds = SecondsReport {
            check: folded.check_seconds,
            record: record_seconds,
            total: started.elapsed().as_secs_f64(),
        };
        let skipped = results.skip_conflicts();
        let mut report = self.report(folded, seconds, results.written());
        results.write_bytes(REPORT, report.to_json().as_bytes())?;
        report.published = results.publish(Some(&sha256), &|file| {
            file.of.as_deref() != Some(&sha256) || self.recording.replaces(&file.name)
        })?;
        report.published.skipped = skipped;
        Ok(report)
    }
}
