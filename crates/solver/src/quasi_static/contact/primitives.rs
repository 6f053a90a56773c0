//! The vertices, edges and facets that can meet.
//!
//! Candidates are found as pairs of triangles. So that no pair of primitives is met twice, every vertex and every edge
//! belongs to one triangle that has it (Curtis, Tamstorf, Manocha 2008, "Fast collision detection for deformable
//! models using representative-triangles").

use std::collections::HashSet;

use foldmotion_geometry::Aabb;
use glam::DVec3;

use super::pair::{ContactPair, PairKind};
use crate::Model;

/// Crossings shallower than this, in unit lengths, are rounding.
const ROUNDING: f64 = 1e-9;
/// Triangles in one plane overlap where they do by more than this along every axis, in unit lengths.
const OVERLAP: f64 = 1e-6;

pub(super) struct Primitives {
    faces: Vec<[u32; 3]>,
    /// Whether the sheet goes on beyond the sides 01, 12 and 20 of each triangle.
    goes_on: Vec<[bool; 3]>,
    /// The vertices that belong to each triangle.
    vertices: Vec<Vec<u32>>,
    /// The edges that belong to each triangle, with their rest lengths.
    edges: Vec<Vec<([u32; 2], f64)>>,
}

impl Primitives {
    pub(super) fn new(model: &Model) -> Self {
        let mut vertices = vec![Vec::new(); model.faces.len()];
        let mut edges = vec![Vec::new(); model.faces.len()];
        // The first triangle that has a vertex, and the triangles at each vertex.
        let mut at_vertex: Vec<Vec<u32>> = vec![Vec::new(); model.node_count()];
        for (index, face) in model.faces.iter().enumerate() {
            for &v in face {
                at_vertex[v as usize].push(index as u32);
            }
        }
        for (vertex, around) in at_vertex.iter().enumerate() {
            if let Some(&owner) = around.first() {
                vertices[owner as usize].push(vertex as u32);
            }
        }
        for bar in &model.bars {
            let [a, b] = bar.vertices;
            let has_both = |face: &&u32| model.faces[**face as usize].contains(&b);
            if let Some(&owner) = at_vertex[a as usize].iter().find(has_both) {
                edges[owner as usize].push((bar.vertices, bar.rest_length));
            }
        }
        let hinges: HashSet<[u32; 2]> =
            model.hinges.iter().map(|h| sorted([h.vertices[0], h.vertices[1]])).collect();
        let goes_on = |&[a, b, c]: &[u32; 3]| {
            [[a, b], [b, c], [c, a]].map(|side| hinges.contains(&sorted(side)))
        };
        let goes_on = model.faces.iter().map(goes_on).collect();
        Self { faces: model.faces.clone(), goes_on, vertices, edges }
    }

    /// The box of every triangle on the straight path from `positions` to `positions` + `displacement` (empty: at
    /// rest), every face moved out by `radius`.
    pub(super) fn boxes(
        &self,
        positions: &[DVec3],
        displacement: &[DVec3],
        radius: f64,
    ) -> Vec<Aabb> {
        let around = |face: &[u32; 3]| {
            let start = face.map(|v| positions[v as usize]);
            let end = face.map(|v| {
                positions[v as usize] + displacement.get(v as usize).copied().unwrap_or_default()
            });
            Aabb::around(start.into_iter().chain(end)).inflated(radius)
        };
        self.faces.iter().map(around).collect()
    }

    /// The smallest height of a triangle.
    pub(super) fn smallest_height(&self, positions: &[DVec3]) -> f64 {
        let height = |face: &[u32; 3]| {
            let [a, b, c] = face.map(|v| positions[v as usize]);
            let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
            (b - a).cross(c - a).length() / longest
        };
        self.faces.iter().map(height).fold(f64::INFINITY, f64::min)
    }

    /// Calls `visit(kind, nodes, mollifier)` for the pairs of primitives that belong to the triangles `a` and `b` and
    /// share no vertex.
    pub(super) fn visit_pairs(
        &self,
        a: u32,
        b: u32,
        mut visit: impl FnMut(PairKind, [u32; 4], f64),
    ) {
        for (own, other) in [(a, b), (b, a)] {
            let [p, q, r] = self.faces[other as usize];
            for &v in &self.vertices[own as usize] {
                if ![p, q, r].contains(&v) {
                    visit(PairKind::VertexFacet, [v, p, q, r], 0.0);
                }
            }
        }
        for &(first, length) in &self.edges[a as usize] {
            for &(second, other_length) in &self.edges[b as usize] {
                if first.iter().all(|v| !second.contains(v)) {
                    let nodes = [first[0], first[1], second[0], second[1]];
                    let mollifier = ContactPair::mollifier([length, other_length]);
                    visit(PairKind::EdgeEdge, nodes, mollifier);
                }
            }
        }
    }

