//! The study: a scene with everything resolved, ready to run.

use foldmotion_check::CollisionOptions;
use foldmotion_geometry::Number;
use foldmotion_geometry::collide::Limits;
use foldmotion_pattern::Case;
use foldmotion_solver::dynamic::Device;
use foldmotion_solver::{
    CreaseGroup, Ease, Material, Model, Schedule, ScheduleStep, SolverError, Stage,
};

use glam::DVec3;

use crate::budget::MotionBudget;
use crate::recording::Recording;
use crate::scene::{CaseChoice, CreasesChoice, EaseChoice, EngineChoice, StageChoice, StepScene};
use crate::subject::Subject;
use crate::{Scene, SceneSource, StudyError};

/// Frames of a motion, at most: the file of a small sheet then stays below some gigabytes.
const MOST_FRAMES: usize = 100_000;
/// The shortest and the longest length of a scene, in its unit.
const SHORTEST: f64 = 1e-9;
const LONGEST: f64 = 1e9;
/// Sheets larger than this many units exceed what one machine folds.
const MOST_ROWS_OR_COLUMNS: i64 = 1_000_000;

/// Everything a run needs, resolved from a scene.
#[derive(Debug, Clone)]
pub struct Study {
    /// Its title.
    pub title: String,
    /// FOLD's name of the unit of length.
    pub unit_name: &'static str,
    /// What is folded.
    pub subject: Subject,
    /// Bars, hinges and masses.
    pub model: Model,
    /// The target fold angles along the motion.
    pub schedule: Schedule,
    /// What moves the sheet.
    pub engine: EngineChoice,
    /// Where the dynamic engine moves it; the quasi-static one runs on the processor.
    pub device: Device,
    /// How close layers may come, in units of the sheet's unit length; none lets them pass through each other.
    pub contact_gap: Option<f64>,
    /// Thickness of the sheet, where the scene gives it.
    pub thickness: Option<f64>,
    /// The states t = 2k/frames are recorded.
    pub frames: usize,
    /// How much work the engine may do; none: as much as it allows itself.
    pub budget: Option<MotionBudget>,
    /// How the motion is checked.
    pub collision: CollisionOptions,
    /// What is written beside the report, and how it looks.
    pub recording: Recording,
    /// What the user should know of the scene, a line each: values that are not used, and why.
    pub notes: Vec<String>,
}

impl Study {
    /// Resolves a scene: what is folded, model, schedule.
    ///
    /// # Errors
    /// Every unusable value, with file, line, key, value and remedy; of an imported pattern with the element.
    pub fn resolve(source: &SceneSource) -> Result<Self, StudyError> {
        let scene = source.scene()?;
        let resolver = Resolver {
            source,
            scene: &scene,
        };
        let (subject, schedule) = if let Some(pattern) = &scene.pattern {
            let imported = resolver.imported(pattern)?;
            let schedule = resolver.imported_schedule(&imported)?;
            (Subject::Imported(Box::new(imported)), schedule)
        } else {
            let (units, schedule) = resolver.unit_study()?;
            (Subject::Units(Box::new(units)), schedule)
        };
        let sheet = subject.sheet();
        let title = resolver.title(subject.title());
        let collision = resolver.collision(&subject)?;
        Ok(Self {
            title: title.clone(),
            unit_name: resolver.unit_name(&subject),
            model: Model::new(sheet, &resolver.material()?)?,
            schedule,
            engine: resolver.engine(),
            device: Device::Cpu,
            contact_gap: resolver.contact_gap(&subject)?,
            thickness: resolver.material_thickness()?,
            frames: resolver.frames()?,
            budget: resolver.budget()?,
            collision,
            notes: resolver.notes(&subject),
            recording: resolver.recording(title)?,
            subject,
        })
    }
}

/// Reads values out of the scene and turns what is wrong with them into errors that name their line.
pub(crate) struct Resolver<'a> {
    pub(crate) source: &'a SceneSource,
    pub(crate) scene: &'a Scene,
}

