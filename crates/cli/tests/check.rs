//! `foldmotion check` as a user sees it.

#![expect(clippy::unwrap_used, reason = "a test fails where something is missing")]

mod common;

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use common::{assert_status, foldmotion, text};

fn json_of(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).unwrap()).unwrap()
}

/// Runs a scene with only the motion file as output; returns the report.
fn run(home: &Path, scene: &str, set: &[&str]) -> Value {
    let scene = format!("{}/../../scenes/{scene}.toml", env!("CARGO_MANIFEST_DIR"));
    let mut arguments = vec!["run", &scene, "--quiet", "--out", "run"];
    for assignment in ["record.outputs=[\"fold\"]", "motion.frames=20"].iter().chain(set) {
        arguments.extend(["--set", assignment]);
    }
    let output = foldmotion(home, &arguments);
    assert!(matches!(output.status.code(), Some(0 | 1)), "{}", text(&output.stderr));
    json_of(&home.join("run/report.json"))
}

/// The certificate agrees with the report in everything both say.
fn agrees(report: &Value, certificate: &Value) {
    let collision = &report["collision"];
    assert_eq!(certificate["verdict"], collision["verdict"]);
    for of_work in ["pairs_tested", "decided_by", "touching_pairs"] {
        assert!(certificate[of_work].is_null() && !collision[of_work].is_null());
    }
    assert_eq!(certificate["unit_length"], report["unit"]["height"]);
    let separation = &certificate["min_separation"];
    assert_eq!(separation["distance"].as_f64(), collision["min_separation"].as_f64());
    let penetrations = certificate["penetrations"].as_array().unwrap();
    assert_eq!(json!(penetrations.len()), collision["penetrating_pairs"]);
    if let Some(first) = penetrations.first() {
        assert_eq!(first["depth"], collision["first"]["depth"]);
        assert_eq!(first["pair"]["facets"], collision["first"]["facets"]);
        assert_eq!(first["t"], collision["first"]["t"]);
    }
}

/// A change that makes a motion invalid, and a text of the message.
type Change<'a> = (&'a dyn Fn(&mut Value), &'a str);

#[test]
fn motions_of_runs_get_the_verdict_of_their_run() {
    let short = ["sheet.rows=2", "profile.length=2.0"];
    for (scene, set, status) in [("one-unit", &[][..], 0), ("shelter-short-plain", &short[..], 1)] {
        let home = tempfile::tempdir().unwrap();
        let report = run(home.path(), scene, set);
        let output = foldmotion(home.path(), &["check", "run/motion.fold"]);
        let (out, err) = (text(&output.stdout), text(&output.stderr));
        assert_status(&output, status);
        assert!(out.contains("verdict: ") && out.contains("sha256 "), "{out}");
        assert!(err.contains("check "), "{err}");
        agrees(&report, &json_of(&home.path().join("out/motion/certificate.json")));
    }
}

#[test]
fn a_vertex_moved_through_the_sheet_is_a_penetration() {
    let home = tempfile::tempdir().unwrap();
    run(home.path(), "one-unit", &[]);
    let path = home.path().join("run/motion.fold");
    let mut motion = json_of(&path);
    // A vertex is moved through another facet.
    let frame = &mut motion["file_frames"][14]["vertices_coords"];
    let points: Vec<[f64; 3]> = serde_json::from_value(frame.clone()).unwrap();
    let far = points.len() - 1;
    let to: Vec<f64> = (0..3).map(|i| 2.0 * points[0][i] - points[far][i]).collect();
    frame[far] = json!(to);
    fs::write(&path, motion.to_string()).unwrap();
    let arguments = ["check", "run/motion.fold", "--out", "run", "--json", "--quiet"];
    let output = foldmotion(home.path(), &arguments);
    assert_status(&output, 1);
    let written = fs::read(home.path().join("run/certificate.json")).unwrap();
    assert_eq!(text(&output.stdout), text(&written));
    let err = text(&output.stderr);
    assert!(err.starts_with("foldmotion: penetrating") && err.lines().count() == 1, "{err}");
    assert!(home.path().join("run/report.json").exists(), "foreign files stay");
    let certificate: Value = serde_json::from_slice(&written).unwrap();
    let first = &certificate["penetrations"][0];
    assert!(first["frames"] == json!([13, 14]) || first["frames"] == json!([14, 15]), "{first}");
    assert_eq!(text(&foldmotion(home.path(), &arguments).stdout), text(&written));
}

