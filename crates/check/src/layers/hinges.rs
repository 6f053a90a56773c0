//! Creases and layers along a common line: whether they pass through each other there.

use std::f64::consts::{PI, TAU};

use foldmotion_pattern::Sheet;
use glam::DVec3;

use super::{FaceEdges, LayerPair, LayerRule, NARROW, front_normal};

/// Half-planes whose angles differ by less than this, in radians, are ordered by their layers instead of the angle. It
/// is far above the angle between coincident layers, τ over the size of a triangle, and far below the angles at which
/// creases rest.
const SAME_ANGLE: f64 = 1e-3;

/// What meets a hinge along its line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Partner {
    /// Another hinge on the same line, given by its edge.
    Hinge { edge: u32 },
    /// A triangle that the line crosses.
    Across { face: u32 },
}

/// A hinge and what meets it along the same line, on the side of one of its triangles.
#[derive(Debug, Clone, Copy)]
pub(super) struct Junction {
    edge: u32,
    other: Partner,
    /// The triangles of the hinge; the one that is a layer of the partner comes first.
    faces: [u32; 2],
    /// The triangles of the partner, the layer first; a crossed triangle is listed twice.
    others: [u32; 2],
    /// The index of the pair of layers at which the junction was found.
    pub(super) pair: usize,
    /// A point of the line at which the two meet.
    pub(super) point: DVec3,
}

/// A half-plane bounded by the line.
#[derive(Debug, Clone, Copy)]
struct HalfPlane {
    face: u32,
    /// The angle around the line, in radians, from the layer at which the junction was found.
    angle: f64,
}

/// The layers of a frame, with what is needed to look them up.
pub(super) struct FrameLayers<'a> {
    pub(super) sheet: &'a Sheet,
    pub(super) edges: &'a FaceEdges,
    pub(super) positions: &'a [DVec3],
    /// The pairs of layers, sorted by their faces.
    pub(super) pairs: &'a [LayerPair],
    /// τ, a length.
    pub(super) tolerance: f64,
}

/// A line in space, with the direction into a half-plane and the direction of increasing angle.
struct Line {
    at: DVec3,
    along: DVec3,
    inward: DVec3,
    /// The direction along × inward.
    up: DVec3,
    length: f64,
}

impl Line {
    fn angle(&self, towards: DVec3) -> f64 {
        self.up.dot(towards).atan2(self.inward.dot(towards))
    }
}

impl Junction {
    /// A key that is the same however the junction was found.
    pub(super) fn key(&self) -> impl Ord + use<> {
        (self.edge, self.other)
    }

    /// The triangles that meet, each once, in increasing order.
    pub(super) fn all_faces(&self) -> Vec<u32> {
        let mut faces = [self.faces, self.others].concat();
        faces.sort_unstable();
        faces.dedup();
        faces
    }

    /// The vertices of the hinge and of its partner, each once.
    pub(super) fn vertices(&self, sheet: &Sheet) -> Vec<u32> {
        let mut vertices = sheet.edges[self.edge as usize].vertices.to_vec();
        let others = match self.other {
            Partner::Hinge { edge } => sheet.edges[edge as usize].vertices.to_vec(),
            Partner::Across { face } => sheet.faces[face as usize].to_vec(),
        };
        for vertex in others {
            if !vertices.contains(&vertex) {
                vertices.push(vertex);
            }
        }
        vertices
    }
}

