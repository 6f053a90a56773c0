//! The functions of the study that the window uses: compute, observe, record with its own camera, open files.

use std::fs;
use std::path::Path;
use std::sync::Mutex;

use foldmotion_study::scene::{CameraScene, OutputChoice, OwnCamera, RecordScene};
use foldmotion_study::{
    CheckOptions, OpenedFile, Phase, SceneSource, Snapshot, Study, StudyError, Watch, check_file,
    reproduce_file,
};

fn source(set: &[&str]) -> SceneSource {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/one-unit.toml");
    let mut source = SceneSource::read(&scene).unwrap();
    let small =
        ["record.size=[64, 48]", "record.fps=5.0", "record.seconds=[0.0, 1.0]", "motion.frames=20"];
    for assignment in small.iter().chain(set) {
        source.set(assignment).unwrap();
    }
    source
}

fn study(set: &[&str]) -> Study {
    Study::resolve(&source(set)).unwrap()
}

/// The bytes of the files in `folder`, by name, except for the report, which has timings, and the manifest.
fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() {
            found.extend(files(&path));
        } else if name != "report.json" && name != ".foldmotion.json" {
            found.push((name, fs::read(&path).unwrap()));
        }
    }
    found.sort();
    found
}

/// The view of a window: 3 lengths across, around a point next to the unit.
fn seen(outputs: &[OutputChoice]) -> RecordScene {
    RecordScene {
        outputs: Some(outputs.to_vec()),
        size: Some([64, 48]),
        fps: Some(5.0),
        seconds: Some([0.0, 1.0]),
        camera: Some(CameraScene::Own(OwnCamera {
            azimuth: -35.0,
            elevation: 25.0,
            turn: None,
            centre: Some([0.25, 0.5, 0.125]),
            width: Some(3.0),
        })),
        ..RecordScene::default()
    }
}

#[test]
fn computing_and_then_writing_gives_the_files_of_a_run() {
    let study = study(&["record.outputs=[\"fold\", \"csv\", \"gif\", \"svg\", \"html\"]"]);
    let home = tempfile::tempdir().unwrap();
    let [once, twice] = ["run", "written"].map(|name| home.path().join(name));
    let report = study.run(&once, &|_, _| true).unwrap();
    let folded = study.compute(&|_, _| true).unwrap();
    let written = study.write(&folded, &twice, &|_, _| true).unwrap();
    assert_eq!(files(&once), files(&twice));
    assert_eq!(report.files, written.files);
    assert!(written.seconds.total >= written.engine.seconds);
    let certificate = study.certificate_of(&folded).unwrap().to_json();
    assert_eq!(certificate, fs::read_to_string(once.join("certificate.json")).unwrap());
    assert!(folded.is_converged() && folded.jam().is_none());
    let boxes = study.boxes(&folded.motion);
    // The two boxes are measured after different rigid fits, so they differ by rounding.
    let extents = boxes.last().unwrap().extents;
    assert!(extents.abs_diff_eq(folded.compact.extents, 1e-14));
    assert_eq!(boxes.len(), folded.findings.series.len());
}

#[test]
fn a_recording_with_the_camera_of_the_window_equals_a_run_with_that_camera() {
    let outputs = [OutputChoice::Gif, OutputChoice::Png, OutputChoice::Svg];
    let plain = study(&[]);
    let folded = plain.compute(&|_, _| true).unwrap();
    let home = tempfile::tempdir().unwrap();
    let [window, scene, other] = ["window", "scene", "other"].map(|name| home.path().join(name));
    let names = plain.record_as(&folded, &seen(&outputs), &window, &|_, _| true).unwrap();
    assert!(names.contains(&"figure.svg".to_owned()) && !window.join("report.json").exists());
    let camera = "record.camera={ azimuth = -35.0, elevation = 25.0, centre = [0.25, 0.5, 0.125], width = 3.0 }";
    let outputs_key = "record.outputs=[\"gif\", \"png\", \"svg\"]";
    study(&[camera, outputs_key]).run(&scene, &|_, _| true).unwrap();
    assert_eq!(files(&window), files(&scene));
    let mut moved = seen(&outputs);
    let Some(CameraScene::Own(own)) = &mut moved.camera else { panic!("it has one") };
    own.centre = Some([0.25, 0.5, 0.625]);
    plain.record_as(&folded, &moved, &other, &|_, _| true).unwrap();
    for name in ["motion.gif", "frames/0001.png", "figure.svg"] {
        let [a, b] = [&window, &other].map(|folder| fs::read(folder.join(name)).unwrap());
        assert_ne!(a, b, "{name}");
    }
    fs::create_dir_all(home.path().join("again")).unwrap();
    let again = Some(home.path().join("again"));
    let made =
        reproduce_file(&window.join("motion.gif"), None, again.as_deref(), false, &|_, _| true);
    assert!(made.unwrap().is_same);
}

