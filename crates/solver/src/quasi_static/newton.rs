//! Newton's method for the equilibrium of the sheet at given targets.
//!
//! Each step solves (K + S + μ I) d = −∇U. K is the exact Hessian where that is positive definite, elsewhere the exact
//! one with μ > 0 or the convex one; its bars carry the forces that the step before foresaw. S removes the six rigid motions: stiff springs that support one triangle of the
//! sheet statically determinately. They enter the matrix alone, never the forces; as ∇U is in balance, the step they
//! give is an exact Newton step, with that triangle's support unmoved; of a floating sheet the rigid part of the step
//! is then taken away, and where μ > 0 makes the matrix regular, S is left out. μ acts as inertia relative to the last
//! iterate and vanishes as the search converges. Once K is the exact one and the steps shrink fast, its factor serves
//! for the following steps too (the chord method): near the equilibrium they cost a fraction and lead to the same
//! point. With contact every step is cut where two layers would come too close.

use glam::DVec3;

use super::configuration::{Configuration, dot, largest};
use super::contact::ContactField;
use super::effort::Effort;
use super::element_stiffness::{
    Curvature, ElementMap, add_stiffness, coupled_nodes, elongations, foreseen_elongations,
};
use super::model_step::ModelStep;
use super::stall::Stall;
use super::stiffness_matrix::StiffnessMatrix;
use super::support::{Support, add_support, remove_rigid_motion, supporting_triangle};
use crate::budget::Allowance;
use crate::{Model, SolverError};

/// Furthest a node moves in one iteration, in unit lengths.
const LARGEST_MOVE: f64 = 0.5;
/// Furthest a hinge turns in one iteration, radians: below π, so that it can be followed.
const LARGEST_TURN: f64 = 0.5;
/// Armijo's constant: the share of the predicted decrease a step must reach.
const SUFFICIENT_DECREASE: f64 = 1e-4;
/// Halvings of a step before its direction is given up.
const MAX_HALVINGS: usize = 14;
/// The share of the energy that is taken for rounding.
const ENERGY_ROUNDING: f64 = 1e-13;
/// Positions are known to this share of the bars' lengths.
const LENGTH_ROUNDING: f64 = 8.0 * f64::EPSILON;
/// μ over the mean diagonal of K: where it starts, its range, and by how much it falls after a step that needed it.
const INERTIA: f64 = 1e-5;
const LEAST_INERTIA: f64 = 1e-9;
const MOST_INERTIA: f64 = 1e-2;
const INERTIA_DECAY: f64 = 0.25;
/// A step with an earlier factor is taken where it is at most this share of the step before it.
const CHORD_DECREASE: f64 = 0.1;
/// A round that advances by less than this share ends the search for the step.
const LEAST_ADVANCE: f64 = 1e-6;
/// After as many iterations a state whose energy is level but for rounding is no longer polished.
const POLISHED: usize = 8;
/// Contact is foreseen for steps that move no node further.
const FURTHEST_FORESEEN: f64 = 0.2;

/// The outcome of a search for equilibrium.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SearchOutcome {
    pub(super) converged: bool,
    /// The largest nodal force left.
    pub(super) residual: f64,
    pub(super) iterations: usize,
    pub(super) factorisations: usize,
}

/// When a state counts as an equilibrium.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tolerance {
    /// The largest nodal force.
    pub(super) force: f64,
    /// The largest move of the last Newton step: what then remains is of the order of its square.
    pub(super) step: f64,
    /// The largest move that a further step with an earlier factor would make.
    pub(super) remainder: f64,
    /// A balanced state is level where a step promises to lower the energy by no more than this share of it: the rest is
    /// motion of a sheet that resists none. 0: by no more than rounding, and after some polishing.
    pub(super) level: f64,
}

/// The search, with the matrix it reuses.
pub(super) struct Newton<'a> {
    model: &'a Model,
    matrix: StiffnessMatrix,
    elements: ElementMap,
    support: Support,
    /// The triangle that S supports.
    supported: [u32; 3],
    /// Σ k l₀² over the bars.
    bar_stiffness: f64,
    inertia: f64,
    /// The attempt that gave the last step.
    attempt: usize,
    /// The elongations of the bars that the Hessian is made with.
    elongations: Vec<f64>,
    /// The Hessian without contact that the matrix has or keeps, whether it is supported, and the mean of its diagonal,
    /// while the state is the one it was assembled at.
    assembled: Option<(Curvature, bool, f64)>,
    /// The largest move of the last step, if the current factor is exact and was used for it.
    chord: Option<f64>,
    pub(super) contact: Option<ContactField>,
    /// Rounds in which the active planes of a step are found; after as many the step is taken as it is.
    most_rounds: usize,
    pub(super) factorisations: usize,
    pub(super) analyses: usize,
    pub(super) effort: Effort,
}

