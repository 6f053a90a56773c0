//! The study: a scene with everything resolved, ready to run.

use std::time::Instant;

use foldmotion_check::CollisionOptions;
use foldmotion_geometry::{Division, Fit, Profile};
use foldmotion_pattern::{
    Case, CompactBox, Facing, PatternCheck, PatternError, ProfileModel, Unit, UnitSheet,
};
use foldmotion_solver::dynamic::Device;
use foldmotion_solver::quasi_static::Contact;
use foldmotion_solver::{
    CreaseGroup, Ease, Material, Model, Schedule, ScheduleStep, SolverError, Stage,
};
use glam::DVec3;

use crate::profile::DividedProfile;
use crate::recording::Recording;
use crate::scene::{
    CaseChoice, CreasesChoice, DivisionChoice, EaseChoice, EngineChoice, FacingChoice, StageChoice,
    StepScene,
};
use crate::unfolding::Unfolding;
use crate::{Scene, SceneSource, StudyError};

/// Layers that lie on each other in a column of the compact state.
const LAYERS_OF_A_COLUMN: f64 = 8.0;
/// The smallest gap, in units of h: below it a barrier outgrows what f64 resolves.
const SMALLEST_GAP: f64 = 1e-6;
/// Frames of a motion, at most: the file of a small sheet then stays below some gigabytes.
const MOST_FRAMES: usize = 100_000;
/// Sheets larger than this many units exceed what one machine folds.
const MOST_ROWS_OR_COLUMNS: i64 = 1_000_000;

/// Everything a run needs, resolved from a scene.
#[derive(Debug, Clone)]
pub struct Study {
    /// Its title.
    pub title: String,
    /// FOLD's name of the unit of length.
    pub unit_name: &'static str,
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
    /// The deployed state, at which the motion starts.
    pub deployed: Vec<DVec3>,
    /// Bars, hinges and masses.
    pub model: Model,
    /// How stage 1 moves the row creases.
    pub unfolding: Unfolding,
    /// The target fold angles along the motion.
    pub schedule: Schedule,
    /// What moves the sheet.
    pub engine: EngineChoice,
    /// Where the dynamic engine moves it; the quasi-static one runs on the processor.
    pub device: Device,
    /// How close layers may come, in units of h; none lets them pass through each other.
    pub contact_gap: Option<f64>,
    /// Thickness of the sheet, where the scene gives it.
    pub thickness: Option<f64>,
    /// The states t = 2k/frames are recorded.
    pub frames: usize,
    /// How the motion is checked.
    pub collision: CollisionOptions,
    /// What is written beside the report, and how it looks.
    pub recording: Recording,
}

impl Study {
    /// Resolves a scene: profile, division, sheet, model, schedule.
    ///
    /// # Errors
    /// Every unusable value, with file, line, key, value and remedy.
    pub fn resolve(source: &SceneSource) -> Result<Self, StudyError> {
        let scene = source.scene()?;
        let resolver = Resolver {
            source,
            scene: &scene,
        };
        let ResolvedSheet {
            profile_source,
            divided,
            division_seconds,
            units,
        } = resolver.sheet()?;
        let (profile, division) = (divided.profile, divided.division);
        let facing = match scene.sheet.facing {
            Some(FacingChoice::Right) => Facing::Right,
            _ => Facing::Left,
        };
        let deployed = units
            .deployed(&division.points, facing)
            .map_err(|e| resolver.pattern_error(&e))?;
        let deployed_angles = units
            .deployed_angles(&division.points, facing)
            .map_err(|e| resolver.pattern_error(&e))?;
        let model = Model::new(&units.sheet, &resolver.material()?)?;
        let steps = resolver.steps_of(&units)?;
        let mut schedule =
            Schedule::uniform(&units.sheet, &deployed_angles, units.compact_angles())?
                .with_steps(&units.sheet, &steps)
                .map_err(|e| resolver.schedule_error(e))?;
        let unfolding = resolver.unfolding(&profile, &division, &steps)?;
        if let Some(path) = unfolding.fold_angles(facing) {
            schedule = schedule.with_unfold_path(&units.sheet, path)?;
        }
        Ok(Self {
            title: resolver.title(),
            unit_name: scene.profile.unit.unwrap_or_default().name(),
            pattern: units.check(),
            closed_form: units.closed_form(),
            engine: resolver.engine(),
            device: Device::Cpu,
            contact_gap: resolver.contact_gap(&units)?,
            thickness: scene.material.thickness,
            frames: resolver.frames()?,
            collision: resolver.collision()?,
            recording: resolver.recording()?,
            profile,
            profile_source,
            division,
            division_method: divided.method,
            fit: divided.fit,
            division_seconds,
            units,
            deployed,
            model,
            unfolding,
            schedule,
        })
    }
}

