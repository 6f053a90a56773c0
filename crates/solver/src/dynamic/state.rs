//! The moving sheet: positions, velocities and the passes of one step.
//!
//! A step is semi-implicit Euler (Origami Simulator's own scheme): with the force F(x, v) on every node of unit mass
//!
//! v ← v + Δt F(x, v),  x ← x + Δt v.
//!
//! Passes: `bar_forces` and `hinge_forces` (and `face_angle_forces`) evaluate each element once and write what it does
//! to each of its corners; `gather_forces` sums them per node in a fixed order; `integrate` moves the nodes. No pass
//! writes what another thread reads, none allocates.

use foldmotion_geometry::{fold_angle, fold_angle_gradient, nearest_turn};
use glam::DVec3;

use super::parallel::fill;
use super::stability::RowSums;
use crate::Model;

/// Positions and velocities of a sheet, with the buffers of a step. Lengths in unit lengths.
#[derive(Debug, Clone)]
pub struct State<'a> {
    pub(super) model: &'a Model,
    /// One position a node.
    pub positions: Vec<DVec3>,
    /// One velocity a node.
    pub velocities: Vec<DVec3>,
    /// The force on every node at the last evaluation.
    pub forces: Vec<DVec3>,
    /// The followed fold angle of every hinge at the last evaluation, radians.
    pub angles: Vec<f64>,
    /// The target of every hinge, radians.
    pub targets: Vec<f64>,
    /// Fraction of the material's damping that acts: 1, or 0 for undamped motion.
    pub damping: f64,
    pub(super) bar_dampers: Vec<f64>,
    /// Room for the row sums of the time step bound, one a node.
    pub(super) row_sums: Vec<RowSums>,
    bar_forces: Vec<DVec3>,
    hinge_forces: Vec<HingeForces>,
    face_forces: Vec<[DVec3; 3]>,
    is_parallel: bool,
}

/// The longest way a node may go in one step, in unit lengths: beyond it the motion has run away.
const MAX_DISPLACEMENT: f64 = 0.5;

/// What a hinge does to its four corners, and its angle.
#[derive(Debug, Clone, Copy)]
struct HingeForces {
    corners: [DVec3; 4],
    angle: f64,
}

impl<'a> State<'a> {
    /// The sheet of `model` at rest at `positions` (unit lengths), with every target at the angle it has there.
    ///
    /// Precondition: one position a node.
    pub fn at_rest(model: &'a Model, positions: Vec<DVec3>) -> Self {
        let mut angles = vec![0.0; model.hinges.len()];
        model.follow_angles(&positions, &mut angles);
        let idle = |angle: &f64| HingeForces {
            corners: [DVec3::ZERO; 4],
            angle: *angle,
        };
        let damper = |bar: &crate::Bar| 2.0 * model.material.damping_ratio * bar.stiffness.sqrt();
        Self {
            velocities: vec![DVec3::ZERO; positions.len()],
            forces: vec![DVec3::ZERO; positions.len()],
            targets: angles.clone(),
            damping: 1.0,
            bar_dampers: model.bars.iter().map(damper).collect(),
            row_sums: vec![RowSums::default(); positions.len()],
            bar_forces: vec![DVec3::ZERO; model.bars.len()],
            hinge_forces: angles.iter().map(idle).collect(),
            face_forces: vec![[DVec3::ZERO; 3]; model.face_angles.len()],
            is_parallel: model.node_count() >= super::parallel::MIN_NODES,
            model,
            positions,
            angles,
        }
    }

    /// Evaluates the force on every node, dampers included, and follows the fold angles.
    pub fn evaluate_forces(&mut self) {
        self.evaluate_bars();
        self.evaluate_hinges();
        self.evaluate_face_angles();
        self.gather_forces();
    }

    /// One step of length `dt`; returns a bound on the way of any node, the root of the sum of their squares.
    ///
    /// # Errors
    /// The first node that moved further than half a unit length, or to no number, and how far.
    pub fn step(&mut self, dt: f64) -> Result<f64, (usize, f64)> {
        self.evaluate_forces();
        self.integrate_damped(dt, 0.0)
    }

