//! Rigid motions (rotation and translation, no reflection), and the one that fits two point sets best.

use glam::{DMat3, DQuat, DVec3};

use crate::symmetric::diagonalise;

/// The rigid motion x ↦ R x + c.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidMotion {
    /// The rotation R of the motion.
    pub rotation: DMat3,
    /// The translation c of the motion.
    pub translation: DVec3,
}

impl RigidMotion {
    /// The motion that leaves every point where it is.
    pub const IDENTITY: Self = Self { rotation: DMat3::IDENTITY, translation: DVec3::ZERO };

    /// Applies the motion: R x + c.
    pub fn apply(&self, point: DVec3) -> DVec3 {
        self.rotation * point + self.translation
    }

    /// The rigid motion that minimises Σ |R source + c − target|².
    ///
    /// Horn 1987, "Closed-form solution of absolute orientation using unit quaternions": the rotation is the
    /// eigenvector of the largest eigenvalue of a symmetric 4 × 4 matrix built from the covariance, computed here by
    /// Jacobi rotations, which also works for planar and collinear sets. It is never a reflection. A single point gives
    /// a translation, no points give the identity. Precondition: both slices have the same length.
    pub fn best_fit(source: &[DVec3], target: &[DVec3]) -> Self {
        debug_assert_eq!(source.len(), target.len(), "best_fit pairs points");
        if source.is_empty() {
            return Self::IDENTITY;
        }
        let inverse_count = 1.0 / source.len() as f64;
        let source_centre = source.iter().sum::<DVec3>() * inverse_count;
        let target_centre = target.iter().sum::<DVec3>() * inverse_count;
        let mut covariance = DMat3::ZERO;
        for (&a, &b) in source.iter().zip(target) {
            let (a, b) = (a - source_centre, b - target_centre);
            covariance += DMat3::from_cols(a * b.x, a * b.y, a * b.z);
        }
        let rotation = DMat3::from_quat(largest_rotation(covariance));
        Self { rotation, translation: target_centre - rotation * source_centre }
    }

    /// The rigid motion that moves `centre` to the origin and the principal axes of `covariance`, a symmetric matrix,
    /// to x, y and z, in order of decreasing eigenvalue.
    pub fn to_principal_axes(centre: DVec3, covariance: DMat3) -> Self {
        let mut a = covariance.transpose().to_cols_array_2d();
        let vectors = diagonalise(&mut a);
        let mut order = [0, 1, 2];
        order.sort_by(|&i: &usize, &j| a[j][j].total_cmp(&a[i][i]));
        let axis = |i: usize| DVec3::new(vectors[0][i], vectors[1][i], vectors[2][i]);
        let [x, y] = [order[0], order[1]].map(axis);
        let rotation = DMat3::from_cols(x, y, x.cross(y)).transpose();
        Self { rotation, translation: -(rotation * centre) }
    }
}

/// The unit quaternion that maximises tr(R covariance), covariance\[i\]\[j\] = Σ a_i b_j.
#[expect(clippy::needless_range_loop, reason = "matrix indices read like the formula")]
fn largest_rotation(covariance: DMat3) -> DQuat {
    let s = |i: usize, j: usize| covariance.col(j)[i];
    let mut a = [
        [s(0, 0) + s(1, 1) + s(2, 2), s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0)],
        [0.0, s(0, 0) - s(1, 1) - s(2, 2), s(0, 1) + s(1, 0), s(2, 0) + s(0, 2)],
        [0.0, 0.0, s(1, 1) - s(0, 0) - s(2, 2), s(1, 2) + s(2, 1)],
        [0.0, 0.0, 0.0, s(2, 2) - s(0, 0) - s(1, 1)],
    ];
    for i in 0..4 {
        for j in 0..i {
            a[i][j] = a[j][i];
        }
    }
    let vectors = diagonalise(&mut a);
    let best = (0..4).max_by(|&i, &j| a[i][i].total_cmp(&a[j][j])).unwrap_or(0);
    let v = |i: usize| vectors[i][best];
    DQuat::from_xyzw(v(1), v(2), v(3), v(0)).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cloud() -> Vec<DVec3> {
        (0..20)
            .map(|i| {
                let x = f64::from(i);
                DVec3::new((x * 1.7).sin(), (x * 0.9).cos() * 2.0, (x * 0.31).sin() * 0.5)
            })
            .collect()
    }

    #[test]
    fn a_rigid_motion_is_recovered_exactly() {
        let motion = RigidMotion {
            rotation: DMat3::from_quat(DQuat::from_xyzw(0.3, -0.5, 0.7, 0.2).normalize()),
            translation: DVec3::new(3.0, -2.0, 9.0),
        };
        let source = cloud();
        let target: Vec<_> = source.iter().map(|&p| motion.apply(p)).collect();
        let fit = RigidMotion::best_fit(&source, &target);
        for (&p, &q) in source.iter().zip(&target) {
            assert!(fit.apply(p).distance(q) < 1e-14);
        }
    }

    #[test]
    fn principal_axes_come_to_lie_along_x_y_and_z() {
        let turn = DMat3::from_quat(DQuat::from_xyzw(0.3, -0.5, 0.7, 0.2).normalize());
        let variances = DMat3::from_diagonal(DVec3::new(0.5, 9.0, 2.0));
        let centre = DVec3::new(3.0, -2.0, 9.0);
        let motion = RigidMotion::to_principal_axes(centre, turn * variances * turn.transpose());
        assert!(motion.apply(centre).length() < 1e-14);
        assert!((motion.rotation.determinant() - 1.0).abs() < 1e-14);
        // The axis of variance 9 goes along x, 2 along y, 0.5 along z.
        for (own, along) in
            [(turn.y_axis, DVec3::X), (turn.z_axis, DVec3::Y), (turn.x_axis, DVec3::Z)]
        {
            assert!(((motion.rotation * own).dot(along).abs() - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn a_planar_set_is_fitted_by_a_rotation_never_by_a_reflection() {
        let source: Vec<_> = cloud().into_iter().map(|p| DVec3::new(p.x, p.y, 0.0)).collect();
        let mirrored: Vec<_> = source.iter().map(|p| DVec3::new(-p.x, p.y, 0.0)).collect();
        let fit = RigidMotion::best_fit(&source, &mirrored);
        assert!((fit.rotation.determinant() - 1.0).abs() < 1e-14);
        // A planar mirror image is reached by turning the plane over.
        for (&p, &q) in source.iter().zip(&mirrored) {
            assert!(fit.apply(p).distance(q) < 1e-14);
        }
    }

    #[test]
    fn a_mirror_image_in_space_cannot_be_reached() {
        let source = cloud();
        let mirrored: Vec<_> = source.iter().map(|p| DVec3::new(-p.x, p.y, p.z)).collect();
        let fit = RigidMotion::best_fit(&source, &mirrored);
        let worst = source
            .iter()
            .zip(&mirrored)
            .map(|(&p, &q)| fit.apply(p).distance(q))
            .fold(0.0, f64::max);
        assert!(worst > 0.1, "a reflection was used: {worst}");
        assert!((fit.rotation.determinant() - 1.0).abs() < 1e-14);
    }
}
