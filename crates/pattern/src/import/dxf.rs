//! Crease patterns in DXF (ASCII).
//!
//! Read are LINE, LWPOLYLINE and POLYLINE with bulges, ARC, CIRCLE and ELLIPSE in model space. A line means what its
//! layer is called (mountain, valley, border, cut, facet, free; auxiliary) or, if that says nothing, what its colour
//! means (its own or its layer's: AutoCAD's numbers or true colour). Source: Autodesk, *DXF Reference*.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use glam::DVec2;

use super::colour::{Meaning, meaning};
use super::drawing::Role;
use super::entries::{Entries, number, wrong_line};
use super::layer_names::named_meaning;
use super::names::Names;
use super::stroke::{Piece, arc};
use super::warning::WarningKind;
use super::{ImportError, ImportOptions, ImportedPattern, LengthUnit, Source};

/// Entities that draw lines which are not read.
const UNREAD: [&str; 6] = ["SPLINE", "INSERT", "HATCH", "REGION", "MLINE", "3DFACE"];
/// The colour number of an entity that takes the colour of its layer.
const BY_LAYER: f64 = 256.0;

/// A record of the file: what follows a group code 0.
struct Record<'a> {
    name: &'a str,
    /// The line on which its name stands.
    line: usize,
    /// Group codes and values.
    groups: Vec<(i32, &'a str)>,
}

impl<'a> Record<'a> {
    fn text(&self, code: i32) -> Option<&'a str> {
        self.groups.iter().find(|(c, _)| *c == code).map(|(_, value)| *value)
    }

    fn number(&self, code: i32) -> Result<Option<f64>, ImportError> {
        let Some(text) = self.text(code) else { return Ok(None) };
        self.parsed(text).map(Some)
    }

    fn parsed(&self, text: &str) -> Result<f64, ImportError> {
        let need = "an entity needs finite numbers";
        number(text).ok_or_else(|| wrong_line(self.line, text, need))
    }

    fn point(&self, x: i32) -> Result<DVec2, ImportError> {
        let coordinate = |code| Ok::<_, ImportError>(self.number(code)?.unwrap_or_default());
        Ok(DVec2::new(coordinate(x)?, coordinate(x + 10)?))
    }

    fn flags(&self) -> Result<i64, ImportError> {
        Ok(self.number(70)?.unwrap_or_default() as i64)
    }
}

/// A layer.
#[derive(Default)]
struct Layer {
    colour: Option<Meaning>,
    is_hidden: bool,
}

/// Whether a text looks like DXF: pairs of group codes and values that begin with a section.
pub(super) fn is_dxf(text: &str) -> bool {
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let mut code = lines.next();
    while code == Some("999") {
        lines.next();
        code = lines.next();
    }
    code == Some("0") && lines.next() == Some("SECTION")
}

/// Reads DXF.
pub(super) fn import_dxf(
    text: &str,
    options: &ImportOptions,
) -> Result<ImportedPattern, ImportError> {
    let records = records(text)?;
    let mut drawing = DxfDrawing { entries: Entries::new(options), layers: BTreeMap::new() };
    let mut unit = LengthUnit::Unit;
    let mut section = "";
    let mut index = 0;
    while let Some(record) = records.get(index) {
        index += 1;
        match (record.name, section) {
            ("SECTION", _) => {
                section = record.text(2).unwrap_or_default();
                if section == "HEADER" {
                    unit = header_unit(record);
                }
            }
            ("ENDSEC", _) => section = "",
            ("LAYER", "TABLES") => drawing.layer(record)?,
            ("POLYLINE", "ENTITIES") => {
                let rest = &records[index..];
                let count = rest.iter().take_while(|r| r.name == "VERTEX").count();
                drawing.polyline(record, &rest[..count])?;
                index += count;
            }
            (_, "ENTITIES") => drawing.entity(record)?,
            _ => {}
        }
    }
    drawing.cuts_around_are_border();
    drawing.entries.finish(None, unit)
}

fn records(text: &str) -> Result<Vec<Record<'_>>, ImportError> {
    let mut records: Vec<Record<'_>> = Vec::new();
    let mut lines = text.lines().enumerate();
    while let (Some((index, code)), Some((_, value))) = (lines.next(), lines.next()) {
        let need = "a group code, a whole number, is needed";
        let code: i32 = code.trim().parse().map_err(|_| wrong_line(index + 1, code, need))?;
        let value = value.trim();
        match records.last_mut() {
            _ if code == 0 => {
                records.push(Record { name: value, line: index + 2, groups: Vec::new() });
            }
            Some(record) => record.groups.push((code, value)),
            None => {}
        }
    }
    Ok(records)
}

