//! The study: a scene with everything resolved, ready to run.
//!
//! Each module resolves one table of the scene, and refuses values that cannot be used with file, line, key, value and remedy.

pub(crate) mod budget;
mod check;
mod crease_names;
pub(crate) mod flat_folding;
mod gap;
pub(crate) mod imported;
pub(crate) mod input;
mod material;
pub(crate) mod mending;
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
use foldmotion_solver::quasi_static::Contact;
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
    /// The title of the scene.
    pub title: String,
    /// FOLD's name of the unit of length.
    pub unit_name: &'static str,
    /// The sheet that is folded.
    pub subject: Subject,
    /// The mechanical model: bars, hinges and masses.
    pub model: Model,
    /// The target fold angles along the motion.
    pub schedule: Schedule,
    /// The engine that computes the motion.
    pub engine: EngineChoice,
    /// The device of the dynamic engine; the quasi-static engine runs on the processor.
    pub device: Device,
    /// The contact of layers, its gaps in units of the sheet's unit length; `None` if layers may pass through each other.
    pub contact: Option<Contact>,
    /// The thickness of the sheet; `None` if the scene does not set it.
    pub thickness: Option<f64>,
    /// The number of intervals: the states at t = 2k/frames are recorded.
    pub frames: usize,
    /// The limit of the work of the engine; `None` for its own limit.
    pub budget: Option<MotionBudget>,
    /// The options of the collision check.
    pub collision: CollisionOptions,
    /// The outputs in addition to the report, and their settings.
    pub recording: Recording,
    /// Notes for the user, one line each: values that are not used, and why.
    pub notes: Vec<String>,
}

impl Study {
    /// Resolves a scene: sheet, model, schedule and settings.
    ///
    /// # Errors
    /// The first unusable value, with file, line, key, value and remedy; for an imported pattern with the element.
    pub fn resolve(source: &SceneSource) -> Result<Self, StudyError> {
        let scene = source.scene()?;
        let input = Input::new(source, &scene);
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
        let contact = gap::contact(&input, &subject)?;
        let collision = check::collision(&input, &subject, contact.as_ref())?;
        let mut notes = notes(&input, &subject);
        notes.extend(gap::lowered(&input, &subject, contact.as_ref()));
        notes.extend(check::lowered(&input, &collision));
        Ok(Self {
            title: title.clone(),
            unit_name: unit_name(&input, &subject),
            model: Model::new(sheet, &material::material(&input, &subject)?)
                .map_err(|error| imported::model_error(&input, error))?,
            schedule,
            engine: motion::engine(&input),
            device: Device::Cpu,
            contact,
            thickness: material::material_thickness(&input)?,
            frames: motion::frames(&input)?,
            budget: budget::budget(&input)?,
            collision,
            notes,
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

/// Notes about values of the scene that its case does not use.
fn notes(input: &Input<'_>, subject: &Subject) -> Vec<String> {
    let units = match subject {
        Subject::Units(study) => &study.units,
        Subject::Imported(study) => return study.notes(),
    };
    let scene = &input.scene.sheet;
    let is_open = matches!(scene.case, None | Some(CaseChoice::Auto));
    if !is_open || !units.has_equal_rows() || !matches!(units.unit.case, Case::E | Case::T) {
        return Vec::new();
    }
    let given = [("sheet.lambda", scene.lambda), ("sheet.offset", scene.offset)];
    let unused = given.into_iter().filter_map(|(key, value)| Some((key, value?)));
    let note = |(key, value)| {
        let (case, ratio) = (units.unit.case.name(), units.unit.width / units.unit.height);
        let location = input.source.location_of(key);
        format!(
            "{location}: {key} = {} is not used: with w/h = {:.6} the case is {case}",
            Number(value),
            Number(ratio)
        )
    };
    unused.map(note).collect()
}
