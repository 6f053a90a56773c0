//! Runs of studies, with the states of the sheet while it is computed.

use std::sync::Arc;

use foldmotion_check::FittedBox;
use foldmotion_study::{Folded, Phase, Report, Snapshot, Study, Watch};

use super::job::Report as ProgressReport;
use super::{Job, RepaintSignal, StateFeed};

/// The result of a run.
#[derive(Debug)]
pub(crate) struct FinishedRun {
    pub(crate) study: Arc<Study>,
    pub(crate) folded: Arc<Folded>,
    pub(crate) report: Report,
    pub(crate) boxes: Vec<FittedBox>,
}

/// Starts to fold and check `study`; the feed has the states of the sheet while it is computed.
pub(crate) fn run(study: &Arc<Study>, repaint: RepaintSignal) -> (StateFeed, Job<FinishedRun>) {
    let states = StateFeed::default();
    let (study, shown, woken) = (Arc::clone(study), states.clone(), repaint.clone());
    let job = Job::start("foldmotion run", repaint, move |report| {
        let watcher = Watcher { study: &study, report, states: &shown, repaint: &woken };
        let folded = study.compute(&watcher)?;
        Ok(FinishedRun {
            report: study.report_of(&folded),
            boxes: study.boxes(&folded.motion),
            folded: Arc::new(folded),
            study: Arc::clone(&study),
        })
    });
    (states, job)
}

struct Watcher<'a> {
    study: &'a Study,
    report: ProgressReport<'a>,
    states: &'a StateFeed,
    repaint: &'a RepaintSignal,
}

impl Watch for Watcher<'_> {
    fn progress(&self, phase: Phase, done: f64) -> bool {
        (self.report)(phase, done)
    }

    fn state(&self, moment: &Snapshot<'_>) {
        let positions = || self.study.subject.show(moment.positions());
        if self.states.publish_limited(moment.time, positions) {
            self.repaint.send_limited();
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use std::path::Path;

    use foldmotion_study::SceneSource;

    use super::super::WorkError;
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
            let (states, job) = run(&study, RepaintSignal::new(|| {}));
            wait(|| job.is_done());
            let state = states.latest().unwrap();
            assert_eq!(state.positions.len(), study.subject.sheet().vertices.len());
            assert!(state.positions.iter().all(|p| p.is_finite()));
            let finished = job.take().unwrap().unwrap();
            let alone = study.compute(&|_, _| true).unwrap();
            assert_eq!(finished.folded.motion.frames, alone.motion.frames);
            assert_eq!(finished.boxes.len(), alone.motion.frames.len());
            assert_eq!(finished.report.compact, study.report_of(&alone).compact);
        }
    }

    #[test]
    fn a_run_that_is_stopped_says_so() {
        let (_, job) = run(&study("dynamic"), RepaintSignal::new(|| {}));
        job.stop();
        wait(|| job.is_done());
        assert!(matches!(job.take(), Some(Err(WorkError::Stopped))));
    }
}
