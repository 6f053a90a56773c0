//! The Hessian of the bar-and-hinge energy, element by element.
//!
//! Bar: k (n nᵀ + (Δ/l)(I − n nᵀ)), n its direction, Δ = l − l₀ its elongation. Hinge: κ l₀ (∇θ ∇θᵀ + (θ − θ*) ∇²θ). Face angle:
//! φ (∇α ∇αᵀ + (α − α₀) ∇²α).

use glam::{DMat3, DVec3};

use super::Configuration;
use super::face_angle_hessian::face_angle_hessian;
use super::hinge_hessian::{hinge_blocks, outer};
use super::stiffness_matrix::{ElementBlocks, StiffnessMatrix};
use crate::face_angle::face_angle_gradient;
use crate::{Bar, FaceAngles, Model};

/// The Hessian that is assembled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Curvature {
    /// The exact one: quadratic convergence, positive definite near stable equilibrium only.
    Exact,
    /// Gauss–Newton hinges and face angles, bars without their compressive part: positive semidefinite everywhere.
    Convex,
}

/// The positions of the elements of a model in a matrix, in their order.
pub(super) struct ElementMap {
    bars: Vec<ElementBlocks<2>>,
    hinges: Vec<ElementBlocks<4>>,
    faces: Vec<ElementBlocks<3>>,
}

impl ElementMap {
    /// The blocks of the elements of `model`. Precondition: `matrix` has room for [`coupled_nodes`].
    pub(super) fn new(model: &Model, matrix: &StiffnessMatrix) -> Self {
        let bars = model.bars.iter().map(|bar| &bar.vertices);
        let hinges = model.hinges.iter().map(|hinge| &hinge.vertices);
        let faces = model.face_angles.iter().map(|face| &face.vertices);
        Self {
            bars: bars.filter_map(|nodes| matrix.element(nodes)).collect(),
            hinges: hinges.filter_map(|nodes| matrix.element(nodes)).collect(),
            faces: faces.filter_map(|nodes| matrix.element(nodes)).collect(),
        }
    }
}

/// Adds the Hessian at `state` to `matrix`, with the given elongations of the bars.
pub(super) fn add_stiffness(
    model: &Model,
    state: &Configuration,
    targets: &[f64],
    elongations: &[f64],
    curvature: Curvature,
    map: &ElementMap,
    matrix: &mut StiffnessMatrix,
) {
    for ((bar, element), &elongation) in model.bars.iter().zip(&map.bars).zip(elongations) {
        if let Some(blocks) = bar_blocks(bar, state, elongation, curvature) {
            matrix.add(element, &blocks);
        }
    }
    let angles = state.angles.iter().zip(targets);
    for ((hinge, element), (angle, target)) in model.hinges.iter().zip(&map.hinges).zip(angles) {
        let bend = match curvature {
            Curvature::Exact => hinge.stiffness * (angle - target),
            Curvature::Convex => 0.0,
        };
        let corners = hinge.vertices.map(|v| state.positions[v as usize]);
        matrix.add(element, &hinge_blocks(corners, hinge.stiffness, bend));
    }
    let stiffness = model.material.face_angle_stiffness;
    for (face, element) in model.face_angles.iter().zip(&map.faces) {
        let deviations = match curvature {
            Curvature::Exact => face.deviations(&state.positions),
            Curvature::Convex => [0.0; 3],
        };
        matrix.add(element, &face_blocks(face, deviations, stiffness, state));
    }
}

/// Δ = l − l₀ of every bar.
pub(super) fn elongations(model: &Model, positions: &[DVec3]) -> Vec<f64> {
    let elongation = |bar: &Bar| {
        let [a, b] = bar.vertices.map(|v| positions[v as usize]);
        a.distance(b) - bar.rest_length
    };
    model.bars.iter().map(elongation).collect()
}

