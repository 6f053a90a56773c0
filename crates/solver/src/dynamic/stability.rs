//! The largest time step that is stable for bars, hinges and dampers together.
//!
//! Semi-implicit Euler of ẍ = −K x − C ẋ with unit masses has, for an eigenvector u of its step, eigenvalues μ with
//!
//! μ² − (2 − c Δt − k Δt²) μ + (1 − c Δt) = 0,  k = u*K u, c = u*C u, u*u = 1.
//!
//! By Jury's conditions |μ| ≤ 1 where k Δt² + 2 c Δt ≤ 4 (for C = 0 the familiar Δt ≤ 2/ω; for one oscillator
//! Δt ω ≤ 2 (√(1 + ζ²) − ζ)). It holds for every u where it holds for the largest eigenvalue of Δt² K + 2 Δt C, which
//! Gershgorin's theorem for block matrices (Feingold and Varga 1962) bounds by the largest row sum of block norms.
//! With r_K(i), r_C(i) the row sums of node i the step is stable for
//!
//! Δt ≤ min over i of (√(r_C² + 4 r_K) − r_C) / r_K.
//!
//! A bar's blocks are bounded by k (its axial stiffness, and the transverse one of a bar stretched or pressed to no
//! less than half its length), a hinge's by κ l₀ (1 + |θ − θ*|) |∂θ/∂x_a| |∂θ/∂x_b|: Gauss–Newton, and its torque times
//! the second derivative of θ, whose size is that of the product of the first ones. The last is an estimate, not a
//! bound; the safety factor of the engine covers it.

use pulp::{Simd, WithSimd};

use super::State;
use super::lanes::{Lanes, Quad, Vectors, WIDTH};
use super::layout::Block;
use super::part::{Edge, Face, LEAST_SQUARE, Part};
use super::passes::{Hinges, Scratch, load};
use super::row_sums::RowSums;

/// The share of the stable time step that is used: covers what the bound only estimates and the change of geometry
/// until it is evaluated again.
pub(super) const SAFETY: f64 = 0.9;

impl State<'_> {
    /// The largest time step that is stable at the present positions, targets and angles of the last evaluation, for
    /// unit masses.
    pub fn stable_time_step(&mut self) -> f64 {
        self.update_row_sums();
        self.row_sums.iter().map(|row| row.stable_time_step()).fold(f64::INFINITY, f64::min)
    }

    /// Evaluates the row sums of every node.
    pub(super) fn update_row_sums(&mut self) {
        let Some(scratch) = self.scratch.first_mut() else {
            return;
        };
        let mut weights = Vec::new();
        let rows = self.row_sums.chunks_mut(self.layout.block_len);
        for ((block, hinges), rows) in self.layout.blocks.iter().zip(&self.hinges).zip(rows) {
            self.arch.dispatch(BlockRows {
                block,
                hinges,
                positions: &self.now.positions,
                scratch,
                weights: &mut weights,
                damping: self.damping,
                face_angle_stiffness: self.model.material.face_angle_stiffness,
                rows,
            });
        }
    }
}

/// The row sums of the nodes of one block, by the passes of a step.
#[derive(Debug)]
struct BlockRows<'a> {
    block: &'a Block,
    hinges: &'a Hinges,
    positions: &'a [Quad],
    scratch: &'a mut Scratch,
    /// The weight of the hinge of each edge at an apex.
    weights: &'a mut Vec<f64>,
    damping: f64,
    face_angle_stiffness: f64,
    rows: &'a mut [RowSums],
}

impl WithSimd for BlockRows<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        load(self.block, self.positions, &mut self.scratch.positions);
        self.edge_rows(simd);
        self.face_rows(simd);
        self.node_rows();
    }
}

