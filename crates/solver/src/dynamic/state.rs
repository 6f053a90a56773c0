//! The moving sheet: positions, velocities and the passes of one step.
//!
//! A step is semi-implicit Euler (Origami Simulator's own scheme): with the force F(x, v) on every node of mass m
//!
//! v ← v + Δt F(x, v) / m,  x ← x + Δt v.
//!
//! The nodes are cut into blocks (`layout`); each block makes its passes (`passes`) from the state in which the step
//! starts and writes that of its own nodes at the end. So threads meet once a step, and the result depends on their
//! number in no bit.

use glam::DVec3;
use pulp::Arch;

use super::lanes::{Quad, WIDTH};
use super::layout::{Layout, NO_HINGE};
use super::passes::{
    BlockStep, Hinges, Mass, Scratch, StateAfter, StateBefore, StepSettings, Totals,
};
use super::row_sums::RowSums;
use crate::Model;

/// Positions and velocities of a sheet, with the buffers of a step. Lengths in unit lengths.
#[derive(Debug, Clone)]
pub struct State<'a> {
    pub(super) model: &'a Model,
    pub(super) layout: Layout,
    pub(super) now: Nodes,
    next: Nodes,
    /// The force on every node at the last evaluation.
    forces: Vec<Quad>,
    pub(super) masses: Vec<Mass>,
    /// The row sums of every node when they were last evaluated.
    pub(super) row_sums: Vec<RowSums>,
    pub(super) hinges: Vec<Hinges>,
    /// Fraction of the material's damping that acts: 1, or 0 for undamped motion.
    pub damping: f64,
    pub(super) totals: Vec<Totals>,
    pub(super) scratch: Vec<Scratch>,
    pub(super) arch: Arch,
}

/// Nodes in the order of the layout.
#[derive(Debug, Clone)]
pub(super) struct Nodes {
    pub(super) positions: Vec<Quad>,
    pub(super) velocities: Vec<Quad>,
}

/// The largest displacement of a node in one step, in unit lengths: beyond it the motion has diverged.
pub(super) const MAX_DISPLACEMENT: f64 = 0.5;

impl<'a> State<'a> {
    /// The sheet of `model` at rest at `positions` (unit lengths), with every target at the angle it has there.
    ///
    /// Precondition: one position a node.
    pub fn at_rest(model: &'a Model, positions: &[DVec3]) -> Self {
        let mut angles = vec![0.0; model.hinges.len()];
        model.follow_angles(positions, &mut angles);
        let layout = Layout::new(model);
        let count = layout.order.len();
        let nodes =
            Nodes { positions: quads(&layout.order, positions), velocities: vec![[0.0; 4]; count] };
        let hinges = layout.blocks.iter().map(|block| Hinges {
            angles: vec![[0.0; WIDTH]; block.edges.len()],
            targets: vec![[0.0; WIDTH]; block.edges.len()],
        });
        let workers = rayon::current_num_threads().min(layout.blocks.len()).max(1);
        let mut state = Self {
            hinges: hinges.collect(),
            next: nodes.clone(),
            now: nodes,
            forces: vec![[0.0; 4]; count],
            masses: vec![Mass::UNIT; count],
            row_sums: vec![RowSums::default(); count],
            damping: 1.0,
            totals: vec![Totals::default(); layout.blocks.len()],
            scratch: vec![Scratch::default(); workers],
            arch: Arch::new(),
            layout,
            model,
        };
        state.set_targets(&angles);
        state.set_angles(&angles);
        state
    }

    /// One step of length `dt` with the dampers of the bars; returns a bound on the displacement of any node, the root
    /// of the sum of their squares.
    ///
    /// # Errors
    /// The first node that moved further than half a unit length, or to no number, and how far.
    pub fn step(&mut self, dt: f64) -> Result<f64, (usize, f64)> {
        self.step_with(dt, 0.0)
    }

