//! What a study says of an imported pattern: near misses, creases left out, vertices that cannot fold flat, thin parts; and
//! its own motion as a pattern.

#![expect(clippy::unwrap_used, reason = "a test stops where something is missing")]

use std::fmt::Write as _;
use std::path::Path;

use foldmotion_study::{Report, SceneSource, Study, StudyError};
use serde_json::{Value, json};

/// Resolves a scene with more lines beside a file of that name and text.
fn resolve(name: &str, text: &str, more: &str) -> Result<Study, StudyError> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(name), text).unwrap();
    let scene = format!("[pattern]\nfile = \"{name}\"\n{more}");
    Study::resolve(&SceneSource::new(&folder.path().join("scene.toml"), scene))
}

fn run(study: &Study, folder: &Path) -> Report {
    study.run(folder, &|_, _| true).unwrap()
}

/// A square of 100 with lines: two ends and a colour.
fn square(lines: &[([f64; 4], &str)]) -> String {
    let mut text = "<svg><rect width=\"100\" height=\"100\" stroke=\"#000\"/>".to_owned();
    for ([x1, y1, x2, y2], colour) in lines {
        let _ = write!(text, "<path d=\"M{x1} {y1}L{x2} {y2}\" stroke=\"{colour}\"/>");
    }
    text + "</svg>"
}

#[test]
fn what_was_mended_and_dropped_is_said_and_reported() {
    let clean = square(&[([0.0, 30.0, 100.0, 30.0], "#f00")]);
    assert!(resolve("a.svg", &clean, "").unwrap().notes.is_empty());
    // One crease misses the border by 0.3, another ends in the middle of nowhere.
    let text = square(&[
        ([0.0, 30.0, 99.7, 30.0], "#f00"),
        ([0.0, 60.0, 100.0, 60.0], "#00f"),
        ([0.0, 80.0, 40.0, 80.0], "#00f"),
    ]);
    let study = resolve("a.svg", &text, "[motion]\nframes = 4\ncontact = false\n").unwrap();
    let note = study.notes.join("\n");
    for words in
        ["1 vertices lie on lines", "1 creases or parts", "40.0000 of", "(20.0000, -80.0000)"]
    {
        assert!(note.contains(words), "{note}: {words}");
    }
    assert!(note.contains("pattern.vertex_tolerance"), "{note}");
    let folder = tempfile::tempdir().unwrap();
    let report: Value = serde_json::from_str(&run(&study, folder.path()).to_json()).unwrap();
    let mending = &report["import"]["mending"];
    assert_eq!(mending["chosen_from_drawing"], json!(true));
    assert_eq!(
        (&mending["dropped_creases"], &mending["dropped_length"]),
        (&json!(1), &json!(40.0))
    );
    assert_eq!(mending["dropped"][0]["middle"], json!([20.0, -80.0]));
    for key in ["largest_error_deg", "mean_error_deg"] {
        assert!(report["fold_angles"][key].is_number());
    }
}

#[test]
fn a_pattern_that_loses_most_creases_or_has_none_is_refused_with_the_key_that_helps() {
    let missed = square(&[([0.0, 30.0, 95.0, 30.0], "#f00")]);
    let error = resolve("a.svg", &missed, "").unwrap_err();
    assert_eq!(error.status(), 2);
    assert!(error.to_string().contains("pattern.vertex_tolerance"), "{error}");
    assert!(resolve("a.svg", &missed, "vertex_tolerance = 6.0\n").is_ok());
    let bare = square(&[]);
    let error = resolve("a.svg", &bare, "").unwrap_err();
    assert_eq!(error.status(), 2);
    assert!(error.to_string().contains("no crease"), "{error}");
}

