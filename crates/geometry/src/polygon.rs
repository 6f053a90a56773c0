//! Where a polyline crosses itself.

use std::cmp::Ordering;

use glam::DVec2;

use crate::orientation::orientation;

/// Two segments of a polyline that share a point which they should not share.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// The indices of the segments, from 0, in increasing order.
    pub segments: [usize; 2],
    /// The common point, rounded to f64.
    pub point: DVec2,
}

/// A point at which the polyline through `points` crosses or touches itself, if there is one; always the same one.
///
/// Segment k runs from point k to point k + 1. Neighbouring segments may share their common point, but not fold back
/// onto each other; the same holds for the last and the first segment of a `closed` polyline, whose last point equals
/// its first. Decided without rounding error. Boxes around runs of segments, halved repeatedly, keep the cost near n
/// log n for curves that do not fill the plane. Preconditions: no two consecutive points are equal, coordinates are
/// finite.
pub fn first_crossing(points: &[DVec2], closed: bool) -> Option<Crossing> {
    let count = points.len().saturating_sub(1);
    if count < 2 {
        return None;
    }
    let boxes = RunBoxes::new(points);
    let mut pending = vec![(1, 1)];
    while let Some((a, b)) = pending.pop() {
        if !boxes.meet(a, b) {
            continue;
        }
        match (boxes.is_leaf(a), boxes.is_leaf(b)) {
            (true, true) => {
                let (i, j) = (boxes.segment(a), boxes.segment(b));
                if let Some(point) = shared_point(points, closed, i, j) {
                    return Some(Crossing { segments: [i, j], point });
                }
            }
            // Both runs have the same depth, so both are split; a run paired with itself gives three pairs.
            _ if a == b => {
                pending.extend([(2 * a + 1, 2 * a + 1), (2 * a, 2 * a + 1), (2 * a, 2 * a)]);
            }
            _ => pending.extend([
                (2 * a + 1, 2 * b + 1),
                (2 * a + 1, 2 * b),
                (2 * a, 2 * b + 1),
                (2 * a, 2 * b),
            ]),
        }
    }
    None
}

/// Bounding boxes of runs of segments: node 1 contains all, node k splits into 2k and 2k + 1, leaves contain one
/// segment.
struct RunBoxes {
    corners: Vec<(DVec2, DVec2)>,
    first_leaf: usize,
}

impl RunBoxes {
    fn new(points: &[DVec2]) -> Self {
        let first_leaf = (points.len() - 1).next_power_of_two();
        // An empty box has its corners in the wrong order and overlaps nothing.
        let empty = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let mut corners = vec![empty; 2 * first_leaf];
        for (leaf, pair) in corners[first_leaf..].iter_mut().zip(points.windows(2)) {
            *leaf = (pair[0].min(pair[1]), pair[0].max(pair[1]));
        }
        for node in (1..first_leaf).rev() {
            let (a, b) = (corners[2 * node], corners[2 * node + 1]);
            corners[node] = (a.0.min(b.0), a.1.max(b.1));
        }
        Self { corners, first_leaf }
    }

    fn meet(&self, a: usize, b: usize) -> bool {
        let (a, b) = (self.corners[a], self.corners[b]);
        a.0.cmple(b.1).all() && b.0.cmple(a.1).all()
    }

    fn is_leaf(&self, node: usize) -> bool {
        node >= self.first_leaf
    }

    fn segment(&self, leaf: usize) -> usize {
        leaf - self.first_leaf
    }
}

/// A point that segments i ≤ j share, beyond what neighbours may share.
fn shared_point(points: &[DVec2], closed: bool, i: usize, j: usize) -> Option<DVec2> {
    let last = points.len() - 2;
    if i == j {
        None
    } else if i + 1 == j {
        folded_back(points[i], points[j], points[j + 1])
    } else if closed && i == 0 && j == last {
        folded_back(points[last], points[0], points[1])
    } else {
        meeting_point([points[i], points[i + 1]], [points[j], points[j + 1]])
    }
}

/// The nearer end of b → a and b → c, if the two overlap.
fn folded_back(a: DVec2, b: DVec2, c: DVec2) -> Option<DVec2> {
    if orientation(a, b, c) != Ordering::Equal {
        return None;
    }
    // The points are exactly collinear: the order along either axis tells the direction.
    let same_way = |p: f64, q: f64, r: f64| (p < q && r < q) || (p > q && r > q);
    let overlap = same_way(a.x, b.x, c.x) || same_way(a.y, b.y, c.y);
    let nearer = if (a - b).length_squared() < (c - b).length_squared() { a } else { c };
    overlap.then_some(nearer)
}

/// A point common to two segments.
fn meeting_point([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> Option<DVec2> {
    let sides = [orientation(a, b, c), orientation(a, b, d)];
    let other = [orientation(c, d, a), orientation(c, d, b)];
    if sides == [Ordering::Equal; 2] {
        return collinear_meeting_point([a, b], [c, d]);
    }
    let apart = |s: [Ordering; 2]| s[0] == s[1] && s[0] != Ordering::Equal;
    if apart(sides) || apart(other) {
        return None;
    }
    let (along, across) = (b - a, d - c);
    let share = (c - a).perp_dot(across) / along.perp_dot(across);
    Some(if share.is_finite() { a + along * share.clamp(0.0, 1.0) } else { a })
}

/// An end of one of two collinear segments that lies on the other.
fn collinear_meeting_point(first: [DVec2; 2], second: [DVec2; 2]) -> Option<DVec2> {
    let on = |p: DVec2, [a, b]: [DVec2; 2]| p.cmpge(a.min(b)).all() && p.cmple(a.max(b)).all();
    let inner = second.into_iter().find(|&p| on(p, first));
    inner.or_else(|| first.into_iter().find(|&p| on(p, second)))
}
