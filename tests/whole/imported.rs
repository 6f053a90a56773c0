//! Crease patterns of files, run from end to end.

use std::path::{Path, PathBuf};

use foldmotion_study::{
    CheckOptions, Report, SceneSource, Study, check_file,
    report::{ImportReport, OutcomeKind},
};
use serde_json::{Value, json};

/// A Miura sheet whose facets stay flat.
const RIGID: [&str; 2] = ["material.preset=near-rigid", "material.facet_stiffness=1000"];

fn example(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/imported").join(name)
}

fn study(path: &Path, set: &[&str]) -> Study {
    let mut source = SceneSource::read(path).unwrap();
    for assignment in set {
        source.set(assignment).unwrap();
    }
    Study::resolve(&source).unwrap()
}

/// Runs with few frames; the report and the motion file.
fn run(path: &Path, set: &[&str]) -> (Report, Value) {
    let folder = tempfile::tempdir().unwrap();
    let few = ["motion.frames=24", "record.outputs=[\"fold\"]"];
    let study = study(path, &[&few, set].concat());
    let report = study.run(folder.path(), &|_, _| true).unwrap();
    let text = std::fs::read_to_string(folder.path().join("motion.fold")).unwrap();
    // A check of the file gives the same verdict.
    let path = folder.path().join("motion.fold");
    let checked = check_file(&path, &CheckOptions::default(), &|_, _| true).unwrap();
    assert_eq!(checked.certificate.verdict, report.collision.verdict);
    (report, serde_json::from_str(&text).unwrap())
}

fn run_fold(file: &Value, set: &[&str]) -> (Report, Value) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.fold");
    std::fs::write(&path, file.to_string()).unwrap();
    run(&path, set)
}

/// The fold angles, in degrees, of the edges of a frame that `picks` them by letter and ends in the pattern.
fn angles(motion: &Value, frame: &Value, picks: impl Fn(&str, [[f64; 2]; 2]) -> bool) -> Vec<f64> {
    let places: Vec<[f64; 2]> = serde_json::from_value(motion["vertices_coords"].clone()).unwrap();
    let edges: Vec<[usize; 2]> = serde_json::from_value(motion["edges_vertices"].clone()).unwrap();
    let letters: Vec<String> = serde_json::from_value(motion["edges_assignment"].clone()).unwrap();
    let angles: Vec<Option<f64>> =
        serde_json::from_value(frame["edges_foldAngle"].clone()).unwrap();
    let picked = edges.iter().zip(&letters).zip(angles);
    picked
        .filter(|((ends, letter), _)| picks(letter.as_str(), ends.map(|v| places[v])))
        .map(|(_, angle)| angle.unwrap())
        .collect()
}

fn frames(motion: &Value) -> &[Value] {
    motion["file_frames"].as_array().unwrap()
}

fn time(frame: &Value) -> f64 {
    frame["foldmotion:time"].as_f64().unwrap()
}

/// Vertices, facets, mountains, valleys, borders, V − E + F.
type Counts = (usize, usize, usize, usize, usize, i64);

#[test]
fn every_example_has_its_known_counts_in_both_formats() {
    let known: [(&str, Counts); 6] = [
        ("miura", (25, 16, 10, 14, 16, 1)),
        ("bird-base", (17, 24, 20, 12, 8, 1)),
        ("crane", (48, 52, 54, 35, 10, 1)),
        ("square-twist", (16, 9, 8, 4, 12, 1)),
        ("pop-up", (14, 4, 1, 4, 14, -1)),
        ("frame", (8, 4, 2, 2, 8, 0)),
    ];
    for (name, expected) in known {
        for ending in ["svg", "fold"] {
            let study = study(&example(&format!("{name}.{ending}")), &[]);
            let imported = &study.subject.imported().unwrap().imported;
            let count = |letter| {
                let edges = imported.sheet.edges.iter();
                edges.filter(|e| e.assignment.letter() == letter).count()
            };
            let found = (
                imported.sheet.vertices.len(),
                imported.sheet.facets.len(),
                count('M'),
                count('V'),
                count('B'),
                imported.euler_characteristic(),
            );
            assert_eq!(found, expected, "{name}.{ending}");
            assert_eq!(study.title, name);
        }
    }
}

