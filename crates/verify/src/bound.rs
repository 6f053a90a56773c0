//! What the Bernstein coefficients of the heights along an axis prove about a pair of triangles over a time interval.

use glam::DVec3;

use crate::moving_pair::{Feature, MovingPair, OnPlane};
use crate::path::Path;

/// What is certain about a pair along a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bound {
    /// A lower bound, at every instant, of the gap (min n·b − max n·a) / |n|, whatever the triangles share.
    pub(crate) gap: f64,
    /// A lower bound, at every instant, of the distance between the parts that are not shared, if positive.
    pub(crate) room: f64,
}

impl Path {
    /// What the Bernstein coefficients prove about the pair along this path.
    pub(crate) fn bound(&self, moving: &MovingPair, on_plane: OnPlane) -> Bound {
        let margin = self.margin(moving.size);
        let origin = moving.a[0];
        let relative = |p: [DVec3; 2]| self.heights([p[0] - origin[0], p[1] - origin[1]]);
        let (a, b) = (moving.a.map(relative), moving.b.map(relative));
        let mut least = f64::INFINITY;
        let mut clear = f64::INFINITY;
        for k in 0..self.degree + 2 {
            let high = a[0][k].max(a[1][k]).max(a[2][k]);
            let low = b[0][k].min(b[1][k]).min(b[2][k]);
            least = least.min(low - high);
            if moving.shared == 0 {
                continue;
            }
            for i in (0..3).filter(|&i| !on_plane.a[i]) {
                clear = clear.min(-a[i][k]);
            }
            for j in (0..3).filter(|&j| !on_plane.b[j]) {
                clear = clear.min(b[j][k]);
            }
        }
        let (shortest, longest) = self.lengths();
        let sure = least - margin;
        let divisor = if sure > 0.0 { longest } else { shortest };
        let gap = if divisor > margin / moving.size { sure / divisor } else { f64::NEG_INFINITY };
        let room = match moving.shared {
            0 => gap,
            _ if clear.is_finite() => (clear - margin) / longest,
            _ => f64::NEG_INFINITY,
        };
        Bound { gap, room }
    }
}

impl MovingPair {
    /// What an axis, in the given sense, proves.
    pub(crate) fn bound(&self, axis: (Feature, f64)) -> Bound {
        let path = self.directed(axis);
        let bound = path.bound(self, self.on_plane(axis.0));
        if self.may_clear(axis.0) {
            return bound;
        }
        Bound { room: f64::NEG_INFINITY, ..bound }
    }
}
