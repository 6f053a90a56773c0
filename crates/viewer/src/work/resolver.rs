//! Resolving the current scene: first as a draft, then as a study that can be run.

use std::sync::Arc;
use std::time::Duration;

use foldmotion_study::{Draft, SceneSource, Study};

use super::latest_worker::LatestWorker;
use super::{RepaintSignal, WorkError};

/// The delay before the study of a scene is resolved, so that drafts have the processor to themselves during a drag.
const DELAY: Duration = Duration::from_millis(120);

/// Resolves scenes in the background; only the latest one is of interest.
#[derive(Debug)]
pub(crate) struct Resolver {
    drafts: LatestWorker<SceneSource, Arc<Draft>>,
    studies: LatestWorker<SceneSource, Arc<Study>>,
    serial: u64,
}

/// A resolved scene, with the serial number from [`Resolver::submit`].
#[derive(Debug)]
pub(crate) enum Resolved {
    /// The draft, or why there is none.
    Draft(u64, Result<Arc<Draft>, WorkError>),
    /// The study, or why there is none.
    Study(u64, Result<Arc<Study>, WorkError>),
}

impl Resolver {
    /// A resolver without a scene.
    pub(crate) fn new(repaint: RepaintSignal) -> Self {
        let draft = |source: SceneSource| Ok(Draft::resolve(&source).map(Arc::new)?);
        let study = |source: SceneSource| Ok(Study::resolve(&source).map(Arc::new)?);
        Self {
            drafts: LatestWorker::new("foldmotion draft", Duration::ZERO, repaint.clone(), draft),
            studies: LatestWorker::new("foldmotion study", DELAY, repaint, study),
            serial: 0,
        }
    }

    /// Submits a scene, replacing those before it; returns its serial number, from 1.
    pub(crate) fn submit(&mut self, source: SceneSource) -> u64 {
        self.serial += 1;
        self.drafts.submit(self.serial, source.clone());
        self.studies.submit(self.serial, source);
        self.serial
    }

    /// The results since the last call: at most a draft and a study.
    pub(crate) fn take(&self) -> impl Iterator<Item = Resolved> {
        let draft = self.drafts.take().map(|(n, draft)| Resolved::Draft(n, draft));
        let study = self.studies.take().map(|(n, study)| Resolved::Study(n, study));
        draft.into_iter().chain(study)
    }

    /// Whether a result is still to come.
    pub(crate) fn is_busy(&self) -> bool {
        self.drafts.is_busy() || self.studies.is_busy()
    }
}

#[cfg(test)]
mod tests {
    use super::super::job::tests::wait;
    use super::super::run::tests::source;
    use super::*;

    fn answers(resolver: &Resolver) -> (Option<Resolved>, Option<Resolved>) {
        wait(|| !resolver.is_busy());
        let (mut draft, mut study) = (None, None);
        for answer in resolver.take() {
            match answer {
                Resolved::Draft(..) => draft = Some(answer),
                Resolved::Study(..) => study = Some(answer),
            }
        }
        (draft, study)
    }

    #[test]
    fn the_last_of_many_scenes_is_resolved_as_draft_and_study() {
        let mut resolver = Resolver::new(RepaintSignal::new(|| {}));
        for frames in (2..40).step_by(2) {
            resolver.submit(source(&format!("[motion]\nframes = {frames}\n")));
        }
        let serial = resolver.submit(source("[motion]\nframes = 48\n"));
        let (draft, study) = answers(&resolver);
        let Some(Resolved::Draft(n, Ok(draft))) = draft else { panic!("{draft:?}") };
        assert_eq!(n, serial);
        let Some(Resolved::Study(n, Ok(study))) = study else { panic!("{study:?}") };
        assert_eq!((n, study.frames), (serial, 48));
        assert_eq!(draft.sheet(), study.subject.sheet());
    }

    #[test]
    fn an_error_names_its_key_and_a_draft_does_not_need_what_only_runs_need() {
        let mut resolver = Resolver::new(RepaintSignal::new(|| {}));
        resolver.submit(source("[motion]\nframes = 3\n"));
        let (draft, study) = answers(&resolver);
        assert!(matches!(draft, Some(Resolved::Draft(1, Ok(_)))));
        let Some(Resolved::Study(1, Err(error))) = study else { panic!("{study:?}") };
        assert_eq!(error.key(), Some("motion.frames"));
    }
}
