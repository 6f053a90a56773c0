//! The outcome is the first and last line of the output, and an exit status that is not 0 is explained even with `--quiet`.

#![expect(clippy::unwrap_used, reason = "a test fails where something is missing")]

mod common;

use std::fs;
use std::path::Path;
use std::process::Output;

use serde_json::{Value, json};

use common::{assert_status, foldmotion, text};

fn scene(name: &str) -> String {
    format!("{}/../../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

fn json_of(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).unwrap()).unwrap()
}

/// Runs `file` with only the motion file as output; returns the output and the report.
fn run(home: &Path, file: &str, more: &[&str]) -> (Output, Value) {
    let mut arguments = vec!["run", file, "--out", "out"];
    arguments.extend(["--set", "record.outputs=[\"fold\"]", "--set", "motion.frames=20"]);
    arguments.extend(more);
    let output = foldmotion(home, &arguments);
    let report = json_of(&home.join("out/report.json"));
    (output, report)
}

/// A square with a valley from each corner to its middle, which cannot fold flat.
fn four_valleys(home: &Path) -> String {
    let pattern = json!({
        "vertices_coords": [[0, 0], [4, 0], [4, 4], [0, 4], [2, 2]],
        "edges_vertices": [[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [1, 4], [2, 4], [3, 4]],
        "edges_assignment": ["B", "B", "B", "B", "V", "V", "V", "V"],
        "faces_vertices": [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]],
    });
    let path = home.join("valleys.fold");
    fs::write(&path, pattern.to_string()).unwrap();
    path.to_string_lossy().into_owned()
}

/// The outcome is in the first and the last line, in the report, in the motion file and, unless it is `folded`, on stderr.
fn assert_is_reported_everywhere(
    home: &Path,
    output: &Output,
    report: &Value,
    kind: &str,
    headline: &str,
) {
    let (out, err) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(report["outcome"]["kind"], kind, "{out}");
    assert!(out.starts_with(headline), "{out}");
    let last = out.lines().last().unwrap();
    assert!(last.starts_with(headline), "{out}");
    assert_eq!(json_of(&home.join("out/motion.fold"))["foldmotion:outcome"], last);
    let reason = report["outcome"]["reason"].as_str().unwrap();
    let reported = err.lines().any(|line| line == format!("foldmotion: {last}: {reason}"));
    assert_eq!(reported, kind != "folded", "{err}");
    let kept = ["motion.fold", "report.json"].map(|name| home.join("out").join(name).exists());
    assert_eq!(kept, [true; 2]);
}

#[test]
fn a_sheet_that_folds_is_reported_as_folded() {
    let home = tempfile::tempdir().unwrap();
    let (output, report) = run(home.path(), &scene("one-unit"), &[]);
    assert_status(&output, 0);
    assert_is_reported_everywhere(home.path(), &output, &report, "folded", "folded");
    assert!(report["fold_angles"]["largest_error_deg"].as_f64().unwrap() < 5.0);
}

#[test]
fn a_jam_is_reported_with_the_units_that_block_and_without_a_good_verdict() {
    let home = tempfile::tempdir().unwrap();
    let (output, report) =
        run(home.path(), &scene("shelter-short-plain"), &["--set", "motion.contact=true"]);
    assert_status(&output, 3);
    assert_is_reported_everywhere(home.path(), &output, &report, "jammed", "jammed at t = 1.");
    let reason = report["outcome"]["reason"].as_str().unwrap();
    assert!(reason.contains("of unit U^"), "{reason}");
    let out = text(&output.stdout);
    assert!(out.contains("collisions of the motion up to its last state: free"), "{out}");
    assert!(!out.contains("compact box"), "{out}");
}

#[test]
fn an_equilibrium_far_from_the_targets_is_not_reported_as_folded() {
    let home = tempfile::tempdir().unwrap();
    let file = four_valleys(home.path());
    let (output, report) = run(home.path(), &file, &["--set", "motion.contact=false"]);
    assert_status(&output, 3);
    assert_is_reported_everywhere(
        home.path(),
        &output,
        &report,
        "not-converged",
        "did not converge",
    );
    let angles = &report["fold_angles"];
    assert!(angles["largest_error_deg"].as_f64() > angles["tolerance_deg"].as_f64());
    // The named edge is one of the four creases.
    let motion = json_of(&home.path().join("out/motion.fold"));
    let edge = angles["edge"].as_u64().unwrap() as usize;
    assert_eq!(motion["edges_assignment"][edge], "V");
}

