//! A motion written as FOLD.

use foldmotion_pattern::{Case, FoldHeader, Frame, Motion, Unit, UnitSheet};
use glam::DVec3;
use serde_json::{Value, json};

fn written() -> (Motion, Value, u64) {
    let unit = Unit::new(Case::S, 1.6, 1.0, None, None).unwrap();
    let units = UnitSheet::new(unit, 2, 2).unwrap();
    let third = 1.0 / 3.0;
    let wild: Vec<DVec3> = units.compact().iter().map(|&p| p * third + third).collect();
    let motion = Motion {
        frames: vec![
            Frame { time: 1.0, positions: units.sheet.planar() },
            Frame { time: 1.5, positions: wild },
            Frame { time: 2.0, positions: units.compact() },
        ],
        compact_order: units.compact_order(),
        sheet: units.sheet.clone(),
    };
    let target_angles = units.compact_angles();
    let keys = json!({"file_author": "somebody", "file_title": "another"});
    let keys = keys.as_object().unwrap().clone();
    let header = FoldHeader {
        title: "a \"title\"",
        creator: "test",
        unit: "m",
        target_angles,
        layer_orders: &[(2, units.compact_order())],
        keys: &keys,
    };
    let mut bytes = Vec::new();
    motion.write_fold(&header, &mut bytes).unwrap();
    let value = serde_json::from_slice(&bytes).unwrap();
    (motion, value, bytes.len() as u64)
}

#[test]
fn coordinates_read_back_as_the_same_numbers() {
    let (motion, value, _) = written();
    for (frame, read) in motion.frames.iter().zip(value["file_frames"].as_array().unwrap()) {
        let coords: Vec<[f64; 3]> =
            serde_json::from_value(read["vertices_coords"].clone()).unwrap();
        let same = frame.positions.iter().zip(&coords).all(|(p, c)| p.to_array() == *c);
        assert!(same && coords.len() == frame.positions.len());
        assert_eq!(read["foldmotion:time"].as_f64(), Some(frame.time));
        assert_eq!((&read["frame_parent"], &read["frame_inherit"]), (&json!(0), &json!(true)));
    }
}

#[test]
fn fold_angles_carry_the_sign_of_their_assignment_and_borders_have_none() {
    let (motion, value, _) = written();
    let compact = value["file_frames"][2]["edges_foldAngle"].as_array().unwrap();
    for (edge, angle) in motion.sheet.edges.iter().zip(compact) {
        match (edge.assignment.letter(), angle.as_f64()) {
            ('B', None) => {}
            // Folded flat, a half turn is measured with either sign.
            ('M', Some(a)) => {
                assert!((a + 90.0).abs() < 1e-9 || (a.abs() - 180.0).abs() < 1e-9, "{a}");
            }
            ('V', Some(a)) => {
                assert!((a - 90.0).abs() < 1e-9 || (a.abs() - 180.0).abs() < 1e-9, "{a}");
            }
            ('F', Some(a)) => assert!(a.abs() < 1e-9),
            other => panic!("{other:?}"),
        }
    }
    let key: Vec<Option<f64>> = serde_json::from_value(value["edges_foldAngle"].clone()).unwrap();
    let signs =
        motion.sheet.edges.iter().zip(key).all(|(edge, angle)| match edge.assignment.letter() {
            'M' => angle.unwrap() < 0.0,
            'V' => angle.unwrap() > 0.0,
            'F' => angle == Some(0.0),
            _ => angle.is_none(),
        });
    assert!(signs);
}

#[test]
fn the_frames_named_alone_carry_the_order_of_their_layers() {
    let (motion, value, _) = written();
    assert!(value["file_frames"][0].get("faceOrders").is_none());
    let orders: Vec<(u32, u32, i8)> =
        serde_json::from_value(value["file_frames"][2]["faceOrders"].clone()).unwrap();
    assert!(!orders.is_empty());
    assert_eq!(orders, motion.compact_order.iter().collect::<Vec<_>>());
}

#[test]
fn further_keys_are_in_the_key_frame_but_replace_none() {
    let (_, value, _) = written();
    assert_eq!(value["file_author"], "somebody");
    assert_ne!(value["file_title"], "another");
}

#[test]
fn the_file_is_no_larger_than_estimated() {
    let (motion, _, size) = written();
    let orders = 24 * motion.compact_order.len() as u64;
    assert!(size <= Motion::fold_file_size(&motion.sheet, 3) + orders);
}
