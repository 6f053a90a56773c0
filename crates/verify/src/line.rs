//! What meets along a crease: the layers and creases on its line, sorted around it.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use foldmotion_pattern::Sheet;
use glam::DVec3;

use crate::layer::{Layer, LayerTolerances, corners};
use foldmotion_check::LayerRule;

/// Half-planes whose angles differ by less than this, in radians, are ordered by their layers.
const SAME_ANGLE: f64 = 1e-3;

/// The layers of an instant, and what lies beyond each side of each triangle.
#[derive(Debug)]
pub(crate) struct LayerStacks<'a> {
    pub(crate) sheet: &'a Sheet,
    pub(crate) positions: &'a [DVec3],
    pub(crate) scale: LayerTolerances,
    /// For each triangle the triangles it lies on, in increasing order, each with the direction along which the first
    /// lies below it.
    pub(crate) around: Vec<Vec<(u32, Option<DVec3>)>>,
    /// For each side of each triangle, from corner i to the next, its edge and the triangle beyond.
    pub(crate) hinges: &'a [[Option<(u32, u32)>; 3]],
}

/// The edge of a hinge, whether its partner is a triangle that it crosses, and the edge or triangle of the partner.
pub(crate) type JunctionKey = (u32, bool, u32);

/// A hinge, what meets it, and whether they pass through each other.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Junction {
    pub(crate) rule: LayerRule,
    /// Whether they pass through each other; `None` if an order is unknown.
    pub(crate) crosses: Option<bool>,
    /// The triangles concerned, each once, in increasing order.
    pub(crate) faces: Vec<u32>,
    pub(crate) vertices: Vec<u32>,
}

/// Two half-planes joined at a line: a hinge, or a triangle that continues across the line.
struct Chord {
    key: JunctionKey,
    faces: [u32; 2],
    /// The angles of the half-planes around the line, in radians.
    angles: [f64; 2],
    /// The part of the line that it covers: distances from the start of the line.
    reach: [f64; 2],
    vertices: Vec<u32>,
}

/// The line along a side of a triangle, with the triangle at angle 0.
struct Line {
    at: DVec3,
    along: DVec3,
    inward: DVec3,
    up: DVec3,
    length: f64,
}

/// One of the two half-planes of a chord.
#[derive(Clone, Copy)]
struct ChordEnd {
    chord: usize,
    face: u32,
    angle: f64,
    /// Ends with the same number coincide.
    group: usize,
}

impl Line {
    fn of(triangle: &[DVec3; 3], i: usize) -> Option<Self> {
        let (at, end, apex) = (triangle[i], triangle[(i + 1) % 3], triangle[(i + 2) % 3]);
        let along = (end - at).try_normalize()?;
        let up = along.cross(apex - at).try_normalize()?;
        Some(Self { at, along, inward: up.cross(along), up, length: at.distance(end) })
    }

    fn angle(&self, towards: DVec3) -> f64 {
        self.up.dot(towards).atan2(self.inward.dot(towards))
    }

    /// The direction in which a half-plane moves as its angle grows.
    fn growing(&self, angle: f64) -> DVec3 {
        self.up * angle.cos() - self.inward * angle.sin()
    }
}

