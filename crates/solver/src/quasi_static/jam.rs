//! Whether contact stopped the motion.

use super::outcome::{Jam, QuasiStaticRun, StageOutcome, StopReason};

/// The creases of a folded sheet are no further than this from their targets, in degrees; one that is further off where
/// layers push may be kept from it by them. In the built-in scenes, the contact gap and the stiffness of the sheet keep
/// creases up to 5 degrees from their targets.
pub const FOLDED_WITHIN_DEG: f64 = 10.0;

/// The same in radians.
pub(super) const FOLDED_WITHIN: f64 = FOLDED_WITHIN_DEG.to_radians();

/// The jam in which `run` ended, if it did: creases far from their targets, or no further equilibrium, where layers
/// push.
///
/// `slack`: how far off, in radians, creases stay between layers that lie a gap apart. `blocking`: the pairs that push
/// hardest in the last state.
pub(super) fn find_jam(
    run: &QuasiStaticRun,
    slack: f64,
    blocking: Vec<([u32; 2], f64)>,
) -> Option<Jam> {
    let limit = slack.max(FOLDED_WITHIN);
    let last = run.figures.last()?;
    let found_none = |stage: &StageOutcome| {
        let stop = stage.stop.as_ref();
        stop.is_some_and(|stop| stop.reason == StopReason::NoEquilibrium)
    };
    let ended_early = run.stages.iter().any(found_none);
    // What a budget ended might have gone on.
    let is_cut_short = !ended_early && run.stages.iter().any(|stage| stage.stop.is_some());
    let is_free = run.release.is_some_and(|release| !release.is_jam());
    if is_cut_short || is_free {
        return None;
    }
    let is_kept = last.fold_angle_error > limit;
    if blocking.is_empty() || !(is_kept || ended_early) {
        return None;
    }
    // Before the jam no layers push, or all creases are near their targets.
    let frames = run.frames.iter().zip(&run.figures);
    let first = frames
        .rev()
        .take_while(|(_, f)| f.contacts > 0 && (ended_early || f.fold_angle_error > limit))
        .last();
    Some(Jam {
        time: first.or(run.frames.last().zip(Some(last)))?.0.time,
        fold_angle_error: last.fold_angle_error,
        blocking,
    })
}
