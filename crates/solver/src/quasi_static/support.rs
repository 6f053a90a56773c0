//! The rigid motion of the sheet, on which its energy does not depend.

use glam::{DMat3, DVec3};

use super::configuration::Configuration;
use super::hinge_hessian::outer;
use super::stiffness_matrix::StiffnessMatrix;
use crate::Model;

/// How the rigid motion of the sheet is determined in a Newton step, on which its energy does not depend.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Support {
    /// A triangle amid the sheet stays where it is, so that the steps of a symmetric sheet are not symmetric.
    #[default]
    Triangle,
    /// It neither moves nor turns: steps are as symmetric as the sheet.
    Floating,
}

/// Takes from the velocities `direction` of points at `positions` their mean and the rotation that fits them best, so
/// that no point of support shows in them.
pub(super) fn remove_rigid_motion(positions: &[DVec3], direction: &mut [DVec3]) {
    let inverse_count = 1.0 / positions.len().max(1) as f64;
    let centre = positions.iter().sum::<DVec3>() * inverse_count;
    let mean = direction.iter().sum::<DVec3>() * inverse_count;
    let mut inertia = DMat3::ZERO;
    let mut momentum = DVec3::ZERO;
    for (&position, &velocity) in positions.iter().zip(&*direction) {
        let arm = position - centre;
        inertia += DMat3::IDENTITY * arm.length_squared() - outer(arm, arm);
        momentum += arm.cross(velocity - mean);
    }
    let spin = inertia.inverse() * momentum;
    let spin = if spin.is_finite() { spin } else { DVec3::ZERO };
    for (&position, velocity) in positions.iter().zip(direction) {
        *velocity -= mean + spin.cross(position - centre);
    }
}

/// A triangle amid the sheet: the left one of the middle hinge; of a sheet without hinges its one triangle.
pub(super) fn supporting_triangle(model: &Model) -> [u32; 3] {
    match model.hinges.get(model.hinges.len() / 2) {
        Some(hinge) => {
            let [e0, e1, left, _] = hinge.vertices;
            [e0, e1, left]
        }
        None => model.faces[0],
    }
}

/// Supports the triangle: its first node in space, its second across the line to the first, its third across the
/// plane of the three.
pub(super) fn add_support(
    triangle: [u32; 3],
    state: &Configuration,
    stiffness: f64,
    matrix: &mut StiffnessMatrix,
) {
    let [a, b, c] = triangle.map(|v| state.positions[v as usize]);
    let along = (b - a).normalize_or_zero();
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let blocks = [
        DMat3::IDENTITY * stiffness,
        (DMat3::IDENTITY - outer(along, along)) * stiffness,
        outer(normal, normal) * stiffness,
    ];
    for (&node, block) in triangle.iter().zip(blocks) {
        if let Some(places) = matrix.element(&[node]) {
            matrix.add(&places, &[[block]]);
        }
    }
}
