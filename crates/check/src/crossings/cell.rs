//! Two simplices of the sheet without a common vertex.

use std::cmp::Ordering;

use foldmotion_geometry::collide::{
    MovingPair, PairPose, Passage, edge_passages, sign_of_volume, vertex_passages,
};
use glam::DVec3;

use super::topology::Topology;

/// A pair of disjoint simplices that may meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Cell {
    /// The vertex may pass through the facet.
    VertexFacet { vertex: u32, face: u32 },
    /// The edges may pass through each other; the lower index first.
    Edges([u32; 2]),
    /// The vertex may pass the edge on any side of it.
    VertexEdge { vertex: u32, edge: u32 },
}

/// Cells in which something passes through something come first. Cells are compared very often.
impl Ord for Cell {
    fn cmp(&self, other: &Self) -> Ordering {
        self.key().cmp(&other.key())
    }
}

impl PartialOrd for Cell {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The positions at both ends of an interval.
#[derive(Debug, Clone, Copy)]
pub(super) struct IntervalEnds<'a>(pub(super) [&'a [DVec3]; 2]);

impl IntervalEnds<'_> {
    fn path(&self, vertex: u32) -> [DVec3; 2] {
        self.0.map(|positions| positions[vertex as usize])
    }
}

impl Cell {
    fn key(self) -> (u8, u64) {
        let (kind, first, second) = match self {
            Self::VertexFacet { vertex, face } => (0, vertex, face),
            Self::Edges([a, b]) => (1, a, b),
            Self::VertexEdge { vertex, edge } => (2, vertex, edge),
        };
        (kind, (u64::from(first) << 32) | u64::from(second))
    }

    pub(super) fn edges(a: u32, b: u32) -> Self {
        Self::Edges([a.min(b), a.max(b)])
    }

    /// The vertices of both simplices, each padded to three by repetition.
    pub(super) fn corners(self, topology: &Topology) -> [[u32; 3]; 2] {
        let edge = |edge: u32| {
            let [p, q] = topology.ends(edge);
            [p, q, q]
        };
        match self {
            Self::VertexFacet { vertex, face } => [[vertex; 3], topology.corners(face)],
            Self::Edges([a, b]) => [edge(a), edge(b)],
            Self::VertexEdge { vertex, edge: e } => [[vertex; 3], edge(e)],
        }
    }

    pub(super) fn moving(self, topology: &Topology, ends: IntervalEnds<'_>) -> MovingPair {
        let corners = self.corners(topology);
        let [start, end] = ends.0.map(|positions| {
            let [a, b] = corners.map(|c| c.map(|v| positions[v as usize]));
            PairPose { a, b, shared: 0 }
        });
        MovingPair::new(start, end)
    }

    /// The passages of the simplices through each other; `None` if rounding hides one. A vertex and an edge have none.
    pub(super) fn passages(
        self,
        topology: &Topology,
        ends: IntervalEnds<'_>,
    ) -> Option<Vec<Passage>> {
        match self {
            Self::VertexFacet { vertex, face } => {
                let facet = topology.corners(face).map(|v| ends.path(v));
                vertex_passages(ends.path(vertex), facet)
            }
            Self::Edges(edges) => {
                let [a, b] = edges.map(|edge| topology.ends(edge).map(|v| ends.path(v)));
                edge_passages(a, b)
            }
            Self::VertexEdge { .. } => Some(Vec::new()),
        }
    }

    /// The cells of a vertex with an edge that lie on the rim of this cell.
    pub(super) fn rim(self, topology: &Topology) -> impl Iterator<Item = Self> {
        let (around, crossed) = match self {
            Self::VertexFacet { vertex, face } => {
                let edges = topology.face_edges[face as usize];
                (Some(edges.map(|edge| (vertex, edge))), None)
            }
            Self::Edges([a, b]) => {
                let ([p, q], [r, s]) = (topology.ends(a), topology.ends(b));
                (None, Some([(p, b), (q, b), (r, a), (s, a)]))
            }
            Self::VertexEdge { .. } => (None, None),
        };
        let all = around.into_iter().flatten();
        all.chain(crossed.into_iter().flatten())
            .map(|(vertex, edge)| Self::VertexEdge { vertex, edge })
    }

    /// The pairs of triangles that contain the two simplices.
    pub(super) fn faces(self, topology: &Topology) -> impl Iterator<Item = [u32; 2]> {
        let around_edge = |edge: u32| topology.edge_faces[edge as usize].clone();
        let around_vertex = |vertex: u32| topology.vertex_faces[vertex as usize].clone();
        let (a, b) = match self {
            Self::VertexFacet { vertex, face } => (around_vertex(vertex), vec![face]),
            Self::Edges([a, b]) => (around_edge(a), around_edge(b)),
            Self::VertexEdge { vertex, edge } => (around_vertex(vertex), around_edge(edge)),
        };
        a.into_iter().flat_map(move |f| {
            let b = b.clone();
            b.into_iter().map(move |g| [f.min(g), f.max(g)])
        })
    }
}

