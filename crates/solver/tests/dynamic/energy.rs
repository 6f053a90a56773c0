//! The energy and its gradient against finite differences, invariances and bad material.

use std::f64::consts::PI;

use crate::sheets::{folded_hinge, hinge, shaken, units};
use foldmotion_geometry::RigidMotion;
use foldmotion_pattern::{Assignment, Case, Sheet};
use foldmotion_solver::{EnergyByKind, Material, Model, SolverError};
use glam::{DMat3, DQuat, DVec3};

const WITH_FACE_ANGLES: Material = Material {
    axial_stiffness: 20.0,
    fold_stiffness: 0.7,
    facet_stiffness: 0.9,
    face_angle_stiffness: 0.2,
    damping_ratio: 0.45,
};

/// The worst component of the analytic gradient minus the central difference of `part` of the energy.
fn gradient_error(
    model: &Model,
    positions: &[DVec3],
    angles: &[f64],
    targets: &[f64],
    part: impl Fn(&EnergyByKind) -> f64,
) -> f64 {
    let mut gradient = vec![DVec3::ZERO; model.node_count()];
    model.gradient(positions, angles, targets, &mut gradient);
    let step = 1e-6;
    let energy_at = |node: usize, axis: usize, shift: f64| {
        let mut moved = positions.to_vec();
        moved[node][axis] += shift;
        let mut followed = angles.to_vec();
        model.follow_angles(&moved, &mut followed);
        part(&model.energy_by_kind(&moved, &followed, targets))
    };
    let mut worst = 0.0f64;
    for (node, slope) in gradient.iter().enumerate() {
        for axis in 0..3 {
            let rise = energy_at(node, axis, step) - energy_at(node, axis, -step);
            worst = worst.max((rise / (2.0 * step) - slope[axis]).abs());
        }
    }
    worst
}

fn only(material: &str) -> (Material, fn(&EnergyByKind) -> f64) {
    let tiny = Material::MIN_STIFFNESS;
    let none = Material {
        axial_stiffness: tiny,
        fold_stiffness: tiny,
        facet_stiffness: tiny,
        face_angle_stiffness: 0.0,
        ..Material::default()
    };
    match material {
        "bars" => (Material { axial_stiffness: 20.0, ..none }, |e| e.bars),
        "creases" => (Material { fold_stiffness: 0.7, ..none }, |e| e.creases),
        "facets" => (Material { facet_stiffness: 0.7, ..none }, |e| e.facets),
        _ => (Material { face_angle_stiffness: 0.2, ..none }, |e| e.face_angles),
    }
}

#[test]
fn the_gradient_of_each_kind_of_energy_agrees_with_finite_differences() {
    let units = units(Case::SII, 2, 1);
    let positions = shaken(&units.compact(), 0.05);
    for kind in ["bars", "creases", "facets", "face angles"] {
        let (material, part) = only(kind);
        let model = Model::new(&units.sheet, &material).unwrap();
        let mut angles: Vec<f64> =
            model.hinges.iter().map(|h| units.compact_angles()[h.edge as usize]).collect();
        model.follow_angles(&positions, &mut angles);
        let targets: Vec<f64> = angles.iter().map(|a| 0.3 * a + 0.1).collect();
        assert!(part(&model.energy_by_kind(&positions, &angles, &targets)) > 1e-4, "{kind}: idle");
        let error = gradient_error(&model, &positions, &angles, &targets, part);
        assert!(error < 2e-6, "{kind}: {error}");
        let wrong: Vec<f64> = targets.iter().map(|t| t + 1e-3).collect();
        if kind == "creases" {
            let mut gradient = vec![DVec3::ZERO; model.node_count()];
            model.gradient(&positions, &angles, &wrong, &mut gradient);
            let mut right = gradient.clone();
            model.gradient(&positions, &angles, &targets, &mut right);
            let differs = gradient.iter().zip(&right).any(|(a, b)| a.distance(*b) > 1e-5);
            assert!(differs, "the check would not notice a target off by a thousandth");
        }
    }
}

#[test]
fn the_gradient_holds_near_and_beyond_half_a_turn() {
    let sheet = hinge(Assignment::Valley, 1.3, 0.8, 0.5);
    let model = Model::new(&sheet, &Material::default()).unwrap();
    for angle in [PI - 1e-3, PI + 1e-3, PI + 0.4, -PI + 1e-9, -PI - 0.2] {
        let positions = folded_hinge(&sheet, angle);
        let mut angles = vec![angle.signum() * 3.0];
        model.follow_angles(&positions, &mut angles);
        assert!((angles[0] - angle).abs() < 1e-12, "{} is not {angle}", angles[0]);
        let error = gradient_error(&model, &positions, &angles, &[0.2], |e| e.creases);
        assert!(error < 1e-7, "{angle}: {error}");
    }
}

