//! An edge on the screen.

use glam::{DVec2, DVec3};

/// An edge on the screen.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Segment {
    start: DVec2,
    /// From the start to the end.
    along: DVec2,
    /// 1 / |along|², 0 for a segment seen end-on.
    inverse_squared: f64,
    /// The depths of its start and end.
    depths: [f64; 2],
    /// Whether the sheet ends or turns over here, so that the line is drawn beyond its triangles too.
    pub(crate) is_outline: bool,
}

impl Segment {
    pub(crate) fn new([start, end]: [DVec3; 2], is_outline: bool) -> Self {
        let along = (end - start).truncate();
        let length_squared = along.length_squared();
        Self {
            start: start.truncate(),
            along,
            inverse_squared: if length_squared > 0.0 { length_squared.recip() } else { 0.0 },
            depths: [start.z, end.z],
            is_outline,
        }
    }

    /// The squared distance of `point` and the parameter of the nearest point, 0 at the start, 1 at the end.
    #[inline]
    pub(crate) fn nearest(&self, point: DVec2) -> (f64, f64) {
        let from_start = point - self.start;
        let s = (from_start.dot(self.along) * self.inverse_squared).clamp(0.0, 1.0);
        ((from_start - self.along * s).length_squared(), s)
    }

    #[inline]
    pub(crate) fn depth(&self, s: f64) -> f64 {
        self.depths[0] + s * (self.depths[1] - self.depths[0])
    }
}
