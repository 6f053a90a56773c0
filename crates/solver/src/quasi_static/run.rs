//! The run: load steps along the stages of the schedule.

use std::collections::VecDeque;

use foldmotion_geometry::RigidMotion;
use foldmotion_pattern::Frame;
use glam::DVec3;

use super::configuration::Configuration;
use super::newton::{Newton, Settled, Tolerance};
use super::outcome::{QuasiStaticRun, StageOutcome};
use super::{QuasiStaticOptions, force_scale, rounding_force};
use crate::{Model, Schedule, SolverError, Stage};

/// The last Newton step of an equilibrium moves no node further, in unit lengths.
const STEP_TOLERANCE: f64 = 1e-9;
/// A load step that settled within this many iterations is followed by a longer one.
const EASY_ITERATIONS: usize = 10;
/// By which load steps grow and shrink.
const STEP_FACTOR: f64 = 2.0;

/// Folds the sheet of `model` slowly along `schedule`, from `start` (one position a vertex, in the sheet's unit).
///
/// At every load step the sheet is brought to the nearest minimum of its energy downhill from the last state, itself
/// extrapolated. Load steps hit every t = 2k/frames; between them they shorten where Newton's method fails and grow
/// again where it is easy. `progress` is told t after each one and ends the run by returning false.
///
/// A stage in which even the shortest load step finds no equilibrium ends the run: what was reached is returned, with
/// [`StageOutcome::converged`] false.
///
/// # Errors
/// Options out of range, counts that do not fit the model, positions that are not finite, a matrix too large, and
/// [`SolverError::Cancelled`].
pub fn run_quasi_static(
    model: &Model,
    schedule: &Schedule,
    start: &[DVec3],
    options: &QuasiStaticOptions,
    progress: &(dyn Fn(f64) -> bool + Sync),
) -> Result<QuasiStaticRun, SolverError> {
    options.validate()?;
    check_input(model, schedule, start)?;
    let mut run = Run {
        model,
        schedule,
        options,
        progress,
        newton: Newton::new(model, options.max_iterations)?,
        state: Configuration::new(model, model.to_model(start)),
        targets: vec![0.0; model.hinges.len()],
        outcome: QuasiStaticRun::default(),
    };
    for &stage in &options.stages {
        run.begin(stage);
        if !run.stage(stage)? {
            break;
        }
    }
    Ok(run.outcome)
}

fn check_input(model: &Model, schedule: &Schedule, start: &[DVec3]) -> Result<(), SolverError> {
    let counts = [
        ("positions", model.node_count(), start.len()),
        ("schedule ramps", model.hinges.len(), schedule.hinge_count()),
    ];
    for (what, expected, found) in counts {
        if expected != found {
            return Err(SolverError::Count {
                what,
                expected,
                found,
            });
        }
    }
    match start.iter().position(|p| !p.is_finite()) {
        Some(index) => Err(SolverError::NotFinite {
            what: "start position of vertex",
            index,
        }),
        None => Ok(()),
    }
}

struct Run<'a> {
    model: &'a Model,
    schedule: &'a Schedule,
    options: &'a QuasiStaticOptions,
    progress: &'a (dyn Fn(f64) -> bool + Sync),
    newton: Newton<'a>,
    state: Configuration,
    targets: Vec<f64>,
    outcome: QuasiStaticRun,
}