/// The unit that `$INSUNITS` names.
fn header_unit(header: &Record<'_>) -> LengthUnit {
    let mut groups = header.groups.iter();
    groups.find(|(code, value)| *code == 9 && *value == "$INSUNITS");
    match groups.next().map(|(_, value)| *value) {
        Some("1") => LengthUnit::Inch,
        Some("4") => LengthUnit::Millimetre,
        Some("5") => LengthUnit::Centimetre,
        Some("6") => LengthUnit::Metre,
        _ => LengthUnit::Unit,
    }
}

struct DxfDrawing<'a, 'b> {
    entries: Entries<'b>,
    layers: BTreeMap<&'a str, Layer>,
}

impl<'a> DxfDrawing<'a, '_> {
    fn layer(&mut self, record: &Record<'a>) -> Result<(), ImportError> {
        let Some(name) = record.text(2) else { return Ok(()) };
        let number = record.number(62)?.unwrap_or(7.0);
        let is_frozen = record.flags()? & 1 == 1;
        let layer =
            Layer { colour: colour(record, number.abs())?, is_hidden: number < 0.0 || is_frozen };
        self.layers.insert(name, layer);
        Ok(())
    }

    fn entity(&mut self, record: &Record<'a>) -> Result<(), ImportError> {
        let pieces = match record.name {
            "LINE" => vec![Piece::Line([record.point(10)?, record.point(11)?])],
            "LWPOLYLINE" => light_polyline(record)?,
            "ARC" | "CIRCLE" => circle(record)?,
            "ELLIPSE" => ellipse(record)?,
            name if UNREAD.contains(&name) => {
                self.entries.unread(source(record), format!("{name} of DXF is not read"));
                return Ok(());
            }
            "SEQEND" | "EOF" => return Ok(()),
            _ => {
                self.entries.warnings.add(WarningKind::Ignored, &source(record));
                return Ok(());
            }
        };
        self.add(record, pieces)
    }

    fn polyline(
        &mut self,
        record: &Record<'a>,
        vertices: &[Record<'a>],
    ) -> Result<(), ImportError> {
        // Curve fits, meshes.
        if record.flags()? & (16 | 64) != 0 {
            self.entries.unread(source(record), "a mesh of DXF is not read".to_owned());
            return Ok(());
        }
        let mut points = Vec::with_capacity(vertices.len());
        // The control points of a spline are not on it.
        for vertex in vertices {
            if vertex.flags()? & 16 == 0 {
                points.push((vertex.point(10)?, vertex.number(42)?.unwrap_or_default()));
            }
        }
        self.add(record, bulged(&points, record.flags()? & 1 == 1))
    }

    fn add(&mut self, record: &Record<'a>, pieces: Vec<Piece>) -> Result<(), ImportError> {
        let name = record.text(8).unwrap_or("0");
        let layer = self.layers.get(name);
        if layer.is_some_and(|layer| layer.is_hidden) || record.text(60) == Some("1") {
            self.entries.warnings.add(WarningKind::NotDrawn, &source(record));
            return Ok(());
        }
        let own = match record.number(62)? {
            Some(BY_LAYER | 0.0) | None if record.text(420).is_none() => None,
            number => colour(record, number.unwrap_or(BY_LAYER))?,
        };
        let by_layer = layer.and_then(|layer| layer.colour);
        let known = named_meaning(name).or(own).or(by_layer);
        let meaning = known.unwrap_or(Meaning::Exact(Role::Border));
        let shown = match (named_meaning(name), record.text(62)) {
            (None, Some(number)) => format!("colour {number}"),
            _ => format!("layer {name:?}"),
        };
        let mut names = Names::default();
        names.add_class(name);
        if let Some(handle) = record.text(5) {
            names.add_id(handle);
        }
        // An extrusion downwards mirrors what is not a line.
        let is_mirrored = record.name != "LINE" && record.number(230)?.is_some_and(|z| z < 0.0);
        let mirror = glam::DAffine2::from_scale(DVec2::new(-1.0, 1.0));
        let placed = |piece: Piece| if is_mirrored { piece.transformed(&mirror) } else { piece };
        let pieces = pieces.into_iter().map(placed).collect();
        self.entries.add(source(record), names, (meaning, &shown), pieces);
        Ok(())
    }

    /// Without a border, cuts are: those inside the sheet stay cuts.
    fn cuts_around_are_border(&mut self) {
        let strokes = &mut self.entries.strokes;
        if !strokes.iter().any(|stroke| stroke.role == Role::Border) {
            for stroke in strokes.iter_mut().filter(|stroke| stroke.role == Role::Cut) {
                stroke.role = Role::Border;
            }
        }
    }
}

fn source(record: &Record<'_>) -> Source {
    let layer = record.text(8).unwrap_or("0");
    Source::entry(&format!("{} on layer {layer:?}", record.name), record.line)
}

