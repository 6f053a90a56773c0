//! The exact order of the facets that coincide in the compact state.
//!
//! Across the width every half unit is a stack of four layers: of the half between P and Q (seen along +y) the flap
//! and the tucks of even rows, then the tucks and the flap of odd rows; the half between Q and P is its mirror image.
//! So flaps and tucks of the next row lie between the two lower tucks of a unit, nested. One rank an element of that
//! stack orders a whole column. At a ridge of case S the upper wall lies on the side of the first row.

use glam::{DVec2, DVec3};

use crate::{Case, FacetKind, Folding, LayerOrder, UnitSheet};

/// Overlaps smaller than this fraction of h are shared edges, not layers.
const OVERLAP_TOLERANCE: f64 = 1e-9;

impl UnitSheet {
    /// The order of every two triangles of different facets that overlap in the compact state, both directions.
    ///
    /// Empty for an unmodified rectangle with w > h, whose flat state no order of layers admits (geometry of figure
    /// 4d); in one with w < h, rows that reach each other round the curved outline carry no order. A map has one pair
    /// for every two layers that overlap, which grows with the square of their number.
    pub fn compact_order(&self) -> LayerOrder {
        self.compact_order_within(usize::MAX).unwrap_or_default()
    }

    /// The same order where it has at most `pairs` entries; `None` as soon as it outgrows them.
    ///
    /// The columns of case E lie in one plane in the compact state, so that its order grows with the square of their
    /// number.
    pub fn compact_order_within(&self, pairs: usize) -> Option<LayerOrder> {
        let mut order = LayerOrder::default();
        let is_map = self.folding == Folding::Map;
        if !is_map
            && self.unit.case == Case::Plain
            && self.unit.width > self.unit.height * (1.0 + 1e-9)
        {
            return Some(order);
        }
        let positions = self.compact();
        let tolerance = OVERLAP_TOLERANCE * self.unit.height;
        let mut layers: Vec<Layer> =
            (0..self.sheet.faces.len() as u32).map(|f| self.layer(f, &positions)).collect();
        layers.sort_by(|a, b| a.plane.cmp(&b.plane).then(a.offset.total_cmp(&b.offset)));
        let same_plane =
            |a: &Layer, b: &Layer| a.plane == b.plane && (a.offset - b.offset).abs() <= tolerance;
        for cluster in layers.chunk_by_mut(same_plane) {
            cluster.sort_by(|a, b| a.low.total_cmp(&b.low).then(a.face.cmp(&b.face)));
            for (i, a) in cluster.iter().enumerate() {
                let near = cluster[i + 1..].iter().take_while(|b| b.low < a.high - tolerance);
                for b in near.filter(|b| a.overlaps(b, tolerance)) {
                    let (lower, upper) = if a.rank < b.rank { (a, b) } else { (b, a) };
                    // The rank grows along +axis; FOLD asks for the side of the second facet's front normal.
                    let facing_up = |layer: &Layer| if layer.normal_along > 0.0 { 1 } else { -1 };
                    order.insert(upper.face, lower.face, facing_up(lower));
                    order.insert(lower.face, upper.face, -facing_up(upper));
                    if order.len() > pairs {
                        return None;
                    }
                }
            }
        }
        Some(order)
    }

    fn layer(&self, face: u32, positions: &[DVec3]) -> Layer {
        let facet_index = self.sheet.face_facets[face as usize];
        let facet = &self.sheet.facets[facet_index as usize];
        let corners = self.sheet.faces[face as usize].map(|v| positions[v as usize]);
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        // Flaps and tucks lie in planes of constant y, walls in planes of constant x; pads never coincide.
        let plane = match facet.kind {
            FacetKind::Wall => Plane::X,
            FacetKind::Flap | FacetKind::Tuck => Plane::Y,
            _ => Plane::Z,
        };
        let rank = match plane {
            Plane::X => u64::from(!self.is_lower_wall(facet_index)),
            Plane::Z if facet.kind == FacetKind::Unit => self.map_rank(facet.row, facet.column),
            _ => u64::from(self.half_unit_rank(facet_index)),
        };
        let (flat, offset, normal_along) = match plane {
            Plane::X => (corners.map(|p| DVec2::new(p.z, p.y)), corners[0].x, normal.x),
            Plane::Y => (corners.map(|p| DVec2::new(p.x, p.z)), corners[0].y, normal.y),
            Plane::Z => (corners.map(|p| DVec2::new(p.x, p.y)), corners[0].z, normal.z),
        };
        let low = flat.iter().map(|p| p.x).fold(f64::INFINITY, f64::min);
        let high = flat.iter().map(|p| p.x).fold(f64::NEG_INFINITY, f64::max);
        Layer { face, facet: facet_index, plane, flat, offset, rank, normal_along, low, high }
    }

