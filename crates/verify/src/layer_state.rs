//! What the verifier knows of the order of layers.

use std::collections::{BTreeMap, BTreeSet};

use foldmotion_check::Claims;

use crate::cluster::{Contradiction, FoundCluster};
use crate::layer::Layer;

/// What is known of layers.
#[derive(Debug, Default)]
pub(crate) struct LayerState {
    /// Those of the last frame, in order.
    pub(crate) layers: Vec<Layer>,
    pub(crate) hinges: Vec<[Option<(u32, u32)>; 3]>,
    pub(crate) clusters: Vec<FoundCluster>,
    pub(crate) claims: Claims,
    /// Layers whose order is that of a claim or of an assignment, not of the motion.
    pub(crate) claimed: BTreeSet<[u32; 2]>,
    /// What claims of the last frame contradict.
    pub(crate) contradictions: Vec<Contradiction>,
    /// Why other proofs may see a frame otherwise, and whose pair it is.
    pub(crate) doubts: BTreeMap<usize, ([u32; 2], &'static str)>,
    pub(crate) is_proved: bool,
}

impl LayerState {
    pub(crate) fn new(hinges: Vec<[Option<(u32, u32)>; 3]>) -> Self {
        Self {
            hinges,
            ..Self::default()
        }
    }

    pub(crate) fn order(&self, faces: [u32; 2]) -> Option<&Layer> {
        let found = self
            .layers
            .binary_search_by(|layer| layer.faces.cmp(&faces));
        found.ok().map(|index| &self.layers[index])
    }
}
