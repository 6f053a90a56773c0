//! Overlays as segments, as the shader's `overlay_vertex` reads them.

use eframe::egui::{Color32, Rgba};
use glam::DVec3;

use super::picture::{Overlay, Picture, Shape};

/// Opacity of lines behind the sheet.
const HIDDEN: f32 = 0.28;

/// Diameter of the dot on a pulled vertex, points.
const PULL_DIAMETER: f32 = 9.0;

/// A line between two points, or a dot if they are equal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Segment {
    pub(super) ends: [DVec3; 2],
    pub(super) colour: Color32,
    /// The width of the line or the diameter of the dot, points.
    pub(super) width: f32,
    pub(super) hidden: f32,
}

impl Segment {
    /// Number of floats of a segment in the buffer.
    pub(super) const FLOATS: usize = 12;

    /// The record that the shader reads, with positions relative to `origin`, for `pixels` per point.
    pub(super) fn floats(&self, origin: DVec3, pixels: f32) -> [f32; Self::FLOATS] {
        let [a, b] = self.ends.map(|end| (end - origin).as_vec3());
        let [r, g, b_, alpha] = Rgba::from(self.colour.to_opaque()).to_array();
        let opacity = alpha * f32::from(self.colour.a()) / 255.0;
        let half = 0.5 * self.width * pixels;
        [a.x, a.y, a.z, b.x, b.y, b.z, r, g, b_, opacity, half, self.hidden]
    }
}

/// All lines and dots over the sheet of `picture`.
pub(super) fn segments(picture: &Picture<'_>) -> Vec<Segment> {
    let mut segments: Vec<Segment> = picture.overlays.iter().flat_map(of_overlay).collect();
    let place = |vertex: u32| picture.positions.get(vertex as usize).copied();
    if let Some(pull) = picture.pull
        && let Some(from) = place(pull.vertex)
    {
        let [r, g, b] = picture.style.mark;
        let colour = Color32::from_rgb(r, g, b);
        let segment = |ends, width| Segment { ends, colour, width, hidden: 1.0 };
        segments.push(segment([from, pull.target], 2.0));
        segments.push(segment([from; 2], PULL_DIAMETER));
        segments.push(segment([pull.target; 2], 0.7 * PULL_DIAMETER));
    }
    segments.retain(|segment| segment.ends.iter().all(|end| end.is_finite()));
    segments
}

fn of_overlay(overlay: &Overlay<'_>) -> Vec<Segment> {
    let hidden = match overlay.shape {
        Shape::Dots(_) => 1.0,
        Shape::Path(_) | Shape::Box(..) => HIDDEN,
    };
    let segment =
        |ends: [DVec3; 2]| Segment { ends, colour: overlay.colour, width: overlay.width, hidden };
    match overlay.shape {
        Shape::Path(points) => {
            let pairs = points.windows(2).map(|pair| [pair[0], pair[1]]);
            pairs.map(segment).collect()
        }
        Shape::Box(corner, edges) => box_edges(corner, edges).map(segment).to_vec(),
        Shape::Dots(points) => points.iter().map(|&p| segment([p; 2])).collect(),
    }
}

fn box_edges(corner: DVec3, edges: [DVec3; 3]) -> [[DVec3; 2]; 12] {
    std::array::from_fn(|k| {
        let (along, i, j) = (k / 4, (k / 4 + 1) % 3, (k / 4 + 2) % 3);
        let side = |bit: usize, edge: usize| edges[edge] * f64::from(u8::from(k & bit != 0));
        let start = corner + side(1, i) + side(2, j);
        [start, start + edges[along]]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_has_twelve_edges_and_three_at_each_of_its_eight_corners() {
        let edges = box_edges(DVec3::ONE, [DVec3::X, DVec3::Y * 2.0, DVec3::Z * 3.0]);
        let mut corners: Vec<[i32; 3]> =
            (edges.iter().flatten()).map(|p| p.as_ivec3().to_array()).collect();
        corners.sort_unstable();
        assert_eq!(corners.len(), 24);
        let counts: Vec<usize> = corners.chunk_by(|a, b| a == b).map(<[_]>::len).collect();
        assert_eq!(counts, [3; 8]);
        let lengths: f64 = edges.iter().map(|[a, b]| (*b - *a).length()).sum();
        assert!((lengths - 24.0).abs() < 1e-12);
    }
}
