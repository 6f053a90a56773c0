//! The sheet cut into blocks: what a pass reads, in the order in which it reads it.
//!
//! Nodes are renumbered along Hilbert's curve and cut into equal runs. A block owns a run and holds every element that
//! acts on it, with copies of those on its border: evaluated twice, they save the wait for the neighbour. All a block
//! reads and writes in a step fits into a core's own cache; blocks do not depend on each other within a step, nor their
//! results on who works on them.

use crate::Model;
use crate::gather::Gather;

use super::lanes::WIDTH;

/// Sheets are cut into at least [`BLOCKS`] blocks, so that threads find work, unless these would own fewer nodes than
/// this: of a smaller block the border is too large a share.
const SMALL_BLOCK: usize = 1024;
const BLOCKS: usize = 16;

/// Nodes a block owns at most: its numbers are 16 bits wide, and its loads stay in the cache.
const LARGE_BLOCK: usize = 4096;

/// The mark of an edge without a hinge.
pub(super) const NO_HINGE: u32 = u32::MAX;

/// Bars with their hinges; every edge of the sheet is a bar, and a hinge where two triangles meet.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct EdgeGroup {
    /// The ends and the apexes on the left and on the right, numbered within the block; an edge of the border has its
    /// one apex twice.
    pub(super) vertices: [[u16; WIDTH]; 4],
    /// k of the bar over the number of triangles at the edge.
    pub(super) stiffness: [f64; WIDTH],
    /// k l₀ over that number.
    pub(super) tension: [f64; WIDTH],
    /// The coefficient of the damper along the bar, divided by that number.
    pub(super) damper: [f64; WIDTH],
    /// κ l₀ of the hinge; 0 without one.
    pub(super) hinge_stiffness: [f64; WIDTH],
}

/// Triangles.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct FaceGroup {
    /// The corners, numbered within the block, counter-clockwise seen from the front.
    pub(super) vertices: [[u16; WIDTH]; 3],
    /// The edge opposite to each of them, numbered within the block.
    pub(super) edges: [[u16; WIDTH]; 3],
}

/// A run of nodes with all that acts on them.
#[derive(Debug, Clone)]
pub(super) struct Block {
    /// The first node it owns, in the order of the layout.
    pub(super) first: usize,
    /// The number of nodes it owns: the first ones of its own numbering.
    pub(super) owned: usize,
    /// The others its elements touch, in the order of the layout.
    pub(super) halo: Vec<u32>,
    pub(super) edges: Vec<EdgeGroup>,
    pub(super) faces: Vec<FaceGroup>,
    /// The rest angles at the corners of the triangles; empty if they are not held.
    pub(super) rest_angles: Vec<[[f64; WIDTH]; 3]>,
    /// The hinge of each edge in the model, or [`NO_HINGE`].
    pub(super) hinges: Vec<u32>,
    /// The number of triangles at each edge.
    pub(super) triangles: Vec<[f64; WIDTH]>,
    /// The index of the first end of each owned node, and the number of ends.
    pub(super) end_starts: Vec<u16>,
    /// The ends of bars at each owned node: twice the edge, and one more at its second end.
    pub(super) ends: Vec<u16>,
    /// The index of the first corner of each owned node, and the number of corners.
    pub(super) corner_starts: Vec<u16>,
    /// The corners of triangles at each owned node: (3 group + corner) WIDTH + lane.
    pub(super) corners: Vec<u16>,
}

/// The blocks of a model.
#[derive(Debug, Clone)]
pub(super) struct Layout {
    /// The model's number of each node, in the order of the layout.
    pub(super) order: Vec<u32>,
    pub(super) blocks: Vec<Block>,
    /// Nodes every block owns; the last one may own fewer.
    pub(super) block_len: usize,
}

impl Layout {
    pub(super) fn new(model: &Model) -> Self {
        let order = model.locality.clone();
        let nodes = order.len();
        let count = nodes.div_ceil(SMALL_BLOCK).min(BLOCKS);
        let block_len = nodes.div_ceil(count.max(nodes.div_ceil(LARGE_BLOCK)).max(1));
        let topology = Topology::new(model, &order);
        let blocks = (0..nodes)
            .step_by(block_len)
            .map(|first| Block::new(model, &topology, first, block_len.min(nodes - first)))
            .collect();
        Self { order, blocks, block_len }
    }
}

