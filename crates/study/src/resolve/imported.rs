//! The crease pattern of a file, resolved: what it is and which fold angles it takes.

use std::path::Path;

use foldmotion_pattern::{
    Curves, ImportError, ImportOptions, Imported, LARGEST_IMPORT_FILE, MergeTolerance,
    PatternCheck, import_fold, import_svg,
};
use foldmotion_solver::{Schedule, ScheduleStep, Stage};

use super::input::Input;
use super::motion::{schedule_error, steps};
use crate::scene::pattern::PatternScene;
use crate::scene::{CreaseGroup, DivisionScene, ProfileScene, SheetScene};
use crate::{SceneSource, StudyError, input_file};

/// A crease pattern of a file.
#[derive(Debug, Clone)]
pub struct ImportedStudy {
    /// The file, as the scene names it.
    pub file: String,
    /// What it holds.
    pub imported: Imported,
    /// FOLD's name of its unit of length.
    pub unit_name: &'static str,
    /// By how much of its fold angles it folds, in percent.
    pub fold_percent: f64,
    /// The fold angles through which it folds, radians, one list of one angle for each edge a stage of the file; it ends
    /// with the last. One list where the file has no stages.
    pub waypoints: Vec<Vec<f64>>,
    /// The facet that stays in place.
    pub fixed: Option<u32>,
    /// The pattern check.
    pub pattern: PatternCheck,
}

impl ImportedStudy {
    /// The fold angle every edge ends with.
    pub(crate) fn end_angles(&self) -> &[f64] {
        self.waypoints.last().map_or(&[], Vec::as_slice)
    }

    /// The motion times at which a stage of the file ends, but for the last.
    pub(crate) fn waypoint_times(&self) -> Vec<f64> {
        let count = self.waypoints.len();
        let time = |k| Stage::Fold.start_time() + k as f64 / count as f64;
        (1..count).map(time).collect()
    }
}

/// A format of crease patterns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PatternFileFormat {
    Fold,
    Svg,
}

impl PatternFileFormat {
    /// The format that the name of a file ends in, in upper or lower case.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        match ending.as_str() {
            "fold" => Some(Self::Fold),
            "svg" => Some(Self::Svg),
            _ => None,
        }
    }
}

/// The pattern that the scene names.
pub(crate) fn imported(
    input: &Input<'_>,
    scene: &PatternScene,
) -> Result<ImportedStudy, StudyError> {
    refuse_keys_of_units(input)?;
    let percent = scene.fold_percent.unwrap_or(100.0);
    if !(-100.0..=100.0).contains(&percent) {
        return Err(input.error("pattern.fold_percent", "must lie between -100 and 100"));
    }
    let imported = read_pattern(input, scene)?;
    let unit_name = match scene.unit {
        Some(unit) => unit.name(),
        None => imported.unit.name(),
    };
    Ok(ImportedStudy {
        file: scene.file.clone(),
        unit_name,
        fold_percent: percent,
        waypoints: waypoints(&imported, scene.stages != Some(false), percent / 100.0),
        fixed: fixed_facet(input, scene, &imported)?,
        pattern: imported.check(),
        imported,
    })
}

/// The schedule from the flat pattern through its waypoints.
pub(crate) fn imported_schedule(
    input: &Input<'_>,
    study: &ImportedStudy,
) -> Result<Schedule, StudyError> {
    let sheet = &study.imported.sheet;
    let flat = vec![0.0; sheet.edges.len()];
    let mut schedule = Schedule::uniform(sheet, &flat, study.end_angles())?;
    if study.waypoints.len() > 1 {
        schedule = schedule.with_waypoints(sheet, &study.waypoints)?;
    }
    schedule
        .with_steps(sheet, &imported_steps(input)?)
        .map_err(|e| schedule_error(input, e))
}

/// A pattern takes the place of profile, sheet and division.
fn refuse_keys_of_units(input: &Input<'_>) -> Result<(), StudyError> {
    let scene = input.scene;
    let tables = [
        ("profile", scene.profile != ProfileScene::default()),
        ("sheet", scene.sheet != SheetScene::default()),
        ("division", scene.division != DivisionScene::default()),
    ];
    if let Some((table, _)) = tables.into_iter().find(|(_, given)| *given) {
        let message = format!(
            "[{table}] describes a sheet of units, and [pattern] brings one of its own; leave one of the two out"
        );
        return Err(StudyError::Parse {
            place: input.source.location_of(table),
            message,
        });
    }
    if scene.motion.unfold.is_some() {
        let message = "an imported pattern starts flat: nothing is unfolded; leave it out";
        return Err(input.error("motion.unfold", message));
    }
    if scene.material.facet_model.is_some() {
        let message =
            "cuts the facets of units; an imported pattern is cut as its file says: leave it out";
        return Err(input.error("material.facet_model", message));
    }
    Ok(())
}