impl<'a> Newton<'a> {
    pub(super) fn new(
        model: &'a Model,
        contact: Option<ContactField>,
        support: Support,
        most_rounds: usize,
    ) -> Result<Self, SolverError> {
        let matrix = StiffnessMatrix::new(model.node_count(), &coupled_nodes(model))?;
        Ok(Self {
            model,
            elements: ElementMap::new(model, &matrix),
            matrix,
            support,
            supported: supporting_triangle(model),
            bar_stiffness: model
                .bars
                .iter()
                .map(|bar| bar.stiffness * bar.rest_length * bar.rest_length)
                .sum(),
            inertia: INERTIA,
            attempt: 0,
            elongations: Vec::new(),
            assembled: None,
            chord: None,
            contact,
            most_rounds,
            factorisations: 0,
            analyses: 1,
            effort: Effort::default(),
        })
    }

    /// Moves `state` to the equilibrium at `targets`, or as far as it gets within `allowance`.
    ///
    /// `tolerances`: without contact, and where layers push. `visit` is called with every state on the path and may end
    /// the search. On the straight path between two of them no layer touches another.
    ///
    /// # Errors
    /// Those of [`StiffnessMatrix::new`] and of `visit`.
    pub(super) fn settle(
        &mut self,
        state: &mut Configuration,
        targets: &[f64],
        tolerances: [Tolerance; 2],
        allowance: Allowance,
        visit: &mut dyn FnMut(&Configuration) -> Result<(), SolverError>,
    ) -> Result<SearchOutcome, SolverError> {
        self.linearise(state);
        let mut energy = self.energy(state, targets);
        let mut gradient = self.gradient(state, targets);
        self.inertia = INERTIA;
        self.attempt = 0;
        self.chord = None;
        self.elongations = elongations(self.model, &state.positions);
        let earlier = self.factorisations;
        let (mut is_near, mut is_level) = (false, false);
        let mut stall = Stall::NONE;
        let mut iterations = 0;
        let mut residual = largest(&gradient);
        loop {
            let pushes = |c: &ContactField| c.pushes();
            let tolerance = tolerances[usize::from(self.contact.as_ref().is_some_and(pushes))];
            let factorisations = self.factorisations - earlier;
            let settled =
                |converged| SearchOutcome { converged, residual, iterations, factorisations };
            // Where the energy is level but for rounding, steps wander and leave forces of rounding's making.
            let force = if is_level { tolerances[1].force } else { tolerance.force };
            let is_balanced = residual <= force + self.contact_rounding(state);
            if is_balanced && (is_near || is_level) {
                let updates = |c: &mut ContactField| c.update_multipliers(&state.positions);
                if self.contact.as_mut().is_some_and(updates) {
                    energy = self.energy(state, targets);
                    gradient = self.gradient(state, targets);
                    (is_near, is_level) = (false, false);
                    stall = Stall::NONE;
                    self.effort.multiplier_updates += 1;
                    continue;
                }
                return Ok(settled(true));
            }
            let is_stalled = stall.note(energy, residual, self.energy_rounding(energy));
            if is_stalled || allowance.is_spent(iterations as u64) || !energy.is_finite() {
                return Ok(settled(is_balanced));
            }
            let Some(step) = self.step(state, targets, &gradient, energy)? else {
                // Nothing lowers the energy any further: rounding has the last word.
                return Ok(settled(is_balanced));
            };
            is_near = step.is_last(&tolerance);
            is_level = if tolerance.level > 0.0 {
                step.promised <= tolerance.level * energy.abs()
            } else {
                step.promised <= self.energy_rounding(energy) && iterations > POLISHED
            };
            residual = largest(&step.gradient);
            let [from, to] = [&state.positions, &step.state.positions];
            self.elongations = foreseen_elongations(self.model, from, to);
            *state = step.state;
            if self.contact.is_some() {
                self.linearise(state);
                if step.is_cut && self.stiffen(state) {
                    stall = Stall::NONE;
                }
                energy = self.energy(state, targets);
                gradient = self.gradient(state, targets);
            } else {
                energy = step.energy;
                gradient = step.gradient;
            }
            iterations += 1;
            visit(state)?;
        }
    }

