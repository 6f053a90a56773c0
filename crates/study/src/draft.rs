//! What a scene folds, before anything says how it moves: quick enough to follow a hand that drags a control point.

use foldmotion_geometry::{Division, Fit, Profile};
use foldmotion_pattern::{CompactBox, PatternCheck, Sheet, UnitSheet};
use glam::DVec3;

use crate::resolve::imported::{ImportedStudy, imported};
use crate::resolve::input::Input;
use crate::resolve::unit::pattern_error;
use crate::resolve::units::{ResolvedSheet, sheet};
use crate::scene::DivisionMethod;
use crate::{SceneSource, StudyError};

/// What a scene folds.
#[derive(Debug, Clone)]
pub enum Draft {
    /// A sheet of units on a divided profile.
    Units(Box<UnitDraft>),
    /// The crease pattern of a file.
    Imported(Box<ImportedStudy>),
}

/// A sheet of units on a divided profile.
#[derive(Debug, Clone)]
pub struct UnitDraft {
    /// Γ.
    pub profile: Profile,
    /// Where Γ comes from.
    pub profile_source: String,
    /// Γ divided.
    pub division: Division,
    /// How.
    pub division_method: DivisionMethod,
    /// How far Γ is from its segments.
    pub fit: Fit,
    /// The sheet of units.
    pub units: UnitSheet,
    /// The pattern check.
    pub pattern: PatternCheck,
    /// The closed form of the compact box, where the case has one.
    pub closed_form: Option<CompactBox>,
    /// The deployed state.
    pub deployed: Vec<DVec3>,
}

impl Draft {
    /// Resolves what `source` folds. What says how it moves (`material`, `motion`, `check`, `record`) is not looked at.
    ///
    /// # Errors
    /// Every unusable value, with file, line, key, value and remedy.
    pub fn resolve(source: &SceneSource) -> Result<Self, StudyError> {
        let scene = source.scene()?;
        let input = Input {
            source,
            scene: &scene,
        };
        if let Some(pattern) = &scene.pattern {
            return Ok(Self::Imported(Box::new(imported(&input, pattern)?)));
        }
        Ok(Self::Units(Box::new(unit_draft(&input)?)))
    }

    /// The sheet.
    pub fn sheet(&self) -> &Sheet {
        match self {
            Self::Units(draft) => &draft.units.sheet,
            Self::Imported(study) => &study.imported.sheet,
        }
    }

    /// The sheet of units, where it is one.
    pub fn units(&self) -> Option<&UnitDraft> {
        match self {
            Self::Units(draft) => Some(draft),
            Self::Imported(_) => None,
        }
    }

    /// The state in which its motion starts.
    pub fn start(&self) -> Vec<DVec3> {
        match self {
            Self::Units(draft) => draft.deployed.clone(),
            Self::Imported(study) => study.imported.sheet.planar(),
        }
    }
}

fn unit_draft(input: &Input<'_>) -> Result<UnitDraft, StudyError> {
    let ResolvedSheet {
        profile_source,
        divided,
        units,
        ..
    } = sheet(input)?;
    let deployed = units
        .deployed(
            &divided.division.points,
            input.scene.sheet.facing.unwrap_or_default(),
        )
        .map_err(|e| pattern_error(input, &e))?;
    Ok(UnitDraft {
        pattern: units.check(),
        closed_form: units.closed_form(),
        profile: divided.profile,
        profile_source,
        division: divided.division,
        division_method: divided.method,
        fit: divided.fit,
        units,
        deployed,
    })
}
