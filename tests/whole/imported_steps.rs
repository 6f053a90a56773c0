//! Steps of an imported pattern that name creases by id, class and edge.

use std::f64::consts::PI;
use std::path::Path;

use foldmotion_pattern::Assignment;
use foldmotion_study::scene::Stage;
use foldmotion_study::{SceneSource, Study};

/// A strip with three creases across it: a, b and c, of which a and b are in one group.
const STRIP: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\">\n<rect width=\"8\" height=\"2\" stroke=\"#000\"/>\n\
                     <g id=\"left\" class=\"early\" stroke=\"#f00\"><path id=\"a\" d=\"M2 0V2\"/><path id=\"b\" d=\"M4 \
                     0V2\"/></g>\n<path id=\"c\" class=\"late last\" stroke=\"#00f\" d=\"M6 0V2\"/>\n</svg>\n";

fn resolved(folder: &Path, steps: &str) -> Study {
    std::fs::write(folder.join("strip.svg"), STRIP).unwrap();
    let path = folder.join("scene.toml");
    std::fs::write(&path, format!("[pattern]\nfile = \"strip.svg\"\n{steps}")).unwrap();
    Study::resolve(&SceneSource::read(&path).unwrap()).unwrap()
}

/// The parts of their ends that the creases a, b and c have reached in the middle of the stage.
fn halfway(study: &Study) -> [f64; 3] {
    let sheet = study.subject.sheet();
    let mut hinges: Vec<(f64, f64)> = Vec::new();
    for (hinge, edge) in sheet.edges.iter().filter(|edge| edge.is_hinge()).enumerate() {
        if matches!(edge.assignment, Assignment::Mountain | Assignment::Valley) {
            let x = sheet.vertices[edge.vertices[0] as usize].x;
            hinges.push((x, study.schedule.target(Stage::Fold, hinge, 0.5).abs() / PI));
        }
    }
    hinges.sort_by(|a, b| a.0.total_cmp(&b.0));
    hinges.iter().map(|hinge| hinge.1).collect::<Vec<_>>().try_into().unwrap()
}

#[test]
fn steps_name_creases_by_id_class_group_and_edge() {
    let folder = tempfile::tempdir().unwrap();
    let step = |names: &str| format!("[[motion.step]]\nstage = \"fold\"\nto = 0.5\n{names}\n");
    for (names, expected) in [
        ("ids = [\"a\"]", [1.0, 0.5, 0.5]),
        ("ids = [\"a\", \"c\"]", [1.0, 0.5, 1.0]),
        ("ids = [\"left\"]", [1.0, 1.0, 0.5]),
        ("classes = [\"early\"]", [1.0, 1.0, 0.5]),
        ("classes = [\"last\"]", [0.5, 0.5, 1.0]),
        ("classes = [\"last\"]\nids = [\"b\"]", [0.5, 1.0, 1.0]),
        ("ids = [\"left\", \"c\"]\ncreases = \"valleys\"", [0.5, 0.5, 1.0]),
    ] {
        let found = halfway(&resolved(folder.path(), &step(names)));
        let far = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(far < 1e-9, "{names}: {found:?}");
    }
    let plain = resolved(folder.path(), "");
    let sheet = plain.subject.sheet();
    let is_valley = |edge: &foldmotion_pattern::Edge| edge.assignment == Assignment::Valley;
    let edge = sheet.edges.iter().position(is_valley).unwrap();
    let by_edge = resolved(folder.path(), &step(&format!("edges = [{edge}]")));
    assert!((halfway(&by_edge)[2] - 1.0).abs() < 1e-9);
}