/// All cells in a pair of triangles.
pub(super) fn cells_of(topology: &Topology, [f, g]: [u32; 2]) -> Vec<Cell> {
    let mut cells = Vec::with_capacity(39);
    for (f, g) in [(f, g), (g, f)] {
        let beyond = topology.corners(g);
        // The corners of a triangle thinner than the reach can pass around its own edges.
        for (i, edge) in topology.face_edges[f as usize].into_iter().enumerate() {
            let vertex = topology.corners(f)[(i + 2) % 3];
            cells.push(Cell::VertexEdge { vertex, edge });
        }
        for vertex in topology.corners(f) {
            if beyond.contains(&vertex) {
                continue;
            }
            cells.push(Cell::VertexFacet { vertex, face: g });
            let edges = topology.face_edges[g as usize];
            cells.extend(edges.map(|edge| Cell::VertexEdge { vertex, edge }));
        }
    }
    for a in topology.face_edges[f as usize] {
        for b in topology.face_edges[g as usize] {
            if topology.are_disjoint(a, b) {
                cells.push(Cell::edges(a, b));
            }
        }
    }
    cells
}

/// What one turn of `vertex` around `edge` adds to the passages of other cells. The turn is right-handed about the edge
/// from its lower end to its higher one.
///
/// The vertex passes once through each triangle at the edge, and each edge that ends at the vertex passes once through
/// `edge`.
pub(super) fn turn(topology: &Topology, vertex: u32, edge: u32) -> Vec<(Cell, i64)> {
    let faces = topology.edge_faces[edge as usize].iter();
    let through_faces =
        faces.filter(|&&face| !topology.corners(face).contains(&vertex)).map(|&face| {
            let cell = Cell::VertexFacet { vertex, face };
            (cell, topology.direction_in(edge, face))
        });
    let edges = topology.vertex_edges[vertex as usize].iter();
    let through_edge = edges.filter(|&&other| topology.are_disjoint(other, edge)).map(|&other| {
        let is_start = topology.ends(other)[0] == vertex;
        (Cell::edges(other, edge), if is_start { -1 } else { 1 })
    });
    through_faces.chain(through_edge).collect()
}

/// How the passages of the ends of an edge, and of the edge through the rim of a triangle, change the number of times
/// the edge pierces the triangle from back to front.
pub(super) fn piercing_terms(topology: &Topology, edge: u32, face: u32) -> Vec<(Cell, i64)> {
    let [a, b] = topology.ends(edge);
    let mut terms = vec![
        (Cell::VertexFacet { vertex: b, face }, 1),
        (Cell::VertexFacet { vertex: a, face }, -1),
    ];
    for rim in topology.face_edges[face as usize] {
        terms.push((Cell::edges(edge, rim), -topology.direction_in(rim, face)));
    }
    terms
}

