//! FOLD read as a motion: what is read, and what is refused by name and index.

use foldmotion_pattern::{
    Assignment, Case, FoldError, FoldFile, FoldHeader, Frame, Motion, Unit, UnitSheet,
};
use glam::DVec3;
use serde_json::{Value, json};

fn frames(text: &str) -> Result<(FoldFile, Vec<Frame>), FoldError> {
    let file = FoldFile::read(text.as_bytes())?;
    let mut frames = Vec::new();
    file.frames::<FoldError>(text.as_bytes(), &mut |frame, _| {
        frames.push(frame);
        Ok(())
    })?;
    assert_eq!(frames.len(), file.frame_count());
    Ok((file, frames))
}

fn refused(value: &Value) -> FoldError {
    frames(&value.to_string()).map(drop).unwrap_err()
}

/// Two triangles on a square, moving.
fn square() -> Value {
    json!({
        "file_spec": 1.1,
        "frame_classes": ["creasePattern"],
        "vertices_coords": [[0, 0], [1, 0], [1, 1], [0, 1]],
        "edges_vertices": [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]],
        "edges_assignment": ["B", "B", "B", "B", "V"],
        "faces_vertices": [[0, 1, 2], [0, 2, 3]],
        "file_frames": [
            { "frame_parent": 0, "frame_inherit": true,
              "vertices_coords": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]] },
            { "frame_parent": 1, "frame_inherit": true,
              "vertices_coords": [[0, 0], [1, 0], [1, 1], [0.5, 0.5, 0.5]] },
        ],
    })
}

fn with(change: impl FnOnce(&mut Value)) -> Value {
    let mut value = square();
    change(&mut value);
    value
}

#[test]
fn our_own_motion_reads_back_bitwise() {
    let unit = Unit::new(Case::S, 1.6, 1.0, None, None).unwrap();
    let units = UnitSheet::new(unit, 2, 2).unwrap();
    let wild: Vec<DVec3> = units.compact().iter().map(|&p| p / 3.0 + 1.0 / 3.0).collect();
    let frame = |time, positions| Frame { time, positions };
    let motion = Motion {
        frames: vec![
            frame(1.0, units.sheet.planar()),
            frame(1.0 + 1.0 / 3.0, wild),
            frame(2.0, units.compact()),
        ],
        compact_order: units.compact_order(),
        sheet: units.sheet.clone(),
    };
    let header = FoldHeader {
        title: "ours",
        creator: "test",
        unit: "m",
        target_angles: units.compact_angles(),
        layer_orders: &[(2, units.compact_order())],
        keys: &serde_json::Map::new(),
    };
    let mut bytes = Vec::new();
    motion.write_fold(&header, &mut bytes).unwrap();
    let (file, read) = frames(std::str::from_utf8(&bytes).unwrap()).unwrap();
    assert_eq!(read, motion.frames);
    let (own, sheet) = (&file.sheet, &motion.sheet);
    assert_eq!((&own.vertices, &own.faces), (&sheet.vertices, &sheet.faces));
    assert_eq!(own.face_facets, sheet.face_facets);
    assert_eq!(own.unit_length.to_bits(), sheet.unit_length.to_bits());
    assert!(file.has_unit_length && file.has_facets);
    for (a, b) in own.edges.iter().zip(&sheet.edges) {
        assert_eq!((a.vertices, a.assignment, a.faces), (b.vertices, b.assignment, b.faces));
    }
    for (a, b) in own.facets.iter().zip(&sheet.facets) {
        let start = a.polygon.iter().position(|v| *v == b.polygon[0]).unwrap();
        let mut turned = a.polygon.clone();
        turned.rotate_left(start);
        assert_eq!(turned, b.polygon);
    }
}

#[test]
fn a_pattern_is_not_a_frame_of_the_motion_and_times_default_to_the_index() {
    let (file, read) = frames(&square().to_string()).unwrap();
    assert_eq!(read.iter().map(|f| f.time).collect::<Vec<_>>(), [0.0, 1.0]);
    assert_eq!(read[1].positions[2..], [DVec3::new(1.0, 1.0, 0.0), DVec3::splat(0.5)]);
    let mean = (4.0 + 2.0_f64.sqrt()) / 5.0;
    assert!((file.sheet.unit_length - mean).abs() < 1e-15);
    assert_eq!(file.sheet.edges[4].assignment, Assignment::Valley);
    // A folded key frame is the first.
    let folded = with(|v| v["frame_classes"] = json!(["foldedForm"]));
    assert_eq!(frames(&folded.to_string()).unwrap().1.len(), 3);
    let alone = with(|v| drop(v.as_object_mut().unwrap().remove("file_frames")));
    assert_eq!(frames(&alone.to_string()).unwrap().1.len(), 1);
}

