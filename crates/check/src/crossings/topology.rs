//! The vertices, edges and triangles of a sheet, and their adjacency.

use std::collections::BTreeMap;

/// The adjacency of a triangulated sheet; an edge may have any number of triangles.
#[derive(Debug)]
pub(super) struct Topology {
    pub(super) faces: Vec<[u32; 3]>,
    /// The ends of every edge, the lower index first, which defines the direction of the edge.
    pub(super) edges: Vec<[u32; 2]>,
    /// Edge i of a triangle runs from corner i to corner i + 1.
    pub(super) face_edges: Vec<[u32; 3]>,
    pub(super) edge_faces: Vec<Vec<u32>>,
    pub(super) vertex_edges: Vec<Vec<u32>>,
    pub(super) vertex_faces: Vec<Vec<u32>>,
}

impl Topology {
    /// Precondition: all corners are less than `vertices`.
    pub(super) fn new(faces: &[[u32; 3]], vertices: usize) -> Self {
        let mut topology = Self {
            faces: faces.to_vec(),
            edges: Vec::new(),
            face_edges: Vec::with_capacity(faces.len()),
            edge_faces: Vec::new(),
            vertex_edges: vec![Vec::new(); vertices],
            vertex_faces: vec![Vec::new(); vertices],
        };
        let mut known: BTreeMap<[u32; 2], u32> = BTreeMap::new();
        for (face, corners) in (0..).zip(faces) {
            let around = [0, 1, 2].map(|i| {
                let (p, q) = (corners[i], corners[(i + 1) % 3]);
                let ends = [p.min(q), p.max(q)];
                let edge = *known.entry(ends).or_insert_with(|| topology.add_edge(ends));
                topology.edge_faces[edge as usize].push(face);
                edge
            });
            topology.face_edges.push(around);
            for &v in corners {
                topology.vertex_faces[v as usize].push(face);
            }
        }
        topology
    }

    fn add_edge(&mut self, ends: [u32; 2]) -> u32 {
        let edge = self.edges.len() as u32;
        self.edges.push(ends);
        self.edge_faces.push(Vec::new());
        for v in ends {
            self.vertex_edges[v as usize].push(edge);
        }
        edge
    }

    pub(super) fn ends(&self, edge: u32) -> [u32; 2] {
        self.edges[edge as usize]
    }

    pub(super) fn corners(&self, face: u32) -> [u32; 3] {
        self.faces[face as usize]
    }

    pub(super) fn are_disjoint(&self, a: u32, b: u32) -> bool {
        let (a, b) = (self.ends(a), self.ends(b));
        !a.iter().any(|v| b.contains(v))
    }

    /// 1 if the corners of `face` run along `edge` from its lower end to its higher one, −1 if they run the other way.
    pub(super) fn direction_in(&self, edge: u32, face: u32) -> i64 {
        let corners = self.corners(face);
        let ends = self.ends(edge);
        let is_along = (0..3).any(|i| [corners[i], corners[(i + 1) % 3]] == ends);
        if is_along { 1 } else { -1 }
    }
}
