//! What the collision check reports.

use std::fmt;

use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::layers::{Claims, Cluster, LayerConflict};

/// How a motion is judged.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CollisionOptions {
    /// τ in units of h: overlaps up to this are touching. Positive, below 0.1.
    pub touch_tolerance: f64,
    /// The most steps spent on one pair in one interval before it is left undecided.
    pub budget: u32,
    /// Once more pairs than this have penetrated, the intervals after the one at hand are not judged; 0: no limit.
    pub stop_at: usize,
}

impl Default for CollisionOptions {
    fn default() -> Self {
        Self { touch_tolerance: 1e-6, budget: 1 << 16, stop_at: 4096 }
    }
}

/// The verdict on a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// No facets come within τ of each other, apart from what they share.
    Free,
    /// Some touch, none penetrate.
    Touching,
    /// Some penetrate.
    Penetrating,
    /// No penetration was found, but some pair could not be decided.
    Undecided,
}

impl Verdict {
    /// Its name in reports and certificates.
    pub fn name(self) -> &'static str {
        match self {
            Self::Free => "free",
            Self::Touching => "touching",
            Self::Penetrating => "penetrating",
            Self::Undecided => "undecided",
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// How two facets penetrate each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum PenetrationKind {
    /// A vertex is deeper than τ beyond a facet.
    #[serde(rename = "vertex through facet")]
    VertexFacet,
    /// Two edges are deeper than τ beyond each other.
    #[serde(rename = "edge through edge")]
    EdgeEdge,
    /// Facets that share an edge are folded past ±180° by an overlap of more than τ.
    #[serde(rename = "folded past a half turn")]
    FoldedThrough,
    /// Facets that share a vertex cross around it.
    #[serde(rename = "facets crossing around a shared vertex")]
    AroundVertex,
    /// Facets leave contact on the other side, without an instant found at which they are deeper than τ.
    #[serde(rename = "facets changing sides")]
    PassedThrough,
    /// A part passes through an interior edge or vertex of the sheet, beside each of the triangles there.
    #[serde(rename = "through an edge between facets")]
    ThroughEdge,
    /// The order of coincident layers contradicts itself, or what the file claims of it.
    #[serde(rename = "layers out of order")]
    LayerOrder,
}

impl PenetrationKind {
    /// Its name in reports and certificates.
    pub fn name(self) -> &'static str {
        match self {
            Self::VertexFacet => "vertex through facet",
            Self::EdgeEdge => "edge through edge",
            Self::FoldedThrough => "folded past a half turn",
            Self::AroundVertex => "facets crossing around a shared vertex",
            Self::PassedThrough => "facets changing sides",
            Self::ThroughEdge => "through an edge between facets",
            Self::LayerOrder => "layers out of order",
        }
    }
}

impl fmt::Display for PenetrationKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The first penetration of a pair of triangles; of kind [`PenetrationKind::LayerOrder`] there may be one besides.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Penetration {
    /// The motion time at which the contact begins that leads to it; the start of the interval if the pair was in
    /// contact there already.
    pub time: f64,
    /// The motion time at which the overlap passes τ.
    pub passed: f64,
    /// The index of the frame at the start of the interval.
    pub frame: usize,
    /// The triangles, the smaller index first.
    pub faces: [u32; 2],
    /// The vertices that meet: a vertex and a facet's three, two edges' four, or a hinge's four (fewer where some are
    /// shared).
    pub vertices: Vec<u32>,
    /// Where they meet as the overlap passes τ.
    pub point: DVec3,
    /// In units of h, the largest at the instants passed + 2^(k − 34) of the interval, k = 0, 1, …, and at its end: the
    /// depth for facets that share no vertex (at most τ if they
    /// passed through), otherwise the overlap from the side on which they were.
    pub depth: f64,
    /// How they meet.
    pub kind: PenetrationKind,
    /// The rule that the layers break, of kind [`PenetrationKind::LayerOrder`]: depth 0, at the time of a frame.
    pub conflict: Option<LayerConflict>,
}