    /// The pairs of triangles that have the primitives of `pair`, one each.
    pub(super) fn triangles_of(&self, pair: &ContactPair) -> Vec<[u32; 2]> {
        let [a, b, c, d] = pair.nodes;
        let (first, second): (&[u32], &[u32]) = match pair.kind {
            PairKind::VertexFacet => (&[a], &[b, c, d]),
            PairKind::EdgeEdge => (&[a, b], &[c, d]),
        };
        let with = |nodes: &[u32]| -> Vec<u32> {
            let has_all = |face: &[u32; 3]| nodes.iter().all(|node| face.contains(node));
            let faces = self.faces.iter().enumerate().filter(|(_, face)| has_all(face));
            faces.map(|(index, _)| index as u32).collect()
        };
        let (first, second) = (with(first), with(second));
        let pairs = first.iter().flat_map(|&a| second.iter().map(move |&b| [a.min(b), a.max(b)]));
        pairs.filter(|[a, b]| a != b).collect()
    }

    /// Whether the triangles lie in one plane and overlap there.
    pub(super) fn overlap(&self, faces: [u32; 2], positions: &[DVec3]) -> bool {
        overlap(faces.map(|face| self.faces[face as usize].map(|v| positions[v as usize])))
    }

    /// Whether a side of one triangle passes through the other: through its inside, or through a side beyond which the
    /// sheet goes on. For triangles that share a vertex also, whether they cross around it.
    pub(super) fn cross(&self, faces: [u32; 2], positions: &[DVec3]) -> bool {
        let [a, b] = faces;
        [[a, b], [b, a]].into_iter().any(|[own, other]| {
            let facet = self.faces[other as usize];
            let [p, q, r] = self.faces[own as usize];
            let at = |v: u32| positions[v as usize];
            let goes_on = self.goes_on[other as usize];
            [[p, q, r], [q, r, p], [r, p, q]].into_iter().any(|[from, to, opposite]| {
                let is_apart = !facet.contains(&from) && !facet.contains(&to);
                let side = [from, to].map(at);
                is_apart
                    && (pierces(side, facet.map(at), goes_on)
                        || around(opposite, facet, goes_on)
                            .is_some_and(|(facet, on)| pierces_sector(side, facet.map(at), on)))
            })
        })
    }
}

/// Whether the triangles lie in one plane, but for rounding, and overlap there: facets that do lie neither above nor
/// below each other. They do unless the normal of a side separates them (Ericson 2005, section 5.2.1).
fn overlap([first, second]: [[DVec3; 3]; 2]) -> bool {
    let [a, b, c] = first;
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let is_flat = second.iter().all(|&p| normal.dot(p - a).abs() <= ROUNDING);
    let sides = |[a, b, c]: [DVec3; 3]| [b - a, c - b, a - c];
    let depth = |side: DVec3| {
        let axis = normal.cross(side).normalize_or_zero();
        let range = |corners: [DVec3; 3]| {
            let [p, q, r] = corners.map(|corner| axis.dot(corner));
            (p.min(q).min(r), p.max(q).max(r))
        };
        let ((low, high), (other_low, other_high)) = (range(first), range(second));
        (high - other_low).min(other_high - low)
    };
    is_flat && sides(first).into_iter().chain(sides(second)).all(|side| depth(side) > OVERLAP)
}

