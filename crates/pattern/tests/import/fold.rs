//! What FOLD files say.

use std::f64::consts::PI;

use foldmotion_pattern::{
    Assignment, Edge, ImportError, ImportOptions, ImportedPattern, LengthUnit, Source, WarningKind,
    import_fold,
};
use glam::{DVec2, DVec3};
use serde_json::{Value, json};

use crate::patterns::{check_sheet, counts};

fn import(file: &Value) -> ImportedPattern {
    let imported = try_import(file).unwrap();
    check_sheet(&imported);
    imported
}

fn try_import(file: &Value) -> Result<ImportedPattern, ImportError> {
    import_fold(file.to_string().as_bytes(), &ImportOptions::default())
}

/// Two triangles that share edge 4, the diagonal of a square.
pub(crate) fn two_triangles() -> Value {
    json!({
        "vertices_coords": [[0, 0], [1, 0], [1, 1], [0, 1]],
        "edges_vertices": [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]],
        "edges_assignment": ["B", "B", "B", "B", "M"],
        "faces_vertices": [[0, 1, 2], [0, 2, 3]],
    })
}

fn warned(imported: &ImportedPattern, kind: WarningKind) -> usize {
    let found = imported.warnings.iter().find(|w| w.kind == kind);
    found.map_or(0, |w| w.count)
}

#[test]
fn letters_and_angles_say_how_an_edge_folds() {
    use Assignment::{Facet, Free, Mountain, Valley};
    /// Letter, angle, and what becomes of the edge.
    type Case = (Value, Option<Value>, Assignment, f64, Option<WarningKind>);
    let cases: [Case; 16] = [
        (json!("M"), None, Mountain, -180.0, None),
        (json!("V"), None, Valley, 180.0, None),
        (json!("M"), Some(json!(-90)), Mountain, -90.0, None),
        (json!("V"), Some(json!(0)), Valley, 0.0, None),
        (json!("M"), Some(json!(30)), Valley, 30.0, Some(WarningKind::OtherSign)),
        (json!("V"), Some(json!(null)), Free, 0.0, Some(WarningKind::MadeFree)),
        (json!("U"), None, Free, 0.0, None),
        (json!("U"), Some(json!(0)), Free, 0.0, None),
        (json!("U"), Some(json!(-45)), Mountain, -45.0, None),
        (json!("F"), None, Facet, 0.0, None),
        (json!("F"), Some(json!(12)), Valley, 12.0, None),
        (json!("J"), None, Facet, 0.0, None),
        (json!("J"), Some(json!(0)), Facet, 0.0, None),
        (json!(null), Some(json!(-20)), Mountain, -20.0, None),
        (json!(null), Some(json!(0)), Facet, 0.0, None),
        (json!(null), None, Free, 0.0, Some(WarningKind::Unassigned)),
    ];
    for (letter, angle, assignment, degrees, warning) in cases {
        for key in ["edges_foldAngle", "edges_foldAngles"] {
            for has_faces in [true, false] {
                let mut file = two_triangles();
                if letter.is_null() {
                    file.as_object_mut().unwrap().remove("edges_assignment");
                } else {
                    file["edges_assignment"][4] = letter.clone();
                }
                if let Some(angle) = &angle {
                    file[key] = json!([null, null, null, null, angle]);
                }
                if !has_faces {
                    file.as_object_mut().unwrap().remove("faces_vertices");
                }
                let imported = import(&file);
                let edge = imported.sheet.edges.iter().position(Edge::is_hinge).unwrap();
                assert_eq!(imported.sheet.edges[edge].assignment, assignment, "{file}");
                assert!((imported.targets[edge].to_degrees() - degrees).abs() < 1e-12);
                if let Some(kind) = warning {
                    assert!(warned(&imported, kind) > 0, "{file}: {:?}", imported.warnings);
                } else if has_faces {
                    assert!(imported.warnings.is_empty(), "{file}: {:?}", imported.warnings);
                }
                let free: Vec<u32> = imported.free_hinges().collect();
                assert_eq!(free.len(), usize::from(assignment == Free));
            }
        }
    }
}

#[test]
fn a_cut_between_two_faces_parts_them_where_it_can() {
    let mut file = two_triangles();
    file["edges_assignment"][4] = json!("C");
    let parted = import(&file);
    assert_eq!((parted.sheet.facets.len(), parted.euler_characteristic()), (2, 2));
    // A cut from the border to the middle: one vertex more, and a notch instead of two hinges.
    let notched = json!({
        "vertices_coords": [[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0.5]],
        "edges_vertices": [[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [1, 4], [2, 4], [3, 4]],
        "edges_assignment": ["B", "B", "B", "B", "C", "M", "V", "U"],
        "faces_vertices": [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]],
    });
    let imported = import(&notched);
    assert_eq!((imported.sheet.vertices.len(), counts(&imported)[&'B']), (6, 6));
    assert_eq!(imported.vertex_sources[5], Some(0));
    assert_eq!(imported.euler_characteristic(), 1);
}

