//! Contact: layers that push each other apart and cannot pass through one another.
//!
//! Every vertex and facet and every two edges that share no vertex keep the gap g. Those two kinds of pairs are enough:
//! surfaces that do not cross can begin to cross only where a vertex meets a facet or an edge an edge (Provot 1997),
//! also for facets that share a vertex or an edge, whose other corners and opposite edges are such pairs. A crease
//! can therefore close up to 180° less the turn that holds its apexes g apart, never beyond.
//!
//! Forces come from an augmented Lagrangian of [planes](plane) made anew for every Newton step; a step finds the pairs
//! it would bring too close before it is taken. What guarantees that no layer passes through another is apart from
//! that: every step ends before a pair has given up half of its gap, by continuous collision detection
//! ([`step_limit`]).
//!
//! Pairs that start closer than twice g (the seam of a closed profile, facets narrower than that) keep half of the
//! largest distance they have had, until that is g. Pairs that start in touch, such as the sides of a cut, are not
//! pushed apart until they have come apart; that no facets cross there is tested
//! at every equilibrium, and on the way to it, instead.

mod candidates;
mod closest;
mod near;
mod pair;
mod plane;
mod primitives;
mod step_limit;

use std::collections::BTreeMap;

use glam::DVec3;

use self::candidates::Candidates;
use self::plane::{Form, Plane};
use self::primitives::Primitives;
use super::configuration::{dot, largest};
use super::model_step::ModelStep;
use super::stiffness_matrix::StiffnessMatrix;
use crate::{Model, SolverError};

/// The share of the gap that may be missing in equilibrium.
const VIOLATION: f64 = 0.1;
/// Layers keep the gap over this, so that what is missing in equilibrium does not show.
const KEPT: f64 = 1.0 - VIOLATION;
/// Pairs that come closer than this many gaps on the way to an equilibrium are pressed hard.
const PRESSED: f64 = 0.75;
/// By how much κ grows of a pair whose multiplier converges too slowly, and of one that cut a step short: each step that
/// it cuts is lost for the rest of the sheet.
const STIFFENING: f64 = 2.0;
const STIFFENING_OF_CUTS: f64 = 8.0;
/// Positions are known to this share of their size.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// A gap above this share of the smallest height of a facet cannot be kept by a folded sheet.
const LARGEST_GAP: f64 = 0.25;
/// Layers that may lie between the facets of one crease.
const LAYERS: f64 = 8.0;
/// The number of blocking pairs reported.
const HARDEST: usize = 8;
/// Bisections for the minimum of the model along a line.
const BISECTIONS: usize = 40;

/// Contact of the layers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// g, the closest approach of primitives that share no vertex, in unit lengths.
    pub gap: f64,
    /// What becomes of g by the end of stage fold, at most g: the sheet closes where its creases follow their targets.
    pub final_gap: f64,
}

impl Contact {
    /// Contact with a gap that stays the same.
    pub fn constant(gap: f64) -> Self {
        Self { gap, final_gap: gap }
    }
}

impl Default for Contact {
    fn default() -> Self {
        Self { gap: 1e-3, final_gap: 1e-5 }
    }
}

/// The forces between the layers of a sheet, and the candidates for them.
pub(super) struct ContactField {
    candidates: Candidates,
    smallest_height: f64,
    planes: Vec<Plane>,
    /// κ g, a force.
    force: f64,
}

impl ContactField {
    /// The contact of `model` from `start` (unit lengths) on; `force` scales the stiffness of contact.
    ///
    /// # Errors
    /// [`SolverError::GapTooLarge`], [`SolverError::FinalGap`], and [`SolverError::StartCrosses`] where the sheet crosses itself at the start.
    pub(super) fn new(
        model: &Model,
        contact: Contact,
        force: f64,
        start: &[DVec3],
    ) -> Result<Self, SolverError> {
        let Contact { gap, final_gap } = contact;
        let primitives = Primitives::new(model);
        let smallest_height = primitives.smallest_height(start);
        let maximum = LARGEST_GAP * smallest_height;
        if !(gap > 0.0 && gap <= maximum) {
            return Err(SolverError::GapTooLarge { gap, maximum });
        }
        if !(final_gap > 0.0 && final_gap <= gap) {
            return Err(SolverError::FinalGap { final_gap, gap });
        }
        let candidates = Candidates::new(primitives, gap / KEPT, start)?;
        Ok(Self { candidates, smallest_height, planes: Vec::new(), force })
    }

