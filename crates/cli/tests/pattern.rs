//! `foldmotion pattern` as a user sees it.

#![expect(clippy::unwrap_used, reason = "a test fails where something is missing")]

mod common;

use std::path::Path;
use std::process::Output;

use common::{assert_status, foldmotion, text};

fn pattern(folder: &Path, arguments: &[&str]) -> Output {
    foldmotion(folder, &[&["pattern"], arguments].concat())
}

fn scene(name: &str) -> String {
    format!("{}/../../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .filter(|name| !name.starts_with('.'))
        .collect();
    names.sort_unstable();
    names
}

#[test]
fn the_pattern_of_every_case_is_written_in_the_size_of_its_scene() {
    let home = tempfile::tempdir().unwrap();
    for name in ["shelter-e", "shelter-t", "shelter-s", "shelter-sii", "shelter-tall-plain"] {
        let output = pattern(home.path(), &[&scene(name), "--margin", "0"]);
        assert_status(&output, 0);
        let folder = home.path().join("out").join(name);
        assert_eq!(names(&folder), ["pattern.dxf", "pattern.fold", "pattern.svg"]);
        let svg = std::fs::read_to_string(folder.join("pattern.svg")).unwrap();
        assert!(svg.contains("1 m of the scene is 1000 mm on paper"), "{name}");
        // h = 1 m, seven rows, W = 5 m; rows differ by what the division leaves.
        assert!(svg.contains("width=\"7000mm\" height=\"5000mm\""), "{name}: {}", &svg[..400]);
        let fold = std::fs::read(folder.join("pattern.fold")).unwrap();
        let fold: serde_json::Value = serde_json::from_slice(&fold).unwrap();
        assert_eq!((&fold["frame_unit"], &fold["file_spec"]), (&"mm".into(), &1.2.into()));
    }
}

#[test]
fn every_unit_of_length_becomes_millimetres() {
    let home = tempfile::tempdir().unwrap();
    let units = [
        ("cm", "70mm", "10 mm"),
        ("mm", "7mm", "1 mm"),
        ("in", "177.8mm", "25.4 mm"),
        ("pt", "2.469444444mm", "0.352777778 mm"),
        ("unit", "7mm", "no physical length, is 1 mm"),
    ];
    for (unit, width, note) in units {
        let set = format!("profile.unit={unit}");
        let arguments =
            [&scene("shelter-e"), "--set", &set, "--margin=0", "--out=here", "--formats=svg"];
        let output = pattern(home.path(), &arguments);
        assert_status(&output, 0);
        let svg = std::fs::read_to_string(home.path().join("here/pattern.svg")).unwrap();
        assert!(svg.contains(&format!("width=\"{width}\"")), "{unit}: {}", &svg[..400]);
        assert!(svg.contains(note) && text(&output.stdout).contains(note), "{unit}");
    }
}

#[test]
fn pages_are_written_on_request_and_removed_by_the_next_pattern_without_pages() {
    let home = tempfile::tempdir().unwrap();
    let shelter = scene("shelter-sii");
    let folder = home.path().join("here");
    let common = [shelter.as_str(), "--out", "here", "--width", "300mm"];
    let with = |more: &[&str]| {
        let output = pattern(home.path(), &[&common, more].concat());
        assert_status(&output, 0);
        text(&output.stdout)
    };
    let summary = with(&["--sheet", "A4", "--formats", "svg,dxf"]);
    // 420 mm x 300 mm on windows of 190 mm x 277 mm that overlap by 10 mm.
    assert!(
        summary.contains("420.000 mm x 300.000 mm") && summary.contains("2 x 3 (rows x columns)")
    );
    let pages = |ending: &str| {
        let page = |n: &String| n.starts_with("pattern-") && n.ends_with(ending);
        names(&folder).iter().filter(|n| page(n)).count()
    };
    assert_eq!((pages(".svg"), pages(".dxf")), (6, 6));
    std::fs::write(folder.join("pattern-notes.svg"), "mine").unwrap();
    assert_eq!(with(&["--formats", "fold", "--quiet"]), "");
    assert_eq!(names(&folder), ["pattern-notes.svg", "pattern.fold"]);
}

#[test]
fn the_same_scene_gives_the_same_bytes() {
    let home = tempfile::tempdir().unwrap();
    let shelter = scene("shelter-s");
    for out in ["a", "b"] {
        let output =
            pattern(home.path(), &[&shelter, "--out", out, "--scale", "0.05", "--sheet", "a3"]);
        assert_status(&output, 0);
    }
    let (a, b) = (home.path().join("a"), home.path().join("b"));
    assert_eq!(names(&a), names(&b));
    for name in names(&a) {
        assert_eq!(std::fs::read(a.join(&name)).unwrap(), std::fs::read(b.join(&name)).unwrap());
    }
}

#[test]
fn bad_input_is_status_2_and_writes_no_files() {
    let home = tempfile::tempdir().unwrap();
    let shelter = scene("shelter-e");
    let cases: &[&[&str]] = &[
        &["--scale", "0"],
        &["--scale", "-1"],
        &["--scale", "nan"],
        &["--scale", "1e-9"],
        &["--scale", "1", "--width", "1m"],
        &["--width", "-3mm"],
        &["--width", "wide"],
        &["--formats", "svg,png"],
        &["--formats", ""],
        &["--sheet", "A9"],
        &["--sheet", "10x10mm"],
        &["--sheet", "A4", "--margin", "110"],
        &["--sheet", "A4", "--overlap", "100"],
        &["--sheet", "30x30mm"],
        &["--margin", "-1"],
        &["--dash", "cut=1,2"],
        &["--dash", "valley=1,2,3"],
        &["--line-width", "0"],
        &["--set", "sheet.columns=0"],
        &["--set", "sheet"],
    ];
    for &case in cases {
        let output = pattern(home.path(), &[&[shelter.as_str()], case].concat());
        let error = text(&output.stderr);
        assert_status(&output, 2);
        assert!(!error.contains("panicked") && !error.is_empty(), "{case:?}");
        assert!(names(home.path()).is_empty(), "{case:?}");
    }
    assert_eq!(pattern(home.path(), &["missing.toml"]).status.code(), Some(2));
}

#[test]
fn rows_that_clash_are_named_and_drawn() {
    let home = tempfile::tempdir().unwrap();
    let unequal = std::fs::read_to_string(scene("shelter-unequal")).unwrap();
    let own = unequal.replace("common-flap", "own-case").replace("lambda = 0.8\n", "");
    std::fs::write(home.path().join("own.toml"), own).unwrap();
    let output = pattern(home.path(), &["own.toml"]);
    assert_status(&output, 2);
    let error = text(&output.stderr);
    assert!(error.contains("clash") && error.contains("row 0"), "{error}");
    let folder = home.path().join("out/own");
    assert_eq!(names(&folder), ["clashes.svg"]);
    assert!(text(&output.stdout).contains("clashes.svg"));
    let figure = std::fs::read_to_string(folder.join("clashes.svg")).unwrap();
    assert!(figure.contains("</svg>"));
    // Other errors draw nothing.
    let output = pattern(home.path(), &[&scene("shelter-s"), "--set", "sheet.width=-1.0"]);
    assert_status(&output, 2);
    assert_eq!(names(&home.path().join("out")), ["own"]);
}

/// A strip of three pieces of height 1, folded at x = 2 and x = `second`.
fn letter(second: f64, letters: [&str; 2]) -> String {
    let edges = [[0, 1], [1, 2], [2, 3], [3, 7], [7, 6], [6, 5], [5, 4], [4, 0], [1, 5], [2, 6]];
    let mut assignments = vec!["B"; 8];
    assignments.extend(letters);
    let x = [0.0, 2.0, second, second + 2.0];
    let vertices: Vec<[f64; 2]> =
        [0.0, 1.0].iter().flat_map(|&y| x.iter().map(move |&x| [x, y])).collect();
    serde_json::json!({
        "file_spec": 1.2, "vertices_coords": vertices, "edges_vertices": edges,
        "edges_assignment": assignments, "faces_vertices": [[0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6]],
    })
    .to_string()
}

#[test]
fn a_crease_pattern_is_folded_flat_with_a_proved_order_or_the_facets_that_have_none() {
    let home = tempfile::tempdir().unwrap();
    std::fs::write(home.path().join("letter.fold"), letter(3.0, ["V", "M"])).unwrap();
    let output = pattern(home.path(), &["letter.fold"]);
    assert_status(&output, 0);
    let said = text(&output.stdout);
    let line = "folds flat: 3 facets, 3 overlapping pairs, an order of layers exists (proved)";
    assert!(said.contains(line) && said.contains("by check and verify"), "{said}");
    let folder = home.path().join("out/letter");
    let pattern_files = ["pattern.dxf", "pattern.fold", "pattern.svg"];
    assert_eq!(names(&folder), [&["folded.fold", "folded.svg"][..], &pattern_files].concat());
    let folded = std::fs::read(folder.join("folded.fold")).unwrap();
    let folded: serde_json::Value = serde_json::from_slice(&folded).unwrap();
    let frame = &folded["file_frames"][0];
    assert_eq!(frame["frame_classes"], serde_json::json!(["foldedForm"]));
    assert!(!frame["faceOrders"].as_array().unwrap().is_empty());
    let svg = std::fs::read_to_string(folder.join("folded.svg")).unwrap();
    assert!(svg.contains("from above") && svg.contains("from below"));
    // The file is itself a pattern with the same flat state, its facets cut into triangles.
    let again = pattern(home.path(), &["out/letter/folded.fold", "--out", "again"]);
    let said = text(&again.stdout);
    assert!(said.contains("an order of layers exists (proved)"), "{said}");

    std::fs::write(home.path().join("long.fold"), letter(3.0, ["V", "V"])).unwrap();
    let output = pattern(home.path(), &["long.fold"]);
    assert_status(&output, 0);
    let said = text(&output.stdout);
    assert!(
        said.contains("no order of layers exists: facets 0, 1, 2 cannot be put in order"),
        "{said}"
    );
    assert_eq!(names(&home.path().join("out/long")), pattern_files);
}

#[test]
fn the_files_of_the_flat_state_are_those_of_the_formats_asked_for_and_go_with_it() {
    let home = tempfile::tempdir().unwrap();
    std::fs::write(home.path().join("letter.fold"), letter(3.0, ["V", "M"])).unwrap();
    let written = |more: &[&str]| {
        let output = pattern(home.path(), &[&["letter.fold", "--out", "here"], more].concat());
        assert_status(&output, 0);
        names(&home.path().join("here"))
    };
    assert_eq!(written(&["--formats", "dxf"]), ["pattern.dxf"]);
    let formats = ["--formats", "fold"];
    assert_eq!(written(&formats), ["folded.fold", "pattern.dxf", "pattern.fold"]);
    let half = [&formats[..], &["--set", "pattern.fold_percent=50"]].concat();
    assert_eq!(written(&half), ["pattern.fold"]);
}

#[test]
fn a_run_that_ends_short_of_a_flat_state_says_whether_it_exists() {
    let home = tempfile::tempdir().unwrap();
    std::fs::write(home.path().join("long.fold"), letter(3.0, ["V", "V"])).unwrap();
    let output = foldmotion(home.path(), &["run", "long.fold", "--json"]);
    assert_status(&output, 3);
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let layers = &report["layer_order"];
    assert_eq!((&layers["exists"], &layers["pairs"]), (&false.into(), &3.into()), "{layers}");
    assert_eq!(layers["contradicting"], serde_json::json!([0, 1, 2]));
    assert!(layers["proved_by"].as_array().unwrap().is_empty());
}

#[test]
fn the_pattern_of_a_file_of_any_format_is_written_and_read_again() {
    let home = tempfile::tempdir().unwrap();
    let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\"><rect width=\"80\" height=\"40\" stroke=\"#000\"/>\
               <path d=\"M20 0V40\" stroke=\"#f00\"/><path d=\"M40 0Q50 20 40 40\" fill=\"none\" stroke=\"#00f\"/>\
               <path d=\"M60 0V20\" stroke=\"#0f0\"/><path d=\"M60 20V40\" stroke=\"#f00\"/></svg>";
    let cp = "1 0 0 80 0\n1 80 0 80 40\n1 80 40 0 40\n1 0 40 0 0\n2 20 0 20 40\n3 40 0 40 40\n";
    for (name, content, mountains) in [
        ("fan.svg", svg, 2),
        ("fan.txt", svg, 2),
        ("two.cp", cp, 1),
        ("two.txt", cp, 1),
        ("two", cp, 1),
    ] {
        std::fs::write(home.path().join(name), content).unwrap();
        let output = pattern(home.path(), &[name, "--out", "written", "--force"]);
        assert_status(&output, 0);
        let summary = text(&output.stdout);
        assert!(
            summary.contains(&format!("pattern of {name}; 80.000 mm x 40.000 mm")),
            "{summary}"
        );
        assert!(summary.contains(&format!("mountain {mountains:>7} lines")), "{summary}");
        assert_eq!(summary.contains("curve"), content == svg, "{summary}");
        let written = names(&home.path().join("written"));
        for file in ["pattern.dxf", "pattern.fold", "pattern.svg"] {
            assert!(written.contains(&file.to_owned()), "{written:?}");
        }
        for format in ["svg", "dxf", "fold"] {
            let file = format!("written/pattern.{format}");
            let again = pattern(home.path(), &[&file, "--out", "again", "--force"]);
            assert_status(&again, 0);
            let summary = text(&again.stdout);
            assert!(
                summary.contains(&format!("mountain {mountains:>7} lines")),
                "{file}: {summary}"
            );
        }
    }
}

#[test]
fn a_file_of_no_known_format_is_refused_with_the_formats_that_are_read() {
    let home = tempfile::tempdir().unwrap();
    for (name, bytes) in [
        ("picture.png", &b"\x89PNG\r\n\x1a\n\0\0"[..]),
        ("notes.txt", b"fold it in half"),
        ("page.html", b"<html></html>"),
        ("drawing.dxf", b"AutoCAD Binary DXF\r\n\x1a\0"),
        ("model.obj", b"nothing"),
    ] {
        std::fs::write(home.path().join(name), bytes).unwrap();
        for command in ["pattern", "run"] {
            let output = foldmotion(home.path(), &[command, name]);
            assert_status(&output, 2);
            let error = text(&output.stderr);
            assert!(error.contains(name) && !error.contains("TOML parse"), "{error}");
        }
    }
    let output = foldmotion(home.path(), &["run", "notes.txt"]);
    let error = text(&output.stderr);
    for format in [".fold", "SVG", ".cp", ".opx", ".orh", "OBJ", "DXF"] {
        assert!(error.contains(format), "{error}");
    }
}
