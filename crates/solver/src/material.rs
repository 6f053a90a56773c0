//! The material: stiffness and damping of a sheet.
//!
//! **What the numbers say about a real sheet** of thickness τ, Young's modulus E and Poisson's ratio ν (Schenk and Guest
//! 2011, "Origami folding: a structural engineering approach"; Filipov, Liu, Tachi, Schenk, Paulino 2017, "Bar and hinge
//! models for scalable analysis of origami"). A bar stands for a strip of tributary width b, so its EA is E τ b. A facet
//! bends with the plate stiffness D = E τ³ / (12 (1 − ν²)); a hinge between triangles whose centres lie b′ apart has the
//! stiffness D / b′ per unit length. The ratio
//!
//! EA / κ_facet = 12 (1 − ν²) b b′ / τ²
//!
//! is free of E and tells the thickness. With b ≈ b′ ≈ h/2 and ν = 0.3 it is about 2.7 (h/τ)². Creases are softer than
//! the facet by a length L* ("length scale of folding", 25 to 100 τ in paper: Lechenault, Thiria, Adda-Bedia 2014):
//! κ_fold = D / L*, of the order of κ_facet for h/2 ≈ 50 τ. Equilibrium shapes depend on these ratios alone, so E drops
//! out; the estimates hold to a factor, as the tributary widths of real facets differ.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::SolverError;

/// Materials by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Preset {
    /// Origami Simulator's constants, with its face-angle springs.
    OrigamiSimulator,
    /// Stiff bars, soft creases.
    Paper,
    /// Bars that strain by less than a thousandth.
    NearRigid,
}

impl Preset {
    /// Every preset, the softest first.
    pub const ALL: [Self; 3] = [Self::OrigamiSimulator, Self::Paper, Self::NearRigid];

    /// Its constants.
    pub fn material(self) -> Material {
        match self {
            Self::OrigamiSimulator => Material::ORIGAMI_SIMULATOR,
            Self::Paper => Material::PAPER,
            Self::NearRigid => Material::NEAR_RIGID,
        }
    }
}

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
    /// Origami Simulator's own numbers, face-angle springs included: as an elastic sheet about h/3 thick, so bars
    /// strain by several per cent in between.
    pub const ORIGAMI_SIMULATOR: Self = Self { face_angle_stiffness: 0.2, ..Self::SOFT };

    /// A sheet about h/30 thick (0.3 mm card for h = 1 cm): bars strain by less than a per cent.
    pub const PAPER: Self = Self { axial_stiffness: 2_000.0, ..Self::SOFT };

    /// A sheet about h/110 thick (0.1 mm paper for h = 11 mm): bars strain by less than a thousandth.
    pub const NEAR_RIGID: Self = Self { axial_stiffness: 25_000.0, ..Self::SOFT };

    const SOFT: Self = Self {
        axial_stiffness: 20.0,
        fold_stiffness: 0.7,
        facet_stiffness: 0.7,
        face_angle_stiffness: 0.0,
        damping_ratio: 0.45,
    };

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
        within("damping_ratio", self.damping_ratio, 0.0, Self::MAX_DAMPING_RATIO)
    }
}

impl Default for Material {
    fn default() -> Self {
        Self::SOFT
    }
}

fn within(name: &'static str, value: f64, minimum: f64, maximum: f64) -> Result<(), SolverError> {
    if (minimum..=maximum).contains(&value) {
        Ok(())
    } else {
        Err(SolverError::MaterialOutOfRange { name, value, minimum, maximum })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_named_preset_exists_and_is_valid_and_no_other() {
        for preset in Preset::ALL {
            assert_eq!(preset.material().validate(), Ok(()));
        }
    }

    #[test]
    fn presets_rise_in_stiffness_and_keep_the_hinges() {
        let [soft, paper, rigid] = Preset::ALL.map(Preset::material);
        assert!(soft.axial_stiffness < paper.axial_stiffness);
        assert!(paper.axial_stiffness < rigid.axial_stiffness);
        assert_eq!(soft.fold_stiffness, rigid.fold_stiffness);
        assert_eq!(soft.facet_stiffness, paper.facet_stiffness);
    }
}
