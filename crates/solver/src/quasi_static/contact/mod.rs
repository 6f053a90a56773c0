//! Contact: layers pushed apart by barriers, steps limited so that none passes through another.
//!
//! Every vertex and facet and every two edges that share no vertex keep the gap g. Those two kinds of pairs are enough:
//! surfaces that do not cross can begin to cross only where a vertex meets a facet or an edge an edge (Provot 1997),
//! also for facets that share a vertex or an edge, whose other corners and opposite edges are such pairs. A crease
//! can therefore close up to 180° less the turn that holds its apexes g apart, never beyond.
//!
//! Pairs that start closer than g and its reach (the seam of a closed profile, facets narrower than that) keep half of
//! the largest distance they have had, until that is g; pairs that start in touch are left alone until they have
//! come apart.

mod closest;
mod near;
mod pair;
mod primitives;
mod step_limit;

use std::collections::BTreeMap;

use foldmotion_geometry::collide::Tree;
use glam::{DMat3, DVec3};

use self::near::NearPairs;
use self::pair::{ContactPair, PairKind};
use self::primitives::Primitives;
use self::step_limit::step_limit;
use super::configuration::dot;
use super::element_stiffness::Curvature;
use super::stiffness_matrix::StiffnessMatrix;
use crate::{Model, SolverError};

/// d̂ over the gap.
const REACH: f64 = 0.5;
/// A gap above this share of the smallest height of a facet cannot be kept by a folded sheet.
const LARGEST_GAP: f64 = 0.25;
/// Pairs closer than this share of the gap at the start count as in touch.
const TOUCHING: f64 = 1e-3;
/// By how much distances may change before candidates are looked for again, in unit lengths.
const MARGIN: f64 = 0.02;

/// Layers that may lie between the facets of one crease.
const LAYERS: f64 = 8.0;
/// The number of blocking pairs reported.
const HARDEST: usize = 8;

/// Contact of the layers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// g, the closest approach of primitives that share no vertex, in unit lengths.
    pub gap: f64,
}

impl Default for Contact {
    fn default() -> Self {
        Self { gap: 1e-3 }
    }
}

/// The barriers between the layers of a sheet, and the candidates for them.
pub(super) struct ContactField {
    primitives: Primitives,
    tree: Tree,
    gap: f64,
    reach: f64,
    /// F, by which every barrier is scaled.
    pub(super) force: f64,
    /// ρ of the pairs that do not keep the whole gap yet.
    admitted: BTreeMap<(PairKind, [u32; 4]), f64>,
    pairs: Vec<ContactPair>,
    near: NearPairs,
    searched_path: SearchedPath,
    smallest_height: f64,
}

/// The straight path along which candidates were searched.
#[derive(Default)]
struct SearchedPath {
    from: Vec<DVec3>,
    displacement: Vec<DVec3>,
}

impl SearchedPath {
    /// Whether no node of `positions` is further than half the margin from where it is at one instant of the path.
    fn holds(&self, positions: &[DVec3]) -> bool {
        if self.from.len() != positions.len() {
            return false;
        }
        let off = || positions.iter().zip(&self.from).map(|(&x, &a)| x - a);
        let square = dot(&self.displacement, &self.displacement);
        let along: f64 = off().zip(&self.displacement).map(|(d, &w)| d.dot(w)).sum();
        let time = if square > 0.0 { (along / square).clamp(0.0, 1.0) } else { 0.0 };
        let limit = 0.25 * MARGIN * MARGIN;
        off().zip(&self.displacement).all(|(d, &w)| (d - w * time).length_squared() <= limit)
    }
}

impl ContactField {
    /// The contact of `model` from `start` (unit lengths) on.
    ///
    /// # Errors
    /// [`SolverError::GapTooLarge`], and [`SolverError::StartCrosses`] where the sheet crosses itself at the start.
    pub(super) fn new(
        model: &Model,
        contact: Contact,
        force: f64,
        start: &[DVec3],
    ) -> Result<Self, SolverError> {
        let primitives = Primitives::new(model);
        let smallest_height = primitives.smallest_height(start);
        let maximum = LARGEST_GAP * smallest_height;
        if !(contact.gap > 0.0 && contact.gap <= maximum) {
            return Err(SolverError::GapTooLarge { gap: contact.gap, maximum });
        }
        let boxes = primitives.boxes(start, &[], 0.0);
        let mut field = Self {
            tree: Tree::new(&boxes),
            gap: contact.gap,
            reach: REACH * contact.gap,
            force,
            admitted: BTreeMap::new(),
            pairs: Vec::new(),
            near: NearPairs::default(),
            searched_path: SearchedPath::default(),
            smallest_height,
            primitives,
        };
        if let Some(faces) = field.crossing(start) {
            return Err(SolverError::StartCrosses { faces });
        }
        field.admit(start);
        Ok(field)
    }

