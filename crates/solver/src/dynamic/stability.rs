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
//! A bar's blocks are bounded by k (its axial stiffness, and the transverse one of a bar stretched or pressed to no less than
//! half its length), a hinge's by κ l₀ (1 + |θ − θ*|) |∂θ/∂x_a| |∂θ/∂x_b|: Gauss–Newton, and its torque times the second
//! derivative of θ, whose size is that of the product of the first ones. The last is an estimate, not a bound; the
//! safety factor of the engine covers it.

use glam::DVec3;

use super::State;
use crate::face_angle::face_angle_gradient;

/// The row sums of the block norms of the stiffness and of the damping matrix at a node.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct RowSums {
    stiffness: f64,
    damping: f64,
}

impl RowSums {
    /// The largest Δt that is stable for this row; infinite for a node that nothing holds.
    fn stable_time_step(self) -> f64 {
        let Self { stiffness, damping } = self;
        if stiffness > 0.0 {
            // (√(c² + 4k) − c) / k without its cancellation.
            4.0 / ((damping * damping + 4.0 * stiffness).sqrt() + damping)
        } else {
            f64::INFINITY
        }
    }
}

impl State<'_> {
    /// The largest stable time step at the present positions, angles and targets.
    pub fn stable_time_step(&mut self) -> f64 {
        self.row_sums.fill(RowSums::default());
        self.add_bar_rows();
        self.add_hinge_rows();
        self.add_face_angle_rows();
        self.row_sums
            .iter()
            .map(|row| row.stable_time_step())
            .fold(f64::INFINITY, f64::min)
    }

    fn add_bar_rows(&mut self) {
        for (bar, damper) in self.model.bars.iter().zip(&self.bar_dampers) {
            for v in bar.vertices {
                let row = &mut self.row_sums[v as usize];
                row.stiffness += 2.0 * bar.stiffness;
                row.damping += 2.0 * damper * self.damping;
            }
        }
    }

    fn add_hinge_rows(&mut self) {
        for (index, hinge) in self.model.hinges.iter().enumerate() {
            let norms = hinge.angle_gradient(&self.positions).map(DVec3::length);
            let lag = (self.angles[index] - self.targets[index]).abs();
            let stiffness = hinge.stiffness * (1.0 + lag);
            self.add_rows(hinge.vertices, norms, stiffness);
        }
    }

    fn add_face_angle_rows(&mut self) {
        for face in &self.model.face_angles {
            let [a, b, c] = face.vertices;
            for corner in [[a, b, c], [b, c, a], [c, a, b]] {
                let [p, q, r] = corner.map(|v| self.positions[v as usize]);
                let norms = face_angle_gradient(p, q, r).map(DVec3::length);
                self.add_rows(corner, norms, self.model.material.face_angle_stiffness);
            }
        }
    }

    /// Adds the rows of stiffness · g gᵀ, with the norms of the blocks of g.
    fn add_rows<const N: usize>(&mut self, vertices: [u32; N], norms: [f64; N], stiffness: f64) {
        let weight = stiffness * norms.iter().sum::<f64>();
        for (v, norm) in vertices.into_iter().zip(norms) {
            self.row_sums[v as usize].stiffness += weight * norm;
        }
    }
}
