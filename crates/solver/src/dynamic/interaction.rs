//! A sheet moved interactively: it follows a motion time that may change at any moment, and can be pulled at a vertex.
//!
//! It moves by dynamic relaxation (`relaxation`), in which it settles in few steps. The time of the schedule follows
//! the requested one, the more slowly the further the creases lag behind their targets. The pulling force grows with
//! the distance up to [`REACH`] and stays constant beyond; it is balanced by forces −(a + ω × r) on all nodes (inertia
//! relief), so that the sheet as a whole stays where it is however it is pulled.

use glam::{DMat3, DVec3};

use super::State;
use super::lanes::Quad;
use super::passes::{Hinges, Mass};
use super::relaxation::{DT, Relaxation, StepHistory};
use crate::{Model, Schedule, SolverError, Stage};

/// Steps between two updates, at which the time advances and rigid motion is removed.
const STEPS_PER_UPDATE: usize = 10;
/// The largest change of motion time in a step.
const LARGEST_TIME_STEP: f64 = 1e-3;
/// The lag of a crease, radians, at which the time moves at half its largest speed.
const HALF_SPEED_LAG: f64 = 0.3;
/// The largest pulling force over the axial stiffness: the strain of a single bar that carries it.
const LARGEST_FORCE: f64 = 0.25;
/// The distance in unit lengths at which the pulling force reaches its largest value.
const REACH: f64 = 1.0;
/// A node slower than this, unit lengths per step, is at rest.
const REST: f64 = 1e-8;
/// A state is kept as the one to return to if no node is faster, unit lengths per step.
const SAFE_SPEED: f64 = 0.05;

/// A vertex and the point to which it is pulled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pull {
    /// The vertex that is pulled.
    pub vertex: u32,
    /// The point towards which it is pulled, in the sheet's unit.
    pub point: DVec3,
}

/// A sheet that follows a motion time and can be pulled.
#[derive(Debug)]
pub struct InteractiveSheet<'a> {
    schedule: &'a Schedule,
    stages: Vec<Stage>,
    state: State<'a>,
    targets: Vec<f64>,
    time: f64,
    aim: f64,
    pull: Option<Pull>,
    history: StepHistory,
    /// The number of consecutive updates at which nothing moved.
    updates_at_rest: u32,
    safe: SafeState,
}

/// The last state in which the sheet moved slowly; it is restored if the sheet diverges.
#[derive(Debug, Clone)]
struct SafeState {
    positions: Vec<Quad>,
    hinges: Vec<Hinges>,
    time: f64,
}

impl<'a> InteractiveSheet<'a> {
    /// The sheet of `model` at rest at `start` (one position for each vertex, in the sheet's unit), a state of the
    /// motion along
    /// `schedule` at motion time `time`. `stages`: those of the motion, in order.
    ///
    /// # Errors
    /// [`SolverError::Count`], [`SolverError::NotFinite`] for a start that does not fit, no stage, or a time that is no
    /// number.
    pub fn new(
        model: &'a Model,
        schedule: &'a Schedule,
        stages: &[Stage],
        start: &[DVec3],
        time: f64,
    ) -> Result<Self, SolverError> {
        schedule.check_start(model, start)?;
        if stages.is_empty() {
            let what = "stages of the motion";
            return Err(SolverError::Count { what, expected: 1, found: 0 });
        }
        if !time.is_finite() {
            let what = "motion time of the start, number";
            return Err(SolverError::NotFinite { what, index: 0 });
        }
        let state = State::at_rest(model, &model.to_model(start));
        let mut interaction = Self {
            safe: SafeState::of(&state, time),
            schedule,
            stages: stages.to_vec(),
            state,
            targets: vec![0.0; model.hinges.len()],
            time,
            aim: time,
            pull: None,
            history: StepHistory::NONE,
            updates_at_rest: 0,
        };
        interaction.time = interaction.within(time);
        interaction.aim(time);
        interaction.follow();
        // The targets tell which turn a hinge near ±π is in.
        interaction.state.set_angles(&interaction.targets);
        interaction.state.evaluate_forces();
        interaction.safe = SafeState::of(&interaction.state, interaction.time);
        Ok(interaction)
    }

    /// Sets the motion time to move to, clamped to the stages. A time that is not finite changes nothing.
    pub fn aim(&mut self, time: f64) {
        if time.is_finite() {
            self.aim = self.within(time);
            self.updates_at_rest = 0;
        }
    }

