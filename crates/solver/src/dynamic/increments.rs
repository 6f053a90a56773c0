//! The increments of a stage's ramp.
//!
//! Equal ones, at least one a frame and none that turns a target by more than [`LARGEST_TURN`]; the last one of `fold` is
//! cut into a geometric series, each closing increment leaving [`CLOSING_RATIO`] of what the one before left. There
//! the layers of the compact state come together: with ε left to turn, neighbouring layers lie of the order of ε² apart, so
//! the sag of a straight path between two states and the lag behind the schedule must shrink like ε² too. Hence the
//! tolerance of these increments falls with the square of what is left, and each is recorded as a frame of its own.

use super::options::DynamicOptions;
use crate::{Schedule, Stage};

/// The largest turn of a target in one increment, radians (1.5°: that of 240 frames), so that the path does not depend
/// on how few frames are recorded.
const LARGEST_TURN: f64 = std::f64::consts::PI / 120.0 * (1.0 + 1e-9);

/// What a closing increment leaves of the turn that was left.
const CLOSING_RATIO: f64 = 0.7;

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
    let uniform = (1..total).map(|index| Increment {
        end: index as f64 / total as f64,
        tolerance: options.ramp_tolerance,
        is_recorded: index.is_multiple_of(per_frame),
    });
    let mut increments: Vec<_> = uniform.collect();
    if stage == Stage::Fold {
        increments.extend(closing(turn, 1.0 / total as f64, options));
    }
    increments
}

#[expect(clippy::cast_sign_loss, reason = "a largest magnitude is not negative")]
fn per_frame(turn: f64) -> usize {
    ((turn / LARGEST_TURN).ceil() as usize).max(1)
}

/// The closing increments of a stage that turns by `turn`, of which the share `left` is left.
fn closing(turn: f64, left: f64, options: &DynamicOptions) -> impl Iterator<Item = Increment> {
    let ratios = std::iter::successors(Some(CLOSING_RATIO), |ratio| Some(ratio * CLOSING_RATIO));
    ratios
        .take_while(move |ratio| turn * left * ratio > CLOSED_TURN)
        .map(move |ratio| Increment {
            end: 1.0 - left * ratio,
            tolerance: (options.ramp_tolerance * ratio * ratio).max(options.tolerance),
            is_recorded: true,
        })
}
