//! The contents of the shader's uniform `View`.

use eframe::egui::{Color32, Rgba};
use foldmotion_record::Style;
use glam::DVec3;

use super::super::picture::Picture;
use super::super::prepared::PreparedSheet;
use super::super::projection::Projection;

/// Lines are drawn in front of their triangle by this fraction of the distance between layers.
const PULL: f64 = 0.2;

/// Number of floats in the shader's `View`.
pub(super) const VIEW_FLOATS: usize = 48;

/// What a frame is drawn from besides the picture.
pub(in super::super) struct FrameView<'a> {
    pub(in super::super) projection: &'a Projection,
    pub(in super::super) prepared: &'a PreparedSheet,
    pub(in super::super) size: [u32; 2],
    pub(in super::super) pixels_per_point: f32,
}

/// The contents of the shader's `View`.
pub(super) fn numbers(
    picture: &Picture<'_>,
    view: &FrameView<'_>,
    origin: DVec3,
    encodes: bool,
) -> Vec<f32> {
    let style: &Style = picture.style;
    let layer = view.prepared.layer(picture.sheet.unit_length);
    let half_width = 0.5 * style.line_width as f32 * view.pixels_per_point;
    let [width, height] = view.size.map(|side| side as f32);
    let light = |[r, g, b]: [u8; 3]| Rgba::from(Color32::from_rgb(r, g, b)).to_array();
    let [right, up, toward, scale] = view.projection.rows(origin);
    let encodes = f32::from(u8::from(encodes));
    let pulse = picture.pulse.clamp(0.0, 1.0);
    let rows = [
        right,
        up,
        toward,
        scale,
        [width, height, half_width, encodes],
        [layer as f32, (PULL * layer) as f32, pulse, 0.0],
        light(style.front),
        light(style.back),
        light(style.mark),
        light(style.border),
        light(style.mountain),
        light(style.valley),
    ];
    rows.concat()
}
