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