/// The meaning of a colour: the true colour of a record, or AutoCAD's number.
fn colour(record: &Record<'_>, index: f64) -> Result<Option<Meaning>, ImportError> {
    if let Some(true_colour) = record.number(420)? {
        let [.., red, green, blue] = (true_colour as i64).to_be_bytes();
        return Ok(Some(meaning([red, green, blue])));
    }
    let number = u8::try_from(index as i64).ok().filter(|number| *number > 0);
    Ok(number.map(|number| meaning(indexed_colour(number))))
}

/// AutoCAD's colour of a number: nine by name, then 24 hues in five shades, full and half saturated, then greys.
fn indexed_colour(index: u8) -> [u8; 3] {
    const SHADES: [f64; 5] = [255.0, 165.0, 127.0, 76.0, 38.0];
    match index {
        1 => [255, 0, 0],
        2 => [255, 255, 0],
        3 => [0, 255, 0],
        4 => [0, 255, 255],
        5 => [0, 0, 255],
        6 => [255, 0, 255],
        // Black on white, white on black.
        0 | 7 => [0, 0, 0],
        8 | 9 | 250.. => [128; 3],
        _ => {
            let hue = f64::from(index / 10 - 1) * 15.0;
            let brightest = SHADES[usize::from(index % 10) / 2];
            let least = if index.is_multiple_of(2) { 0.0 } else { 0.5 };
            let channel = |centre: f64| {
                let away = (hue - centre + 180.0).rem_euclid(360.0) - 180.0;
                let share = (2.0 - away.abs() / 60.0).clamp(0.0, 1.0);
                brightest * (least + (1.0 - least) * share)
            };
            #[expect(clippy::cast_sign_loss, reason = "a channel lies between 0 and 255")]
            [0.0, 120.0, 240.0].map(|centre| channel(centre) as u8)
        }
    }
}

fn circle(record: &Record<'_>) -> Result<Vec<Piece>, ImportError> {
    let radius = record.number(40)?.unwrap_or_default();
    let [start, end] = match record.name {
        "ARC" => [record.number(50)?, record.number(51)?]
            .map(|angle| angle.unwrap_or_default().to_radians()),
        _ => [0.0, TAU],
    };
    if radius <= 0.0 {
        return Ok(Vec::new());
    }
    let axes = [DVec2::X * radius, DVec2::Y * radius];
    Ok(arc(record.point(10)?, axes, start, sweep(start, end)))
}

fn ellipse(record: &Record<'_>) -> Result<Vec<Piece>, ImportError> {
    let major = record.point(11)?;
    let ratio = record.number(40)?.unwrap_or(1.0);
    let start = record.number(41)?.unwrap_or_default();
    let end = record.number(42)?.unwrap_or(TAU);
    Ok(arc(record.point(10)?, [major, major.perp() * ratio], start, sweep(start, end)))
}

/// The angle from start to end counter-clockwise: a whole turn if they are the same.
fn sweep(start: f64, end: f64) -> f64 {
    let sweep = (end - start).rem_euclid(TAU);
    // The angles of a whole turn may come with rounding.
    if sweep < 1e-9 || TAU - sweep < 1e-9 { TAU } else { sweep }
}

fn light_polyline(record: &Record<'_>) -> Result<Vec<Piece>, ImportError> {
    let mut points: Vec<(DVec2, f64)> = Vec::new();
    for (code, value) in &record.groups {
        match (code, points.last_mut()) {
            (10, _) => points.push((DVec2::new(record.parsed(value)?, 0.0), 0.0)),
            (20, Some((point, _))) => point.y = record.parsed(value)?,
            (42, Some((_, bulge))) => *bulge = record.parsed(value)?,
            _ => {}
        }
    }
    Ok(bulged(&points, record.flags()? & 1 == 1))
}

/// Pieces from point to point; a bulge is the tangent of a quarter of the angle of the arc to the next point.
fn bulged(points: &[(DVec2, f64)], is_closed: bool) -> Vec<Piece> {
    let next = points.iter().cycle().skip(1);
    let count = if is_closed { points.len() } else { points.len().saturating_sub(1) };
    let pairs = points.iter().zip(next).take(count);
    pairs.flat_map(|((from, bulge), (to, _))| bulge_arc(*from, *to, *bulge)).collect()
}

fn bulge_arc(from: DVec2, to: DVec2, bulge: f64) -> Vec<Piece> {
    if bulge == 0.0 || from == to {
        return vec![Piece::Line([from, to])];
    }
    let chord = to - from;
    let centre = from.midpoint(to) + chord.perp() * ((1.0 - bulge * bulge) / (4.0 * bulge));
    let radius = from - centre;
    let mut pieces = arc(centre, [radius, radius.perp()], 0.0, 4.0 * bulge.atan());
    if let Some(Piece::Curve(last)) = pieces.last_mut() {
        last[3] = to;
    }
    pieces
}