    /// One step of length `dt`, with a viscous force −c m v, centred in the step, beside the dampers.
    ///
    /// # Errors
    /// As [`Self::step`].
    pub(super) fn step_with(&mut self, dt: f64, viscosity: f64) -> Result<f64, (usize, f64)> {
        self.evaluate(StepSettings { dt, viscosity, damping: self.damping });
        std::mem::swap(&mut self.now, &mut self.next);
        // The sum carries a NaN where a maximum would lose it.
        let displacement = self.sum(|totals| totals.squared_speed).sqrt() * dt;
        if displacement <= MAX_DISPLACEMENT {
            return Ok(displacement);
        }
        let runaway = self
            .layout
            .order
            .iter()
            .zip(&self.now.velocities)
            .map(|(&node, v)| (node as usize, vector(v).length() * dt))
            .find(|(_, d)| d.is_nan() || *d > MAX_DISPLACEMENT);
        runaway.map_or(Ok(displacement), Err)
    }

    /// Evaluates the force on every node, dampers included, and follows the fold angles; nothing moves.
    pub fn evaluate_forces(&mut self) {
        self.evaluate(StepSettings { dt: 0.0, viscosity: 0.0, damping: self.damping });
    }

    /// The passes over every block, from `now` to `next`.
    fn evaluate(&mut self, settings: StepSettings) {
        let len = self.layout.block_len;
        let work = SharedStep {
            arch: self.arch,
            before: StateBefore {
                positions: &self.now.positions,
                velocities: &self.now.velocities,
            },
            settings,
            face_angle_stiffness: self.model.material.face_angle_stiffness,
            block_len: len,
        };
        let share = BlockRun {
            blocks: &self.layout.blocks,
            hinges: &mut self.hinges,
            totals: &mut self.totals,
            after: StateAfter {
                positions: &mut self.next.positions,
                velocities: &mut self.next.velocities,
                forces: &mut self.forces,
                masses: &self.masses,
            },
        };
        share.run(&work, &mut self.scratch);
    }

    pub(super) fn sum(&self, of: impl Fn(&Totals) -> f64) -> f64 {
        self.totals.iter().map(of).sum()
    }

    fn largest(&self, of: impl Fn(&Totals) -> f64) -> f64 {
        self.totals.iter().map(of).fold(0.0, f64::max)
    }

    /// Positions in the order of the model.
    pub fn positions(&self) -> Vec<DVec3> {
        vectors(&self.layout.order, &self.now.positions)
    }

    /// Velocities in the order of the model.
    pub fn velocities(&self) -> Vec<DVec3> {
        vectors(&self.layout.order, &self.now.velocities)
    }

    /// Sets the positions, one a node, in unit lengths.
    pub fn set_positions(&mut self, positions: &[DVec3]) {
        self.now.positions = quads(&self.layout.order, positions);
    }

    /// Sets the velocities, one a node.
    pub fn set_velocities(&mut self, velocities: &[DVec3]) {
        self.now.velocities = quads(&self.layout.order, velocities);
    }

    /// The force on every node at the last evaluation.
    pub fn forces(&self) -> Vec<DVec3> {
        vectors(&self.layout.order, &self.forces)
    }

    /// Sets the target of every hinge, radians.
    pub fn set_targets(&mut self, targets: &[f64]) {
        self.set_by_hinge(targets, |hinges| &mut hinges.targets);
    }

    /// Takes each fold angle, at the next evaluation, for the value modulo 2π that is nearest to that of `angles`.
    pub fn set_angles(&mut self, angles: &[f64]) {
        self.set_by_hinge(angles, |hinges| &mut hinges.angles);
    }

    fn set_by_hinge(
        &mut self,
        numbers: &[f64],
        of: impl Fn(&mut Hinges) -> &mut Vec<[f64; WIDTH]>,
    ) {
        for (block, hinges) in self.layout.blocks.iter().zip(&mut self.hinges) {
            let slots = of(hinges).as_flattened_mut();
            for (slot, &hinge) in slots.iter_mut().zip(&block.hinges) {
                if hinge != NO_HINGE {
                    *slot = numbers[hinge as usize];
                }
            }
        }
    }