#[test]
fn a_miura_sheet_folds_along_the_closed_form_of_its_rigid_motion() {
    // tan(θ across / 2) = cos γ tan(θ zigzag / 2), with γ the sharp angle between the two kinds of crease.
    let cosine = f64::cos(f64::atan2(1.25, 0.5));
    let (report, motion) = run(&example("miura.svg"), &RIGID);
    assert_eq!((report.status(), report.stages.len()), (0, 1));
    assert!(report.stages[0].peak_strain < 1e-3);
    let half = |degrees: &f64| (degrees.abs().to_radians() / 2.0).tan();
    let mut compared = 0;
    for frame in frames(&motion).iter().filter(|f| (1.1..1.9).contains(&time(f))) {
        let is_crease = |letter: &str| letter == "M" || letter == "V";
        let is_across = |[a, b]: [[f64; 2]; 2]| (a[1] - b[1]).abs() < 1e-9;
        let across = angles(&motion, frame, |l, ends| is_crease(l) && is_across(ends));
        let zigzag = angles(&motion, frame, |l, ends| is_crease(l) && !is_across(ends));
        for (a, z) in across.iter().zip(&zigzag) {
            let ratio = half(a) / half(z);
            assert!((ratio / cosine - 1.0).abs() < 0.01, "{ratio} {cosine}");
            compared += 1;
        }
    }
    assert!(compared >= 100);
    // All layers are on one parallelogram, except for the gaps between them.
    let [_, _, height] = report.compact.extents;
    assert!(height < 0.02, "{:?}", report.compact);
}

#[test]
fn the_report_of_an_import_has_no_unit_and_starts_at_the_flat_sheet() {
    let (report, motion) = run(&example("miura.fold"), &[]);
    assert!(report.case.is_none() && report.rows.is_none() && report.unit.is_none());
    assert!(report.division.is_none() && report.profile.is_none() && report.unfold.is_none());
    assert!(report.closed_form.is_none() && report.compact.rms_to_exact.is_none());
    assert!(report.pattern.developable && report.pattern.flat_foldable);
    let import: ImportReport = report.import.unwrap();
    assert_eq!((import.mountains, import.valleys), (10, 14));
    assert_eq!((import.stages, import.fold_percent), (1, 100.0));
    let first = &frames(&motion)[0];
    assert_eq!(time(first), 1.0);
    assert!(angles(&motion, first, |letter, _| letter != "B").iter().all(|a| *a == 0.0));
    assert_eq!(time(frames(&motion).last().unwrap()), 2.0);
    assert_eq!(report.stages[0].name.name(), "fold");
}

#[test]
fn a_square_twist_strains_or_bends_its_facets_because_it_is_not_rigid_foldable() {
    let (soft, _) = run(&example("square-twist.svg"), &[]);
    assert_eq!((soft.status(), soft.collision.verdict.name()), (0, "free"));
    assert!(soft.stages[0].peak_strain > 0.02);
    let (paper, _) =
        run(&example("square-twist.svg"), &["material.preset=near-rigid", "motion.contact=false"]);
    assert!(paper.stages[0].peak_strain < 2e-3);
    assert!(paper.stages[0].peak_facet_bending_deg > 10.0);
}

#[test]
fn a_card_with_cuts_pops_up_without_strain() {
    for ending in ["svg", "fold"] {
        let (report, motion) = run(&example(&format!("pop-up.{ending}")), &[]);
        assert_eq!(report.status(), 0);
        assert!(report.stages[0].peak_strain < 1e-3);
        // Half way all creases are at a right angle: the strip stands off the card like a box.
        let half = frames(&motion).iter().find(|f| time(f) == 1.5).unwrap();
        let folded = angles(&motion, half, |l, _| l == "M" || l == "V");
        assert!(folded.iter().all(|a| (a.abs() - 90.0).abs() < 0.5), "{folded:?}");
        let [x, y, z] = report.compact.extents;
        assert!((x - 4.0).abs() < 0.01 && (y - 2.0).abs() < 0.01 && z < 0.05);
    }
}