    /// g.
    pub(super) fn gap(&self) -> f64 {
        self.candidates.gap() * KEPT
    }

    /// Lets the layers come as close as `gap`, if that is closer than before.
    pub(super) fn close_to(&mut self, gap: f64) {
        self.candidates.close_to(gap / KEPT);
    }

    /// κ.
    pub(super) fn stiffness(&self) -> f64 {
        self.force / self.candidates.gap()
    }

    /// The force that rounding of `positions` may leave: κ of the stiffest plane times it.
    pub(super) fn rounding_force(&self, positions: &[DVec3]) -> f64 {
        let stiffness =
            self.planes.iter().map(|plane| plane.stiffness).fold(self.stiffness(), f64::max);
        ROUNDING * stiffness * largest(positions)
    }

    /// How far layers a gap apart may keep creases from their targets, in radians: several layers over the smallest
    /// height of a triangle.
    pub(super) fn fold_angle_slack(&self) -> f64 {
        LAYERS * self.gap() / self.smallest_height
    }

    /// The searches for candidates so far.
    pub(super) fn searches(&self) -> usize {
        self.candidates.searches()
    }

    /// Makes the planes of the pairs that are near at `positions`; those that push are active.
    pub(super) fn linearise(&mut self, positions: &[DVec3]) {
        self.candidates.prepare(positions, &mut self.planes);
        self.candidates.measure(positions);
        self.planes.clear();
        self.candidates.forget_planes();
        for index in self.candidates.near() {
            self.add_plane(index, positions);
        }
        for pair in self.candidates.pairs_mut() {
            (pair.is_on_facet, pair.pushes) = (false, false);
        }
        for plane in &mut self.planes {
            plane.is_active = plane.push(plane.value) > 0.0;
            let pair = self.candidates.pair_mut(plane.pair);
            (pair.is_on_facet, pair.pushes) = (plane.form == Form::Facet, plane.is_active);
        }
    }

    fn add_plane(&mut self, index: u32, positions: &[DVec3]) {
        let stiffness = self.stiffness();
        let pair = self.candidates.pair_mut(index);
        if let Some(mut plane) = Plane::new(pair, &pair.corners(positions)) {
            plane.pair = index;
            plane.stiffness *= stiffness;
            pair.has_plane = true;
            self.planes.push(plane);
        }
    }

    /// Makes planes too of the pairs that the step `direction` from `positions`, no node moving further than `reach`,
    /// would bring within the gap; whether there are any.
    pub(super) fn foresee(&mut self, positions: &[DVec3], direction: &[DVec3], reach: f64) -> bool {
        self.candidates.prepare_path(positions, direction, &mut self.planes);
        self.candidates.measure(positions);
        let known = self.planes.len();
        for index in self.candidates.closing(direction, reach) {
            self.add_plane(index, positions);
        }
        let mut index = 0;
        let candidates = &mut self.candidates;
        self.planes.retain(|plane| {
            index += 1;
            let is_kept = index <= known || plane.push_after(direction) > 0.0;
            candidates.pair_mut(plane.pair).has_plane = is_kept;
            is_kept
        });
        self.planes.len() > known
    }

    /// Makes active those planes that push after the step `direction`; whether that changed any.
    pub(super) fn activate(&mut self, direction: &[DVec3]) -> bool {
        let mut changed = false;
        for plane in &mut self.planes {
            let pushes = plane.push_after(direction) > 0.0;
            changed |= pushes != plane.is_active;
            plane.is_active = pushes;
        }
        changed
    }

    /// Σ ψ at `positions`.
    pub(super) fn energy(&self, positions: &[DVec3]) -> f64 {
        self.planes.iter().map(|plane| plane.energy(positions)).sum()
    }

