//! The ring around a point.

use glam::DVec2;

use crate::{Drawing, Stroke};

/// The radius of a ring in sizes of letters, and its sides.
const RING: f64 = 0.5;
const RING_SIDES: u32 = 32;

/// A ring around `centre`, between light lines so that it shows on any ground.
pub(super) fn ring(drawing: &mut Drawing, centre: DVec2, color: [u8; 3], letters: f64) {
    let point = |k: u32| {
        let turn = f64::from(k) / f64::from(RING_SIDES) * std::f64::consts::TAU;
        centre + DVec2::from_angle(turn) * (RING * letters)
    };
    for (color, width) in [([u8::MAX; 3], 0.35), (color, 0.18)] {
        let stroke = Stroke::new(color, width * letters);
        drawing.line((0..=RING_SIDES).map(point), stroke);
    }
}