impl LayerStacks<'_> {
    /// The direction along which `f` is known to lie below `g`.
    pub(crate) fn below(&self, f: u32, g: u32) -> Option<DVec3> {
        let around = &self.around[f as usize];
        let found = around.binary_search_by_key(&g, |&(face, _)| face).ok()?;
        around[found].1
    }

    /// Tests what meets along side `i` of a triangle, piece by piece.
    pub(crate) fn meet(&self, face: u32, i: usize, found: &mut BTreeMap<JunctionKey, Junction>) {
        let triangle = corners(self.sheet, self.positions, face);
        let (Some((edge, beyond)), Some(line)) =
            (self.hinges[face as usize][i], Line::of(&triangle, i))
        else {
            return;
        };
        let mut chords = vec![self.hinge(&line, edge, [face, beyond], [0.0, line.length])];
        for &(other, _) in &self.around[face as usize] {
            if let Some(chord) = self.chord(&line, other)
                && chords.iter().all(|known| known.key != chord.key)
            {
                chords.push(chord);
            }
        }
        let mut stops: Vec<f64> = chords.iter().flat_map(|c| c.reach).collect();
        stops.sort_by(f64::total_cmp);
        let stretches = stops.windows(2).filter(|w| w[1] - w[0] > self.scale.slack);
        for middle in stretches.map(|w| f64::midpoint(w[0], w[1])) {
            let is_there = |c: &&Chord| c.reach[0] < middle && middle < c.reach[1];
            let there: Vec<&Chord> = chords.iter().filter(is_there).collect();
            if there.len() > 1 {
                self.test(&line, &there, found);
            }
        }
    }

    /// The part of a triangle that meets the line: a hinge along it, or the triangle across it.
    fn chord(&self, line: &Line, face: u32) -> Option<Chord> {
        let narrow = self.scale.narrow();
        let triangle = corners(self.sheet, self.positions, face);
        let coordinates =
            triangle.map(|p| (line.along.dot(p - line.at), line.inward.dot(p - line.at)));
        let side = coordinates.map(|(_, h)| {
            let is_off = h.abs() > narrow;
            if is_off { h.signum() } else { 0.0 }
        });
        let on_line = (0..3).find(|&k| side[k] == 0.0 && side[(k + 1) % 3] == 0.0);
        let ends: Vec<f64> = if let Some(k) = on_line {
            vec![coordinates[k].0, coordinates[(k + 1) % 3].0]
        } else if side.contains(&1.0) && side.contains(&-1.0) {
            let cut = |k: usize| {
                let ((s, p), (t, q)) = (coordinates[k], coordinates[(k + 1) % 3]);
                (p.is_sign_negative() != q.is_sign_negative()).then(|| s + (t - s) * (p / (p - q)))
            };
            (0..3).filter_map(cut).collect()
        } else {
            return None;
        };
        let low = ends.iter().copied().fold(f64::INFINITY, f64::min);
        let high = ends.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let reach = [low.max(0.0), high.min(line.length)];
        if reach[1] - reach[0] <= narrow {
            return None;
        }
        if let Some(k) = on_line {
            let (edge, beyond) = self.hinges[face as usize][k]?;
            return Some(self.hinge(line, edge, [face, beyond], reach));
        }
        let [p, q, r] = triangle;
        let across = (q - p).cross(r - p).cross(line.along);
        Some(Chord {
            key: (0, true, face),
            faces: [face; 2],
            angles: [across, -across].map(|towards| line.angle(towards)),
            reach,
            vertices: self.sheet.faces[face as usize].to_vec(),
        })
    }

    fn hinge(&self, line: &Line, edge: u32, faces: [u32; 2], reach: [f64; 2]) -> Chord {
        let ends = self.sheet.edges[edge as usize].vertices;
        let angles = faces.map(|face| {
            let mut corners = self.sheet.faces[face as usize].into_iter();
            let apex = corners.find(|v| !ends.contains(v)).unwrap_or(ends[0]);
            line.angle(self.positions[apex as usize] - self.positions[ends[0] as usize])
        });
        Chord { key: (0, false, edge), faces, angles, reach, vertices: ends.to_vec() }
    }

    /// Sorts all ends around the line and joins them. The first chord is the hinge whose junctions are recorded.
    fn test(&self, line: &Line, chords: &[&Chord], found: &mut BTreeMap<JunctionKey, Junction>) {
        let ends = grouped_ends(chords);
        let sorted = self.sorted(line, &ends);
        let joins = sorted.as_ref().is_some_and(|all| is_planar(all));
        for (k, other) in chords.iter().enumerate().skip(1) {
            let crosses = if joins { Some(false) } else { self.crosses(line, &ends, k) };
            let (own, theirs) = (chords[0].key, other.key);
            let key = if theirs.1 {
                (own.2, true, theirs.2)
            } else {
                (own.2.min(theirs.2), false, own.2.max(theirs.2))
            };
            let junction = Junction {
                rule: rule_of(chords[0], other),
                crosses,
                faces: once([chords[0].faces, other.faces].concat()),
                vertices: once([&chords[0].vertices[..], &other.vertices].concat()),
            };
            let known = found.entry(key).or_insert_with(|| junction.clone());
            if known.crosses != Some(true) && junction.crosses.is_some() {
                *known = junction;
            }
        }
    }

    /// The chords of all ends, in order around the line; `None` if coincident layers have no known strict order.
    fn sorted(&self, line: &Line, ends: &[ChordEnd]) -> Option<Vec<usize>> {
        let mut ranks = vec![0; ends.len()];
        for (k, x) in ends.iter().enumerate() {
            let mut rank = ends.iter().filter(|y| y.group < x.group).count();
            let group = ends.iter().enumerate().filter(|(_, y)| y.group == x.group);
            for (_, y) in group.filter(|&(l, _)| l != k) {
                rank += usize::from(!self.is_before(line, x, y)?);
            }
            ranks[k] = rank;
        }
        let mut sorted = vec![None; ends.len()];
        for (end, &rank) in ends.iter().zip(&ranks) {
            // Two ends with the same rank: the orders form a cycle.
            if sorted[rank].replace(end.chord).is_some() {
                return None;
            }
        }
        sorted.into_iter().collect()
    }

    fn is_before(&self, line: &Line, x: &ChordEnd, y: &ChordEnd) -> Option<bool> {
        if x.group != y.group {
            return Some(x.group < y.group);
        }
        let up = self.below(x.face, y.face)?;
        Some(up.dot(line.growing(x.angle)) > 0.0)
    }

    /// Whether exactly one end of chord `k` lies between the ends of the first chord.
    fn crosses(&self, line: &Line, ends: &[ChordEnd], k: usize) -> Option<bool> {
        let of = |chord: usize| ends.iter().filter(move |end| end.chord == chord);
        let mut between = 0;
        for end in of(k) {
            let mut passed = 0;
            for own in of(0) {
                passed += u32::from(self.is_before(line, own, end)?);
            }
            between += u32::from(passed == 1);
        }
        Some(between == 1)
    }
}