impl Resolver<'_> {
    /// The title; that of the pattern or the file's name where the scene has none.
    pub(crate) fn title(&self, of_pattern: Option<&String>) -> String {
        let own = self.scene.title.as_ref().or(of_pattern);
        own.map_or_else(|| self.source.stem(), |title| printable(title))
    }

    fn unit_name(&self, subject: &Subject) -> &'static str {
        match subject {
            Subject::Units(_) => self.scene.profile.unit.unwrap_or_default().name(),
            Subject::Imported(imported) => imported.unit_name,
        }
    }

    pub(crate) fn fault(&self, key: &str, message: impl Into<String>) -> StudyError {
        self.source.value_error(key, message.into())
    }

    /// A length that squares and cubes of leave within what f64 holds.
    pub(crate) fn length(&self, key: &str, value: f64) -> Result<f64, StudyError> {
        if (SHORTEST..=LONGEST).contains(&value) {
            return Ok(value);
        }
        let [least, most] = [SHORTEST, LONGEST].map(Number);
        let message =
            format!("must be positive, from {least} to {most}; take another profile.unit");
        Err(self.fault(key, message))
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
                format!(
                    "must lie between {} and {}",
                    Number(minimum),
                    Number(maximum)
                ),
            ),
            other => StudyError::Solver(other),
        })?;
        Ok(material)
    }

    pub(crate) fn engine(&self) -> EngineChoice {
        self.scene
            .motion
            .engine
            .unwrap_or(EngineChoice::QuasiStatic)
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
                    Some(CreasesChoice::Mountains) => CreaseGroup::Mountains,
                    Some(CreasesChoice::Valleys) => CreaseGroup::Valleys,
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

    pub(crate) fn schedule_error(&self, error: SolverError) -> StudyError {
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

    fn material_thickness(&self) -> Result<Option<f64>, StudyError> {
        let thickness = self.scene.material.thickness;
        thickness
            .map(|thickness| self.length("material.thickness", thickness))
            .transpose()
    }

    /// Values that the scene gives and its case leaves out.
    fn notes(&self, subject: &Subject) -> Vec<String> {
        let Some(units) = subject.units().map(|study| &study.units) else {
            return Vec::new();
        };
        let scene = &self.scene.sheet;
        let is_open = matches!(scene.case, None | Some(CaseChoice::Auto));
        if !is_open || !units.has_equal_rows() || !matches!(units.unit.case, Case::E | Case::T) {
            return Vec::new();
        }
        let given = [
            ("sheet.lambda", scene.lambda),
            ("sheet.offset", scene.offset),
        ];
        let unused = given
            .into_iter()
            .filter_map(|(key, value)| Some((key, value?)));
        let note = |(key, value)| {
            let (case, ratio) = (units.unit.case.name(), units.unit.width / units.unit.height);
            let place = self.source.place_of(key);
            format!(
                "{place}: {key} = {} is not used: with w/h = {:.6} the case is {case}",
                Number(value),
                Number(ratio)
            )
        };
        unused.map(note).collect()
    }

    fn collision(&self, subject: &Subject) -> Result<CollisionOptions, StudyError> {
        let mut options = CollisionOptions::default();
        if let Some(tolerance) = self.scene.check.touch_tolerance {
            if !(tolerance > 0.0 && tolerance <= 1e-2) {
                return Err(self.fault(
                    "check.touch_tolerance",
                    "must lie above 0 and be at most 0.01 (units of h, or of the mean edge)",
                ));
            }
            options.touch_tolerance = tolerance;
        }
        let (tolerance, least) = (options.touch_tolerance, least_tolerance(subject));
        if tolerance < least {
            let message = format!(
                "{} is too small for a sheet as long or wide as this beside its unit: rounding takes {:.2}; give a larger \
                 one, or a sheet of fewer or less slender units",
                Number(tolerance),
                Number(least)
            );
            return Err(self.fault("check.touch_tolerance", message));
        }
        if let Some(stop_at) = self.scene.check.stop_at {
            options.stop_at = usize::try_from(stop_at).map_err(|_| {
                self.fault(
                    "check.stop_at",
                    "must be 0, for no limit, or a number of pairs",
                )
            })?;
        }
        Ok(options)
    }
}

/// The least tolerance, in units of the sheet's unit of length, that the check can tell from rounding.
fn least_tolerance(subject: &Subject) -> f64 {
    /// Of the rounding; the check asks for a hundred times.
    const MARGINS: f64 = 128.0;
    let start = subject.start();
    let Some(&first) = start.first() else {
        return 0.0;
    };
    let planar = subject.sheet().planar();
    let spread = |positions: &[DVec3]| {
        let origin = positions.first().copied().unwrap_or(first);
        let distances = positions.iter().map(|p| p.distance(origin));
        distances.fold(0.0, f64::max)
    };
    let extent = spread(&start).max(spread(&planar));
    MARGINS * Limits::margin_for(extent) / subject.sheet().unit_length
}

/// A text as one line that no terminal takes for more.
pub(crate) fn printable(text: &str) -> String {
    let letter = |letter: char| if letter.is_control() { ' ' } else { letter };
    text.chars().map(letter).collect()
}
