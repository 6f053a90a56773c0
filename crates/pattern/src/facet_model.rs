//! How a quadrilateral facet is cut into triangles.
//!
//! One diagonal lets a quadrilateral bend along itself alone, so that a symmetric sheet moves unsymmetrically. With a node
//! where the two diagonals cross, four triangles meet in it, and the quadrilateral bends along either diagonal alike.
//! Sources: Filipov, Liu, Tachi, Schenk, Paulino 2017, "Bar and hinge models for scalable analysis of origami" (its
//! model N5B8); Liu and Paulino 2018 (MERLIN2).

use glam::{DVec2, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::layout::split;
use crate::{Facet, UnitSheet};

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
    /// The name in scene files.
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
    diagonal: [u32; 2],
    /// Where the other one crosses it, from 0 to 1.
    share: f64,
}

impl MiddleNode {
    fn of(vertices: &[DVec2], [a, b, c, d]: [u32; 4]) -> Self {
        let [p, q, r, s] = [a, b, c, d].map(|v| vertices[v as usize]);
        Self {
            diagonal: [a, c],
            share: (q - p).perp_dot(s - q) / (r - p).perp_dot(s - q),
        }
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
            [[a, b], [b, c], [c, d], [d, a]]
                .map(|[from, to]| [from, to, middle])
                .to_vec()
        };
        let triangles = facets.iter().map(&mut cut).collect();
        Self {
            triangles,
            middle_nodes,
        }
    }
}

impl UnitSheet {
    /// How its quadrilaterals are cut into triangles.
    pub fn facet_model(&self) -> FacetModel {
        self.facet_model
    }

    /// The same crease pattern with its quadrilaterals cut as `model` says.
    ///
    /// The vertices of the crease pattern keep their numbers; middle nodes follow them, in the order of their facets.
    #[must_use]
    pub fn with_facet_model(self, model: FacetModel) -> Self {
        if model == self.facet_model {
            return self;
        }
        Self::assemble(
            self.unit,
            self.row_units,
            self.boundaries,
            self.columns,
            self.folding,
            model,
        )
    }

    /// The shorter side of the narrowest quadrilateral over its longer one, means of opposite sides; 1 where there is none.
    pub fn narrowest_facet(&self) -> f64 {
        let ratio = |facet: &Facet| {
            let &[a, b, c, d] = &facet.polygon[..] else {
                return 1.0;
            };
            let length = |v: u32, w: u32| {
                self.sheet.vertices[v as usize].distance(self.sheet.vertices[w as usize])
            };
            let sides = [length(a, b) + length(c, d), length(b, c) + length(d, a)];
            sides[0].min(sides[1]) / sides[0].max(sides[1])
        };
        self.sheet.facets.iter().map(ratio).fold(1.0, f64::min)
    }

    /// The number of vertices of the crease pattern; middle nodes follow.
    pub fn pattern_vertices(&self) -> usize {
        self.places.len()
    }

    /// A state of the whole sheet from that of its crease pattern, every facet of which is flat in it.
    pub(crate) fn with_middle_nodes(&self, mut positions: Vec<DVec3>) -> Vec<DVec3> {
        let middles = self.middle_nodes.iter().map(|node| {
            let [p, r] = node.diagonal.map(|v| positions[v as usize]);
            p.lerp(r, node.share)
        });
        let middles: Vec<DVec3> = middles.collect();
        positions.extend(middles);
        positions
    }
}
