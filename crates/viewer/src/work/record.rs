//! Writing films, figures, models and the results of runs.

use std::path::PathBuf;
use std::sync::Arc;

use foldmotion_study::scene::RecordScene;
use foldmotion_study::{Findings, Folded, OpenedMotion, Study};

use super::{Job, RepaintSignal};

/// Records a run into `folder` as `record` says; the result is the names of the files.
pub(crate) fn record(
    study: Arc<Study>,
    folded: Arc<Folded>,
    record: RecordScene,
    folder: PathBuf,
    repaint: RepaintSignal,
) -> Job<Vec<String>> {
    Job::start("foldmotion record", repaint, move |report| {
        Ok(study.record_as(&folded, &record, &folder, report)?)
    })
}

/// Records a motion file with its findings.
pub(crate) fn record_opened(
    motion: Arc<OpenedMotion>,
    findings: Option<Arc<Findings>>,
    record: RecordScene,
    folder: PathBuf,
    repaint: RepaintSignal,
) -> Job<Vec<String>> {
    Job::start("foldmotion record", repaint, move |report| {
        let made = motion.record_as(findings.as_deref(), &record, &folder, report)?;
        Ok(made.files)
    })
}

/// Writes the results of a run into `folder` as `foldmotion run` does; the result is the names of the files.
pub(crate) fn write(
    study: Arc<Study>,
    folded: Arc<Folded>,
    folder: PathBuf,
    repaint: RepaintSignal,
) -> Job<Vec<String>> {
    Job::start("foldmotion write", repaint, move |report| {
        let mut files = study.write(&folded, &folder, report)?.files;
        files.push("report.json".to_owned());
        Ok(files)
    })
}

#[cfg(test)]
mod tests {
    use std::fs;

    use foldmotion_study::OpenedFile;
    use foldmotion_study::scene::{CameraScene, OutputChoice, OwnCamera};

    use super::super::job::tests::wait;
    use super::super::run::tests::source;
    use super::super::{WorkError, check_motion, open};
    use super::*;

    fn quiet() -> RepaintSignal {
        RepaintSignal::new(|| {})
    }

    fn done<T>(job: &Job<T>) -> Result<T, WorkError> {
        wait(|| job.is_done());
        job.take().unwrap()
    }

    fn view(outputs: &[OutputChoice]) -> RecordScene {
        RecordScene {
            outputs: Some(outputs.to_vec()),
            size: Some([64, 48]),
            fps: Some(2.0),
            camera: Some(CameraScene::Own(OwnCamera {
                azimuth: -30.0,
                elevation: 20.0,
                turn: None,
                centre: Some([1.0, 2.0, 0.5]),
                width: Some(9.0),
            })),
            ..RecordScene::default()
        }
    }

    #[test]
    fn a_run_is_written_opened_checked_and_recorded() {
        let more = "[motion]\nengine = \"dynamic\"\nframes = 24\n";
        let study = Arc::new(Study::resolve(&source(more)).unwrap());
        let folded = Arc::new(study.compute(&|_, _| true).unwrap());
        let home = tempfile::tempdir().unwrap();
        let at = |name: &str| home.path().join(name);
        let (run, kept) = (Arc::clone(&study), Arc::clone(&folded));
        let outputs = [OutputChoice::Fold, OutputChoice::Png, OutputChoice::Svg];
        let files = done(&record(run, kept, view(&outputs), at("mine"), quiet())).unwrap();
        assert!(files.contains(&"motion.fold".to_owned()));
        let opened = done(&open(at("mine/motion.fold"), quiet())).unwrap();
        let OpenedFile::Motion(motion) = opened else { panic!("a motion was written") };
        assert_eq!(motion.motion().frames, folded.motion.frames);
        let checked = done(&check_motion(Arc::clone(&motion), quiet())).unwrap();
        assert_eq!(checked.findings.collision.verdict, folded.findings.collision.verdict);
        let certificate = fs::read_to_string(at("mine/certificate.json")).unwrap();
        assert_eq!(checked.certificate.to_json(), certificate);
        let pictures = [OutputChoice::Png];
        let findings = Some(checked.findings);
        let job = record_opened(motion, findings, view(&pictures), at("again"), quiet());
        assert!(done(&job).unwrap().contains(&"frames/0001.png".to_owned()));
        let files = done(&write(study, folded, at("whole"), quiet())).unwrap();
        assert!(files.contains(&"frames/0001.png".to_owned()));
        assert!(at("whole/report.json").is_file());
    }

    #[test]
    fn a_recording_that_is_dropped_leaves_nothing_behind() {
        let study = Arc::new(Study::resolve(&source("[motion]\nframes = 4\n")).unwrap());
        let folded = Arc::new(study.compute(&|_, _| true).unwrap());
        let home = tempfile::tempdir().unwrap();
        let mut long = view(&[OutputChoice::Png]);
        long.fps = Some(50.0);
        long.seconds = Some([60.0, 60.0]);
        let job = record(study, folded, long, home.path().join("film"), quiet());
        job.stop();
        assert!(matches!(done(&job), Err(WorkError::Stopped)));
        assert_eq!(fs::read_dir(home.path()).unwrap().count(), 0);
    }

    #[test]
    fn a_file_that_is_not_there_is_an_error_that_names_it() {
        let error = done(&open("nowhere/else.toml".into(), quiet())).unwrap_err();
        assert!(error.to_string().contains("else.toml"), "{error}");
    }
}