impl BlockRows<'_> {
    /// Evaluates the rows of each edge at its ends, those of its damper, and the weight of its hinge at an apex.
    #[inline(always)]
    fn edge_rows<S: Simd>(&mut self, simd: S) {
        let scratch = &mut *self.scratch;
        let groups = self.block.edges.len();
        scratch.loads.resize(groups, [[0.0; 4]; WIDTH]);
        self.weights.resize(groups * WIDTH, 0.0);
        let (weights, _) = self.weights.as_chunks_mut::<WIDTH>();
        let hinges = self.hinges.angles.iter().zip(&self.hinges.targets);
        let edges = self.block.edges.iter().zip(&self.block.triangles);
        let loads = scratch.loads.iter_mut().zip(weights);
        let two = Lanes::splat(simd, 2.0);
        let one = two.constant(1.0);
        for (((record, triangles), (angle, target)), (rows, weights)) in
            edges.zip(hinges).zip(loads)
        {
            for index in 0..Lanes::<S>::PARTS {
                let part = Part { simd, index };
                let Edge { e, a, b } = part.edge(&scratch.positions, record);
                let square = e.dot(e).max(two.constant(LEAST_SQUARE));
                let (left, right) = (e.cross(a), b.cross(e));
                let left_area = left.dot(left).max(two.constant(LEAST_SQUARE)).sqrt();
                let right_area = right.dot(right).max(two.constant(LEAST_SQUARE)).sqrt();
                // The sizes of the gradient of the angle at the apexes; the ends share in them.
                let length = square.sqrt();
                let (at_left, at_right) = (length.over(left_area), length.over(right_area));
                let cosine = left.dot(right).over(left_area * right_area);
                let (l, r) = (a.dot(e).over(square), b.dot(e).over(square));
                let at_end = length_of_sum(at_left * l, at_right * r, cosine);
                let at_start = length_of_sum(at_left * (one - l), at_right * (one - r), cosine);
                let lag = (part.numbers(angle) - part.numbers(target)).abs();
                let stiffness = part.numbers(&record.hinge_stiffness) * (one + lag);
                let weight = stiffness * (at_start + at_end + at_left + at_right);
                weight.store(weights, index);
                let twice = two * part.numbers(triangles);
                let bar = twice * part.numbers(&record.stiffness);
                let rows_of_ends = Vectors {
                    x: weight.mul_add(at_start, bar),
                    y: weight.mul_add(at_end, bar),
                    z: twice * part.numbers(&record.damper),
                };
                rows_of_ends.store(rows, index);
            }
        }
    }

    /// Evaluates the rows of each triangle at its corners: as apexes of hinges and as angles.
    #[inline(always)]
    fn face_rows<S: Simd>(&mut self, simd: S) {
        let scratch = &mut *self.scratch;
        let groups = self.block.faces.len();
        scratch.corner_forces.resize(groups, [[[0.0; 4]; WIDTH]; 3]);
        let one = Lanes::splat(simd, 1.0);
        let held = one.constant(self.face_angle_stiffness);
        for (record, rows) in self.block.faces.iter().zip(&mut scratch.corner_forces) {
            for index in 0..Lanes::<S>::PARTS {
                let part = Part { simd, index };
                let Face { sides: [ea, eb, ec], square, .. } =
                    part.face(&scratch.positions, record);
                let area = square.sqrt();
                let (la, lb, lc) = (length(ea), length(eb), length(ec));
                let wa = part.gathered(self.weights, &record.edges[0]) * la;
                let wb = part.gathered(self.weights, &record.edges[1]) * lb;
                let wc = part.gathered(self.weights, &record.edges[2]) * lc;
                // |q| of each side, and |q_b + q_c| at a and so on.
                let (qa, qb, qc) = (one.over(la), one.over(lb), one.over(lc));
                let oa = length_of_sum(qb, qc, eb.dot(ec) * qb * qc);
                let ob = length_of_sum(qc, qa, ec.dot(ea) * qc * qa);
                let oc = length_of_sum(qa, qb, ea.dot(eb) * qa * qb);
                let (sa, sb, sc) = (oa + qb + qc, ob + qc + qa, oc + qa + qb);
                // The angle at the next corner sees this one across the side that joins them.
                let ra = held * (oa * sa + qc * sb + qb * sc) + wa.over(area);
                let rb = held * (ob * sb + qa * sc + qc * sa) + wb.over(area);
                let rc = held * (oc * sc + qb * sa + qa * sb) + wc.over(area);
                alone(ra).store(&mut rows[0], index);
                alone(rb).store(&mut rows[1], index);
                alone(rc).store(&mut rows[2], index);
            }
        }
    }

    #[inline(always)]
    fn node_rows(&mut self) {
        let ends = self.scratch.loads.as_flattened();
        let corners = self.scratch.corner_forces.as_flattened().as_flattened();
        let starts = self.block.end_starts.windows(2);
        let starts = starts.zip(self.block.corner_starts.windows(2));
        for (row, (end_range, corner_range)) in self.rows.iter_mut().zip(starts) {
            let [mut stiffness, mut damping] = [0.0; 2];
            for &slot in &self.block.ends[end_range[0] as usize..end_range[1] as usize] {
                let rows = &ends[slot as usize / 2];
                stiffness += rows[slot as usize % 2];
                damping += rows[2] * self.damping;
            }
            for &slot in &self.block.corners[corner_range[0] as usize..corner_range[1] as usize] {
                stiffness += corners[slot as usize][0];
            }
            *row = RowSums { stiffness, damping };
        }
    }
}

/// |u + v| of vectors of these lengths with this cosine between them.
#[inline(always)]
fn length_of_sum<S: Simd>(u: Lanes<S>, v: Lanes<S>, cosine: Lanes<S>) -> Lanes<S> {
    let squared = u.mul_add(u, v * v) + u.constant(2.0) * u * v * cosine;
    squared.max(u.constant(0.0)).sqrt()
}

#[inline(always)]
fn length<S: Simd>(vector: Vectors<S>) -> Lanes<S> {
    let squared = vector.dot(vector);
    squared.max(squared.constant(LEAST_SQUARE)).sqrt()
}

/// A number where a vector has room.
#[inline(always)]
fn alone<S: Simd>(x: Lanes<S>) -> Vectors<S> {
    let zero = x.constant(0.0);
    Vectors { x, y: zero, z: zero }
}
