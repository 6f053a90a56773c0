//! A crease pattern folded flat, without a motion: its flat state as FOLD and as a drawing.

use std::fmt::Write as _;

use foldmotion_pattern::{FlatState, LayerOrder};
use foldmotion_record::{FigureState, StripOptions, View, strip};
use glam::DVec3;

use crate::compute::layers::{FoundState, LayerOrderReport};
use crate::{ImportedStudy, StudyError, VERSION};

/// The flat state as FOLD 1.2, with `faceOrders`.
const FOLDED_FOLD: &str = "folded.fold";
/// The flat state seen from both sides.
const FOLDED_SVG: &str = "folded.svg";

/// The flat state of the crease pattern of a file.
pub(crate) struct FoldedPattern {
    /// Name and content of each file: none if no order of the layers is proved.
    pub(crate) files: Vec<(&'static str, String)>,
    /// Whether an order exists and is proved, or why not.
    pub(crate) summary: String,
}

impl FoldedPattern {
    /// Whether a flat state may have a file of this name.
    pub(crate) fn may_have(name: &str) -> bool {
        [FOLDED_FOLD, FOLDED_SVG].contains(&name)
    }

    /// Whether this one has a file of this name.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.files.iter().any(|(file, _)| *file == name)
    }

    /// Folds the pattern flat and orders its layers.
    ///
    /// # Errors
    /// [`StudyError::Record`].
    pub(crate) fn of(study: &ImportedStudy, title: &str) -> Result<Self, StudyError> {
        let found = FoundState::find(&study.imported, study.end_angles());
        let facets = study.imported.sheet.facets.len();
        let summary = summary(&found.report, facets);
        let is_proved = found.report.exists == Some(true);
        let mut files = Vec::new();
        if let Some((state, order)) = found.ordered.as_ref().filter(|_| is_proved) {
            let creator = format!("foldmotion {VERSION}");
            files.push((FOLDED_FOLD, state.fold(order, title, &creator, study.unit_name)));
            files.push((FOLDED_SVG, drawing(state, order)?));
        }
        Ok(Self { files, summary })
    }
}

fn summary(report: &LayerOrderReport, facets: usize) -> String {
    let mut text = String::new();
    let _ = match (report.pairs, report.exists) {
        (Some(pairs), Some(true)) => writeln!(
            text,
            "folds flat: {facets} facets, {pairs} overlapping pairs, an order of layers exists (proved)"
        ),
        (Some(pairs), _) => {
            writeln!(text, "folds flat by reflections: {facets} facets, {pairs} overlapping pairs")
        }
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
