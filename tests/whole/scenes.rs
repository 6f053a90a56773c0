//! Every scene of `scenes/` runs, and its verdict, box and status are the ones measured.

use std::path::{Path, PathBuf};

use foldmotion_study::report::OutcomeKind;
use foldmotion_study::{CheckOptions, Report, SceneSource, Study, check_file};

/// The expected result of a scene.
struct Expected {
    scene: &'static str,
    verdict: &'static str,
    status: u8,
}

const fn expected(scene: &'static str, verdict: &'static str, status: u8) -> Expected {
    Expected { scene, verdict, status }
}

/// As they stand: with contact, but for the short rectangles, whose compact state no order of layers admits.
const EXPECTED: &[Expected] = &[
    expected("one-unit", "free", 0),
    expected("one-row", "free", 0),
    expected("shelter-e", "free", 0),
    expected("shelter-t", "free", 0),
    expected("shelter-s", "free", 0),
    expected("shelter-sii", "free", 0),
    expected("shelter-short-plain", "penetrating", 1),
    expected("shelter-tall-plain", "free", 0),
    expected("spiral-s", "free", 0),
    expected("omega-sii", "free", 0),
    expected("map-fold", "touching", 0),
    expected("shelter-unequal", "free", 0),
    expected("spiral-energy", "free", 0),
];

/// Without contact, by the dynamic engine: settled after each increment of the schedule, the soft sheet closes its
/// layers without crossing; unmodified rectangles cross on the way whatever their shape.
const DYNAMIC: &[Expected] = &[
    expected("one-unit", "touching", 0),
    expected("one-row", "touching", 0),
    expected("shelter-e", "touching", 0),
    expected("shelter-t", "touching", 0),
    expected("shelter-s", "touching", 0),
    expected("shelter-sii", "touching", 0),
    expected("shelter-short-plain", "penetrating", 1),
    expected("shelter-tall-plain", "penetrating", 1),
];

/// Small films: what they show is the record crate's to test.
const SMALL_FILM: [&str; 2] = ["record.size=[120, 90]", "record.fps=5.0"];
/// No files but the report.
const REPORT_ONLY: &str = "record.outputs=[]";

fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes")
}

fn run(scene: &str, set: &[&str], folder: &Path) -> Report {
    let mut source = SceneSource::read(&scenes().join(format!("{scene}.toml"))).unwrap();
    for assignment in set {
        source.set(assignment).unwrap();
    }
    Study::resolve(&source).unwrap().run(folder, &|_, _| true).unwrap()
}

#[test]
fn every_scene_file_has_an_expected_verdict() {
    let mut names: Vec<String> = std::fs::read_dir(scenes())
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .map(|path| path.file_stem().unwrap().to_string_lossy().into_owned())
        .collect();
    names.sort();
    let mut expected: Vec<&str> = EXPECTED.iter().map(|e| e.scene).collect();
    expected.sort_unstable();
    assert_eq!(names, expected);
}

fn worst_box_error(report: &Report) -> Option<f64> {
    let error = report.compact.relative_error?;
    Some(
        error
            .extents
            .into_iter()
            .chain([error.area, error.volume])
            .fold(0.0, |a: f64, b| a.max(b.abs())),
    )
}