    /// Adds Σ ∇ψ at `positions`.
    pub(super) fn add_gradient(&self, positions: &[DVec3], gradient: &mut [DVec3]) {
        for plane in &self.planes {
            if let Some(forces) = plane.forces(positions) {
                for (&node, force) in plane.nodes.iter().zip(forces) {
                    gradient[node as usize] -= force;
                }
            }
        }
    }

    /// Turns Σ ∇ψ at the start of the step into that of the active planes, whether or not they push there.
    pub(super) fn add_foreseen(&self, gradient: &mut [DVec3]) {
        for plane in &self.planes {
            let push = plane.push(plane.value);
            if plane.is_active != (push > 0.0) {
                plane.add_push(if plane.is_active { push } else { -push }, gradient);
            }
        }
    }

    /// Adds Σ ∇∇ψ of the active planes; `is_exact`: with the curvature of the distances.
    pub(super) fn add_stiffness(
        &self,
        positions: &[DVec3],
        is_exact: bool,
        matrix: &mut StiffnessMatrix,
    ) {
        for plane in self.active() {
            if let Some(places) = matrix.element(&plane.nodes) {
                matrix.add(&places, &plane.hessian(positions, is_exact));
            }
        }
    }

    /// Subtracts Σ κ ∇c (∇c·d) of the active planes.
    pub(super) fn subtract_stiffness(&self, direction: &[DVec3], forces: &mut [DVec3]) {
        for plane in self.active() {
            plane.add_push(plane.stiffness * plane.change(direction), forces);
        }
    }

    fn active(&self) -> impl Iterator<Item = &Plane> {
        self.planes.iter().filter(|plane| plane.is_active)
    }

    /// Whether `matrix` has room for every active plane.
    pub(super) fn fits(&self, matrix: &StiffnessMatrix) -> bool {
        self.active().all(|plane| matrix.element(&plane.nodes).is_some())
    }

    /// The pairs of nodes that planes couple.
    pub(super) fn coupled_nodes(&self) -> impl Iterator<Item = [u32; 2]> {
        let couples = |nodes: [u32; 4]| {
            (0..4)
                .flat_map(move |i| (0..i).map(move |j| [i, j]))
                .map(move |pair: [usize; 2]| pair.map(|i| nodes[i]))
        };
        self.planes.iter().flat_map(move |plane| couples(plane.nodes))
    }

    /// The share of the way from `step` to `ahead` at which the model of the energy is least. `gradient`: of the
    /// energy with contact at the start of the step.
    pub(super) fn model_minimum(
        &self,
        gradient: &[DVec3],
        step: &ModelStep,
        ahead: &ModelStep,
    ) -> f64 {
        let way: Vec<DVec3> =
            ahead.direction.iter().zip(&step.direction).map(|(&a, &d)| a - d).collect();
        let mut slope = dot(gradient, &way) + dot(&step.elastic, &way);
        let bend = dot(&ahead.elastic, &way) - dot(&step.elastic, &way);
        let mut pieces = Vec::new();
        for plane in &self.planes {
            let rate = plane.change(&way);
            // The gradient holds what pushes at the start.
            slope += plane.push(plane.value).max(0.0) * rate;
            let push = plane.push_after(&step.direction);
            // Pushes are linear along the way.
            if push > 0.0 || push > plane.stiffness * rate {
                pieces.push((push, rate, plane.stiffness));
            }
        }
        let derivative = |share: f64| {
            let pushes = pieces.iter().map(|&(push, rate, stiffness): &(f64, f64, f64)| {
                (push - stiffness * rate * share).max(0.0) * rate
            });
            slope + bend * share - pushes.sum::<f64>()
        };
        least_of_convex(derivative)
    }

    /// Lets the multipliers carry the forces at `positions` and stiffens the pairs that miss too much of their gap, if
    /// there are any; whether it did.
    pub(super) fn update_multipliers(&mut self, positions: &[DVec3]) -> bool {
        let violation = |plane: &Plane| (plane.gap - plane.value_at(positions)) / plane.gap;
        if self.planes.iter().all(|plane| violation(plane) <= VIOLATION) {
            return false;
        }
        for plane in &mut self.planes {
            plane.multiplier = plane.push(plane.value_at(positions)).max(0.0);
            let pair = self.candidates.pair_mut(plane.pair);
            pair.multiplier = plane.multiplier;
            if violation(plane) > VIOLATION {
                plane.stiffen(pair, STIFFENING);
            }
        }
        true
    }