impl Run<'_> {
    /// Records the state in which the stage begins, unless the stage before ended in it.
    fn begin(&mut self, stage: Stage) {
        self.schedule.targets(stage, 0.0, &mut self.targets);
        if self
            .outcome
            .frames
            .last()
            .is_none_or(|f| f.time != stage.start_time())
        {
            self.record(stage.start_time());
        }
    }

    /// Runs one stage; false where it did not reach its end.
    fn stage(&mut self, stage: Stage) -> Result<bool, SolverError> {
        let mut outcome = StageOutcome::new(stage);
        let mut history = History::new(self.state.clone());
        let spacing = 2.0 / self.options.frames as f64;
        let frames = self.options.frames / 2;
        let mut length = spacing;
        let mut next_frame = 1;
        let mut s = 0.0;
        while next_frame <= frames {
            let goal = next_frame as f64 / frames as f64;
            // A step that would leave less than half of itself before the frame is stretched to it.
            let reaches = goal - s <= 1.5 * length;
            let next = if reaches { goal } else { s + length };
            let trial = self.load_step(stage, next, &history);
            outcome.add(&trial.settled);
            if trial.settled.converged {
                self.state = self.aligned(trial.state);
                history.push(next, self.state.clone());
                s = next;
                let time = stage.start_time() + s;
                if reaches {
                    next_frame += 1;
                }
                if reaches || self.options.record_load_steps {
                    self.record(time);
                }
                if trial.settled.iterations <= EASY_ITERATIONS {
                    length = (length * STEP_FACTOR).min(spacing);
                }
                if !(self.progress)(time) {
                    return Err(SolverError::Cancelled { time });
                }
            } else {
                outcome.shortened_steps += 1;
                length = (next - s) / STEP_FACTOR;
                if length < self.options.min_load_step {
                    break;
                }
            }
        }
        outcome.converged = next_frame > frames;
        outcome.reached = stage.start_time() + s;
        let converged = outcome.converged;
        self.outcome.factorisations = self.newton.factorisations;
        self.outcome.stages.push(outcome);
        Ok(converged)
    }

    /// The equilibrium at `s`, sought from the state extrapolated to it and, failing that, from the last one.
    fn load_step(&mut self, stage: Stage, s: f64, history: &History) -> Trial {
        self.schedule.targets(stage, s, &mut self.targets);
        let tolerance = Tolerance {
            force: self.options.tolerance * force_scale(self.model)
                + rounding_force(self.model, &self.state.positions),
            step: STEP_TOLERANCE,
        };
        let mut state = history
            .extrapolate(self.model, s)
            .unwrap_or_else(|| self.state.clone());
        let settled = self.newton.settle(&mut state, &self.targets, tolerance);
        Trial { state, settled }
    }

    /// `state` moved rigidly onto the last one: the sheet does not wander.
    fn aligned(&self, mut state: Configuration) -> Configuration {
        let motion = RigidMotion::best_fit(&state.positions, &self.state.positions);
        for position in &mut state.positions {
            *position = motion.apply(*position);
        }
        state
    }

    fn record(&mut self, time: f64) {
        self.outcome.frames.push(Frame {
            time,
            positions: self.model.to_sheet(&self.state.positions),
        });
        self.outcome.energy.push(self.model.energy_by_kind(
            &self.state.positions,
            &self.state.angles,
            &self.targets,
        ));
    }
}

struct Trial {
    state: Configuration,
    settled: Settled,
}

/// The last equilibria of a stage, to extrapolate from.
struct History {
    states: VecDeque<(f64, Configuration)>,
}

impl History {
    fn new(start: Configuration) -> Self {
        Self {
            states: VecDeque::from([(0.0, start)]),
        }
    }

    fn push(&mut self, s: f64, state: Configuration) {
        self.states.push_back((s, state));
        if self.states.len() > 3 {
            self.states.pop_front();
        }
    }

    /// The polynomial through the last (up to three) states at `s`; none where a hinge would turn too far.
    fn extrapolate(&self, model: &Model, s: f64) -> Option<Configuration> {
        let weights: Vec<f64> = (0..self.states.len())
            .map(|i| {
                let others = (0..self.states.len()).filter(|&j| j != i);
                let (own, at) = (self.states[i].0, |j: usize| self.states[j].0);
                others.map(|j| (s - at(j)) / (own - at(j))).product()
            })
            .collect();
        let (_, last) = self.states.back()?;
        let mut direction = vec![DVec3::ZERO; last.positions.len()];
        for (weight, (_, state)) in weights.iter().zip(&self.states) {
            for ((d, &x), &own) in direction
                .iter_mut()
                .zip(&state.positions)
                .zip(&last.positions)
            {
                *d += (x - own) * *weight;
            }
        }
        last.moved(model, &direction, 1.0, std::f64::consts::FRAC_PI_2)
    }
}