    /// Starts or ends a pull. A vertex that the sheet does not have or a point that is not finite ends it.
    pub fn pull(&mut self, pull: Option<Pull>) {
        let count = self.state.model.node_count();
        self.pull = pull.filter(|p| (p.vertex as usize) < count && p.point.is_finite());
        self.updates_at_rest = 0;
    }

    /// Moves the sheet by about `steps` steps and returns the motion time reached. Returns at once if it is at rest.
    ///
    /// # Errors
    /// [`SolverError::Diverged`] if a node moved too far. The pull has then ended and the sheet is at rest in its last
    /// safe state, from which it can be moved again.
    pub fn advance(&mut self, steps: usize) -> Result<f64, SolverError> {
        for _ in 0..steps.div_ceil(STEPS_PER_UPDATE) {
            if self.is_at_rest() {
                break;
            }
            if let Err((node, displacement)) = self.update() {
                let time = self.time;
                self.restore();
                return Err(SolverError::Diverged { node, time, displacement });
            }
        }
        Ok(self.time)
    }

    /// The motion time of the targets.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Whether the sheet has reached the requested time and no longer moves.
    pub fn is_at_rest(&self) -> bool {
        self.time == self.aim && self.updates_at_rest > 1
    }

    /// One position a vertex, in the sheet's unit.
    pub fn positions(&self) -> Vec<DVec3> {
        self.state.model.to_sheet(&self.state.positions())
    }

    /// The largest |θ − θ*| of a hinge, radians.
    pub fn fold_angle_error(&self) -> f64 {
        self.state.fold_angle_error()
    }

    fn within(&self, time: f64) -> f64 {
        let starts = || self.stages.iter().map(|stage| stage.start_time());
        let first = starts().fold(f64::INFINITY, f64::min);
        let last = starts().fold(f64::NEG_INFINITY, f64::max) + 1.0;
        time.clamp(first, last)
    }

    /// Gives the hinges their targets at the present time.
    fn follow(&mut self) {
        let stage = if self.time <= 1.0 && self.stages.contains(&Stage::Unfold) {
            Stage::Unfold
        } else {
            Stage::Fold
        };
        let local = self.time - stage.start_time();
        self.schedule.targets(stage, local, &mut self.targets);
        self.state.set_targets(&self.targets);
    }

    fn update(&mut self) -> Result<(), (usize, f64)> {
        if self.time != self.aim {
            let lag = self.state.fold_angle_error() / HALF_SPEED_LAG;
            let most = LARGEST_TIME_STEP * STEPS_PER_UPDATE as f64 / (1.0 + lag * lag);
            self.time += (self.aim - self.time).clamp(-most, most);
            self.follow();
        }
        let pull = self.pull.map(|pull| {
            let mut order = self.state.layout.order.iter();
            let index = order.position(|&node| node == pull.vertex).unwrap_or(0);
            (index, pull.point / self.state.model.unit_length)
        });
        let largest_force = LARGEST_FORCE * self.state.model.material.axial_stiffness;
        let mut relaxation = Relaxation::resumed(&mut self.state, 0.0, self.history);
        for _ in 0..STEPS_PER_UPDATE {
            let pull_force = pull
                .map(|(index, point)| relaxation.state().pull_force(index, point, largest_force));
            relaxation.step()?;
            if let Some(pull_force) = pull_force {
                let history = relaxation.history();
                relaxation.state_mut().add(&pull_force, history);
            }
        }
        self.history = relaxation.history();
        let fastest = self.state.remove_rigid_motion() * DT;
        if fastest <= SAFE_SPEED {
            self.safe.take(&self.state, self.time);
        }
        self.updates_at_rest = if fastest <= REST { self.updates_at_rest + 1 } else { 0 };
        Ok(())
    }

    fn restore(&mut self) {
        self.pull = None;
        self.history = StepHistory::NONE;
        self.updates_at_rest = 0;
        self.time = self.safe.time;
        self.state.now.positions.clone_from_slice(&self.safe.positions);
        self.state.hinges.clone_from(&self.safe.hinges);
        self.state.stop();
        self.follow();
    }
}

impl SafeState {
    fn of(state: &State<'_>, time: f64) -> Self {
        Self { positions: state.now.positions.clone(), hinges: state.hinges.clone(), time }
    }