/// Who meets whom, by the numbers of the model.
pub(super) struct Topology<'a> {
    pub(super) order: &'a [u32],
    /// The place of each node in the layout.
    pub(super) places: Vec<u32>,
    pub(super) faces_at: Gather,
    /// The edge opposite to each corner of each triangle.
    pub(super) face_edges: Vec<[u32; 3]>,
    /// The hinge of each edge.
    pub(super) hinge_of: Vec<u32>,
    /// The corner of a triangle that does not lie on each edge.
    pub(super) apex_of: Vec<u32>,
    /// The number of triangles at each edge, 1 or 2.
    pub(super) triangles_at: Vec<f64>,
}

impl<'a> Topology<'a> {
    pub(super) fn new(model: &Model, order: &'a [u32]) -> Self {
        let mut places = vec![0; order.len()];
        for (place, &node) in order.iter().enumerate() {
            places[node as usize] = place as u32;
        }
        let edge_between = |a: u32, b: u32| {
            let ends = model.bar_gather.slots(a as usize).iter();
            let edges = ends.map(|&slot| slot / 2);
            let mut joining = edges.filter(|&e| model.bars[e as usize].vertices.contains(&b));
            // Every side of a triangle is an edge of the sheet.
            joining.next().unwrap_or_default()
        };
        let face_edges: Vec<[u32; 3]> = model
            .faces
            .iter()
            .map(|&[a, b, c]| [edge_between(b, c), edge_between(c, a), edge_between(a, b)])
            .collect();
        let mut hinge_of = vec![NO_HINGE; model.bars.len()];
        for (index, hinge) in model.hinges.iter().enumerate() {
            hinge_of[hinge.edge as usize] = index as u32;
        }
        let mut apex_of = vec![0; model.bars.len()];
        let mut triangles_at = vec![0.0; model.bars.len()];
        for (face, edges) in model.faces.iter().zip(&face_edges) {
            for (apex, edge) in face.iter().zip(edges) {
                apex_of[*edge as usize] = *apex;
                triangles_at[*edge as usize] += 1.0;
            }
        }
        Self {
            order,
            places,
            faces_at: Gather::new(order.len(), model.faces.iter()),
            face_edges,
            hinge_of,
            apex_of,
            triangles_at,
        }
    }

    /// Ends and apexes of an edge, as the hinge has them.
    pub(super) fn edge_vertices(&self, model: &Model, edge: u32) -> [u32; 4] {
        if let Some(hinge) = model.hinges.get(self.hinge_of[edge as usize] as usize) {
            return hinge.vertices;
        }
        let [a, b] = model.bars[edge as usize].vertices;
        let apex = self.apex_of[edge as usize];
        [a, b, apex, apex]
    }
}

impl Block {
    fn new(model: &Model, topology: &Topology<'_>, first: usize, owned: usize) -> Self {
        let nodes = &topology.order[first..first + owned];
        let mut faces: Vec<u32> = nodes
            .iter()
            .flat_map(|&node| topology.faces_at.slots(node as usize))
            .map(|&slot| slot / 3)
            .collect();
        let mut edges: Vec<u32> = Vec::with_capacity(3 * faces.len());
        sort_by_place(&mut faces, |face| {
            model.faces[face as usize].map(|v| topology.places[v as usize])
        });
        for &face in &faces {
            edges.extend(topology.face_edges[face as usize]);
        }
        let vertices = |edge: u32| topology.edge_vertices(model, edge);
        sort_by_place(&mut edges, |edge| {
            model.bars[edge as usize].vertices.map(|v| topology.places[v as usize])
        });
        let mut halo: Vec<u32> = edges
            .iter()
            .flat_map(|&edge| vertices(edge))
            .map(|v| topology.places[v as usize])
            .filter(|&place| !(first..first + owned).contains(&(place as usize)))
            .collect();
        halo.sort_unstable();
        halo.dedup();
        let mut block = Self {
            first,
            owned,
            halo,
            edges: vec![EdgeGroup::default(); edges.len().div_ceil(WIDTH)],
            faces: vec![FaceGroup::default(); faces.len().div_ceil(WIDTH)],
            rest_angles: Vec::new(),
            hinges: edges.iter().map(|&edge| topology.hinge_of[edge as usize]).collect(),
            triangles: vec![[0.0; WIDTH]; edges.len().div_ceil(WIDTH)],
            end_starts: Vec::with_capacity(owned + 1),
            ends: Vec::new(),
            corner_starts: Vec::with_capacity(owned + 1),
            corners: Vec::new(),
        };
        block.fill_edges(model, topology, &edges);
        block.fill_faces(model, topology, &faces, &edges);
        block.fill_slots(edges.len(), faces.len());
        block
    }

