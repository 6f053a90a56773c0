//! The crease pattern of a file, resolved, with its fold angles.

use std::path::Path;

use foldmotion_pattern::{
    ImportError, ImportOptions, ImportedPattern, LARGEST_IMPORT_FILE, MergeTolerance, PatternCheck,
    PatternFileFormat, Pieces, import_pattern,
};
use foldmotion_solver::{Schedule, ScheduleStep, SolverError, Stage};

use super::crease_names::named_edges;
use super::flat_folding::not_flat_foldable;
use super::input::Input;
use super::mending::MendingReport;
use super::motion::{schedule_error, steps};
use crate::scene::pattern::PatternScene;
use crate::scene::{CreaseGroup, DivisionScene, ProfileScene, SheetScene};
use crate::{SceneSource, StudyError, input_file};

/// A crease pattern of a file.
#[derive(Debug, Clone)]
pub struct ImportedStudy {
    /// The path of the file, as in the scene.
    pub file: String,
    /// The imported pattern.
    pub imported: ImportedPattern,
    /// FOLD's name of the unit of length.
    pub unit_name: &'static str,
    /// The part of its fold angles to which the pattern folds, in percent.
    pub fold_percent: f64,
    /// The fold angles at the end of each stage of the file, one for each edge, in radians; one list if the file has no stages.
    pub waypoints: Vec<Vec<f64>>,
    /// The facet that stays in place; `None` if none does.
    pub fixed: Option<u32>,
    /// The pattern check.
    pub pattern: PatternCheck,
}

impl ImportedStudy {
    /// The fold angle of each edge at the end of the motion.
    pub(crate) fn end_angles(&self) -> &[f64] {
        self.waypoints.last().map_or(&[], Vec::as_slice)
    }

    /// Lines for the user: what was done about near misses, creases that were left out, vertices that cannot fold flat.
    pub(crate) fn notes(&self) -> Vec<String> {
        let mending = MendingReport::new(&self.imported.mending).line();
        let is_to_fold_flat = self.imported.folds_flat() && self.fold_percent.abs() == 100.0;
        let faults = is_to_fold_flat.then(|| not_flat_foldable(&self.imported, &self.pattern));
        mending.into_iter().chain(faults.flatten()).collect()
    }

    /// The motion times at which the stages of the file end, except the last.
    pub(crate) fn waypoint_times(&self) -> Vec<f64> {
        let count = self.waypoints.len();
        let time = |k| Stage::Fold.start_time() + k as f64 / count as f64;
        (1..count).map(time).collect()
    }
}

/// Reads and resolves the pattern of the scene.
pub(crate) fn imported(
    input: &Input<'_>,
    scene: &PatternScene,
) -> Result<ImportedStudy, StudyError> {
    refuse_keys_of_units(input)?;
    let percent = scene.fold_percent.unwrap_or(100.0);
    if !(-100.0..=100.0).contains(&percent) {
        return Err(input.error("pattern.fold_percent", "must be between -100 and 100"));
    }
    let imported = read_pattern(input, scene)?;
    if !imported.has_creases() {
        let message = "the pattern has no crease inside its border: draw one (#f00 or #00f in SVG, M or V in FOLD)";
        return Err(input.error("pattern.file", message));
    }
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

/// The schedule from the flat pattern to its fold angles, through its waypoints.
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
    let steps = imported_steps(input)?;
    let named = input.scene.motion.step.iter().enumerate();
    let among: Result<Vec<_>, _> =
        named.map(|(index, step)| named_edges(input, index, step, &study.imported)).collect();
    schedule.with_steps_among(sheet, &steps, &among?).map_err(|e| schedule_error(input, e))
}

/// An error of the mechanical model of an imported pattern: edges and triangles that are too small are the pattern's.
pub(crate) fn model_error(input: &Input<'_>, error: SolverError) -> StudyError {
    let is_of_pattern = input.scene.pattern.is_some()
        && matches!(error, SolverError::DegenerateEdge { .. } | SolverError::DegenerateFace { .. });
    if is_of_pattern {
        let message = format!("{error}: a larger tolerance merges its ends");
        return input.error("pattern.vertex_tolerance", message);
    }
    StudyError::Solver(error)
}

/// Refuses keys that do not apply to an imported pattern.
fn refuse_keys_of_units(input: &Input<'_>) -> Result<(), StudyError> {
    let scene = input.scene;
    let tables = [
        ("profile", scene.profile != ProfileScene::default()),
        ("sheet", scene.sheet != SheetScene::default()),
        ("division", scene.division != DivisionScene::default()),
    ];
    if let Some((table, _)) = tables.into_iter().find(|(_, given)| *given) {
        let message = format!(
            "[{table}] describes a sheet of units, but [pattern] imports a sheet; omit one of the two"
        );
        return Err(StudyError::Parse { location: input.source.location_of(table), message });
    }
    if scene.motion.unfold.is_some() {
        let message = "an imported pattern starts flat, so nothing is unfolded; omit it";
        return Err(input.error("motion.unfold", message));
    }
    if scene.material.facet_model.is_some() {
        let message = "applies to the facets of units; the facets of an imported pattern are cut as its file says; omit it";
        return Err(input.error("material.facet_model", message));
    }
    Ok(())
}

