//! The box around a state, in the view of the state.

use glam::DVec2;

use super::paint::Painter;
use super::pose::Bounds;
use crate::{Anchor, Camera, Drawing, Stroke};

/// The colour of the box.
const INK: [u8; 3] = [110, 110, 115];

/// Edges shorter than this on the page have no size written at them.
const SHORTEST: f64 = 2.0;

/// A box on the page.
struct Shown<'a> {
    bounds: &'a Bounds,
    corners: [DVec2; 8],
    /// The corner farthest from the viewer.
    farthest: usize,
}

impl<'a> Shown<'a> {
    fn new(bounds: &'a Bounds, camera: &Camera, shift: DVec2) -> Self {
        let corners = bounds.corners().map(|corner| camera.project(corner));
        let farthest = (0..8).min_by(|&a, &b| corners[a].z.total_cmp(&corners[b].z));
        Self {
            bounds,
            corners: corners.map(|p| p.truncate() + shift),
            farthest: farthest.unwrap_or(0),
        }
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

    /// The edge along `axis` that lies farthest out, lower ones first, and the direction out there.
    fn outer(&self, axis: usize) -> Option<([DVec2; 2], DVec2)> {
        let centre = self.corners.iter().sum::<DVec2>() / 8.0;
        let edges = (0..8_usize).filter(|k| k >> axis & 1 == 0);
        let edges = edges.map(|k| [k, k | 1 << axis].map(|k| self.corners[k]));
        let out = |[a, b]: [DVec2; 2]| {
            let from_centre = 0.5 * (a + b) - centre;
            from_centre.reject_from((b - a).normalize_or(DVec2::X))
        };
        let place = |edge: &[DVec2; 2]| out(*edge).length() + 0.01 * out(*edge).y;
        let edge = edges.max_by(|a, b| place(a).total_cmp(&place(b)))?;
        let is_long = edge[0].distance(edge[1]) > SHORTEST;
        is_long.then(|| (edge, out(edge).normalize_or(DVec2::Y)))
    }
}

impl Painter<'_> {
    fn box_stroke(&self) -> Stroke {
        Stroke::new(INK, self.layout.line_width)
    }

    /// The edges of the box that the state may hide.
    pub(super) fn back_of_box(
        &self,
        drawing: &mut Drawing,
        bounds: &Bounds,
        camera: &Camera,
        shift: DVec2,
    ) {
        let shown = Shown::new(bounds, camera, shift);
        let width = self.layout.line_width;
        let stroke = self.box_stroke().dashed(3.0 * width, 3.0 * width);
        drawing.lines(shown.edges(true), stroke);
    }

    /// The other edges, with the sizes.
    pub(super) fn front_of_box(
        &self,
        drawing: &mut Drawing,
        bounds: &Bounds,
        camera: &Camera,
        shift: DVec2,
    ) {
        let shown = Shown::new(bounds, camera, shift);
        drawing.lines(shown.edges(false), self.box_stroke());
        let letters = self.layout.letters;
        for (axis, text) in shown.bounds.sizes.iter().enumerate() {
            let Some((edge, out)) = shown.outer(axis).filter(|_| !text.is_empty()) else {
                continue;
            };
            let anchor = match out.x {
                x if x > 0.35 => Anchor::Start,
                x if x < -0.35 => Anchor::End,
                _ => Anchor::Middle,
            };
            // The base line lies below the middle of letters.
            let base = DVec2::new(0.0, 0.35 * letters);
            let at = 0.5 * (edge[0] + edge[1]) + out * (0.75 * letters) + base;
            drawing.words(at, text.clone(), letters, anchor);
        }
    }
}
