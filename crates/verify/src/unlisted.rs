//! A search for passages through the sheet where no penetration is listed.

use foldmotion_pattern::Frame;
use glam::DVec3;
use rayon::prelude::*;

use crate::neighbourhood::edges;
use crate::piercing::may_pierce;
use crate::verifier::Verifier;

/// The instants that are searched, as shares of the interval.
const INSTANTS: [f64; 2] = [0.5, 1.0];

/// An edge that surely passes through the sheet, at a triangle.
struct Pierced {
    edge: [u32; 2],
    face: u32,
    instant: f64,
}

impl Verifier<'_> {
    /// Refutes a list without a penetration up to the last frame if an edge passes through the sheet such that no push
    /// by τ undoes it. `near`: the nearby pairs in the interval that begins at `start`.
    ///
    /// If something is listed, more is known about passages than this search could find.
    pub(crate) fn search_unlisted(&mut self, start: &Frame, near: &[[u32; 2]]) {
        let is_listed = self.claimed.values().any(|p| p.time <= self.last.time);
        let is_undecided = self.undecided.iter().any(|(_, frame)| *frame < self.frames);
        if is_listed || is_undecided || self.is_pierced {
            return;
        }
        let both = near.par_iter().with_min_len(64);
        let found = both.find_map_first(|&[f, g]| {
            let pierced = |a, b| self.pierced(start, a, b);
            pierced(f, g).or_else(|| pierced(g, f))
        });
        let Some(Pierced { edge, face, instant }) = found else {
            return;
        };
        self.is_pierced = true;
        let t = start.time + (self.last.time - start.time) * instant;
        let what =
            format!("edge {edge:?} passes through the sheet at triangle {face}, seen at t = {t}");
        self.refute("penetrations", "none that accounts for this", what);
    }

    /// An edge of one triangle that passes through the sheet at another.
    fn pierced(&self, start: &Frame, wall: u32, face: u32) -> Option<Pierced> {
        let corners = self.around.corners(face);
        let tolerance = self.limits.tolerance;
        for instant in INSTANTS {
            let position = |v: u32| -> DVec3 {
                let frames = [start, &self.last].map(|frame| frame.positions[v as usize]);
                frames[0] + (frames[1] - frames[0]) * instant
            };
            let triangle = corners.map(position);
            let mut edges = edges(self.around.corners(wall)).into_iter();
            let pierced = edges.find(|&edge| {
                may_pierce(edge.map(position), &triangle, tolerance)
                    && self
                        .around
                        .surfaces_of(face)
                        .iter()
                        .any(|surface| surface.is_pierced(edge, &position, tolerance))
            });
            if let Some(edge) = pierced {
                return Some(Pierced { edge, face, instant });
            }
        }
        None
    }
}
