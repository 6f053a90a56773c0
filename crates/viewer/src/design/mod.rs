//! The design panel: profile, sheet, material, motion; the crease pattern; closed forms.
//!
//! The panel edits a copy of the scene and hands it back as a [`Change`]; it holds no scene of its own. What it draws of
//! the sheet comes from the last [`Draft`] that could be made, which may be older than the scene.

mod camera;
mod canvas;
mod choice;
mod closed_forms;
mod creases;
mod curve;
mod form;
mod handle_editor;
mod imported;
mod knots;
mod material;
mod motion;
mod number;
mod pattern_preview;
mod plane;
mod profile;
mod record;
mod scene_schema;
mod sheet;
mod step;
#[cfg(test)]
mod tests;
mod unit_size;

use std::collections::BTreeSet;

use eframe::egui;
use foldmotion_study::{Draft, Scene};

use form::Form;

/// What the panel shows.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DesignInput<'a> {
    /// The scene as it is.
    pub(crate) scene: &'a Scene,
    /// The last draft that could be made, if any.
    pub(crate) draft: Option<&'a Draft>,
    /// Another number for each draft: what is drawn of it is kept until the number changes.
    pub(crate) draft_number: u64,
    /// What is wrong with the scene.
    pub(crate) errors: &'a [SceneError],
}

/// Something wrong with the scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct SceneError {
    /// The dotted key at error, where one is.
    pub(crate) key: Option<String>,
    /// What is wrong, and what would be right.
    pub(crate) message: String,
}

impl SceneError {
    /// The error that `error` says, at `key` where it is one's.
    pub(crate) fn new(key: Option<&str>, error: &impl ToString) -> Self {
        Self {
            key: key.map(str::to_owned),
            message: error.to_string(),
        }
    }
}

/// An edit of the scene.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Change {
    /// The scene after it.
    pub(crate) scene: Scene,
    /// What was done, as "undo" names it.
    pub(crate) label: &'static str,
    /// Whether it goes on with the change before: a drag, or a key held down.
    pub(crate) continues: bool,
}

/// What the panel remembers from frame to frame; nothing of the scene.
#[derive(Debug, Default)]
pub(crate) struct DesignPanel {
    gesture: Option<egui::Id>,
    claims: BTreeSet<String>,
    profile: profile::ProfileSection,
    sheet: sheet::SheetSection,
    preview: pattern_preview::PatternPreview,
    measurements: closed_forms::Measurements,
}

impl DesignPanel {
    /// Shows the panel. The change is what the user did in this frame, if anything; the caller applies it.
    pub(crate) fn show(&mut self, ui: &mut egui::Ui, facts: &DesignInput<'_>) -> Option<Change> {
        if !ui.input(|input| input.pointer.any_down())
            && ui.input(|input| input.keys_down.is_empty())
        {
            self.gesture = None;
        }
        let mut form = Form::new(ui, facts, self.gesture, std::mem::take(&mut self.claims));
        ui.spacing_mut().item_spacing.y = 4.0;
        form.general_errors(ui);
        if facts.scene.pattern.is_some() {
            imported::show(&mut self.measurements, &mut form, ui);
        } else {
            self.profile.show(&mut form, ui);
            self.sheet.show(&mut form, ui);
            self.measurements.show(&mut form, ui);
        }
        self.preview.show(&mut form, ui);
        material::show(&mut form, ui);
        motion::show(&mut form, ui);
        record::show(&mut form, ui);
        let (change, gesture, claims) = form.finish(ui);
        (self.gesture, self.claims) = (gesture, claims);
        change
    }
}
