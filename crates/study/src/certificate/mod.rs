//! The certificate: `certificate.json` and the table on the terminal.

pub(crate) mod certify;
pub(crate) mod check_file;
pub(crate) mod checked;
pub(crate) mod statement;
pub(crate) mod verify_file;

use std::fmt::Write as _;

use foldmotion_check::{Claims, Cluster, LayerProof, LayerRule, PenetrationKind, Stopped, Verdict};
use foldmotion_geometry::Number;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The format of certificates that this program writes and verifies.
///
/// Format 1, without the key `format`, was written by versions up to 0.1. Its verdict could be *touching* for a motion that
/// passes through the sheet at an interior edge, and it stated counts of work.
pub const FORMAT: u32 = 2;

/// `certificate.json`: what was proved of a motion file, and under which assumptions.
///
/// It states only what another proof can decide by itself. Counts of work (pairs tested, touching pairs, rules tested) are in
/// the report of a run and on the terminal.
///
/// Lengths are in the file's unit unless said otherwise. Frames are counted from 0 over the motion; the interval
/// between frames k and k + 1 is `[k, k + 1]`. The same file gives the same bytes on every run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "foldmotion certificate")]
pub struct Certificate {
    /// The format of the certificate: 2. Others are refused.
    pub format: u32,
    /// The version of foldmotion that made the certificate.
    pub version: String,
    /// The name of the motion file that the certificate is about.
    pub file: String,
    /// The SHA-256 of the motion file, in hexadecimal.
    pub sha256: String,
    /// The `file_title` of the motion file; null if it has none.
    pub title: Option<String>,
    /// Whether the sheet passes through itself.
    pub verdict: Verdict,
    /// The tolerance τ, in units of `unit_length`.
    pub tolerance: f64,
    /// The length in which τ and every separation and depth are stated.
    pub unit_length: f64,
    /// The assumptions under which the verdict holds.
    pub assumptions: Vec<String>,
    /// The number of frames of the motion.
    pub frames: usize,
    /// The motion times of the first and of the last frame.
    pub times: [f64; 2],
    /// The number of vertices of the sheet.
    pub vertices: usize,
    /// The number of faces in the file.
    pub faces: usize,
    /// The number of triangles into which the faces were cut.
    pub triangles: usize,
    /// Where the check ended early: everything below speaks of the frames up to there. Null if it speaks of all.
    pub stopped: Option<Stopped>,
    /// The closest approach of facets that share no vertex; null if all do.
    pub min_separation: Option<SeparationEntry>,
    /// The first penetration of every pair of triangles that has one, in order of time.
    pub penetrations: Vec<PenetrationEntry>,
    /// Pairs of triangles that could not be decided in an interval.
    pub undecided: Vec<UndecidedEntry>,
    /// The clusters of triangles that are stacked, and whether their order is proved.
    pub clusters: Vec<Cluster>,
    /// What the file's `faceOrders` claim.
    pub layer_orders: Claims,
}

/// Two triangles by their numbers here and in the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct TrianglePair {
    /// The two triangles; they have the numbers of the file if all its faces are triangles.
    pub triangles: [u32; 2],
    /// The faces of the file from which they were cut.
    pub faces: [u32; 2],
    /// Their `faces_foldmotion:facet`; null if the file names none.
    pub facets: Option<[u32; 2]>,
}

/// The closest approach.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SeparationEntry {
    /// A lower bound of the smallest distance, in units of `unit_length`; 0 if facets meet.
    pub distance: f64,
    /// An upper bound: the distance of `points` at `t`, in units of `unit_length`.
    pub attained: f64,
    /// Whether the bounds differ by at most the larger of τ/100 and a ten-thousandth of `attained`, and rounding.
    pub is_tight: bool,
    /// The motion time at which `attained` is attained.
    pub t: f64,
    /// The two triangles that come closest.
    pub pair: TrianglePair,
    /// The closest points of the two triangles.
    pub points: [[f64; 3]; 2],
}

/// The first penetration of a pair.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PenetrationEntry {
    /// The frames between which it happens; the same frame twice if the motion begins with it.
    pub frames: [usize; 2],
    /// The motion times of these two frames.
    pub interval: [f64; 2],
    /// The motion time at which the contact begins that leads to it.
    pub t: f64,
    /// The motion time at which the overlap exceeds τ.
    pub passed_t: f64,
    /// Which parts of the two triangles meet, and how.
    pub kind: PenetrationKind,
    /// The two triangles that penetrate each other.
    pub pair: TrianglePair,
    /// The vertices of the features that meet.
    pub vertices: Vec<u32>,
    /// The point at which the two triangles meet.
    pub point: [f64; 3],
    /// How deep they overlap, in units of `unit_length`; 0 for layers out of order.
    pub depth: f64,
    /// The layers whose order contradicts itself or the file's claims; null for other kinds.
    pub layers: Option<LayersEntry>,
}

