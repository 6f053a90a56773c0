//! When a hinge turns within its stage, and how.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The course of a fold angle between the start and the end of its step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Ease {
    /// At constant speed: the share u of the time has made the share u of the turn.
    #[default]
    Linear,
    /// From rest to rest, by the cubic 3u² − 2u³; fastest in the middle, at 3/2 of the mean speed.
    Smooth,
}

/// The part of a stage in which a hinge turns, in stage-local time; before it and after it the hinge is held.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Timing {
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) ease: Ease,
}

impl Timing {
    /// The whole stage at constant speed.
    pub(crate) const UNIFORM: Self = Self { from: 0.0, to: 1.0, ease: Ease::Linear };

    /// The share of the turn made at stage-local time `s`.
    pub(crate) fn progress(&self, s: f64) -> f64 {
        self.eased(((s - self.from) / self.duration()).clamp(0.0, 1.0))
    }

    /// The share of the turn left with `time_left` of the stage to go.
    ///
    /// That is 1 − progress(1 − `time_left`), without the rounding near the end (both eases look the same from either
    /// end).
    pub(crate) fn share_left(&self, time_left: f64) -> f64 {
        self.eased(((time_left - self.end_left()) / self.duration()).clamp(0.0, 1.0))
    }

    /// The time left of the stage when the share `share_left` of the turn is left: the inverse of
    /// [`Self::share_left`] inside the step.
    pub(crate) fn time_left(&self, share_left: f64) -> f64 {
        let time = match self.ease {
            Ease::Linear => share_left,
            // The root in [0, 1] of 3u² − 2u³ = share, by the sine of a third of an angle.
            Ease::Smooth => 0.5 - ((1.0 - 2.0 * share_left).asin() / 3.0).sin(),
        };
        self.end_left() + self.duration() * time
    }

    /// The time left of the stage when the turn ends.
    pub(crate) fn end_left(&self) -> f64 {
        1.0 - self.to
    }

    /// The greatest rate of [`Self::progress`] between `start` and `end`, which lie on the same side of `from` and of
    /// `to`.
    pub(crate) fn steepest(&self, start: f64, end: f64) -> f64 {
        let middle = 0.5 * (start + end);
        if middle <= self.from || middle >= self.to {
            return 0.0;
        }
        match self.ease {
            Ease::Linear => 1.0 / self.duration(),
            Ease::Smooth => {
                let share = |s: f64| ((s - self.from) / self.duration()).clamp(0.0, 1.0);
                let nearest_middle = 0.5f64.max(share(start)).min(share(end));
                6.0 * nearest_middle * (1.0 - nearest_middle) / self.duration()
            }
        }
    }

    fn duration(&self) -> f64 {
        self.to - self.from
    }

    fn eased(&self, share: f64) -> f64 {
        match self.ease {
            Ease::Linear => share,
            Ease::Smooth => share * share * (3.0 - 2.0 * share),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEPS: [Timing; 3] = [
        Timing::UNIFORM,
        Timing { from: 0.2, to: 0.7, ease: Ease::Linear },
        Timing { from: 0.2, to: 0.7, ease: Ease::Smooth },
    ];

    #[test]
    fn the_share_left_complements_the_progress() {
        for timing in STEPS {
            for index in 0..=100 {
                let s = f64::from(index) / 100.0;
                let sum = timing.progress(s) + timing.share_left(1.0 - s);
                assert!((sum - 1.0).abs() < 1e-14, "{timing:?} at {s}: {sum}");
            }
        }
    }

    #[test]
    fn the_time_left_inverts_the_share_left() {
        for timing in STEPS {
            for share in [1e-9, 1e-4, 0.02, 0.3, 0.5, 0.9] {
                let back = timing.share_left(timing.time_left(share));
                assert!((back - share).abs() < 1e-12, "{timing:?}: {share} {back}");
            }
        }
    }

    #[test]
    fn no_part_turns_faster_than_its_steepest_rate_and_some_part_as_fast() {
        for timing in STEPS {
            for (start, end) in [(0.0, 0.2), (0.2, 0.3), (0.4, 0.5), (0.6, 0.7), (0.7, 1.0)] {
                let rate = |index: i32| {
                    let at = |i| start + (end - start) * f64::from(i) / 1000.0;
                    let change = timing.progress(at(index + 1)) - timing.progress(at(index));
                    change / (at(index + 1) - at(index))
                };
                let sampled = (0..1000).map(rate).fold(0.0, f64::max);
                let steepest = timing.steepest(start, end);
                assert!(
                    sampled <= steepest + 1e-9 && sampled >= 0.999 * steepest,
                    "{timing:?} from {start} to {end}: {steepest}, sampled {sampled}"
                );
            }
        }
    }
}
