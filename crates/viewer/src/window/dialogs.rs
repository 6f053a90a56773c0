//! The dialogs: file pickers, questions before something is lost, the record dialog.

use std::path::PathBuf;

use eframe::egui::{
    Button, Context, Id, Modal, ProgressBar, RichText, Ui, ViewportCommand, Window,
};
use foldmotion_study::scene::RecordScene;

use super::Viewer;
use super::record_panel::{CurrentView, RecordRequest};
use crate::document::SaveError;
use crate::settings::{FilePicker, PickerResult, show_help};

#[derive(Debug, Default)]
pub(super) enum Dialog {
    #[default]
    None,
    /// Chooses a file to open.
    Open(FilePicker),
    /// Chooses a file to save the scene in, and what to do after that.
    Save(FilePicker, Option<NextAction>),
    /// Chooses a folder for recordings.
    Folder(FilePicker),
    /// Asks about unsaved edits before the next action.
    Unsaved(NextAction),
    /// Asks what to do about a file that another program has changed.
    Changed,
    /// Offers unsaved scenes for recovery.
    Restore,
}

/// What to do after a question.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum NextAction {
    New,
    ChooseFile,
    Open(PathBuf),
    Quit,
}

impl Viewer {
    pub(super) fn dialogs(&mut self, ctx: &Context) {
        show_help(ctx, &mut self.shows_help);
        self.record_window(ctx);
        match std::mem::take(&mut self.dialog) {
            Dialog::None => {}
            Dialog::Open(mut picker) => match picker.show(ctx) {
                Some(PickerResult::File(path)) => self.open(path),
                Some(PickerResult::Cancelled) => {}
                None => self.dialog = Dialog::Open(picker),
            },
            Dialog::Save(mut picker, then) => match picker.show(ctx) {
                Some(PickerResult::File(path)) => match self.document.save_as(&path) {
                    Ok(()) => {
                        self.saved();
                        if let Some(then) = then {
                            self.continue_with(then, ctx);
                        }
                    }
                    Err(error) => self.notify(error.to_string(), false),
                },
                Some(PickerResult::Cancelled) => {}
                None => self.dialog = Dialog::Save(picker, then),
            },
            Dialog::Folder(mut picker) => match picker.show(ctx) {
                Some(PickerResult::File(path)) => {
                    self.record_panel.folder = Some(path.display().to_string());
                }
                Some(PickerResult::Cancelled) => {}
                None => self.dialog = Dialog::Folder(picker),
            },
            Dialog::Unsaved(then) => self.ask_unsaved(ctx, then),
            Dialog::Changed => self.ask_changed(ctx),
            Dialog::Restore => self.ask_restore(ctx),
        }
    }

    /// Asks about unsaved edits before the window is closed.
    pub(super) fn ask_before_closing(&mut self, ctx: &Context) {
        let is_asked = ctx.input(|i| i.viewport().close_requested());
        if is_asked && !self.is_closing && self.document.is_modified() {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.dialog = Dialog::Unsaved(NextAction::Quit);
        }
    }

    fn ask_unsaved(&mut self, ctx: &Context, then: NextAction) {
        let words = format!("{} has unsaved edits", self.document.name());
        let about = "Discarded edits cannot be recovered.";
        let answers: &[&str] = if then == NextAction::Quit {
            &["Save", "Discard edits", "Keep for the next start", "Cancel"]
        } else {
            &["Save", "Discard edits", "Cancel"]
        };
        let chosen = ask(ctx, "unsaved", &words, about, answers);
        match chosen.map(|index| answers[index]) {
            Some("Save") => match self.document.save() {
                Ok(()) => {
                    self.saved();
                    self.continue_with(then, ctx);
                }
                Err(SaveError::Changed { .. }) => self.dialog = Dialog::Changed,
                Err(_) => {
                    self.choose_save_path();
                    if let Dialog::Save(_, next) = &mut self.dialog {
                        *next = Some(then);
                    }
                }
            },
            Some("Discard edits") => {
                self.document.revert();
                if let Some(unsaved) = &mut self.unsaved {
                    unsaved.clear();
                }
                self.continue_with(then, ctx);
            }
            Some("Keep for the next start") => self.continue_with(then, ctx),
            Some(_) => {}
            None => self.dialog = Dialog::Unsaved(then),
        }
    }

    fn ask_changed(&mut self, ctx: &Context) {
        let words = format!("{} was changed by another program", self.document.name());
        let about = "Reloading the file can be undone; overwriting it cannot.";
        match ask(ctx, "changed", &words, about, &["Reload", "Overwrite", "Cancel"]) {
            Some(0) => {
                if let Err(error) = self.document.reload() {
                    self.notify(error.to_string(), false);
                }
            }
            Some(1) => match self.document.save_over() {
                Ok(()) => self.saved(),
                Err(error) => self.notify(error.to_string(), false),
            },
            Some(_) => {}
            None => self.dialog = Dialog::Changed,
        }
    }

