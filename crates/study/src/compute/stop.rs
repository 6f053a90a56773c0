//! The report of a motion that stopped before its end.

use foldmotion_geometry::Number;
use foldmotion_solver::quasi_static::StopReason;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A motion whose engine stopped before its end.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StopReport {
    /// The motion time of the last state reached; later states were not computed.
    pub t: f64,
    /// Why the engine stopped: no equilibrium, or a spent budget.
    pub reason: StopCause,
    /// The last load step that the quasi-static engine tried, in motion time; null for the dynamic engine.
    pub load_step: Option<f64>,
    /// The unbalanced force left by the last attempt, as the engine states it.
    pub residual: f64,
    /// At most this much unbalanced force counts as equilibrium.
    pub residual_tolerance: f64,
}

/// Why a stage ended before its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum StopCause {
    /// No equilibrium was found further on.
    NoEquilibrium,
    /// The budget of steps or iterations was used up.
    OutOfSteps,
    /// The budget of time was used up.
    OutOfTime,
}

impl From<StopReason> for StopCause {
    fn from(reason: StopReason) -> Self {
        match reason {
            StopReason::NoEquilibrium => Self::NoEquilibrium,
            StopReason::OutOfIterations => Self::OutOfSteps,
            StopReason::OutOfTime => Self::OutOfTime,
        }
    }
}

impl StopReport {
    /// The reason, as part of a sentence.
    pub fn words(&self) -> String {
        match self.reason {
            StopCause::OutOfSteps => {
                "the budget of steps was used up before the next equilibrium was found"
            }
            StopCause::OutOfTime => {
                "the budget of time was used up before the next equilibrium was found"
            }
            StopCause::NoEquilibrium => "no equilibrium was found further on",
        }
        .to_owned()
    }

    /// The evidence, as a line for the terminal.
    pub(crate) fn line(&self) -> String {
        let step = self.load_step.map_or_else(String::new, |step| {
            format!(" in the last attempt, a load step of {:.2}", Number(step))
        });
        format!(
            "unbalanced force left{step}: {:.2}; at most {:.2} counts as equilibrium",
            Number(self.residual),
            Number(self.residual_tolerance)
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report(reason: StopCause, load_step: Option<f64>) -> StopReport {
        StopReport { t: 1.25, reason, load_step, residual: 0.5, residual_tolerance: 1e-9 }
    }

    #[test]
    fn a_stop_is_reported_with_its_reason_and_its_evidence() {
        let none = report(StopCause::NoEquilibrium, Some(1e-5));
        assert_eq!(
            none.line(),
            "unbalanced force left in the last attempt, a load step of 1e-5: 0.5; at most 1e-9 counts as \
             equilibrium"
        );
        let spent = report(StopCause::OutOfSteps, None);
        assert_eq!(spent.line(), "unbalanced force left: 0.5; at most 1e-9 counts as equilibrium");
        assert!(spent.words().contains("steps"));
        let late = report(StopCause::OutOfTime, None);
        assert!(late.words().contains("time"), "{}", late.words());
    }
}