    /// How far layers a gap apart may keep creases from their targets, in radians: several layers over the smallest
    /// height of a triangle.
    pub(super) fn fold_angle_slack(&self) -> f64 {
        LAYERS * self.gap / self.smallest_height
    }

    /// The reach d̂ of the barrier.
    pub(super) fn reach(&self) -> f64 {
        self.reach
    }

    /// Makes the candidates good for `positions`.
    pub(super) fn prepare(&mut self, positions: &[DVec3]) {
        let still = vec![DVec3::ZERO; positions.len()];
        self.prepare_path(positions, &still);
    }

    /// Makes the candidates good for every state on the straight path from `positions` to `positions` + `displacement`.
    pub(super) fn prepare_path(&mut self, positions: &[DVec3], displacement: &[DVec3]) {
        let end: Vec<DVec3> = positions.iter().zip(displacement).map(|(&x, &d)| x + d).collect();
        // The states near the searched path are a convex set: if they hold the ends of a path they hold all of it.
        if self.searched_path.holds(positions) && self.searched_path.holds(&end) {
            return;
        }
        self.searched_path =
            SearchedPath { from: positions.to_vec(), displacement: displacement.to_vec() };
        self.pairs = self.search(positions, displacement, self.gap + self.reach + MARGIN);
        self.near = NearPairs::default();
    }

    /// Σ B; infinite where a gap is not kept.
    pub(super) fn energy(&mut self, positions: &[DVec3]) -> f64 {
        let force = self.force;
        let pairs = self.near.active(&self.pairs, positions);
        pairs.map(|pair| pair.energy(&pair.corners(positions), force)).sum()
    }

    pub(super) fn add_gradient(&mut self, positions: &[DVec3], gradient: &mut [DVec3]) {
        for pair in self.near.active(&self.pairs, positions) {
            if let Some(slopes) = pair.gradient(&pair.corners(positions), self.force) {
                for (node, slope) in pair.nodes.iter().zip(slopes) {
                    gradient[*node as usize] += slope;
                }
            }
        }
    }

    pub(super) fn add_stiffness(
        &mut self,
        positions: &[DVec3],
        curvature: Curvature,
        matrix: &mut StiffnessMatrix,
    ) {
        let mut blocks = [[DMat3::ZERO; 4]; 4];
        for pair in self.near.active(&self.pairs, positions) {
            let corners = pair.corners(positions);
            if pair.hessian(&corners, self.force, curvature, &mut blocks)
                && let Some(places) = matrix.element(&pair.nodes)
            {
                matrix.add(&places, &blocks);
            }
        }
    }

    /// Whether `matrix` has room for every barrier within reach.
    pub(super) fn fits(&mut self, positions: &[DVec3], matrix: &StiffnessMatrix) -> bool {
        self.near.active(&self.pairs, positions).all(|pair| matrix.element(&pair.nodes).is_some())
    }

    /// The pairs of nodes coupled by barriers, or that will be when the layers come closer by `more`.
    pub(super) fn coupled_nodes(&self, positions: &[DVec3], more: f64) -> Vec<[u32; 2]> {
        let mut coupled = Vec::new();
        for pair in &self.pairs {
            let distance = pair.closest(&pair.corners(positions)).distance;
            if distance < pair.gap + pair.reach + more {
                for i in 0..4 {
                    coupled.extend((0..i).map(|j| [pair.nodes[i], pair.nodes[j]]));
                }
            }
        }
        coupled
    }

    /// The largest t ≤ `limit` for which every pair keeps a tenth of its separation on the path from `positions` along
    /// t × `direction`. Precondition: candidates prepared for that path.
    pub(super) fn step_limit(
        &mut self,
        positions: &[DVec3],
        direction: &[DVec3],
        limit: f64,
    ) -> f64 {
        self.near.move_to(&self.pairs, positions);
        let pairs = self.pairs.iter().zip(&self.near.least);
        pairs.fold(limit, |limit, (pair, least)| {
            let d = pair.corners(direction);
            if least - pair.gap > pair.speed(&d) * limit {
                return limit;
            }
            step_limit(pair, pair.gap, &pair.corners(positions), &d, limit)
        })
    }

    /// Whether no layer touches another on the straight path between two states: half of the gap stays.
    pub(super) fn is_path_free(&mut self, from: &[DVec3], to: &[DVec3]) -> bool {
        let displacement: Vec<DVec3> = to.iter().zip(from).map(|(&b, &a)| b - a).collect();
        self.prepare_path(from, &displacement);
        self.pairs.iter().all(|pair| {
            let (x, d) = (pair.corners(from), pair.corners(&displacement));
            step_limit(pair, 0.5 * pair.gap, &x, &d, 1.0) >= 1.0
        })
    }