impl FrameLayers<'_> {
    /// The junctions along the edges of the two layers of a pair.
    pub(super) fn junctions(&self, index: usize) -> Vec<Junction> {
        let [f, g] = self.pairs[index].faces;
        let mut found = Vec::new();
        for (a, b) in [(f, g), (g, f)] {
            for i in 0..3 {
                let Some((edge, beyond)) = self.edges.hinge(self.sheet, a, i) else {
                    continue;
                };
                let Some((other, others, point)) = self.at_line(a, i, b) else {
                    continue;
                };
                let junction =
                    Junction { edge, other, faces: [a, beyond], others, pair: index, point };
                found.extend(junction.in_order());
            }
        }
        found
    }

    /// The part of triangle `b` that meets edge `i` of its layer `a`.
    fn at_line(&self, a: u32, i: usize, b: u32) -> Option<(Partner, [u32; 2], DVec3)> {
        let width = NARROW * self.tolerance;
        let line = self.line(a, i)?;
        let corners = self.corners(b);
        let height = corners.map(|p| line.inward.dot(p - line.at));
        let along = corners.map(|p| line.along.dot(p - line.at));
        let shared = |from: f64, to: f64| {
            let (low, high) = (from.min(to).max(0.0), from.max(to).min(line.length));
            (high - low > width).then(|| line.at + line.along * f64::midpoint(low, high))
        };
        let beside = (0..3).find(|&k| height[k].abs().max(height[(k + 1) % 3].abs()) <= width);
        if let Some(k) = beside {
            let point = shared(along[k], along[(k + 1) % 3])?;
            let (edge, beyond) = self.edges.hinge(self.sheet, b, k)?;
            return Some((Partner::Hinge { edge }, [b, beyond], point));
        }
        let is_across = height.iter().any(|&h| h > width) && height.iter().any(|&h| h < -width);
        if !is_across {
            return None;
        }
        let cuts = (0..3).filter_map(|k| {
            let (p, q) = (height[k], height[(k + 1) % 3]);
            let (s, t) = (along[k], along[(k + 1) % 3]);
            ((p > 0.0) != (q > 0.0)).then(|| s + (t - s) * p / (p - q))
        });
        let [mut low, mut high] = [f64::INFINITY, f64::NEG_INFINITY];
        for cut in cuts {
            (low, high) = (low.min(cut), high.max(cut));
        }
        let point = shared(low, high)?;
        Some((Partner::Across { face: b }, [b, b], point))
    }

    /// The rule that applies to a junction and whether it holds; `None` if an order it depends on is unknown.
    pub(super) fn test(&self, junction: &Junction) -> Option<(LayerRule, bool)> {
        let corners = self.sheet.faces[junction.faces[0] as usize];
        let ends = self.sheet.edges[junction.edge as usize].vertices;
        let i = (0..3).find(|&i| !ends.contains(&corners[(i + 2) % 3]))?;
        let line = self.line(junction.faces[0], i)?;
        let own = junction.faces.map(|face| self.half(&line, face, ends));
        let others = match junction.other {
            Partner::Hinge { edge } => {
                let ends = self.sheet.edges[edge as usize].vertices;
                junction.others.map(|face| self.half(&line, face, ends))
            }
            Partner::Across { face } => {
                let across = front_normal(self.sheet, face, self.positions).cross(line.along);
                [across, -across].map(|towards| HalfPlane { face, angle: line.angle(towards) })
            }
        };
        let cut = widest_gap([own[0].angle, own[1].angle, others[0].angle, others[1].angle]);
        let mut crossings = 0;
        for x in &own {
            for y in &others {
                crossings += u32::from(self.is_before(&line, x, y, cut)?);
            }
        }
        // The two pairs interleave if an odd number of the four comparisons hold, wherever the circle is cut.
        Some((rule_of(&own, &others), crossings % 2 == 0))
    }

    /// Whether half-plane `x` comes before `y` in the direction of increasing angle, starting from `cut`.
    fn is_before(&self, line: &Line, x: &HalfPlane, y: &HalfPlane, cut: f64) -> Option<bool> {
        let apart = (y.angle - x.angle + PI).rem_euclid(TAU) - PI;
        if apart.abs() >= SAME_ANGLE {
            let from_cut = |half: &HalfPlane| (half.angle - cut).rem_euclid(TAU);
            return Some(from_cut(x) < from_cut(y));
        }
        let key = [x.face.min(y.face), x.face.max(y.face)];
        let found = self.pairs.binary_search_by(|pair| pair.faces.cmp(&key)).ok()?;
        let first_is_below = self.pairs[found].up?;
        let growing = line.up * x.angle.cos() - line.inward * x.angle.sin();
        let is_below = first_is_below.dot(growing) > 0.0;
        Some(is_below == (x.face < y.face))
    }

    /// The half-plane of triangle `face` at its edge `ends`.
    fn half(&self, line: &Line, face: u32, ends: [u32; 2]) -> HalfPlane {
        let corners = self.sheet.faces[face as usize];
        let apex = corners.into_iter().find(|v| !ends.contains(v)).unwrap_or(corners[0]);
        let towards = self.positions[apex as usize] - self.positions[ends[0] as usize];
        HalfPlane { face, angle: line.angle(towards) }
    }

    /// The line through edge `i` of a triangle, with the apex inward.
    fn line(&self, face: u32, i: usize) -> Option<Line> {
        let corners = self.corners(face);
        let (at, end, apex) = (corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]);
        let along = (end - at).try_normalize()?;
        let towards = apex - at;
        let inward = (towards - along * along.dot(towards)).try_normalize()?;
        Some(Line { at, along, inward, up: along.cross(inward), length: at.distance(end) })
    }

    fn corners(&self, face: u32) -> [DVec3; 3] {
        self.sheet.faces[face as usize].map(|v| self.positions[v as usize])
    }
}

impl Junction {
    /// The junction with the smaller edge first; `None` if the hinge is its own partner.
    fn in_order(self) -> Option<Self> {
        match self.other {
            Partner::Hinge { edge } if edge == self.edge => None,
            Partner::Hinge { edge } if edge < self.edge => Some(Self {
                edge,
                other: Partner::Hinge { edge: self.edge },
                faces: self.others,
                others: self.faces,
                ..self
            }),
            _ => Some(self),
        }
    }
}

fn rule_of(own: &[HalfPlane; 2], others: &[HalfPlane; 2]) -> LayerRule {
    let bends = [own, others].map(|[p, q]| {
        let apart = ((p.angle - q.angle + PI).rem_euclid(TAU) - PI).abs();
        (apart < SAME_ANGLE, apart > PI - SAME_ANGLE)
    });
    match bends {
        [(true, _), (true, _)] => LayerRule::TacoTaco,
        [(_, true), (_, true)] => LayerRule::TortillaTortilla,
        [(true, _), (_, true)] | [(_, true), (true, _)] => LayerRule::TacoTortilla,
        _ => LayerRule::Bent,
    }
}

/// The middle of the widest gap between four angles.
fn widest_gap(mut angles: [f64; 4]) -> f64 {
    angles.sort_by(f64::total_cmp);
    let gap = |i: usize| (angles[(i + 1) % 4] - angles[i]).rem_euclid(TAU);
    let widest = (0..4).max_by(|&i, &j| gap(i).total_cmp(&gap(j))).unwrap_or(0);
    // If all four angles are equal, the gap is a full turn, which the remainder turns into 0.
    let half = 0.5 * gap(widest);
    angles[widest] + if half > 0.0 { half } else { PI }
}
