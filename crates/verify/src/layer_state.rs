//! What the verifier knows of the order of layers.

use std::collections::{BTreeMap, BTreeSet};

use foldmotion_check::Claims;

use crate::cluster::{Contradiction, FoundCluster};
use crate::layer::Layer;

/// What is known about the layers of the last frame.
#[derive(Debug, Default)]
pub(crate) struct LayerState {
    /// The layers of the last frame, sorted by their faces.
    pub(crate) layers: Vec<Layer>,
    pub(crate) hinges: Vec<[Option<(u32, u32)>; 3]>,
    pub(crate) clusters: Vec<FoundCluster>,
    pub(crate) claims: Claims,
    /// Layers whose order comes from a claim or an assignment, not from the motion.
    pub(crate) claimed: BTreeSet<[u32; 2]>,
    /// The contradictions between claims and known orders at the last frame.
    pub(crate) contradictions: Vec<Contradiction>,
    /// For frames that another proof may judge differently, the pair concerned and the reason.
    pub(crate) doubts: BTreeMap<usize, ([u32; 2], &'static str)>,
    pub(crate) is_proved: bool,
}

impl LayerState {
    pub(crate) fn new(hinges: Vec<[Option<(u32, u32)>; 3]>) -> Self {
        Self { hinges, ..Self::default() }
    }

    pub(crate) fn order(&self, faces: [u32; 2]) -> Option<&Layer> {
        let found = self.layers.binary_search_by(|layer| layer.faces.cmp(&faces));
        found.ok().map(|index| &self.layers[index])
    }
}
