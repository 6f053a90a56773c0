//! The proof of a flat state and an order of its layers, without a motion.

use foldmotion_pattern::{Assignment, LayerOrder, Sheet};
use glam::DVec3;

use super::cluster::prove;
use super::pairs::{LayerPair, front_normal, layer_pairs};
use super::{Cluster, FaceEdges, LayerConflict, LayerProof, LayerRule, NARROW};

/// What is proved of a flat state and an order of its layers.
#[derive(Debug, Clone, PartialEq)]
pub struct FlatLayers {
    /// Layers that lie on each other, directly or through others, with what is proved of their order.
    pub clusters: Vec<Cluster>,
    /// Rules that the order breaks.
    pub conflicts: Vec<LayerConflict>,
    /// The largest difference between the lengths of an edge in the pattern and in the flat state.
    pub stretch: f64,
}

impl FlatLayers {
    /// Whether no edge is longer or shorter by more than `length`, the order of all layers is known, and it breaks no rule.
    pub fn is_proved(&self, length: f64) -> bool {
        let is_proved = |cluster: &Cluster| cluster.order == LayerProof::Proved;
        self.stretch <= length && self.conflicts.is_empty() && self.clusters.iter().all(is_proved)
    }
}

/// Tests the rules of flat foldings on the triangles of a flat state.
///
/// `positions`: one for each vertex, all in one plane. `order`: of any two triangles that overlap by more than `width` in
/// every direction, in at least one of the two ways to state it. Creases must lie on the side of their assignment. Lines
/// nearer than `width` count as one.
pub fn flat_layers(
    sheet: &Sheet,
    positions: &[DVec3],
    order: &LayerOrder,
    width: f64,
) -> FlatLayers {
    let tolerance = width / NARROW;
    let near = near_pairs(sheet, positions);
    let near: Vec<_> = near.into_iter().map(|pair| (pair, None)).collect();
    let mut pairs = layer_pairs(sheet, positions, &near, tolerance);
    let edges = FaceEdges::new(sheet);
    let mut conflicts = Vec::new();
    for pair in &mut pairs {
        let stated = Stated { sheet, positions, order, pair: *pair };
        match stated.up(&edges) {
            Ok(up) => pair.up = up,
            Err(rule) => conflicts.push(LayerConflict { rule, faces: pair.faces.to_vec() }),
        }
    }
    let proof = prove(sheet, &edges, positions, &pairs, tolerance);
    conflicts.extend(proof.contradictions.into_iter().map(|found| found.conflict));
    FlatLayers { clusters: proof.clusters, conflicts, stretch: stretch(sheet, positions) }
}

/// The order of a pair, as it is stated.
struct Stated<'a> {
    sheet: &'a Sheet,
    positions: &'a [DVec3],
    order: &'a LayerOrder,
    pair: LayerPair,
}

impl Stated<'_> {
    /// The direction along which the first triangle lies below the second; `None` if nothing is stated.
    ///
    /// # Errors
    /// The rule that the statements break: both ways of stating the order must agree with each other and the assignment
    /// of the crease between the two.
    fn up(&self, edges: &FaceEdges) -> Result<Option<DVec3>, LayerRule> {
        let [f, g] = self.pair.faces;
        let front = |face| front_normal(self.sheet, face, self.positions);
        // The sign of (f, g) refers to the front of g, that of (g, f) to the front of f.
        let by_second = self.order.sign(f, g).map(|sign| -f64::from(sign) * front(g));
        let by_first = self.order.sign(g, f).map(|sign| f64::from(sign) * front(f));
        let by_crease = self.assigned(edges).map(|sign| sign * front(f));
        let agree = |one: Option<DVec3>, other: Option<DVec3>| {
            one.zip(other).is_none_or(|(one, other)| one.dot(other) > 0.0)
        };
        let stated = by_first.or(by_second);
        if !agree(by_first, by_second) {
            return Err(LayerRule::Claim);
        }
        if !agree(stated, by_crease) {
            return Err(LayerRule::Crease);
        }
        Ok(stated)
    }

    /// 1 if the crease between the two folds to the front, −1 if to the back.
    fn assigned(&self, edges: &FaceEdges) -> Option<f64> {
        let [f, g] = self.pair.faces;
        let mut hinges = (0..3).filter_map(|i| edges.hinge(self.sheet, f, i));
        let (edge, _) = hinges.find(|&(_, beyond)| beyond == g)?;
        match self.sheet.edges[edge as usize].assignment {
            Assignment::Valley => Some(1.0),
            Assignment::Mountain => Some(-1.0),
            _ => None,
        }
    }
}

/// The pairs of triangles whose boxes overlap, in order.
fn near_pairs(sheet: &Sheet, positions: &[DVec3]) -> Vec<(u32, u32)> {
    let bounds = |face: &[u32; 3]| {
        let [p, q, r] = face.map(|v| positions[v as usize]);
        [p.min(q).min(r), p.max(q).max(r)]
    };
    let boxes: Vec<[DVec3; 2]> = sheet.faces.iter().map(bounds).collect();
    let mut by_start: Vec<u32> = (0..boxes.len() as u32).collect();
    by_start.sort_by(|&f, &g| boxes[f as usize][0].x.total_cmp(&boxes[g as usize][0].x));
    let mut pairs = Vec::new();
    for (k, &f) in by_start.iter().enumerate() {
        let [low, high] = boxes[f as usize];
        let ahead = by_start[k + 1..].iter().take_while(|&&g| boxes[g as usize][0].x <= high.x);
        for &g in ahead {
            let [other_low, other_high] = boxes[g as usize];
            if other_low.y <= high.y && low.y <= other_high.y {
                pairs.push((f.min(g), f.max(g)));
            }
        }
    }
    pairs.sort_unstable();
    pairs
}

/// The largest difference between the lengths of an edge in the pattern and in the flat state.
fn stretch(sheet: &Sheet, positions: &[DVec3]) -> f64 {
    let differences = sheet.edges.iter().map(|edge| {
        let [a, b] = edge.vertices.map(|v| v as usize);
        let drawn = sheet.vertices[a].distance(sheet.vertices[b]);
        (positions[a].distance(positions[b]) - drawn).abs()
    });
    differences.fold(0.0, f64::max)
}