#[test]
fn a_sheet_that_passes_through_itself_collides() {
    let home = tempfile::tempdir().unwrap();
    let set = ["--set", "sheet.rows=2", "--set", "profile.length=2.0"];
    let (output, report) = run(home.path(), &scene("shelter-short-plain"), &set);
    assert_status(&output, 1);
    assert_is_reported_everywhere(home.path(), &output, &report, "collides", "collides at t = ");
    assert_eq!(report["outcome"]["t"], report["collision"]["first"]["t"]);
}

#[test]
fn a_budget_of_steps_ends_a_run_always_at_the_same_state() {
    let home = tempfile::tempdir().unwrap();
    for engine in ["quasi-static", "dynamic"] {
        let set = format!("motion.engine={engine}");
        let budget = ["--set", &set, "--budget", "150 steps"];
        let (output, report) = run(home.path(), &scene("one-unit"), &budget);
        assert_eq!(output.status.code(), Some(3), "{engine}");
        assert_is_reported_everywhere(home.path(), &output, &report, "stopped", "stopped at t = ");
        assert_eq!(report["stop"]["reason"], "out-of-steps");
        let steps = report["engine"]["steps"].as_u64().unwrap();
        assert!((100..=160).contains(&steps), "{engine}: {steps}");
        let motion = fs::read(home.path().join("out/motion.fold")).unwrap();
        run(home.path(), &scene("one-unit"), &budget);
        assert_eq!(fs::read(home.path().join("out/motion.fold")).unwrap(), motion);
    }
}

#[test]
fn a_budget_of_time_ends_a_run() {
    let home = tempfile::tempdir().unwrap();
    for engine in ["quasi-static", "dynamic"] {
        let set = format!("motion.engine={engine}");
        let budget = ["--set", &set, "--budget", "1e-6"];
        let (output, report) = run(home.path(), &scene("shelter-sii"), &budget);
        assert_eq!(output.status.code(), Some(3), "{engine}");
        assert_eq!(report["stop"]["reason"], "out-of-time", "{engine}");
        assert!(report["outcome"]["t"].as_f64().unwrap() < 1.0);
    }
}

#[test]
fn an_invalid_budget_is_refused_with_its_flag_or_key() {
    let home = tempfile::tempdir().unwrap();
    for budget in ["0", "-1", "0 steps", "tomorrow", "1e300"] {
        let budget = format!("--budget={budget}");
        let output = foldmotion(home.path(), &["run", &scene("one-unit"), &budget]);
        let err = text(&output.stderr);
        assert_status(&output, 2);
        assert!(err.contains("--budget"), "{err}");
    }
    let set = ["run", &scene("one-unit"), "--set", "motion.budget=-3"];
    let err = text(&foldmotion(home.path(), &set).stderr);
    assert!(err.contains("motion.budget"), "{err}");
}

#[test]
fn a_status_that_is_not_0_is_explained_even_when_quiet() {
    let home = tempfile::tempdir().unwrap();
    let one_line = |output: &Output, status: i32, word: &str| {
        let err = text(&output.stderr);
        assert_status(output, status);
        assert_eq!(text(&output.stdout), "");
        assert_eq!(err.lines().count(), 1, "{err}");
        assert!(err.starts_with("foldmotion: ") && err.contains(word), "{err}");
    };
    let set = ["--set", "sheet.rows=2", "--set", "profile.length=2.0", "--quiet"];
    let (output, _) = run(home.path(), &scene("shelter-short-plain"), &set);
    one_line(&output, 1, "collides at t = ");
    let check = ["check", "out/motion.fold", "--out", "out", "--quiet"];
    one_line(&foldmotion(home.path(), &check), 1, "penetrating");
    // The certificate is made false.
    let path = home.path().join("out/certificate.json");
    let mut certificate = json_of(&path);
    certificate["verdict"] = "free".into();
    certificate["penetrations"] = json!([]);
    fs::write(&path, certificate.to_string()).unwrap();
    let verify = ["check", "out/motion.fold", "--verify", "out/certificate.json", "--quiet"];
    one_line(&foldmotion(home.path(), &verify), 2, "REFUTED");
}

#[test]
fn a_file_with_one_state_is_not_a_motion() {
    let home = tempfile::tempdir().unwrap();
    let file = four_valleys(home.path());
    for command in ["check", "record"] {
        let output = foldmotion(home.path(), &[command, &file]);
        let err = text(&output.stderr);
        assert_status(&output, 2);
        assert!(
            err.contains("a motion needs two or more") && err.contains("foldmotion run"),
            "{err}"
        );
        assert!(!home.path().join("out").exists());
    }
}