#[test]
fn keys_may_follow_the_frames() {
    let value = square();
    let (key, list): (Vec<_>, Vec<_>) = value
        .as_object()
        .unwrap()
        .iter()
        .map(|(k, v)| format!("\"{k}\":{v}"))
        .partition(|line| !line.starts_with("\"file_frames"));
    let early = format!("{{{},{}}}", list[0], key.join(","));
    let late = format!("{{{},{}}}", key.join(","), list[0]);
    let (a, b) = (frames(&early).unwrap(), frames(&late).unwrap());
    assert_eq!((a.0.sheet, a.1), (b.0.sheet, b.1));
}

#[test]
fn coordinates_are_inherited_along_chains() {
    let value = with(|v| {
        let list = v["file_frames"].as_array_mut().unwrap();
        list.push(json!({ "frame_parent": 1, "frame_inherit": true }));
        list.push(json!({ "frame_parent": 3, "frame_inherit": true }));
        list.push(json!({ "frame_parent": 0, "frame_inherit": true }));
    });
    let (_, read) = frames(&value.to_string()).unwrap();
    assert_eq!(read.len(), 5);
    for k in [2, 3, 4] {
        assert_eq!(read[k].positions, read[0].positions);
    }
    assert_ne!(read[1].positions, read[0].positions);
}

#[test]
fn bad_inheritance_is_refused() {
    for parent in [json!(2), json!(3), json!(99)] {
        let looped = with(|v| v["file_frames"][1]["frame_parent"] = parent.clone());
        let error = refused(&looped);
        assert!(matches!(error, FoldError::Parent { .. }), "{error}");
    }
    let orphan = with(|v| {
        drop(v["file_frames"][0].as_object_mut().unwrap().remove("frame_parent"));
    });
    assert!(refused(&orphan).to_string().starts_with("file_frames[0] inherits"));
    let own = with(|v| v["file_frames"][1] = json!({ "frame_parent": 0 }));
    assert!(matches!(refused(&own), FoldError::Missing { .. }));
}

#[test]
fn polygons_are_cut_and_edges_built_from_faces() {
    let value = json!({
        "vertices_coords": [[0, 0], [2, 0], [2, 1], [1, 0.2], [0, 1], [2, -1], [0, -1]],
        "faces_vertices": [[0, 1, 2, 3, 4], [0, 6, 5, 1]],
    });
    let (file, _) = frames(&value.to_string()).unwrap();
    assert_eq!(file.triangle_faces, [0, 0, 0, 1, 1]);
    assert_eq!(file.sheet.facets.len(), 2);
    let borders = file.sheet.edges.iter().filter(|e| !e.is_hinge()).count();
    assert_eq!((file.sheet.edges.len(), borders), (11, 7));
    let area = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| file.rest[v as usize]);
        (b - a).cross(c - a).z
    };
    assert!(file.sheet.faces.iter().all(|t| area(t) > 0.0));
}

#[test]
fn each_bad_input_is_named() {
    type Change = fn(&mut Value);
    let cases: [(Change, &str); 16] = [
        (|v| v["vertices_coords"][2] = json!([1]), "the key frame, vertices_coords[2]"),
        (|v| v["vertices_coords"][2] = json!([1, null]), "the key frame, vertices_coords[2]"),
        (|v| v["vertices_coords"][1] = json!([1, 2, 3, 4]), "vertices_coords[1]"),
        (
            |v| v["file_frames"][1]["vertices_coords"][3][0] = json!("NaN"),
            "file_frames[1], vertices_coords[3]",
        ),
        (
            |v| {
                drop(v["file_frames"][1]["vertices_coords"].as_array_mut().unwrap().pop());
            },
            "file_frames[1]: vertices_coords has 3 entries: 4",
        ),
        (|v| v["faces_vertices"][1][2] = json!(4), "faces_vertices[1] names vertex 4"),
        (|v| v["faces_vertices"][1][2] = json!(-1), "faces_vertices[1]"),
        (|v| v["edges_vertices"][4][1] = json!(9), "edges_vertices[4] names vertex 9"),
        (|v| v["faces_vertices"][0] = json!([0, 1]), "faces_vertices[0] has 2 corners"),
        (|v| v["faces_vertices"][0] = json!([0, 1, 1]), "faces_vertices[0] names vertex 1 twice"),
        (|v| v["vertices_coords"][3] = json!([0.5, 0.5]), "faces_vertices[1] has no area"),
        (|v| v["faces_vertices"] = json!([]), "the key frame has no faces_vertices"),
        (|v| v["faces_vertices"] = json!([[0, 1, 2], [0, 2, 3], [2, 0, 1]]), "the edge [0, 2]"),
        (
            |v| v["file_frames"][0]["faces_vertices"] = json!([[0, 1, 2]]),
            "file_frames[0] has other",
        ),
        (|v| v["edges_assignment"] = json!(["B"]), "edges_assignment has 1 entries: 5"),
        (|v| v["foldmotion:unitLength"] = json!(0), "foldmotion:unitLength is 0"),
    ];
    for (change, named) in cases {
        let error = refused(&with(change)).to_string();
        assert!(error.contains(named), "{error:?} should contain {named:?}");
    }
}

