//! The one polyline of an ASCII DXF drawing: an `LWPOLYLINE`, a `POLYLINE` with its `VERTEX` entities, or a chain of
//! `LINE`s.
//!
//! A DXF file is pairs of lines, a group code and a value (Autodesk, *DXF Reference*, section "Group codes"), up to the
//! pair 0, EOF. Read are the codes 10, 20, 11 and 21 (x and y, the profile's x and z), 70 (flags: 1 closed), 90 (the
//! number of vertices of an `LWPOLYLINE`) and 42 (bulge, which must be 0). Beside a polyline other entities are left
//! out.

use glam::DVec2;

use super::chain::{Segment, chain};
use super::{Outline, OutlineError, number};

/// Flags of a `POLYLINE` that is no chain of straight segments: curve fits, splines, meshes.
const CURVED: u32 = 2 | 4 | 16 | 64;

/// Entities that may be a profile but are not read.
const REFUSED: [&str; 4] = ["ARC", "SPLINE", "ELLIPSE", "CIRCLE"];

/// A polyline in progress.
#[derive(Default)]
struct Polyline {
    line: usize,
    points: Vec<DVec2>,
    closed: bool,
    /// The number of points that it announces.
    count: Option<usize>,
}

/// The entity that the next group codes belong to.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Entity {
    Light,
    Heavy,
    Vertex,
    Line,
    Other,
}

/// The entities found in a drawing.
#[derive(Default)]
struct Drawing {
    polylines: Vec<Polyline>,
    segments: Vec<Segment>,
    /// The first entity that is not read, and where.
    refused: Option<(&'static str, usize)>,
    has_end: bool,
}

pub(super) fn parse(text: &str) -> Result<Outline, OutlineError> {
    if text.starts_with("AutoCAD Binary DXF") {
        return Err(OutlineError::BinaryDxf);
    }
    let mut drawing = Drawing::default();
    let mut entity = Entity::Other;
    let mut lines = text.lines().enumerate();
    let mut last = 0;
    while let (Some((index, code)), Some((_, value))) = (lines.next(), lines.next()) {
        let (line, value) = (index + 2, value.trim());
        last = line;
        let code: i32 = code.trim().parse().map_err(|_| OutlineError::GroupCode {
            line: index + 1,
            value: code.trim().chars().take(40).collect(),
        })?;
        if code == 0 {
            entity = drawing.begin(value, entity, line);
        } else {
            drawing.take(entity, code, value, line)?;
        }
    }
    if !drawing.has_end {
        return Err(OutlineError::CutOff { line: last });
    }
    drawing.outline()
}

impl Drawing {
    /// Begins the entity called `name` after one of another kind.
    fn begin(&mut self, name: &str, before: Entity, line: usize) -> Entity {
        match (name, before) {
            ("LWPOLYLINE" | "POLYLINE", _) => {
                self.polylines.push(Polyline { line, ..Polyline::default() });
                if name == "POLYLINE" { Entity::Heavy } else { Entity::Light }
            }
            // Vertices belong to the polyline before them until SEQEND.
            ("VERTEX", Entity::Heavy | Entity::Vertex) => Entity::Vertex,
            ("LINE", _) => {
                self.segments.push(Segment { line, ends: [DVec2::ZERO; 2] });
                Entity::Line
            }
            _ => {
                self.has_end |= name == "EOF";
                let refused = REFUSED.iter().find(|refused| **refused == name);
                if let (Some(name), None) = (refused, self.refused) {
                    self.refused = Some((name, line));
                }
                Entity::Other
            }
        }
    }

    fn take(
        &mut self,
        entity: Entity,
        code: i32,
        value: &str,
        line: usize,
    ) -> Result<(), OutlineError> {
        if entity == Entity::Line {
            if let (10 | 11 | 20 | 21, Some(segment)) = (code, self.segments.last_mut()) {
                let coordinate = number(value, line)?;
                let end = &mut segment.ends[usize::from(code % 10 == 1)];
                match code / 10 {
                    1 => end.x = coordinate,
                    _ => end.y = coordinate,
                }
            }
            return Ok(());
        }
        match self.polylines.last_mut() {
            Some(polyline) => polyline.take(entity, code, value, line),
            None => Ok(()),
        }
    }

    fn outline(mut self) -> Result<Outline, OutlineError> {
        match (self.polylines.len(), self.refused) {
            (1, _) => self.polylines.remove(0).outline(),
            (0, Some((entity, line))) => Err(OutlineError::Entity { entity, line }),
            (0, None) if !self.segments.is_empty() => chain(&self.segments).map(Outline::of),
            (0, None) => Err(OutlineError::Empty {
                expected: "a drawing needs one LWPOLYLINE or POLYLINE, or a chain of LINEs",
            }),
            (count, _) => {
                Err(OutlineError::SeveralPolylines { count, line: self.polylines[1].line })
            }
        }
    }
}

impl Polyline {
    fn take(
        &mut self,
        entity: Entity,
        code: i32,
        value: &str,
        line: usize,
    ) -> Result<(), OutlineError> {
        match (entity, code) {
            (Entity::Light | Entity::Vertex, 10) => {
                self.points.push(DVec2::new(number(value, line)?, 0.0));
            }
            (Entity::Light | Entity::Vertex, 20) => {
                let z = number(value, line)?;
                if let Some(point) = self.points.last_mut() {
                    point.y = z;
                }
            }
            (Entity::Light | Entity::Vertex, 42) if number(value, line)? != 0.0 => {
                return Err(OutlineError::Bulge { line, value: value.to_owned() });
            }
            (Entity::Light, 90) => self.count = Some(whole(value, line)? as usize),
            (Entity::Light | Entity::Heavy, 70) => {
                let flags = whole(value, line)?;
                if entity == Entity::Heavy && flags & CURVED != 0 {
                    return Err(OutlineError::CurvedPolyline { line, flags });
                }
                self.closed = flags & 1 == 1;
            }
            _ => {}
        }
        Ok(())
    }

    /// The outline; where the drawing closes it, its first point is its last too.
    fn outline(mut self) -> Result<Outline, OutlineError> {
        if let Some(announced) = self.count.filter(|&count| count != self.points.len()) {
            return Err(OutlineError::VertexCount {
                line: self.line,
                announced,
                found: self.points.len(),
            });
        }
        if let (true, Some(&first)) = (self.closed, self.points.first())
            && self.points.last() != Some(&first)
        {
            self.points.push(first);
        }
        Ok(Outline::of(self.points))
    }
}

fn whole(value: &str, line: usize) -> Result<u32, OutlineError> {
    value
        .parse()
        .map_err(|_| OutlineError::NotANumber { line, value: value.chars().take(40).collect() })
}
