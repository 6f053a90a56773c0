//! What is reported of layers.

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A rule that the order of layers keeps.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum LayerRule {
    /// Two creases folded flat on one line are nested or apart.
    TacoTaco,
    /// A crease folded flat has no layer between its facets that runs on across it.
    TacoTortilla,
    /// Layers that run on across one line keep their order.
    TortillaTortilla,
    /// A crease that leaves the plane does not pass through a layer there, nor through another crease on its line.
    #[serde(rename = "bent crease")]
    Bent,
    /// Layers over one region have an order without a cycle.
    Transitivity,
    /// A crease folded flat has its facets on the side of its assignment.
    #[serde(rename = "faceOrders against the assignment of the crease")]
    Crease,
    /// The file's `faceOrders` say what the motion did.
    #[serde(rename = "faceOrders against the motion")]
    Claim,
}

impl LayerRule {
    /// Its name in certificates.
    pub fn name(self) -> &'static str {
        match self {
            Self::TacoTaco => "taco-taco",
            Self::TacoTortilla => "taco-tortilla",
            Self::TortillaTortilla => "tortilla-tortilla",
            Self::Bent => "bent crease",
            Self::Transitivity => "transitivity",
            Self::Crease => "faceOrders against the assignment of the crease",
            Self::Claim => "faceOrders against the motion",
        }
    }
}

impl fmt::Display for LayerRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The layers that contradict each other.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct LayerConflict {
    /// The rule they break.
    pub rule: LayerRule,
    /// All triangles concerned, two to four.
    pub faces: Vec<u32>,
}

/// How often each rule was tested in a cluster, summed over its frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct RuleCounts {
    /// Two creases folded flat on one line.
    pub taco_taco: u64,
    /// A crease folded flat and a layer across it.
    pub taco_tortilla: u64,
    /// Two layers across one line.
    pub tortilla_tortilla: u64,
    /// A crease that leaves the plane and another or a layer on its line.
    pub bent: u64,
    /// Ordered pairs shown to be on no cycle over a common region.
    pub transitivity: u64,
    /// Creases folded flat whose order agrees with their assignment.
    pub crease: u64,
}

impl RuleCounts {
    pub(crate) fn count(&mut self, rule: LayerRule) {
        match rule {
            LayerRule::TacoTaco => self.taco_taco += 1,
            LayerRule::TacoTortilla => self.taco_tortilla += 1,
            LayerRule::TortillaTortilla => self.tortilla_tortilla += 1,
            LayerRule::Bent => self.bent += 1,
            LayerRule::Transitivity => self.transitivity += 1,
            LayerRule::Crease => self.crease += 1,
            LayerRule::Claim => {}
        }
    }

    fn add(&mut self, other: &Self) {
        self.taco_taco += other.taco_taco;
        self.taco_tortilla += other.taco_tortilla;
        self.tortilla_tortilla += other.tortilla_tortilla;
        self.bent += other.bent;
        self.transitivity += other.transitivity;
        self.crease += other.crease;
    }
}

/// What is known of the order in a cluster; the worst over its frames.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum LayerProof {
    /// Every pair has an order, and all rules hold.
    Proved,
    /// No tested rule is broken, but some pair has no known order.
    Unproved,
    /// A rule is broken.
    Contradicted,
}

/// Triangles that lie on each other, directly or through others, over consecutive frames.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Cluster {
    /// The index of the first and of the last frame at which they do.
    pub frames: [usize; 2],
    /// The motion times of these two frames.
    #[serde(rename = "t")]
    pub times: [f64; 2],
    /// The triangles, by rising index.
    #[serde(rename = "triangles")]
    pub faces: Vec<u32>,
    /// The deepest stack found: at least this many layers lie over one point.
    pub layers: usize,
    /// The largest number of pairs that lie on each other at one frame.
    pub pairs: usize,
    /// Whether the order of the layers is proved.
    pub order: LayerProof,
    /// How often each rule was tested.
    #[serde(skip)]
    pub rules: RuleCounts,
}

impl Cluster {
    /// Takes in the same triangles at the next frame.
    pub(crate) fn extend(&mut self, next: &Self) {
        self.frames[1] = next.frames[1];
        self.times[1] = next.times[1];
        self.layers = self.layers.max(next.layers);
        self.pairs = self.pairs.max(next.pairs);
        self.order = self.order.max(next.order);
        self.rules.add(&next.rules);
    }
}

/// The orders that a file's `faceOrders` claim, summed over the frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
pub struct Claims {
    /// Entries with a sign of 1 or -1, inherited ones counted at each frame.
    pub claimed: usize,
    /// Those of faces that are not stacked at their frame, or have passed through each other.
    pub ignored: usize,
}