#[test]
fn energy_does_not_change_and_forces_turn_with_a_rigid_motion() {
    let units = units(Case::S, 2, 2);
    let model = Model::new(&units.sheet, &WITH_FACE_ANGLES).unwrap();
    let motion = RigidMotion {
        rotation: DMat3::from_quat(DQuat::from_xyzw(0.3, -0.5, 0.7, 0.2).normalize()),
        translation: DVec3::new(3.0, -2.0, 9.0),
    };
    let positions = shaken(&units.sheet.planar(), 0.2);
    let moved: Vec<DVec3> = positions.iter().map(|p| motion.apply(*p)).collect();
    let targets = vec![0.4; model.hinges.len()];
    let evaluate = |positions: &[DVec3]| {
        let mut angles = vec![0.0; model.hinges.len()];
        model.follow_angles(positions, &mut angles);
        let mut gradient = vec![DVec3::ZERO; model.node_count()];
        model.gradient(positions, &angles, &targets, &mut gradient);
        (model.energy_by_kind(positions, &angles, &targets).total(), gradient)
    };
    let (energy, gradient) = evaluate(&positions);
    let (moved_energy, moved_gradient) = evaluate(&moved);
    assert!((energy - moved_energy).abs() < 1e-11 * energy, "{energy} {moved_energy}");
    for (g, moved) in gradient.iter().zip(&moved_gradient) {
        assert!((motion.rotation * *g).distance(*moved) < 1e-10);
    }
    let net: DVec3 = gradient.iter().sum();
    let torque: DVec3 = gradient.iter().zip(&positions).map(|(g, p)| p.cross(*g)).sum();
    assert!(net.length() < 1e-11 && torque.length() < 1e-11, "{net} {torque}");
}

#[test]
fn an_isometric_state_at_its_targets_has_no_energy() {
    for case in [Case::E, Case::T, Case::S, Case::SII] {
        let units = units(case, 3, 2);
        let model = Model::new(&units.sheet, &WITH_FACE_ANGLES).unwrap();
        let targets: Vec<f64> =
            model.hinges.iter().map(|h| units.compact_angles()[h.edge as usize]).collect();
        let mut angles = targets.clone();
        let compact = model.to_model(&units.compact());
        model.follow_angles(&compact, &mut angles);
        let energy = model.energy_by_kind(&compact, &angles, &targets);
        assert!(energy.total() < 1e-24, "{case:?}: {energy:?}");
        let wrong = model.energy_by_kind(&compact, &angles, &vec![0.0; targets.len()]);
        assert!(wrong.creases > 1.0 && wrong.bars < 1e-24, "{case:?}: {wrong:?}");
    }
}

#[test]
fn stiffness_follows_length_and_material() {
    let sheet = hinge(Assignment::Mountain, 2.0, 1.0, 1.0);
    let model = Model::new(&sheet, &Material::default()).unwrap();
    assert_eq!(model.bars[0].stiffness, 10.0);
    assert_eq!(model.hinges[0].stiffness, 1.4);
    assert!(model.face_angles.is_empty());
    let with_faces = Model::new(&sheet, &WITH_FACE_ANGLES).unwrap();
    assert_eq!(with_faces.face_angles.len(), 2);
}

#[test]
fn a_bad_material_is_refused_by_name_with_its_value_and_limits() {
    let sheet = hinge(Assignment::Valley, 1.0, 1.0, 1.0);
    let refused = |material: Material| Model::new(&sheet, &material).unwrap_err().to_string();
    let good = Material::default();
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-300, 1e300] {
        let message = refused(Material { axial_stiffness: value, ..good });
        assert!(message.starts_with(&format!("axial_stiffness is {value}")), "{message}");
        assert!(message.contains("0.000000001 and 1000000000000"), "{message}");
    }
    assert!(refused(Material { fold_stiffness: 0.0, ..good }).contains("fold_stiffness"));
    assert!(refused(Material { facet_stiffness: -2.0, ..good }).contains("facet_stiffness is -2"));
    assert!(refused(Material { face_angle_stiffness: -0.1, ..good }).contains("face_angle"));
    assert!(refused(Material { damping_ratio: f64::NAN, ..good }).contains("damping_ratio"));
    assert!(Model::new(&sheet, &Material { damping_ratio: 0.0, ..good }).is_ok());
}

#[test]
fn a_degenerate_sheet_is_refused_with_its_element() {
    let refused = |sheet: &Sheet| Model::new(sheet, &Material::default()).unwrap_err();
    let thin = hinge(Assignment::Valley, 1.0, 1e-8, 1.0);
    assert!(matches!(refused(&thin), SolverError::DegenerateFace { face: 0, .. }));
    let mut short = hinge(Assignment::Valley, 1.0, 1.0, 1.0);
    short.vertices[1] = short.vertices[0];
    assert!(matches!(refused(&short), SolverError::DegenerateEdge { edge: 0, .. }));
    let mut unmeasured = hinge(Assignment::Valley, 1.0, 1.0, 1.0);
    unmeasured.unit_length = 0.0;
    assert!(matches!(refused(&unmeasured), SolverError::UnitLength { .. }));
    let mut lost = hinge(Assignment::Valley, 1.0, 1.0, 1.0);
    lost.vertices[3].x = f64::NAN;
    assert!(matches!(refused(&lost), SolverError::DegenerateEdge { edge: 3, .. }));
    let mut empty = hinge(Assignment::Valley, 1.0, 1.0, 1.0);
    empty.faces.clear();
    assert!(matches!(refused(&empty), SolverError::NoFacets));
}