/// A square of polygons that folds along its middle by `angle` degrees at its last frame.
fn folding(angle: f64) -> Value {
    let frame = |angle: f64| {
        let (s, c) = angle.to_radians().sin_cos();
        json!({ "frame_parent": 0, "frame_inherit": true, "vertices_coords":
            [[-1, 0], [0, 0], [0, 1], [-1, 1], [c, 0, s], [c, 1, s]] })
    };
    json!({
        "vertices_coords": [[-1, 0], [0, 0], [0, 1], [-1, 1], [1, 0], [1, 1]],
        "frame_classes": ["creasePattern"],
        "faces_vertices": [[0, 1, 2, 3], [1, 4, 5, 2]],
        "file_frames": (0..=8).map(|k| frame(angle * f64::from(k) / 8.0)).collect::<Vec<_>>(),
    })
}

#[test]
fn polygons_are_checked_and_the_certificate_says_that_they_were_cut() {
    let home = tempfile::tempdir().unwrap();
    for (angle, verdict, status) in [(120.0, "free", 0), (240.0, "penetrating", 1)] {
        fs::write(home.path().join("book.fold"), folding(angle).to_string()).unwrap();
        let output = foldmotion(home.path(), &["check", "book.fold", "--quiet", "--json"]);
        assert_status(&output, status);
        let certificate: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(certificate["verdict"], verdict);
        assert_eq!((&certificate["faces"], &certificate["triangles"]), (&json!(2), &json!(4)));
        let said = certificate["assumptions"].to_string();
        assert!(said.contains("2 faces with more than three corners were cut"), "{said}");
    }
}

#[test]
fn the_given_tolerance_is_certified() {
    let home = tempfile::tempdir().unwrap();
    fs::write(home.path().join("book.fold"), folding(90.0).to_string()).unwrap();
    let arguments = ["check", "book.fold", "--json", "--quiet", "--tolerance", "1e-4"];
    let output = foldmotion(home.path(), &arguments);
    let certificate: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(certificate["tolerance"], json!(1e-4));
}

#[test]
fn bad_motions_are_status_2_and_write_no_files() {
    let home = tempfile::tempdir().unwrap();
    let flat = |v: &mut Value| v["file_frames"][4]["vertices_coords"][4] = json!([0, 0, 0]);
    let backwards = |v: &mut Value| {
        for (k, frame) in v["file_frames"].as_array_mut().unwrap().iter_mut().enumerate() {
            frame["foldmotion:time"] = json!(-(k as f64));
        }
    };
    let changes: [Change<'_>; 3] = [
        (&flat, "file_frames[4]: faces_vertices[1] has no area"),
        (&backwards, "file_frames[1]: "),
        (&|v| v["faces_vertices"] = json!([]), "faces_vertices"),
    ];
    let good = folding(90.0).to_string();
    let mut files: Vec<(String, &str)> = vec![
        (good[..good.len() / 2].to_owned(), "EOF"),
        (String::new(), "EOF"),
        ("[]".to_owned(), "a FOLD file"),
    ];
    for (change, named) in changes {
        let mut value = folding(90.0);
        change(&mut value);
        files.push((value.to_string(), named));
    }
    for (content, named) in files {
        fs::write(home.path().join("bad.fold"), content).unwrap();
        let output = foldmotion(home.path(), &["check", "bad.fold", "--quiet"]);
        let error = text(&output.stderr);
        assert_status(&output, 2);
        assert!(error.contains(named) && error.contains("bad.fold"), "{error}");
        assert!(!home.path().join("out").exists());
    }
    fs::write(home.path().join("bad.fold"), &good).unwrap();
    for arguments in [
        &["check", "missing.fold"][..],
        &["check", "."],
        &["check", "bad.fold", "--tolerance", "0"],
        &["check", "bad.fold", "--tolerance", "x"],
        &["check"],
    ] {
        let output = foldmotion(home.path(), arguments);
        assert_status(&output, 2);
    }
    assert!(!home.path().join("out").exists());
}

