//! What limits the time step at one node.

/// The row sums of the block norms of the stiffness and of the damping matrix at a node.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct RowSums {
    pub(super) stiffness: f64,
    pub(super) damping: f64,
}

impl RowSums {
    /// The largest Δt that is stable for this row and unit masses; infinite for a node that nothing holds.
    pub(super) fn stable_time_step(self) -> f64 {
        let Self { stiffness, damping } = self;
        if stiffness > 0.0 {
            // (√(c² + 4k) − c) / k without its cancellation.
            4.0 / ((damping * damping + 4.0 * stiffness).sqrt() + damping)
        } else {
            f64::INFINITY
        }
    }
}