#[test]
fn a_frame_with_a_hole_folds_in_steps_and_one_facet_stays_in_place() {
    let (report, motion) = run(&example("frame.toml"), &[]);
    // Its mitres do not allow 108 degrees at all four corners: it comes to rest before, and the outcome says so.
    assert_eq!(report.outcome.kind, OutcomeKind::NotConverged);
    assert!(report.fold_angles.largest_error_deg > 20.0);
    assert_eq!((report.status(), report.length_unit.as_str()), (3, "cm"));
    let import = report.import.unwrap();
    assert_eq!((import.euler_characteristic, import.fixed_facet), (0, Some(0)));
    let study = study(&example("frame.toml"), &[]);
    let sheet = study.subject.sheet();
    for frame in frames(&motion) {
        let places: Vec<[f64; 3]> =
            serde_json::from_value(frame["vertices_coords"].clone()).unwrap();
        // The facet may bend and strain a little; its middle does not move.
        let corners = &sheet.facets[0].polygon;
        for axis in 0..3 {
            let off = |&v: &u32| {
                let own = sheet.vertices[v as usize].extend(0.0);
                places[v as usize][axis] - own[axis]
            };
            assert!(corners.iter().map(off).sum::<f64>().abs() < 1e-9);
        }
    }
    // Valleys wait until 0.4 of the stage.
    let early = frames(&motion).iter().find(|f| (time(f) - 4.0 / 3.0).abs() < 1e-9).unwrap();
    let largest = |letter| {
        let found = angles(&motion, early, |l, _| l == letter);
        found.iter().fold(0.0, |a: f64, b| a.max(b.abs()))
    };
    assert!(largest("M") > 1.5 * largest("V"), "{} {}", largest("M"), largest("V"));
}

#[test]
fn a_bird_base_folds_and_a_crane_is_reported_not_to_reach_its_end() {
    let (report, _) = run(&example("bird-base.fold"), &[]);
    assert_eq!((report.status(), report.collision.verdict.name()), (0, "free"));
    let (report, _) = run(&example("crane.svg"), &[]);
    assert_eq!(report.status(), 3);
    assert!(report.jam.is_some() || !report.stages[0].converged);
}

#[test]
fn snaps_are_listed_with_their_times_and_the_energy_they_released() {
    let (report, _) = run(&example("bird-base.fold"), &[]);
    let snaps = &report.stages[0].snaps;
    assert!(!snaps.is_empty());
    for snap in snaps {
        assert!(snap.is_over && snap.energy_released > 0.0, "{snap:?}");
        assert!(1.0 <= snap.from_t && snap.from_t < snap.to_t && snap.to_t <= 2.0, "{snap:?}");
    }
    assert!(snaps.windows(2).all(|pair| pair[0].to_t <= pair[1].from_t));
    let (report, _) = run(&example("miura.fold"), &[]);
    assert!(report.stages[0].snaps.is_empty(), "a Miura sheet does not snap");
}

#[test]
fn a_jam_is_what_goes_on_without_contact_and_what_does_not_is_too_stiff() {
    let (crane, _) = run(&example("crane.fold"), &[]);
    let without = crane.fold_angles.mean_error_without_contact_deg.unwrap();
    assert_eq!(crane.outcome.kind, OutcomeKind::Jammed);
    assert!(without < 1.0 && crane.fold_angles.mean_error_deg > 10.0, "{without}");
    let (frame, _) = run(&example("frame.fold"), &[]);
    let without = frame.fold_angles.mean_error_without_contact_deg.unwrap();
    assert_eq!(frame.outcome.kind, OutcomeKind::NotConverged);
    assert!(without > 0.8 * frame.fold_angles.mean_error_deg, "{without}");
    assert!(frame.jam.is_none());
}

#[test]
fn what_a_budget_ends_is_stopped_where_it_is_even_where_layers_push() {
    let (report, _) = run(&example("crane.fold"), &["motion.budget=\"500 steps\""]);
    assert_eq!((report.outcome.kind, report.status()), (OutcomeKind::Stopped, 3));
    assert!(report.jam.is_none() && report.stages[0].most_contacts > 0);
    let last = report.path.end_t;
    assert!((report.outcome.t - last).abs() < 1e-9, "{} {last}", report.outcome.t);
}