/// Γ divided and the sheet of units: what is folded, before anything says how.
pub(crate) struct ResolvedSheet {
    profile_source: String,
    divided: DividedProfile,
    division_seconds: f64,
    pub(crate) units: UnitSheet,
}

/// Reads values out of the scene and turns what is wrong with them into errors that name their line.
pub(crate) struct Resolver<'a> {
    pub(crate) source: &'a SceneSource,
    pub(crate) scene: &'a Scene,
}

impl Resolver<'_> {
    /// The title; the file's name where the scene has none.
    pub(crate) fn title(&self) -> String {
        let title = self.scene.title.clone();
        title.unwrap_or_else(|| self.source.stem())
    }

    /// Divides the profile and lays out the sheet.
    pub(crate) fn sheet(&self) -> Result<ResolvedSheet, StudyError> {
        let curve = self.curve()?;
        let started = Instant::now();
        let divided = self.division(&curve)?;
        let division_seconds = started.elapsed().as_secs_f64();
        let columns = self.count(
            "sheet.columns",
            self.scene.sheet.columns,
            curve.model.map(|m| m.columns.of(self.case_asked_for())),
        )?;
        let units = self.units(curve.model, &divided.division, columns)?;
        Ok(ResolvedSheet {
            profile_source: curve.source,
            divided,
            division_seconds,
            units,
        })
    }

    pub(crate) fn fault(&self, key: &str, message: impl Into<String>) -> StudyError {
        self.source.value_error(key, message.into())
    }

    pub(crate) fn positive(&self, key: &str, value: f64) -> Result<f64, StudyError> {
        if value > 0.0 && value.is_finite() {
            Ok(value)
        } else {
            Err(self.fault(key, "must be a positive, finite number"))
        }
    }

    pub(crate) fn count(
        &self,
        key: &str,
        value: Option<i64>,
        default: Option<usize>,
    ) -> Result<usize, StudyError> {
        match (value, default) {
            (Some(n), _) => usize::try_from(n)
                .ok()
                .filter(|_| (1..=MOST_ROWS_OR_COLUMNS).contains(&n))
                .ok_or_else(|| {
                    self.fault(
                        key,
                        format!("must lie between 1 and {MOST_ROWS_OR_COLUMNS}"),
                    )
                }),
            (None, Some(n)) => Ok(n),
            (None, None) => Err(self.fault(key, "is missing: a profile of your own needs it")),
        }
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
        Unit::new(case, width, height, scene.lambda, scene.offset)
            .map_err(|e| self.pattern_error(&e))
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
            (Some(width), _) => Ok(self.positive("sheet.width", width)? / columns as f64),
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

    fn material(&self) -> Result<Material, StudyError> {
        let scene = &self.scene.material;
        let standard = match scene.preset {
            Some(preset) => Material::preset(preset.name()).unwrap_or_default(),
            None => Material::default(),
        };
        let material = Material {
            axial_stiffness: scene.axial_stiffness.unwrap_or(standard.axial_stiffness),
            fold_stiffness: scene.fold_stiffness.unwrap_or(standard.fold_stiffness),
            facet_stiffness: scene.facet_stiffness.unwrap_or(standard.facet_stiffness),
            face_angle_stiffness: scene
                .face_angle_stiffness
                .unwrap_or(standard.face_angle_stiffness),
            damping_ratio: scene.damping_ratio.unwrap_or(standard.damping_ratio),
        };
        material.validate().map_err(|e| match e {
            SolverError::MaterialOutOfRange {
                name,
                minimum,
                maximum,
                ..
            } => self.fault(
                &format!("material.{name}"),
                format!("must lie between {minimum:e} and {maximum:e}"),
            ),
            other => StudyError::Solver(other),
        })?;
        Ok(material)
    }

    fn engine(&self) -> EngineChoice {
        self.scene
            .motion
            .engine
            .unwrap_or(EngineChoice::QuasiStatic)
    }

    /// The gap, in units of h; none without contact.
    fn contact_gap(&self, units: &UnitSheet) -> Result<Option<f64>, StudyError> {
        let height = units.unit.height;
        let motion = &self.scene.motion;
        let thickness = self.scene.material.thickness;
        let is_dynamic = self.engine() == EngineChoice::Dynamic;
        if is_dynamic && motion.contact == Some(true) {
            let message = "the dynamic engine has no contact; use engine = \"quasi-static\", or contact = false";
            return Err(self.fault("motion.contact", message));
        }
        if is_dynamic || motion.contact == Some(false) {
            let given = [
                ("motion.gap", motion.gap),
                // Of a map it is also what its stack is measured by.
                (
                    "material.thickness",
                    thickness.filter(|_| units.map_layers().is_none()),
                ),
            ];
            return match given.into_iter().find(|(_, value)| value.is_some()) {
                Some((key, _)) => {
                    Err(self.fault(key, "keeps layers apart, but contact is off; leave it out"))
                }
                None => Ok(None),
            };
        }
        let (key, gap) = match (motion.gap, thickness) {
            (Some(_), Some(_)) => {
                let message = "the gap follows from material.thickness; leave one of the two out";
                return Err(self.fault("motion.gap", message));
            }
            (_, Some(thickness)) => ("material.thickness", thickness / height),
            (gap, None) => ("motion.gap", gap.unwrap_or(Contact::default().gap)),
        };
        let layers = units.map_layers().map_or(LAYERS_OF_A_COLUMN, |n| n as f64);
        let limit = units.thinnest_part() / height / layers;
        if gap >= SMALLEST_GAP && gap <= limit {
            return Ok(Some(gap));
        }
        let scale = if key == "material.thickness" {
            height
        } else {
            1.0
        };
        let message = format!(
            "must lie between {:e} and {:.6}, so that the {layers} layers on each other fit beside the thinnest part of the unit",
            SMALLEST_GAP * scale,
            limit * scale
        );
        Err(self.fault(key, message))
    }

    pub(crate) fn steps(&self) -> Result<Vec<ScheduleStep>, StudyError> {
        let step = |(index, step): (usize, &StepScene)| {
            let range = |key: &str, range: &Option<Vec<i64>>| match range.as_deref() {
                None => Ok(None),
                Some(&[one]) => self.place_range(index, key, [one, one]),
                Some(&[first, last]) => self.place_range(index, key, [first, last]),
                Some(_) => {
                    let message = "must be [first, last], both included, or [one]";
                    Err(self.fault(&format!("motion.step.{index}.{key}"), message))
                }
            };
            Ok(ScheduleStep {
                stage: match step.stage {
                    StageChoice::Unfold => Stage::Unfold,
                    StageChoice::Fold => Stage::Fold,
                },
                creases: match step.creases {
                    None | Some(CreasesChoice::All) => CreaseGroup::All,
                    Some(CreasesChoice::Rows) => CreaseGroup::Rows,
                    Some(CreasesChoice::Columns) => CreaseGroup::Columns,
                    Some(CreasesChoice::Diagonals) => CreaseGroup::Diagonals,
                    Some(CreasesChoice::Verticals) => CreaseGroup::Verticals,
                    Some(CreasesChoice::Pads) => CreaseGroup::Pads,
                },
                rows: range("rows", &step.rows)?,
                columns: range("columns", &step.columns)?,
                from: step.from.unwrap_or(0.0),
                to: step.to.unwrap_or(1.0),
                ease: match step.ease {
                    None | Some(EaseChoice::Linear) => Ease::Linear,
                    Some(EaseChoice::Smooth) => Ease::Smooth,
                },
            })
        };
        self.scene
            .motion
            .step
            .iter()
            .enumerate()
            .map(step)
            .collect()
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

    fn place_range(
        &self,
        index: usize,
        key: &str,
        range: [i64; 2],
    ) -> Result<Option<[u32; 2]>, StudyError> {
        match range.map(u32::try_from) {
            [Ok(first), Ok(last)] => Ok(Some([first, last])),
            _ => Err(self.fault(&format!("motion.step.{index}.{key}"), "counts from 0")),
        }
    }

    fn schedule_error(&self, error: SolverError) -> StudyError {
        let key = match &error {
            SolverError::StepTime { step, name, .. } => format!("motion.step.{step}.{name}"),
            SolverError::StepDuration { step, .. } => format!("motion.step.{step}.to"),
            SolverError::StepRange { step, what, .. } => format!("motion.step.{step}.{what}"),
            SolverError::StepNamesNone { step } => format!("motion.step.{step}"),
            SolverError::StepsOverlap { steps, .. } => format!("motion.step.{}", steps[1]),
            _ => return StudyError::Solver(error),
        };
        self.fault(&key, error.to_string())
    }

    fn frames(&self) -> Result<usize, StudyError> {
        let frames = self.scene.motion.frames.unwrap_or(240);
        usize::try_from(frames)
            .ok()
            .filter(|n| n.is_multiple_of(2) && (2..=MOST_FRAMES).contains(n))
            .ok_or_else(|| {
                let message = format!("must be an even number between 2 and {MOST_FRAMES}");
                self.fault("motion.frames", message)
            })
    }

    fn collision(&self) -> Result<CollisionOptions, StudyError> {
        let mut options = CollisionOptions::default();
        if let Some(tolerance) = self.scene.check.touch_tolerance {
            if !(tolerance > 0.0 && tolerance <= 1e-2) {
                return Err(self.fault(
                    "check.touch_tolerance",
                    "must lie above 0 and be at most 0.01 (units of h)",
                ));
            }
            options.touch_tolerance = tolerance;
        }
        Ok(options)
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
