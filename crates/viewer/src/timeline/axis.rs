//! The axis of motion time that the bar and the plots share.

use eframe::egui::{Rangef, Rect};

/// Maps motion time to horizontal positions on the screen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Axis {
    /// The first and the last motion time.
    pub(super) times: [f64; 2],
    /// Their positions on the screen, points.
    pub(super) span: Rangef,
}

impl Axis {
    /// Width of the numbers to the left of the plots, points.
    const LEFT: f32 = 64.0;
    /// Width of the space for the last label on the right, points.
    const RIGHT: f32 = 18.0;

    /// The axis within the width of `rect`.
    pub(super) fn within(rect: Rect, times: [f64; 2]) -> Self {
        let left = rect.left() + Self::LEFT;
        let right = (rect.right() - Self::RIGHT).max(left + 1.0);
        Self { times, span: Rangef::new(left, right) }
    }

    /// The position of motion time `t`, points.
    pub(super) fn x(&self, t: f64) -> f32 {
        let [first, last] = self.times;
        let part = (t - first) / (last - first).max(f64::MIN_POSITIVE);
        self.span.min + self.span.span() * part as f32
    }

    /// The motion time at position `x`, clamped to the axis.
    pub(super) fn time(&self, x: f32) -> f64 {
        let [first, last] = self.times;
        let part = f64::from((x - self.span.min) / self.span.span()).clamp(0.0, 1.0);
        first + part * (last - first)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::{pos2, vec2};

    #[test]
    fn a_position_on_the_axis_reads_back_as_its_time() {
        let rect = Rect::from_min_size(pos2(10.0, 0.0), vec2(400.0, 20.0));
        for times in [[0.0, 2.0], [1.0, 2.0]] {
            let axis = Axis::within(rect, times);
            for k in 0..=20 {
                let t = times[0] + (times[1] - times[0]) * f64::from(k) / 20.0;
                assert!((axis.time(axis.x(t)) - t).abs() < 1e-5, "{t}");
            }
            assert_eq!(axis.time(-1e6), times[0]);
            assert_eq!(axis.time(1e6), times[1]);
        }
    }
}
