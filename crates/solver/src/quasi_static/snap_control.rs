//! How the engine treats a sheet that leaves its equilibrium, and what follows from that for its searches.

/// What becomes of a load step that finds no equilibrium in the iterations allowed to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SnapControl {
    /// It is taken again, shorter and at last with many more iterations: every recorded state is an equilibrium.
    #[default]
    Settle,
    /// It is kept as it is: the sheet is in motion towards its next equilibrium, downhill, while the load goes on. Only
    /// the end of a stage is sought for as long as it takes. All states are found as accurately as those in contact.
    PassThrough,
}

impl SnapControl {
    /// κ g of contact, over what the sheet pushes with. Multipliers carry the rest: the stiffer the planes, the more rounds
    /// it takes to find which of them push. A snap presses layers together harder, before multipliers have grown.
    pub(super) fn contact_share(self) -> f64 {
        match self {
            Self::Settle => 0.1,
            Self::PassThrough => 1.0,
        }
    }

    /// Rounds in which the planes of contact that push after a Newton step are found. A sheet on the way through a snap is
    /// better off with more steps.
    pub(super) fn most_rounds(self) -> usize {
        match self {
            Self::Settle => 20,
            Self::PassThrough => 6,
        }
    }

    /// The energy that a balanced sheet may still lose in a step, as a share of it; 0: what rounding hides.
    pub(super) fn level(self) -> f64 {
        match self {
            Self::Settle => 0.0,
            Self::PassThrough => 1e-9,
        }
    }

    /// Whether load steps that find no equilibrium are kept.
    pub(super) fn passes_through(self) -> bool {
        self == Self::PassThrough
    }
}