fn read_pattern(input: &Input<'_>, scene: &PatternScene) -> Result<ImportedPattern, StudyError> {
    let path = input.source.resolve_path(&scene.file);
    let options = ImportOptions {
        merge: scene.vertex_tolerance.map(MergeTolerance::Absolute),
        unknown: scene.unknown.unwrap_or_default(),
        curve_tolerance: scene.curve_tolerance,
        curved_facets: scene.curved_facets.unwrap_or_default(),
        pieces: pieces(scene.piece.as_deref()),
    };
    let bytes = input.source.read_pattern(&path)?;
    let extension = path.extension().and_then(|ending| ending.to_str());
    let imported = import_pattern(&bytes, extension, &options);
    imported.map_err(|error| match error {
        ImportError::Tolerance { .. } if scene.vertex_tolerance.is_some() => {
            input.error("pattern.vertex_tolerance", error.to_string())
        }
        ImportError::CurveTolerance { .. } => {
            input.error("pattern.curve_tolerance", error.to_string())
        }
        ImportError::Piece { .. } => input.error("pattern.piece", error.to_string()),
        error => StudyError::Import { path, error: Box::new(error) },
    })
}

/// The pieces that the scene asks for.
fn pieces(name: Option<&str>) -> Pieces {
    match name {
        None | Some("main") => Pieces::Main,
        Some("largest") => Pieces::Largest,
        Some("all") => Pieces::All,
        Some(name) => Pieces::Named(name.to_owned()),
    }
}

/// The facet that stays in place. Several fixed facets would prevent the sheet from folding.
fn fixed_facet(
    input: &Input<'_>,
    scene: &PatternScene,
    imported: &ImportedPattern,
) -> Result<Option<u32>, StudyError> {
    let count = imported.sheet.facets.len();
    let fixed = match &scene.fixed {
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
    match *fixed.as_slice() {
        [] => Ok(None),
        [facet] => Ok(Some(facet)),
        _ => {
            let message = format!(
                "{} facets are fixed ({:?} …), but only one can be; name it here, or use [] for none",
                fixed.len(),
                &fixed[..2]
            );
            Err(input.error("pattern.fixed", message))
        }
    }
}

/// The steps of the scene. Steps for rows, columns or creases of units are refused.
fn imported_steps(input: &Input<'_>) -> Result<Vec<ScheduleStep>, StudyError> {
    for (index, step) in input.scene.motion.step.iter().enumerate() {
        let is_of_units = !matches!(
            step.creases,
            None | Some(CreaseGroup::All | CreaseGroup::Mountains | CreaseGroup::Valleys)
        );
        let unsuitable = [
            ("stage", step.stage == Stage::Unfold),
            ("creases", is_of_units),
            ("rows", step.rows.is_some()),
            ("columns", step.columns.is_some()),
        ];
        if let Some((key, _)) = unsuitable.into_iter().find(|&(_, is_unsuitable)| is_unsuitable) {
            let message = match key {
                "stage" => "an imported pattern starts flat; its only stage is \"fold\"",
                "creases" => {
                    "an imported pattern has no units; use \"all\", \"mountains\" or \"valleys\""
                }
                _ => "an imported pattern has no rows and columns; omit it",
            };
            return Err(input.error(&format!("motion.step.{index}.{key}"), message));
        }
    }
    steps(input)
}

/// The fold angles at the end of each stage, times `fraction`. Angles that a stage does not give are kept.
fn waypoints(imported: &ImportedPattern, with_stages: bool, fraction: f64) -> Vec<Vec<f64>> {
    if !with_stages || imported.stages.is_empty() {
        return vec![imported.targets.iter().map(|t| t * fraction).collect()];
    }
    let mut last = vec![0.0; imported.targets.len()];
    let stages = imported.stages.iter().map(|stage| {
        for (angle, target) in last.iter_mut().zip(&stage.angles) {
            *angle = target.map_or(*angle, |target| target * fraction);
        }
        last.clone()
    });
    stages.collect()
}

impl SceneSource {
    /// The scene that only has `[pattern]` with this file; `None` if the file is not a crease pattern by its extension
    /// or, if that is none of a crease pattern, by its content.
    pub(crate) fn for_pattern(path: &Path) -> Option<Self> {
        let extension = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
        if extension.eq_ignore_ascii_case("toml") {
            return None;
        }
        if PatternFileFormat::of_extension(extension).is_none() {
            let bytes = input_file::read(path, LARGEST_IMPORT_FILE as u64).ok()?;
            PatternFileFormat::of_content(&bytes)?;
        }
        let name = path.file_name()?.to_str()?;
        let mut source = Self::new(path, String::new());
        source.set_by_file("pattern.file", name);
        Some(source)
    }

    /// Whether [`Self::read`] treats a file as a crease pattern.
    pub fn is_pattern(path: &Path) -> bool {
        Self::for_pattern(path).is_some()
    }
}
