//! The increments of a stage's ramp.
//!
//! Equal ones, at least one a frame and none that turns a target by more than [`LARGEST_TURN`]; towards the end of
//! `fold` also a geometric series, each closing increment leaving [`CLOSING_RATIO`] of the turn that was left. There
//! the layers of the compact state come together: with ε left to turn, neighbouring layers lie of the order of ε²
//! apart, so the sag of a straight path between two states and the lag behind the schedule must shrink like ε² too.
//! Hence the tolerance falls with the square of what is left, and each closing increment is recorded as a frame.

use super::options::DynamicOptions;
use crate::{Schedule, Stage};

/// The largest turn of a target in one increment, radians (1.5°: that of 240 frames), so that the path does not depend
/// on how few frames are recorded.
const LARGEST_TURN: f64 = std::f64::consts::PI / 120.0 * (1.0 + 1e-9);

/// What a closing increment leaves of the turn that was left.
const CLOSING_RATIO: f64 = 0.7;

/// The turn left at which closing begins, radians: there its increments are as large as the equal ones.
const CLOSING_TURN: f64 = LARGEST_TURN / (1.0 - CLOSING_RATIO);

/// The turn at which closing ends, radians: layers then lie closer than 1e-6, which counts as touching.
const CLOSED_TURN: f64 = 3e-4;

/// A part of a stage's ramp.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Increment {
    /// The stage-local time at its end.
    pub(super) end: f64,
    /// The residual to which the sheet settles there.
    pub(super) tolerance: f64,
    /// Whether the state there is a frame.
    pub(super) is_recorded: bool,
}

/// The increments of `stage` but for the last one, which ends at 1 and settles to the final tolerance.
pub(super) fn increments(
    schedule: &Schedule,
    stage: Stage,
    options: &DynamicOptions,
) -> Vec<Increment> {
    let intervals = options.frames / 2;
    let turn = schedule.largest_turn(stage);
    let per_frame = per_frame(turn / intervals as f64);
    let total = intervals * per_frame;
    // `left`: the share of the stage that is left at the end of the increment.
    let increment = |left: f64, is_recorded: bool| {
        let closeness = (turn * left / LARGEST_TURN).min(1.0);
        let tolerance = match stage {
            Stage::Unfold => options.ramp_tolerance,
            Stage::Fold => options.ramp_tolerance * closeness * closeness,
        };
        Increment {
            end: 1.0 - left,
            tolerance: tolerance.max(options.tolerance),
            is_recorded,
        }
    };
    let uniform = (1..total).map(|index| {
        increment(
            (total - index) as f64 / total as f64,
            index.is_multiple_of(per_frame),
        )
    });
    let mut increments: Vec<_> = uniform.collect();
    if stage == Stage::Fold {
        // A closing increment that all but meets an equal one is left out: frames are distinct in time.
        let is_apart = |left: &f64| {
            let place = left * total as f64;
            (place - place.round()).abs() > 1e-3
        };
        increments.extend(
            closing(turn)
                .filter(is_apart)
                .map(|left| increment(left, true)),
        );
        increments.sort_by(|a, b| a.end.total_cmp(&b.end));
    }
    increments
}

#[expect(clippy::cast_sign_loss, reason = "a largest magnitude is not negative")]
fn per_frame(turn: f64) -> usize {
    ((turn / LARGEST_TURN).ceil() as usize).max(1)
}

/// The shares left at the ends of the closing increments of a stage that turns by `turn`.
fn closing(turn: f64) -> impl Iterator<Item = f64> {
    let first = (CLOSING_TURN / turn).min(1.0) * CLOSING_RATIO;
    std::iter::successors(Some(first), |left| Some(left * CLOSING_RATIO))
        .take_while(move |left| turn * left > CLOSED_TURN)
}

#[cfg(test)]
mod tests {
    use foldmotion_pattern::{Case, Unit, UnitSheet};

    use super::*;

    fn increments_for(frames: usize, share: f64) -> Vec<Increment> {
        let unit = Unit::new(Case::E, 1.0, 1.0, None, None).unwrap();
        let units = UnitSheet::new(unit, 1, 1).unwrap();
        let flat = vec![0.0; units.sheet.edges.len()];
        let compact: Vec<f64> = units.compact_angles().iter().map(|a| a * share).collect();
        let schedule = Schedule::uniform(&units.sheet, &flat, &compact).unwrap();
        let options = DynamicOptions {
            frames,
            ..DynamicOptions::default()
        };
        increments(&schedule, Stage::Fold, &options)
    }

    #[test]
    fn every_frame_has_its_increment_and_none_turns_too_far() {
        for (frames, share) in [(2, 1.0), (24, 0.3), (240, 1.0), (1000, 1.0), (240, 0.7)] {
            let increments = increments_for(frames, share);
            let ends: Vec<f64> = increments.iter().map(|i| i.end).collect();
            let mut from = 0.0;
            for &end in ends.iter().chain(&[1.0]) {
                assert!(end > from, "{end} follows {from}");
                assert!(
                    (end - from) * share <= (1.0 / 120.0) * (1.0 + 1e-6),
                    "{from} to {end}"
                );
                from = end;
            }
            for k in 1..frames / 2 {
                let time = k as f64 / (frames / 2) as f64;
                let is_frame = |i: &Increment| i.is_recorded && (i.end - time).abs() < 1e-12;
                assert!(
                    increments.iter().any(is_frame),
                    "{frames} frames: {time} is missing"
                );
            }
        }
    }

    #[test]
    fn closing_increments_shrink_and_tighten_towards_the_end() {
        let increments = increments_for(240, 1.0);
        let last = increments[increments.len() - 1];
        let left = std::f64::consts::PI * (1.0 - last.end);
        assert!(left < 1.5 * CLOSED_TURN && left > CLOSED_TURN, "{left}");
        assert!(last.tolerance < 1e-6 && last.is_recorded, "{last:?}");
        assert_eq!(
            increments[0].tolerance,
            DynamicOptions::default().ramp_tolerance
        );
    }

    #[test]
    fn a_sheet_that_does_not_turn_has_one_increment_a_frame() {
        assert_eq!(increments_for(24, 0.0).len(), 11);
    }
}
