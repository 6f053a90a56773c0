//! A sheet of units, resolved: profile, division, sheet and how it unfolds.

use std::time::Instant;

use foldmotion_geometry::{Division, Fit, Profile};
use foldmotion_pattern::{
    Case, CompactBox, Folding, LayerOrder, PatternCheck, PatternError, ProfileModel, Unit,
    UnitSheet,
};
use foldmotion_solver::{Schedule, ScheduleStep, Stage};
use glam::DVec3;

use crate::profile::DividedProfile;
use crate::scene::{CaseChoice, DivisionChoice};
use crate::study::Resolver;
use crate::unfolding::Unfolding;
use crate::{SceneSource, StudyError};

/// Entries of the order of the compact state, at most: about 1 GB.
const MOST_ORDERED: usize = 50_000_000;

/// Units of a sheet that is folded, at most: some 10 GB.
const MOST_FOLDED: usize = 1_000_000;

/// A sheet of units on a divided profile.
#[derive(Debug, Clone)]
pub struct UnitStudy {
    /// Γ.
    pub profile: Profile,
    /// Where Γ comes from.
    pub profile_source: String,
    /// Γ divided.
    pub division: Division,
    /// How.
    pub division_method: DivisionChoice,
    /// How far Γ is from its segments.
    pub fit: Fit,
    /// Seconds the division took.
    pub division_seconds: f64,
    /// The sheet of units.
    pub units: UnitSheet,
    /// The pattern check.
    pub pattern: PatternCheck,
    /// The closed form of the compact box, where the case has one.
    pub closed_form: Option<CompactBox>,
    /// The exact order of the layers in the compact state.
    pub compact_order: LayerOrder,
    /// The deployed state, at which the motion starts.
    pub deployed: Vec<DVec3>,
    /// How stage 1 moves the row creases.
    pub unfolding: Unfolding,
}

impl UnitStudy {
    /// Resolves profile, division, sheet and unfolding of a scene.
    ///
    /// # Errors
    /// Every unusable value, with file, line, key, value and remedy.
    pub fn resolve(source: &SceneSource) -> Result<Self, StudyError> {
        let scene = source.scene()?;
        let resolver = Resolver {
            source,
            scene: &scene,
        };
        Ok(resolver.unit_study()?.0)
    }
}

/// Γ divided and the sheet of units: what is folded, before anything says how.
pub(crate) struct ResolvedSheet {
    pub(crate) profile_source: String,
    pub(crate) divided: DividedProfile,
    division_seconds: f64,
    pub(crate) units: UnitSheet,
}

/// What a sheet is laid out for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// To be seen, or cut.
    Show,
    /// To be folded and checked too.
    Fold,
}

