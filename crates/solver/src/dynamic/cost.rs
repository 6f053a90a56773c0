//! What a step costs, counted from its records: what measured rates are held against.

use super::State;
use super::lanes::{Quad, WIDTH};
use super::layout::{EdgeGroup, FaceGroup};
use super::passes::Mass;

/// Additions, multiplications, divisions and roots of an edge without its damper, counted in `edge_loads`: 9 for the
/// three differences, 5 + 3 for the length, 2 for the pull, 18 for the normals, 12 for sine and cosine, 34 for the
/// angle, 10 for the turn and the moment.
const EDGE_OPERATIONS: f64 = 93.0;
/// The operations of a triangle without its angle springs, counted in `face_loads`.
const FACE_OPERATIONS: f64 = 91.0;
/// The operations of a node apart from its sum, counted in `node_step`, and of each corner in it.
const NODE_OPERATIONS: f64 = 36.0;
const CORNER_OPERATIONS: f64 = 3.0;

/// The operations and bytes of one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepCost {
    /// Nodes moved.
    pub nodes: usize,
    /// Bytes read and written that do not fit into a core's own cache: all but the loads of a block.
    pub bytes: f64,
    /// Operations on f64 numbers, elements on the borders of blocks counted as often as they are evaluated; without
    /// dampers and angle springs.
    pub operations: f64,
    /// Bytes the state holds.
    pub memory: f64,
}

impl State<'_> {
    /// The cost of one undamped step of this state.
    pub fn step_cost(&self) -> StepCost {
        let nodes = self.masses.len();
        let quad = size_of::<Quad>();
        let number = size_of::<[f64; WIDTH]>();
        let (mut bytes, mut memory, mut operations) = (0, 0, 0.0);
        for block in &self.layout.blocks {
            let edges = block.edges.len() * size_of::<EdgeGroup>();
            let faces = block.faces.len() * size_of::<FaceGroup>();
            let angles = block.edges.len() * number;
            let corners = 2 * (block.corners.len() + block.corner_starts.len());
            let ends = 2 * (block.ends.len() + block.end_starts.len());
            let halo = block.halo.len();
            // Angles are read and written, targets read.
            bytes += edges + faces + 3 * angles + corners + halo * (quad + 4);
            memory += edges + faces + 3 * angles + corners + ends + halo * 4;
            memory += block.hinges.len() * 4;
            operations += EDGE_OPERATIONS * block.hinges.len() as f64
                + FACE_OPERATIONS * (block.faces.len() * WIDTH) as f64
                + NODE_OPERATIONS * block.owned as f64
                + CORNER_OPERATIONS * block.corners.len() as f64;
        }
        // Positions and velocities are read and written, forces too, masses read.
        bytes += nodes * (6 * quad + size_of::<Mass>());
        memory += nodes * (5 * quad + size_of::<Mass>() + 2 * size_of::<f64>() + 4);
        StepCost { nodes, bytes: bytes as f64, operations, memory: memory as f64 }
    }
}