#[test]
fn a_cut_that_both_ends_hold_together_is_a_free_hinge() {
    let slit = json!({
        "vertices_coords": [[0, 0], [3, 0], [3, 2], [0, 2], [1, 1], [2, 1]],
        "edges_vertices": [[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [3, 4], [1, 5], [2, 5], [4, 5]],
        "edges_assignment": ["B", "B", "B", "B", "M", "V", "M", "V", "C"],
    });
    let imported = import(&slit);
    assert_eq!(warned(&imported, WarningKind::ClosedCut), 1);
    assert_eq!(counts(&imported)[&'U'], 1);
    assert_eq!(imported.euler_characteristic(), 1);
}

#[test]
fn polygons_of_any_size_and_faces_with_holes_are_cut_into_triangles() {
    let ring = |n: usize, radius: f64| {
        (0..n).map(move |k| {
            let turn = 2.0 * PI * k as f64 / n as f64;
            [radius * turn.cos(), radius * turn.sin()]
        })
    };
    let border = |first: usize, n: usize| (0..n).map(move |k| [first + k, first + (k + 1) % n]);
    for n in [5, 17, 2000] {
        let file = json!({
            "vertices_coords": ring(n, 3.0).collect::<Vec<_>>(),
            "edges_vertices": border(0, n).collect::<Vec<_>>(),
            "faces_vertices": [(0..n).collect::<Vec<_>>()],
        });
        let imported = import(&file);
        assert_eq!(
            (imported.sheet.faces.len(), imported.sheet.facets[0].polygon.len()),
            (n - 2, n)
        );
        assert!(imported.warnings.is_empty(), "{:?}", imported.warnings);
    }
    // Traced: an octagon with a square hole that nothing joins to it. Listed: the same with a way to the hole.
    let edges: Vec<_> = border(0, 8).chain(border(8, 4)).collect();
    let mut file = json!({
        "vertices_coords": ring(8, 3.0).chain(ring(4, 1.0)).collect::<Vec<_>>(),
        "edges_vertices": edges,
        "edges_assignment": vec!["B"; 12],
    });
    for listed in [false, true] {
        if listed {
            let walk = [0, 1, 2, 3, 4, 5, 6, 7, 0, 8, 11, 10, 9, 8];
            file["faces_vertices"] = json!([walk]);
        }
        let imported = import(&file);
        assert_eq!(imported.euler_characteristic(), 0, "listed: {listed}");
        assert_eq!((imported.sheet.facets.len(), imported.sheet.faces.len()), (1, 12));
    }
}

#[test]
fn planes_other_than_z_0_are_turned_into_it_fronts_up() {
    let flat = import(&two_triangles());
    let places: [fn(f64, f64) -> [f64; 3]; 4] = [
        |x, y| [x, y, 7.0],
        |x, y| [x, 0.0, -y],
        |x, y| [x, -y, 0.0],
        |x, y| [x * 0.6 + 1.0, y, x * -0.8],
    ];
    for place in places {
        let mut file = two_triangles();
        for v in file["vertices_coords"].as_array_mut().unwrap() {
            let [x, y] = [0, 1].map(|i| v[i].as_f64().unwrap());
            *v = json!(place(x, y));
        }
        let imported = import(&file);
        assert!(warned(&imported, WarningKind::Turned) == 0);
        let lengths = |i: &ImportedPattern| -> Vec<f64> {
            let v = &i.sheet.vertices;
            i.sheet
                .edges
                .iter()
                .map(|e| v[e.vertices[0] as usize].distance(v[e.vertices[1] as usize]))
                .collect()
        };
        let same =
            lengths(&imported).iter().zip(lengths(&flat)).all(|(a, b)| (a - b).abs() < 1e-12);
        assert!(same);
        let shape = imported.shape.as_ref().unwrap();
        assert_eq!(shape[1], DVec3::from(place(1.0, 0.0)));
    }
    assert_eq!(flat.shape, None);
}

#[test]
fn a_folded_key_frame_is_laid_out_flat_unless_a_frame_is_the_pattern() {
    let mut file = two_triangles();
    file["frame_classes"] = json!(["foldedForm"]);
    let flat = file["vertices_coords"].clone();
    file["vertices_coords"] = json!([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.5]]);
    assert_eq!(warned(&import(&file), WarningKind::Unfolded), 1);
    // Without faces nothing says how.
    let mut bare = file.clone();
    bare.as_object_mut().unwrap().remove("faces_vertices");
    let error = try_import(&bare).unwrap_err();
    assert!(matches!(error, ImportError::NotFlat { .. }), "{error}");
    // The same square folded over its diagonal, in the plane.
    file["vertices_coords"] = json!([[0, 0], [1, 0], [1, 1], [1, 0]]);
    let imported = import(&file);
    let distances = |sheet: &foldmotion_pattern::Sheet| {
        [1, 3].map(|v| sheet.vertices[v].distance(sheet.vertices[0]))
    };
    assert_eq!(distances(&imported.sheet), [1.0, 1.0]);
    let across = imported.sheet.vertices[1].distance(imported.sheet.vertices[3]);
    assert!((across - 2f64.sqrt()).abs() < 1e-15);
    assert!(imported.targets.contains(&-PI));
    // Laid flat by the listed class alone: without it, the faces overlap.
    file.as_object_mut().unwrap().remove("frame_classes");
    let error = try_import(&file).unwrap_err();
    assert!(matches!(error, ImportError::Overlap { .. }), "{error}");
    file["file_frames"] = json!([{
        "frame_parent": 0, "frame_inherit": true, "frame_classes": ["creasePattern"],
        "vertices_coords": flat,
    }]);
    assert_eq!(import(&file).sheet.vertices, import(&two_triangles()).sheet.vertices);
}

