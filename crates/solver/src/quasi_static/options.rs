//! The options of a quasi-static run.

use super::{Contact, SnapControl, Support};
use crate::{Budget, SolverError, Stage};

/// The options of [`super::run_quasi_static`].
#[derive(Debug, Clone, PartialEq)]
pub struct QuasiStaticOptions {
    /// The stages to run, in the order of the motion.
    pub stages: Vec<Stage>,
    /// N, even: the states at t = 2k/N are recorded.
    pub frames: usize,
    /// Further motion times at which the state is recorded; those outside the stages are passed over.
    pub extra_times: Vec<f64>,
    /// Whether the load steps between them are recorded too.
    pub record_load_steps: bool,
    /// A state is an equilibrium where the largest nodal force is at most this times the force scale (see
    /// [`super::force_scale`]), rounding aside; with contact, at most a thousand times that.
    pub tolerance: f64,
    /// Newton steps taken at one load step before it is shortened.
    pub max_iterations: usize,
    /// Newton steps allowed in a stage, over the number of states it records or 120 if that is more: after as many it
    /// is [stopped](super::StopReason::OutOfIterations). Most sheets take 5, a near-rigid one that yields bit by bit
    /// 30.
    pub iterations_a_step: usize,
    /// Iterations or time allowed in the whole run, in the place of [`Self::iterations_a_step`].
    pub budget: Budget,
    /// Contact of the layers; none lets them pass through each other.
    pub contact: Option<Contact>,
    /// How the rigid motion of the sheet is determined in a Newton step.
    pub support: Support,
    /// How the sheet passes through snaps.
    pub snap_control: SnapControl,
}

impl Default for QuasiStaticOptions {
    fn default() -> Self {
        Self {
            stages: Stage::ALL.to_vec(),
            frames: 240,
            extra_times: Vec::new(),
            record_load_steps: false,
            tolerance: 1e-9,
            max_iterations: 60,
            iterations_a_step: 300,
            budget: Budget::Standard,
            contact: None,
            support: Support::default(),
            snap_control: SnapControl::default(),
        }
    }
}

impl QuasiStaticOptions {
    /// The largest number of frames taken.
    pub const MAX_FRAMES: usize = 100_000;

    /// The first option out of range, as an error.
    pub(super) fn validate(&self) -> Result<(), SolverError> {
        if self.frames < 2 || self.frames % 2 == 1 || self.frames > Self::MAX_FRAMES {
            return Err(SolverError::Frames { frames: self.frames, maximum: Self::MAX_FRAMES });
        }
        positive("tolerance", self.tolerance)?;
        positive("max_iterations", self.max_iterations as f64)?;
        positive("iterations_a_step", self.iterations_a_step as f64)
    }
}

fn positive(name: &'static str, value: f64) -> Result<(), SolverError> {
    if value.is_finite() && value > 0.0 { Ok(()) } else { Err(SolverError::Option { name, value }) }
}
