//! The sheet in the hand: it follows a motion time that may be moved at will, and can be pulled at a vertex.
//!
//! It moves by dynamic relaxation (`relaxation`), in which it settles in few steps. The time of the schedule follows the
//! one aimed at, ever slower the further the creases lag behind their targets. The hand that pulls is a spring that
//! grows no stronger with the distance; it is balanced by forces −(a + ω × r) on all nodes (inertia relief), so that
//! the sheet stays where it is however it is pulled.

use glam::{DMat3, DVec3};

use super::State;
use super::lanes::Quad;
use super::passes::{Hinges, Mass};
use super::relaxation::{DT, Past, Relaxation};
use crate::{Model, Schedule, SolverError, Stage};

/// Steps between two looks: the time moves on, and the sheet is held in place.
const STEPS_A_LOOK: usize = 10;
/// The furthest the motion time moves in a step.
const PACE: f64 = 1e-3;
/// The lag of a crease, radians, at which the time moves at half its pace.
const LAG: f64 = 0.3;
/// The largest force of the hand, over the axial stiffness: the strain of a bar that it would hold by itself.
const GRIP: f64 = 0.25;
/// The distance in unit lengths at which the hand pulls its hardest.
const REACH: f64 = 1.0;
/// A node slower than this, unit lengths a step, is at rest.
const REST: f64 = 1e-8;
/// A state may be gone back to where no node is faster, in unit lengths a step.
const SOUND: f64 = 0.05;

/// Where a hand pulls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pull {
    /// The vertex that is pulled.
    pub vertex: u32,
    /// The point it pulls towards, in the sheet's unit.
    pub point: DVec3,
}

/// A sheet that is moved by hand.
#[derive(Debug)]
pub struct Hand<'a> {
    schedule: &'a Schedule,
    stages: Vec<Stage>,
    state: State<'a>,
    targets: Vec<f64>,
    time: f64,
    aim: f64,
    pull: Option<Pull>,
    past: Past,
    /// Looks in a row at which nothing moved.
    still: u32,
    sound: Sound,
}

/// A state to go back to.
#[derive(Debug, Clone)]
struct Sound {
    positions: Vec<Quad>,
    hinges: Vec<Hinges>,
    time: f64,
}

impl<'a> Hand<'a> {
    /// The sheet of `model` at rest at `start` (one position for each vertex, in the sheet's unit), a state of the motion along
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
            return Err(SolverError::Count {
                what,
                expected: 1,
                found: 0,
            });
        }
        if !time.is_finite() {
            let what = "motion time of the start, number";
            return Err(SolverError::NotFinite { what, index: 0 });
        }
        let state = State::at_rest(model, &model.to_model(start));
        let mut hand = Self {
            sound: Sound::of(&state, time),
            schedule,
            stages: stages.to_vec(),
            state,
            targets: vec![0.0; model.hinges.len()],
            time,
            aim: time,
            pull: None,
            past: Past::NONE,
            still: 0,
        };
        hand.time = hand.within(time);
        hand.aim(time);
        hand.follow();
        // The targets tell which turn a hinge near ±π is in.
        hand.state.set_angles(&hand.targets);
        hand.state.evaluate_forces();
        hand.sound = Sound::of(&hand.state, hand.time);
        Ok(hand)
    }

    /// Asks for the motion time `time`, taken within the stages; one that is no number changes nothing.
    pub fn aim(&mut self, time: f64) {
        if time.is_finite() {
            self.aim = self.within(time);
            self.still = 0;
        }
    }

    /// Pulls, or lets go. A vertex that the sheet does not have or a point that is not finite lets go.
    pub fn pull(&mut self, pull: Option<Pull>) {
        let count = self.state.model.node_count();
        self.pull = pull.filter(|p| (p.vertex as usize) < count && p.point.is_finite());
        self.still = 0;
    }

    /// Moves the sheet on by about `steps` steps, and answers the motion time reached. Needs no more than a look where it
    /// is at rest.
    ///
    /// # Errors
    /// [`SolverError::Diverged`] where a node ran away. The hand has then let go, the sheet is back at rest in its last
    /// sound state, and can be moved on.
    pub fn advance(&mut self, steps: usize) -> Result<f64, SolverError> {
        for _ in 0..steps.div_ceil(STEPS_A_LOOK) {
            if self.is_at_rest() {
                break;
            }
            if let Err((node, displacement)) = self.look() {
                let time = self.time;
                self.go_back();
                return Err(SolverError::Diverged {
                    node,
                    time,
                    displacement,
                });
            }
        }
        Ok(self.time)
    }

    /// The motion time of the targets.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Whether it moves no more.
    pub fn is_at_rest(&self) -> bool {
        self.time == self.aim && self.still > 1
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

    fn look(&mut self) -> Result<(), (usize, f64)> {
        if self.time != self.aim {
            let lag = self.state.fold_angle_error() / LAG;
            let most = PACE * STEPS_A_LOOK as f64 / (1.0 + lag * lag);
            self.time += (self.aim - self.time).clamp(-most, most);
            self.follow();
        }
        let pull = self.pull.map(|pull| {
            let mut order = self.state.layout.order.iter();
            let place = order.position(|&node| node == pull.vertex).unwrap_or(0);
            (place, pull.point / self.state.model.unit_length)
        });
        let grip = GRIP * self.state.model.material.axial_stiffness;
        let mut relaxation = Relaxation::resumed(&mut self.state, 0.0, self.past);
        for _ in 0..STEPS_A_LOOK {
            let tug = pull.map(|(place, point)| relaxation.state().tug(place, point, grip));
            relaxation.step()?;
            if let Some(tug) = tug {
                let past = relaxation.past();
                relaxation.state_mut().add(&tug, past);
            }
        }
        self.past = relaxation.past();
        let fastest = self.state.stay() * DT;
        if fastest <= SOUND {
            self.sound.take(&self.state, self.time);
        }
        self.still = if fastest <= REST { self.still + 1 } else { 0 };
        Ok(())
    }

    fn go_back(&mut self) {
        self.pull = None;
        self.past = Past::NONE;
        self.still = 0;
        self.time = self.sound.time;
        self.state
            .now
            .positions
            .clone_from_slice(&self.sound.positions);
        self.state.hinges.clone_from(&self.sound.hinges);
        self.state.stop();
        self.follow();
    }
}

