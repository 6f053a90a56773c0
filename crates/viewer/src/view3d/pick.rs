//! Finding what is under the pointer, on the processor.

use foldmotion_record::TIE_TOLERANCE;
use glam::{DVec2, DVec3};

use super::picture::Picture;
use super::prepared::PreparedSheet;
use super::projection::Projection;

/// The largest distance of a vertex from the pointer, points.
const REACH: f64 = 12.0;

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Hit {
    pub(super) vertex: Option<u32>,
    pub(super) face: Option<u32>,
}

/// The vertices on the screen, projected again when the state or the view changes.
#[derive(Debug, Default)]
pub(super) struct ProjectedVertices {
    key: Option<(u64, u64, Projection)>,
    points: Vec<DVec3>,
}

impl ProjectedVertices {
    pub(super) fn follow(&mut self, picture: &Picture<'_>, projection: &Projection) {
        let key = Some((picture.sheet_key, picture.state_key, *projection));
        if self.key != key {
            self.key = key;
            self.points.clear();
            let points = picture.positions.iter().map(|&p| projection.project(p));
            self.points.extend(points);
        }
    }

    /// The position of `vertex` on the screen.
    pub(super) fn at(&self, vertex: u32) -> Option<DVec2> {
        self.points.get(vertex as usize).map(|p| p.truncate())
    }

    /// What is visible at a position on the screen.
    pub(super) fn hit(&self, picture: &Picture<'_>, prepared: &PreparedSheet, at: DVec2) -> Hit {
        let slack = TIE_TOLERANCE * picture.sheet.unit_length;
        let near = |point: &DVec3| point.truncate().distance_squared(at);
        let mut vertices: Vec<(u32, &DVec3)> = (0..).zip(&self.points).collect();
        vertices.retain(|(_, point)| near(point) <= REACH * REACH);
        // The nearest to the pointer comes first; at equal distance, the nearest to the viewer.
        vertices.sort_by(|(_, p), (_, q)| {
            let far = |point: &DVec3| near(point).sqrt().round();
            far(p).total_cmp(&far(q)).then(q.z.total_cmp(&p.z))
        });
        let seen = vertices.into_iter().find(|&(vertex, point)| {
            let others = |face: &[u32; 3]| !face.contains(&vertex);
            let front = self.front(picture, prepared, point.truncate(), others);
            front.is_none_or(|(_, depth)| depth <= point.z + slack)
        });
        let front = self.front(picture, prepared, at, |_| true);
        Hit { vertex: seen.map(|(vertex, _)| vertex), face: front.map(|(face, _)| face) }
    }

    /// The triangle nearest to the viewer at `at`, of those that pass `filter`, and its nearness there.
    fn front(
        &self,
        picture: &Picture<'_>,
        prepared: &PreparedSheet,
        at: DVec2,
        filter: impl Fn(&[u32; 3]) -> bool,
    ) -> Option<(u32, f64)> {
        let mut front: Option<(u32, f64)> = None;
        for (index, face) in (0..).zip(&picture.sheet.faces) {
            let corners = face.map(|v| self.points.get(v as usize).copied());
            let [Some(a), Some(b), Some(c)] = corners else {
                continue;
            };
            let Some((depth, side)) = depth_at([a, b, c], at) else {
                continue;
            };
            let depth =
                depth - prepared.depth_offset(index as usize, side, picture.sheet.unit_length);
            if front.is_none_or(|(_, nearest)| depth > nearest) && filter(face) {
                front = Some((index, depth));
            }
        }
        front
    }
}

/// The nearness of a triangle at `at`, and 1 or −1 if its front or its back is visible. `None` outside the triangle.
fn depth_at([a, b, c]: [DVec3; 3], at: DVec2) -> Option<(f64, f64)> {
    let flat = |p: DVec3| p.truncate() - at;
    let [fa, fb, fc] = [a, b, c].map(flat);
    let parts = [fb.perp_dot(fc), fc.perp_dot(fa), fa.perp_dot(fb)];
    let area: f64 = parts.iter().sum();
    let covers = area != 0.0 && parts.iter().all(|part| part * area >= 0.0);
    let depth = (parts[0] * a.z + parts[1] * b.z + parts[2] * c.z) / area;
    // y points down on the screen, so a triangle that is counter-clockwise from its front has a negative area.
    covers.then_some((depth, if area < 0.0 { 1.0 } else { -1.0 }))
}
