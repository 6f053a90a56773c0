//! Two triangles of the sheet with their shared corners first.

use std::collections::BTreeMap;

use foldmotion_pattern::{Assignment, Sheet};
use glam::DVec3;

use crate::moving_pair::MovingPair;

/// Triangles f < g with their common vertices first, in the same order.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FacePair {
    pub(crate) faces: [u32; 2],
    pub(crate) a: [u32; 3],
    pub(crate) b: [u32; 3],
    pub(crate) shared: usize,
}

impl FacePair {
    /// Precondition: the faces are those of the sheet.
    pub(crate) fn new(sheet: &Sheet, faces: [u32; 2]) -> Self {
        let [a, b] = faces.map(|f| sheet.faces[f as usize]);
        let is_common = |v: &u32| a.contains(v) && b.contains(v);
        let common: Vec<u32> = a.into_iter().filter(is_common).collect();
        let first = |corners: [u32; 3]| {
            let others = corners.into_iter().filter(|v| !is_common(v));
            let mut sorted = corners;
            for (slot, v) in sorted.iter_mut().zip(common.iter().copied().chain(others)) {
                *slot = v;
            }
            sorted
        };
        Self { faces, a: first(a), b: first(b), shared: common.len() }
    }

    pub(crate) fn moving(&self, start: &[DVec3], end: &[DVec3]) -> MovingPair {
        let corners = |positions: &[DVec3]| {
            [self.a, self.b].map(|corners| corners.map(|v| positions[v as usize]))
        };
        MovingPair::new(corners(start), corners(end), self.shared)
    }

    /// Whether the distance of the pair counts towards the separation: its facets have no vertex in common.
    pub(crate) fn is_measured(&self, sheet: &Sheet) -> bool {
        let [p, q] = self.faces.map(|f| {
            let facet = sheet.face_facets[f as usize];
            &sheet.facets[facet as usize].polygon
        });
        self.shared == 0 && !p.iter().any(|v| q.contains(v))
    }
}

/// The assignment of the edge between two triangles.
pub(crate) fn assignments(sheet: &Sheet) -> BTreeMap<[u32; 2], Assignment> {
    let between = sheet.edges.iter().filter_map(|edge| match edge.faces {
        [Some(f), Some(g)] => Some(([f.min(g), f.max(g)], edge.assignment)),
        _ => None,
    });
    between.collect()
}

/// The unit normal of a triangle, pointing to its front.
pub(crate) fn front_normal(sheet: &Sheet, face: u32, positions: &[DVec3]) -> DVec3 {
    let [p, q, r] = sheet.faces[face as usize].map(|v| positions[v as usize]);
    (q - p).cross(r - p).normalize_or_zero()
}
