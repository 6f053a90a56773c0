//! `[material]`.

use foldmotion_geometry::Number;
use foldmotion_pattern::Sheet;
use foldmotion_solver::{Material, Preset, SolverError};
use glam::DVec2;

use super::input::Input;
use super::subject::Subject;
use crate::StudyError;

pub(crate) fn material(input: &Input<'_>, subject: &Subject) -> Result<Material, StudyError> {
    let scene = &input.scene.material;
    let standard = match (scene.preset, subject) {
        (None | Some(Preset::OrigamiSimulator), Subject::Imported(study)) => {
            as_in_origami_simulator(&study.imported.sheet)
        }
        (Some(preset), _) => preset.material(),
        (None, Subject::Units(_)) => Material::default(),
    };
    let material = Material {
        axial_stiffness: scene.axial_stiffness.unwrap_or(standard.axial_stiffness),
        fold_stiffness: scene.fold_stiffness.unwrap_or(standard.fold_stiffness),
        facet_stiffness: scene.facet_stiffness.unwrap_or(standard.facet_stiffness),
        face_angle_stiffness: scene.face_angle_stiffness.unwrap_or(standard.face_angle_stiffness),
        damping_ratio: scene.damping_ratio.unwrap_or(standard.damping_ratio),
    };
    material.validate().map_err(|e| match e {
        SolverError::MaterialOutOfRange { name, minimum, maximum, .. } => input.error(
            &format!("material.{name}"),
            format!("must be between {} and {}", Number(minimum), Number(maximum)),
        ),
        other => StudyError::Solver(other),
    })?;
    Ok(material)
}

/// Origami Simulator's constants for a pattern. Its unit of length is the radius of the pattern, ours the mean edge: the
/// springs of face angles are the only constant that the unit changes against the others.
fn as_in_origami_simulator(sheet: &Sheet) -> Material {
    let low = sheet.vertices.iter().copied().fold(DVec2::INFINITY, DVec2::min);
    let high = sheet.vertices.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
    let centre = low.midpoint(high);
    let radius = sheet.vertices.iter().map(|v| v.distance(centre)).fold(0.0, f64::max);
    let material = Material::ORIGAMI_SIMULATOR;
    let face_angle_stiffness = material.face_angle_stiffness * radius / sheet.unit_length;
    Material { face_angle_stiffness, ..material }
}

pub(crate) fn material_thickness(input: &Input<'_>) -> Result<Option<f64>, StudyError> {
    let thickness = input.scene.material.thickness;
    thickness.map(|thickness| input.length("material.thickness", thickness)).transpose()
}
