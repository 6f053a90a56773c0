//! A motion in few key frames.

use foldmotion_pattern::Motion;

use crate::RecordError;
use crate::film::{check_frames, check_times};
#[cfg(test)]
use crate::positions_at;

/// The key frames that hold a motion, and how well.
#[derive(Debug, Clone, PartialEq)]
pub struct KeyFrames {
    /// The frames of the motion that are kept, in order: the first, the last and some between.
    pub frames: Vec<usize>,
    /// The largest distance of a vertex, at any frame of the motion, from where it is when vertices run straight from
    /// one kept frame to the next. In the motion's unit of length.
    pub error: f64,
}

/// Chooses key frames so that every vertex stays within `tolerance` of the motion at all its frames.
///
/// The frame that is farthest from the straight path between its kept neighbours is kept too, until all are near
/// enough (Douglas and Peucker 1973, Algorithms for the reduction of the number of points required to represent a
/// digitized line, applied to all vertices at once, with time as the parameter). Between frames both the motion and
/// its key frames are straight, so the bound holds at all times. Not the fewest frames possible.
///
/// # Errors
/// [`RecordError::NotPositive`], [`RecordError::NoFrames`], [`RecordError::Time`], [`RecordError::VertexCount`],
/// [`RecordError::NotFinite`].
pub fn key_frames(motion: &Motion, tolerance: f64) -> Result<KeyFrames, RecordError> {
    if !(tolerance.is_finite() && tolerance > 0.0) {
        return Err(RecordError::NotPositive { name: "tolerance", value: tolerance });
    }
    check_times(motion)?;
    check_frames(motion)?;
    let last = motion.frames.len() - 1;
    let mut kept = vec![last];
    let mut error: f64 = 0.0;
    let mut frames = vec![0];
    let mut from = 0;
    // `kept` is a stack of ends, the nearest on top.
    while let Some(&to) = kept.last() {
        match farthest(motion, from, to) {
            Some((frame, distance)) if distance > tolerance => kept.push(frame),
            found => {
                error = error.max(found.map_or(0.0, |(_, distance)| distance));
                kept.pop();
                if to != from {
                    frames.push(to);
                }
                from = to;
            }
        }
    }
    Ok(KeyFrames { frames, error })
}

/// The frame between `from` and `to` that is farthest from the straight path between them.
fn farthest(motion: &Motion, from: usize, to: usize) -> Option<(usize, f64)> {
    let [start, end] = [from, to].map(|i| &motion.frames[i]);
    let distance = |index: usize| {
        let frame = &motion.frames[index];
        let part = (frame.time - start.time) / (end.time - start.time);
        let ends = start.positions.iter().zip(&end.positions);
        let offsets = (ends.zip(&frame.positions))
            .map(|((p, q), found)| p.lerp(*q, part).distance_squared(*found));
        offsets.fold(0.0, f64::max).sqrt()
    };
    let between = (from + 1)..to;
    let all = between.map(|index| (index, distance(index)));
    all.reduce(|best, next| if next.1 > best.1 { next } else { best })
}

/// The largest distance of `motion` from itself with `frames` alone, found frame by frame.
#[cfg(test)]
fn measured(motion: &Motion, frames: &[usize]) -> f64 {
    let few = Motion {
        frames: frames.iter().map(|&i| motion.frames[i].clone()).collect(),
        ..motion.clone()
    };
    let distance = |frame: &foldmotion_pattern::Frame| {
        let found = positions_at(&few, frame.time);
        let pairs = found.iter().zip(&frame.positions);
        pairs.map(|(p, q)| p.distance(*q)).fold(0.0, f64::max)
    };
    motion.frames.iter().map(distance).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use foldmotion_pattern::{Case, Unit};
    use foldmotion_pattern::{Frame, UnitSheet};

    use super::*;

    /// A sheet that turns by a right angle in 90 steps, as a solid body.
    fn turning() -> Motion {
        let unit = Unit::new(Case::S, 1.6, 1.0, None, None).unwrap();
        let units = UnitSheet::new(unit, 1, 1).unwrap();
        let frame = |degrees: u32| {
            let turn = glam::DQuat::from_rotation_y(f64::from(degrees).to_radians());
            let positions = units.sheet.planar().iter().map(|&p| turn * p).collect();
            Frame { time: f64::from(degrees) / 90.0, positions }
        };
        Motion {
            frames: (0..=90).map(frame).collect(),
            compact_order: units.compact_order(),
            sheet: units.sheet,
        }
    }

    #[test]
    fn key_frames_hold_the_motion_within_the_tolerance_as_measured_anew() {
        let motion = turning();
        let mut count = usize::MAX;
        for tolerance in [1e-4, 1e-3, 1e-2, 10.0] {
            let keys = key_frames(&motion, tolerance).unwrap();
            let error = measured(&motion, &keys.frames);
            assert!(error <= tolerance && (error - keys.error).abs() < 1e-12);
            assert!(keys.frames.is_sorted_by(|a, b| a < b));
            assert!(keys.frames.len() <= count, "a larger tolerance needs no more");
            count = keys.frames.len();
        }
        assert_eq!(count, 2);
        assert!(measured(&motion, &[0, 90]) > 1e-2, "two frames are not enough");
    }

    #[test]
    fn a_still_motion_has_one_key_frame_and_no_tolerance_is_refused() {
        let mut motion = turning();
        motion.frames.truncate(1);
        assert_eq!(key_frames(&motion, 1e-3).unwrap().frames, [0]);
        assert!(key_frames(&motion, 0.0).is_err() && key_frames(&motion, f64::NAN).is_err());
    }
}
