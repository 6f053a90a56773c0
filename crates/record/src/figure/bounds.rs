//! The box around a state, in the view of the state.

use glam::DVec2;

use super::state::Bounds;
use crate::{Camera, Drawing, Stroke};

/// The colour of boxes and dimension lines.
pub(super) const INK: [u8; 3] = [110, 110, 115];

/// A box on the page.
struct Shown {
    corners: [DVec2; 8],
    /// The corner farthest from the viewer.
    farthest: usize,
}

impl Shown {
    fn new(bounds: &Bounds, camera: &Camera, shift: DVec2) -> Self {
        let corners = bounds.corners().map(|corner| camera.project(corner));
        let farthest = (0..8).min_by(|&a, &b| corners[a].z.total_cmp(&corners[b].z));
        Self { corners: corners.map(|p| p.truncate() + shift), farthest: farthest.unwrap_or(0) }
    }

    /// The edges as pairs of corners, those at the farthest corner or the others.
    fn edges(&self, behind: bool) -> Vec<[DVec2; 2]> {
        let pairs = (0..8).flat_map(|k: usize| (0..3).map(move |i| [k, k | 1 << i]));
        let edges = pairs.filter(|[a, b]| a != b);
        edges
            .filter(|pair| pair.contains(&self.farthest) == behind)
            .map(|pair| pair.map(|k| self.corners[k]))
            .collect()
    }

    /// The edge along `axis` that lies farthest out, lower ones first.
    fn outer(&self, axis: usize) -> [DVec2; 2] {
        let centre = self.centre();
        let edge = |k: usize| [k, k | 1 << axis].map(|k| self.corners[k]);
        let outwardness = |[a, b]: [DVec2; 2]| {
            let from_centre = 0.5 * (a + b) - centre;
            let out = from_centre.reject_from((b - a).normalize_or(DVec2::X));
            out.length() + 0.01 * out.y
        };
        let edges = (0..8_usize).filter(|k| k >> axis & 1 == 0).map(edge);
        let outermost = edges.reduce(|a, b| if outwardness(b) >= outwardness(a) { b } else { a });
        outermost.unwrap_or([centre; 2])
    }

    fn centre(&self) -> DVec2 {
        self.corners.iter().sum::<DVec2>() / 8.0
    }
}

/// The edges of `bounds` along x, y and z that lie farthest out, each with the middle of the box.
pub(super) fn outer_edges(bounds: &Bounds, camera: &Camera) -> [([DVec2; 2], DVec2); 3] {
    let shown = Shown::new(bounds, camera, DVec2::ZERO);
    [0, 1, 2].map(|axis| (shown.outer(axis), shown.centre()))
}

/// The edges of the box that the state may hide, dashed.
pub(super) fn draw_back(
    drawing: &mut Drawing,
    bounds: &Bounds,
    camera: &Camera,
    shift: DVec2,
    line_width: f64,
) {
    let shown = Shown::new(bounds, camera, shift);
    let stroke = Stroke::new(INK, line_width).dashed(3.0 * line_width, 3.0 * line_width);
    drawing.lines(shown.edges(true), stroke);
}

/// The other edges.
pub(super) fn draw_front(
    drawing: &mut Drawing,
    bounds: &Bounds,
    camera: &Camera,
    shift: DVec2,
    line_width: f64,
) {
    let shown = Shown::new(bounds, camera, shift);
    drawing.lines(shown.edges(false), Stroke::new(INK, line_width));
}
