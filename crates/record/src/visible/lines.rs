//! Which parts of a line are seen.
//!
//! Points of the line are numbered by s, 0 at its start and 1 at its end. Each triangle hides one interval of the half
//! of the line that lies on a triangle beside it; a point is seen where at least one half is not hidden.

use glam::DVec2;

use super::{Scene, VisibleLine};
use crate::screen_face::ScreenFace;

/// Points nearer to a line than this lie on it, in pixels; the same holds for depths.
const ON_LINE: f64 = 1e-7;

/// Visible and hidden parts shorter than this are rounding, in pixels.
const SHORTEST: f64 = 1e-6;

/// A closed interval of s.
type Interval = [f64; 2];

/// An edge on the screen, seen as the border of the triangle `face` beside it.
struct Half {
    /// Its ends: pixels and depth.
    ends: [(DVec2, f64); 2],
    face: u32,
    /// Into the triangle; `None` if that is seen edge-on and has no inside.
    inward: Option<DVec2>,
}

/// The visible parts of `edge`; `level`: that of a triangle.
pub(super) fn seen_of(
    scene: &Scene<'_>,
    edge: u32,
    level: &impl Fn(u32) -> u32,
) -> Vec<VisibleLine> {
    let surface = scene.surface;
    let sheet = surface.paper().sheet;
    let joined = &sheet.edges[edge as usize];
    let corners = joined.vertices.map(|v| surface.points()[v as usize]);
    let ends = corners.map(|p| (p.truncate(), p.z));
    let [start, end] = ends.map(|(p, _)| p);
    let length = start.distance(end);
    if length < SHORTEST {
        return Vec::new();
    }
    let beside = || joined.faces.into_iter().flatten();
    // A triangle seen edge-on shows no half of the line where its neighbour does.
    let has_inside = |&face: &u32| !surface.face(face).is_edge_on();
    let is_edge_on = !beside().any(|face| has_inside(&face));
    let mut near = Vec::new();
    scene.grid.near(&[start.min(end), start.max(end)], &mut near);
    near.retain(|other| beside().all(|face| face != *other));
    let mut found = Vec::new();
    for (side, face) in (0..).zip(joined.faces) {
        let Some(face) = face.filter(|face| is_edge_on || has_inside(face)) else {
            continue;
        };
        let inward = has_inside(&face).then(|| {
            let apex = sheet.apex(face, joined).unwrap_or(joined.vertices[0]);
            let normal = (end - start).perp() / length;
            let apex = surface.points()[apex as usize].truncate();
            normal * (apex - start).dot(normal).signum()
        });
        let half = Half { ends, face, inward };
        let hidden = near.iter().filter_map(|&other| half.hidden_by(scene, other));
        let seen = gaps(hidden.collect(), SHORTEST / length);
        found.extend(seen.into_iter().map(|interval| (interval, side)));
    }
    let line = |(interval, seen): (Interval, [bool; 2])| {
        let faces = joined.faces.into_iter().zip(seen).filter(|pair| pair.1);
        let face = faces.filter_map(|pair| pair.0).max_by_key(|&face| level(face));
        face.map(|face| VisibleLine {
            edge,
            face,
            seen,
            level: level(face),
            ends: interval.map(|s| start + (end - start) * s),
        })
    };
    let parts = joined_parts(&found, SHORTEST / length).into_iter();
    parts.filter_map(line).collect()
}

impl Half {
    /// Where triangle `other` hides this half.
    fn hidden_by(&self, scene: &Scene<'_>, other: u32) -> Option<Interval> {
        let surface = scene.surface;
        let screen = surface.face(other);
        if screen.is_edge_on() {
            return None;
        }
        let mut interval = [0.0, 1.0];
        for side in screen.sides() {
            let [from, to] = self.ends.map(|(p, _)| side.distance(p));
            if from.abs() < ON_LINE && to.abs() < ON_LINE {
                // Along the other's side: it covers this half if both lie on the same side of the line.
                let is_covered = self.inward.is_some_and(|inward| side.n.dot(inward) > 0.0);
                if !is_covered {
                    return None;
                }
            } else {
                keep(&mut interval, from, to)?;
            }
        }
        let threshold = if self.inward.is_some() {
            surface.threshold(other, self.face)
        } else {
            surface.outline_threshold(other, self.face)
        };
        let [from, to] = self.ends.map(|(p, depth)| screen.plane(p) - depth - threshold);
        if from.abs() < ON_LINE && to.abs() < ON_LINE {
            return self.is_behind(screen, surface.face(self.face), other).then_some(interval);
        }
        keep(&mut interval, from, to)?;
        Some(interval)
    }