/// Four valleys from the corners of a square to a point.
fn corners_to(x: f64, y: f64, letters: [&str; 4]) -> String {
    let angles = json!({
        "vertices_coords": [[0, 0], [4, 0], [4, 4], [0, 4], [x, y]],
        "edges_vertices": [[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [1, 4], [2, 4], [3, 4]],
        "edges_assignment": ["B", "B", "B", "B", letters[0], letters[1], letters[2], letters[3]],
    });
    angles.to_string()
}

#[test]
fn vertices_that_cannot_fold_flat_are_named() {
    let named = |text: &str, more: &str| {
        let study = resolve("a.fold", text, more).unwrap();
        let found = study.notes.iter().find(|note| note.contains("locally flat-foldable"));
        found.cloned()
    };
    assert_eq!(named(&corners_to(2.0, 2.0, ["V", "V", "V", "M"]), ""), None);
    let maekawa = named(&corners_to(2.0, 2.0, ["V"; 4]), "").unwrap();
    assert!(maekawa.contains("vertex 4 at (2.0000, 2.0000)"), "{maekawa}");
    assert!(maekawa.contains("mountains - valleys = -4"), "{maekawa}");
    let kawasaki = named(&corners_to(1.0, 2.0, ["V", "V", "V", "M"]), "").unwrap();
    assert!(kawasaki.contains("alternate angles sum to 1"), "{kawasaki}");
    // Drawn with few digits, or with a free hinge that may fold or not.
    assert_eq!(named(&corners_to(2.001, 2.0, ["V", "V", "V", "M"]), ""), None);
    assert_eq!(named(&corners_to(2.0, 2.0, ["V", "V", "V", "U"]), ""), None);
    // Nothing is to fold flat.
    assert_eq!(named(&corners_to(2.0, 2.0, ["V"; 4]), "fold_percent = 50.0\n"), None);
}

#[test]
fn the_gap_and_the_tolerance_follow_the_thinnest_part_of_a_pattern() {
    let strip = |width: f64| {
        let file = json!({
            "vertices_coords": [[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0], [0.5, 1], [0.5 + width, 0.5]],
            "edges_vertices": [[0, 4], [4, 1], [1, 2], [2, 5], [5, 3], [3, 0], [4, 5], [4, 6], [6, 5]],
            "edges_assignment": ["B", "B", "B", "B", "B", "B", "V", "F", "F"],
        });
        resolve("a.fold", &file.to_string(), "vertex_tolerance = 1e-9\n").unwrap()
    };
    let wide = strip(0.2);
    assert!(wide.notes.iter().all(|note| !note.contains("motion.gap")));
    assert_eq!(wide.contact.unwrap().gap, 1e-3);
    for width in [1e-3, 1e-5, 2e-6] {
        let thin = strip(width);
        let contact = thin.contact.unwrap();
        let mean_edge = thin.subject.sheet().unit_length;
        assert!((contact.gap / (width / mean_edge / 8.0) - 1.0).abs() < 1e-6);
        assert!(contact.final_gap <= contact.gap);
        assert!(thin.collision.touch_tolerance < contact.final_gap);
        assert!(thin.notes.iter().any(|note| note.contains("motion.gap is")), "{:?}", thin.notes);
        let says_tolerance =
            thin.notes.iter().any(|note| note.contains("check.touch_tolerance is"));
        assert_eq!(says_tolerance, width < 1e-4, "{:?}", thin.notes);
    }
}

#[test]
fn a_part_too_thin_for_the_model_is_refused_with_the_key_that_merges_it() {
    let file = json!({
        "vertices_coords": [[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0], [0.5, 1], [0.500_000_1, 0]],
        "edges_vertices": [[0, 4], [4, 6], [6, 1], [1, 2], [2, 5], [5, 3], [3, 0], [4, 5]],
        "edges_assignment": ["B", "B", "B", "B", "B", "B", "B", "V"],
    });
    let error = resolve("a.fold", &file.to_string(), "vertex_tolerance = 1e-9\n").unwrap_err();
    assert_eq!(error.status(), 2);
    assert!(error.to_string().contains("pattern.vertex_tolerance"), "{error}");
    assert!(resolve("a.fold", &file.to_string(), "").is_ok());
}

/// A strip of three panels with two creases that fold one after the other.
fn staged() -> String {
    json!({
        "vertices_coords": [[0, 0], [3, 0], [3, 2], [0, 2], [1, 0], [1, 2], [2, 0], [2, 2]],
        "edges_vertices": [[0, 4], [4, 6], [6, 1], [1, 2], [2, 7], [7, 5], [5, 3], [3, 0], [4, 5], [6, 7]],
        "edges_assignment": ["B", "B", "B", "B", "B", "B", "B", "B", "V", "M"],
        "file_frames": [
            {"frame_parent": 0, "frame_inherit": true,
             "edges_foldAngle": [null, null, null, null, null, null, null, null, 60, 0]},
            {"frame_parent": 0, "frame_inherit": true,
             "edges_foldAngle": [null, null, null, null, null, null, null, null, 60, -80]},
        ],
    })
    .to_string()
}

#[test]
fn a_motion_run_again_is_the_same_pattern_with_the_same_stages() {
    let once = json!({
        "vertices_coords": [[0, 0], [3, 0], [3, 2], [0, 2], [1, 0], [1, 2]],
        "edges_vertices": [[0, 4], [4, 1], [1, 2], [2, 5], [5, 3], [3, 0], [4, 5]],
        "edges_assignment": ["B", "B", "B", "B", "B", "B", "V"],
        "edges_foldAngle": [0, 0, 0, 0, 0, 0, 70],
    });
    for (text, stages) in [(once.to_string(), 1), (staged(), 2)] {
        let motion = "[motion]\nframes = 24\ncontact = false\n[record]\noutputs = [\"fold\"]\n";
        let study = resolve("a.fold", &text, motion).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let report = run(&study, folder.path());
        assert_eq!(report.import.unwrap().stages, stages);
        let written = folder.path().join("motion.fold");
        let again = Study::resolve(&SceneSource::read(&written).unwrap()).unwrap();
        let [first, second] = [&study, &again].map(|study| study.subject.imported().unwrap());
        assert_eq!(second.waypoints.len(), stages);
        let letters = |study: &foldmotion_study::ImportedStudy| {
            let edges = study.imported.sheet.edges.iter();
            edges.map(|edge| edge.assignment).collect::<Vec<_>>()
        };
        assert_eq!(letters(first), letters(second));
        assert_eq!(first.imported.sheet.vertices, second.imported.sheet.vertices);
        for (a, b) in first.waypoints.iter().flatten().zip(second.waypoints.iter().flatten()) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
    }
}
