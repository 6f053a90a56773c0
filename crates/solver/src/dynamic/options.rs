//! What the user can ask of the dynamic engine, and what it answers.

use foldmotion_pattern::Frame;

use crate::{Budget, SolverError, Stage};

/// The device on which a run computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Device {
    /// The processor, in f64.
    #[default]
    Cpu,
    /// A GPU, in f32, as far as that goes; the rest is the processor's. Needs the cargo feature `gpu`.
    Gpu,
    /// A GPU that is none in software, for sheets large enough; else the processor.
    Auto,
}

impl Device {
    /// Sheets of fewer nodes are left to the processor by [`Self::Auto`]: a step of theirs takes it less than the
    /// handing over of a submission and its result.
    pub const AUTO_NODES: usize = 50_000;
}

/// Options of [`run`](super::run).
#[derive(Debug, Clone, PartialEq)]
pub struct DynamicOptions {
    /// The stages to run, in the order of the motion.
    pub stages: Vec<Stage>,
    /// The device on which the sheet is moved.
    pub device: Device,
    /// The motion is recorded at t = 2k/frames, k = 0 … frames; even, at least 2.
    pub frames: usize,
    /// Further motion times at which the state is recorded; those outside the stages are passed over.
    pub extra_times: Vec<f64>,
    /// The residual at which the end of a stage counts as settled (see [`StageOutcome::residual`]).
    pub tolerance: f64,
    /// The residual to which the sheet settles after each increment of the ramp. Infinite: not at all, so that the
    /// sheet lags behind the schedule as in Origami Simulator.
    pub ramp_tolerance: f64,
    /// Damped steps over which each increment of the ramp is spread; at least 1.
    pub ramp_steps: usize,
    /// Settling steps allowed in each stage; ramp steps are not counted. A stage that needs more ends the run where it
    /// is.
    pub step_budget: u64,
    /// Steps of every kind or time allowed in the whole run, in the place of [`Self::step_budget`].
    pub budget: Budget,
}

impl DynamicOptions {
    /// The largest number of frames taken.
    pub const MAX_FRAMES: usize = 1_000_000;

    pub(super) fn validate(&self) -> Result<(), SolverError> {
        let (frames, maximum) = (self.frames, Self::MAX_FRAMES);
        if frames < 2 || !frames.is_multiple_of(2) || frames > maximum {
            return Err(SolverError::Frames { frames, maximum });
        }
        let ramp_steps = self.ramp_steps as f64;
        let numbers = [
            ("tolerance", self.tolerance, self.tolerance < f64::INFINITY),
            ("ramp_tolerance", self.ramp_tolerance, true),
            ("ramp_steps", ramp_steps, true),
        ];
        match numbers.into_iter().find(|&(_, value, is_bounded)| !(value > 0.0 && is_bounded)) {
            Some((name, value, _)) => Err(SolverError::Option { name, value }),
            None => Ok(()),
        }
    }
}

impl Default for DynamicOptions {
    fn default() -> Self {
        Self {
            stages: Stage::ALL.to_vec(),
            device: Device::Cpu,
            frames: 240,
            extra_times: Vec::new(),
            tolerance: 1e-8,
            ramp_tolerance: 1e-3,
            ramp_steps: 8,
            step_budget: 1_000_000,
            budget: Budget::Standard,
        }
    }
}

/// The status with which a stage ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StageStatus {
    /// The residual fell to the tolerance.
    Settled,
    /// The step budget ended first, and with it the run; the state reached is recorded all the same.
    OutOfSteps,
    /// The time of the budget ended first, and with it the run; the state reached is recorded all the same.
    OutOfTime,
}

/// The outcome of a stage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StageOutcome {
    /// The stage of the motion.
    pub stage: Stage,
    /// Whether it was run to its end and that is an equilibrium.
    pub status: StageStatus,
    /// t of its last state: the end of the stage, or where the step budget ended.
    pub reached: f64,
    /// The residual to which that state was to settle.
    pub tolerance: f64,
    /// The largest unbalanced force on a node in that state over the fold stiffness: how many radians out of balance a
    /// crease of unit length on an arm of unit length would have to be to make it.
    pub residual: f64,
    /// The largest |θ − θ*| of any hinge in that state, radians. A settled sheet whose targets fit together has none;
    /// one caught in another equilibrium, or driven to angles that contradict each other, has.
    pub fold_angle_error: f64,
    /// Steps taken, ramp and settling.
    pub steps: u64,
}

impl StageOutcome {
    /// Whether the stage ended in equilibrium.
    pub fn is_converged(&self) -> bool {
        self.status == StageStatus::Settled
    }
}

/// A computed motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// The states at t = 2k/frames; between them those by which the layers close at the end of `fold`, and the path the
    /// sheet took where settling at the end of a stage moved it visibly. Times increase strictly, positions are in
    /// the sheet's unit.
    pub frames: Vec<Frame>,
    /// One for each stage begun, in order.
    pub stages: Vec<StageOutcome>,
    /// The number of steps of the whole run.
    pub steps: u64,
    /// The device that moved the sheet: "cpu", or the name of the GPU.
    pub device: String,
}
