//! The lines of SVG elements.

use glam::{DAffine2, DVec2};
use roxmltree::Node;
use svgtypes::{PathParser, PathSegment, SimplePathSegment, SimplifyingPathParser};

use super::super::drawing::Role;
use super::super::{ImportError, Source};
use super::LineNumbers;
use super::values::{length, numbers, size, wrong};

/// The most chords of a curve.
const MOST_CHORDS: f64 = 1_000.0;

/// A piece of an outline.
#[derive(Debug, Clone, Copy)]
pub(super) enum Piece {
    Line([DVec2; 2]),
    /// A cubic Bézier curve by its control points.
    Curve([DVec2; 4]),
}

/// An element with a stroke that means something.
#[derive(Debug)]
pub(super) struct Stroke {
    pub(super) source: Source,
    pub(super) role: Role,
    /// The target fold angle, radians.
    pub(super) target: f64,
    pub(super) pieces: Vec<Piece>,
}

impl Piece {
    pub(super) fn points(&self) -> &[DVec2] {
        match self {
            Self::Line(points) => points,
            Self::Curve(points) => points,
        }
    }

    pub(super) fn transformed(self, transform: &DAffine2) -> Self {
        match self {
            Self::Line(points) => Self::Line(points.map(|p| transform.transform_point2(p))),
            Self::Curve(points) => Self::Curve(points.map(|p| transform.transform_point2(p))),
        }
    }

    /// Points in order on the piece, such that it strays from the chords between them by no more than `tolerance`.
    ///
    /// The second derivative of a cubic is at most 6 M, M the longer of its second differences, so that n chords stray
    /// by at most 6 M / (8 n²).
    pub(super) fn chords(&self, tolerance: f64) -> Vec<DVec2> {
        let [a, b, c, d] = match *self {
            Self::Line(ends) => return ends.to_vec(),
            Self::Curve(points) => points,
        };
        let second = (a - 2.0 * b + c).length().max((b - 2.0 * c + d).length());
        #[expect(clippy::cast_sign_loss, reason = "clamped to at least 1")]
        let count = (0.75 * second / tolerance).sqrt().ceil().clamp(1.0, MOST_CHORDS) as u32;
        let at = |i: u32| {
            let t = f64::from(i) / f64::from(count);
            let s = 1.0 - t;
            a * (s * s * s) + b * (3.0 * s * s * t) + c * (3.0 * s * t * t) + d * (t * t * t)
        };
        // The ends exactly.
        (0..=count)
            .map(|i| match i {
                0 => a,
                _ if i == count => d,
                _ => at(i),
            })
            .collect()
    }
}

/// The outline that an element draws.
pub(super) enum Outline {
    Pieces(Vec<Piece>),
    /// It cannot be read, for this reason.
    UnreadElement(String),
    /// The element is not a shape.
    None,
}

/// The outline of an element, in its own coordinates.
pub(super) fn outline(node: Node<'_, '_>, numbering: &LineNumbers) -> Result<Outline, ImportError> {
    let pieces = match node.tag_name().name() {
        "path" => return path(node, numbering),
        "line" => {
            let [x1, y1, x2, y2] = [
                length(node, numbering, "x1")?,
                length(node, numbering, "y1")?,
                length(node, numbering, "x2")?,
                length(node, numbering, "y2")?,
            ];
            chain(&[DVec2::new(x1, y1), DVec2::new(x2, y2)], false)
        }
        "rect" => return rect(node, numbering),
        "polyline" => chain(&points(node, numbering)?, false),
        "polygon" => chain(&points(node, numbering)?, true),
        name @ ("circle" | "ellipse" | "use") => {
            return Ok(Outline::UnreadElement(format!("<{name}> is not read")));
        }
        _ => return Ok(Outline::None),
    };
    Ok(Outline::Pieces(pieces))
}

fn chain(points: &[DVec2], closed: bool) -> Vec<Piece> {
    let mut pieces: Vec<Piece> = points.windows(2).map(|p| Piece::Line([p[0], p[1]])).collect();
    if let (true, [first, .., last]) = (closed, points) {
        pieces.push(Piece::Line([*last, *first]));
    }
    pieces
}

fn points(node: Node<'_, '_>, numbering: &LineNumbers) -> Result<Vec<DVec2>, ImportError> {
    let text = node.attribute("points").unwrap_or_default();
    let numbers = numbers(text).filter(|n| n.len().is_multiple_of(2));
    let need = "an even count of finite numbers is needed";
    let numbers = numbers.ok_or_else(|| wrong(node, numbering, "points", text, need))?;
    Ok(numbers.chunks(2).map(|p| DVec2::new(p[0], p[1])).collect())
}

fn rect(node: Node<'_, '_>, numbering: &LineNumbers) -> Result<Outline, ImportError> {
    if size(node, numbering, "rx")? > 0.0 || size(node, numbering, "ry")? > 0.0 {
        return Ok(Outline::UnreadElement("rounded rectangles are not read".to_owned()));
    }
    let low = DVec2::new(length(node, numbering, "x")?, length(node, numbering, "y")?);
    let sides = DVec2::new(size(node, numbering, "width")?, size(node, numbering, "height")?);
    let high = low + sides;
    let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
    Ok(Outline::Pieces(if sides.min_element() > 0.0 { chain(&corners, true) } else { Vec::new() }))
}

fn path(node: Node<'_, '_>, numbering: &LineNumbers) -> Result<Outline, ImportError> {
    let text = node.attribute("d").unwrap_or_default().trim();
    if text == "none" {
        return Ok(Outline::Pieces(Vec::new()));
    }
    let is_arc =
        |segment: &Result<PathSegment, _>| matches!(segment, Ok(PathSegment::EllipticalArc { .. }));
    if PathParser::from(text).any(|segment| is_arc(&segment)) {
        return Ok(Outline::UnreadElement("elliptical arcs (A) of paths are not read".to_owned()));
    }
    let need = "commands of SVG paths with finite numbers are needed";
    let mut pieces = Vec::new();
    let (mut start, mut at) = (DVec2::ZERO, DVec2::ZERO);
    for segment in SimplifyingPathParser::from(text) {
        let segment = segment.map_err(|_| wrong(node, numbering, "d", text, need))?;
        match segment {
            SimplePathSegment::MoveTo { x, y } => {
                (start, at) = (DVec2::new(x, y), DVec2::new(x, y));
            }
            SimplePathSegment::LineTo { x, y } => {
                pieces.push(Piece::Line([at, DVec2::new(x, y)]));
                at = DVec2::new(x, y);
            }
            SimplePathSegment::CurveTo { x1, y1, x2, y2, x, y } => {
                let [b, c, d] = [[x1, y1], [x2, y2], [x, y]].map(DVec2::from);
                pieces.push(Piece::Curve([at, b, c, d]));
                at = d;
            }
            SimplePathSegment::Quadratic { x1, y1, x, y } => {
                let [b, c] = [[x1, y1], [x, y]].map(DVec2::from);
                // The same curve as a cubic.
                pieces.push(Piece::Curve([at, at.lerp(b, 2.0 / 3.0), c.lerp(b, 2.0 / 3.0), c]));
                at = c;
            }
            SimplePathSegment::ClosePath => {
                if at != start {
                    pieces.push(Piece::Line([at, start]));
                }
                at = start;
            }
        }
    }
    Ok(Outline::Pieces(pieces))
}
