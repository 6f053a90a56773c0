//! `[material]`.

use foldmotion_geometry::Number;
use foldmotion_solver::{Material, SolverError};

use super::input::Input;
use crate::StudyError;

pub(crate) fn material(input: &Input<'_>) -> Result<Material, StudyError> {
    let scene = &input.scene.material;
    let standard = match scene.preset {
        Some(preset) => preset.material(),
        None => Material::default(),
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

pub(crate) fn material_thickness(input: &Input<'_>) -> Result<Option<f64>, StudyError> {
    let thickness = input.scene.material.thickness;
    thickness.map(|thickness| input.length("material.thickness", thickness)).transpose()
}
