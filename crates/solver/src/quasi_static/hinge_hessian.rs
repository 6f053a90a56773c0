//! The second derivative of the fold angle of a hinge.
//!
//! The angle depends on its four points through e = e1 − e0, a = left − e0 and b = right − e0 alone, and but for the
//! orientation through each side by itself. With n = e × a (for the right side b × e), σ = a·e/|e|², the arm
//! t = a − σ e of the apex and its height |t|, the first derivative is g = ∂θ/∂a = |e| n/|n|², ∂θ/∂e = −σ g (Bridson et
//! al. 2003), and moving the apex or the edge turns and shrinks g:
//!
//! ∂g/∂a = −T/|t|²,  ∂g/∂e = σ T/|t|² − e gᵀ/|e|²,  T = t gᵀ + g tᵀ,
//! ∂²θ/∂e² = Σ σ (e gᵀ + g eᵀ)/|e|² − (σ²/|t|² + 1/(2|e|²)) T
//!
//! with the sum over both sides (compare Tamstorf and Grinspun 2013, "Discrete bending forces and their Jacobians"; the
//! parts of T/(2|e|²) that are not symmetric by themselves cancel between the sides). ∂²θ/∂a∂b = 0.

use glam::{DMat3, DVec3};

/// The second derivative of [`foldmotion_geometry::fold_angle`] in its points (e0, e1, left, right), as 3 × 3 blocks.
///
/// Precondition: both triangles have positive area.
pub fn fold_angle_hessian(e0: DVec3, e1: DVec3, left: DVec3, right: DVec3) -> [[DMat3; 4]; 4] {
    hinge_blocks([e0, e1, left, right], 0.0, 1.0)
}

/// `square` ∇θ ∇θᵀ + `bend` ∇²θ, by blocks of the points (e0, e1, left, right).
///
/// Precondition: both triangles have positive area.
#[inline]
pub(super) fn hinge_blocks(
    [e0, e1, left, right]: [DVec3; 4],
    square: f64,
    bend: f64,
) -> [[DMat3; 4]; 4] {
    let e = e1 - e0;
    let per_edge = 1.0 / e.length_squared();
    let (to_left, to_right) = (left - e0, right - e0);
    let l = HingeSide::new(e, per_edge, to_left, e.cross(to_left));
    let r = HingeSide::new(e, per_edge, to_right, to_right.cross(e));
    let across = outer(l.slope, r.slope) * square;
    let [ll, rr] = [l, r].map(|side| side.own(square, bend));
    let [l_edge, r_edge] = [l, r].map(|side| outer(e * (-bend * per_edge), side.slope));
    // The apexes against e1; e0 follows, as translations change nothing.
    let l1 = l_edge - ll * l.share - across * r.share;
    let r1 = r_edge - rr * r.share - across.transpose() * l.share;
    let [l0, r0] = [-(ll + across + l1), -(rr + across.transpose() + r1)];
    let e11 = (l.turn + r.turn) * (-0.5 * bend * per_edge)
        - (l_edge.transpose() + l1) * l.share
        - (r_edge.transpose() + r1) * r.share;
    let e10 = -(l1.transpose() + r1.transpose() + e11);
    let e00 = -(l0 + r0 + e10);
    [
        [e00, e10.transpose(), l0.transpose(), r0.transpose()],
        [e10, e11, l1.transpose(), r1.transpose()],
        [l0, l1, ll, across],
        [r0, r1, across.transpose(), rr],
    ]
}

/// One triangle of the hinge.
#[derive(Clone, Copy)]
struct HingeSide {
    /// g = ∂θ/∂apex.
    slope: DVec3,
    /// σ.
    share: f64,
    /// 1/|t|².
    per_height: f64,
    /// T.
    turn: DMat3,
}

impl HingeSide {
    #[inline]
    fn new(e: DVec3, per_edge: f64, apex: DVec3, normal: DVec3) -> Self {
        let share = apex.dot(e) * per_edge;
        let per_area = 1.0 / normal.length_squared();
        let per_height = per_area / per_edge;
        let slope = normal * (per_area / per_edge.sqrt());
        let half = outer(apex - e * share, slope);
        Self { slope, share, per_height, turn: half + half.transpose() }
    }

    /// The block of the apex with itself.
    #[inline]
    fn own(&self, square: f64, bend: f64) -> DMat3 {
        outer(self.slope, self.slope * square) - self.turn * (bend * self.per_height)
    }
}

/// u vᵀ.
#[inline]
pub(super) fn outer(u: DVec3, v: DVec3) -> DMat3 {
    DMat3::from_cols(u * v.x, u * v.y, u * v.z)
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