    /// The target of every hinge, radians.
    pub fn targets(&self) -> Vec<f64> {
        self.by_hinge(|hinges| &hinges.targets)
    }

    /// The followed fold angle of every hinge at the last evaluation, radians.
    pub fn angles(&self) -> Vec<f64> {
        self.by_hinge(|hinges| &hinges.angles)
    }

    fn by_hinge(&self, of: impl Fn(&Hinges) -> &Vec<[f64; WIDTH]>) -> Vec<f64> {
        let mut numbers = vec![0.0; self.model.hinges.len()];
        for (block, hinges) in self.layout.blocks.iter().zip(&self.hinges) {
            for (&number, &hinge) in of(hinges).as_flattened().iter().zip(&block.hinges) {
                if hinge != NO_HINGE {
                    numbers[hinge as usize] = number;
                }
            }
        }
        numbers
    }

    /// The largest force on a node at the last evaluation over the fold stiffness.
    pub fn residual(&self) -> f64 {
        self.largest(|totals| totals.squared_force).sqrt() / self.model.material.fold_stiffness
    }

    /// The largest |v| of a node after the last step.
    pub fn largest_speed(&self) -> f64 {
        self.largest(|totals| totals.largest_squared_speed).sqrt()
    }

    /// The largest |θ − θ*| of a hinge at the last evaluation.
    pub fn fold_angle_error(&self) -> f64 {
        let errors = self.layout.blocks.iter().zip(&self.hinges);
        let errors = errors.flat_map(|(block, hinges)| {
            let pairs = hinges.angles.as_flattened().iter();
            let pairs = pairs.zip(hinges.targets.as_flattened()).zip(&block.hinges);
            pairs
                .filter(|(_, hinge)| **hinge != NO_HINGE)
                .map(|((angle, target), _)| (angle - target).abs())
        });
        errors.fold(0.0, f64::max)
    }

    /// Σ |v|² / 2, of unit masses.
    pub fn kinetic_energy(&self) -> f64 {
        let squares = self.now.velocities.iter().map(|v| vector(v).length_squared());
        0.5 * squares.sum::<f64>()
    }

    /// The mass of every node, in the order of the model.
    #[cfg(feature = "gpu")]
    pub(super) fn masses(&self) -> Vec<f64> {
        let mut masses = vec![1.0; self.masses.len()];
        for (&node, mass) in self.layout.order.iter().zip(&self.masses) {
            masses[node as usize] = mass.mass;
        }
        masses
    }

    /// Gives every node the mass 1, that of the material.
    pub(super) fn use_unit_masses(&mut self) {
        for index in 0..self.masses.len() {
            self.change_mass(index, Mass::UNIT);
        }
    }

    /// Gives every node the mass at which a time step of 2 is the longest that is stable for it.
    pub(super) fn scale_masses(&mut self) {
        self.update_row_sums();
        for index in 0..self.masses.len() {
            let stiffness = self.row_sums[index].stiffness;
            self.change_mass(index, Mass::new(stiffness.max(f64::MIN_POSITIVE)));
        }
    }

    /// The node keeps its kinetic energy.
    fn change_mass(&mut self, index: usize, mass: Mass) {
        let factor = (self.masses[index].mass * mass.inverse).sqrt();
        for speed in &mut self.now.velocities[index] {
            *speed *= factor;
        }
        self.masses[index] = mass;
    }

    pub(super) fn stop(&mut self) {
        self.now.velocities.fill([0.0; 4]);
    }
}

/// The values that all blocks share in a step.
#[derive(Debug)]
struct SharedStep<'a> {
    arch: Arch,
    before: StateBefore<'a>,
    settings: StepSettings,
    face_angle_stiffness: f64,
    block_len: usize,
}