/// A strip of three panels with two creases, whose frames fold one after the other.
fn strip() -> Value {
    let angles = |a: f64, b: f64| json!([null, null, null, null, null, null, null, null, a, b]);
    json!({
        "file_spec": 1.2, "file_author": "somebody", "frame_unit": "mm",
        "edges_own:weight": [0, 1, 2, 3, 4, 5, 6, 7, 8, 9],
        "vertices_coords": [[0, 0], [1, 0], [2, 0], [3, 0], [3, 1], [2, 1], [1, 1], [0, 1]],
        "edges_vertices": [[0, 1], [1, 2], [2, 3], [3, 4], [4, 5], [5, 6], [6, 7], [7, 0], [1, 6], [2, 5]],
        "edges_assignment": ["B", "B", "B", "B", "B", "B", "B", "B", "V", "M"],
        "edges_foldAngle": angles(120.0, -60.0),
        "faces_vertices": [[0, 1, 6, 7], [1, 2, 5, 6], [2, 3, 4, 5]],
        "file_frames": [
            {"frame_parent": 0, "frame_inherit": true, "edges_foldAngle": angles(90.0, 0.0)},
            {"frame_parent": 0, "frame_inherit": true, "edges_foldAngle": angles(30.0, -80.0)},
        ],
    })
}

/// The angles of the valley and the mountain crease of the strip at a time.
fn strip_angles(motion: &Value, at: f64) -> [f64; 2] {
    let frame = frames(motion).iter().find(|f| time(f) == at).unwrap();
    ["V", "M"].map(|letter| angles(motion, frame, |l, _| l == letter)[0])
}

fn assert_near(found: [f64; 2], expected: [f64; 2]) {
    let is_near = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-4);
    assert!(is_near, "{found:?} {expected:?}");
}

#[test]
fn frames_with_angles_are_stages_and_the_last_is_the_end() {
    let (report, motion) = run_fold(&strip(), &["motion.frames=6"]);
    assert_eq!(report.import.unwrap().stages, 2);
    // The end of the first frame is recorded though it lies between the frames asked for.
    assert_near(strip_angles(&motion, 1.5), [90.0, 0.0]);
    assert_near(strip_angles(&motion, 2.0), [30.0, -80.0]);
    let (report, motion) = run_fold(&strip(), &["pattern.stages=false"]);
    assert_eq!(report.import.unwrap().stages, 1);
    assert_near(strip_angles(&motion, 2.0), [120.0, -60.0]);
    let dynamic = ["motion.engine=dynamic", "pattern.fold_percent=50"];
    let (_, motion) = run_fold(&strip(), &dynamic);
    // The dynamic engine lags behind a little during the motion.
    let [valley, mountain] = strip_angles(&motion, 1.5);
    assert!((valley - 45.0).abs() < 0.1 && mountain.abs() < 0.1);
    assert_near(strip_angles(&motion, 2.0), [15.0, -40.0]);
}

#[test]
fn a_negative_percentage_folds_inside_out() {
    let set = ["pattern.stages=false", "pattern.fold_percent=-50"];
    let (_, motion) = run_fold(&strip(), &set);
    assert_near(strip_angles(&motion, 2.0), [-60.0, 30.0]);
}

#[test]
fn unknown_keys_and_the_unit_are_preserved_in_the_motion_file() {
    let (report, motion) = run_fold(&strip(), &[]);
    assert_eq!(report.length_unit, "mm");
    assert_eq!(motion["frame_unit"], "mm");
    assert_eq!(motion["file_author"], "somebody");
    let ends: Vec<[u32; 2]> = serde_json::from_value(motion["edges_vertices"].clone()).unwrap();
    let weights: Vec<Option<u32>> =
        serde_json::from_value(motion["edges_own:weight"].clone()).unwrap();
    assert_eq!(weights.len(), ends.len());
    let of_file: Vec<[u32; 2]> = serde_json::from_value(strip()["edges_vertices"].clone()).unwrap();
    for (ends, weight) in ends.iter().zip(weights) {
        // Those that cut the panels into triangles are new.
        let listed = of_file.iter().position(|e| e == ends).map(|k| k as u32);
        assert_eq!(listed, weight);
    }
}