    /// Stiffens the pairs that have given up much of their gap at `positions`, where a step was cut short: the force that
    /// presses them together is more than they can bear before they come too close. Returns whether there are any.
    pub(super) fn stiffen(&mut self, positions: &[DVec3]) -> bool {
        let mut stiffened = false;
        for plane in &mut self.planes {
            if plane.value_at(positions) < PRESSED * plane.gap {
                stiffened |=
                    plane.stiffen(self.candidates.pair_mut(plane.pair), STIFFENING_OF_CUTS);
            }
        }
        stiffened
    }

    /// The largest t ≤ `limit` for which every pair keeps half of its gap on the path from `positions` along
    /// t × `direction`.
    pub(super) fn step_limit(
        &mut self,
        positions: &[DVec3],
        direction: &[DVec3],
        limit: f64,
    ) -> f64 {
        let displacement: Vec<DVec3> = direction.iter().map(|&d| d * limit).collect();
        self.candidates.prepare_path(positions, &displacement, &mut self.planes);
        self.candidates.step_limit(positions, direction, limit)
    }

    /// Whether no layer touches another on the straight path between two states.
    pub(super) fn is_path_free(&mut self, from: &[DVec3], to: &[DVec3]) -> bool {
        self.candidates.is_path_free(from, to, &mut self.planes)
    }

    /// Takes note of an equilibrium: pairs that have come further apart keep more of the gap from now on.
    pub(super) fn accept(&mut self, positions: &[DVec3]) {
        self.candidates.accept(positions);
    }

    /// Two triangles that cross each other on the straight path between two states, among those that started in touch.
    pub(super) fn crossing_in_touch(&self, from: &[DVec3], to: &[DVec3]) -> Option<[u32; 2]> {
        self.candidates.crossing_in_touch(from, to)
    }

    /// Whether any pair pushes in the state in which the planes were made.
    pub(super) fn pushes(&self) -> bool {
        self.planes.iter().any(|plane| plane.push(plane.value) > 0.0)
    }

    /// The number of pairs that push, and the sum of their forces.
    pub(super) fn load(&self, positions: &[DVec3]) -> (usize, f64) {
        let forces = self.planes.iter().map(|plane| plane.push(plane.value_at(positions)));
        forces
            .filter(|&force| force > 0.0)
            .fold((0, 0.0), |(count, sum), force| (count + 1, sum + force))
    }

    /// The pairs of triangles that push hardest, with the force, hardest first.
    pub(super) fn hardest(&self, positions: &[DVec3]) -> Vec<([u32; 2], f64)> {
        let mut by_faces: BTreeMap<[u32; 2], f64> = BTreeMap::new();
        for plane in &self.planes {
            let force = plane.push(plane.value_at(positions));
            if force > 0.0 {
                *by_faces.entry(self.candidates.pair(plane.pair).faces).or_default() += force;
            }
        }
        let mut sorted: Vec<_> = by_faces.into_iter().collect();
        sorted.sort_by(|a, b| b.1.total_cmp(&a.1));
        sorted.truncate(HARDEST);
        sorted
    }
}

/// The share in [0, 1] at which a convex function with this derivative is least.
fn least_of_convex(derivative: impl Fn(f64) -> f64) -> f64 {
    if derivative(1.0) <= 0.0 {
        return 1.0;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _bisection in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if derivative(middle) > 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    // Rounding leaves a small slope at the minimum of a quadratic.
    if high > 0.9999 { 1.0 } else { low }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_of_a_convex_function_is_where_its_derivative_vanishes_or_at_an_end() {
        assert!((least_of_convex(|t| t - 0.3) - 0.3).abs() < 1e-9);
        let kinked = |t: f64| if t < 0.5 { t - 0.6 } else { 10.0 * (t - 0.5) };
        assert!((least_of_convex(kinked) - 0.5).abs() < 1e-9);
        assert_eq!(least_of_convex(|t| t - 2.0), 1.0);
        assert!(least_of_convex(|t| t + 1.0) < 1e-9);
    }
}
