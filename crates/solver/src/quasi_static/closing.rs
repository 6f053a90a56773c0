//! How the gap closes at the end of the motion.
//!
//! In the compact state layers lie on each other, and with a gap between them the stack is thicker than the closed
//! form says, or stays open. So the gap shrinks towards the end of stage fold, g(s) = g ((1 − s)/c)² for s > 1 − c,
//! and no further than the final gap. It shrinks as the square of what is left of the folding, as the distance does of
//! vertices that meet in the flat stack: layers that would not touch without a gap do not touch with it either before
//! the final gap is reached.

use crate::Stage;

/// c, the share of stage fold in which the gap shrinks.
const CLOSING: f64 = 0.1;
/// While more of the stage is left than twice this, load steps take at most half of it: what a step bends from its
/// straight path is then a fixed share of the gap.
const LAST_STEP: f64 = 4e-3;

/// The gap over stage-local time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Closing {
    gap: f64,
    final_gap: f64,
}

impl Closing {
    /// From `gap` to `final_gap`; `None` where there is nothing to close.
    pub(super) fn new(stage: Stage, gap: f64, final_gap: f64) -> Option<Self> {
        (stage == Stage::Fold && final_gap < gap).then_some(Self { gap, final_gap })
    }

    /// g at `s`.
    pub(super) fn gap_at(&self, s: f64) -> f64 {
        let open = ((1.0 - s) / CLOSING).clamp(0.0, 1.0);
        (self.gap * open * open).max(self.final_gap)
    }

    /// The latest end of a load step from `s`.
    pub(super) fn latest_end(s: f64) -> f64 {
        let half = 0.5 * (1.0 - s);
        if half > LAST_STEP { s + half } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gap_falls_from_the_whole_to_the_final_one_and_stays_whole_before() {
        let closing = Closing::new(Stage::Fold, 1e-3, 1e-5).unwrap();
        assert_eq!(closing.gap_at(0.0), 1e-3);
        assert!((closing.gap_at(1.0 - CLOSING) - 1e-3).abs() < 1e-15);
        assert_eq!(closing.gap_at(1.0), 1e-5);
        let gaps: Vec<f64> = (0..=100).map(|k| closing.gap_at(f64::from(k) / 100.0)).collect();
        assert!(gaps.windows(2).all(|pair| pair[1] <= pair[0]));
    }

    #[test]
    fn a_constant_gap_and_stage_unfold_do_not_close() {
        assert!(Closing::new(Stage::Fold, 1e-3, 1e-3).is_none());
        assert!(Closing::new(Stage::Unfold, 1e-3, 1e-5).is_none());
    }

    #[test]
    fn load_steps_halve_what_is_left_until_little_is() {
        let mut s = 0.0;
        let mut steps = 0;
        while s < 1.0 {
            s = Closing::latest_end(s);
            steps += 1;
        }
        assert_eq!(steps, 8);
    }
}
