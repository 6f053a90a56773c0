//! The records of a model as the shader reads them.

use glam::DVec2;

use super::super::layout::{NO_HINGE, Topology};
use crate::Model;
use crate::gather::Gather;

/// Records in the order of the buffers; nodes in the model's locality order.
#[derive(Debug)]
pub(super) struct Tables {
    pub(super) edge_vertices: Vec<[u32; 4]>,
    /// Stiffness, rest length, damper, stiffness of the hinge.
    pub(super) edge_constants: Vec<[f32; 4]>,
    /// From the first end in the pattern: to the second and to the left apex; to the right one.
    pub(super) edge_rest: Vec<[[f32; 4]; 2]>,
    /// Corners; the edges opposite to them.
    pub(super) face_records: Vec<[[u32; 4]; 2]>,
    /// The sides c and a in the pattern; the rest angles.
    pub(super) face_rest: Vec<[[f32; 4]; 2]>,
    pub(super) starts: Vec<[u32; 2]>,
    pub(super) slots: Vec<u32>,
    /// The hinge of each edge in the model, if it has one.
    pub(super) hinges: Vec<Option<u32>>,
}

impl Tables {
    pub(super) fn new(model: &Model) -> Self {
        let topology = Topology::new(model, &model.locality);
        let place = |vertex: u32| topology.places[vertex as usize];
        let mut edges: Vec<u32> = (0..model.bars.len() as u32).collect();
        edges.sort_by_cached_key(|&edge| {
            let [a, b] = model.bars[edge as usize].vertices;
            (place(a).min(place(b)), edge)
        });
        let mut rank = vec![0; edges.len()];
        for (index, &edge) in edges.iter().enumerate() {
            rank[edge as usize] = index as u32;
        }
        let mut faces: Vec<u32> = (0..model.faces.len() as u32).collect();
        faces.sort_by_cached_key(|&face| (model.faces[face as usize].map(place), face));
        let mut tables = Self {
            edge_vertices: Vec::with_capacity(edges.len()),
            edge_constants: Vec::with_capacity(edges.len()),
            edge_rest: Vec::with_capacity(edges.len()),
            face_records: Vec::with_capacity(faces.len()),
            face_rest: Vec::with_capacity(faces.len()),
            starts: Vec::new(),
            slots: Vec::new(),
            hinges: Vec::with_capacity(edges.len()),
        };
        for &edge in &edges {
            tables.push_edge(model, &topology, edge);
        }
        for &face in &faces {
            let corners = model.faces[face as usize];
            let sides = topology.face_edges[face as usize].map(|e| rank[e as usize]);
            tables.push_face(model, face, corners.map(place), sides);
        }
        tables.fill_slots(model.node_count());
        tables
    }

    fn push_edge(&mut self, model: &Model, topology: &Topology<'_>, edge: u32) {
        let vertices = topology.edge_vertices(model, edge);
        let bar = &model.bars[edge as usize];
        let index = topology.hinge_of[edge as usize];
        let hinge = model.hinges.get(index as usize);
        self.edge_vertices.push(vertices.map(|v| topology.places[v as usize]));
        let damper = 2.0 * model.material.damping_ratio * bar.stiffness.sqrt();
        self.edge_constants.push([
            bar.stiffness as f32,
            bar.rest_length as f32,
            damper as f32,
            hinge.map_or(0.0, |hinge| hinge.stiffness as f32),
        ]);
        let [start, end, left, right] = vertices.map(|v| model.pattern[v as usize]);
        self.edge_rest.push([pair(end - start, left - start), pair(right - start, DVec2::ZERO)]);
        self.hinges.push((index != NO_HINGE).then_some(index));
    }

    fn push_face(&mut self, model: &Model, face: u32, corners: [u32; 3], sides: [u32; 3]) {
        let padded = |[a, b, c]: [u32; 3]| [a, b, c, 0];
        self.face_records.push([padded(corners), padded(sides)]);
        let [a, b, c] = model.faces[face as usize].map(|v| model.pattern[v as usize]);
        let rest = model.face_angles.get(face as usize);
        let angles = rest.map_or([0.0; 3], |face| face.rest_angles.map(|angle| angle as f32));
        self.face_rest.push([pair(b - a, c - b), [angles[0], angles[1], angles[2], 0.0]]);
    }

    /// Ends first, then corners, each by node.
    fn fill_slots(&mut self, nodes: usize) {
        let ends = self.edge_vertices.iter().filter_map(|v| v.first_chunk());
        let corners = self.face_records.iter().filter_map(|[v, _]| v.first_chunk());
        let ends = Gather::new::<2>(nodes, ends);
        let corners = Gather::new::<3>(nodes, corners);
        let tables = [&ends, &corners];
        self.slots = tables
            .iter()
            .flat_map(|table| (0..nodes).flat_map(|node| table.slots(node)))
            .copied()
            .collect();
        let mut next = [0, 2 * self.edge_vertices.len() as u32];
        self.starts.push(next);
        for node in 0..nodes {
            for (next, table) in next.iter_mut().zip(tables) {
                *next += table.slots(node).len() as u32;
            }
            self.starts.push(next);
        }
    }
}

fn pair(a: DVec2, b: DVec2) -> [f32; 4] {
    [a.x as f32, a.y as f32, b.x as f32, b.y as f32]
}