impl Resolver<'_> {
    /// The sheet of units, and its schedule.
    pub(crate) fn unit_study(&self) -> Result<(UnitStudy, Schedule), StudyError> {
        let ResolvedSheet {
            profile_source,
            divided,
            division_seconds,
            units,
        } = self.laid_out(Purpose::Fold)?;
        let (profile, division) = (divided.profile, divided.division);
        let facing = self.scene.facing();
        let deployed = units
            .deployed(&division.points, facing)
            .map_err(|e| self.pattern_error(&e))?;
        let deployed_angles = units
            .deployed_angles(&division.points, facing)
            .map_err(|e| self.pattern_error(&e))?;
        let steps = self.steps_of(&units)?;
        let mut schedule =
            Schedule::uniform(&units.sheet, &deployed_angles, units.compact_angles())?
                .with_steps(&units.sheet, &steps)
                .map_err(|e| self.schedule_error(e))?;
        let unfolding = self.unfolding(&profile, &division, &steps)?;
        if let Some(path) = unfolding.fold_angles(facing) {
            schedule = schedule.with_unfold_path(&units.sheet, path)?;
        }
        let study = UnitStudy {
            pattern: units.check(),
            closed_form: units.closed_form(),
            compact_order: self.compact_order(&units)?,
            profile,
            profile_source,
            division,
            division_method: divided.method,
            fit: divided.fit,
            division_seconds,
            units,
            deployed,
            unfolding,
        };
        Ok((study, schedule))
    }

    /// The order of the layers in the compact state, which check and films hold in memory.
    fn compact_order(&self, units: &UnitSheet) -> Result<LayerOrder, StudyError> {
        units
            .compact_order_within(MOST_ORDERED)
            .ok_or_else(|| self.too_many_layers())
    }

    fn too_many_layers(&self) -> StudyError {
        let message = format!(
            "more than {} pairs of facets would coincide in the compact state, too many to check; fewer columns, or a \
             case whose columns lie beside each other (S, SII)",
            MOST_ORDERED / 2
        );
        self.fault("sheet.columns", message)
    }

    /// Refuses a sheet that memory could not hold or whose layers nothing could check, before it is laid out.
    pub(crate) fn require_moderate(
        &self,
        units: &[Unit],
        columns: usize,
        folding: Folding,
    ) -> Result<(), StudyError> {
        let rows = units.len();
        if rows.saturating_mul(columns) > MOST_FOLDED {
            let message = format!(
                "{rows} x {columns} units are more than {MOST_FOLDED}, the most that are folded; fewer columns or rows"
            );
            return Err(self.fault("sheet.columns", message));
        }
        let Some(&unit) = units
            .first()
            .filter(|&first| units.iter().all(|unit| unit == first))
        else {
            return Ok(());
        };
        match UnitSheet::count_compact_order(unit, rows, columns, folding) {
            Some(count) if count > MOST_ORDERED as f64 => Err(self.too_many_layers()),
            _ => Ok(()),
        }
    }

    /// Divides the profile and lays out the sheet.
    pub(crate) fn sheet(&self) -> Result<ResolvedSheet, StudyError> {
        self.laid_out(Purpose::Show)
    }

    fn laid_out(&self, purpose: Purpose) -> Result<ResolvedSheet, StudyError> {
        let curve = self.curve()?;
        let started = Instant::now();
        let divided = self.division(&curve)?;
        let division_seconds = started.elapsed().as_secs_f64();
        let columns = self.count(
            "sheet.columns",
            self.scene.sheet.columns,
            curve.model.map(|m| m.columns.of(self.case_asked_for())),
        )?;
        let units = self.units(curve.model, &divided.division, columns, purpose)?;
        Ok(ResolvedSheet {
            profile_source: curve.source,
            divided,
            division_seconds,
            units,
        })
    }

    /// The case whose columns a built-in profile brings.
    fn case_asked_for(&self) -> Case {
        match self.scene.sheet.case {
            Some(CaseChoice::T) => Case::T,
            Some(CaseChoice::S) => Case::S,
            Some(CaseChoice::SII) => Case::SII,
            Some(CaseChoice::Plain) => Case::Plain,
            None | Some(CaseChoice::E | CaseChoice::Auto) => Case::E,
        }
    }

    /// w and the case, from W, Nc and h. A built-in profile is as wide in every case as in case E.
    pub(crate) fn unit(
        &self,
        built_in: Option<&ProfileModel>,
        height: f64,
        columns: usize,
    ) -> Result<Unit, StudyError> {
        let scene = &self.scene.sheet;
        let choice = scene.case.unwrap_or(CaseChoice::Auto);
        let width = self.unit_width(built_in, height, columns)?;
        let case = choice.resolve(width, height, scene.lambda);
        // Where the case is open, these belong to the one that λ asks for.
        let is_unused = choice == CaseChoice::Auto && matches!(case, Case::E | Case::T);
        let [lambda, offset] =
            [scene.lambda, scene.offset].map(|value| value.filter(|_| !is_unused));
        Unit::new(case, width, height, lambda, offset).map_err(|e| self.pattern_error(&e))
    }

    /// w, from W and Nc, or from the (mean) height of the rows.
    pub(crate) fn unit_width(
        &self,
        built_in: Option<&ProfileModel>,
        height: f64,
        columns: usize,
    ) -> Result<f64, StudyError> {
        let scene = &self.scene.sheet;
        match (scene.width, scene.case.unwrap_or(CaseChoice::Auto)) {
            (Some(width), _) => Ok(self.length("sheet.width", width)? / columns as f64),
            (None, CaseChoice::E | CaseChoice::Auto) => Ok(height),
            (None, _) if let Some(model) = built_in => {
                Ok(model.columns.e as f64 * height / columns as f64)
            }
            (None, _) => {
                let message =
                    "is missing: only case E makes the width from the rows' height, W = Nc·h";
                Err(self.fault("sheet.width", message))
            }
        }
    }

    fn unfolding(
        &self,
        profile: &Profile,
        division: &Division,
        steps: &[ScheduleStep],
    ) -> Result<Unfolding, StudyError> {
        let in_turn = steps.iter().any(|step| {
            step.stage == Stage::Unfold && (step.rows.is_some() || step.columns.is_some())
        });
        let asked = self.scene.motion.unfold.unwrap_or_default();
        Unfolding::new(asked, profile, division, in_turn)
            .map_err(|e| self.fault("motion.unfold", e.to_string()))
    }

    pub(crate) fn pattern_error(&self, error: &PatternError) -> StudyError {
        let key = match error {
            PatternError::CountOutOfRange {
                name: "columns", ..
            } => "sheet.columns",
            PatternError::CountOutOfRange { .. } | PatternError::WrongPolygon { .. } => {
                "sheet.rows"
            }
            PatternError::LambdaOutOfRange { .. }
            | PatternError::CommonFlapOutOfRange { .. }
            | PatternError::KeyWithoutCase { key: "lambda", .. } => "sheet.lambda",
            PatternError::OffsetOutOfRange { .. } | PatternError::KeyWithoutCase { .. } => {
                "sheet.offset"
            }
            PatternError::CaseContradictsUnit { .. } if self.scene.sheet.width.is_some() => {
                "sheet.width"
            }
            PatternError::CaseContradictsUnit { .. } => "sheet.case",
            _ => "sheet.width",
        };
        self.fault(key, error.to_string())
    }
}