    fn take(&mut self, state: &State<'_>, time: f64) {
        self.positions.clone_from(&state.now.positions);
        self.hinges.clone_from(&state.hinges);
        self.time = time;
    }
}

/// The nodes as a rigid body.
#[derive(Debug, Clone, Copy)]
struct Body {
    mass: f64,
    middle: DVec3,
    inverse_inertia: DMat3,
}

impl Body {
    /// The velocity of its centre and its angular velocity, for a momentum and an angular momentum.
    fn moved_by(&self, momentum: DVec3, spin: DVec3) -> [DVec3; 2] {
        [momentum / self.mass, self.inverse_inertia * spin]
    }
}

/// A pulling force and the motion that balances it.
#[derive(Debug, Clone, Copy)]
struct PullForce {
    index: usize,
    force: DVec3,
    middle: DVec3,
    drift: DVec3,
    turn: DVec3,
}

impl State<'_> {
    /// The force on the node at `index` of the layout towards `point`, at most `largest_force`. It is balanced for
    /// nodes of equal mass, so that the balance does not depend on the masses of the relaxation.
    fn pull_force(&self, index: usize, point: DVec3, largest_force: f64) -> PullForce {
        let body = self.body(|_| 1.0);
        let from = xyz(self.now.positions[index]);
        let displacement = point - from;
        let force = displacement * (largest_force / displacement.length().max(REACH));
        let [drift, turn] = body.moved_by(force, (from - body.middle).cross(force));
        PullForce { index, force, middle: body.middle, drift, turn }
    }

    /// Adds the effect of `pull_force`, computed from the state before it, to the step that was just made.
    fn add(&mut self, pull_force: &PullForce, step: StepHistory) {
        let StepHistory { damping, dt, .. } = step;
        let share = dt / (1.0 + 0.5 * damping * dt);
        let nodes = self.now.positions.iter_mut().zip(&mut self.now.velocities);
        for (index, ((x, v), mass)) in nodes.zip(&self.masses).enumerate() {
            let before = xyz(*x) - dt * xyz(*v);
            let mut force = -pull_force.drift - pull_force.turn.cross(before - pull_force.middle);
            if index == pull_force.index {
                force += pull_force.force;
            }
            let added = force * (share * mass.inverse);
            *v = quad(xyz(*v) + added);
            *x = quad(xyz(*x) + added * dt);
        }
    }

    /// Removes the rigid motion v + ω × r from the velocities and returns the largest speed left.
    fn remove_rigid_motion(&mut self) -> f64 {
        let body = self.body(|mass| mass.mass);
        let (mut momentum, mut spin) = (DVec3::ZERO, DVec3::ZERO);
        let nodes = self.now.positions.iter().zip(&self.now.velocities);
        for ((x, v), m) in nodes.zip(&self.masses) {
            let p = xyz(*v) * m.mass;
            momentum += p;
            spin += (xyz(*x) - body.middle).cross(p);
        }
        let [drift, turn] = body.moved_by(momentum, spin);
        let mut fastest = 0.0_f64;
        for (x, v) in self.now.positions.iter().zip(&mut self.now.velocities) {
            let left = xyz(*v) - drift - turn.cross(xyz(*x) - body.middle);
            fastest = fastest.max(left.length());
            *v = quad(left);
        }
        fastest
    }

    fn body(&self, weight: impl Fn(&Mass) -> f64) -> Body {
        let nodes = || {
            let nodes = self.now.positions.iter().zip(&self.masses);
            nodes.map(|(x, m)| (xyz(*x), weight(m)))
        };
        let (mut mass, mut first) = (0.0, DVec3::ZERO);
        for (x, m) in nodes() {
            mass += m;
            first += m * x;
        }
        let middle = first / mass;
        let mut inertia = DMat3::ZERO;
        for (x, m) in nodes() {
            let r = x - middle;
            let outer = DMat3::from_cols(r * r.x, r * r.y, r * r.z);
            inertia += (DMat3::IDENTITY * r.length_squared() - outer) * m;
        }
        let inverse = inertia.inverse();
        // Nodes along a line have no inertia about it.
        let inverse_inertia = if inverse.is_finite() { inverse } else { DMat3::ZERO };
        Body { mass, middle, inverse_inertia }
    }
}

fn quad(vector: DVec3) -> Quad {
    [vector.x, vector.y, vector.z, 0.0]
}

fn xyz([x, y, z, _]: Quad) -> DVec3 {
    DVec3::new(x, y, z)
}
