//! The order of layers that lie on each other.
//!
//! Two triangles are *layers* of each other at a frame if the corners of one lie within τ of the plane of the other and
//! the two, projected along its normal, overlap by more than 10 τ in every direction. Their order is the side on which
//! the motion has kept them: the directions along which the first lies below the second all point to one side of it.
//! Layers that overlap, directly or through others, form a *cluster*.
//!
//! # The rules
//!
//! Orders of pairs that are right one by one need not be possible together. In a cluster they are tested by the rules
//! of flat foldings (Justin 1994, "Towards a mathematical theory of origami"; Bern and Hayes 1996, "The complexity of
//! flat origami"; the names are those of Akitaya, Cheung, Demaine, Horiyama, Hull, Ku, Tachi and Uehara 2016, "Box
//! pleating is hard"):
//!
//! - *transitivity*: over no common region is a above b, b above c and c above a;
//! - *taco–taco*, *taco–tortilla*, *tortilla–tortilla*: two creases on one line, or a crease and a layer that crosses
//!   it, do not pass through each other there.
//!
//! The last three are one rule. Around a line, two creases (or a crease and a layer, which is bent by 0 there) are two
//! pairs of half-planes. They pass through each other exactly if the pairs interleave in the cyclic order of the four.
//! Half-planes that coincide are ordered by their layers. So creases that leave the plane of the cluster, as beside the
//! walls of case S, need no rule of their own: the layer that such a crease crosses must not lie on the side to which
//! the crease bends (*bent*). A crease folded flat is a taco; an edge of angle 0, which may lie inside a facet, is a
//! tortilla.
//!
//! These rules are necessary. If the orders of all pairs are known, they are also sufficient for the layers of a flat
//! folding (Justin); what happens at a vertex follows from its creases.
//!
//! # Limits
//!
//! Overlaps of at most 10 τ count as shared edges, and creases at most 10 τ apart count as one line. A pair that the
//! motion never held on one side, because it was in contact from the first frame on, has no order unless the file
//! claims one. A cluster with such a pair is *unproved*, and only rules between pairs of known order are tested in it.

mod acyclic;
mod cluster;
mod flat;
mod flat_state;
mod hinges;
mod pairs;
mod report;
mod stacking;

pub(crate) use cluster::{Contradiction, prove};
pub use flat_state::{FlatLayers, flat_layers};
pub(crate) use pairs::{LayerPair, front_normal, layer_pairs, layer_point, order_of};
pub use report::{Claims, Cluster, LayerConflict, LayerProof, LayerRule, RuleCounts};
pub(crate) use stacking::{FaceStack, unused_claims};

use foldmotion_pattern::Sheet;

/// Overlaps, and distances of lines, up to this multiple of τ count as none.
const NARROW: f64 = 10.0;

/// For each triangle of a sheet, the edge of the sheet along each of its sides.
#[derive(Debug)]
pub(crate) struct FaceEdges(Vec<[Option<u32>; 3]>);

impl FaceEdges {
    pub(crate) fn new(sheet: &Sheet) -> Self {
        let mut edges = vec![[None; 3]; sheet.faces.len()];
        for (index, edge) in (0..).zip(&sheet.edges) {
            for face in edge.faces.into_iter().flatten() {
                let corners = sheet.faces[face as usize];
                let is_edge = |&i: &usize| {
                    let ends = [corners[i], corners[(i + 1) % 3]];
                    edge.vertices.iter().all(|v| ends.contains(v))
                };
                if let Some(i) = (0..3).find(is_edge) {
                    edges[face as usize][i] = Some(index);
                }
            }
        }
        Self(edges)
    }

    /// The edge from corner `i` of `face` to the next corner, and the triangle beyond it; `None` at the boundary.
    pub(crate) fn hinge(&self, sheet: &Sheet, face: u32, i: usize) -> Option<(u32, u32)> {
        let edge = self.0[face as usize][i]?;
        let faces = sheet.edges[edge as usize].faces;
        let beyond = faces.into_iter().flatten().find(|&f| f != face)?;
        Some((edge, beyond))
    }
}
