//! A crease pattern folded flat, without a motion: its flat state as FOLD and as a drawing.

use std::fmt::Write as _;

use foldmotion_pattern::{FlatState, LayerOrder};
use foldmotion_record::{FigureState, StripOptions, View, strip};
use glam::DVec3;

use crate::compute::layers::{FoundState, LayerOrderReport};
use crate::digest::sha256;
use crate::resolve::imported::imported;
use crate::resolve::input::Input;
use crate::results::{Command, Destination, Results};
use crate::{ImportedStudy, SceneSource, StudyError, VERSION};

/// The flat state as FOLD 1.2, with `faceOrders`.
const FOLDED_FOLD: &str = "folded.fold";
/// The flat state seen from both sides.
const FOLDED_SVG: &str = "folded.svg";

/// A crease pattern of a file, for its flat state.
#[derive(Debug, Clone)]
pub struct FoldedPattern {
    title: String,
    study: ImportedStudy,
}

impl FoldedPattern {
    /// Reads the crease pattern of a scene; `None` if the scene has a sheet of units.
    ///
    /// # Errors
    /// Every unusable value, with file, line, key, value and remedy.
    pub fn resolve(source: &SceneSource) -> Result<Option<Self>, StudyError> {
        let scene = source.scene()?;
        let Some(pattern) = &scene.pattern else {
            return Ok(None);
        };
        let input = Input::new(source, &scene);
        let study = imported(&input, pattern)?;
        let title = input.title(study.imported.title.as_ref());
        Ok(Some(Self { title, study }))
    }

    /// Folds the pattern flat and writes `folded.fold` and `folded.svg` into a folder if an order of its layers is proved. Returns a
    /// summary for the terminal: whether an order exists and is proved, or why not.
    ///
    /// # Errors
    /// [`StudyError`]; the folder is then as it was.
    pub fn write<'a>(&self, destination: impl Into<Destination<'a>>) -> Result<String, StudyError> {
        let found = FoundState::find(&self.study.imported, self.study.end_angles());
        let mut summary = self.summary(&found.report);
        let is_proved = found.report.exists == Some(true);
        let Some((state, order)) = found.ordered.as_ref().filter(|_| is_proved) else {
            return Ok(summary);
        };
        let mut results = Results::open(destination.into(), Command::Pattern, Some(FOLDED_FOLD))?;
        results.require_clear(&|name| [FOLDED_FOLD, FOLDED_SVG].contains(&name))?;
        let folder = results.folder().to_owned();
        let creator = format!("foldmotion {VERSION}");
        let fold = state.fold(order, &self.title, &creator, self.study.unit_name);
        results.write_bytes(FOLDED_FOLD, fold.as_bytes())?;
        results.write_bytes(FOLDED_SVG, drawing(state, order)?.as_bytes())?;
        let published = results.publish(Some(&sha256(fold.as_bytes())), &|_| false)?;
        for line in published.words() {
            let _ = writeln!(summary, "{line}");
        }
        let _ = writeln!(summary, "flat state in {}", folder.display());
        Ok(summary)
    }

    fn summary(&self, report: &LayerOrderReport) -> String {
        let facets = self.study.imported.sheet.facets.len();
        let mut text = format!("{}\n", self.title);
        let _ = match (report.pairs, report.exists) {
            (Some(pairs), Some(true)) => writeln!(
                text,
                "folds flat: {facets} facets, {pairs} overlapping pairs, an order of layers exists (proved)"
            ),
            (Some(pairs), _) => writeln!(
                text,
                "folds flat by reflections: {facets} facets, {pairs} overlapping pairs"
            ),
            (None, _) => writeln!(text, "{facets} facets"),
        };
        if let (Some(all), Some(components)) = (report.conditions, report.components) {
            let _ = writeln!(
                text,
                "conditions: {} taco-taco, {} taco-tortilla, {} tortilla-tortilla, {} transitivity; {components} components \
                 searched",
                all.taco_taco, all.taco_tortilla, all.tortilla_tortilla, all.transitivity
            );
        }
        let _ = writeln!(text, "{}", report.line());
        text
    }
}

/// The flat state from above and from below, front and back of the sheet in two colours.
fn drawing(state: &FlatState, order: &LayerOrder) -> Result<String, StudyError> {
    let above = state.frame().positions;
    let below = above.iter().map(|&p| p * DVec3::new(-1.0, 1.0, 1.0)).collect();
    let states = [
        FigureState::new(above, order, "from above"),
        FigureState::new(below, order, "from below"),
    ];
    let options =
        StripOptions { columns: 2, view: View::Top, has_key: false, ..StripOptions::default() };
    let drawing = strip(&state.sheet, &states, &options).map_err(StudyError::Record)?;
    drawing.svg().map_err(StudyError::Record)
}
