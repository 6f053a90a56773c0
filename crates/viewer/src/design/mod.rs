//! The design panel: profile, sheet, closed forms, crease pattern, material, motion and recording.
//!
//! The panel edits a copy of the scene and returns it as a [`Change`]; it keeps no scene of its own. Drawings of the
//! sheet use the last valid [`Draft`], which may be older than the scene.

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
    pub(crate) scene: &'a Scene,
    pub(crate) draft: Option<&'a Draft>,
    /// A number that differs between drafts; cached drawings are kept until it changes.
    pub(crate) draft_number: u64,
    pub(crate) errors: &'a [SceneError],
}

/// An error in the scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct SceneError {
    /// The dotted key that is wrong, if the error belongs to one.
    pub(crate) key: Option<String>,
    /// What is wrong, and what would be valid.
    pub(crate) message: String,
}

impl SceneError {
    /// The message of `error`, which belongs to `key`.
    pub(crate) fn new(key: Option<&str>, error: &impl ToString) -> Self {
        Self { key: key.map(str::to_owned), message: error.to_string() }
    }
}

/// An edit of the scene.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Change {
    pub(crate) scene: Scene,
    /// The name of the edit in the undo menu.
    pub(crate) label: &'static str,
    /// Whether it continues the previous edit, as during a drag or while a key is held down.
    pub(crate) continues: bool,
}

/// State of the panel that lasts from frame to frame; it holds no part of the scene.
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
    /// Shows the panel and returns the user's edit in this frame, if any, for the caller to apply.
    pub(crate) fn show(&mut self, ui: &mut egui::Ui, input: &DesignInput<'_>) -> Option<Change> {
        if !ui.input(|input| input.pointer.any_down())
            && ui.input(|input| input.keys_down.is_empty())
        {
            self.gesture = None;
        }
        let mut form = Form::new(ui, input, self.gesture, std::mem::take(&mut self.claims));
        ui.spacing_mut().item_spacing.y = 4.0;
        form.general_errors(ui);
        if input.scene.pattern.is_some() {
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
