//! A run with the GPU: it moves the sheet, the CPU's state follows and says how stiff the sheet is.

use glam::DVec3;

use super::{Gpu, GpuState};
use crate::budget::Allowance;
use crate::dynamic::State;
use crate::dynamic::recorder::PATH_STEP;
use crate::dynamic::relaxation::DT;
use crate::dynamic::state::MAX_DISPLACEMENT;
use crate::{Model, SolverError};

/// Steps between two readings of the residual; if the path is recorded, as many as on the CPU.
const STEPS_A_LOOK: usize = 100;
const STEPS_A_RECORDED_LOOK: usize = 10;
/// Units in the last place of an f32 position by which forces may be off: sums of some ten terms.
const ROUNDINGS: f64 = 8.0;

/// The sheet on the GPU, beside its state on the CPU.
#[derive(Debug)]
pub(in crate::dynamic) struct GpuDrive<'a> {
    state: GpuState<'a>,
    model: &'a Model,
}

/// The outcome of settling in f32.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamic) struct Rough {
    pub(in crate::dynamic) steps: u64,
    /// The tolerance of the residual.
    pub(in crate::dynamic) tolerance: f64,
    pub(in crate::dynamic) is_settled: bool,
}

impl<'a> GpuDrive<'a> {
    pub(in crate::dynamic) fn new(
        gpu: &'a Gpu,
        model: &'a Model,
        start: &[DVec3],
    ) -> Result<Self, SolverError> {
        Ok(Self { state: GpuState::at_rest(gpu, model, start)?, model })
    }

    /// Takes over from the CPU's state.
    pub(in crate::dynamic) fn load(&mut self, cpu: &State<'_>) {
        self.state.set_positions(&cpu.positions());
        self.state.set_velocities(&cpu.velocities());
        self.state.set_angles(&cpu.angles());
        self.state.set_targets(&cpu.targets());
        self.state.set_masses(&cpu.masses());
    }

    /// A step with the dampers of the bars.
    pub(in crate::dynamic) fn step(&mut self, targets: &[f64], dt: f64) -> Result<(), SolverError> {
        self.state.set_targets(targets);
        self.state.step(1, dt, 1.0, 0.0)
    }

    /// Hands over to the CPU's state at motion time `time`, after steps of length `dt`.
    ///
    /// # Errors
    /// [`SolverError::Diverged`] where a node went further in a step than the CPU lets it, or to no number.
    pub(in crate::dynamic) fn store(
        &self,
        cpu: &mut State<'_>,
        dt: f64,
        time: f64,
    ) -> Result<(), SolverError> {
        let positions = self.state.positions()?;
        let velocities = self.state.velocities()?;
        // The displacement from or to a position that is not a number is not a number either.
        let displacements =
            positions.iter().zip(&velocities).map(|(p, v)| v.length() * dt + 0.0 * p.length());
        let runaway = displacements
            .enumerate()
            .find(|(_, displacement)| displacement.is_nan() || *displacement > MAX_DISPLACEMENT);
        if let Some((node, displacement)) = runaway {
            return Err(SolverError::Diverged { node, time, displacement });
        }
        cpu.set_positions(&positions);
        cpu.set_velocities(&velocities);
        cpu.set_angles(&self.state.angles()?);
        Ok(())
    }

    /// The residual that f32 leaves at `positions`: what rounding of the largest displacement pulls at the stiffest
    /// bar.
    fn floor(&self, positions: &[DVec3]) -> f64 {
        let pattern = self.model.pattern.iter();
        let moves = positions.iter().zip(pattern).map(|(p, q)| p.distance(q.extend(0.0)));
        let furthest = moves.fold(1.0, f64::max);
        let stiffest = self.model.bars.iter().map(|bar| bar.stiffness).fold(0.0, f64::max);
        ROUNDINGS * f64::from(f32::EPSILON) * furthest * stiffest
            / self.model.material.fold_stiffness
    }

    /// Relaxes at motion time `time` to `tolerance`, or to what f32 leaves; `look` sees the positions now and then and
    /// may end it with an error.
    pub(in crate::dynamic) fn settle(
        &mut self,
        cpu: &mut State<'_>,
        tolerance: f64,
        allowance: Allowance,
        is_recorded: bool,
        time: f64,
        look: &mut dyn FnMut(&[DVec3]) -> Result<(), SolverError>,
    ) -> Result<Rough, SolverError> {
        let look_steps = if is_recorded { STEPS_A_RECORDED_LOOK } else { STEPS_A_LOOK };
        let tolerance = tolerance.max(self.floor(&cpu.positions()));
        let mut steps = 0;
        while !allowance.is_spent(steps) {
            cpu.scale_masses();
            self.load(cpu);
            self.state.relax(look_steps, DT, PATH_STEP)?;
            let mut looks = 1;
            loop {
                steps += look_steps as u64;
                let totals = self.state.totals()?;
                let is_settled =
                    totals.residual <= tolerance && totals.largest_speed * DT <= tolerance;
                if is_settled || allowance.is_spent(steps) || looks * look_steps >= STEPS_A_LOOK {
                    self.store(cpu, totals.pace[0], time)?;
                    look(&cpu.positions())?;
                    if is_settled {
                        return Ok(Rough { steps, tolerance, is_settled });
                    }
                    break;
                }
                if is_recorded {
                    look(&self.state.positions()?)?;
                }
                self.state.go_on(look_steps)?;
                looks += 1;
            }
        }
        Ok(Rough { steps, tolerance, is_settled: false })
    }
}
