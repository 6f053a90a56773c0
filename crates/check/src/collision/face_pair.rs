//! Two triangles of the sheet with their shared corners first.

use foldmotion_geometry::collide::PairPose;
use foldmotion_pattern::Sheet;
use glam::DVec3;

/// Triangles f < g, their corners rearranged so that the shared ones come first, in the same order in both.
#[derive(Debug, Clone, Copy)]
pub(super) struct FacePair {
    pub(super) faces: [u32; 2],
    pub(super) a: [u32; 3],
    pub(super) b: [u32; 3],
    pub(super) shared: usize,
}

impl FacePair {
    pub(super) fn new(sheet: &Sheet, f: u32, g: u32) -> Self {
        let (mut a, mut b) = (sheet.faces[f as usize], sheet.faces[g as usize]);
        let mut shared = 0;
        for i in 0..3 {
            if let Some(j) = (shared..3).find(|&j| b[j] == a[i]) {
                a.swap(shared, i);
                b.swap(shared, j);
                shared += 1;
            }
        }
        Self { faces: [f, g], a, b, shared }
    }

    /// The key under which the pair is looked up.
    pub(super) fn key(&self) -> (u32, u32) {
        (self.faces[0], self.faces[1])
    }

    pub(super) fn pose(&self, positions: &[DVec3]) -> PairPose {
        let positions_of = |corners: [u32; 3]| corners.map(|v| positions[v as usize]);
        PairPose { a: positions_of(self.a), b: positions_of(self.b), shared: self.shared }
    }
}

/// Whether the facets (polygons) of triangles f and g have a vertex in common.
pub(super) fn facets_share_a_vertex(sheet: &Sheet, f: u32, g: u32) -> bool {
    let polygon = |face: u32| &sheet.facets[sheet.face_facets[face as usize] as usize].polygon;
    polygon(f).iter().any(|v| polygon(g).contains(v))
}
