//! Values of triangles, shown as colours.

use foldmotion_pattern::Motion;
use glam::Vec3;

use crate::RecordError;
use crate::colour_map::colour_of;
use crate::shade::linear;

/// One number a triangle and frame of a motion, such as a strain, and how it is shown.
#[derive(Debug, Clone, PartialEq)]
pub struct Values {
    /// The quantity with its unit, for the legend.
    pub title: String,
    /// The values of the first and the last colour; others are clamped.
    pub range: [f64; 2],
    /// One list a frame of the motion, one value for each triangle. A triangle whose value is not a number shows its
    /// paper.
    pub frames: Vec<Vec<f64>>,
}

impl Values {
    /// Refuses values that do not fit `motion`, and a range that has no length.
    pub(crate) fn check(&self, motion: &Motion) -> Result<(), RecordError> {
        let [low, high] = self.range;
        if !(low.is_finite() && high.is_finite() && low < high) {
            return Err(RecordError::Range { low, high });
        }
        let expected = motion.sheet.faces.len();
        let wrong = self.frames.iter().position(|f| f.len() != expected);
        let frame = wrong.unwrap_or(self.frames.len());
        if wrong.is_none() && self.frames.len() == motion.frames.len() {
            return Ok(());
        }
        Err(RecordError::ValueCount {
            frame,
            found: self.frames.get(frame).map_or(0, Vec::len),
            expected,
        })
    }

    /// The colours of the triangles at motion time `time`; values run straight from frame to frame.
    pub(crate) fn colours(&self, motion: &Motion, time: f64) -> Vec<Option<Vec3>> {
        let last = self.frames.len() - 1;
        let next = motion.frames.partition_point(|frame| frame.time < time);
        let (after, before) = (next.min(last), next.saturating_sub(1).min(last));
        let [from, to] = [before, after].map(|i| motion.frames[i].time);
        let part = if to > from { ((time - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 };
        let [low, high] = self.range;
        let colour = |(&a, &b): (&f64, &f64)| {
            let value = if part == 1.0 { b } else { a + (b - a) * part };
            let part = (value - low) / (high - low);
            (!part.is_nan()).then(|| linear(colour_of(part)))
        };
        let pairs = self.frames[before].iter().zip(&self.frames[after]);
        pairs.map(colour).collect()
    }
}
