//! The material: stiffness and damping of a sheet.

use crate::SolverError;

/// Stiffness and damping of the bars and hinges.
///
/// The default is Origami Simulator's (Ghassaei, Demaine, Gershenfeld 2018), without its face-angle springs.
/// All numbers are in the model's own units (see [`crate::Model`]): only their ratios shape the equilibrium, their
/// size against the unit node mass sets the pace.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// EA of the bars: a bar of rest length l₀ has the stiffness EA / l₀.
    pub axial_stiffness: f64,
    /// Rotational stiffness of a crease per unit length of crease.
    pub fold_stiffness: f64,
    /// Rotational stiffness of a facet hinge (the diagonal of a quadrilateral) per unit length.
    pub facet_stiffness: f64,
    /// Stiffness of the springs that hold the three angles of each triangle; 0 leaves them out.
    ///
    /// Per corner, not per length: Origami Simulator sets 0.2.
    pub face_angle_stiffness: f64,
    /// ζ of the dampers along the bars, d = 2 ζ √(k m).
    pub damping_ratio: f64,
}

impl Material {
    /// The smallest stiffness taken; together with [`Self::MAX_STIFFNESS`] it keeps every product of two within f64.
    pub const MIN_STIFFNESS: f64 = 1e-9;
    /// The largest stiffness taken.
    pub const MAX_STIFFNESS: f64 = 1e12;
    /// The largest damping ratio taken.
    pub const MAX_DAMPING_RATIO: f64 = 1e3;

    /// Refuses constants that are not finite or out of range.
    ///
    /// # Errors
    /// [`SolverError::MaterialOutOfRange`], of the first such constant.
    pub fn validate(&self) -> Result<(), SolverError> {
        let stiffnesses = [
            ("axial_stiffness", self.axial_stiffness),
            ("fold_stiffness", self.fold_stiffness),
            ("facet_stiffness", self.facet_stiffness),
        ];
        for (name, value) in stiffnesses {
            within(name, value, Self::MIN_STIFFNESS, Self::MAX_STIFFNESS)?;
        }
        let name = "face_angle_stiffness";
        within(name, self.face_angle_stiffness, 0.0, Self::MAX_STIFFNESS)?;
        within(
            "damping_ratio",
            self.damping_ratio,
            0.0,
            Self::MAX_DAMPING_RATIO,
        )
    }
}

impl Default for Material {
    fn default() -> Self {
        Self {
            axial_stiffness: 20.0,
            fold_stiffness: 0.7,
            facet_stiffness: 0.7,
            face_angle_stiffness: 0.0,
            damping_ratio: 0.45,
        }
    }
}

fn within(name: &'static str, value: f64, minimum: f64, maximum: f64) -> Result<(), SolverError> {
    if (minimum..=maximum).contains(&value) {
        Ok(())
    } else {
        Err(SolverError::MaterialOutOfRange {
            name,
            value,
            minimum,
            maximum,
        })
    }
}