/// Whether chords can be drawn without crossing: each closes before any that was open when it opened.
fn is_planar(sorted: &[usize]) -> bool {
    let mut open: Vec<usize> = Vec::new();
    for &chord in sorted {
        if open.last() == Some(&chord) {
            open.pop();
        } else if open.contains(&chord) {
            return false;
        } else {
            open.push(chord);
        }
    }
    true
}

/// The ends of all chords in the order of their angles, starting after the widest gap, with coincident ends numbered
/// alike.
fn grouped_ends(chords: &[&Chord]) -> Vec<ChordEnd> {
    let of = |(chord, c): (usize, &&Chord)| {
        let end = |k: usize| ChordEnd { chord, face: c.faces[k], angle: c.angles[k], group: 0 };
        [end(0), end(1)]
    };
    let mut ends: Vec<ChordEnd> = chords.iter().enumerate().flat_map(of).collect();
    ends.sort_by(|x, y| x.angle.total_cmp(&y.angle));
    let count = ends.len();
    let gap = |k: usize| (ends[k].angle - ends[(k + count - 1) % count].angle).rem_euclid(TAU);
    let first = (0..count).max_by(|&k, &l| gap(k).total_cmp(&gap(l)));
    let gaps: Vec<f64> = (0..count).map(gap).collect();
    let first = first.unwrap_or(0);
    let mut group = 0;
    for step in 1..count {
        let k = (first + step) % count;
        group += usize::from(gaps[k] >= SAME_ANGLE);
        ends[k].group = group;
    }
    ends
}

fn rule_of(own: &Chord, other: &Chord) -> LayerRule {
    let bend = |c: &Chord| ((c.angles[0] - c.angles[1] + PI).rem_euclid(TAU) - PI).abs();
    let is_taco = |c: &Chord| bend(c) < SAME_ANGLE;
    let is_flat = |c: &Chord| bend(c) > PI - SAME_ANGLE;
    if is_taco(own) && is_taco(other) {
        LayerRule::TacoTaco
    } else if is_flat(own) && is_flat(other) {
        LayerRule::TortillaTortilla
    } else if (is_taco(own) || is_flat(own)) && (is_taco(other) || is_flat(other)) {
        LayerRule::TacoTortilla
    } else {
        LayerRule::Bent
    }
}

fn once(mut all: Vec<u32>) -> Vec<u32> {
    all.sort_unstable();
    all.dedup();
    all
}

/// For each triangle the triangles it lies on, each with the direction along which the first lies below it.
pub(crate) fn around(faces: usize, layers: &[Layer]) -> Vec<Vec<(u32, Option<DVec3>)>> {
    let mut around = vec![Vec::new(); faces];
    for layer in layers {
        let [f, g] = layer.faces;
        around[f as usize].push((g, layer.up));
        around[g as usize].push((f, layer.up.map(|up| -up)));
    }
    for others in &mut around {
        others.sort_by_key(|&(face, _)| face);
    }
    around
}

/// For each side of each triangle, its edge and the triangle beyond.
pub(crate) fn hinges(sheet: &Sheet) -> Vec<[Option<(u32, u32)>; 3]> {
    let mut hinges = vec![[None; 3]; sheet.faces.len()];
    for (index, edge) in (0..).zip(&sheet.edges) {
        let [Some(f), Some(g)] = edge.faces else {
            continue;
        };
        for (face, beyond) in [(f, g), (g, f)] {
            let corners = sheet.faces[face as usize];
            let apex = corners.iter().position(|v| !edge.vertices.contains(v));
            if let Some(apex) = apex {
                hinges[face as usize][(apex + 1) % 3] = Some((index, beyond));
            }
        }
    }
    hinges
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nested_and_neighbouring_chords_are_planar_and_interleaved_ones_are_not() {
        for sorted in [&[0, 1, 1, 0][..], &[0, 0, 1, 1], &[2, 0, 1, 1, 0, 2]] {
            assert!(is_planar(sorted), "{sorted:?}");
        }
        for sorted in [&[0, 1, 0, 1][..], &[2, 0, 1, 2, 0, 1]] {
            assert!(!is_planar(sorted), "{sorted:?}");
        }
    }
}