    /// The number of a node within the block.
    fn local(&self, topology: &Topology<'_>, node: u32) -> u16 {
        let place = topology.places[node as usize];
        let own = (place as usize).wrapping_sub(self.first);
        let local = if own < self.owned {
            own
        } else {
            self.owned + self.halo.partition_point(|&other| other < place)
        };
        local as u16
    }

    fn fill_edges(&mut self, model: &Model, topology: &Topology<'_>, edges: &[u32]) {
        for (index, &edge) in edges.iter().enumerate() {
            let (group, lane) = (index / WIDTH, index % WIDTH);
            let vertices = topology.edge_vertices(model, edge);
            let bar = &model.bars[edge as usize];
            let hinge = model.hinges.get(self.hinges[index] as usize);
            let local = vertices.map(|v| self.local(topology, v));
            let record = &mut self.edges[group];
            for (column, vertex) in record.vertices.iter_mut().zip(local) {
                column[lane] = vertex;
            }
            let triangles = topology.triangles_at[edge as usize];
            let share = 1.0 / triangles;
            let damper = 2.0 * model.material.damping_ratio * bar.stiffness.sqrt();
            self.triangles[group][lane] = triangles;
            record.stiffness[lane] = share * bar.stiffness;
            record.tension[lane] = share * bar.stiffness * bar.rest_length;
            record.damper[lane] = share * damper;
            record.hinge_stiffness[lane] = hinge.map_or(0.0, |hinge| hinge.stiffness);
        }
    }

    fn fill_faces(&mut self, model: &Model, topology: &Topology<'_>, faces: &[u32], edges: &[u32]) {
        let mut by_edge: Vec<(u32, u16)> =
            edges.iter().enumerate().map(|(index, &edge)| (edge, index as u16)).collect();
        by_edge.sort_unstable();
        let index_of = |edge: u32| {
            let at = by_edge.partition_point(|&(other, _)| other < edge);
            by_edge[at].1
        };
        if !model.face_angles.is_empty() {
            self.rest_angles = vec![[[0.0; WIDTH]; 3]; self.faces.len()];
        }
        for (index, &face) in faces.iter().enumerate() {
            let (group, lane) = (index / WIDTH, index % WIDTH);
            for corner in 0..3 {
                let vertex = model.faces[face as usize][corner];
                self.faces[group].vertices[corner][lane] = self.local(topology, vertex);
                self.faces[group].edges[corner][lane] =
                    index_of(topology.face_edges[face as usize][corner]);
                if let Some(angles) = self.rest_angles.get_mut(group) {
                    angles[corner][lane] = model.face_angles[face as usize].rest_angles[corner];
                }
            }
        }
    }

    /// Lists the ends and corners at each owned node, in the order of the records.
    fn fill_slots(&mut self, edges: usize, faces: usize) {
        let ends: Vec<[u32; 2]> = (0..edges)
            .map(|edge| {
                let vertices = &self.edges[edge / WIDTH].vertices;
                [0, 1].map(|end| u32::from(vertices[end][edge % WIDTH]))
            })
            .collect();
        let corners: Vec<[u32; 3]> = (0..faces)
            .map(|face| {
                let vertices = &self.faces[face / WIDTH].vertices;
                [0, 1, 2].map(|corner| u32::from(vertices[corner][face % WIDTH]))
            })
            .collect();
        let nodes = self.owned + self.halo.len();
        let ends = Gather::new(nodes, ends.iter());
        let corners = Gather::new(nodes, corners.iter());
        let corner_slot = |slot: &u32| {
            let (face, corner) = (*slot as usize / 3, *slot as usize % 3);
            ((3 * (face / WIDTH) + corner) * WIDTH + face % WIDTH) as u16
        };
        self.end_starts.push(0);
        self.corner_starts.push(0);
        for node in 0..self.owned {
            self.ends.extend(ends.slots(node).iter().map(|&slot| slot as u16));
            self.corners.extend(corners.slots(node).iter().map(corner_slot));
            self.end_starts.push(self.ends.len() as u16);
            self.corner_starts.push(self.corners.len() as u16);
        }
    }
}

/// Sorts elements, each once, by the lowest place of a node of theirs.
fn sort_by_place<const N: usize>(elements: &mut Vec<u32>, places: impl Fn(u32) -> [u32; N]) {
    let key = |&element: &u32| (places(element).into_iter().min(), element);
    elements.sort_by_cached_key(key);
    elements.dedup();
}