    /// Offers unsaved scenes for recovery.
    fn ask_restore(&mut self, ctx: &Context) {
        let Some(unsaved) = &mut self.unsaved else {
            return;
        };
        let left: Vec<String> =
            unsaved.recovered().map(crate::settings::UnsavedScene::describe).collect();
        if left.is_empty() {
            return;
        }
        let mut chosen = None;
        let mut is_over = false;
        Modal::new(Id::unique("restore")).show(ctx, |ui| {
            ui.set_max_width(460.0);
            ui.heading("Unsaved edits");
            ui.label("The window was closed or crashed before these edits were saved.");
            ui.separator();
            for (index, words) in left.iter().enumerate() {
                ui.horizontal(|ui| {
                    if ui.button("Restore").clicked() {
                        chosen = Some((index, true));
                    }
                    if ui.button("Discard").clicked() {
                        chosen = Some((index, false));
                    }
                    ui.label(words);
                });
            }
            ui.separator();
            is_over = ui.button("Later").clicked();
        });
        match chosen {
            Some((index, true)) => match unsaved.restore(index) {
                Ok(Some(document)) => {
                    self.take_document(document);
                    return;
                }
                Ok(None) => {}
                Err(error) => self.notify(error.to_string(), false),
            },
            Some((index, false)) => unsaved.discard(index),
            None => {}
        }
        if !is_over {
            self.dialog = Dialog::Restore;
        }
    }

    fn record_window(&mut self, ctx: &Context) {
        if !self.settings.panels.record {
            return;
        }
        let stem = self.document.source().stem();
        let beside = || PathBuf::from("out").join(stem).display().to_string();
        self.record_panel.folder.get_or_insert_with(beside);
        let shown = self.shown_motion();
        let is_ready = shown.as_ref().is_some_and(|shown| shown.can_be_recorded());
        let record: RecordScene = self.document.scene().record.clone();
        let current = CurrentView {
            orbit: self.view3d.orbit(),
            time: self.playback.time,
            colour: self.settings.view.colour,
            is_file: self.display.file.is_some(),
        };
        let mut is_open = true;
        let mut request = None;
        Window::new("Record")
            .open(&mut is_open)
            .default_pos(ctx.content_rect().center() - eframe::egui::vec2(200.0, 220.0))
            .resizable(false)
            .show(ctx, |ui: &mut Ui| {
                if let Some((_, job)) = &self.jobs.recording {
                    ui.label("Recording…");
                    let bar = ProgressBar::new(job.progress().done as f32);
                    ui.add(bar.show_percentage());
                    if ui.button("Stop").clicked() {
                        job.stop();
                    }
                } else if !is_ready {
                    ui.label("A preview cannot be recorded. Run the scene first.");
                    let can_run = self.resolved.study.is_some() && self.jobs.run.is_none();
                    let button = Button::new("Run the scene");
                    if ui.add_enabled(can_run, button).clicked() {
                        self.run();
                    }
                } else {
                    request = self.record_panel.show(ui, &record, &current);
                }
            });
        self.settings.panels.record = is_open;
        match request {
            Some(RecordRequest::Record(record, folder)) => self.record(&record, folder),
            Some(RecordRequest::ChooseFolder) => {
                let recent = self.settings.recent.folders();
                let folder = std::env::current_dir().unwrap_or_default();
                self.dialog = Dialog::Folder(FilePicker::save(
                    "Folder for the recording",
                    &[],
                    &folder,
                    "recording",
                    &recent,
                ));
            }
            Some(RecordRequest::Close) => self.settings.panels.record = false,
            None => {}
        }
    }

    /// Records the motion with the current camera.
    fn record(&mut self, record: &RecordScene, folder: PathBuf) {
        let Some(shown) = self.shown_motion() else {
            return;
        };
        if let Some(job) = shown.record(record, folder.clone(), self.repaint.clone()) {
            self.jobs.recording = Some((folder, job));
        }
    }

    /// Updates the title of the window.
    pub(super) fn title(&mut self, ctx: &Context) {
        let mark = if self.document.is_modified() { "• " } else { "" };
        let name = match &self.display.file {
            Some(shown) => {
                shown.opened().map(|motion| motion.title().to_owned()).unwrap_or_default()
            }
            None => self.document.name(),
        };
        let title = format!("{mark}{name} — foldmotion");
        // The system may report another title, so the last one set is remembered.
        if self.display.title != title {
            ctx.send_viewport_cmd(ViewportCommand::Title(title.clone()));
            self.display.title = title;
        }
    }
}

/// Asks a question; returns the index of the chosen answer, the last one if the user presses Escape.
fn ask(ctx: &Context, id: &str, words: &str, about: &str, answers: &[&str]) -> Option<usize> {
    let mut chosen = None;
    let modal = Modal::new(Id::unique(id)).show(ctx, |ui| {
        ui.set_max_width(420.0);
        ui.label(RichText::new(words).strong().size(15.0));
        ui.label(about);
        ui.add_space(8.0);
        ui.horizontal(|ui| {
            for (index, answer) in answers.iter().enumerate() {
                if ui.button(*answer).clicked() {
                    chosen = Some(index);
                }
            }
        });
    });
    if modal.should_close() && chosen.is_none() {
        chosen = Some(answers.len().saturating_sub(1));
    }
    chosen
}
