//! The Hessian of the bar-and-hinge energy, element by element.
//!
//! Bar: k (n nᵀ + (1 − l₀/l)(I − n nᵀ)), n its direction. Hinge: κ l₀ (∇θ ∇θᵀ + (θ − θ*) ∇²θ). Face angle:
//! φ ∇α ∇αᵀ, whose second term is of the order of the strain and left out.

use glam::DMat3;

use super::Configuration;
use super::hinge_hessian::{fold_angle_hessian, outer};
use super::stiffness_matrix::StiffnessMatrix;
use crate::face_angle::face_angle_gradient;
use crate::{Bar, FaceAngles, Hinge, Model};

/// Which Hessian is assembled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Curvature {
    /// The exact one: quadratic convergence, positive definite near stable equilibrium only.
    Exact,
    /// Gauss–Newton hinges and bars without their compressive part: positive semidefinite everywhere.
    Convex,
}

/// Adds the Hessian at `state` to `matrix`.
pub(super) fn add_stiffness(
    model: &Model,
    state: &Configuration,
    targets: &[f64],
    curvature: Curvature,
    matrix: &mut StiffnessMatrix,
) {
    for bar in &model.bars {
        add_bar(bar, state, curvature, matrix);
    }
    for (index, hinge) in model.hinges.iter().enumerate() {
        let excess = match curvature {
            Curvature::Exact => state.angles[index] - targets[index],
            Curvature::Convex => 0.0,
        };
        add_hinge(hinge, excess, state, matrix);
    }
    for face in &model.face_angles {
        add_face(face, model.material.face_angle_stiffness, state, matrix);
    }
}

/// The pairs of nodes that share an element of `model`.
pub(super) fn coupled_nodes(model: &Model) -> Vec<[u32; 2]> {
    // The bars and the apexes of the hinges: every triangle's sides are bars.
    let bars = model.bars.iter().map(|bar| bar.vertices);
    let apexes = model.hinges.iter().map(|hinge| {
        let [_, _, left, right] = hinge.vertices;
        [left, right]
    });
    bars.chain(apexes).collect()
}

fn add_bar(bar: &Bar, state: &Configuration, curvature: Curvature, matrix: &mut StiffnessMatrix) {
    let [a, b] = bar.vertices.map(|v| state.positions[v as usize]);
    let along = b - a;
    let length = along.length();
    if length == 0.0 {
        return;
    }
    let slack = 1.0 - bar.rest_length / length;
    let across = match curvature {
        Curvature::Exact => slack,
        Curvature::Convex => slack.max(0.0),
    };
    let direction = outer(along, along) * (1.0 / (length * length));
    let block = (direction * (1.0 - across) + DMat3::IDENTITY * across) * bar.stiffness;
    let [i, j] = bar.vertices;
    matrix.add(i, i, block);
    matrix.add(j, j, block);
    matrix.add(i, j, -block);
}

fn add_hinge(hinge: &Hinge, excess: f64, state: &Configuration, matrix: &mut StiffnessMatrix) {
    let slopes = hinge.angle_gradient(&state.positions);
    let mut blocks = [[DMat3::ZERO; 4]; 4];
    if excess != 0.0 {
        let [e0, e1, left, right] = hinge.vertices.map(|v| state.positions[v as usize]);
        blocks = fold_angle_hessian(e0, e1, left, right);
    }
    for (i, row) in blocks.iter_mut().enumerate() {
        for (j, block) in row.iter_mut().enumerate() {
            *block = (outer(slopes[i], slopes[j]) + *block * excess) * hinge.stiffness;
        }
    }
    matrix.add_element(&hinge.vertices, &blocks);
}

fn add_face(
    face: &FaceAngles,
    stiffness: f64,
    state: &Configuration,
    matrix: &mut StiffnessMatrix,
) {
    for turn in 0..3 {
        let corner: [u32; 3] = std::array::from_fn(|k| face.vertices[(turn + k) % 3]);
        let [a, b, c] = corner.map(|v| state.positions[v as usize]);
        let slopes = face_angle_gradient(a, b, c);
        let blocks = slopes.map(|u| slopes.map(|v| outer(u, v) * stiffness));
        matrix.add_element(&corner, &blocks);
    }
}
