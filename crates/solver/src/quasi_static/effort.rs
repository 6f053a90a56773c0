//! What the work of a run went into.

/// What the Newton steps of a run were spent on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Effort {
    /// Steps with the factor of an earlier one.
    pub chord_steps: usize,
    /// Steps shortened because layers would have come too close.
    pub cut_steps: usize,
    /// Halvings of steps that did not lower the energy.
    pub halvings: usize,
    /// Matrices found not to be positive definite.
    pub indefinite: usize,
    /// Rounds in which steps found the pairs that they would bring too close.
    pub rounds: usize,
    /// Updates of the multipliers of contact.
    pub multiplier_updates: usize,
    /// Searches for pairs that can meet.
    pub searches: usize,
}
