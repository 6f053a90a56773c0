//! Errors in a crease pattern, or in the scene that names it, have a location and status 2.

use std::path::Path;

use foldmotion_study::{SceneSource, Study, StudyError};

const SQUARE: &str = "<svg>\n<rect width=\"2\" height=\"2\" stroke=\"#000\"/>\n<path id=\"fold\" d=\"M0 0L2 2\" stroke=\"#f00\"/>\n</svg>\n";

fn resolve(folder: &Path, scene: &str) -> Result<Study, StudyError> {
    let path = folder.join("scene.toml");
    std::fs::write(&path, scene).unwrap();
    Study::resolve(&SceneSource::read(&path).unwrap())
}

/// Checks that a scene next to the file `name` with the content `bytes` is refused with all `words`.
fn refused(name: &str, bytes: &[u8], scene: &str, words: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(name), bytes).unwrap();
    let error = resolve(folder.path(), scene).err().unwrap();
    let text = error.to_string();
    assert_eq!(error.status(), 2, "{text}");
    for word in words {
        assert!(text.contains(word), "{text}: {word}");
    }
}

fn of_square(more: &str, words: &[&str]) {
    let scene = format!("[pattern]\nfile = \"square.svg\"\n{more}");
    refused("square.svg", SQUARE.as_bytes(), &scene, words);
}

#[test]
fn values_of_the_scene_are_refused_with_their_line() {
    of_square("fold_percent = 101", &["scene.toml:3", "fold_percent", "-100 and 100"]);
    of_square("fold_percent = nan", &["scene.toml:3", "fold_percent"]);
    of_square("fixed = [2]", &["scene.toml:3", "facets 0 to 1"]);
    of_square("fixed = [-1]", &["scene.toml:3", "facets 0 to 1"]);
    of_square("fixed = [0, 1]", &["scene.toml:3", "only one"]);
    of_square("vertex_tolerance = 5.0", &["scene.toml:3", "vertex_tolerance"]);
    of_square("vertex_tolerance = -1.0", &["scene.toml:3", "vertex_tolerance"]);
    of_square("curve_tolerance = 7.0", &["scene.toml:3", "curve_tolerance"]);
    of_square("[sheet]\nrows = 3", &["scene.toml:3", "[sheet]", "[pattern]"]);
    of_square("[profile]\nmodel = \"omega\"", &["scene.toml:3", "[profile]"]);
    of_square("[division]\nmethod = \"parametric\"", &["scene.toml:3", "[division]"]);
    of_square("[motion]\nunfold = \"auto\"", &["scene.toml:4", "flat"]);
    of_square("[motion]\ngap = 0.5", &["scene.toml:4", "motion.gap", "pattern"]);
    for (line, word) in [
        ("stage = \"unfold\"", "starts flat"),
        ("stage = \"fold\"\nrows = [0]", "no rows"),
        ("stage = \"fold\"\ncolumns = [0]", "no rows"),
        ("stage = \"fold\"\ncreases = \"pads\"", "mountains"),
        ("stage = \"fold\"\ncreases = \"valleys\"", "motion.step.0"),
        ("stage = \"fold\"\nids = [\"fold\", \"f\"]", "known are fold"),
        ("stage = \"fold\"\nclasses = [\"f\"]", "none has such a name"),
        ("stage = \"fold\"\nedges = [99]", "no edge 99"),
    ] {
        of_square(&format!("[[motion.step]]\n{line}"), &["scene.toml:", word]);
    }
}

#[test]
fn files_are_refused_by_name_and_element() {
    let scene = |file: &str| format!("[pattern]\nfile = \"{file}\"\n");
    let refused = |name: &str, bytes: &[u8], words: &[&str]| {
        refused(name, bytes, &scene(name), words);
    };
    refused("a.txt", b"plain", &["a.txt", "FOLD", "SVG", ".cp", "DXF"]);
    refused("a", b"", &["FOLD", "SVG", ".cp", "DXF"]);
    refused("empty.svg", b"", &["empty.svg", "XML"]);
    refused("empty.fold", b"", &["empty.fold"]);
    refused("none.fold", b"{}", &["none.fold", "vertices_coords"]);
    refused("bytes.svg", b"<svg>\xff</svg>", &["bytes.svg", "UTF-8"]);
    let unknown = SQUARE.replace("#f00", "#xyz");
    refused(
        "u.svg",
        unknown.as_bytes(),
        &["u.svg", "<path id=\"fold\"> (line 3)", "pattern.unknown"],
    );
    refused("huge.svg", &vec![b' '; (16 << 20) + 1], &["huge.svg", "bytes"]);
    let folder = tempfile::tempdir().unwrap();
    let missing = resolve(folder.path(), &scene("gone.svg")).err().unwrap();
    assert_eq!(missing.status(), 2);
    assert!(missing.to_string().contains("gone.svg"), "{missing}");
    std::fs::create_dir(folder.path().join("dir.svg")).unwrap();
    let directory = resolve(folder.path(), &scene("dir.svg")).err().unwrap();
    assert_eq!(directory.status(), 2, "{directory}");
}

#[test]
fn unknown_elements_are_ignored_on_request() {
    let folder = tempfile::tempdir().unwrap();
    let text = SQUARE.replace("</svg>", "<circle r=\"1\" stroke=\"url(#a)\"/></svg>");
    std::fs::write(folder.path().join("c.svg"), text).unwrap();
    assert!(resolve(folder.path(), "[pattern]\nfile = \"c.svg\"\n").is_err());
    let study = resolve(folder.path(), "[pattern]\nfile = \"c.svg\"\nunknown = \"ignore\"\n");
    let study = study.unwrap();
    let imported = &study.subject.imported().unwrap().imported;
    assert_eq!(imported.sheet.facets.len(), 2);
    assert!(imported.warnings[0].to_string().contains("<circle>"));
}

#[test]
fn a_piece_that_is_not_there_is_refused_at_its_key() {
    let two = "<svg><rect id=\"a\" width=\"2\" height=\"2\" stroke=\"#000\"/><rect x=\"9\" width=\"2\" height=\"2\" \
               stroke=\"#000\"/><path d=\"M1 0V2M10 0V2\" stroke=\"#f00\"/></svg>";
    let scene = |piece: &str| format!("[pattern]\nfile = \"two.svg\"\npiece = \"{piece}\"\n");
    refused("two.svg", two.as_bytes(), &scene("b"), &["scene.toml:3", "pattern.piece", "0 to 1"]);
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("two.svg"), two).unwrap();
    for (piece, facets) in [("a", 2), ("1", 2), ("all", 4), ("largest", 2)] {
        let study = resolve(folder.path(), &scene(piece)).unwrap();
        assert_eq!(study.subject.sheet().facets.len(), facets, "{piece}");
    }
}
