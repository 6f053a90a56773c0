//! How much work an engine may do.

use std::time::Instant;

/// The amount of work that a run may do before it ends in the state it has reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Budget {
    /// The default of the engine: some hundred Newton iterations a load step, or a million steps of settling a
    /// stage.
    #[default]
    Standard,
    /// This many in the whole run: Newton iterations of the quasi-static engine, steps of the dynamic one.
    Steps(u64),
    /// Until this moment. Where the run ends then depends on the machine.
    Until(Instant),
}

impl Budget {
    /// Whether its moment has passed.
    pub(crate) fn is_late(self) -> bool {
        matches!(self, Self::Until(end) if Instant::now() >= end)
    }

    /// How a search with `left` steps, from [`Self::left`], has to end.
    pub(crate) fn allowance(self, left: u64) -> Allowance {
        Allowance { steps: left, budget: self }
    }

    /// The steps left after `taken` steps of the run, if the default of the engine is `standard` more.
    pub(crate) fn left(self, standard: u64, taken: u64) -> u64 {
        match self {
            Self::Standard | Self::Until(_) => standard,
            Self::Steps(steps) => steps.saturating_sub(taken),
        }
    }
}

/// The steps that one search may take, and the moment at which it ends all the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Allowance {
    steps: u64,
    budget: Budget,
}

impl Allowance {
    /// Whether a search that has taken `steps` has to end.
    pub(crate) fn is_spent(&self, steps: u64) -> bool {
        steps >= self.steps || self.budget.is_late()
    }
}
