//! The control of the length of load steps.

use super::newton::SearchOutcome;

/// A load step that settled within this many iterations is followed by a longer one.
const EASY_ITERATIONS: usize = 10;
/// After one that took more factorisations than this, shorter ones lead on faster: what they are extrapolated to is
/// nearer.
const COSTLY_FACTORISATIONS: usize = 8;
const MOST_SHORTENED: f64 = 8.0;
/// A stage has at least as many load steps as with 240 frames, so that the path does not depend on how few frames are
/// recorded.
const LEAST_STEPS: usize = 120;
/// By which load steps grow and shrink.
const STEP_FACTOR: f64 = 2.0;
/// Load steps shortened to this share of the longest are given the budget of a snap.
const SNAP_STEP: f64 = 0.1;
/// No load step is shortened below this share of the longest. Where equilibria follow each other so closely that each
/// takes many factorisations however near it is, as in a near-rigid sheet that yields bit by bit, steps would
/// otherwise shrink until time stands still.
const LEAST_STEP: f64 = 1e-3;

/// The length of the load steps of one stage, in stage-local time.
#[derive(Debug, Clone)]
pub(super) struct StepControl {
    least_steps: usize,
    longest: f64,
    length: f64,
}

impl StepControl {
    /// The step control of a stage with `frames` / 2 recorded states.
    pub(super) fn new(frames: usize) -> Self {
        let least_steps = LEAST_STEPS.max(frames / 2);
        let longest = 1.0 / least_steps as f64;
        Self { least_steps, longest, length: longest }
    }

    /// The number of load steps of the stage if all have the largest length.
    pub(super) fn least_steps(&self) -> usize {
        self.least_steps
    }

    /// The end of the load step from `s`, and whether that is `goal`.
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
    pub(super) fn adapt(&mut self, settled: &SearchOutcome, in_contact: bool) {
        self.set(self.length * growth(settled, in_contact));
    }

    fn set(&mut self, length: f64) {
        self.length = length.clamp(LEAST_STEP * self.longest, self.longest);
    }
}

/// By how much longer the next load step may be.
fn growth(settled: &SearchOutcome, in_contact: bool) -> f64 {
    let excess = settled.factorisations as f64 / COSTLY_FACTORISATIONS as f64;
    if excess > 1.0 && !in_contact {
        1.0 / excess.min(MOST_SHORTENED)
    } else if settled.iterations <= EASY_ITERATIONS {
        STEP_FACTOR
    } else {
        1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settled(iterations: usize) -> SearchOutcome {
        SearchOutcome { converged: true, residual: 0.0, iterations, factorisations: iterations }
    }

    #[test]
    fn steps_that_stay_costly_however_short_end_the_stage_all_the_same() {
        for frames in [2, 180, 240, 100_000] {
            let mut load_steps = StepControl::new(frames);
            let most = 1_000 * load_steps.least_steps() + 1;
            let (mut s, mut steps) = (0.0, 0);
            while s < 1.0 && steps <= most {
                s = load_steps.next(s, 1.0).0;
                load_steps.adapt(&settled(1_000), false);
                steps += 1;
            }
            assert!(s == 1.0 && steps > most / 2, "{frames}: {s} {steps}");
        }
    }

    #[test]
    fn steps_that_fail_become_short_and_shrink_no_further_than_the_floor() {
        let mut load_steps = StepControl::new(240);
        let mut failures = 0;
        while !load_steps.is_short() {
            load_steps.shorten(load_steps.next(0.0, 1.0).0);
            failures += 1;
        }
        assert_eq!(failures, 4);
        for _ in 0..100 {
            load_steps.shorten(load_steps.next(0.0, 1.0).0);
        }
        let least = load_steps.next(0.0, 1.0).0;
        assert!((least - LEAST_STEP / 120.0).abs() < 1e-15, "{least}");
    }

    #[test]
    fn easy_steps_grow_to_the_spacing_of_frames_and_no_further() {
        let mut load_steps = StepControl::new(480);
        load_steps.shorten(1e-9);
        for _ in 0..100 {
            load_steps.adapt(&settled(2), false);
        }
        assert_eq!(load_steps.next(0.0, 1.0), (1.0 / 240.0, false));
    }
}
