//! `motion.budget`: how much work the engine may do before the motion ends where it is.

use std::str::FromStr;
use std::time::{Duration, Instant};

use foldmotion_solver::Budget;

use super::input::Input;
use crate::StudyError;
use crate::scene::BudgetScene;

/// The longest time in seconds: a hundred years.
const MOST_SECONDS: f64 = 3.2e9;

/// A limit of the work of the engine. The motion that it reached by then is checked and recorded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MotionBudget {
    /// Seconds of wall-clock time for all runs of the engine together. Where the motion ends then depends on the machine.
    Seconds(f64),
    /// Newton iterations of the quasi-static engine, or steps of the dynamic one, in each run of the engine.
    Steps(u64),
}

impl MotionBudget {
    /// The budget of an engine that starts now.
    pub(crate) fn start(self) -> Budget {
        match self {
            Self::Steps(steps) => Budget::Steps(steps),
            Self::Seconds(seconds) => {
                let duration = Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX);
                Instant::now().checked_add(duration).map_or(Budget::Standard, Budget::Until)
            }
        }
    }

    fn seconds(seconds: f64) -> Result<Self, String> {
        if seconds > 0.0 && seconds <= MOST_SECONDS {
            Ok(Self::Seconds(seconds))
        } else {
            Err(format!("seconds must be above 0 and at most {MOST_SECONDS:e}"))
        }
    }
}

impl FromStr for MotionBudget {
    type Err = String;

    /// Parses `60`, `60 s`, `60 seconds` or `20000 steps`.
    fn from_str(text: &str) -> Result<Self, String> {
        let text = text.trim();
        let split =
            text.find(|c: char| c.is_alphabetic() && c != 'e' && c != 'E').unwrap_or(text.len());
        let (number, unit) = (text[..split].trim(), &text[split..]);
        let wrong =
            || format!("{text:?} is neither seconds (60 s) nor a number of steps (20000 steps)");
        match unit {
            "" | "s" | "second" | "seconds" => Self::seconds(number.parse().map_err(|_| wrong())?),
            "step" | "steps" => match number.parse() {
                Ok(0) => Err("at least one step is needed".to_owned()),
                Ok(steps) => Ok(Self::Steps(steps)),
                Err(_) => Err(wrong()),
            },
            _ => Err(wrong()),
        }
    }
}

pub(crate) fn budget(input: &Input<'_>) -> Result<Option<MotionBudget>, StudyError> {
    let budget = match &input.scene.motion.budget {
        None => return Ok(None),
        Some(BudgetScene::Seconds(seconds)) => MotionBudget::seconds(*seconds),
        Some(BudgetScene::Words(words)) => words.parse(),
    };
    budget.map(Some).map_err(|message| input.error("motion.budget", message))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_and_steps_are_accepted_and_nothing_else() {
        for text in ["60", "60 s", "6e1 seconds", " 60s "] {
            assert_eq!(text.parse(), Ok(MotionBudget::Seconds(60.0)), "{text}");
        }
        assert_eq!("20000 steps".parse(), Ok(MotionBudget::Steps(20_000)));
        for text in
            ["", "s", "-1", "0", "0 steps", "1.5 steps", "nan", "inf", "1 h", "1e300 s", "steps 5"]
        {
            assert!(text.parse::<MotionBudget>().is_err(), "{text}");
        }
    }
}