/// The closest approach of facets that share no vertex.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Separation {
    /// A lower bound of the smallest distance over the whole motion, in units of h; 0 where facets meet.
    pub distance: f64,
    /// An upper bound: the distance of `points` at `time`, in units of h.
    pub attained: f64,
    /// Whether the bounds are as near to each other as promised: within the larger of τ / 100 and a ten thousandth
    /// of `attained`, and of rounding. False where the budget ended before.
    pub is_tight: bool,
    /// The motion time.
    pub time: f64,
    /// The triangles, the smaller index first.
    pub faces: [u32; 2],
    /// The closest points, one on each.
    pub points: [DVec3; 2],
}

/// A pair that could not be decided in an interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Undecided {
    /// The motion time up to which the pair is certified.
    pub time: f64,
    /// The index of the frame at the start of the interval.
    pub frame: usize,
    /// The triangles, the smaller index first.
    pub faces: [u32; 2],
}

/// Where a check ended early: nothing is said of the frames after.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Stopped {
    /// The index of the last frame judged.
    pub frame: usize,
    /// The motion time of the last frame judged.
    #[serde(rename = "t")]
    pub time: f64,
    /// More pairs of triangles than this penetrate up to that frame.
    pub stop_at: usize,
}

impl Stopped {
    /// The same in a sentence.
    pub fn line(&self) -> String {
        format!(
            "the check stopped at frame {}, t = {}: more than {} pairs penetrate up to there; nothing is said of later \
             frames",
            self.frame, self.time, self.stop_at
        )
    }
}

/// How many pairs were judged, counted once an interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct PairCounts {
    /// Triangles that share no vertex.
    pub disjoint: u64,
    /// Triangles that share one vertex.
    pub shared_vertex: u64,
    /// Triangles that share an edge, a crease or one inside a facet.
    pub shared_crease: u64,
}

impl PairCounts {
    /// All of them.
    pub fn total(&self) -> u64 {
        self.disjoint + self.shared_vertex + self.shared_crease
    }
}

/// What decided the pairs, counted once an interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct FilterCounts {
    /// The swept boxes lie apart.
    pub boxes: u64,
    /// One axis at rest separates, or the fold angle of a hinge keeps its sign.
    pub axis_at_rest: u64,
    /// Axes that turn along separate.
    pub turning_axis: u64,
    /// All axes were tried.
    pub search: u64,
}

impl FilterCounts {
    /// The share of the pairs that needed no search.
    pub fn share_without_search(&self) -> f64 {
        let quick = self.boxes + self.axis_at_rest + self.turning_axis;
        quick as f64 / (quick + self.search).max(1) as f64
    }
}

/// The verdict on a motion, with its evidence.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CollisionReport {
    /// The verdict.
    pub verdict: Verdict,
    /// τ in units of h.
    pub tolerance: f64,
    /// The penetration that is first in time.
    pub first: Option<Penetration>,
    /// The first penetration of every pair that has one, in order of time.
    pub penetrations: Vec<Penetration>,
    /// How many distinct pairs touch or were not shown to keep apart: a count from above.
    pub touching_pairs: usize,
    /// Where the check ended early; none where every frame was judged.
    pub stopped: Option<Stopped>,
    /// What could not be decided.
    pub undecided: Vec<Undecided>,
    /// The closest approach over the whole motion, between two bounds; none where all facets share vertices.
    pub min_separation: Option<Separation>,
    /// The smallest distance of facets that share no vertex at each frame, in units of h; empty where all do.
    pub separation_series: Vec<f64>,
    /// How many pairs were judged.
    pub pairs_tested: PairCounts,
    /// What decided them.
    pub decided_by: FilterCounts,
    /// Layers that lie on each other, and what is proved of their order.
    pub clusters: Vec<Cluster>,
    /// The orders that were claimed.
    pub claims: Claims,
}