#[test]
fn frames_with_angles_are_stages_and_drive_what_the_key_frame_leaves_free() {
    let mut file = two_triangles();
    file["edges_assignment"][4] = json!("V");
    file["edges_foldAngle"] = json!([null, null, null, null, null]);
    file["file_frames"] = json!([
        {"frame_parent": 0, "frame_inherit": true, "frame_title": "half",
         "edges_foldAngle": [null, null, null, null, 90]},
        {"frame_parent": 1, "frame_inherit": true, "vertices_coords": [[0, 0], [1, 0], [1, 1], [0, 1]]},
        {"frame_parent": 2, "frame_inherit": true, "edges_foldAngle": [null, null, null, null, null]},
        {"edges_vertices": [[0, 1]], "edges_foldAngle": [3]},
    ]);
    let imported = import(&file);
    assert_eq!(imported.free_hinges().count(), 0);
    let edge = imported.sheet.edges.iter().position(Edge::is_hinge).unwrap();
    let stages: Vec<_> =
        imported.stages.iter().map(|s| (s.frame, s.title.as_deref(), s.angles[edge])).collect();
    assert_eq!(stages, [(0, Some("half"), Some(PI / 2.0)), (2, None, None)]);
    assert_eq!(imported.sheet.edges[edge].assignment, Assignment::Valley);
    let other = imported.warnings.iter().find(|w| w.kind == WarningKind::OtherFrame).unwrap();
    assert_eq!(other.sources, [Source::FoldFrame(3)]);
}

#[test]
fn what_no_face_needs_is_left_out_with_a_warning() {
    let mut file = two_triangles();
    file["vertices_coords"].as_array_mut().unwrap().insert(0, json!([9, 9]));
    for list in ["edges_vertices", "faces_vertices"] {
        for entry in file[list].as_array_mut().unwrap() {
            for v in entry.as_array_mut().unwrap() {
                *v = json!(v.as_u64().unwrap() + 1);
            }
        }
    }
    // Edges listed twice with another meaning, and a face the wrong way round.
    for (edge, letter) in [([1, 3], "V"), ([1, 3], "M")] {
        file["edges_vertices"].as_array_mut().unwrap().push(json!(edge));
        file["edges_assignment"].as_array_mut().unwrap().push(json!(letter));
    }
    file["faces_vertices"][1].as_array_mut().unwrap().reverse();
    let imported = import(&file);
    assert_eq!(imported.vertex_sources, [1, 2, 3, 4].map(Some));
    for (kind, source) in [
        (WarningKind::UnusedVertex, Source::FoldVertex(0)),
        (WarningKind::Conflict, Source::FoldEdge(5)),
        (WarningKind::Duplicate, Source::FoldEdge(6)),
        (WarningKind::Turned, Source::FoldFace(1)),
    ] {
        let warning = imported.warnings.iter().find(|w| w.kind == kind).unwrap();
        assert_eq!(warning.sources, [source], "{warning}");
    }
}

#[test]
fn edges_that_only_faces_name_are_facet_lines_or_free() {
    let mut file = two_triangles();
    file["edges_vertices"].as_array_mut().unwrap().pop();
    file["edges_assignment"].as_array_mut().unwrap().pop();
    let imported = import(&file);
    assert_eq!(counts(&imported).get(&'F'), Some(&1));
    let keys = file.as_object_mut().unwrap();
    keys.remove("edges_vertices");
    keys.remove("edges_assignment");
    let imported = import(&file);
    assert_eq!(counts(&imported).get(&'U'), Some(&1));
    assert_eq!(warned(&imported, WarningKind::Unassigned), 1);
}

