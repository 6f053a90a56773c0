//! FOLD files as programs write them: stale faces, alternatives, recorded motions, folded shapes.

use std::f64::consts::PI;

use foldmotion_pattern::{
    FoldHeader, Frame, ImportError, ImportOptions, ImportedPattern, LayerOrder, Motion, Source,
    WarningKind, import_fold,
};
use glam::DVec3;
use serde_json::{Value, json};

use crate::draw::{miura, square_twist};
use crate::fold::two_triangles;
use crate::patterns::{check_sheet, counts};

fn import(file: &Value) -> ImportedPattern {
    let imported = import_fold(file.to_string().as_bytes(), &ImportOptions::default()).unwrap();
    check_sheet(&imported);
    imported
}

fn sources(imported: &ImportedPattern, kind: WarningKind) -> Vec<Source> {
    let found = imported.warnings.iter().find(|w| w.kind == kind);
    found.map_or_else(Vec::new, |w| w.sources.clone())
}

#[test]
fn faces_that_miss_a_crease_are_left_out_not_the_crease() {
    let file = json!({
        "vertices_coords": [[0, 0], [3, 0], [3, 2], [0, 2], [1, 0], [1, 2]],
        "edges_vertices": [[0, 4], [4, 1], [1, 2], [2, 5], [5, 3], [3, 0], [4, 5]],
        "edges_assignment": ["B", "B", "B", "B", "B", "B", "V"],
        "faces_vertices": [[0, 4, 1, 2, 5, 3]],
    });
    let imported = import(&file);
    assert_eq!((imported.sheet.facets.len(), counts(&imported)[&'V']), (2, 1));
    assert_eq!(sources(&imported, WarningKind::StaleFaces), [Source::FoldEdge(6)]);
    // Facet lines of no face do no harm.
    let mut aside = file.clone();
    aside["edges_assignment"][6] = json!("F");
    assert_eq!(import(&aside).sheet.facets.len(), 1);
}

#[test]
fn loose_vertices_change_nothing() {
    let mut file = square_twist().fold();
    let known = import(&file);
    file["vertices_coords"].as_array_mut().unwrap().push(json!([1e7, 3.0, 5.0]));
    let imported = import(&file);
    assert_eq!((&imported.sheet, &imported.targets), (&known.sheet, &known.targets));
    assert_eq!(sources(&imported, WarningKind::UnusedVertex).len(), 1);
}

#[test]
fn small_letters_and_single_names_are_read() {
    let mut file = miura(3, 3).fold();
    let known = import(&file);
    for letter in file["edges_assignment"].as_array_mut().unwrap() {
        *letter = json!(letter.as_str().unwrap().to_lowercase());
    }
    file["file_spec"] = json!("1.1");
    file["file_classes"] = json!("singleModel");
    file["frame_classes"] = json!("creasePattern");
    let imported = import(&file);
    assert_eq!((&imported.sheet, &imported.targets), (&known.sheet, &known.targets));
}

#[test]
fn alternatives_are_not_stages() {
    let mut file = two_triangles();
    let frame = |classes: Value| {
        json!({"frame_parent": 0, "frame_inherit": true, "frame_classes": classes,
            "edges_foldAngle": [null, null, null, null, 90]})
    };
    file["file_frames"] = json!([frame(json!(["foldedForm"]))]);
    assert_eq!(import(&file).stages.len(), 1);
    file["file_frames"] = json!([frame(json!(["creasePattern"]))]);
    file["frame_classes"] = json!(["creasePattern"]);
    let imported = import(&file);
    assert!(imported.stages.is_empty());
    assert_eq!(sources(&imported, WarningKind::Alternative), [Source::FoldFrame(0)]);
    for classes in [json!(["multiModel"]), json!("multiModel")] {
        file["file_frames"] = json!([frame(json!(["foldedForm"]))]);
        file["file_classes"] = classes;
        assert!(import(&file).stages.is_empty());
    }
    // Nor does an alternative drive what the pattern leaves free.
    file["edges_assignment"][4] = json!("U");
    assert_eq!(import(&file).free_hinges().count(), 1);
}

/// The motion of a pattern to the positions of `place`, written and read again.
fn recorded(imported: &ImportedPattern, place: impl Fn(f64, DVec3) -> DVec3) -> Value {
    let flat = imported.sheet.planar();
    let frame = |k: u32| {
        let time = 1.0 + f64::from(k) / 4.0;
        let positions = flat.iter().map(|&p| place(time - 1.0, p)).collect();
        Frame { time, positions }
    };
    let motion = Motion {
        sheet: imported.sheet.clone(),
        frames: (0..=4).map(frame).collect(),
        compact_order: LayerOrder::default(),
    };
    let mut text = Vec::new();
    let header = FoldHeader {
        creator: "test",
        title: "test",
        unit: "unit",
        target_angles: &imported.targets,
        layer_orders: &[],
        keys: &serde_json::Map::new(),
    };
    motion.write_fold(&header, &mut text).unwrap();
    serde_json::from_slice(&text).unwrap()
}

#[test]
fn a_recorded_motion_is_the_pattern_that_it_moved() {
    let known = import(&two_triangles());
    // Waves of 1e-14: the angles of facet lines are not exactly 0.
    let file = recorded(&known, |_, p| DVec3::new(p.x, p.y, 1e-14 * (p.x * 9.0).sin()));
    let imported = import(&file);
    assert_eq!(counts(&imported), counts(&known));
    assert_eq!(imported.targets, known.targets);
    assert!(imported.stages.is_empty());
    assert_eq!(sources(&imported, WarningKind::Recorded).len(), 5);
}