    /// Holds the planes of contact at `state`.
    fn linearise(&mut self, state: &Configuration) {
        if let Some(contact) = &mut self.contact {
            contact.linearise(&state.positions);
        }
    }

    /// Stiffens the pairs that are pressed hard in `state`; whether there are any.
    fn stiffen(&mut self, state: &Configuration) -> bool {
        self.contact.as_mut().is_some_and(|contact| contact.stiffen(&state.positions))
    }

    /// The nodal force that rounding of the contact may leave.
    fn contact_rounding(&self, state: &Configuration) -> f64 {
        let contact = self.contact.as_ref().filter(|contact| contact.pushes());
        contact.map_or(0.0, |contact| contact.rounding_force(&state.positions))
    }

    fn energy(&mut self, state: &Configuration, targets: &[f64]) -> f64 {
        let elastic = self.model.energy_by_kind(&state.positions, &state.angles, targets).total();
        let contact = self.contact.as_ref().map(|c| c.energy(&state.positions));
        elastic + contact.unwrap_or(0.0)
    }

    fn gradient(&mut self, state: &Configuration, targets: &[f64]) -> Vec<DVec3> {
        let mut gradient = vec![DVec3::ZERO; state.positions.len()];
        self.model.gradient(&state.positions, &state.angles, targets, &mut gradient);
        if let Some(contact) = &self.contact {
            contact.add_gradient(&state.positions, &mut gradient);
        }
        gradient
    }

    /// One accepted step, or `None` if no direction lowers the energy.
    fn step(
        &mut self,
        state: &Configuration,
        targets: &[f64],
        gradient: &[DVec3],
        energy: f64,
    ) -> Result<Option<Step>, SolverError> {
        self.assembled = None;
        if let Some(step) = self.chord_step(state, targets, gradient, energy) {
            return Ok(Some(step));
        }
        let inertia = self.inertia;
        let attempts = [
            (Curvature::Exact, 0.0),
            (Curvature::Exact, inertia),
            (Curvature::Exact, 10.0 * inertia),
            (Curvature::Exact, 100.0 * inertia),
            (Curvature::Convex, 0.0),
            (Curvature::Convex, 1e-4),
            (Curvature::Convex, 1e-2),
            (Curvature::Convex, 1.0),
        ];
        // What was needed last is tried first, but for one attempt that would be better.
        let first = self.attempt.saturating_sub(1);
        for (attempt, (curvature, inertia)) in attempts.into_iter().enumerate().skip(first) {
            let direction = self.newton_direction(state, targets, gradient, curvature, inertia)?;
            let Some(direction) = direction else {
                continue;
            };
            if let Some(step) = self.search(state, targets, gradient, energy, &direction) {
                if inertia > 0.0 {
                    self.inertia = (inertia * INERTIA_DECAY).clamp(LEAST_INERTIA, MOST_INERTIA);
                }
                self.attempt = attempt;
                let is_exact = curvature == Curvature::Exact && inertia == 0.0;
                self.chord = step.full_move.filter(|_| is_exact);
                return Ok(Some(step));
            }
        }
        Ok(None)
    }

    /// −(K + S + μ I)⁻¹ ∇U, or with contact the step that keeps the gaps it would break; `None` where the matrix is not
    /// positive definite.
    fn newton_direction(
        &mut self,
        state: &Configuration,
        targets: &[f64],
        gradient: &[DVec3],
        curvature: Curvature,
        inertia: f64,
    ) -> Result<Option<Vec<DVec3>>, SolverError> {
        let Some(mut contact) = self.contact.take() else {
            let is_definite = self.factorise(state, targets, curvature, inertia, None);
            return Ok(is_definite.then(|| self.direction(state, gradient)));
        };
        let direction = self.foreseen(state, targets, gradient, (curvature, inertia), &mut contact);
        self.contact = Some(contact);
        direction
    }

