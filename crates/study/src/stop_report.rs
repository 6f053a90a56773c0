//! A motion that ended before its end, in `report.json` and on the terminal.

use foldmotion_geometry::Number;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::engine::StageSummary;

/// The engine stopped before the end of the motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StopReport {
    /// Motion time of the last state reached; later ones were not computed.
    pub t: f64,
    /// no-equilibrium: none was found further on, however short the load step; out-of-steps: the budget of steps or
    /// iterations was used up before one was.
    pub reason: String,
    /// The load step that the quasi-static engine tried last, in motion time; null for the dynamic engine.
    pub load_step: Option<f64>,
    /// Unbalanced force left by the last attempt, as the engine states it.
    pub residual: f64,
    /// At most this much of it counts as equilibrium.
    pub residual_tolerance: f64,
}

impl StopReport {
    /// What ended `stage` before its end, if anything did.
    pub(crate) fn of(stage: &StageSummary) -> Option<Self> {
        let stop = stage.stop?;
        let reason = if stop.is_out_of_steps {
            "out-of-steps"
        } else {
            "no-equilibrium"
        };
        Some(Self {
            t: stage.reached,
            reason: reason.to_owned(),
            load_step: stop.step,
            residual: stop.residual,
            residual_tolerance: stop.tolerance,
        })
    }

    /// Where and why, in a few words.
    pub fn words(&self) -> String {
        let budget = if self.reason == "out-of-steps" {
            " within the budget of steps"
        } else {
            ""
        };
        format!("stopped at t = {:.4}, no equilibrium found{budget}", self.t)
    }

    /// The evidence, a line for the terminal.
    pub(crate) fn line(&self) -> String {
        let step = self.load_step.map_or_else(String::new, |step| {
            format!(" a load step of {:.2} on", Number(step))
        });
        format!(
            "{}: unbalanced force {:.2} left{step}, where {:.2} counts as equilibrium",
            self.words(),
            Number(self.residual),
            Number(self.residual_tolerance)
        )
    }
}

#[cfg(test)]
mod tests {
    use foldmotion_solver::Stage;

    use super::*;
    use crate::engine::StopSummary;

    fn report(is_out_of_steps: bool, step: Option<f64>) -> Option<StopReport> {
        StopReport::of(&StageSummary {
            stage: Stage::Fold,
            converged: false,
            reached: 1.25,
            residual: 0.5,
            steps: 7,
            load_steps: None,
            stop: Some(StopSummary {
                is_out_of_steps,
                step,
                residual: 0.5,
                tolerance: 1e-9,
            }),
        })
    }

    #[test]
    fn a_stop_is_told_with_its_time_its_reason_and_its_evidence() {
        let none = report(false, Some(1e-5)).map(|stop| stop.line());
        let none = none.unwrap_or_default();
        assert_eq!(
            none,
            "stopped at t = 1.2500, no equilibrium found: unbalanced force 0.5 left a load step of 1e-5 on, where \
             1e-9 counts as equilibrium"
        );
        let spent = report(true, None).map(|stop| stop.line());
        assert_eq!(
            spent.unwrap_or_default(),
            "stopped at t = 1.2500, no equilibrium found within the budget of steps: unbalanced force 0.5 left, where \
             1e-9 counts as equilibrium"
        );
    }
}