#[test]
fn an_invalid_recording_is_refused_with_its_flag() {
    let study = study(&[]);
    let folded = study.compute(&|_, _| true).unwrap();
    let home = tempfile::tempdir().unwrap();
    let mut asked = seen(&[OutputChoice::Png]);
    let Some(CameraScene::Own(own)) = &mut asked.camera else { panic!("it has one") };
    own.width = Some(-3.0);
    let error = study.record_as(&folded, &asked, &home.path().join("out"), &|_, _| true);
    let error = error.unwrap_err();
    assert_eq!((error.status(), error.key()), (2, Some("record.camera")));
    assert_eq!(fs::read_dir(home.path()).unwrap().count(), 0);
    let stopped =
        study.record_as(&folded, &seen(&[OutputChoice::Png]), &home.path().join("out"), &|_, _| {
            false
        });
    assert!(matches!(stopped, Err(StudyError::Interrupted)));
    assert_eq!(fs::read_dir(home.path()).unwrap().count(), 0);
}

/// An observer that keeps the states, and may end the run after some of them.
#[derive(Default)]
struct Seen {
    states: Mutex<Vec<(f64, usize)>>,
    most: Option<usize>,
}

impl Watch for Seen {
    fn progress(&self, phase: Phase, _: f64) -> bool {
        phase != Phase::Fold
            || self.most.is_none_or(|most| self.states.lock().unwrap().len() < most)
    }

    fn state(&self, moment: &Snapshot<'_>) {
        let positions = moment.positions();
        assert!(positions.iter().all(|p| p.is_finite()));
        self.states.lock().unwrap().push((moment.time, positions.len()));
    }
}

#[test]
fn an_observed_run_reports_its_states_and_has_the_same_result() {
    for engine in ["motion.engine=dynamic", "motion.engine=quasi-static"] {
        let study = study(&[engine]);
        let seen = Seen::default();
        let watched = study.compute(&seen).unwrap();
        let alone = study.compute(&|_, _| true).unwrap();
        assert_eq!(watched.motion.frames, alone.motion.frames);
        let states = seen.states.into_inner().unwrap();
        let vertices = study.subject.sheet().vertices.len();
        assert!(states.len() > 2 * watched.motion.frames.len(), "{engine}: {}", states.len());
        assert!(states.iter().all(|&(_, count)| count == vertices));
        assert!(states.is_sorted_by(|a, b| a.0 <= b.0));
        assert_eq!(states.last().map(|s| s.0), Some(2.0));
        let few = Seen { most: Some(3), ..Seen::default() };
        assert!(matches!(study.compute(&few), Err(StudyError::Interrupted)));
        assert_eq!(few.states.into_inner().unwrap().len(), 3);
    }
}