/// A run of neighbouring blocks and the values that they write.
#[derive(Debug)]
struct BlockRun<'a> {
    blocks: &'a [super::layout::Block],
    hinges: &'a mut [Hinges],
    totals: &'a mut [Totals],
    after: StateAfter<'a>,
}

impl BlockRun<'_> {
    /// Steps the blocks on as many workers as there are scratches.
    fn run(self, work: &SharedStep<'_>, scratches: &mut [Scratch]) {
        if scratches.len() < 2 {
            if let [scratch] = scratches {
                self.run_here(work, scratch);
            }
            return;
        }
        let half = scratches.len() / 2;
        let (first, second) = self.split(half, scratches.len(), work.block_len);
        let (here, there) = scratches.split_at_mut(half);
        rayon::join(|| first.run(work, here), || second.run(work, there));
    }

    fn split(self, part: usize, of: usize, block_len: usize) -> (Self, Self) {
        let blocks = self.blocks.len() * part / of;
        let nodes = (blocks * block_len).min(self.after.forces.len());
        let (blocks_0, blocks_1) = self.blocks.split_at(blocks);
        let (hinges_0, hinges_1) = self.hinges.split_at_mut(blocks);
        let (totals_0, totals_1) = self.totals.split_at_mut(blocks);
        let (positions_0, positions_1) = self.after.positions.split_at_mut(nodes);
        let (velocities_0, velocities_1) = self.after.velocities.split_at_mut(nodes);
        let (forces_0, forces_1) = self.after.forces.split_at_mut(nodes);
        let (masses_0, masses_1) = self.after.masses.split_at(nodes);
        let first = BlockRun {
            blocks: blocks_0,
            hinges: hinges_0,
            totals: totals_0,
            after: StateAfter {
                positions: positions_0,
                velocities: velocities_0,
                forces: forces_0,
                masses: masses_0,
            },
        };
        let second = BlockRun {
            blocks: blocks_1,
            hinges: hinges_1,
            totals: totals_1,
            after: StateAfter {
                positions: positions_1,
                velocities: velocities_1,
                forces: forces_1,
                masses: masses_1,
            },
        };
        (first, second)
    }

    fn run_here(self, work: &SharedStep<'_>, scratch: &mut Scratch) {
        let StateAfter { positions, velocities, forces, masses } = self.after;
        let len = work.block_len;
        let after = positions
            .chunks_mut(len)
            .zip(velocities.chunks_mut(len))
            .zip(forces.chunks_mut(len))
            .zip(masses.chunks(len));
        let blocks = self.blocks.iter().zip(self.hinges).zip(self.totals);
        for (((block, hinges), totals), (((positions, velocities), forces), masses)) in
            blocks.zip(after)
        {
            *totals = work.arch.dispatch(BlockStep {
                block,
                hinges,
                before: work.before,
                after: StateAfter { positions, velocities, forces, masses },
                scratch,
                settings: work.settings,
                face_angle_stiffness: work.face_angle_stiffness,
            });
        }
    }
}

/// One quad a node, in the order of the layout.
fn quads(order: &[u32], vectors: &[DVec3]) -> Vec<Quad> {
    let quad = |&node: &u32| {
        let v = vectors[node as usize];
        [v.x, v.y, v.z, 0.0]
    };
    order.iter().map(quad).collect()
}

/// One vector a node, in the order of the model.
fn vectors(order: &[u32], quads: &[Quad]) -> Vec<DVec3> {
    let mut vectors = vec![DVec3::ZERO; quads.len()];
    for (&node, quad) in order.iter().zip(quads) {
        vectors[node as usize] = vector(quad);
    }
    vectors
}

fn vector(quad: &Quad) -> DVec3 {
    let [x, y, z, _] = *quad;
    DVec3::new(x, y, z)
}
