//! Writes a motion as FOLD 1.2: the crease pattern as key frame, the frames of the motion as `file_frames`.

use std::io::{self, Write};

use glam::DVec3;
use serde_json::{Map, Value, json};

use super::CreasePattern;
use crate::{Frame, LayerOrder, Motion, Sheet};

/// The keys of a FOLD file of a motion that do not follow from the motion itself.
#[derive(Debug, Clone, Copy)]
pub struct FoldHeader<'a> {
    /// The title of the file, `file_title`.
    pub title: &'a str,
    /// The program that wrote the file, `file_creator`.
    pub creator: &'a str,
    /// `frame_unit`: one of FOLD's `unit`, `in`, `pt`, `m`, `cm`, `mm`, `um`, `nm`.
    pub unit: &'a str,
    /// The fold angle every edge of the crease pattern is to take, radians: `edges_foldAngle` of the key frame, which
    /// Origami Simulator folds to.
    pub target_angles: &'a [f64],
    /// The order of the triangles that coincide, by the index of the frame, in order: its `faceOrders`.
    pub layer_orders: &'a [(usize, LayerOrder)],
    /// Further keys of the key frame; those that the motion writes itself are ignored.
    pub keys: &'a Map<String, Value>,
}

/// An upper estimate of the mean size of a written number, bytes: 17 digits, sign, point and comma.
const BYTES_A_NUMBER: u64 = 20;

impl Motion {
    /// An upper estimate of the size of [`Motion::write_fold`]'s file for `frames` frames, bytes.
    pub fn fold_file_size(sheet: &Sheet, frames: usize) -> u64 {
        let numbers = 3 * sheet.vertices.len() as u64 + sheet.edges.len() as u64;
        let header = 8 * (sheet.vertices.len() + sheet.edges.len() + sheet.faces.len()) as u64;
        (header + frames as u64 * numbers) * BYTES_A_NUMBER + 4096
    }

    /// Streams the motion to `out` as FOLD 1.2, one frame a line.
    ///
    /// Coordinates are the shortest decimals that read back as the same f64; fold angles are measured, in degrees,
    /// clamped to ±180; frames for which the header has an order get `faceOrders`.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write_fold(&self, header: &FoldHeader<'_>, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "{{")?;
        let own = CreasePattern {
            sheet: &self.sheet,
            target_angles: header.target_angles,
            title: header.title,
            creator: header.creator,
            description: None,
            file_classes: &["singleModel", "animation"],
            unit: header.unit,
            scale: 1.0,
            has_triangles: true,
        }
        .keys();
        for (key, value) in &own {
            writeln!(out, "\"{key}\": {value},")?;
        }
        let is_own = |key: &str| key == "file_frames" || own.iter().any(|(own, _)| *own == key);
        for (key, value) in header.keys.iter().filter(|(key, _)| !is_own(key)) {
            writeln!(out, "{}: {value},", json!(key))?;
        }
        writeln!(out, "\"file_frames\": [")?;
        for (index, frame) in self.frames.iter().enumerate() {
            let last = index + 1 == self.frames.len();
            let orders = header.layer_orders;
            let order = orders.binary_search_by_key(&index, |(frame, _)| *frame);
            let order = order.ok().map(|index| &orders[index].1);
            write_frame(&self.sheet, frame, order, out)?;
            writeln!(out, "{}", if last { "" } else { "," })?;
        }
        writeln!(out, "]\n}}")
    }
}