/// The facet turned so that `vertex` comes first, with whether the sheet goes on beyond its sides; `None` if it is not
/// its vertex.
fn around(
    vertex: u32,
    [a, b, c]: [u32; 3],
    [ab, bc, ca]: [bool; 3],
) -> Option<([u32; 3], [bool; 3])> {
    let turned = [([a, b, c], [ab, bc, ca]), ([b, c, a], [bc, ca, ab]), ([c, a, b], [ca, ab, bc])];
    turned.into_iter().find(|(facet, _)| facet[0] == vertex)
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// Whether the segment passes through the triangle by more than rounding, at its inside or on a side beyond which the
/// sheet `goes_on`.
fn pierces(segment: [DVec3; 2], [a, b, c]: [DVec3; 3], goes_on: [bool; 3]) -> bool {
    let sides = [(a, b), (b, c), (c, a)];
    pierces_plane(segment, [a, b, c])
        .is_some_and(|(hit, normal)| is_inside(hit, normal, &sides, &goes_on))
}

/// Whether the segment passes through the sector of the triangle at its first corner, however far from it: what is
/// nearer to the corner on the same ray then passes through the triangle.
fn pierces_sector(segment: [DVec3; 2], [a, b, c]: [DVec3; 3], goes_on: [bool; 3]) -> bool {
    let [ab, _, ca] = goes_on;
    pierces_plane(segment, [a, b, c])
        .is_some_and(|(hit, normal)| is_inside(hit, normal, &[(a, b), (c, a)], &[ab, ca]))
}

/// Where the segment passes through the plane of the triangle by more than rounding, with the unit normal.
fn pierces_plane([p, q]: [DVec3; 2], [a, b, c]: [DVec3; 3]) -> Option<(DVec3, DVec3)> {
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let (above, below) = (normal.dot(p - a), normal.dot(q - a));
    let apart = above.abs() > ROUNDING && below.abs() > ROUNDING;
    let passes = apart && (above > 0.0) != (below > 0.0);
    passes.then(|| (p.lerp(q, above / (above - below)), normal))
}

/// Whether a point of the plane lies inside of all `sides`, those included beyond which the sheet `goes_on`.
fn is_inside(hit: DVec3, normal: DVec3, sides: &[(DVec3, DVec3)], goes_on: &[bool]) -> bool {
    sides.iter().zip(goes_on).all(|(&(from, to), &goes_on)| {
        let side = to - from;
        let inside = normal.cross(side).dot(hit - from) / side.length();
        inside > if goes_on { -ROUNDING } else { ROUNDING }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_segment_pierces_a_triangle_only_through_its_inside() {
        let v = DVec3::new;
        let triangle = [v(0.0, 0.0, 0.0), v(1.0, 0.0, 0.0), v(0.0, 1.0, 0.0)];
        let pierces = |segment| pierces(segment, triangle, [false; 3]);
        assert!(pierces([v(0.2, 0.2, 1.0), v(0.2, 0.3, -1.0)]));
        assert!(!pierces([v(0.2, 0.2, 1.0), v(0.2, 0.3, 0.1)]));
        assert!(!pierces([v(0.2, 0.2, 1.0), v(0.2, 0.3, 0.0)]));
        assert!(!pierces([v(0.8, 0.8, 1.0), v(0.8, 0.8, -1.0)]));
        assert!(!pierces([v(0.0, 0.0, 1.0), v(0.0, 0.0, -1.0)]));
    }

    #[test]
    fn a_segment_pierces_a_side_only_where_the_sheet_goes_on() {
        let v = DVec3::new;
        let triangle = [v(0.0, 0.0, 0.0), v(1.0, 0.0, 0.0), v(0.0, 1.0, 0.0)];
        let through_the_first = [v(0.4, 0.0, 1.0), v(0.6, 0.0, -1.0)];
        assert!(pierces(through_the_first, triangle, [true, false, false]));
        assert!(!pierces(through_the_first, triangle, [false, true, true]));
    }

    #[test]
    fn triangles_that_share_a_vertex_cross_where_their_sectors_do() {
        let v = DVec3::new;
        // A small triangle at the corner of a large one: no side of either meets the other's inside.
        let positions = [
            v(0.0, 0.0, 0.0),
            v(5.0, 0.0, 0.0),
            v(0.0, 5.0, 0.0),
            v(0.1, 0.2, 0.1),
            v(0.2, 0.1, -0.1),
            v(-0.1, 0.2, -0.1),
        ];
        let primitives = |second: [u32; 3]| Primitives {
            faces: vec![[0, 1, 2], second],
            goes_on: vec![[false; 3]; 2],
            vertices: vec![Vec::new(); 2],
            edges: vec![Vec::new(); 2],
        };
        assert!(primitives([3, 4, 0]).cross([0, 1], &positions));
        assert!(primitives([4, 0, 3]).cross([1, 0], &positions));
        assert!(!primitives([4, 5, 0]).cross([0, 1], &positions));
    }

    #[test]
    fn triangles_overlap_in_one_plane_only() {
        let v = DVec3::new;
        let first = [v(0.0, 0.0, 0.0), v(1.0, 0.0, 0.0), v(0.0, 1.0, 0.0)];
        let moved = |by: DVec3| first.map(|p| v(1.0 - p.x, -p.y, 0.0) + by);
        assert!(!overlap([first, moved(v(0.0, 0.0, 0.0))]), "they share a side");
        assert!(!overlap([first, moved(v(0.0, 0.3, 1e-3))]), "one lies above the other");
        assert!(overlap([first, moved(v(-0.1, 0.3, 0.0))]));
    }
}