#[test]
fn units_titles_unit_lengths_and_fixed_faces_are_read() {
    for unit in ["unit", "in", "pt", "m", "cm", "mm", "um", "nm"] {
        let mut file = two_triangles();
        file["frame_unit"] = json!(unit);
        file["file_title"] = json!("a square");
        let imported = import(&file);
        assert_eq!((imported.unit.name(), imported.title.as_deref()), (unit, Some("a square")));
    }
    assert_eq!(LengthUnit::named("in").unwrap().metres(), Some(0.0254));
    let mut file = two_triangles();
    let mean = (4.0 + 2f64.sqrt()) / 5.0;
    assert!((import(&file).sheet.unit_length - mean).abs() < 1e-15);
    file["foldmotion:unitLength"] = json!(0.5);
    file["faces_foldmotion:fixed"] = json!([false, true]);
    let imported = import(&file);
    assert_eq!((imported.sheet.unit_length, imported.fixed_facets), (0.5, vec![1]));
    let mut file = two_triangles();
    file["rtori:os:vertices_fixed"] = json!([1, 1, 1, 0]);
    assert_eq!(import(&file).fixed_facets, [0]);
}

#[test]
fn keys_that_are_not_read_survive_a_round_trip() {
    let mut file = two_triangles();
    file["file_author"] = json!("someone");
    file["edges_lab:stiffness"] = json!([1, 2, 3, 4, 5]);
    file["lab:edges_colour"] = json!(["a", "b", "c", "d", "e"]);
    file["vertices_lab:mass"] = json!([{"m": 1}, 2, 3, 4]);
    file["faces_lab:paper"] = json!(["x", "y"]);
    file["lab:note"] = json!({"nested": [1, {"deep": null}]});
    file["faceOrders"] = json!([[0, 1, 1]]);
    file["edges_faces"] = json!([[0, null]]);
    let imported = import(&file);
    let written: Value = serde_json::from_str(&imported.fold("test")).unwrap();
    for key in [
        "file_author",
        "edges_lab:stiffness",
        "lab:edges_colour",
        "vertices_lab:mass",
        "faces_lab:paper",
        "lab:note",
        "edges_vertices",
        "edges_assignment",
        "faces_vertices",
    ] {
        assert_eq!(written[key], file[key], "{key}");
    }
    assert!(written.get("edges_faces").is_none() && written.get("faceOrders").is_none());
    let again = import(&written);
    assert_eq!((&again.sheet, &again.targets), (&imported.sheet, &imported.targets));
    assert_eq!(again.keys.get("lab:note"), imported.keys.get("lab:note"));
}

#[test]
fn lists_follow_their_elements_where_the_sheet_has_others() {
    // The crease that crosses the other is split; the cut's vertex is doubled.
    let file = json!({
        "vertices_coords": [[0, 0], [2, 0], [2, 2], [0, 2], [1, 0], [1, 2], [0, 1], [2, 1]],
        "edges_vertices": [[0, 4], [4, 1], [1, 7], [7, 2], [2, 5], [5, 3], [3, 6], [6, 0], [4, 5], [6, 7]],
        "edges_assignment": ["B", "B", "B", "B", "B", "B", "B", "B", "M", "V"],
        "edges_lab:name": [0, 1, 2, 3, 4, 5, 6, 7, "up", "across"],
        "vertices_lab:name": [0, 1, 2, 3, 4, 5, 6, 7],
    });
    let imported = import(&file);
    assert_eq!(warned(&imported, WarningKind::Split), 2);
    let written: Value = serde_json::from_str(&imported.fold("test")).unwrap();
    for (letter, name) in [("M", json!("up")), ("V", json!("across"))] {
        let letters = written["edges_assignment"].as_array().unwrap();
        let names = letters.iter().zip(written["edges_lab:name"].as_array().unwrap());
        let of: Vec<&Value> = names.filter(|(l, _)| *l == letter).map(|(_, n)| n).collect();
        assert_eq!(of, [&name, &name]);
    }
    let places = written["vertices_coords"].as_array().unwrap();
    for (place, name) in places.iter().zip(written["vertices_lab:name"].as_array().unwrap()) {
        match name.as_u64() {
            Some(index) => {
                let at = |v: &Value| DVec2::from([0, 1].map(|i| v[i].as_f64().unwrap()));
                assert_eq!(at(place), at(&file["vertices_coords"][index as usize]));
            }
            None => assert_eq!(place, &json!([1.0, 1.0])),
        }
    }
}
