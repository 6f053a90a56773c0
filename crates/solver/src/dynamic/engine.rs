//! The run: both stages, ramped, settled and recorded.
//!
//! A stage is a ramp of all targets, cut into `increments`. In each the targets move linearly while the sheet, a
//! mass–spring–damper with the material's dampers, follows for a number of stable steps; then it settles (`relaxation`)
//! to the tolerance of the increment, so that it never lags far behind the schedule whatever its size and its damping.
//! At the end of the stage it settles to the final tolerance.

use foldmotion_pattern::Frame;
use glam::DVec3;

#[cfg(feature = "gpu")]
use super::gpu::{Gpu, GpuDrive};
use super::increments::increments;
use super::options::{Device, DynamicOptions, Run, StageOutcome, StageStatus};
use super::recorder::Recorder;
use super::relaxation::{Progress, Relaxation};
use super::stability::SAFETY;
use super::state::State;
use crate::budget::Allowance;
use crate::{Model, Schedule, Snapshot, SolverError, Stage, Watcher};

/// Moves the sheet of `model` along `schedule` from `start` (one position for each vertex, in the sheet's unit) through
/// the given stages.
///
/// `progress` is called before every increment and whenever the residual is examined (every ten steps); returning false ends
/// the run. The result does not depend on it or on the number of threads, bit for bit.
///
/// # Errors
/// [`SolverError::Count`], [`SolverError::NotFinite`], [`SolverError::Frames`], [`SolverError::Option`] for input that
/// does not fit; [`SolverError::Diverged`] where a node runs away; [`SolverError::Cancelled`]. A stage that does not
/// settle within its step budget is not an error but a [`StageStatus::OutOfSteps`]: the run ends there, with what it reached.
pub fn run(
    model: &Model,
    schedule: &Schedule,
    start: &[DVec3],
    options: &DynamicOptions,
    progress: Watcher<'_>,
) -> Result<Run, SolverError> {
    options.validate()?;
    schedule.check_start(model, start)?;
    // On a worker the threads meet without waking each other up.
    rayon::scope(|_| run_on_device(model, schedule, start, options, progress))
}

fn run_on_device(
    model: &Model,
    schedule: &Schedule,
    start: &[DVec3],
    options: &DynamicOptions,
    progress: Watcher<'_>,
) -> Result<Run, SolverError> {
    #[cfg(not(feature = "gpu"))]
    {
        if options.device == Device::Gpu {
            return Err(SolverError::NoGpu {
                reason: "this program was built without the feature gpu".to_owned(),
            });
        }
        run_here(model, schedule, start, options, progress)
    }
    #[cfg(feature = "gpu")]
    {
        let gpu = match options.device {
            Device::Gpu => Some(Gpu::new()?),
            Device::Auto if model.node_count() >= Device::AUTO_NODES => {
                Gpu::new().ok().filter(|gpu| !gpu.is_software())
            }
            Device::Cpu | Device::Auto => None,
        };
        let drive = match &gpu {
            Some(gpu) => Some(GpuDrive::new(gpu, model, &model.to_model(start))?),
            None => None,
        };
        let mut run = run_here(model, schedule, start, options, progress, drive)?;
        if let Some(gpu) = gpu {
            gpu.name().clone_into(&mut run.device);
        }
        Ok(run)
    }
}

fn run_here(
    model: &Model,
    schedule: &Schedule,
    start: &[DVec3],
    options: &DynamicOptions,
    progress: Watcher<'_>,
    #[cfg(feature = "gpu")] drive: Option<GpuDrive<'_>>,
) -> Result<Run, SolverError> {
    let mut state = State::at_rest(model, &model.to_model(start));
    let mut targets = vec![0.0; model.hinges.len()];
    let first = options.stages.first().copied().unwrap_or(Stage::Unfold);
    schedule.targets(first, 0.0, &mut targets);
    state.set_targets(&targets);
    state.set_angles(&targets);
    let recorder = Recorder::new(model);
    let mut engine = Engine {
        schedule,
        options,
        progress,
        state,
        recorder,
        targets,
        taken: 0,
        #[cfg(feature = "gpu")]
        drive,
    };
    engine.recorder.push(first, 0.0, &engine.state.positions());
    let mut stages = Vec::with_capacity(options.stages.len());
    for &stage in &options.stages {
        let outcome = engine.run_stage(stage)?;
        stages.push(outcome);
        if !outcome.is_converged() {
            break;
        }
    }
    let mut frames = engine.recorder.into_frames();
    // The start is given, not computed: it is recorded as it came, to the last bit.
    if let Some(frame) = frames.first_mut() {
        *frame = Frame { time: first.start_time(), positions: start.to_vec() };
    }
    let steps = stages.iter().map(|stage| stage.steps).sum();
    Ok(Run { frames, stages, steps, device: "cpu".to_owned() })
}