#[test]
fn every_scene_has_its_verdict_and_writes_its_files() {
    let home = tempfile::tempdir().unwrap();
    for Expected { scene, verdict, status } in EXPECTED {
        let folder = home.path().join(scene);
        let report = run(scene, &SMALL_FILM, &folder);
        let kind = if *status == 1 { OutcomeKind::Collides } else { OutcomeKind::Folded };
        assert_eq!(report.outcome.kind, kind, "{scene}");
        assert_eq!(
            (report.collision.verdict.name(), report.status()),
            (*verdict, *status),
            "{scene}"
        );
        assert!(report.stages.iter().all(|s| s.converged && s.reached_t >= 1.0), "{scene}");
        // Layers are a gap of 1e-3 h apart, and there are eight of them in a column; long stacks add up.
        assert!(
            report.compact.rms_to_exact.unwrap()
                < f64::max(2e-2, 1.5e-3 * report.rows.unwrap() as f64),
            "{scene}: {}",
            report.compact.rms_to_exact.unwrap()
        );
        let is_equal = report.unequal_rows.is_none();
        assert_eq!(report.division.as_ref().unwrap().max_residual <= 1e-12, is_equal, "{scene}");
        for file in ["report.json", "motion.fold", "motion.gif", "motion.csv", "plots.svg"] {
            assert!(folder.join(file).metadata().unwrap().len() > 0, "{scene}: {file}");
        }
        let written = std::fs::read_to_string(folder.join("report.json")).unwrap();
        assert_eq!(serde_json::from_str::<Report>(&written).unwrap(), report, "{scene}");
        assert_eq!(
            *verdict == "penetrating",
            report.collision.first.is_some(),
            "{scene}: a witness is given"
        );
        if *verdict == "free" && report.rows.unwrap() > 1 {
            assert!(report.collision.min_separation.unwrap() > 1e-6, "{scene}");
        }
    }
}

#[test]
fn the_dynamic_engine_reaches_the_exact_compact_state_with_the_verdicts_measured() {
    let home = tempfile::tempdir().unwrap();
    for Expected { scene, verdict, status } in DYNAMIC {
        let set = ["motion.engine=dynamic", "motion.contact=false", REPORT_ONLY];
        let report = run(scene, &set, &home.path().join(scene));
        assert_eq!(
            (report.collision.verdict.name(), report.status()),
            (*verdict, *status),
            "{scene}"
        );
        assert!(report.stages.iter().all(|s| s.converged), "{scene}");
        assert!(
            report.compact.rms_to_exact.unwrap() < 1e-3,
            "{scene}: {}",
            report.compact.rms_to_exact.unwrap()
        );
        assert!(worst_box_error(&report).is_none_or(|e| e < 1e-3), "{scene}");
    }
}

#[test]
fn without_contact_the_quasi_static_engine_ends_on_the_exact_compact_state_at_any_stiffness() {
    let home = tempfile::tempdir().unwrap();
    for scene in ["shelter-e", "shelter-t", "shelter-s", "shelter-sii"] {
        for stiffness in [20, 2_000, 20_000] {
            let set = [
                "motion.contact=false",
                "motion.frames=120",
                REPORT_ONLY,
                &format!("material.axial_stiffness={stiffness}.0"),
            ];
            let report = run(scene, &set, home.path());
            assert!(report.stages.iter().all(|s| s.converged), "{scene} at {stiffness}");
            let rms = report.compact.rms_to_exact.unwrap();
            assert!(rms < 1e-9, "{scene} at {stiffness}: {rms}");
        }
    }
}

/// The stiff sheet snaps many times: with these numbers of frames, load steps once shrank without limit.
#[test]
fn a_near_rigid_sheet_without_contact_folds_up_whatever_the_number_of_frames() {
    for frames in [180, 200, 240] {
        let home = tempfile::tempdir().unwrap();
        let frames = format!("motion.frames={frames}");
        let set = ["material.preset=near-rigid", "motion.contact=false", &frames, REPORT_ONLY];
        let report = run("shelter-t", &set, home.path());
        assert!(report.stages.iter().all(|s| s.converged), "{frames}");
        assert!(report.outcome.is_at_end(), "{frames}: {}", report.outcome.line());
        assert_eq!(report.stop, None);
        let rms = report.compact.rms_to_exact.unwrap();
        assert!(rms < 1e-9, "{frames}: {rms}");
    }
}

#[test]
fn contact_stops_short_plain_rectangles_and_names_what_blocks() {
    let home = tempfile::tempdir().unwrap();
    let report = run("shelter-short-plain", &["motion.contact=true", REPORT_ONLY], home.path());
    assert_eq!((report.status(), report.collision.verdict.name()), (3, "free"));
    let jam = report.jam.unwrap();
    assert!(jam.t > 1.0 && jam.t < 2.0 && !jam.facets.is_empty(), "{jam:?}");
}