#[test]
fn text_that_is_no_whole_json_is_refused_wherever_it_ends() {
    let text = square().to_string();
    for end in 0..text.len() {
        assert!(FoldFile::read(&text.as_bytes()[..end]).is_err(), "{end}");
    }
    assert!(FoldFile::read(format!("{text} {{}}").as_bytes()).is_err());
    let mut bytes = text.replace("1.1", "\"u\"").into_bytes();
    let at = bytes.iter().position(|&b| b == b'u').unwrap();
    bytes[at] = 0xff;
    let error = FoldFile::read(&bytes[..]).unwrap_err().to_string();
    assert!(error.contains("UTF-8"), "{error}");
    let huge = square().to_string().replace("0.5,0.5,0.5", "0.5,0.5,1e999");
    let error = frames(&huge).unwrap_err().to_string();
    assert!(error.starts_with("file_frames[1], vertices_coords[3]"), "{error}");
    let twice = text.replacen('{', "{\"vertices_coords\":[],", 1);
    assert!(frames(&twice).unwrap_err().to_string().contains("given twice"));
}

#[test]
fn a_caller_that_ends_the_reading_gets_its_own_error() {
    #[derive(Debug, PartialEq)]
    struct Enough(usize);
    impl From<FoldError> for Enough {
        fn from(_: FoldError) -> Self {
            Self(0)
        }
    }
    let text = square().to_string();
    let file = FoldFile::read(text.as_bytes()).unwrap();
    let outcome = file.frames(text.as_bytes(), &mut |_, _| Err(Enough(1)));
    assert_eq!(outcome, Err(Enough(1)));
}

/// The claims of every frame.
fn claims(value: &Value) -> Vec<Vec<(u32, u32, i8)>> {
    let text = value.to_string();
    let file = FoldFile::read(text.as_bytes()).unwrap();
    let mut claims = Vec::new();
    file.frames::<FoldError>(text.as_bytes(), &mut |_, order| {
        claims.push(order.iter().collect());
        Ok(())
    })
    .unwrap();
    claims
}

#[test]
fn face_orders_are_inherited_like_coordinates_and_unknown_signs_are_no_claim() {
    let still = json!({ "frame_parent": 1, "frame_inherit": true });
    let own = with(|v| {
        v["file_frames"][0]["faceOrders"] = json!([[1, 0, 1], [0, 1, 0]]);
        v["file_frames"][1]["faceOrders"] = json!([[1, 0, -1]]);
        v["file_frames"].as_array_mut().unwrap().push(still.clone());
    });
    assert_eq!(claims(&own), [vec![(1, 0, 1)], vec![(1, 0, -1)], vec![(1, 0, 1)]]);
    let of_key = with(|v| v["faceOrders"] = json!([[0, 1, -1]]));
    assert_eq!(claims(&of_key), vec![vec![(0, 1, -1)]; 2]);
    assert_eq!(claims(&square()), vec![vec![]; 2]);
}

#[test]
fn face_orders_that_order_no_two_faces_are_refused_by_entry() {
    let orders = [
        (json!([[0, 1, 1], [1, 2, 1]]), "file_frames[1]: faceOrders[1] is [1, 2, 1]"),
        (json!([[1, 1, 1]]), "faceOrders[0] is [1, 1, 1]"),
        (json!([[1, 0, 2]]), "faceOrders[0] is [1, 0, 2]"),
        (json!([[1, 0, 1], [1, 0, -1]]), "faceOrders[1] gives faces 1 and 0"),
        (json!([[1, 0]]), "faceOrders"),
        (json!([[1, -1, 1]]), "faceOrders"),
        (json!([[1, 0, 0.5]]), "faceOrders"),
        (json!(3), "faceOrders"),
    ];
    for (order, named) in orders {
        let error = refused(&with(|v| v["file_frames"][1]["faceOrders"] = order));
        assert!(error.to_string().contains(named), "{error}");
        assert!(error.to_string().contains("file_frames[1]"), "{error}");
    }
    let error = refused(&with(|v| v["faceOrders"] = json!([[0, 2, 1]])));
    assert!(error.to_string().contains("the key frame: faceOrders[0]"), "{error}");
}
