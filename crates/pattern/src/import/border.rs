//! A border for drawings that have none.

use glam::DVec2;

use super::drawing::{Drawing, Line, Role, bounds};
use super::predicate::{from_segment, side};
use super::split::planar_graph;
use super::warning::{WarningKind, Warnings};
use super::{ImportError, Source};

/// An outline that fills this part of the box around it is that box.
const FULL: f64 = 0.999;

/// Whether a drawing has lines, but none that is border.
pub(super) fn is_missing(drawing: &Drawing) -> bool {
    let mut lines = drawing.lines.iter();
    !drawing.lines.is_empty() && lines.all(|line| line.role != Role::Border)
}

/// Adds the outline of the lines as border to a drawing without one, if some of them end nowhere.
///
/// The outline is the convex hull of the lines. A crease that would lie on it would be no crease: then the outline is
/// the box around the lines, with the sides on which creases lie moved outwards to the edge of the `page` or, without
/// one, by half of the box. Lines that close the pattern themselves need no border; those at its edge are made one.
pub(super) fn complete(
    drawing: &mut Drawing,
    tolerance: f64,
    page: Option<[DVec2; 2]>,
    warnings: &mut Warnings,
) -> Result<(), ImportError> {
    let graph = planar_graph(drawing, tolerance, &mut Warnings::default())?;
    let ends_nowhere = |line: &u32| graph.lines[*line as usize].role != Role::Cut;
    let lines_at = graph.lines_at();
    let mut ends = lines_at.iter().filter(|lines| lines.len() == 1).flatten();
    if !ends.any(ends_nowhere) {
        return Ok(());
    }
    let creases: Vec<[DVec2; 2]> =
        graph.lines.iter().map(|line| line.ends.map(|v| graph.points[v as usize])).collect();
    let Some(outline) = outline(&creases, tolerance, page) else { return Ok(()) };
    warnings.add(WarningKind::AddedBorder, &Source::Outline);
    let source = drawing.sources.len() as u32;
    drawing.sources.push(Source::Outline);
    let first = drawing.points.len() as u32;
    let count = outline.len() as u32;
    drawing.points.extend(outline);
    drawing.lines.extend((0..count).map(|corner| Line {
        ends: [first + corner, first + (corner + 1) % count],
        role: Role::Border,
        target: 0.0,
        source,
        is_curved: false,
    }));
    Ok(())
}

fn outline(creases: &[[DVec2; 2]], tolerance: f64, page: Option<[DVec2; 2]>) -> Option<Vec<DVec2>> {
    let points: Vec<DVec2> = creases.iter().flatten().copied().collect();
    let [low, high] = bounds(&points)?;
    let hull = hull(points);
    let size = high - low;
    let is_thin = size.min_element() <= tolerance;
    if !is_thin && (area(&hull) < FULL * size.x * size.y || !lies_on(creases, &hull, tolerance)) {
        return Some(hull);
    }
    let page = page.map(|[a, b]| [a.min(b), a.max(b)]);
    let longest = size.max_element();
    let mut corners = [low, high];
    for axis in 0..2 {
        let is_on = |at: f64| {
            creases.iter().any(|ends| ends.iter().all(|p| (p[axis] - at).abs() <= tolerance))
        };
        let step = if size[axis] > tolerance { size[axis] } else { longest } / 2.0;
        if is_on(low[axis]) {
            let edge = page.map(|page| page[0][axis]).filter(|edge| *edge < low[axis] - tolerance);
            corners[0][axis] = edge.unwrap_or(low[axis] - step);
        }
        if is_on(high[axis]) {
            let edge = page.map(|page| page[1][axis]).filter(|edge| *edge > high[axis] + tolerance);
            corners[1][axis] = edge.unwrap_or(high[axis] + step);
        }
    }
    let [low, high] = corners;
    Some(vec![low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)])
}

/// Whether a crease lies on a side of the outline.
fn lies_on(creases: &[[DVec2; 2]], outline: &[DVec2], tolerance: f64) -> bool {
    let next = outline.iter().cycle().skip(1);
    let mut sides = outline.iter().zip(next);
    sides.any(|(a, b)| {
        let is_on = |p: &DVec2| from_segment([*a, *b], *p).0 <= tolerance;
        creases.iter().any(|ends| ends.iter().all(is_on))
    })
}

/// The convex hull, counter-clockwise (Andrew 1979).
fn hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    let half = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for point in points {
            while let [.., a, b] = chain.as_slice()
                && side(*a, *b, point) <= 0.0
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut points.iter().copied());
    hull.extend(half(&mut points.iter().rev().copied()));
    hull
}

fn area(corners: &[DVec2]) -> f64 {
    let Some(first) = corners.first() else { return 0.0 };
    corners.windows(2).map(|pair| (pair[0] - first).perp_dot(pair[1] - first)).sum::<f64>() / 2.0
}