    /// The minimum of the quadratic model of the energy and of the augmented Lagrangian of the planes, found by Newton's
    /// method with exact line search (semismooth: the latter's pieces are quadratic; Qi and Sun 1993): each round makes
    /// those planes active that push at the step found so far. Planes of pairs that only the step would bring too close
    /// are made on the way.
    fn foreseen(
        &mut self,
        state: &Configuration,
        targets: &[f64],
        gradient: &[DVec3],
        (curvature, inertia): (Curvature, f64),
        contact: &mut ContactField,
    ) -> Result<Option<Vec<DVec3>>, SolverError> {
        let x = &state.positions;
        let mut step = ModelStep::none(x.len());
        for round in 0..self.most_rounds {
            self.make_room(contact)?;
            if !self.factorise(state, targets, curvature, inertia, Some(contact)) {
                return Ok(None);
            }
            self.effort.rounds += 1;
            let Some(ahead) = self.model_step(state, gradient, contact) else {
                return Ok(None);
            };
            if round == 0 {
                contact.foresee(x, &ahead.direction, largest(&ahead.direction));
            }
            let share = contact.model_minimum(gradient, &step, &ahead);
            step.advance(share, &ahead);
            let changed = contact.activate(&step.direction);
            let is_least = (share == 1.0 && !changed) || share < LEAST_ADVANCE;
            if is_least {
                if !contact.foresee(x, &step.direction, largest(&step.direction)) {
                    break;
                }
                contact.activate(&step.direction);
            }
        }
        Ok(Some(step.direction))
    }

    /// The Newton step of the model with the active planes, with the current factor, no longer than contact is foreseen.
    fn model_step(
        &mut self,
        state: &Configuration,
        gradient: &[DVec3],
        contact: &ContactField,
    ) -> Option<ModelStep> {
        let mut model_gradient = gradient.to_vec();
        contact.add_foreseen(&mut model_gradient);
        let direction = self.direction(state, &model_gradient);
        let reach = largest(&direction);
        // H d is what is left of −∇U once the planes' part is taken off.
        let mut elastic: Vec<DVec3> = model_gradient.iter().map(|&g| -g).collect();
        contact.subtract_stiffness(&direction, &mut elastic);
        let mut step = ModelStep { direction, elastic };
        if reach > FURTHEST_FORESEEN {
            step.scale(FURTHEST_FORESEEN / reach);
        }
        reach.is_finite().then_some(step)
    }

    /// A step with the factor of an earlier one; `None` if it would not be much smaller than the step before.
    fn chord_step(
        &mut self,
        state: &Configuration,
        targets: &[f64],
        gradient: &[DVec3],
        energy: f64,
    ) -> Option<Step> {
        let last = self.chord.take()?;
        let direction = self.direction(state, gradient);
        let decrease = largest(&direction) / last;
        if decrease.is_nan() || decrease > CHORD_DECREASE {
            return None;
        }
        let mut step = self.search(state, targets, gradient, energy, &direction)?;
        self.chord = step.full_move;
        step.decrease = Some(decrease);
        self.effort.chord_steps += 1;
        Some(step)
    }

    /// Makes room in the matrix for the active planes.
    fn make_room(&mut self, contact: &ContactField) -> Result<(), SolverError> {
        if contact.fits(&self.matrix) {
            return Ok(());
        }
        // Room for earlier planes would fill the factor more and more.
        let mut pairs = coupled_nodes(self.model);
        pairs.extend(contact.coupled_nodes());
        self.matrix = StiffnessMatrix::new(self.model.node_count(), &pairs)?;
        self.elements = ElementMap::new(self.model, &self.matrix);
        self.assembled = None;
        self.analyses += 1;
        Ok(())
    }

    /// Factorises K + S + μ I at `state`, μ = `inertia` over the mean diagonal; false where that is not positive
    /// definite.
    fn factorise(
        &mut self,
        state: &Configuration,
        targets: &[f64],
        curvature: Curvature,
        inertia: f64,
        contact: Option<&ContactField>,
    ) -> bool {
        // Inertia alone makes the matrix positive definite.
        let is_supported = self.support == Support::Triangle || inertia == 0.0;
        let known = self
            .assembled
            .filter(|(present, supported, _)| *present == curvature && *supported == is_supported);
        let scale = match (known, contact) {
            (Some((.., scale)), None) => scale,
            (Some((.., scale)), Some(_)) => {
                self.matrix.restore();
                scale
            }
            (None, _) => {
                let scale = self.assemble(state, targets, curvature, is_supported);
                if contact.is_some() {
                    self.matrix.keep();
                }
                scale
            }
        };
        self.assembled = Some((curvature, is_supported, scale));
        if let Some(contact) = contact {
            let is_exact = curvature == Curvature::Exact;
            contact.add_stiffness(&state.positions, is_exact, &mut self.matrix);
        }
        self.factorisations += 1;
        let is_definite = self.matrix.factorise(inertia * scale);
        self.effort.indefinite += usize::from(!is_definite);
        is_definite
    }