#[test]
fn angles_of_rounding_make_no_crease() {
    for (angle, letter) in [(1e-13, 'F'), (-1e-8, 'F'), (1e-3, 'V')] {
        let mut file = two_triangles();
        file["edges_assignment"][4] = json!("F");
        file["edges_foldAngle"] = json!([null, null, null, null, angle]);
        assert_eq!(counts(&import(&file))[&letter], 1);
        file["edges_foldAngle"] = json!([null, null, null, null, 0]);
        file["file_frames"] = json!([{"frame_parent": 0, "frame_inherit": true,
            "edges_foldAngle": [null, null, null, null, angle]}]);
        assert_eq!(counts(&import(&file))[&letter], 1);
    }
}

#[test]
fn a_pattern_far_from_the_origin_is_moved_there() {
    let known = import(&square_twist().fold());
    let far = 2f64.powi(26);
    let mut file = square_twist().fold();
    for point in file["vertices_coords"].as_array_mut().unwrap() {
        *point = json!([point[0].as_f64().unwrap() + far, point[1].as_f64().unwrap() - far]);
    }
    let imported = import(&file);
    assert_eq!(counts(&imported), counts(&known));
    assert!(imported.sheet.vertices.iter().all(|p| p.abs().max_element() < 1e3));
    for point in file["vertices_coords"].as_array_mut().unwrap() {
        *point = json!([point[0].as_f64().unwrap() + 1e15, point[1]]);
    }
    let error = import_fold(file.to_string().as_bytes(), &ImportOptions::default()).unwrap_err();
    assert!(matches!(error, ImportError::Extent { .. }), "{error}");
}

/// A strip of four unit squares, folded up by 60°, down by 90° and up by 180°, in any direction of space.
fn strip(letters: [&str; 3]) -> Value {
    let turns = [0.0, PI / 3.0, -PI / 6.0, 5.0 * PI / 6.0];
    let mut at = [0.0, 0.0];
    let mut vertices = vec![json!([0, 0, 0]), json!([0, 1, 0])];
    for turn in turns {
        at = [at[0] + f64::cos(turn), at[1] + f64::sin(turn)];
        vertices.extend([json!([at[0], 0, at[1]]), json!([at[0], 1, at[1]])]);
    }
    let [a, b, c] = letters;
    json!({
        "vertices_coords": vertices,
        "edges_vertices": [[0, 2], [2, 4], [4, 6], [6, 8], [8, 9], [9, 7], [7, 5], [5, 3], [3, 1], [1, 0],
            [2, 3], [4, 5], [6, 7]],
        "edges_assignment": ["B", "B", "B", "B", "B", "B", "B", "B", "B", "B", a, b, c],
        // The third face is listed the other way round.
        "faces_vertices": [[0, 2, 3, 1], [2, 4, 5, 3], [4, 5, 7, 6], [6, 8, 9, 7]],
    })
}

#[test]
fn a_folded_shape_is_laid_out_flat_and_folds_by_its_own_angles() {
    for letters in [["V", "M", "V"], ["U", "U", "V"], ["M", "V", "V"]] {
        let imported = import(&strip(letters));
        assert_eq!(sources(&imported, WarningKind::Unfolded), [Source::KeyFrame]);
        let mut extent = imported.sheet.vertices.iter();
        let first = *extent.next().unwrap();
        let farthest = extent.map(|p| p.distance(first)).fold(0.0, f64::max);
        assert!((farthest - 17f64.sqrt()).abs() < 1e-12, "{farthest}");
        let target = |edge: u32| {
            let found = (0..).zip(&imported.targets);
            let of_edge =
                |&(e, _): &(u32, &f64)| imported.edge_source(e) == Some(&Source::FoldEdge(edge));
            *found.filter(of_edge).map(|(_, target)| target).next().unwrap()
        };
        for (edge, degrees) in [(10, 60.0), (11, -90.0), (12, 180.0)] {
            assert!((target(edge).to_degrees() - degrees).abs() < 1e-9, "{edge}: {}", target(edge));
        }
    }
    // A file's own angles count.
    let mut file = strip(["V", "M", "V"]);
    let mut angles = vec![Value::Null; 13];
    angles[10] = json!(20);
    file["edges_foldAngle"] = json!(angles);
    assert!(import(&file).targets.iter().any(|t| (t.to_degrees() - 20.0).abs() < 1e-12));
}

#[test]
fn a_shape_that_is_not_developable_is_refused_by_vertex() {
    // A pyramid over a square, whose four faces around the top do not close in the plane.
    let file = json!({
        "vertices_coords": [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [1, 1, 1]],
        "edges_vertices": [[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [1, 4], [2, 4], [3, 4]],
        "edges_assignment": ["B", "B", "B", "B", "M", "M", "M", "M"],
        "faces_vertices": [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]],
    });
    let error = import_fold(file.to_string().as_bytes(), &ImportOptions::default()).unwrap_err();
    assert!(matches!(error, ImportError::NotDevelopable { .. }), "{error}");
    assert!(error.to_string().contains("vertex"), "{error}");
}