    /// Rank of a flap or tuck along +y.
    fn half_unit_rank(&self, facet: u32) -> u32 {
        let facet = &self.sheet.facets[facet as usize];
        let middle = facet.polygon.iter().map(|&v| self.sheet.vertices[v as usize].y).sum::<f64>()
            / facet.polygon.len() as f64;
        let first_half = middle < (f64::from(facet.column) + 0.5) * self.unit.width;
        let even = facet.row.is_multiple_of(2);
        let depth = match (even, facet.kind == FacetKind::Flap) {
            (true, true) => 0,
            (true, false) => 1,
            (false, false) => 2,
            (false, true) => 3,
        };
        8 * facet.column + if first_half { depth } else { 7 - depth }
    }

    /// Whether a wall is the one below its ridge or bottom pad (further from row 0).
    fn is_lower_wall(&self, facet: u32) -> bool {
        let facet = &self.sheet.facets[facet as usize];
        let row = facet.row as usize;
        let middle = f64::midpoint(self.boundaries[row], self.boundaries[row + 1]);
        let mean = facet.polygon.iter().map(|&v| self.sheet.vertices[v as usize].x).sum::<f64>()
            / facet.polygon.len() as f64;
        mean < middle
    }
}

/// The coordinate that is constant on a layer; layers of different planes never coincide.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Plane {
    X,
    Y,
    Z,
}

/// A triangle in the compact state.
struct Layer {
    face: u32,
    facet: u32,
    plane: Plane,
    /// Its corners in the plane.
    flat: [DVec2; 3],
    offset: f64,
    rank: u64,
    normal_along: f64,
    low: f64,
    high: f64,
}

impl Layer {
    /// Whether the two lie in one plane, have an order, and overlap by more than `tolerance` in every direction.
    fn overlaps(&self, other: &Self, tolerance: f64) -> bool {
        if self.facet == other.facet || self.rank == other.rank {
            return false;
        }
        let axes =
            |t: &[DVec2; 3]| [(t[1] - t[0]).perp(), (t[2] - t[1]).perp(), (t[0] - t[2]).perp()];
        let span = |t: &[DVec2; 3], axis: DVec2| {
            let d = t.map(|p| p.dot(axis));
            (d[0].min(d[1]).min(d[2]), d[0].max(d[1]).max(d[2]))
        };
        axes(&self.flat).into_iter().chain(axes(&other.flat)).all(|axis| {
            let axis = axis.normalize_or_zero();
            let (a, b) = (span(&self.flat, axis), span(&other.flat, axis));
            a.1.min(b.1) - a.0.max(b.0) > tolerance
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{CreaseKind, Unit};

    fn sheets() -> Vec<UnitSheet> {
        [
            (Case::E, 1.0, None, None),
            (Case::T, 0.7, None, None),
            (Case::S, 1.6, None, None),
            (Case::SII, 1.6, Some(0.7), None),
            (Case::SII, 1.6, Some(0.7), Some(0.0)),
            (Case::Plain, 0.7, None, None),
        ]
        .into_iter()
        .map(|(case, w, l, d)| {
            UnitSheet::new(Unit::new(case, w, 1.0, l, d).unwrap(), 4, 3).unwrap()
        })
        .collect()
    }

    #[test]
    fn the_two_directions_of_a_pair_agree() {
        for sheet in sheets() {
            let positions = sheet.compact();
            let order = sheet.compact_order();
            assert!(!order.is_empty());
            let normal = |f: u32| {
                let [a, b, c] = sheet.sheet.faces[f as usize].map(|v| positions[v as usize]);
                (b - a).cross(c - a)
            };
            for (f, g, sign) in order.iter() {
                let back = order.sign(g, f).unwrap();
                let same_way = normal(f).dot(normal(g)) > 0.0;
                assert_eq!(back == -sign, same_way, "{:?} {f} {g}", sheet.unit.case);
            }
        }
    }

    /// A valley folded flat puts each facet on the front of the other, a mountain on its back.
    #[test]
    fn facets_joined_by_a_crease_folded_flat_lie_on_the_side_the_crease_folds_to() {
        for sheet in sheets() {
            let order = sheet.compact_order();
            let mut seen = 0;
            for (edge, &angle) in sheet.sheet.edges.iter().zip(sheet.compact_angles()) {
                if angle.abs() < 3.0 || edge.kind == CreaseKind::Border {
                    continue;
                }
                let [Some(f), Some(g)] = edge.faces else { panic!("a crease joins two triangles") };
                let expected = if angle > 0.0 { 1 } else { -1 };
                assert_eq!(order.sign(f, g), Some(expected), "{:?} {edge:?}", sheet.unit.case);
                assert_eq!(order.sign(g, f), Some(expected), "{:?} {edge:?}", sheet.unit.case);
                seen += 1;
            }
            assert!(seen > 20);
        }
    }

    #[test]
    fn a_short_unmodified_rectangle_has_no_order() {
        let unit = Unit::new(Case::Plain, 2.5, 1.0, None, None).unwrap();
        assert!(UnitSheet::new(unit, 3, 2).unwrap().compact_order().is_empty());
    }
}