#[test]
fn a_file_is_opened_by_its_content() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("unit");
    study(&["record.outputs=[\"fold\"]"]).run(&folder, &|_, _| true).unwrap();
    let open = |path: &Path| OpenedFile::read(path, &|_, _| true);
    let path = folder.join("motion.fold");
    let OpenedFile::Motion(motion) = open(&path).unwrap() else { panic!("a run writes a motion") };
    let (findings, certificate) = motion.check(&CheckOptions::default(), &|_, _| true).unwrap();
    let alone = check_file(&path, &CheckOptions::default(), &|_, _| true).unwrap();
    assert_eq!(certificate.to_json(), alone.certificate.to_json());
    assert_eq!(findings.series.len(), motion.motion().frames.len());
    assert!(motion.has_rest_lengths() && findings.series[3].peak_strain.is_finite());
    assert_eq!(findings.series[20].time, motion.motion().frames[20].time);
    let stopped = motion.check(&CheckOptions::default(), &|phase, _| phase != Phase::Check);
    assert!(matches!(stopped, Err(StudyError::Interrupted)));
    let mut text = fs::read_to_string(&path).unwrap();
    text.push(' ');
    fs::write(&path, text).unwrap();
    let error = motion.check(&CheckOptions::default(), &|_, _| true).unwrap_err();
    assert!(error.to_string().contains("changed"), "{error}");

    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let mut found = 0;
    for entry in fs::read_dir(&scenes).unwrap() {
        let path = entry.unwrap().path();
        if path.is_file() {
            assert!(matches!(open(&path), Ok(OpenedFile::Scene(_))), "{}", path.display());
            found += 1;
        }
    }
    assert!(found > 3);
    // A file that is not a motion is opened as a crease pattern, whose import reports the error.
    let broken = home.path().join("broken.fold");
    fs::write(&broken, "{").unwrap();
    let OpenedFile::Scene(source) = open(&broken).unwrap() else { panic!("it is no motion") };
    assert!(Study::resolve(&source).is_err());
    assert!(matches!(open(Path::new("nowhere.toml")), Err(StudyError::Read { .. })));
    assert!(matches!(OpenedFile::read(&path, &|_, _| false), Err(StudyError::Interrupted)));
}

#[test]
fn a_motion_without_times_is_one_stage_and_so_is_its_verdict() {
    let home = tempfile::tempdir().unwrap();
    let path = home.path().join("flap.fold");
    // Two triangles; the second folds through a half turn and past it, through the first.
    let corner = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        format!("[{}, {}, {}]", 0.5 - 0.5 * cos, 0.5 - 0.5 * cos, 0.7 * sin)
    };
    let frame = |degrees: f64| {
        format!(
            "{{\"frame_inherit\": true, \"frame_parent\": 0, \"vertices_coords\": [[1, 0, 0], [0, 1, 0], [1, 1, 0], {}]}}",
            corner(degrees)
        )
    };
    let frames: Vec<String> = [0.0, 60.0, 120.0, 170.0, 190.0, 220.0].map(frame).to_vec();
    let text = format!(
        "{{\"file_spec\": 1.1, \"vertices_coords\": [[1, 0, 0], [0, 1, 0], [1, 1, 0], [0, 0, 0]], \
         \"faces_vertices\": [[0, 2, 1], [0, 1, 3]], \"file_frames\": [{}]}}",
        frames.join(", ")
    );
    fs::write(&path, text).unwrap();
    let OpenedFile::Motion(motion) = OpenedFile::read(&path, &|_, _| true).unwrap() else {
        panic!("it moves")
    };
    let (findings, certificate) = motion.check(&CheckOptions::default(), &|_, _| true).unwrap();
    let ends = [&motion.motion().frames[0], motion.motion().frames.last().unwrap()];
    assert_eq!(ends.map(|frame| frame.time), [1.0, 2.0]);
    assert_eq!(certificate.verdict.name(), "penetrating");
    let first = findings.collision.first.unwrap();
    assert!((1.0..=2.0).contains(&first.time), "{}", first.time);
    let by_index = certificate.penetrations[0].t;
    let count = motion.motion().frames.len() as f64;
    assert!((first.time - 1.0 - by_index / (count - 1.0)).abs() < 1e-12);
    let folder = home.path().join("film");
    let made = motion.record_as(
        Some(&check_findings(&motion)),
        &seen(&[OutputChoice::Png]),
        &folder,
        &|_, _| true,
    );
    assert!(made.unwrap().is_checked);
}

fn check_findings(motion: &foldmotion_study::OpenedMotion) -> foldmotion_study::Findings {
    let checked = motion.check(&CheckOptions::default(), &|_, _| true);
    checked.unwrap().0
}
