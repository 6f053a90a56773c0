//! Sheets of units whose quadrilaterals are cut around a middle node.

use glam::DVec3;

use crate::{Facet, FacetModel, UnitSheet};

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

    /// The shorter side of the narrowest quadrilateral over its longer one, means of opposite sides; 1 if there is
    /// none.
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
        self.locations.len()
    }

    /// The state of the whole sheet from that of its crease pattern, in which every facet is flat.
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