    /// Takes note of an equilibrium: pairs that have come further apart keep more of the gap from now on.
    pub(super) fn accept(&mut self, positions: &[DVec3]) {
        let whole = 2.0 * self.gap;
        let before = self.admitted.len();
        let mut grown = false;
        for ((kind, nodes), most) in &mut self.admitted {
            let x = nodes.map(|v| positions[v as usize]);
            let distance = match kind {
                PairKind::VertexFacet => closest::Closest::vertex_facet(&x),
                PairKind::EdgeEdge => closest::Closest::edge_edge(&x),
            }
            .distance;
            if distance > 1.1 * *most && distance > 0.1 * self.gap {
                *most = distance;
                grown = true;
            }
        }
        self.admitted.retain(|_, most| *most < whole);
        if grown || self.admitted.len() != before {
            self.searched_path = SearchedPath::default();
        }
    }

    /// The smallest separation over its reach among the active pairs; 1 where there are none.
    pub(super) fn tightest(&self, positions: &[DVec3]) -> f64 {
        self.pairs
            .iter()
            .map(|pair| (pair.closest(&pair.corners(positions)).distance - pair.gap) / pair.reach)
            .fold(1.0, f64::min)
    }

    /// The number of pairs that push, and the sum of their forces.
    pub(super) fn load(&self, positions: &[DVec3]) -> (usize, f64) {
        let forces = self
            .pairs
            .iter()
            .map(|pair| pair.force(&pair.corners(positions), self.force))
            .filter(|&force| force > 0.0);
        forces.fold((0, 0.0), |(count, sum), force| (count + 1, sum + force))
    }

    /// The pairs of triangles that push hardest, with the force, hardest first.
    pub(super) fn hardest(&self, positions: &[DVec3]) -> Vec<([u32; 2], f64)> {
        let mut by_faces: BTreeMap<[u32; 2], f64> = BTreeMap::new();
        for pair in &self.pairs {
            let force = pair.force(&pair.corners(positions), self.force);
            if force > 0.0 {
                *by_faces.entry(pair.faces).or_default() += force;
            }
        }
        let mut sorted: Vec<_> = by_faces.into_iter().collect();
        sorted.sort_by(|a, b| b.1.total_cmp(&a.1));
        sorted.truncate(HARDEST);
        sorted
    }

    /// Every pair that may come nearer than `within` on the straight path from `positions` to `positions` +
    /// `displacement`.
    fn search(
        &mut self,
        positions: &[DVec3],
        displacement: &[DVec3],
        within: f64,
    ) -> Vec<ContactPair> {
        let boxes = self.primitives.boxes(positions, displacement, 0.5 * within);
        self.tree.refit(&boxes);
        let mut pairs = Vec::new();
        for (a, b) in self.tree.overlapping_pairs(&boxes) {
            self.primitives.visit_pairs(a, b, |kind, nodes, mollifier| {
                let mut pair = ContactPair {
                    kind,
                    nodes,
                    faces: [a, b],
                    gap: self.gap,
                    reach: self.reach,
                    mollifier,
                };
                let distance = pair.closest(&pair.corners(positions)).distance;
                let nearest = distance - pair.speed(&pair.corners(displacement));
                if nearest < within && self.keeps_gap(&mut pair) {
                    pairs.push(pair);
                }
            });
        }
        pairs
    }

    /// Sets the gap and the reach of an admitted pair; false where it is left alone.
    fn keeps_gap(&self, pair: &mut ContactPair) -> bool {
        let Some(&most) = self.admitted.get(&(pair.kind, pair.nodes)) else {
            return true;
        };
        pair.gap = self.gap.min(0.5 * most);
        pair.reach = self.reach.min(most - pair.gap);
        most > TOUCHING * self.gap
    }

    /// Admits the pairs that start closer than the gap and its reach.
    fn admit(&mut self, start: &[DVec3]) {
        let whole = 2.0 * self.gap;
        let still = vec![DVec3::ZERO; start.len()];
        let close = self.search(start, &still, whole);
        self.admitted = close
            .iter()
            .map(|pair| {
                let distance = pair.closest(&pair.corners(start)).distance;
                ((pair.kind, pair.nodes), distance)
            })
            .collect();
    }

    /// The first two triangles that cross each other.
    fn crossing(&self, positions: &[DVec3]) -> Option<[u32; 2]> {
        let boxes = self.primitives.boxes(positions, &[], 0.0);
        let pairs = self.tree.overlapping_pairs(&boxes);
        pairs
            .into_iter()
            .map(|(a, b)| [a, b])
            .find(|&faces| self.primitives.cross(faces, positions))
    }
}
