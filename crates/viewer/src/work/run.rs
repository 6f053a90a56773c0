//! Runs of studies, with the states of the sheet while it is computed.

use std::sync::Arc;

use foldmotion_check::FittedBox;
use foldmotion_study::{Folded, Moment, Phase, Report, Study, Watch};

use super::job::JobContext;
use super::{Job, Progress, RepaintSignal, StateFeed, WorkError};

/// A run in the background. Dropping it stops it.
#[derive(Debug)]
pub(crate) struct RunJob {
    job: Job<FinishedRun>,
    states: StateFeed,
}

/// The result of a run.
#[derive(Debug)]
pub(crate) struct FinishedRun {
    /// The study that was run.
    pub(crate) study: Arc<Study>,
    /// The motion and its findings.
    pub(crate) folded: Arc<Folded>,
    /// The report, without files.
    pub(crate) report: Report,
    /// The box of every frame.
    pub(crate) boxes: Vec<FittedBox>,
}

impl RunJob {
    /// Starts to fold and check `study`.
    pub(crate) fn start(study: &Arc<Study>, repaint: RepaintSignal) -> Self {
        let states = StateFeed::default();
        let (run, shown, woken) = (Arc::clone(study), states.clone(), repaint.clone());
        let job = Job::start("foldmotion run", repaint, move |context| {
            let watcher = Watcher {
                study: &run,
                context,
                states: &shown,
                repaint: &woken,
            };
            let folded = run.compute(&watcher)?;
            Ok(FinishedRun {
                report: run.report_of(&folded),
                boxes: run.boxes(&folded.motion),
                folded: Arc::new(folded),
                study: Arc::clone(&run),
            })
        });
        Self { job, states }
    }

    /// The states of the sheet.
    pub(crate) fn states(&self) -> &StateFeed {
        &self.states
    }

    /// The current progress.
    pub(crate) fn progress(&self) -> Progress {
        self.job.progress()
    }

    /// Whether the run has ended.
    pub(crate) fn is_done(&self) -> bool {
        self.job.is_done()
    }

    /// Asks the run to stop.
    pub(crate) fn stop(&self) {
        self.job.stop();
    }

    /// The result, once the run has ended; `None` if it was taken before.
    pub(crate) fn take(&self) -> Option<Result<FinishedRun, WorkError>> {
        self.job.take()
    }
}

struct Watcher<'a> {
    study: &'a Study,
    context: &'a JobContext,
    states: &'a StateFeed,
    repaint: &'a RepaintSignal,
}

impl Watch for Watcher<'_> {
    fn progress(&self, phase: Phase, done: f64) -> bool {
        self.context.report(phase, done)
    }

    fn state(&self, moment: &Moment<'_>) {
        let positions = || self.study.subject.show(moment.positions());
        if self.states.show(moment.time, positions) {
            self.repaint.send_limited();
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use std::path::Path;

    use foldmotion_study::SceneSource;

    use super::super::job::tests::wait;
    use super::*;

    /// A small scene, with `more` appended to its text.
    pub(in crate::work) fn source(more: &str) -> SceneSource {
        let text = format!(
            "[profile]\nmodel = \"shelter\"\n[sheet]\nrows = 3\ncolumns = 2\n[record]\noutputs = [\"png\"]\nsize = [64, 48]\n\
             fps = 2.0\n{more}"
        );
        SceneSource::new(Path::new("small.toml"), text)
    }

    fn study(engine: &str) -> Arc<Study> {
        let more = format!("[motion]\nengine = \"{engine}\"\nframes = 24\n");
        Arc::new(Study::resolve(&source(&more)).unwrap())
    }

    #[test]
    fn a_run_shows_states_of_its_motion_and_ends_as_the_study_alone() {
        for engine in ["quasi-static", "dynamic"] {
            let study = study(engine);
            let run = RunJob::start(&study, RepaintSignal::new(|| {}));
            wait(|| run.is_done());
            let state = run.states().latest().unwrap();
            assert_eq!(state.positions.len(), study.subject.sheet().vertices.len());
            assert!(state.positions.iter().all(|p| p.is_finite()));
            let finished = run.take().unwrap().unwrap();
            let alone = study.compute(&|_, _| true).unwrap();
            assert_eq!(finished.folded.motion.frames, alone.motion.frames);
            assert_eq!(finished.boxes.len(), alone.motion.frames.len());
            assert_eq!(finished.report.compact, study.report_of(&alone).compact);
        }
    }

    #[test]
    fn a_run_that_is_stopped_says_so() {
        let run = RunJob::start(&study("dynamic"), RepaintSignal::new(|| {}));
        run.stop();
        wait(|| run.is_done());
        assert!(matches!(run.take(), Some(Err(WorkError::Stopped))));
    }
}