#[test]
fn verification_has_an_exit_status_and_leaves_the_certificate_unchanged() {
    let home = tempfile::tempdir().unwrap();
    fs::write(home.path().join("book.fold"), folding(240.0).to_string()).unwrap();
    foldmotion(home.path(), &["check", "book.fold", "--out", ".", "--quiet"]);
    let path = home.path().join("certificate.json");
    let written = fs::read(&path).unwrap();
    let verify = ["check", "book.fold", "--verify", "certificate.json"];
    let output = foldmotion(home.path(), &verify);
    let (out, err) = (text(&output.stdout), text(&output.stderr));
    assert_status(&output, 1);
    assert!(out.contains("\nVERIFIED\n"), "{out}");
    assert!(err.contains("verify "), "{err}");
    assert_eq!(fs::read(&path).unwrap(), written);
    let mut lie: Value = serde_json::from_slice(&written).unwrap();
    lie["verdict"] = json!("free");
    fs::write(&path, lie.to_string()).unwrap();
    let output = foldmotion(home.path(), &verify);
    let out = text(&output.stdout);
    assert_status(&output, 2);
    assert!(out.contains("REFUTED") && out.contains("verdict"), "{out}");
    for bad in ["{}", "", "[1, 2"] {
        fs::write(&path, bad).unwrap();
        let output = foldmotion(home.path(), &verify);
        let error = text(&output.stderr);
        assert_status(&output, 2);
        assert!(error.contains("certificate.json: "), "{error}");
    }
}

#[test]
fn a_certificate_of_another_format_is_refused_with_the_reason_and_the_remedy() {
    let home = tempfile::tempdir().unwrap();
    fs::write(home.path().join("book.fold"), folding(90.0).to_string()).unwrap();
    foldmotion(home.path(), &["check", "book.fold", "--out", ".", "--quiet"]);
    let path = home.path().join("certificate.json");
    let written = json_of(&path);
    assert_eq!(written["format"], json!(2));
    let verify = ["check", "book.fold", "--verify", "certificate.json"];
    // A certificate as version 0.1.0 wrote it, without a format and with counts of work.
    let mut first = written.clone();
    first.as_object_mut().unwrap().remove("format");
    first["touching_pairs"] = json!(0);
    let (mut named, mut later) = (written.clone(), written);
    named["format"] = json!(1);
    later["format"] = json!(3);
    let reason = &["format 1", "up to 0.1", "an edge inside it"][..];
    for (certificate, reason) in
        [(first, reason), (named, reason), (later, &["format 3", "format 2"])]
    {
        fs::write(&path, certificate.to_string()).unwrap();
        let output = foldmotion(home.path(), &verify);
        let error = text(&output.stderr);
        assert_status(&output, 2);
        let said = reason.iter().chain(&["certificate.json: ", "run `foldmotion check`"]);
        for words in said {
            assert!(error.contains(words), "{words}: {error}");
        }
    }
}

#[test]
fn a_check_that_stops_early_says_so_and_is_verified_up_to_there() {
    let home = tempfile::tempdir().unwrap();
    let set = ["sheet.rows=2", "profile.length=2.0", "check.stop_at=1"];
    let report = run(home.path(), "shelter-short-plain", &set);
    let of_run = fs::read(home.path().join("run/certificate.json")).unwrap();
    let arguments = ["check", "run/motion.fold", "--out", ".", "--stop-at", "1"];
    let output = foldmotion(home.path(), &arguments);
    let out = text(&output.stdout);
    assert_status(&output, 1);
    assert!(out.contains("the check stopped at frame "), "{out}");
    let path = home.path().join("certificate.json");
    assert_eq!(text(&fs::read(&path).unwrap()), text(&of_run));
    let mut certificate = json_of(&path);
    assert_eq!(certificate["stopped"], report["collision"]["stopped"]);
    let frame = certificate["stopped"]["frame"].as_u64().unwrap();
    assert!(frame < certificate["frames"].as_u64().unwrap() - 1);
    let verify = ["check", "run/motion.fold", "--verify", "certificate.json"];
    let output = foldmotion(home.path(), &verify);
    assert_status(&output, 1);
    certificate["stopped"]["stop_at"] = json!(1000);
    fs::write(&path, certificate.to_string()).unwrap();
    let output = foldmotion(home.path(), &verify);
    let out = text(&output.stdout);
    assert_eq!(output.status.code(), Some(2), "{out}");
    assert!(out.contains("- stopped: "), "{out}");
}

/// A unit folded flat without contact, and its motion.
fn flat_unit(home: &Path) -> Value {
    run(home, "one-unit", &["motion.contact=false"]);
    json_of(&home.join("run/motion.fold"))
}

/// Checks a motion: the exit status and the certificate.
fn check(home: &Path, motion: &Value) -> (Option<i32>, Value) {
    fs::write(home.join("changed.fold"), motion.to_string()).unwrap();
    let output = foldmotion(home, &["check", "changed.fold", "--json", "--quiet"]);
    let certificate = serde_json::from_slice(&output.stdout).unwrap();
    (output.status.code(), certificate)
}

