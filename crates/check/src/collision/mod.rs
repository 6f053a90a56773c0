//! The collision verdict on a motion.

mod checker;
mod closest_approach;
mod closest_features;
mod face_pair;
mod frame;
mod judge;
mod layering;
mod report;
mod span;
mod suspects;

pub use checker::Checker;
use foldmotion_pattern::Motion;
pub use report::{
    CollisionOptions, CollisionReport, FilterCounts, PairCounts, Penetration, PenetrationKind,
    Separation, Stopped, Undecided, Verdict,
};

pub use span::{PenetrationSpan, penetration_spans};

use crate::CheckError;

/// Judges a motion: every pair of triangles in every interval between frames.
///
/// `progress` is called once for each interval with the share that is done, from 0 to 1; if it returns false, the check
/// is cancelled. The whole motion is judged, also after the first penetration, unless more pairs than
/// [`CollisionOptions::stop_at`] penetrate. A pair is not followed beyond its first penetration. The report is bitwise
/// the same for any number of threads.
///
/// # Errors
/// [`CheckError::Cancelled`] if `progress` returned false; the other variants if the motion cannot be judged.
pub fn collisions(
    motion: &Motion,
    options: &CollisionOptions,
    progress: &(dyn Fn(f64) -> bool + Sync),
) -> Result<CollisionReport, CheckError> {
    let (first, rest) = motion.frames.split_first().ok_or(CheckError::NoFrames)?;
    let mut checker = Checker::new(&motion.sheet, first, options)?;
    for (done, frame) in rest.iter().enumerate() {
        if !progress(done as f64 / rest.len() as f64) {
            return Err(CheckError::Cancelled { intervals: done });
        }
        checker.advance(frame)?;
        if checker.is_stopped() {
            break;
        }
    }
    progress(1.0);
    Ok(checker.finish())
}
