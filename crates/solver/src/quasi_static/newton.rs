//! Newton's method for the equilibrium of the sheet at given targets.
//!
//! Each step solves (K + S + μ I) d = −∇U. K is the exact Hessian where that is positive definite and the convex one
//! elsewhere. S removes the six rigid motions: stiff springs that support one triangle of the sheet statically
//! determinately. They enter the matrix alone, never the forces; as ∇U is in balance, the step they give is an exact
//! Newton step, with that triangle's support unmoved. μ is 0 unless no step along d lowers the energy; then it grows,
//! which acts as inertia relative to the last iterate.

use glam::{DMat3, DVec3};

use super::configuration::{Configuration, dot, largest};
use super::element_stiffness::{Curvature, add_stiffness, coupled_nodes};
use super::hinge_hessian::outer;
use super::stiffness_matrix::StiffnessMatrix;
use crate::{Model, SolverError};

/// Furthest a node moves in one iteration, in unit lengths.
const LARGEST_MOVE: f64 = 0.5;
/// Furthest a hinge turns in one iteration, radians: below π, so that it can be followed.
const LARGEST_TURN: f64 = 1.0;
/// Armijo's constant: the share of the predicted decrease a step must reach.
const SUFFICIENT_DECREASE: f64 = 1e-4;
/// Halvings of a step before its direction is given up.
const MAX_HALVINGS: usize = 14;
/// The share of the energy that is taken for rounding.
const ENERGY_ROUNDING: f64 = 1e-13;

/// How a search for equilibrium ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Settled {
    pub(super) converged: bool,
    /// The largest nodal force left.
    pub(super) residual: f64,
    pub(super) iterations: usize,
}

/// When a state counts as an equilibrium.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tolerance {
    /// The largest nodal force.
    pub(super) force: f64,
    /// The largest move of the last Newton step.
    pub(super) step: f64,
}

/// The search, with the matrix it reuses.
pub(super) struct Newton<'a> {
    model: &'a Model,
    matrix: StiffnessMatrix,
    support: [u32; 3],
    max_iterations: usize,
    /// μ over the mean diagonal of K.
    inertia: f64,
    pub(super) factorisations: usize,
}

impl<'a> Newton<'a> {
    pub(super) fn new(model: &'a Model, max_iterations: usize) -> Result<Self, SolverError> {
        let matrix = StiffnessMatrix::new(model.node_count(), &coupled_nodes(model))?;
        Ok(Self {
            model,
            matrix,
            support: supporting_triangle(model),
            max_iterations,
            inertia: 0.0,
            factorisations: 0,
        })
    }

    /// Moves `state` to the equilibrium at `targets`, or as far as it gets.
    pub(super) fn settle(
        &mut self,
        state: &mut Configuration,
        targets: &[f64],
        tolerance: Tolerance,
    ) -> Settled {
        let mut gradient = vec![DVec3::ZERO; state.positions.len()];
        let mut energy = self.energy(state, targets);
        self.gradient(state, targets, &mut gradient);
        self.inertia = 0.0;
        let mut last_move = f64::INFINITY;
        let mut iterations = 0;
        loop {
            let residual = largest(&gradient);
            let settled = |converged| Settled {
                converged,
                residual,
                iterations,
            };
            let balanced = residual <= tolerance.force;
            if balanced && last_move <= tolerance.step {
                return settled(true);
            }
            if iterations == self.max_iterations || !energy.is_finite() {
                return settled(balanced);
            }
            let Some(step) = self.step(state, targets, &gradient, energy) else {
                // Nothing lowers the energy any further: rounding has the last word.
                return settled(balanced);
            };
            last_move = step.largest_move;
            *state = step.state;
            energy = step.energy;
            gradient = step.gradient;
            iterations += 1;
        }
    }

    fn energy(&self, state: &Configuration, targets: &[f64]) -> f64 {
        self.model
            .energy_by_kind(&state.positions, &state.angles, targets)
            .total()
    }

    fn gradient(&self, state: &Configuration, targets: &[f64], gradient: &mut [DVec3]) {
        self.model
            .gradient(&state.positions, &state.angles, targets, gradient);
    }

