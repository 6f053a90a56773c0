//! The lines of SVG elements.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec2;
use roxmltree::Node;

use super::super::ImportError;
use super::super::stroke::{Piece, chain};
use super::LineNumbers;
use super::path::{axis_parallel, path};
use super::values::{length, numbers, size, wrong};

/// The outline of an element, in its own coordinates; empty if it draws nothing.
pub(super) fn outline(
    node: Node<'_, '_>,
    numbering: &LineNumbers,
) -> Result<Vec<Piece>, ImportError> {
    let point = |x, y| -> Result<DVec2, ImportError> {
        Ok(DVec2::new(length(node, numbering, x)?, length(node, numbering, y)?))
    };
    match node.tag_name().name() {
        "path" => {
            let text = node.attribute("d").unwrap_or_default().trim();
            if text == "none" {
                return Ok(Vec::new());
            }
            let need = "commands of SVG paths with finite numbers are needed";
            path(text).ok_or_else(|| wrong(node, numbering, "d", text, need))
        }
        "line" => Ok(chain(&[point("x1", "y1")?, point("x2", "y2")?], false)),
        "rect" => rect(node, numbering),
        "polyline" => Ok(chain(&points(node, numbering)?, false)),
        "polygon" => Ok(chain(&points(node, numbering)?, true)),
        "circle" => {
            let radius = size(node, numbering, "r")?;
            Ok(ellipse(point("cx", "cy")?, DVec2::splat(radius)))
        }
        "ellipse" => Ok(ellipse(point("cx", "cy")?, radii(node, numbering)?)),
        _ => Ok(Vec::new()),
    }
}

/// Whether what an element fills has a closed outline.
pub(super) fn is_closed(node: Node<'_, '_>) -> bool {
    match node.tag_name().name() {
        "rect" | "polygon" | "circle" | "ellipse" => true,
        "path" => node.attribute("d").is_some_and(|d| d.contains(['z', 'Z'])),
        _ => false,
    }
}

fn points(node: Node<'_, '_>, numbering: &LineNumbers) -> Result<Vec<DVec2>, ImportError> {
    let text = node.attribute("points").unwrap_or_default();
    let numbers = numbers(text).filter(|n| n.len().is_multiple_of(2));
    let need = "an even count of finite numbers is needed";
    let numbers = numbers.ok_or_else(|| wrong(node, numbering, "points", text, need))?;
    Ok(numbers.chunks(2).map(|p| DVec2::new(p[0], p[1])).collect())
}

/// `rx` and `ry`; one that is omitted is as the other.
fn radii(node: Node<'_, '_>, numbering: &LineNumbers) -> Result<DVec2, ImportError> {
    let given = |name| node.attribute(name).filter(|text| text.trim() != "auto");
    let [x, y] = ["rx", "ry"];
    let [x, y] = [if given(x).is_some() { x } else { y }, if given(y).is_some() { y } else { x }];
    if given(x).is_none() {
        return Ok(DVec2::ZERO);
    }
    Ok(DVec2::new(size(node, numbering, x)?, size(node, numbering, y)?))
}

fn ellipse(centre: DVec2, radii: DVec2) -> Vec<Piece> {
    if radii.min_element() <= 0.0 {
        return Vec::new();
    }
    axis_parallel(centre, radii, 0.0, TAU)
}

fn rect(node: Node<'_, '_>, numbering: &LineNumbers) -> Result<Vec<Piece>, ImportError> {
    let low = DVec2::new(length(node, numbering, "x")?, length(node, numbering, "y")?);
    let sides = DVec2::new(size(node, numbering, "width")?, size(node, numbering, "height")?);
    let high = low + sides;
    if sides.min_element() <= 0.0 {
        return Ok(Vec::new());
    }
    let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
    let radii = radii(node, numbering)?.min(sides / 2.0);
    if radii.min_element() <= 0.0 {
        return Ok(chain(&corners, true));
    }
    let mut pieces = Vec::new();
    let mut before: Option<DVec2> = None;
    for (index, corner) in (0..4).zip(corners) {
        let centre = corner.clamp(low + radii, high - radii);
        let start = PI + FRAC_PI_2 * f64::from(index);
        let round = axis_parallel(centre, radii, start, FRAC_PI_2);
        let end = |piece: Option<&Piece>, first: bool| {
            let points = piece.map(Piece::points).unwrap_or_default();
            if first { points.first().copied() } else { points.last().copied() }
        };
        if let (Some(from), Some(to)) = (before, end(round.first(), true)) {
            pieces.push(Piece::Line([from, to]));
        }
        before = end(round.last(), false);
        pieces.extend(round);
    }
    if let (Some(from), Some(to)) = (before, pieces.first().and_then(|p| p.points().first())) {
        pieces.push(Piece::Line([from, *to]));
    }
    Ok(pieces)
}