    /// Moves the nodes by one step of length `dt` with the forces of the last evaluation and a viscous force −c v,
    /// centred in the step; c = 0 is semi-implicit Euler.
    ///
    /// # Errors
    /// As [`Self::step`].
    pub fn integrate_damped(&mut self, dt: f64, c: f64) -> Result<f64, (usize, f64)> {
        let keep = (1.0 - 0.5 * c * dt) / (1.0 + 0.5 * c * dt);
        let gain = dt / (1.0 + 0.5 * c * dt);
        let mut squared_speeds = 0.0;
        let nodes = self.velocities.iter_mut().zip(&mut self.positions);
        for ((v, x), force) in nodes.zip(&self.forces) {
            *v = *v * keep + *force * gain;
            *x += *v * dt;
            squared_speeds += v.length_squared();
        }
        // The sum carries a NaN where a maximum would lose it.
        let way = squared_speeds.sqrt() * dt;
        if way <= MAX_DISPLACEMENT {
            return Ok(way);
        }
        let displacements = self.velocities.iter().map(|v| v.length() * dt);
        let runaway = displacements
            .enumerate()
            .find(|(_, d)| d.is_nan() || *d > MAX_DISPLACEMENT);
        runaway.map_or(Ok(way), Err)
    }

    /// Evaluates the fold angles afresh: of each the value, modulo 2π, nearest to its target.
    pub fn follow_angles_from_targets(&mut self) {
        self.angles.copy_from_slice(&self.targets);
        self.model.follow_angles(&self.positions, &mut self.angles);
        for (hinge, angle) in self.hinge_forces.iter_mut().zip(&self.angles) {
            hinge.angle = *angle;
        }
    }

    /// The largest force on a node at the last evaluation over the fold stiffness.
    pub fn residual(&self) -> f64 {
        largest_length(&self.forces) / self.model.material.fold_stiffness
    }

    /// The largest |v| of a node.
    pub fn largest_speed(&self) -> f64 {
        largest_length(&self.velocities)
    }

    /// The largest |θ − θ*| of a hinge at the last evaluation.
    pub fn fold_angle_error(&self) -> f64 {
        let errors = self
            .angles
            .iter()
            .zip(&self.targets)
            .map(|(angle, target)| angle - target);
        errors.map(f64::abs).fold(0.0, f64::max)
    }

    /// Σ |v|² / 2.
    pub fn kinetic_energy(&self) -> f64 {
        0.5 * self
            .velocities
            .iter()
            .map(|v| v.length_squared())
            .sum::<f64>()
    }

    fn evaluate_bars(&mut self) {
        let Self {
            model,
            positions,
            velocities,
            bar_dampers,
            damping,
            ..
        } = self;
        fill(self.is_parallel, &mut self.bar_forces, |index, force| {
            let bar = &model.bars[index];
            let [a, b] = bar.vertices.map(|v| v as usize);
            let drag = (velocities[b] - velocities[a]) * (bar_dampers[index] * *damping);
            *force = bar.pull(positions) + drag;
        });
    }

    fn evaluate_hinges(&mut self) {
        let Self {
            model,
            positions,
            targets,
            ..
        } = self;
        fill(
            self.is_parallel,
            &mut self.hinge_forces,
            |index, hinge_forces| {
                let hinge = &model.hinges[index];
                let [e0, e1, left, right] = hinge.vertices.map(|v| positions[v as usize]);
                let angle = nearest_turn(fold_angle(e0, e1, left, right), hinge_forces.angle);
                let torque = hinge.stiffness * (targets[index] - angle);
                let corners = fold_angle_gradient(e0, e1, left, right).map(|slope| slope * torque);
                *hinge_forces = HingeForces { corners, angle };
            },
        );
        for (angle, hinge) in self.angles.iter_mut().zip(&self.hinge_forces) {
            *angle = hinge.angle;
        }
    }

    fn evaluate_face_angles(&mut self) {
        let Self {
            model, positions, ..
        } = self;
        fill(self.is_parallel, &mut self.face_forces, |index, forces| {
            let stiffness = model.material.face_angle_stiffness;
            *forces = model.face_angles[index]
                .energy_gradient(positions, stiffness)
                .map(|g| -g);
        });
    }

    fn gather_forces(&mut self) {
        let Self {
            model,
            bar_forces,
            hinge_forces,
            face_forces,
            ..
        } = self;
        let face_forces = face_forces.as_flattened();
        fill(self.is_parallel, &mut self.forces, |node, force| {
            let mut sum = DVec3::ZERO;
            for &slot in model.bar_gather.slots(node) {
                let pull = bar_forces[slot as usize / 2];
                sum += if slot % 2 == 0 { pull } else { -pull };
            }
            for &slot in model.hinge_gather.slots(node) {
                sum += hinge_forces[slot as usize / 4].corners[slot as usize % 4];
            }
            for &slot in model.face_gather.slots(node) {
                sum += face_forces[slot as usize];
            }
            *force = sum;
        });
    }
}

fn largest_length(vectors: &[DVec3]) -> f64 {
    vectors
        .iter()
        .map(|v| v.length_squared())
        .fold(0.0, f64::max)
        .sqrt()
}