    /// One accepted step, or none where no direction lowers the energy.
    fn step(
        &mut self,
        state: &Configuration,
        targets: &[f64],
        gradient: &[DVec3],
        energy: f64,
    ) -> Option<Step> {
        for curvature in [Curvature::Exact, Curvature::Convex] {
            let inertias: &[f64] = match curvature {
                Curvature::Exact => &[0.0],
                Curvature::Convex => &[0.0, 1e-6, 1e-4, 1e-2, 1.0],
            };
            for &inertia in inertias {
                let Some(direction) = self.direction(state, targets, gradient, curvature, inertia)
                else {
                    continue;
                };
                if let Some(step) = self.search(state, targets, gradient, energy, &direction) {
                    return Some(step);
                }
            }
        }
        None
    }

    /// −(K + S + μ I)⁻¹ ∇U; none where the matrix is not positive definite.
    fn direction(
        &mut self,
        state: &Configuration,
        targets: &[f64],
        gradient: &[DVec3],
        curvature: Curvature,
        inertia: f64,
    ) -> Option<Vec<DVec3>> {
        self.matrix.clear();
        add_stiffness(self.model, state, targets, curvature, &mut self.matrix);
        let scale = self.matrix.mean_diagonal();
        add_support(self.support, state, scale, &mut self.matrix);
        if inertia > 0.0 {
            self.matrix.shift(inertia * scale);
        }
        self.factorisations += 1;
        if !self.matrix.factorise() {
            return None;
        }
        let mut direction: Vec<DVec3> = gradient.iter().map(|&g| -g).collect();
        self.matrix.solve(&mut direction);
        Some(direction)
    }

    /// Backtracks along `direction` until the energy falls enough.
    fn search(
        &self,
        state: &Configuration,
        targets: &[f64],
        gradient: &[DVec3],
        energy: f64,
        direction: &[DVec3],
    ) -> Option<Step> {
        let slope = dot(gradient, direction);
        let reach = largest(direction);
        if !(slope < 0.0 && reach.is_finite()) {
            return None;
        }
        let mut length = (LARGEST_MOVE / reach).min(1.0);
        let residual = largest(gradient);
        let mut trial_gradient = vec![DVec3::ZERO; gradient.len()];
        for _halving in 0..MAX_HALVINGS {
            if let Some(trial) = state.moved(self.model, direction, length, LARGEST_TURN) {
                let trial_energy = self.energy(&trial, targets);
                let falls = trial_energy <= energy + SUFFICIENT_DECREASE * length * slope;
                let is_level = (trial_energy - energy).abs() <= ENERGY_ROUNDING * energy.abs();
                if falls || is_level {
                    self.gradient(&trial, targets, &mut trial_gradient);
                    if falls || largest(&trial_gradient) < residual {
                        return Some(Step {
                            state: trial,
                            energy: trial_energy,
                            gradient: trial_gradient,
                            largest_move: if length == 1.0 { reach } else { f64::INFINITY },
                        });
                    }
                }
            }
            length *= 0.5;
        }
        None
    }
}

/// An accepted step.
struct Step {
    state: Configuration,
    energy: f64,
    gradient: Vec<DVec3>,
    /// The largest move of a full step; infinite for a shortened one, which says nothing about convergence.
    largest_move: f64,
}

/// A triangle amid the sheet: the left one of the middle hinge; of a sheet without hinges its one triangle.
fn supporting_triangle(model: &Model) -> [u32; 3] {
    if let Some(hinge) = model.hinges.get(model.hinges.len() / 2) {
        let [e0, e1, left, _] = hinge.vertices;
        return [e0, e1, left];
    }
    let [a, b] = model.bars[0].vertices;
    let others = model.bars.iter().flat_map(|bar| bar.vertices);
    let c = others.into_iter().find(|&v| v != a && v != b).unwrap_or(b);
    [a, b, c]
}

/// Supports the triangle: its first node in space, its second across the line to the first, its third across the
/// plane of the three.
fn add_support(
    triangle: [u32; 3],
    state: &Configuration,
    stiffness: f64,
    matrix: &mut StiffnessMatrix,
) {
    let [a, b, c] = triangle.map(|v| state.positions[v as usize]);
    let along = (b - a).normalize_or_zero();
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let [i, j, k] = triangle;
    matrix.add(i, i, DMat3::IDENTITY * stiffness);
    matrix.add(j, j, (DMat3::IDENTITY - outer(along, along)) * stiffness);
    matrix.add(k, k, outer(normal, normal) * stiffness);
}
