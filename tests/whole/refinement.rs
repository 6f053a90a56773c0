//! If the recorded frames leave the verdict open, the engine records more.

use std::path::Path;

use foldmotion_check::straying;
use foldmotion_pattern::Frame;
use foldmotion_study::{Report, SceneSource, Study};
use glam::DVec3;

fn run(scene: &str, set: &[&str], folder: &Path) -> Report {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../scenes/{scene}.toml"));
    let mut source = SceneSource::read(&path).unwrap();
    for assignment in set.iter().chain(&["motion.contact=false"]) {
        source.set(assignment).unwrap();
    }
    let study = Study::resolve(&source).unwrap();
    study.run(folder, &|_, _| true).unwrap()
}

#[test]
fn a_coarse_recording_is_refined_until_its_verdict_is_that_of_the_motion() {
    let folder = tempfile::tempdir().unwrap();
    // Straight from 90° to 180° sheets of E and T cross themselves; the motion does not. Those of S and SII do not either
    // way, and need no more frames.
    for (scene, crosses) in
        [("shelter-e", true), ("shelter-t", true), ("shelter-s", false), ("shelter-sii", false)]
    {
        let report = run(scene, &["motion.frames=4", "record.outputs=[]"], folder.path());
        assert_eq!(report.collision.verdict.name(), "touching", "{scene}");
        let is_refined = report.path.refinements > 0;
        assert_eq!(is_refined, crosses, "{scene}: {:?}", report.path);
        assert_eq!(report.path.frames, 5 + report.path.added_frames, "{scene}");
    }
}

#[test]
fn a_motion_that_crosses_itself_is_refined_no_further_than_necessary() {
    let folder = tempfile::tempdir().unwrap();
    let none = "record.outputs=[]";
    let coarse = run("shelter-short-plain", &["motion.frames=6", none], folder.path());
    let fine = run("shelter-short-plain", &[none], folder.path());
    for report in [&coarse, &fine] {
        assert_eq!(report.collision.verdict.name(), "penetrating");
        assert_eq!(report.status(), 1);
    }
    assert_eq!(fine.path.refinements, 0, "{:?}", fine.path);
    let [coarse, fine] = [coarse, fine].map(|report| report.collision.first.unwrap().t);
    assert!((coarse - fine).abs() < 0.02, "{coarse} {fine}");
}

/// The frames of `motion.fold`.
fn frames(folder: &Path) -> Vec<Frame> {
    let text = std::fs::read_to_string(folder.join("motion.fold")).unwrap();
    let file: serde_json::Value = serde_json::from_str(&text).unwrap();
    let positions = |frame: &serde_json::Value| -> Vec<[f64; 3]> {
        serde_json::from_value(frame["vertices_coords"].clone()).unwrap()
    };
    let frames = file["file_frames"].as_array().unwrap().iter();
    frames
        .map(|frame| Frame {
            time: frame["foldmotion:time"].as_f64().unwrap(),
            positions: positions(frame).into_iter().map(DVec3::from).collect(),
        })
        .collect()
}

/// Every other frame of a motion, against the chords of the rest. The sheet is free in space and drifts a little
/// unevenly, so an estimate from second differences misses here and there.
#[test]
fn the_reported_straying_is_that_of_intermediate_frames() {
    let folder = tempfile::tempdir().unwrap();
    let set = ["motion.frames=48", "record.outputs=[\"fold\"]"];
    let report = run("shelter-s", &set, folder.path());
    let all = frames(folder.path());
    let coarse: Vec<Frame> = all.iter().step_by(2).cloned().collect();
    let estimates = straying(&coarse);
    let mut right = 0;
    for (k, estimate) in estimates.iter().enumerate() {
        let [from, between, to] = [0, 1, 2].map(|j| &all[2 * k + j].positions);
        let chords = from.iter().zip(to).map(|(p, q)| p.midpoint(*q));
        let measured = chords.zip(between).map(|(p, q)| p.distance(*q)).fold(0.0, f64::max);
        right += usize::from(*estimate > 0.5 * measured && *estimate < 5.0 * measured);
    }
    assert!(right * 6 >= estimates.len() * 5, "{right} of {}", estimates.len());
    let largest = straying(&all).into_iter().fold(0.0, f64::max);
    let reported = report.path.straying.unwrap() * report.unit.unwrap().height;
    assert!((reported - largest).abs() < 1e-9 * largest, "{reported} {largest}");
}