/// How often an edge, from its lower end to its higher one, pierces a triangle from back to front: −1, 0 or 1. `None`
/// if they meet at a corner, along the rim or in one plane.
pub(super) fn piercing(
    topology: &Topology,
    edge: u32,
    face: u32,
    positions: &[DVec3],
) -> Option<i64> {
    let at = |v: u32| positions[v as usize];
    let [a, b] = topology.ends(edge).map(at);
    let [p, q, r] = topology.corners(face).map(at);
    let sides = [a, b].map(|end| sign_of_volume([p, q, r, end]));
    if sides[0] != 0 && sides[0] == sides[1] {
        return Some(0);
    }
    let around = [(p, q), (q, r), (r, p)].map(|(c, d)| sign_of_volume([a, b, c, d]));
    if around.contains(&1) && around.contains(&-1) {
        return Some(0);
    }
    if sides.contains(&0) || around.contains(&0) {
        return None;
    }
    // The volume is positive if the end is behind the triangle.
    Some(i64::from(sides[0]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use foldmotion_random::Random;

    /// Two sheets of two triangles each, without a common vertex.
    fn scene() -> Topology {
        Topology::new(&[[0, 1, 2], [1, 3, 2], [4, 5, 6], [6, 5, 7]], 8)
    }

    fn all_cells(topology: &Topology) -> Vec<Cell> {
        let mut cells: Vec<Cell> = (0..4)
            .flat_map(|f| (f + 1..4).map(move |g| [f, g]))
            .flat_map(|faces| cells_of(topology, faces))
            .collect();
        cells.sort_unstable();
        cells.dedup();
        cells
    }

    fn count(cell: Cell, topology: &Topology, frames: &[Vec<DVec3>]) -> i64 {
        let steps = frames.windows(2);
        let passages =
            steps.flat_map(|w| cell.passages(topology, IntervalEnds([&w[0], &w[1]])).unwrap());
        passages.map(|p| i64::from(p.sign)).sum()
    }

    /// The signed number of times the edge passes through the triangle that a vertex traverses.
    fn turns_around([p, m, q]: [DVec3; 3], [c, d]: [DVec3; 2]) -> i64 {
        let sides = [sign_of_volume([p, m, q, c]), sign_of_volume([p, m, q, d])];
        let around = [(p, m), (m, q), (q, p)].map(|(u, v)| sign_of_volume([c, d, u, v]));
        let is_through = sides[0] != sides[1] && around.iter().all(|&s| s == around[0]);
        if is_through { i64::from(sides[0]) } else { 0 }
    }

    /// The signed number of times that the edge from the moving vertex to its fixed end at b passes through the vertex
    /// at c while the vertex traverses the triangle p, m, q and the triangle is contracted to a point: 1 or −1 if c
    /// lies in the tetrahedron, otherwise 0.
    fn turns_of_edge(path: [DVec3; 3], b: DVec3, c: DVec3) -> i64 {
        let [p, m, q] = path;
        let whole = sign_of_volume([p, m, q, b]);
        let parts = [[c, m, q, b], [p, c, q, b], [p, m, c, b], [p, m, q, c]];
        let is_inside = parts.into_iter().all(|part| sign_of_volume(part) == whole);
        if is_inside { i64::from(whole) } else { 0 }
    }

    #[test]
    fn a_closed_path_of_a_vertex_has_the_passages_that_its_turns_around_edges_predict() {
        let topology = scene();
        let mut random = Random::new(5);
        let mut turned = 0;
        for _ in 0..400 {
            let rest: Vec<DVec3> = (0..8).map(|_| random.vector()).collect();
            let vertex = random.index(8) as u32;
            let path = [rest[vertex as usize], random.vector(), random.vector()];
            let frames: Vec<Vec<DVec3>> = [0, 1, 2, 0]
                .map(|k: usize| {
                    let mut frame = rest.clone();
                    frame[vertex as usize] = path[k];
                    frame
                })
                .to_vec();
            let mut expected = std::collections::BTreeMap::new();
            for edge in 0..topology.edges.len() as u32 {
                if topology.ends(edge).contains(&vertex) {
                    continue;
                }
                let ends = topology.ends(edge).map(|v| rest[v as usize]);
                let turns = turns_around(path, ends);
                turned += turns.abs();
                for (cell, sign) in turn(&topology, vertex, edge) {
                    *expected.entry(cell).or_insert(0) += turns * sign;
                }
            }
            for &edge in &topology.vertex_edges[vertex as usize] {
                let ends = topology.ends(edge);
                let far = if ends[0] == vertex { ends[1] } else { ends[0] };
                let sense = if ends[0] == vertex { 1 } else { -1 };
                for c in (0..8).filter(|c| !ends.contains(c)) {
                    let turns = -sense * turns_of_edge(path, rest[far as usize], rest[c as usize]);
                    turned += turns.abs();
                    for (cell, sign) in turn(&topology, c, edge) {
                        *expected.entry(cell).or_insert(0) += turns * sign;
                    }
                }
            }
            for cell in all_cells(&topology) {
                let found = count(cell, &topology, &frames);
                let told = expected.get(&cell).copied().unwrap_or(0);
                assert_eq!(found, told, "{cell:?} of {vertex}");
            }
        }
        assert!(turned > 100, "{turned}");
    }

    #[test]
    fn the_piercings_of_two_instants_differ_by_the_passages_between_them() {
        let topology = scene();
        let mut random = Random::new(6);
        let mut pierced = 0;
        for _ in 0..600 {
            let frames: Vec<Vec<DVec3>> =
                (0..2).map(|_| (0..8).map(|_| random.vector()).collect()).collect();
            for edge in 0..topology.edges.len() as u32 {
                for face in 0..4 {
                    let ends = topology.ends(edge);
                    if topology.corners(face).iter().any(|v| ends.contains(v)) {
                        continue;
                    }
                    let [before, after] =
                        [0, 1].map(|k| piercing(&topology, edge, face, &frames[k]).unwrap());
                    let terms = piercing_terms(&topology, edge, face);
                    let change: i64 = terms
                        .iter()
                        .map(|&(cell, sign)| sign * count(cell, &topology, &frames))
                        .sum();
                    assert_eq!(after - before, change, "{edge} {face}");
                    pierced += before.abs();
                }
            }
        }
        assert!(pierced > 100, "{pierced}");
    }
}