    /// Assembles K + S without contact; returns the mean diagonal of K.
    fn assemble(
        &mut self,
        state: &Configuration,
        targets: &[f64],
        curvature: Curvature,
        is_supported: bool,
    ) -> f64 {
        self.matrix.clear();
        let (elements, matrix) = (&self.elements, &mut self.matrix);
        add_stiffness(self.model, state, targets, &self.elongations, curvature, elements, matrix);
        let scale = self.matrix.mean_diagonal();
        if is_supported {
            add_support(self.supported, state, scale, &mut self.matrix);
        }
        scale
    }

    /// −(K + S + μ I)⁻¹ ∇U with the current factor.
    fn direction(&mut self, state: &Configuration, gradient: &[DVec3]) -> Vec<DVec3> {
        let mut direction: Vec<DVec3> = gradient.iter().map(|&g| -g).collect();
        self.matrix.solve(&mut direction);
        if self.support == Support::Floating {
            remove_rigid_motion(&state.positions, &mut direction);
        }
        direction
    }

    /// Backtracks along `direction` until the energy falls enough.
    fn search(
        &mut self,
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
        let first = (LARGEST_MOVE / reach).min(1.0);
        let mut length = self.limited(&state.positions, direction, first);
        let is_cut = length < first;
        self.effort.cut_steps += usize::from(is_cut);
        let residual = largest(gradient);
        let rounding = self.energy_rounding(energy);
        for _halving in 0..MAX_HALVINGS {
            if let Some(trial) = state.moved(self.model, direction, length, LARGEST_TURN) {
                let trial_energy = self.energy(&trial, targets);
                let falls = trial_energy <= energy + SUFFICIENT_DECREASE * length * slope;
                let is_level = (trial_energy - energy).abs() <= rounding;
                if falls || is_level {
                    let trial_gradient = self.gradient(&trial, targets);
                    if falls || largest(&trial_gradient) < residual {
                        return Some(Step {
                            state: trial,
                            energy: trial_energy,
                            gradient: trial_gradient,
                            full_move: (length == 1.0).then_some(reach),
                            decrease: None,
                            is_cut,
                            promised: -slope,
                        });
                    }
                }
            }
            length *= 0.5;
            self.effort.halvings += 1;
        }
        None
    }

    /// What rounding may change of `energy`: a share of it, and the work of the bars' forces F on what positions are
    /// known to, of which Σ |F| l₀ ≤ √(2 U Σ k l₀²). The second counts in a sheet that is nearly at rest.
    fn energy_rounding(&self, energy: f64) -> f64 {
        let forces = (2.0 * energy.abs() * self.bar_stiffness).sqrt();
        ENERGY_ROUNDING * energy.abs() + LENGTH_ROUNDING * forces
    }

    /// The largest part of `length` × `direction` that contact allows.
    pub(super) fn limited(&mut self, positions: &[DVec3], direction: &[DVec3], length: f64) -> f64 {
        match &mut self.contact {
            Some(contact) => contact.step_limit(positions, direction, length),
            None => length,
        }
    }
}

/// A step of Newton's method that was accepted.
struct Step {
    state: Configuration,
    energy: f64,
    gradient: Vec<DVec3>,
    /// The largest move of a full step; a shortened one says nothing about convergence.
    full_move: Option<f64>,
    /// The move over that of the step before, where this step was made with the same factor.
    decrease: Option<f64>,
    /// Whether contact shortened it.
    is_cut: bool,
    /// By how much it was to lower the energy, to first order.
    promised: f64,
}

impl Step {
    /// Whether a further step would make no difference.
    fn is_last(&self, tolerance: &Tolerance) -> bool {
        self.full_move.is_some_and(|moved| match self.decrease {
            Some(decrease) => moved * decrease <= tolerance.remainder,
            None => moved <= tolerance.step,
        })
    }
}
