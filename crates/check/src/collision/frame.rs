//! A frame prepared for the check: validated, moved to the origin, with the boxes of its triangles.

use foldmotion_geometry::{
    Aabb, Closest,
    collide::{Limits, Tree},
    triangle_triangle,
};
use foldmotion_pattern::{Frame, Sheet};
use glam::DVec3;

use super::face_pair::{FacePair, facets_share_a_vertex};
use crate::CheckError;

/// A frame relative to the origin of the check.
#[derive(Debug)]
pub(super) struct CentredFrame {
    pub(super) time: f64,
    pub(super) positions: Vec<DVec3>,
    pub(super) boxes: Vec<Aabb>,
    /// The largest distance of a vertex from the origin, a length.
    pub(super) extent: f64,
}

impl CentredFrame {
    /// Validates a frame and moves it to the origin. Precondition: the corners of the sheet are in range.
    pub(super) fn new(
        sheet: &Sheet,
        frame: &Frame,
        index: usize,
        origin: DVec3,
    ) -> Result<Self, CheckError> {
        let positions: Vec<_> = frame.positions.iter().map(|&p| p - origin).collect();
        if positions.len() != sheet.vertices.len() {
            return Err(CheckError::FrameSize {
                frame: index,
                found: positions.len(),
                expected: sheet.vertices.len(),
            });
        }
        if let Some(vertex) = positions.iter().position(|p| !p.length().is_finite()) {
            return Err(CheckError::NotFinite {
                frame: index,
                vertex,
                position: frame.positions[vertex],
            });
        }
        let extent = positions.iter().map(|p| p.length()).fold(0.0, f64::max);
        let corners = |face: &[u32; 3]| face.map(|v| positions[v as usize]);
        let limit = 100.0 * Limits::margin_for(extent);
        for (face, corner) in sheet.faces.iter().enumerate() {
            let height = least_height(corners(corner));
            if height.is_nan() || height <= limit {
                return Err(CheckError::DegenerateFace { frame: index, face, height, limit });
            }
        }
        let boxes = sheet.faces.iter().map(|f| Aabb::around(corners(f))).collect();
        Ok(Self { time: frame.time, boxes, extent, positions })
    }

    /// The closest triangles among facets that share no vertex.
    ///
    /// `hint`: a pair that is likely to be close.
    pub(super) fn nearest(
        &self,
        sheet: &Sheet,
        tree: &mut Tree,
        hint: Option<[u32; 2]>,
    ) -> Option<(Closest, [u32; 2])> {
        let corners = |face: u32| sheet.faces[face as usize].map(|v| self.positions[v as usize]);
        let measure = |f: u32, g: u32| triangle_triangle(&corners(f), &corners(g));
        let mut best = hint.map(|[f, g]| (measure(f, g), [f, g]));
        let bound = best.as_ref().map_or(f64::INFINITY, |b| b.0.distance);
        // Pairs that are as near as the bound to within rounding need no exact distance.
        let rounding = Limits::margin_for(self.extent);
        tree.refit(&self.boxes);
        tree.visit_near(&self.boxes, bound, |f, g, bound| {
            let (a, b) = (corners(f), corners(g));
            if FacePair::new(sheet, f, g).shared > 0
                || facets_share_a_vertex(sheet, f, g)
                || is_farther(&a, &b, bound - rounding)
            {
                return bound;
            }
            let closest = triangle_triangle(&a, &b);
            if closest.distance >= bound {
                return bound;
            }
            best = Some((closest, [f, g]));
            closest.distance
        });
        best
    }
}

/// Whether one of three directions shows that the triangles are at least `bound` apart.
fn is_farther(a: &[DVec3; 3], b: &[DVec3; 3], bound: f64) -> bool {
    let normal = |t: &[DVec3; 3]| (t[1] - t[0]).cross(t[2] - t[0]);
    let centres = b.iter().sum::<DVec3>() - a.iter().sum::<DVec3>();
    [normal(a), normal(b), centres].into_iter().any(|d| {
        let Some(d) = d.try_normalize() else {
            return false;
        };
        let range = |t: &[DVec3; 3]| {
            let [x, y, z] = t.map(|p| d.dot(p));
            (x.min(y).min(z), x.max(y).max(z))
        };
        let ((low_a, high_a), (low_b, high_b)) = (range(a), range(b));
        (low_b - high_a).max(low_a - high_b) >= bound
    })
}

/// The smallest height of a triangle: twice its area over its longest side.
fn least_height([p, q, r]: [DVec3; 3]) -> f64 {
    let longest = p.distance(q).max(q.distance(r)).max(r.distance(p));
    (q - p).cross(r - p).length() / longest
}
