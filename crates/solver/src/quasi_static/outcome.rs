//! What a quasi-static run returns.

use foldmotion_pattern::Frame;

use super::effort::Effort;
use super::newton::SearchOutcome;
use super::release::Release;
use super::snap::Snap;
use crate::{EnergyByKind, Stage};

/// The motion and how it was found.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct QuasiStaticRun {
    /// The frames in order of time, positions in the sheet's unit: the states at t = 2k/frames and at the requested
    /// times, and states between where the straight path from one to the next would lead through contact. Those up to
    /// the last state reached.
    pub frames: Vec<Frame>,
    /// Figures of each frame.
    pub figures: Vec<FrameFigures>,
    /// One for each stage begun.
    pub stages: Vec<StageOutcome>,
    /// The state in which contact stopped the motion, if it did.
    pub jam: Option<Jam>,
    /// How far off creases end with contact and without it, of a sheet that passes through snaps and ends off its targets
    /// where layers push.
    pub release: Option<Release>,
    /// Numeric factorisations in all.
    pub factorisations: usize,
    /// Symbolic analyses in all: one, and one each time contact couples nodes for the first time.
    pub analyses: usize,
    /// What Newton's method did.
    pub effort: Effort,
    /// The gap that layers keep in the last state, in unit lengths; `None` without contact.
    pub gap_reached: Option<f64>,
}

impl QuasiStaticRun {
    /// Whether every stage was run to its end in equilibrium and contact stopped none.
    pub fn is_complete(&self) -> bool {
        self.jam.is_none() && self.stages.iter().all(|stage| stage.converged)
    }
}

/// Figures of one frame, in the model's units.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FrameFigures {
    /// Energy of bars and hinges.
    pub energy: EnergyByKind,
    /// Energy of the contact between layers.
    pub contact_energy: f64,
    /// Pairs of primitives that push on each other.
    pub contacts: usize,
    /// The sum of the forces with which they push.
    pub contact_force: f64,
    /// The largest |θ − θ*| of a crease, radians.
    pub fold_angle_error: f64,
}

/// The outcome of a stage.
#[derive(Debug, Clone, PartialEq)]
pub struct StageOutcome {
    /// The stage of the motion.
    pub stage: Stage,
    /// Whether it was run to its end and ended in equilibrium.
    pub converged: bool,
    /// t of the last state.
    pub reached: f64,
    /// The largest nodal force left at any accepted load step; where the stage did not converge, that left by the
    /// last attempt.
    pub residual: f64,
    /// The number of load steps that were accepted.
    pub load_steps: usize,
    /// Load steps that found no equilibrium and were tried again shorter.
    pub shortened_steps: usize,
    /// The snaps, in order of time.
    pub snaps: Vec<Snap>,
    /// Newton iterations, those of failed load steps included.
    pub iterations: usize,
    /// The reason why the stage stopped before its end; `None` if it converged.
    pub stop: Option<Stop>,
}

/// A stage ended before its end, or not in equilibrium, in the state at [`StageOutcome::reached`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// The reason why the stage ended.
    pub reason: StopReason,
    /// The motion time of the last equilibrium if none was found further on; states after it are on the way to the next
    /// one. If a budget ended the stage, that of its last state.
    pub time: f64,
    /// The last load step tried, in motion time: no equilibrium was found this far on.
    pub step: f64,
    /// The largest nodal force that the search left there, in the model's units.
    pub residual: f64,
    /// At most this much counts as equilibrium.
    pub tolerance: f64,
}

/// Why a stage ended before its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StopReason {
    /// No equilibrium was found, however short the load step.
    NoEquilibrium,
    /// The iterations of [`super::QuasiStaticOptions::iterations_a_step`], or of the budget, were used up.
    OutOfIterations,
    /// The time of the budget was used up.
    OutOfTime,
}

impl StopReason {
    pub(super) fn of(is_late: bool, is_spent: bool) -> Self {
        if is_late {
            Self::OutOfTime
        } else if is_spent {
            Self::OutOfIterations
        } else {
            Self::NoEquilibrium
        }
    }
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
            snaps: Vec::new(),
            iterations: 0,
            stop: None,
        }
    }

    /// The motion time of the last equilibrium.
    pub(super) fn last_equilibrium(&self) -> f64 {
        let open = self.snaps.last().filter(|snap| !snap.is_over);
        open.map_or(self.reached, |snap| snap.from)
    }

    pub(super) fn add(&mut self, settled: &SearchOutcome) {
        self.iterations += settled.iterations;
        if settled.converged {
            self.load_steps += 1;
            self.residual = self.residual.max(settled.residual);
        } else {
            self.shortened_steps += 1;
        }
    }
}

/// Contact stopped the motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Jam {
    /// From this motion time on the creases do not follow their targets.
    pub time: f64,
    /// The largest |θ − θ*| of a crease where the motion ended, radians.
    pub fold_angle_error: f64,
    /// The pairs of triangles that push hardest there, hardest first, with the force.
    pub blocking: Vec<([u32; 2], f64)>,
}
