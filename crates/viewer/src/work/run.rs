//! A run of a study that shows where the sheet is.

use std::sync::Arc;

use foldmotion_check::FittedBox;
use foldmotion_study::{Folded, Snapshot, Phase, Report, Study, Watch};

use super::job::Ticket;
use super::{Job, Live, Stand, Wake, WorkError};

/// A run in the background. Dropping it stops it.
#[derive(Debug)]
pub(crate) struct Run {
    job: Job<Finished>,
    live: Live,
}

/// What came of a run.
#[derive(Debug)]
pub(crate) struct Finished {
    /// What was run.
    pub(crate) study: Arc<Study>,
    /// The motion, and what was found out about it.
    pub(crate) folded: Arc<Folded>,
    /// Its report, without files.
    pub(crate) report: Report,
    /// The box of every frame.
    pub(crate) boxes: Vec<FittedBox>,
}

impl Run {
    /// Starts to fold and check `study`.
    pub(crate) fn start(study: &Arc<Study>, wake: Wake) -> Self {
        let live = Live::default();
        let (run, shown, woken) = (Arc::clone(study), live.clone(), wake.clone());
        let job = Job::start("foldmotion run", wake, move |ticket| {
            let watcher = Watcher {
                study: &run,
                ticket,
                live: &shown,
                wake: &woken,
            };
            let folded = run.compute(&watcher)?;
            Ok(Finished {
                report: run.report_of(&folded),
                boxes: run.boxes(&folded.motion),
                folded: Arc::new(folded),
                study: Arc::clone(&run),
            })
        });
        Self { job, live }
    }

    /// Where the sheet is.
    pub(crate) fn live(&self) -> &Live {
        &self.live
    }

    /// How far it is.
    pub(crate) fn stand(&self) -> Stand {
        self.job.stand()
    }

    /// Whether it has ended.
    pub(crate) fn is_done(&self) -> bool {
        self.job.is_done()
    }

    /// Tells it to stop.
    pub(crate) fn stop(&self) {
        self.job.stop();
    }

    /// What came of it, once it has ended; none if that was taken before.
    pub(crate) fn take(&self) -> Option<Result<Finished, WorkError>> {
        self.job.take()
    }
}

struct Watcher<'a> {
    study: &'a Study,
    ticket: &'a Ticket,
    live: &'a Live,
    wake: &'a Wake,
}

impl Watch for Watcher<'_> {
    fn progress(&self, phase: Phase, done: f64) -> bool {
        self.ticket.progress(phase, done)
    }

    fn state(&self, moment: &Snapshot<'_>) {
        let positions = || self.study.subject.show(moment.positions());
        if self.live.show(moment.time, positions) {
            self.wake.soon();
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use std::path::Path;

    use foldmotion_study::SceneSource;

    use super::super::job::tests::wait;
    use super::*;

    /// A small scene; `more` follows its text.
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
            let run = Run::start(&study, Wake::new(|| {}));
            wait(|| run.is_done());
            let state = run.live().newer(0).unwrap();
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
        let run = Run::start(&study("dynamic"), Wake::new(|| {}));
        run.stop();
        wait(|| run.is_done());
        assert!(matches!(run.take(), Some(Err(WorkError::Stopped))));
    }
}