fn read_pattern(input: &Input<'_>, scene: &PatternScene) -> Result<Imported, StudyError> {
    let path = input.source.beside(&scene.file);
    let Some(format) = PatternFileFormat::of(&path) else {
        let message = "must end in .fold or .svg, the formats of crease patterns that are read";
        return Err(input.error("pattern.file", message));
    };
    let options = ImportOptions {
        merge: scene.vertex_tolerance.map(MergeTolerance::Absolute),
        unknown: scene.unknown.unwrap_or_default(),
        curves: scene
            .curve_tolerance
            .map_or(Curves::Refuse, Curves::Flatten),
    };
    let bytes = input_file::read(&path, LARGEST_IMPORT_FILE as u64)?;
    let imported = match format {
        PatternFileFormat::Fold => import_fold(&bytes, &options),
        PatternFileFormat::Svg => import_svg(&bytes, &options),
    };
    imported.map_err(|error| match error {
        ImportError::Tolerance { .. } if scene.vertex_tolerance.is_some() => {
            input.error("pattern.vertex_tolerance", error.to_string())
        }
        ImportError::CurveTolerance { .. } => {
            input.error("pattern.curve_tolerance", error.to_string())
        }
        error => StudyError::Import {
            path,
            error: Box::new(error),
        },
    })
}

/// The facet that stays in place: one at most, for several would hold the sheet.
fn fixed_facet(
    input: &Input<'_>,
    scene: &PatternScene,
    imported: &Imported,
) -> Result<Option<u32>, StudyError> {
    let count = imported.sheet.facets.len();
    let asked = match &scene.fixed {
        None => imported.fixed_facets.clone(),
        Some(list) => {
            let facet = |&n: &i64| u32::try_from(n).ok().filter(|&n| (n as usize) < count);
            let facets: Option<Vec<u32>> = list.iter().map(facet).collect();
            facets.ok_or_else(|| {
                let message = format!("the pattern has the facets 0 to {}", count - 1);
                input.error("pattern.fixed", message)
            })?
        }
    };
    match *asked.as_slice() {
        [] => Ok(None),
        [facet] => Ok(Some(facet)),
        _ => {
            let message = format!(
                "{} facets are to stay in place ({:?} …): only one can; name it here, or [] for none",
                asked.len(),
                &asked[..2]
            );
            Err(input.error("pattern.fixed", message))
        }
    }
}

/// The steps of the scene; a pattern has no rows, columns or units by which they could name creases.
fn imported_steps(input: &Input<'_>) -> Result<Vec<ScheduleStep>, StudyError> {
    for (index, step) in input.scene.motion.step.iter().enumerate() {
        let is_of_units = !matches!(
            step.creases,
            None | Some(CreaseGroup::All | CreaseGroup::Mountains | CreaseGroup::Valleys)
        );
        let faults = [
            ("stage", step.stage == Stage::Unfold),
            ("creases", is_of_units),
            ("rows", step.rows.is_some()),
            ("columns", step.columns.is_some()),
        ];
        if let Some((key, _)) = faults.into_iter().find(|(_, is_fault)| *is_fault) {
            let message = match key {
                "stage" => "an imported pattern starts flat: its one stage is \"fold\"",
                "creases" => {
                    "an imported pattern has no units; use \"all\", \"mountains\" or \"valleys\""
                }
                _ => "an imported pattern has no rows and columns; leave it out",
            };
            return Err(input.error(&format!("motion.step.{index}.{key}"), message));
        }
    }
    steps(input)
}

/// The fold angles along the way, times `fraction`. What a stage says nothing about stays as it was.
fn waypoints(imported: &Imported, with_stages: bool, fraction: f64) -> Vec<Vec<f64>> {
    if !with_stages || imported.stages.is_empty() {
        return vec![imported.targets.iter().map(|t| t * fraction).collect()];
    }
    let mut last = vec![0.0; imported.targets.len()];
    let stages = imported.stages.iter().map(|stage| {
        for (angle, asked) in last.iter_mut().zip(&stage.angles) {
            *angle = asked.map_or(*angle, |asked| asked * fraction);
        }
        last.clone()
    });
    stages.collect()
}

impl SceneSource {
    /// The scene of a crease pattern that is run by itself: `[pattern]` with this file, and all else left out; none where
    /// the name of the file ends in no format of crease patterns.
    pub(crate) fn for_pattern(path: &Path) -> Option<Self> {
        PatternFileFormat::of(path)?;
        let name = path.file_name()?.to_str()?;
        let mut source = Self::new(path, String::new());
        source.give("pattern.file", name);
        Some(source)
    }

    /// Whether [`Self::read`] takes a file for a crease pattern.
    pub fn is_pattern(path: &Path) -> bool {
        Self::for_pattern(path).is_some()
    }
}