/// The sheet jams at t = 2 with another stack of layers than in the compact state.
#[test]
fn a_jammed_sheet_claims_no_order_of_layers_that_it_does_not_have() {
    let home = tempfile::tempdir().unwrap();
    let set = ["material.preset=near-rigid", "motion.frames=200", "record.outputs=[\"fold\"]"];
    let report = run("shelter-t", &set, home.path());
    assert_eq!(report.outcome.kind, OutcomeKind::Jammed);
    assert_eq!(report.collision.verdict.name(), "free");
    let motion = home.path().join("motion.fold");
    let checked = check_file(&motion, &CheckOptions::default(), &|_, _| true).unwrap();
    let orders = checked.certificate.layer_orders;
    assert!(orders.claimed > orders.ignored, "{orders:?}");
}

/// Equations 3 to 7: the box of the sheet that closes in contact, each extent, the area and the volume.
#[test]
fn the_compact_box_of_every_case_meets_the_closed_form_with_contact() {
    let home = tempfile::tempdir().unwrap();
    for scene in ["shelter-e", "shelter-t", "shelter-s", "shelter-sii"] {
        let report = run(scene, &[REPORT_ONLY], home.path());
        assert_eq!(report.outcome.kind, OutcomeKind::Folded, "{scene}");
        assert_eq!(report.collision.verdict.name(), "free", "{scene}");
        let error = report.compact.relative_error.unwrap();
        let all = error.extents.into_iter().chain([error.area, error.volume]);
        assert!(all.clone().all(|e| e.abs() < 1e-3), "{scene}: {error:?}");
        assert!(all.into_iter().any(|e| e > 1e-6), "{scene}: layers keep a gap");
        let engine = report.engine;
        assert_eq!(engine.contact_gap, Some(1e-3), "{scene}");
        assert!((engine.final_gap.unwrap() / 1e-5 - 1.0).abs() < 1e-9, "{scene}");
    }
}

/// Bars that strain by less than a thousandth leave creases open by little, not by the root of the gap.
#[test]
fn near_rigid_stacks_close_with_little_strain() {
    let home = tempfile::tempdir().unwrap();
    for scene in ["shelter-s", "shelter-sii"] {
        let set = ["material.preset=near-rigid", REPORT_ONLY];
        let report = run(scene, &set, home.path());
        assert_eq!(report.outcome.kind, OutcomeKind::Folded, "{scene}");
        let error = report.compact.relative_error.unwrap();
        assert!(error.extents.iter().all(|e| e.abs() < 1e-3), "{scene}: {error:?}");
        assert!(report.stages.iter().all(|stage| stage.peak_strain < 1e-3), "{scene}");
    }
}

/// Gaps of 4, 2 and 1 thousandths: the box shrinks in proportion, and its extrapolation to no gap is the closed form.
#[test]
fn the_compact_box_converges_linearly_with_the_gap() {
    let home = tempfile::tempdir().unwrap();
    let extents = [2e-3, 1e-3, 5e-4].map(|gap| {
        let keys = ["motion.gap", "motion.final_gap"].map(|key| format!("{key}={gap}"));
        let set = [&keys[0], &keys[1], "motion.frames=120", REPORT_ONLY];
        let report = run("shelter-s", &set, home.path());
        assert_eq!(report.collision.verdict.name(), "free");
        let closed = report.closed_form.unwrap().extents;
        std::array::from_fn::<f64, 3, _>(|i| {
            (report.compact.extents[i] - closed[i]) / report.unit.unwrap().height
        })
    });
    for axis in 0..3 {
        let [e4, e2, e1] = extents.map(|e| e[axis]);
        // Richardson: what is left at no gap after the linear part is taken off, but for the tenth of each gap that
        // eight layers may miss.
        let missed = |gap: f64| 8.0 * 0.1 * 2.0 * gap;
        assert!((2.0 * e1 - e2).abs() < missed(1e-3), "axis {axis}: {e4} {e2} {e1}");
        assert!((2.0 * e2 - e4).abs() < missed(2e-3), "axis {axis}: {e4} {e2} {e1}");
        assert!(e4 > e2 && e2 > e1 && e1 > 0.0, "axis {axis}: {e4} {e2} {e1}");
    }
}

