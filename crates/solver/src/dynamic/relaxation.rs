//! Settling: dynamic relaxation, the motion under a viscous damping that suits its slowest part.
//!
//! The dampers along the bars act on relative velocities, so they hardly damp the fast modes of a sheet and choke its
//! long soft ones, which then creep. Where only the equilibrium is wanted they are replaced by a force −c v on every
//! node with c = 2 √λ, critical for the mode that moves at present, whose stiffness is the Rayleigh quotient
//!
//! λ = −Δx·ΔF / Δx·Δx
//!
//! of the last step (Papadrakakis 1981, "A method for the automatic evaluation of the dynamic relaxation parameters";
//! Underwood 1983, "Dynamic relaxation"). With velocities centred between the steps,
//!
//! v ← ((1 − c Δt/2) v + Δt F) / (1 + c Δt/2),  x ← x + Δt v,
//!
//! is stable for every c ≥ 0 where the undamped steps are. The equilibrium does not depend on c or on the masses.

use super::State;
use super::recorder::PATH_STEP;
use super::stability::SAFETY;

/// Steps between two checks of the residual.
const STEPS_A_LOOK: u64 = 10;

/// Steps between two evaluations of the time step.
const STEPS_A_BOUND: u64 = 100;

/// With every mass the row sum of its node the bound on the time step is 2.
pub(super) const DT: f64 = 2.0 * SAFETY;

/// The state of a relaxation after a check of the residual.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Progress {
    /// Residual and speed lie below the tolerance.
    Settled,
    /// The residual is still above the tolerance.
    Moving,
}

/// A relaxation in progress: the state it moves and its memory of the last step.
#[derive(Debug)]
pub(super) struct Relaxation<'a, 'm> {
    state: &'a mut State<'m>,
    tolerance: f64,
    history: StepHistory,
    was_below: bool,
}

/// The damping, the time step and the number of the steps so far.
#[derive(Debug, Clone, Copy)]
pub(super) struct StepHistory {
    /// c and Δt of the last one.
    pub(super) damping: f64,
    pub(super) dt: f64,
    /// The number of steps taken.
    steps: u64,
}

impl StepHistory {
    /// The state before the first step.
    pub(super) const NONE: Self = Self { damping: 0.0, dt: DT, steps: 0 };
}

impl<'a, 'm> Relaxation<'a, 'm> {
    /// Starts to settle `state` to `tolerance`, without the dampers of its bars.
    pub(super) fn new(state: &'a mut State<'m>, tolerance: f64) -> Self {
        Self::resumed(state, tolerance, StepHistory::NONE)
    }

    /// Goes on after the steps of `history`.
    pub(super) fn resumed(state: &'a mut State<'m>, tolerance: f64, history: StepHistory) -> Self {
        state.damping = 0.0;
        Self { state, tolerance, history, was_below: false }
    }

    /// The history that the relaxation adapts to.
    pub(super) fn history(&self) -> StepHistory {
        self.history
    }

    /// Steps taken so far.
    pub(super) fn steps(&self) -> u64 {
        self.history.steps
    }

    /// The state as it moves.
    pub(super) fn state(&self) -> &State<'m> {
        self.state
    }

    /// Steps to the next check of the residual, or until a node may have gone [`PATH_STEP`].
    ///
    /// # Errors
    /// The node that ran away, with its displacement in one step.
    pub(super) fn advance(&mut self) -> Result<Progress, (usize, f64)> {
        let mut displacement = 0.0;
        for _ in 0..STEPS_A_LOOK {
            displacement += self.step()?;
            if displacement > PATH_STEP {
                self.was_below = false;
                return Ok(Progress::Moving);
            }
        }
        let speed = self.state.largest_speed();
        let is_below = self.state.residual() <= self.tolerance && speed * DT <= self.tolerance;
        // Twice in a row: a sheet that swings through its equilibrium is below once.
        let progress =
            if is_below && self.was_below { Progress::Settled } else { Progress::Moving };
        self.was_below = is_below;
        Ok(progress)
    }

    /// The state, to be moved from outside between two steps.
    pub(super) fn state_mut(&mut self) -> &mut State<'m> {
        self.state
    }

    /// One step, and a bound on the displacement of any node.
    ///
    /// # Errors
    /// As [`Self::advance`].
    pub(super) fn step(&mut self) -> Result<f64, (usize, f64)> {
        if self.history.steps.is_multiple_of(STEPS_A_BOUND) {
            self.state.scale_masses();
        }
        if self.history.steps > 1 {
            self.history.damping = self.critical_damping();
        }
        self.history.steps += 1;
        // No node goes far in a step, so that its path is seen.
        self.history.dt = DT.min(PATH_STEP / self.state.largest_speed());
        self.state.step_with(self.history.dt, self.history.damping)
    }

    /// 2 √λ of the last step; the damping as it was where nothing moved.
    fn critical_damping(&self) -> f64 {
        let work = self.state.sum(|totals| totals.work);
        let path = self.state.sum(|totals| totals.path);
        if path > 0.0 {
            2.0 * (work / (path * self.history.dt)).max(0.0).sqrt()
        } else {
            self.history.damping
        }
    }
}