/// The elongations that the state `from` foresees for `to`, to first order.
///
/// A step that turns a stiff bar lengthens it by the square of the turn. The force of that is gone after the next step,
/// but in the Hessian it would stiffen or soften all that the bar can turn about; with the elongations that the step
/// was meant to have, the next one is of the right length (the mixed-integration-point iteration of Magisano, Leonetti
/// and Garcea 2017, "How to improve efficiency and robustness of the Newton method in geometrically non-linear
/// structural problem discretized via displacement-based finite elements"). At equilibrium both are the same.
pub(super) fn foreseen_elongations(model: &Model, from: &[DVec3], to: &[DVec3]) -> Vec<f64> {
    let elongation = |bar: &Bar| {
        let [[a, b], [new_a, new_b]] =
            [from, to].map(|positions| bar.vertices.map(|v| positions[v as usize]));
        (b - a).normalize_or_zero().dot(new_b - new_a) - bar.rest_length
    };
    model.bars.iter().map(elongation).collect()
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

/// `None` for a bar pressed to a point, which has no direction.
fn bar_blocks(
    bar: &Bar,
    state: &Configuration,
    elongation: f64,
    curvature: Curvature,
) -> Option<[[DMat3; 2]; 2]> {
    let [a, b] = bar.vertices.map(|v| state.positions[v as usize]);
    let along = b - a;
    let length = along.length();
    if length == 0.0 {
        return None;
    }
    let slack = elongation / length;
    let across = match curvature {
        Curvature::Exact => slack,
        Curvature::Convex => slack.max(0.0),
    };
    let direction = outer(along, along) * (1.0 / (length * length));
    let block = (direction * (1.0 - across) + DMat3::IDENTITY * across) * bar.stiffness;
    Some([[block, -block], [-block, block]])
}

/// The sum over the corners of the triangle.
fn face_blocks(
    face: &FaceAngles,
    deviations: [f64; 3],
    stiffness: f64,
    state: &Configuration,
) -> [[DMat3; 3]; 3] {
    let mut sum = [[DMat3::ZERO; 3]; 3];
    let points = face.vertices.map(|v| state.positions[v as usize]);
    for (turn, deviation) in deviations.into_iter().enumerate() {
        let corner = |k: usize| (turn + k) % 3;
        let [a, b, c] = [0, 1, 2].map(|k| points[corner(k)]);
        let slopes = face_angle_gradient(a, b, c);
        let bends = face_angle_hessian(a, b, c);
        for i in 0..3 {
            for j in 0..3 {
                sum[corner(i)][corner(j)] +=
                    (outer(slopes[i], slopes[j]) + bends[i][j] * deviation) * stiffness;
            }
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Material;
    use crate::quasi_static::configuration::largest;
    use foldmotion_pattern::{Case, Unit, UnitSheet};

    /// How far (K + μ I)⁻¹ (K x + μ x), with K x by differences of the gradient, lies from x.
    fn error_against_differences(curvature: Curvature) -> f64 {
        let unit = Unit::new(Case::SII, 1.6, 1.0, Some(0.7), None).unwrap();
        let sheet = UnitSheet::new(unit, 2, 1).unwrap();
        let model = Model::new(&sheet.sheet, &Material::ORIGAMI_SIMULATOR).unwrap();
        // Bent and strained all over.
        let wave = |i: usize, rate: f64| {
            let phase = i as f64 * rate;
            DVec3::new(phase.sin(), (1.3 * phase).cos(), (1.7 * phase).sin())
        };
        let vectors = |rate| (0..model.node_count()).map(move |i| wave(i, rate));
        let planar = model.to_model(&sheet.sheet.planar());
        let positions = planar.iter().zip(vectors(1.1)).map(|(&p, w)| p + w * 0.1);
        let angles = vec![0.0; model.hinges.len()];
        let targets = vec![0.4; model.hinges.len()];
        let state = Configuration::new(&model, positions.collect(), angles);
        let x: Vec<DVec3> = vectors(0.6).collect();

        let mut matrix = StiffnessMatrix::new(model.node_count(), &coupled_nodes(&model)).unwrap();
        let map = ElementMap::new(&model, &matrix);
        let elongations = elongations(&model, &state.positions);
        add_stiffness(&model, &state, &targets, &elongations, curvature, &map, &mut matrix);
        let shift = 10.0 * matrix.mean_diagonal();
        let step = 1e-6;
        let gradient_at = |length: f64| {
            let moved = state.moved(&model, &x, length, 1.0).unwrap();
            let mut gradient = vec![DVec3::ZERO; x.len()];
            model.gradient(&moved.positions, &moved.angles, &targets, &mut gradient);
            gradient
        };
        let (above, below) = (gradient_at(step), gradient_at(-step));
        let mut solution: Vec<DVec3> = above
            .iter()
            .zip(&below)
            .zip(&x)
            .map(|((&a, &b), &x)| (a - b) / (2.0 * step) + x * shift)
            .collect();
        assert!(matrix.factorise(shift));
        matrix.solve(&mut solution);
        let errors: Vec<DVec3> = solution.iter().zip(&x).map(|(&s, &x)| s - x).collect();
        largest(&errors)
    }

    #[test]
    fn the_exact_stiffness_is_the_difference_of_the_gradient() {
        let error = error_against_differences(Curvature::Exact);
        assert!(error < 1e-8, "{error}");
    }

    #[test]
    fn the_convex_stiffness_is_another_one_where_the_sheet_is_strained() {
        let error = error_against_differences(Curvature::Convex);
        assert!(error > 1e-3, "{error}");
    }
}
