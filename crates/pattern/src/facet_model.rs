//! How a quadrilateral facet is cut into triangles.
//!
//! One diagonal lets a quadrilateral bend along itself alone, so that a symmetric sheet moves unsymmetrically. With a
//! node where the two diagonals cross, four triangles meet in it, and the quadrilateral bends along either diagonal
//! alike. Sources: Filipov, Liu, Tachi, Schenk, Paulino 2017, "Bar and hinge models for scalable analysis of origami"
//! (its model N5B8); Liu and Paulino 2018 (MERLIN2).

use glam::DVec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::Facet;

/// How a quadrilateral facet is cut into triangles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FacetModel {
    /// Four triangles around a middle node, where the diagonals cross.
    Symmetric,
    /// Two triangles along the shorter diagonal (ties by the lowest vertex).
    OneDiagonal,
}

impl FacetModel {
    /// The name by which scene files call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Symmetric => "symmetric",
            Self::OneDiagonal => "one-diagonal",
        }
    }
}

/// The node in the middle of a quadrilateral facet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MiddleNode {
    /// The ends of one diagonal.
    pub(crate) diagonal: [u32; 2],
    /// Where the other diagonal crosses it, as a fraction of its length.
    pub(crate) share: f64,
}

impl MiddleNode {
    fn of(vertices: &[DVec2], [a, b, c, d]: [u32; 4]) -> Self {
        let [p, q, r, s] = [a, b, c, d].map(|v| vertices[v as usize]);
        Self { diagonal: [a, c], share: (q - p).perp_dot(s - q) / (r - p).perp_dot(s - q) }
    }
}

/// The facets as triangles.
pub(crate) struct CutFacets {
    /// Counter-clockwise, by facet.
    pub(crate) triangles: Vec<Vec<[u32; 3]>>,
    /// Their vertices follow those of the crease pattern.
    pub(crate) middle_nodes: Vec<MiddleNode>,
}

impl CutFacets {
    /// Cuts `facets` and adds the middle nodes to `vertices`.
    pub(crate) fn new(model: FacetModel, vertices: &mut Vec<DVec2>, facets: &[Facet]) -> Self {
        let mut middle_nodes = Vec::new();
        let mut cut = |facet: &Facet| {
            let (FacetModel::Symmetric, &[a, b, c, d]) = (model, &facet.polygon[..]) else {
                return split(vertices, &facet.polygon);
            };
            let node = MiddleNode::of(vertices, [a, b, c, d]);
            let [p, r] = node.diagonal.map(|v| vertices[v as usize]);
            let middle = vertices.len() as u32;
            vertices.push(p.lerp(r, node.share));
            middle_nodes.push(node);
            [[a, b], [b, c], [c, d], [d, a]].map(|[from, to]| [from, to, middle]).to_vec()
        };
        let triangles = facets.iter().map(&mut cut).collect();
        Self { triangles, middle_nodes }
    }
}

/// Triangles of a facet, counter-clockwise: a quadrilateral is split by the shorter diagonal (ties by the lowest
/// vertex).
pub(crate) fn split(vertices: &[DVec2], polygon: &[u32]) -> Vec<[u32; 3]> {
    let &[a, b, c, d] = polygon else {
        return vec![[polygon[0], polygon[1], polygon[2]]];
    };
    let length = |i: u32, j: u32| vertices[i as usize].distance(vertices[j as usize]);
    let (ac, bd) = (length(a, c), length(b, d));
    // Lengths that differ only by rounding tie.
    let tie = (ac - bd).abs() <= 1e-12 * ac.max(bd);
    let lowest_on_ac = a.min(c) < b.min(d);
    if (tie && lowest_on_ac) || (!tie && ac < bd) {
        vec![[a, b, c], [a, c, d]]
    } else {
        vec![[a, b, d], [b, c, d]]
    }
}