/// Figure 4d: the ends of a mid line of a unit pass each other; C2–C6 in U^O, D1–D6 or D3–D8 in U^E.
#[test]
fn a_short_plain_unit_is_found_crossing_at_the_ends_of_a_mid_line() {
    let home = tempfile::tempdir().unwrap();
    let report = run("shelter-short-plain", &[REPORT_ONLY], home.path());
    let within = report.collision.first_within_unit.unwrap();
    let names: Vec<&str> = within.vertex_names.iter().flatten().map(String::as_str).collect();
    let pairs = [["C2", "C6"], ["D1", "D6"], ["D3", "D8"]];
    assert!(pairs.iter().any(|pair| pair.iter().all(|name| names.contains(name))), "{within:?}");
}

#[test]
fn one_square_unit_folds_to_half_its_width_times_its_height() {
    let home = tempfile::tempdir().unwrap();
    let report = run("one-unit", &["motion.contact=false", REPORT_ONLY], home.path());
    assert!((report.compact.area - 0.5).abs() < 1e-6 && report.compact.extents[1].abs() < 1e-6);
}

/// The timings and the number of threads are all that may differ.
#[test]
fn results_are_the_same_bytes_for_one_thread_and_for_two() {
    let home = tempfile::tempdir().unwrap();
    let mut reports = Vec::new();
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let folder = home.path().join(threads.to_string());
        let small =
            ["motion.frames=60", "record.size=[160, 120]", "sheet.rows=4", "profile.length=4.0"];
        let mut report = pool.install(|| run("shelter-sii", &small, &folder));
        report.engine.seconds = 0.0;
        report.engine.threads = 0;
        report.division.as_mut().unwrap().seconds = 0.0;
        report.seconds.check = 0.0;
        report.seconds.record = 0.0;
        report.seconds.total = 0.0;
        reports.push(report);
    }
    assert_eq!(reports[0], reports[1]);
    for file in ["motion.fold", "motion.gif", "motion.csv", "plots.svg"] {
        let bytes = |threads: &str| std::fs::read(home.path().join(threads).join(file)).unwrap();
        assert!(bytes("1") == bytes("2"), "{file}");
    }
}

/// The growing direction lies along x, the width along y, the flaps along −z in the last frame.
#[test]
fn the_compact_frame_of_the_file_has_the_right_orientation() {
    let home = tempfile::tempdir().unwrap();
    run(
        "shelter-s",
        &["record.outputs=[\"fold\"]", "motion.frames=40", "motion.contact=false"],
        home.path(),
    );
    let text = std::fs::read_to_string(home.path().join("motion.fold")).unwrap();
    let fold: serde_json::Value = serde_json::from_str(&text).unwrap();
    let last = fold["file_frames"].as_array().unwrap().last().unwrap();
    let coords: Vec<[f64; 3]> = serde_json::from_value(last["vertices_coords"].clone()).unwrap();
    let span = |axis: usize| {
        let values = coords.iter().map(|p| p[axis]);
        (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max))
    };
    let (x, y, z) = (span(0), span(1), span(2));
    assert!((x.0 + 4.0).abs() < 1e-3 && x.1.abs() < 1e-3, "{x:?}");
    assert!(y.0.abs() < 1e-3 && (y.1 - 2.0).abs() < 1e-3, "{y:?}");
    assert!((z.0 + 0.5).abs() < 1e-3 && z.1.abs() < 1e-3, "{z:?}");
    assert_eq!(last["foldmotion:time"].as_f64(), Some(2.0));
}

#[test]
fn an_interrupted_run_leaves_earlier_results_as_they_were() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("results");
    run("one-unit", &[REPORT_ONLY], &folder);
    let before = std::fs::read(folder.join("report.json")).unwrap();
    let source = SceneSource::read(&scenes().join("one-unit.toml")).unwrap();
    let error = Study::resolve(&source).unwrap().run(&folder, &|_, done| done < 0.5).unwrap_err();
    assert_eq!(error.status(), 3);
    assert_eq!(std::fs::read(folder.join("report.json")).unwrap(), before);
    assert_eq!(std::fs::read_dir(home.path()).unwrap().count(), 1, "nothing half-written is left");
}
