//! The one polyline of an ASCII DXF drawing: an `LWPOLYLINE`, or a `POLYLINE` with its `VERTEX` entities.
//!
//! A DXF file is pairs of lines, a group code and a value (Autodesk, *DXF Reference*, section "Group codes"). Read are the codes
//! 10 and 20 (x and y, the profile's x and z), 70 (flags: 1 closed) and 42 (bulge, which must be 0).

use glam::DVec2;

use super::{Outline, OutlineError, number};

/// Flags of a `POLYLINE` that is no chain of straight segments: curve fits, splines, meshes.
const CURVED: u32 = 2 | 4 | 16 | 64;

/// A polyline under way.
#[derive(Default)]
struct Polyline {
    line: usize,
    points: Vec<DVec2>,
    closed: bool,
}

/// What the codes that come next belong to.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Entity {
    Light,
    Heavy,
    Vertex,
    Other,
}

pub(super) fn parse(text: &str) -> Result<Outline, OutlineError> {
    if text.starts_with("AutoCAD Binary DXF") {
        return Err(OutlineError::BinaryDxf);
    }
    let mut polylines: Vec<Polyline> = Vec::new();
    let mut entity = Entity::Other;
    let mut lines = text.lines().enumerate();
    while let (Some((index, code)), Some((_, value))) = (lines.next(), lines.next()) {
        let (line, value) = (index + 2, value.trim());
        let code: i32 = code.trim().parse().map_err(|_| OutlineError::GroupCode {
            line: index + 1,
            value: code.trim().chars().take(40).collect(),
        })?;
        if code == 0 {
            entity = match (value, entity) {
                ("LWPOLYLINE", _) => Entity::Light,
                ("POLYLINE", _) => Entity::Heavy,
                // Vertices belong to the polyline before them until SEQEND.
                ("VERTEX", Entity::Heavy | Entity::Vertex) => Entity::Vertex,
                _ => Entity::Other,
            };
            if matches!(entity, Entity::Light | Entity::Heavy) {
                polylines.push(Polyline {
                    line,
                    ..Polyline::default()
                });
            }
        } else if let Some(polyline) = polylines.last_mut() {
            polyline.take(entity, code, value, line)?;
        }
    }
    match polylines.len() {
        0 => Err(OutlineError::Empty {
            expected: "a drawing needs one LWPOLYLINE or POLYLINE",
        }),
        1 => Ok(polylines.remove(0).outline()),
        count => Err(OutlineError::SeveralPolylines {
            count,
            line: polylines[1].line,
        }),
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
                return Err(OutlineError::Bulge {
                    line,
                    value: value.to_owned(),
                });
            }
            (Entity::Light | Entity::Heavy, 70) => {
                let flags: u32 = value.parse().map_err(|_| OutlineError::NotANumber {
                    line,
                    value: value.chars().take(40).collect(),
                })?;
                if entity == Entity::Heavy && flags & CURVED != 0 {
                    return Err(OutlineError::CurvedPolyline { line, flags });
                }
                self.closed = flags & 1 == 1;
            }
            _ => {}
        }
        Ok(())
    }

    fn outline(self) -> Outline {
        let outline = Outline::of(self.points);
        Outline {
            closed: self.closed || outline.closed,
            ..outline
        }
    }
}