fn write_frame(
    sheet: &Sheet,
    frame: &Frame,
    order: Option<&LayerOrder>,
    out: &mut impl Write,
) -> io::Result<()> {
    write!(
        out,
        "{{\"frame_parent\":0,\"frame_inherit\":true,\"frame_title\":{},\"frame_classes\":[\"foldedForm\"],\
         \"frame_attributes\":[\"3D\",\"manifold\",\"orientable\",\"noCuts\",\"noJoins\"],\"foldmotion:time\":",
        json!(format!("{}, t = {}", stage_name(frame.time), frame.time))
    )?;
    write_number(frame.time, out)?;
    write!(out, ",\"vertices_coords\":[")?;
    for (index, &DVec3 { x, y, z }) in frame.positions.iter().enumerate() {
        out.write_all(if index == 0 { b"[" } else { b",[" })?;
        write_number(x, out)?;
        out.write_all(b",")?;
        write_number(y, out)?;
        out.write_all(b",")?;
        write_number(z, out)?;
        out.write_all(b"]")?;
    }
    write!(out, "],\"edges_foldAngle\":[")?;
    for (index, angle) in sheet.fold_angles(&frame.positions).into_iter().enumerate() {
        if index > 0 {
            out.write_all(b",")?;
        }
        match angle {
            Some(angle) => write_number(angle.to_degrees().clamp(-180.0, 180.0), out)?,
            None => out.write_all(b"null")?,
        }
    }
    write!(out, "]")?;
    if let Some(order) = order.filter(|order| !order.is_empty()) {
        write!(out, ",\"faceOrders\":[")?;
        for (index, (f, g, sign)) in order.iter().enumerate() {
            write!(out, "{}[{f},{g},{sign}]", if index > 0 { "," } else { "" })?;
        }
        write!(out, "]")?;
    }
    write!(out, "}}")
}

fn write_number(value: f64, out: &mut impl Write) -> io::Result<()> {
    serde_json::to_writer(&mut *out, &value).map_err(io::Error::from)
}

fn stage_name(time: f64) -> &'static str {
    match time {
        0.0 => "deployed",
        1.0 => "planar",
        2.0 => "compact",
        t if t < 1.0 => "unfold",
        _ => "fold",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Case, Unit, UnitSheet};
    use serde_json::Value;

    fn written() -> (Motion, Value, u64) {
        let unit = Unit::new(Case::S, 1.6, 1.0, None, None).unwrap();
        let units = UnitSheet::new(unit, 2, 2).unwrap();
        let third = 1.0 / 3.0;
        let wild: Vec<DVec3> = units.compact().iter().map(|&p| p * third + third).collect();
        let motion = Motion {
            frames: vec![
                Frame {
                    time: 1.0,
                    positions: units.sheet.planar(),
                },
                Frame {
                    time: 1.5,
                    positions: wild,
                },
                Frame {
                    time: 2.0,
                    positions: units.compact(),
                },
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
        for (frame, read) in motion
            .frames
            .iter()
            .zip(value["file_frames"].as_array().unwrap())
        {
            let coords: Vec<[f64; 3]> =
                serde_json::from_value(read["vertices_coords"].clone()).unwrap();
            let same = frame
                .positions
                .iter()
                .zip(&coords)
                .all(|(p, c)| p.to_array() == *c);
            assert!(same && coords.len() == frame.positions.len());
            assert_eq!(read["foldmotion:time"].as_f64(), Some(frame.time));
            assert_eq!(
                (&read["frame_parent"], &read["frame_inherit"]),
                (&json!(0), &json!(true))
            );
        }
    }

    #[test]
    fn fold_angles_carry_the_sign_of_their_assignment_and_borders_have_none() {
        let (motion, value, _) = written();
        let compact = value["file_frames"][2]["edges_foldAngle"]
            .as_array()
            .unwrap();
        for (edge, angle) in motion.sheet.edges.iter().zip(compact) {
            match (edge.assignment.letter(), angle.as_f64()) {
                ('B', None) => {}
                // Folded flat, a half turn is measured with either sign.
                ('M', Some(a)) => assert!(
                    (a + 90.0).abs() < 1e-9 || (a.abs() - 180.0).abs() < 1e-9,
                    "{a}"
                ),
                ('V', Some(a)) => assert!(
                    (a - 90.0).abs() < 1e-9 || (a.abs() - 180.0).abs() < 1e-9,
                    "{a}"
                ),
                ('F', Some(a)) => assert!(a.abs() < 1e-9),
                other => panic!("{other:?}"),
            }
        }
        let key: Vec<Option<f64>> =
            serde_json::from_value(value["edges_foldAngle"].clone()).unwrap();
        let signs = motion.sheet.edges.iter().zip(key).all(|(edge, angle)| {
            match edge.assignment.letter() {
                'M' => angle.unwrap() < 0.0,
                'V' => angle.unwrap() > 0.0,
                'F' => angle == Some(0.0),
                _ => angle.is_none(),
            }
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
    fn further_keys_stand_in_the_key_frame_but_replace_none() {
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
}