#[test]
fn the_certificate_of_a_run_is_byte_for_byte_that_of_its_motion_file() {
    let short = ["sheet.rows=2", "profile.length=2.0"];
    for (scene, set) in [
        ("one-unit", &["motion.contact=false"][..]),
        ("one-unit", &[]),
        ("shelter-short-plain", &short[..]),
    ] {
        let home = tempfile::tempdir().unwrap();
        run(home.path(), scene, set);
        let own = fs::read(home.path().join("run/certificate.json")).unwrap();
        let output = foldmotion(home.path(), &["check", "run/motion.fold", "--quiet", "--json"]);
        assert_eq!(text(&own), text(&output.stdout), "{scene} {set:?}");
    }
}

#[test]
fn swapped_layers_in_face_orders_are_named() {
    let home = tempfile::tempdir().unwrap();
    let motion = flat_unit(home.path());
    let (status, certificate) = check(home.path(), &motion);
    assert_eq!((status, &certificate["verdict"]), (Some(0), &json!("touching")));
    let clusters = certificate["clusters"].as_array().unwrap();
    assert!(clusters.iter().any(|c| c["order"] == "proved"), "{clusters:?}");
    let last = motion["file_frames"].as_array().unwrap().len() - 1;
    let orders = motion["file_frames"][last]["faceOrders"].clone();
    let orders: Vec<(u32, u32, i8)> = serde_json::from_value(orders).unwrap();
    let (f, g, _) = orders[0];
    let swapped: Vec<_> = orders
        .iter()
        .map(|&(a, b, s)| (a, b, if (a.min(b), a.max(b)) == (f.min(g), f.max(g)) { -s } else { s }))
        .collect();
    let mut changed = motion.clone();
    changed["file_frames"][last]["faceOrders"] = json!(swapped);
    let (status, certificate) = check(home.path(), &changed);
    assert_eq!(status, Some(1));
    let first = &certificate["penetrations"][0];
    assert_eq!(first["kind"], "layers out of order");
    assert_eq!(first["pair"]["triangles"], json!([f.min(g), f.max(g)]));
    assert_eq!(first["frames"], json!([last, last]));
}

#[test]
fn a_motion_whose_last_frames_have_their_layers_exchanged_is_refused() {
    let home = tempfile::tempdir().unwrap();
    let mut motion = flat_unit(home.path());
    let frames = motion["file_frames"].as_array_mut().unwrap();
    let from = frames.len() - 2;
    // The frames are mirrored in the middle plane of the stack, which exchanges its layers.
    for frame in &mut frames[from..] {
        let mut points: Vec<[f64; 3]> =
            serde_json::from_value(frame["vertices_coords"].clone()).unwrap();
        let middle = points.iter().map(|p| p[1]).sum::<f64>() / points.len() as f64;
        for point in &mut points {
            point[1] = 2.0 * middle - point[1];
        }
        frame["vertices_coords"] = json!(points);
    }
    let (status, certificate) = check(home.path(), &motion);
    assert_eq!((status, &certificate["verdict"]), (Some(1), &json!("penetrating")));
}

#[test]
fn false_face_orders_of_a_motion_with_contact_are_refused() {
    let home = tempfile::tempdir().unwrap();
    run(home.path(), "one-unit", &[]);
    let check = ["check", "run/motion.fold", "--out", "run", "--quiet"];
    assert_eq!(foldmotion(home.path(), &check).status.code(), Some(0));
    let certificate = json_of(&home.path().join("run/certificate.json"));
    let count = |key: &str| certificate["layer_orders"][key].as_u64().unwrap();
    assert!(count("claimed") > 0 && count("ignored") == 0, "{certificate}");
    let verify = ["check", "run/motion.fold", "--verify", "run/certificate.json"];
    let output = foldmotion(home.path(), &verify);
    assert_status(&output, 0);
    let path = home.path().join("run/motion.fold");
    let mut motion = json_of(&path);
    for frame in motion["file_frames"].as_array_mut().unwrap() {
        let orders = frame.get_mut("faceOrders").and_then(Value::as_array_mut);
        for entry in orders.into_iter().flatten() {
            entry[2] = json!(-entry[2].as_i64().unwrap());
        }
    }
    fs::write(&path, motion.to_string()).unwrap();
    let output = foldmotion(home.path(), &check);
    let err = text(&output.stderr);
    assert_status(&output, 2);
    assert!(err.contains("faceOrders has [") && err.contains("turn the sign"), "{err}");
}
