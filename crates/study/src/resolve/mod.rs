//! The study: a scene with everything resolved, ready to run.
//!
//! [`Study::resolve`] asks one function a section of the scene: `units` and `imported` for what is folded, `material`,
//! `motion`, `check` and `recording` for the rest. Each refuses what cannot be used with file, line, key, value and remedy.

pub(crate) mod budget;
mod check;
mod gap;
pub(crate) mod imported;
pub(crate) mod input;
mod material;
mod motion;
pub(crate) mod names;
pub(crate) mod placement;
pub(crate) mod profile;
pub(crate) mod recording;
pub(crate) mod rows;
pub(crate) mod subject;
pub(crate) mod unfolding;
pub(crate) mod unit;
pub(crate) mod units;

use foldmotion_check::CollisionOptions;
use foldmotion_geometry::Number;
use foldmotion_pattern::Case;
use foldmotion_solver::dynamic::Device;
use foldmotion_solver::{Model, Schedule};

use self::budget::MotionBudget;
use self::input::Input;
use self::recording::Recording;
use self::subject::Subject;
use crate::scene::{CaseChoice, EngineChoice};
use crate::{SceneSource, StudyError};

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
        let input = Input {
            source,
            scene: &scene,
        };
        let (subject, schedule) = if let Some(pattern) = &scene.pattern {
            let imported = imported::imported(&input, pattern)?;
            let schedule = imported::imported_schedule(&input, &imported)?;
            (Subject::Imported(Box::new(imported)), schedule)
        } else {
            let (units, schedule) = units::unit_study(&input)?;
            (Subject::Units(Box::new(units)), schedule)
        };
        let sheet = subject.sheet();
        let title = input.title(subject.title());
        let collision = check::collision(&input, &subject)?;
        Ok(Self {
            title: title.clone(),
            unit_name: unit_name(&input, &subject),
            model: Model::new(sheet, &material::material(&input)?)?,
            schedule,
            engine: motion::engine(&input),
            device: Device::Cpu,
            contact_gap: gap::contact_gap(&input, &subject)?,
            thickness: material::material_thickness(&input)?,
            frames: motion::frames(&input)?,
            budget: budget::budget(&input)?,
            collision,
            notes: notes(&input, &subject),
            recording: recording::recording(&input, title)?,
            subject,
        })
    }
}

fn unit_name(input: &Input<'_>, subject: &Subject) -> &'static str {
    match subject {
        Subject::Units(_) => input.scene.profile.unit.unwrap_or_default().name(),
        Subject::Imported(imported) => imported.unit_name,
    }
}

/// Values that the scene gives and its case leaves out.
fn notes(input: &Input<'_>, subject: &Subject) -> Vec<String> {
    let Some(units) = subject.units().map(|study| &study.units) else {
        return Vec::new();
    };
    let scene = &input.scene.sheet;
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
        let place = input.source.location_of(key);
        format!(
            "{place}: {key} = {} is not used: with w/h = {:.6} the case is {case}",
            Number(value),
            Number(ratio)
        )
    };
    unused.map(note).collect()
}