impl Sound {
    fn of(state: &State<'_>, time: f64) -> Self {
        Self {
            positions: state.now.positions.clone(),
            hinges: state.hinges.clone(),
            time,
        }
    }

    fn take(&mut self, state: &State<'_>, time: f64) {
        self.positions.clone_from(&state.now.positions);
        self.hinges.clone_from(&state.hinges);
        self.time = time;
    }
}

/// A rigid body of the nodes.
#[derive(Debug, Clone, Copy)]
struct Body {
    mass: f64,
    middle: DVec3,
    inverse_inertia: DMat3,
}

impl Body {
    /// The velocities of its middle and about it, of a momentum and an angular momentum.
    fn moved_by(&self, momentum: DVec3, spin: DVec3) -> [DVec3; 2] {
        [momentum / self.mass, self.inverse_inertia * spin]
    }
}

/// The force of the hand, and what balances it.
#[derive(Debug, Clone, Copy)]
struct Tug {
    place: usize,
    force: DVec3,
    middle: DVec3,
    drift: DVec3,
    turn: DVec3,
}

impl State<'_> {
    /// The hand at the node at `place` of the layout, pulling towards `point` with at most the force `grip`. A body of
    /// nodes of equal mass would not move, so that the balance does not depend on the masses of the relaxation.
    fn tug(&self, place: usize, point: DVec3, grip: f64) -> Tug {
        let body = self.body(|_| 1.0);
        let from = xyz(self.now.positions[place]);
        let way = point - from;
        let force = way * (grip / way.length().max(REACH));
        let [drift, turn] = body.moved_by(force, (from - body.middle).cross(force));
        Tug {
            place,
            force,
            middle: body.middle,
            drift,
            turn,
        }
    }

    /// What `tug`, made of the state before it, adds to the step that was just made.
    fn add(&mut self, tug: &Tug, step: Past) {
        let Past { damping, dt, .. } = step;
        let share = dt / (1.0 + 0.5 * damping * dt);
        let nodes = self.now.positions.iter_mut().zip(&mut self.now.velocities);
        for (index, ((x, v), mass)) in nodes.zip(&self.masses).enumerate() {
            let before = xyz(*x) - dt * xyz(*v);
            let mut force = -tug.drift - tug.turn.cross(before - tug.middle);
            if index == tug.place {
                force += tug.force;
            }
            let added = force * (share * mass.inverse);
            *v = quad(xyz(*v) + added);
            *x = quad(xyz(*x) + added * dt);
        }
    }

    /// Takes the motion of the sheet as a whole, v + ω × r, out of the velocities; answers the largest speed left.
    fn stay(&mut self) -> f64 {
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
        let inverse_inertia = if inverse.is_finite() {
            inverse
        } else {
            DMat3::ZERO
        };
        Body {
            mass,
            middle,
            inverse_inertia,
        }
    }
}

fn quad(vector: DVec3) -> Quad {
    [vector.x, vector.y, vector.z, 0.0]
}

fn xyz([x, y, z, _]: Quad) -> DVec3 {
    DVec3::new(x, y, z)
}
