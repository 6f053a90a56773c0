//! The edges of a sheet of units: the kind of each crease and its fold angle in the compact state.

use std::collections::BTreeMap;

use glam::DVec2;

use super::builder::VertexLocation;
use super::lines::{Line, is_mid};
use crate::{Assignment, CreaseKind, Edge, Facet, FacetKind, Sheet, Unit};

/// Joins the triangles of the facets by edges.
pub(super) fn join(
    unit: &Unit,
    lines: &[Line],
    locations: &[(u32, VertexLocation)],
    vertices: Vec<DVec2>,
    facets: Vec<Facet>,
    triangles: &[Vec<[u32; 3]>],
) -> (Sheet, Vec<f64>) {
    let faces = triangles.concat();
    let of_facet = |(facet, triangles): (usize, &Vec<_>)| vec![facet as u32; triangles.len()];
    let face_facets: Vec<u32> = triangles.iter().enumerate().flat_map(of_facet).collect();
    let mut sides: BTreeMap<[u32; 2], [Option<u32>; 2]> = BTreeMap::new();
    for (face, &[a, b, c]) in faces.iter().enumerate() {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let side = usize::from(from > to);
            sides.entry([from.min(to), from.max(to)]).or_default()[side] = Some(face as u32);
        }
    }
    let mut edges = Vec::with_capacity(sides.len());
    let mut compact_angles = Vec::with_capacity(sides.len());
    for (ends, around) in sides {
        let facet_of = |face: Option<u32>| face.map(|f| face_facets[f as usize]);
        let (kind, angle) = match (facet_of(around[0]), facet_of(around[1])) {
            (Some(a), Some(b)) if a == b => (CreaseKind::Facet, 0.0),
            (Some(a), Some(b)) => {
                let (a, b) = (&facets[a as usize], &facets[b as usize]);
                crease(a, b, lines, locations, ends)
            }
            _ => (CreaseKind::Border, 0.0),
        };
        let assignment = match kind {
            CreaseKind::Border => Assignment::Border,
            CreaseKind::Facet => Assignment::Facet,
            _ if angle > 0.0 => Assignment::Valley,
            _ => Assignment::Mountain,
        };
        let near = around.iter().flatten().map(|&f| &facets[face_facets[f as usize] as usize]);
        let row = near.clone().map(|f| f.row).max().unwrap_or(0);
        let column = near.map(|f| f.column).min().unwrap_or(0);
        edges.push(Edge { vertices: ends, assignment, kind, row, column, faces: around });
        compact_angles.push(angle);
    }
    let sheet = Sheet { vertices, edges, faces, face_facets, facets, unit_length: unit.height };
    (sheet, compact_angles)
}

/// The kind of the crease between two facets and its fold angle in the compact state, radians.
fn crease(
    a: &Facet,
    b: &Facet,
    lines: &[Line],
    locations: &[(u32, VertexLocation)],
    ends: [u32; 2],
) -> (CreaseKind, f64) {
    use FacetKind::{BottomPad, Flap, Tuck, Wall};
    use std::f64::consts::{FRAC_PI_2, PI};
    let either = |kind| a.kind == kind || b.kind == kind;
    let both = |kind| a.kind == kind && b.kind == kind;
    if a.row != b.row {
        // Tuck–tuck, or top pad–wall.
        return (CreaseKind::Row, if both(Tuck) { -PI } else { -FRAC_PI_2 });
    }
    if both(Tuck) {
        (CreaseKind::Vertical, -PI)
    } else if both(Flap) {
        let family = lines[locations[ends[0] as usize].0 as usize].family;
        (CreaseKind::Vertical, if is_mid(family, a.row) { PI } else { -PI })
    } else if both(Wall) {
        (CreaseKind::Pad, PI)
    } else if either(BottomPad) {
        (CreaseKind::Pad, FRAC_PI_2)
    } else if either(Flap) && either(Tuck) {
        (CreaseKind::Diagonal, PI)
    } else {
        // Flap–top pad, tuck–wall.
        (CreaseKind::Pad, -FRAC_PI_2)
    }
}
