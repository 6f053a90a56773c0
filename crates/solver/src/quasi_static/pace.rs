//! How long load steps are.

use super::newton::Settled;

/// A load step that settled within this many iterations is followed by a longer one.
const EASY_ITERATIONS: usize = 10;
/// After one that took more factorisations than this, shorter ones lead on faster: what they are extrapolated to is nearer.
const COSTLY_FACTORISATIONS: usize = 8;
const MOST_SHORTENED: f64 = 8.0;
/// The longest load step, in stage-local time: as long as that of 240 frames, so that the path does not depend on how few
/// frames are recorded.
const LONGEST_STEP: f64 = 1.0 / 120.0;
/// By which load steps grow and shrink.
const STEP_FACTOR: f64 = 2.0;
/// Load steps shortened to this share of the longest are given the budget of a snap.
const SNAP_STEP: f64 = 0.1;
/// No load step is shortened below this share of the longest. Where equilibria follow each other so closely that each
/// takes many factorisations however short the way to it, as in a near-rigid sheet that gives way bit by bit, steps would
/// otherwise shrink until time stands still.
const LEAST_STEP: f64 = 1e-3;

/// The length of the load steps of one stage, in stage-local time.
#[derive(Debug, Clone)]
pub(super) struct Pace {
    longest: f64,
    length: f64,
    in_contact: bool,
}

impl Pace {
    /// Of a stage of which `frames` / 2 states are recorded.
    pub(super) fn new(frames: usize, in_contact: bool) -> Self {
        let longest = LONGEST_STEP.min(2.0 / frames as f64);
        Self {
            longest,
            length: longest,
            in_contact,
        }
    }

    /// How many of the longest steps the stage is long.
    pub(super) fn longest_steps(&self) -> usize {
        (1.0 / self.longest).ceil() as usize
    }

    /// Where the load step from `s` ends, and whether that is `goal`.
    pub(super) fn next(&self, s: f64, goal: f64) -> (f64, bool) {
        // A step that would leave less than half of itself before the frame is stretched to it.
        let reaches = goal - s <= 1.5 * self.length;
        (if reaches { goal } else { s + self.length }, reaches)
    }

    /// Whether steps are so short that the sheet is taken to snap.
    pub(super) fn is_short(&self) -> bool {
        self.length <= SNAP_STEP * self.longest
    }

    /// Shortens the steps after one of `length` found no equilibrium.
    pub(super) fn shorten(&mut self, length: f64) {
        self.set(length / STEP_FACTOR);
    }

    /// Lengthens or shortens the steps by what the last one, which found one, took.
    pub(super) fn adapt(&mut self, settled: &Settled) {
        self.set(self.length * self.growth(settled));
    }

    fn set(&mut self, length: f64) {
        self.length = length.clamp(LEAST_STEP * self.longest, self.longest);
    }

    /// By how much longer the next load step may be.
    fn growth(&self, settled: &Settled) -> f64 {
        let excess = settled.factorisations as f64 / COSTLY_FACTORISATIONS as f64;
        if excess > 1.0 && !self.in_contact {
            1.0 / excess.min(MOST_SHORTENED)
        } else if settled.iterations <= EASY_ITERATIONS {
            STEP_FACTOR
        } else {
            1.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settled(iterations: usize) -> Settled {
        Settled {
            converged: true,
            residual: 0.0,
            iterations,
            factorisations: iterations,
        }
    }

    #[test]
    fn steps_that_stay_costly_however_short_end_the_stage_all_the_same() {
        for frames in [2, 180, 240, 100_000] {
            let mut pace = Pace::new(frames, false);
            let most = (1.0 / LEAST_STEP) as usize * pace.longest_steps() + 1;
            let (mut s, mut steps) = (0.0, 0);
            while s < 1.0 && steps <= most {
                s = pace.next(s, 1.0).0;
                pace.adapt(&settled(1_000));
                steps += 1;
            }
            assert!(s == 1.0 && steps > most / 2, "{frames}: {s} {steps}");
        }
    }

    #[test]
    fn steps_that_fail_become_short_and_shrink_no_further_than_the_floor() {
        let mut pace = Pace::new(240, true);
        let mut failures = 0;
        while !pace.is_short() {
            pace.shorten(pace.next(0.0, 1.0).0);
            failures += 1;
        }
        assert_eq!(failures, 4);
        for _ in 0..100 {
            pace.shorten(pace.next(0.0, 1.0).0);
        }
        let least = pace.next(0.0, 1.0).0;
        assert!((least - LEAST_STEP * LONGEST_STEP).abs() < 1e-15, "{least}");
    }

    #[test]
    fn easy_steps_grow_to_the_spacing_of_frames_and_no_further() {
        let mut pace = Pace::new(480, false);
        pace.shorten(1e-9);
        for _ in 0..100 {
            pace.adapt(&settled(2));
        }
        assert_eq!(pace.next(0.0, 1.0), (1.0 / 240.0, false));
    }
}