/// Layers out of order.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct LayersEntry {
    /// The rule that the order of the layers breaks.
    pub rule: LayerRule,
    /// All triangles concerned, from two to four.
    pub triangles: Vec<u32>,
    /// The faces of the file from which they were cut.
    pub faces: Vec<u32>,
}

/// A pair that could not be decided.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct UndecidedEntry {
    /// The frames between which the pair is undecided.
    pub frames: [usize; 2],
    /// The motion times of these two frames.
    pub interval: [f64; 2],
    /// The motion time up to which the pair is certified.
    pub t: f64,
    /// The two triangles that could not be decided.
    pub pair: TrianglePair,
}

impl Certificate {
    /// The exit status: 1 for a penetration, 3 for undecided, otherwise 0.
    pub fn status(&self) -> u8 {
        match self.verdict {
            Verdict::Penetrating => 1,
            Verdict::Undecided => 3,
            Verdict::Free | Verdict::Touching => 0,
        }
    }

    /// The verdict with its first evidence, on one line.
    pub fn line(&self) -> String {
        let judged = self
            .stopped
            .as_ref()
            .map_or_else(String::new, |stopped| format!(", judged up to t = {:.4}", stopped.time));
        let evidence = match (self.penetrations.first(), self.undecided.first()) {
            (Some(first), _) => {
                let [a, b] = first.pair.faces;
                format!(": first at t = {:.4}, {}, faces {a} and {b}", first.t, first.kind)
            }
            (None, Some(first)) => {
                let [a, b] = first.pair.faces;
                format!(": faces {a} and {b} are certified up to t = {:.4} only", first.t)
            }
            (None, None) => String::new(),
        };
        format!("{}{judged}{evidence}", self.verdict)
    }

    /// The text of `certificate.json`.
    pub fn to_json(&self) -> String {
        // Strings, numbers and lists always serialise.
        let mut text = serde_json::to_string_pretty(self).unwrap_or_default();
        text.push('\n');
        text
    }

    /// The table for the terminal.
    pub fn table(&self) -> String {
        let mut out = String::new();
        // Writing into a string cannot fail.
        let _ = writeln!(
            out,
            "{}\n\n{}{}\nsha256 {}",
            self.line(),
            self.file,
            self.title.as_ref().map_or(String::new(), |t| format!(": {t}")),
            self.sha256
        );
        let _ = writeln!(
            out,
            "{} frames, t = {} to {}; {} vertices, {} faces, {} triangles",
            self.frames, self.times[0], self.times[1], self.vertices, self.faces, self.triangles
        );
        let _ = writeln!(
            out,
            "\nverdict: {} (tolerance {} of the unit of length {:.6}; {} pairs penetrate, {} are undecided)",
            self.verdict,
            Number(self.tolerance),
            Number(self.unit_length),
            self.penetrations.len(),
            self.undecided.len()
        );
        if let Some(stopped) = &self.stopped {
            let _ = writeln!(out, "{}", stopped.line());
        }
        if let Some(s) = &self.min_separation {
            let _ = writeln!(
                out,
                "smallest separation of facets that share no vertex: {:.4} units at t = {:.4}, faces {} and {}",
                Number(s.distance),
                s.t,
                s.pair.faces[0],
                s.pair.faces[1]
            );
        }
        if let Some(p) = self.penetrations.first() {
            let _ = writeln!(
                out,
                "first at t = {:.5}: {}, faces {} and {}, vertices {:?}, depth {:.2} units",
                p.t,
                p.kind,
                p.pair.faces[0],
                p.pair.faces[1],
                p.vertices,
                Number(p.depth)
            );
            if let Some(layers) = &p.layers {
                let _ = writeln!(out, "  faces {:?} break: {}", layers.faces, layers.rule);
            }
        }
        let _ = writeln!(out, "{}", self.layer_line());
        for assumption in &self.assumptions {
            let _ = writeln!(out, "- {assumption}");
        }
        out
    }

    fn layer_line(&self) -> String {
        let count = |order| self.clusters.iter().filter(|c| c.order == order).count();
        let deepest = self.clusters.iter().map(|c| c.layers).max().unwrap_or(0);
        let orders = self.layer_orders;
        format!(
            "layers: {} clusters up to {deepest} deep; order proved in {}, open in {}, contradicted in {}; faceOrders: \
             {} claimed, {} ignored",
            self.clusters.len(),
            count(LayerProof::Proved),
            count(LayerProof::Unproved),
            count(LayerProof::Contradicted),
            orders.claimed,
            orders.ignored
        )
    }
}