struct Engine<'a, 'm> {
    schedule: &'a Schedule,
    options: &'a DynamicOptions,
    progress: Watcher<'a>,
    state: State<'m>,
    recorder: Recorder<'m>,
    targets: Vec<f64>,
    /// Steps of every kind in all stages.
    taken: u64,
    #[cfg(feature = "gpu")]
    drive: Option<GpuDrive<'a>>,
}

impl Engine<'_, '_> {
    fn run_stage(&mut self, stage: Stage) -> Result<StageOutcome, SolverError> {
        let mut ramp_steps = 0;
        let mut settling_steps = 0;
        let mut from = 0.0;
        for increment in increments(self.schedule, stage, self.options) {
            let (to, tolerance) = (increment.end, increment.tolerance);
            ramp_steps += self.ramp(stage, from, to)?;
            let status = self.settle(stage, to, tolerance, &mut settling_steps)?;
            let is_spent = status != StageStatus::Settled;
            if increment.is_recorded || is_spent {
                self.recorder.push(stage, to, &self.state.positions());
            }
            if is_spent {
                let steps = ramp_steps + settling_steps;
                return Ok(self.end_stage(stage, to, status, tolerance, steps));
            }
            from = to;
        }
        ramp_steps += self.ramp(stage, from, 1.0)?;
        self.recorder.begin_settling(&self.state.positions());
        let tolerance = self.options.tolerance;
        let status = self.settle(stage, 1.0, tolerance, &mut settling_steps)?;
        self.recorder.push(stage, 1.0, &self.state.positions());
        let steps = ramp_steps + settling_steps;
        Ok(self.end_stage(stage, 1.0, status, tolerance, steps))
    }

    /// Stops the sheet where the stage ended, at stage-local time `s`, and says how it went.
    fn end_stage(
        &mut self,
        stage: Stage,
        s: f64,
        status: StageStatus,
        tolerance: f64,
        steps: u64,
    ) -> StageOutcome {
        self.state.stop();
        self.state.evaluate_forces();
        StageOutcome {
            stage,
            status,
            reached: stage.start_time() + s,
            tolerance,
            residual: self.state.residual(),
            fold_angle_error: self.state.fold_angle_error(),
            steps,
        }
    }

    /// Damped steps while the targets go from their values at `from` to those at `to`; how many.
    fn ramp(&mut self, stage: Stage, from: f64, to: f64) -> Result<u64, SolverError> {
        report(self.progress, stage, from, &self.state)?;
        self.state.damping = 1.0;
        self.state.use_unit_masses();
        let dt = SAFETY * self.state.stable_time_step();
        let steps = self.options.ramp_steps;
        self.taken += steps as u64;
        #[cfg(feature = "gpu")]
        if let Some(drive) = &mut self.drive {
            drive.load(&self.state);
            for step in 1..=steps {
                let s = from + (to - from) * (step as f64 / steps as f64);
                self.schedule.targets(stage, s, &mut self.targets);
                drive.step(&self.targets, dt)?;
            }
            drive.store(&mut self.state, dt, stage.start_time() + to)?;
            self.state.set_targets(&self.targets);
            return Ok(steps as u64);
        }
        for step in 1..=steps {
            let s = from + (to - from) * (step as f64 / steps as f64);
            self.schedule.targets(stage, s, &mut self.targets);
            self.state.set_targets(&self.targets);
            self.state.step(dt).map_err(|runaway| diverged(runaway, stage, s))?;
        }
        Ok(steps as u64)
    }

