//! Airfoil sections as the UIUC Airfoil Coordinates Database holds them.
//!
//! *Selig's order*: a line with the name, then x and z a line, from the trailing edge over the upper side to the nose and back
//! along the lower side. *Lednicer's order*: the name, then the numbers of points of both sides, then the upper and the
//! lower side, each from the nose to the trailing edge. Both become Selig's order, closed at the trailing edge; an
//! open trailing edge is closed at its middle, as long as it is below [`WIDEST_TRAILING_EDGE`] of the chord.

use glam::DVec2;

use super::{Outline, OutlineError, number};

/// Gap of a trailing edge, over the chord.
const WIDEST_TRAILING_EDGE: f64 = 0.02;

pub(super) fn parse(text: &str) -> Result<Outline, OutlineError> {
    let mut rows: Vec<(usize, DVec2)> = Vec::new();
    // The first line is the name, even if it reads as numbers ("0012 64"), unless it is a coordinate pair itself.
    for (index, line) in text.lines().enumerate() {
        let line = line.trim();
        let values: Vec<_> = line.split_whitespace().collect();
        if values.is_empty() {
            continue;
        }
        let is_name = index == 0
            && !matches!(values[..], [x, z] if x.contains('.') && z.contains('.')
                && number(x, 1).is_ok() && number(z, 1).is_ok());
        if is_name {
            continue;
        }
        let [x, z] = values[..] else {
            return Err(OutlineError::NotAPoint { line: index + 1, count: values.len() });
        };
        let point = DVec2::new(number(x, index + 1)?, number(z, index + 1)?);
        rows.push((index + 1, point));
    }
    let Some(&(line, first)) = rows.first() else {
        return Err(OutlineError::Empty {
            expected: "an airfoil has a line with its name, then x and z a line",
        });
    };
    let points: Vec<_> = rows.iter().map(|row| row.1).collect();
    // No section of unit chord has a point at (2, 2) or beyond: these are numbers of points.
    let is_lednicer = first.cmpge(DVec2::splat(2.0)).all() && first.fract() == DVec2::ZERO;
    let points = if is_lednicer { around(line, first, &points[1..])? } else { points };
    Ok(closed(points))
}

/// The points of both sides in Selig's order.
fn around(line: usize, counts: DVec2, points: &[DVec2]) -> Result<Vec<DVec2>, OutlineError> {
    let [upper, lower] = counts.to_array();
    let split = (0..=points.len()).find(|&n| n as f64 == upper);
    let Some(split) = split.filter(|&n| (points.len() - n) as f64 == lower) else {
        return Err(OutlineError::PointCounts { line, upper, lower, found: points.len() });
    };
    let (above, below) = points.split_at(split);
    let is_nose_shared = above.first() == below.first();
    let back = below.iter().skip(usize::from(is_nose_shared));
    Ok(above.iter().rev().chain(back).copied().collect())
}

/// The outline with a small gap at the trailing edge closed at its middle.
fn closed(mut points: Vec<DVec2>) -> Outline {
    let last = points.len() - 1;
    let (start, end) = (points[0], points[last]);
    let nose = points.iter().fold(start.x, |nose: f64, p| nose.min(p.x));
    let is_small = start.distance(end) <= WIDEST_TRAILING_EDGE * (start.x - nose);
    if last > 2 && start != end && is_small {
        let middle = start.midpoint(end);
        points[0] = middle;
        points[last] = middle;
    }
    Outline { points, closed: true }
}
