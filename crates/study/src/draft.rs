//! The sheet of a scene without its motion: resolved quickly enough to follow a control point that is dragged.

use foldmotion_geometry::{Division, Fit, Profile};
use foldmotion_pattern::{CompactBox, PatternCheck, Sheet, UnitSheet};
use glam::DVec3;

use crate::resolve::imported::{ImportedStudy, imported};
use crate::resolve::input::Input;
use crate::resolve::unit::pattern_error;
use crate::resolve::units::{ResolvedSheet, sheet};
use crate::scene::DivisionMethod;
use crate::{SceneSource, StudyError};

/// The sheet that a scene folds.
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
    /// The curve Γ that the sheet approximates.
    pub profile: Profile,
    /// The origin of Γ: a built-in profile, or a key or file of the scene.
    pub profile_source: String,
    /// The division of Γ into segments.
    pub division: Division,
    /// The method of the division.
    pub division_method: DivisionMethod,
    /// The distances of Γ from its segments.
    pub fit: Fit,
    /// The sheet of units.
    pub units: UnitSheet,
    /// The pattern check.
    pub pattern: PatternCheck,
    /// The closed form of the compact box; `None` if the case has none.
    pub closed_form: Option<CompactBox>,
    /// The deployed state.
    pub deployed: Vec<DVec3>,
}

impl Draft {
    /// Resolves the sheet of `source`; the tables `material`, `motion`, `check` and `record` are ignored.
    ///
    /// # Errors
    /// Every unusable value, with file, line, key, value and remedy.
    pub fn resolve(source: &SceneSource) -> Result<Self, StudyError> {
        let scene = source.scene()?;
        let input = Input::new(source, &scene);
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

    /// The sheet of units; `None` for an imported pattern.
    pub fn units(&self) -> Option<&UnitDraft> {
        match self {
            Self::Units(draft) => Some(draft),
            Self::Imported(_) => None,
        }
    }

    /// The positions at which the motion starts.
    pub fn start(&self) -> Vec<DVec3> {
        match self {
            Self::Units(draft) => draft.deployed.clone(),
            Self::Imported(study) => study.imported.sheet.planar(),
        }
    }
}

fn unit_draft(input: &Input<'_>) -> Result<UnitDraft, StudyError> {
    let ResolvedSheet { profile_source, divided, units, .. } = sheet(input)?;
    let deployed = units
        .deployed(&divided.division.points, input.scene.sheet.facing.unwrap_or_default())
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