    /// Whether this half, whose line lies in the other triangle, goes behind it.
    fn is_behind(&self, other: &ScreenFace, own: &ScreenFace, index: u32) -> bool {
        let Some(inward) = self.inward else {
            return false;
        };
        let rise = (other.gradient() - own.gradient()).dot(inward);
        if rise.abs() < ON_LINE {
            return index < self.face;
        }
        rise > 0.0
    }
}

/// Keeps of `interval` where a value, linear from `from` at 0 to `to` at 1, is positive.
fn keep(interval: &mut Interval, from: f64, to: f64) -> Option<()> {
    match (from > 0.0, to > 0.0) {
        (true, true) => {}
        (false, false) => return None,
        (false, true) => interval[0] = interval[0].max(from / (from - to)),
        (true, false) => interval[1] = interval[1].min(from / (from - to)),
    }
    (interval[0] < interval[1]).then_some(())
}

/// The rest of 0 to 1 without `hidden`, without parts shorter than `least`.
fn gaps(mut hidden: Vec<Interval>, least: f64) -> Vec<Interval> {
    hidden.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut seen = Vec::new();
    let mut reached = 0.0;
    for [from, to] in hidden.into_iter().chain([[1.0, 1.0]]) {
        if from - reached > least {
            seen.push([reached, from]);
        }
        reached = f64::max(reached, to);
    }
    seen
}

/// The union of the parts seen, each with its side of the edge: parts and the sides they are seen on.
fn joined_parts(found: &[(Interval, usize)], least: f64) -> Vec<(Interval, [bool; 2])> {
    let mut cuts: Vec<f64> = found.iter().flat_map(|part| part.0).collect();
    cuts.sort_by(f64::total_cmp);
    cuts.dedup_by(|b, a| *b - *a <= least);
    let mut joined: Vec<(Interval, [bool; 2])> = Vec::new();
    for pair in cuts.windows(2) {
        let middle = 0.5 * (pair[0] + pair[1]);
        let holds = |part: &&(Interval, usize)| part.0[0] < middle && middle < part.0[1];
        let mut seen = [false; 2];
        for (_, side) in found.iter().filter(holds) {
            seen[*side] = true;
        }
        match joined.last_mut() {
            _ if seen == [false; 2] => {}
            Some(last) if last.0[1] == pair[0] && last.1 == seen => last.0[1] = pair[1],
            _ => joined.push(([pair[0], pair[1]], seen)),
        }
    }
    joined
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_hidden_twice_or_in_touching_parts_leaves_only_the_rest() {
        let hidden = vec![[0.5, 0.7], [0.2, 0.4], [0.6, 0.8], [0.8, 0.9]];
        assert_eq!(gaps(hidden, 1e-9), [[0.0, 0.2], [0.4, 0.5], [0.9, 1.0]]);
        assert_eq!(gaps(vec![], 1e-9), [[0.0, 1.0]]);
        assert!(gaps(vec![[0.0, 1.0]], 1e-9).is_empty());
    }

    #[test]
    fn halves_are_joined_and_say_on_which_sides_they_are_seen() {
        let (left, right) = ([true, false], [false, true]);
        let parts = [([0.0, 0.6], 0), ([0.4, 1.0], 1)];
        let expected = [([0.0, 0.4], left), ([0.4, 0.6], [true; 2]), ([0.6, 1.0], right)];
        assert_eq!(joined_parts(&parts, 1e-9), expected);
        let apart = [([0.0, 0.2], 0), ([0.5, 1.0], 0)];
        let expected = [([0.0, 0.2], left), ([0.5, 1.0], left)];
        assert_eq!(joined_parts(&apart, 1e-9), expected);
    }
}
