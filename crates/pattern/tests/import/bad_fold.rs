//! FOLD that cannot be read: each fault with its error, by index.

use foldmotion_pattern::{FoldError, ImportError, ImportOptions, MOST_LINES, import_fold};
use serde_json::{Value, json};

use crate::fold::two_triangles;

fn error(file: &Value) -> ImportError {
    import_fold(file.to_string().as_bytes(), &ImportOptions::default()).unwrap_err()
}

fn changed(change: impl FnOnce(&mut Value)) -> ImportError {
    let mut file = two_triangles();
    change(&mut file);
    error(&file)
}

#[test]
fn text_that_is_not_fold_is_refused_with_its_location() {
    let options = ImportOptions::default();
    for text in [
        &b""[..],
        b"[]",
        b"{",
        b"{\"vertices_coords\": [[0, 0], [1, 1e999]]}",
        b"{\"vertices_coords\": [[0, 0], [NaN, 1]]}",
        b"{\"vertices_coords\": [[0]]}",
        b"{\"edges_vertices\": [[0, -1]]}",
        b"{\"edges_vertices\": [[0, 1, 2]]}",
        b"{\"edges_foldAngle\": [\"a\"]}",
        b"{\"lab:note\": \"\xff\"}",
        b"{\"lab:note\": 1, \"lab:note\": 2}",
        b"{\"frame_unit\": 3}",
        b"{} {}",
    ] {
        let refused = import_fold(text, &options).unwrap_err();
        assert!(matches!(refused, ImportError::Fold(FoldError::Json { .. })), "{refused}");
    }
    let deep = format!("{{\"lab:note\": {}{}}}", "[".repeat(100_000), "]".repeat(100_000));
    let refused = import_fold(deep.as_bytes(), &options).unwrap_err();
    assert!(matches!(refused, ImportError::Fold(FoldError::Json { .. })), "{refused}");
}

#[test]
fn lists_that_do_not_fit_each_other_are_refused_by_name() {
    let missing = changed(|f| drop(f.as_object_mut().unwrap().remove("vertices_coords")));
    assert!(missing.to_string().contains("vertices_coords"), "{missing}");
    for (key, value) in [("edges_assignment", json!(["B"])), ("edges_foldAngle", json!([1, 2]))] {
        let refused = changed(|f| f[key] = value);
        assert!(matches!(refused, ImportError::Count { .. }), "{refused}");
        assert!(refused.to_string().contains(key));
    }
    let refused = changed(|f| f["edges_vertices"][2] = json!([2, 9]));
    assert!(refused.to_string().contains("edges_vertices[2] names vertex 9"), "{refused}");
    let refused = changed(|f| f["faces_vertices"][1][0] = json!(4));
    assert!(refused.to_string().contains("faces_vertices[1] names vertex 4"), "{refused}");
    let refused = changed(|f| f["edges_assignment"][3] = json!("Q"));
    assert!(refused.to_string().contains("edges_assignment[3] is \"Q\""), "{refused}");
    let refused = changed(|f| f["edges_foldAngle"] = json!([null, null, null, null, -181]));
    assert!(refused.to_string().contains("edges_foldAngle[4] is -181"), "{refused}");
    let refused = changed(|f| f["frame_unit"] = json!("furlong"));
    assert!(matches!(refused, ImportError::Unit { .. }), "{refused}");
    let refused = changed(|f| f["foldmotion:unitLength"] = json!(0));
    assert!(matches!(refused, ImportError::Fold(FoldError::UnitLength { .. })), "{refused}");
}

#[test]
fn frames_that_inherit_from_nowhere_or_do_not_fit_are_refused() {
    for parent in [json!(1), json!(7)] {
        let refused = changed(|f| {
            f["file_frames"] = json!([{"frame_parent": parent, "frame_inherit": true}]);
        });
        assert!(matches!(refused, ImportError::Fold(FoldError::Parent { .. })), "{refused}");
    }
    let refused = changed(|f| {
        f["file_frames"] =
            json!([{"frame_parent": 0, "frame_inherit": true, "edges_foldAngle": [1]}]);
    });
    assert!(refused.to_string().contains("file_frames[0].edges_foldAngle has 1"), "{refused}");
    let refused = changed(|f| {
        f["file_frames"] = json!([{"frame_parent": 0, "frame_inherit": true,
            "edges_foldAngle": [0, 0, 0, 0, 1e9]}]);
    });
    assert!(refused.to_string().contains("file_frames[0].edges_foldAngle[4]"), "{refused}");
}

#[test]
fn faces_that_are_no_facets_are_refused() {
    // Without edges, from which the facets would follow otherwise.
    let changed = |change: &dyn Fn(&mut Value)| {
        let mut file = two_triangles();
        for key in ["edges_vertices", "edges_assignment"] {
            file.as_object_mut().unwrap().remove(key);
        }
        change(&mut file);
        error(&file)
    };
    let refused = changed(&|f| f["faces_vertices"][1] = json!([0, 2]));
    assert!(refused.to_string().contains("faces_vertices[1] has 2 corners"), "{refused}");
    for polygon in [json!([0, 2, 2]), json!([0, 2, 3, 2]), json!([0, 2, 1, 3])] {
        let refused = changed(&|f| f["faces_vertices"] = json!([polygon]));
        assert!(matches!(refused, ImportError::Facet { facet: 0, .. }), "{polygon}: {refused}");
    }
    // Three points of a line.
    let refused = changed(&|f| f["vertices_coords"][1] = json!([0.5, 0.5]));
    assert!(matches!(refused, ImportError::Facet { facet: 0, .. }), "{refused}");
    let refused = changed(&|f| f["faces_vertices"] = json!([[0, 1, 2], [0, 2, 3], [0, 2, 1]]));
    assert!(
        matches!(refused, ImportError::NonManifold { .. } | ImportError::Overlap { .. }),
        "{refused}"
    );
    let refused = changed(&|f| f["faces_vertices"] = json!([[0, 1, 2], [0, 1, 3]]));
    assert!(matches!(refused, ImportError::Overlap { .. }), "{refused}");
    let refused = changed(&|f| {
        f["vertices_coords"].as_array_mut().unwrap().push(json!([0.5, 0.6]));
        f["faces_vertices"].as_array_mut().unwrap().push(json!([0, 2, 4]));
    });
    assert!(matches!(refused, ImportError::NonManifold { .. }), "{refused}");
}

#[test]
fn a_file_without_faces_is_refused() {
    let none = json!({"vertices_coords": [[0, 0], [1, 0]], "edges_vertices": [[0, 1]]});
    assert_eq!(error(&none), ImportError::NoFaces);
    let empty = json!({"vertices_coords": [[0, 0], [1, 0]]});
    assert_eq!(error(&empty), ImportError::Empty);
}

#[test]
fn large_files_end_in_an_error() {
    let n = MOST_LINES + 1;
    let file = json!({
        "vertices_coords": [[0, 0], [1, 0]],
        "edges_vertices": vec![[0, 1]; n],
    });
    assert!(matches!(error(&file), ImportError::TooMany { .. }));
    let file = json!({"vertices_coords": vec![[0, 0]; 300_000]});
    assert!(matches!(error(&file), ImportError::TooMany { .. }));
}

#[test]
fn every_prefix_of_a_file_is_read_or_refused_without_a_panic() {
    let text = crate::draw::pop_up().fold().to_string();
    for end in 0..text.len() {
        assert!(import_fold(&text.as_bytes()[..end], &ImportOptions::default()).is_err());
    }
}
