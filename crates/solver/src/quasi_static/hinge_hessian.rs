//! The second derivative of the fold angle of a hinge.
//!
//! The angle depends on its four points through e = e1 − e0, a = left − e0 and b = right − e0 alone. With
//! n = e × a, m = b × e, σ_a = a·e/|e|², σ_b = b·e/|e|² the first derivatives are (Bridson et al. 2003)
//!
//! ∂θ/∂a = |e| n/|n|²,  ∂θ/∂b = |e| m/|m|²,  ∂θ/∂e = −σ_a ∂θ/∂a − σ_b ∂θ/∂b.
//!
//! The second ones follow by differentiating these (compare Tamstorf and Grinspun 2013, "Discrete bending forces and
//! their Jacobians"). ∂²θ/∂a∂b = 0.

use glam::{DMat3, DVec3};

/// The second derivative of [`foldmotion_geometry::fold_angle`] in its points (e0, e1, left, right), as 3 × 3 blocks.
///
/// Precondition: both triangles have positive area.
pub fn fold_angle_hessian(e0: DVec3, e1: DVec3, left: DVec3, right: DVec3) -> [[DMat3; 4]; 4] {
    let e = e1 - e0;
    let a = Wing::new(e, left - e0, 1.0);
    let b = Wing::new(e, right - e0, -1.0);
    let by_edge = a.edge_share(e) + b.edge_share(e);
    let zero = DMat3::ZERO;
    // In the coordinates (e, a, b).
    let h = [
        [by_edge, a.mixed.transpose(), b.mixed.transpose()],
        [a.mixed, a.own, zero],
        [b.mixed, zero, b.own],
    ];
    let mut blocks = [[zero; 4]; 4];
    for i in 0..3 {
        for j in 0..3 {
            blocks[i + 1][j + 1] = h[i][j];
            // Every coordinate falls with e0 as it rises with its own point.
            blocks[0][j + 1] -= h[i][j];
            blocks[i + 1][0] -= h[i][j];
            blocks[0][0] += h[i][j];
        }
    }
    blocks
}

/// One triangle of the hinge and what it adds: a for the left one, b for the right one.
struct Wing {
    apex: DVec3,
    /// g = ∂θ/∂apex.
    gradient: DVec3,
    /// ∂g/∂apex.
    own: DMat3,
    /// ∂g/∂e.
    mixed: DMat3,
}

impl Wing {
    /// `sign`: 1 where the normal is e × apex, −1 where it is apex × e.
    fn new(e: DVec3, apex: DVec3, sign: f64) -> Self {
        let normal = e.cross(apex) * sign;
        let square = normal.length_squared();
        let length = e.length();
        let gradient = normal * (length / square);
        let unit = normal / square.sqrt();
        // ∂(|e| n/|n|²)/∂n.
        let by_normal = (DMat3::IDENTITY - outer(unit, unit) * 2.0) * (length / square);
        Self {
            apex,
            gradient,
            own: by_normal * cross_matrix(e) * sign,
            mixed: outer(normal, e) * (1.0 / (length * square))
                - by_normal * cross_matrix(apex) * sign,
        }
    }

    /// Its part of ∂²θ/∂e²: −∂(σ g)/∂e.
    fn edge_share(&self, e: DVec3) -> DMat3 {
        let square = e.length_squared();
        let sigma = self.apex.dot(e) / square;
        let slope = (self.apex - e * (2.0 * sigma)) / square;
        -(self.mixed * sigma + outer(self.gradient, slope))
    }
}

/// u vᵀ.
pub(super) fn outer(u: DVec3, v: DVec3) -> DMat3 {
    DMat3::from_cols(u * v.x, u * v.y, u * v.z)
}

/// The matrix of x ↦ u × x.
fn cross_matrix(u: DVec3) -> DMat3 {
    DMat3::from_cols(
        DVec3::new(0.0, u.z, -u.y),
        DVec3::new(-u.z, 0.0, u.x),
        DVec3::new(u.y, -u.x, 0.0),
    )
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use foldmotion_geometry::fold_angle_gradient;

    use super::*;

    fn hinge(theta: f64) -> [DVec3; 4] {
        [
            DVec3::new(0.1, 0.05, -0.02),
            DVec3::new(1.3, 0.0, 0.1),
            DVec3::new(0.4, 0.8 * theta.cos(), 0.8 * theta.sin()),
            DVec3::new(0.9, -0.5, 0.03),
        ]
    }

    fn gradient(p: &[DVec3; 4]) -> [DVec3; 4] {
        fold_angle_gradient(p[0], p[1], p[2], p[3])
    }

    #[test]
    fn the_hessian_agrees_with_differences_of_the_gradient_up_to_half_a_turn_and_past_it() {
        for theta in [0.0, 0.3, -1.2, 2.9, PI - 1e-3, PI, -PI, PI + 0.01] {
            let points = hinge(theta);
            let [a, b, c, d] = points;
            let hessian = fold_angle_hessian(a, b, c, d);
            for node in 0..4 {
                for axis in 0..3 {
                    let step = 1e-6;
                    let shifted = |sign: f64| {
                        let mut p = points;
                        p[node][axis] += sign * step;
                        gradient(&p)
                    };
                    let (above, below) = (shifted(1.0), shifted(-1.0));
                    for row in 0..4 {
                        let difference = (above[row] - below[row]) / (2.0 * step);
                        let error = (difference - hessian[row][node].col(axis)).length();
                        assert!(error < 1e-7, "{theta} {row} {node} {axis}: {error}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_hessian_is_symmetric_and_blind_to_translations() {
        let [a, b, c, d] = hinge(2.0);
        let hessian = fold_angle_hessian(a, b, c, d);
        for (i, row) in hessian.iter().enumerate() {
            let sum = row.iter().fold(DMat3::ZERO, |s, &m| s + m);
            assert!(sum.abs_diff_eq(DMat3::ZERO, 1e-13));
            for (j, block) in row.iter().enumerate() {
                assert!(block.abs_diff_eq(hessian[j][i].transpose(), 1e-13));
            }
        }
    }
}
