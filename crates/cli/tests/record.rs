//! `foldmotion record` as a user sees it.

#![expect(clippy::unwrap_used, reason = "a test fails where something is missing")]

mod common;

use common::{assert_status, foldmotion, text};

/// A triangle pair that folds, as FOLD.
const MOTION: &str = r#"{"frame_classes": ["creasePattern"], "vertices_coords": [[0, 0], [1, 0], [1, 1], [0, 1]],
"edges_vertices": [[0, 2]], "edges_assignment": ["V"], "faces_vertices": [[0, 1, 2], [0, 2, 3]],
"file_frames": [{"frame_parent": 0, "frame_inherit": true},
{"frame_parent": 0, "frame_inherit": true, "vertices_coords": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0.5, 0.5, 0.7]]}]}"#;

#[test]
fn a_motion_is_recorded_and_a_file_is_reproduced() {
    let home = tempfile::tempdir().unwrap();
    std::fs::write(home.path().join("pair.fold"), MOTION).unwrap();
    let flags = [
        "record",
        "pair.fold",
        "--outputs",
        "gif,svg,stl",
        "--size",
        "64x48",
        "--fps",
        "5",
        "--at",
        "1,2",
        "--camera",
        "-60,30",
        "--hold",
        "0.2",
        "--loop",
        "back-and-forth",
        "--box",
        "false",
    ];
    let output = foldmotion(home.path(), &flags);
    assert_status(&output, 0);
    let said = text(&output.stdout);
    assert!(said.contains("4 files in out/pair") && said.contains("not marked"), "{said}");
    assert!(text(&output.stderr).contains("record "));
    let again = foldmotion(home.path(), &["record", "--again", "out/pair/motion.gif", "--quiet"]);
    assert_eq!(again.status.code(), Some(0), "{}", text(&again.stderr));
    assert_eq!((text(&again.stdout), text(&again.stderr)), (String::new(), String::new()));
    let bytes = ["motion.gif", "motion-again.gif"]
        .map(|name| std::fs::read(home.path().join("out/pair").join(name)).unwrap());
    assert!(bytes[0] == bytes[1]);
}

#[test]
fn wrong_flags_are_named_with_status_2_and_write_no_files() {
    let home = tempfile::tempdir().unwrap();
    std::fs::write(home.path().join("pair.fold"), MOTION).unwrap();
    for (arguments, word) in [
        (vec!["pair.fold", "--outputs", "film"], "film"),
        (vec!["pair.fold", "--outputs", "fold"], "--outputs"),
        (vec!["pair.fold", "--size", "64"], "--size"),
        (vec!["pair.fold", "--size", "0x48"], "--size"),
        (vec!["pair.fold", "--fps", "0"], "--fps"),
        (vec!["pair.fold", "--camera", "below"], "turntable"),
        (vec!["pair.fold", "--at", "0,1", "--outputs", "svg"], "--at"),
        (vec!["pair.fold", "--thickened", "-1"], "--thickened"),
        (vec!["missing.fold"], "missing.fold"),
        (vec!["--again", "pair.fold"], "pair.fold"),
        (vec!["--again", "a.gif", "--fps", "3"], "--fps"),
        (vec![], "MOTION"),
    ] {
        let arguments: Vec<&str> = std::iter::once("record").chain(arguments).collect();
        let output = foldmotion(home.path(), &arguments);
        let said = text(&output.stderr);
        assert_status(&output, 2);
        assert!(said.contains(word), "{arguments:?}: {said}");
        assert!(!home.path().join("out").exists(), "{arguments:?}");
    }
}
