//! What a quasi-static run returns.

use foldmotion_pattern::Frame;

use super::newton::Settled;
use crate::{EnergyByKind, Stage};

/// The motion and how it was found.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct QuasiStaticRun {
    /// In order of time, positions in the sheet's unit. Those up to the last state reached.
    pub frames: Vec<Frame>,
    /// The energy at each frame, in the model's units.
    pub energy: Vec<EnergyByKind>,
    /// One for each stage begun.
    pub stages: Vec<StageOutcome>,
    /// Numeric factorisations in all.
    pub factorisations: usize,
}

/// How a stage went.
#[derive(Debug, Clone, PartialEq)]
pub struct StageOutcome {
    /// Which one.
    pub stage: Stage,
    /// Whether every frame of the stage is an equilibrium.
    pub converged: bool,
    /// t of the last equilibrium.
    pub reached: f64,
    /// The largest nodal force left at any accepted load step, or at the failed one that ended the stage.
    pub residual: f64,
    /// Load steps accepted.
    pub load_steps: usize,
    /// Load steps that found no equilibrium and were tried again shorter.
    pub shortened_steps: usize,
    /// Newton iterations, those of failed load steps included.
    pub iterations: usize,
}

impl StageOutcome {
    pub(super) fn new(stage: Stage) -> Self {
        Self {
            stage,
            converged: false,
            reached: stage.start_time(),
            residual: 0.0,
            load_steps: 0,
            shortened_steps: 0,
            iterations: 0,
        }
    }

    pub(super) fn add(&mut self, settled: &Settled) {
        self.iterations += settled.iterations;
        if settled.converged {
            self.load_steps += 1;
            self.residual = self.residual.max(settled.residual);
        }
    }
}