    /// Relaxes to `tolerance` as far as the budget of the stage allows, if `spent` steps of it are used.
    fn settle(
        &mut self,
        stage: Stage,
        s: f64,
        tolerance: f64,
        spent: &mut u64,
    ) -> Result<StageStatus, SolverError> {
        if let Some(status) = self.spent() {
            return Ok(status);
        }
        if tolerance == f64::INFINITY {
            return Ok(StageStatus::Settled);
        }
        #[cfg(feature = "gpu")]
        if let Some(status) = self.settle_on_gpu(stage, s, tolerance, spent)? {
            return Ok(status);
        }
        let allowance = self.allowance(*spent);
        let mut relaxation = Relaxation::new(&mut self.state, tolerance);
        let mut is_settled = false;
        while !allowance.is_spent(relaxation.steps()) {
            if relaxation.advance().map_err(|runaway| diverged(runaway, stage, s))?
                == Progress::Settled
            {
                is_settled = true;
                break;
            }
            if s == 1.0 {
                self.recorder.settling(stage, &relaxation.state().positions());
            }
            report(self.progress, stage, s, relaxation.state())?;
        }
        *spent += relaxation.steps();
        self.taken += relaxation.steps();
        Ok(if is_settled { StageStatus::Settled } else { self.unsettled() })
    }

    /// The status of a search whose allowance was spent before the sheet settled.
    fn unsettled(&self) -> StageStatus {
        if self.options.budget.is_late() { StageStatus::OutOfTime } else { StageStatus::OutOfSteps }
    }

    /// The status if the budget of the run is spent.
    fn spent(&self) -> Option<StageStatus> {
        let budget = self.options.budget;
        let is_spent = budget.is_late() || budget.left(u64::MAX, self.taken) == 0;
        is_spent.then(|| self.unsettled())
    }

    /// The settling steps left in a stage that has taken `spent`.
    fn allowance(&self, spent: u64) -> Allowance {
        let standard = self.options.step_budget.saturating_sub(spent);
        let budget = self.options.budget;
        budget.allowance(budget.left(standard, self.taken))
    }

    /// Settles as far as f32 goes; `None` if the CPU is to go on from there, or there is no GPU.
    #[cfg(feature = "gpu")]
    fn settle_on_gpu(
        &mut self,
        stage: Stage,
        s: f64,
        tolerance: f64,
        spent: &mut u64,
    ) -> Result<Option<StageStatus>, SolverError> {
        let allowance = self.allowance(*spent);
        let Some(drive) = &mut self.drive else {
            return Ok(None);
        };
        let time = stage.start_time() + s;
        let (recorder, progress, model) = (&mut self.recorder, self.progress, self.state.model);
        let is_recorded = s == 1.0;
        let mut look = |positions: &[DVec3]| {
            if is_recorded {
                recorder.settling(stage, positions);
            }
            if progress(&Snapshot::new(time, &|| model.to_sheet(positions))) {
                Ok(())
            } else {
                Err(SolverError::Cancelled { time })
            }
        };
        self.state.damping = 0.0;
        let rough =
            drive.settle(&mut self.state, tolerance, allowance, is_recorded, time, &mut look)?;
        *spent += rough.steps;
        self.taken += rough.steps;
        Ok(if !rough.is_settled {
            Some(self.unsettled())
        } else if rough.tolerance <= tolerance {
            Some(StageStatus::Settled)
        } else {
            None
        })
    }
}

/// Tells `progress` that `state` is reached.
fn report(
    progress: Watcher<'_>,
    stage: Stage,
    s: f64,
    state: &State<'_>,
) -> Result<(), SolverError> {
    let time = stage.start_time() + s;
    let positions = || state.model.to_sheet(&state.positions());
    if progress(&Snapshot::new(time, &positions)) {
        Ok(())
    } else {
        Err(SolverError::Cancelled { time })
    }
}

fn diverged((node, displacement): (usize, f64), stage: Stage, s: f64) -> SolverError {
    SolverError::Diverged { node, time: stage.start_time() + s, displacement }
}
