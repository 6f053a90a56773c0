//! What is asked before something is lost, and the other windows over the window.

use std::path::PathBuf;

use eframe::egui::{Button, Context, Id, Modal, RichText, Ui, ViewportCommand, Window};
use foldmotion_study::scene::RecordScene;

use super::Viewer;
use super::record_panel::{Seen, Wish};
use crate::document::SaveError;
use crate::settings::{Picked, Picker, show_help};

/// The dialog that is open.
#[derive(Debug, Default)]
pub(super) enum Dialog {
    #[default]
    None,
    /// A file to open.
    Open(Picker),
    /// A place to save the scene, and what follows.
    Save(Picker, Option<Then>),
    /// A folder to record into.
    Folder(Picker),
    /// Unsaved edits, and what is to follow.
    Unsaved(Then),
    /// The file was changed by another program.
    Changed,
    /// Scenes that were left unsaved.
    Restore,
}

/// What follows a question.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Then {
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
                Some(Picked::File(path)) => self.open(path),
                Some(Picked::Cancelled) => {}
                None => self.dialog = Dialog::Open(picker),
            },
            Dialog::Save(mut picker, then) => match picker.show(ctx) {
                Some(Picked::File(path)) => match self.document.save_as(&path) {
                    Ok(()) => {
                        self.saved();
                        if let Some(then) = then {
                            self.go_on(then, ctx);
                        }
                    }
                    Err(error) => self.say(error.to_string(), false),
                },
                Some(Picked::Cancelled) => {}
                None => self.dialog = Dialog::Save(picker, then),
            },
            Dialog::Folder(mut picker) => match picker.show(ctx) {
                Some(Picked::File(path)) => {
                    self.record_panel.folder = Some(path.display().to_string());
                }
                Some(Picked::Cancelled) => {}
                None => self.dialog = Dialog::Folder(picker),
            },
            Dialog::Unsaved(then) => self.ask_unsaved(ctx, then),
            Dialog::Changed => self.ask_changed(ctx),
            Dialog::Restore => self.ask_restore(ctx),
        }
    }

    /// Closing the window with unsaved edits asks first.
    pub(super) fn ask_before_closing(&mut self, ctx: &Context) {
        let is_asked = ctx.input(|i| i.viewport().close_requested());
        if is_asked && !self.is_closing && self.document.is_modified() {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.dialog = Dialog::Unsaved(Then::Quit);
        }
    }

    fn ask_unsaved(&mut self, ctx: &Context, then: Then) {
        let words = format!("{} has unsaved edits", self.document.name());
        let about = "what is discarded is not offered again";
        let answers: &[&str] = if then == Then::Quit {
            &["Save", "Discard edits", "Keep for the next start", "Cancel"]
        } else {
            &["Save", "Discard edits", "Cancel"]
        };
        let chosen = ask(ctx, "unsaved", &words, about, answers);
        match chosen.map(|index| answers[index]) {
            Some("Save") => match self.document.save() {
                Ok(()) => {
                    self.saved();
                    self.go_on(then, ctx);
                }
                Err(SaveError::Changed { .. }) => self.dialog = Dialog::Changed,
                Err(_) => {
                    self.choose_place();
                    if let Dialog::Save(_, next) = &mut self.dialog {
                        *next = Some(then);
                    }
                }
            },
            Some("Discard edits") => {
                self.document.give_up();
                if let Some(unsaved) = &mut self.unsaved {
                    unsaved.forget();
                }
                self.go_on(then, ctx);
            }
            Some("Keep for the next start") => self.go_on(then, ctx),
            Some(_) => {}
            None => self.dialog = Dialog::Unsaved(then),
        }
    }

    fn ask_changed(&mut self, ctx: &Context) {
        let words = format!("{} was changed by another program", self.document.name());
        let about = "reading it again can be undone; overwriting it cannot";
        match ask(
            ctx,
            "changed",
            &words,
            about,
            &["Read it again", "Overwrite it", "Cancel"],
        ) {
            Some(0) => {
                if let Err(error) = self.document.reload() {
                    self.say(error.to_string(), false);
                }
            }
            Some(1) => match self.document.save_over() {
                Ok(()) => self.saved(),
                Err(error) => self.say(error.to_string(), false),
            },
            Some(_) => {}
            None => self.dialog = Dialog::Changed,
        }
    }

    /// Offers what was left unsaved.
    fn ask_restore(&mut self, ctx: &Context) {
        let Some(unsaved) = &mut self.unsaved else {
            return;
        };
        let left: Vec<String> = unsaved
            .left()
            .map(crate::settings::UnsavedScene::describe)
            .collect();
        if left.is_empty() {
            return;
        }
        let mut chosen = None;
        let mut is_over = false;
        Modal::new(Id::unique("restore")).show(ctx, |ui| {
            ui.set_max_width(460.0);
            ui.heading("Unsaved edits");
            ui.label("the window was closed, or ended, with edits that were not saved");
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
                Err(error) => self.say(error.to_string(), false),
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
        let act = self.act();
        let is_ready = act.as_ref().is_some_and(|act| act.can_be_recorded());
        let record: RecordScene = self.document.scene().record.clone();
        let seen = Seen {
            orbit: self.view3d.orbit(),
            time: self.playback.time,
            colour: self.settings.view.colour,
            is_file: self.shown.file.is_some(),
        };
        let mut is_open = true;
        let mut wish = None;
        Window::new("Record")
            .open(&mut is_open)
            .default_pos(ctx.content_rect().center() - eframe::egui::vec2(200.0, 220.0))
            .resizable(false)
            .show(ctx, |ui: &mut Ui| {
                if let Some((_, job)) = &self.jobs.recording {
                    ui.label("recording…");
                    ui.add(
                        eframe::egui::ProgressBar::new(job.stand().done as f32).show_percentage(),
                    );
                    if ui.button("Stop").clicked() {
                        job.stop();
                    }
                } else if !is_ready {
                    ui.label("a preview is not recorded: run the scene first");
                    if ui
                        .add_enabled(
                            self.resolved.study.is_some() && self.jobs.run.is_none(),
                            Button::new("Run the scene"),
                        )
                        .clicked()
                    {
                        self.run();
                    }
                } else {
                    wish = self.record_panel.show(ui, &record, &seen);
                }
            });
        self.settings.panels.record = is_open;
        match wish {
            Some(Wish::Record(record, folder)) => self.record(&record, folder),
            Some(Wish::Choose) => {
                let recent = self.settings.recent.folders();
                let folder = std::env::current_dir().unwrap_or_default();
                self.dialog = Dialog::Folder(Picker::save(
                    "Folder of the recording",
                    &[],
                    &folder,
                    "recording",
                    &recent,
                ));
            }
            Some(Wish::Close) => self.settings.panels.record = false,
            None => {}
        }
    }

    /// Records what is shown, with the camera as it stands.
    fn record(&mut self, record: &RecordScene, folder: PathBuf) {
        let Some(act) = self.act() else { return };
        if let Some(job) = act.record(record, folder.clone(), self.wake.clone()) {
            self.jobs.recording = Some((folder, job));
        }
    }

    /// Asks before the window closes with unsaved edits; they are kept for the next start either way.
    pub(super) fn title(&mut self, ctx: &Context) {
        let mark = if self.document.is_modified() {
            "• "
        } else {
            ""
        };
        let name = match &self.shown.file {
            Some(act) => act
                .opened()
                .map(|motion| motion.title().to_owned())
                .unwrap_or_default(),
            None => self.document.name(),
        };
        let title = format!("{mark}{name} — foldmotion");
        // The system may hand another text back.
        if self.shown.title != title {
            ctx.send_viewport_cmd(ViewportCommand::Title(title.clone()));
            self.shown.title = title;
        }
    }
}

/// A question with its answers; the index of the one that was chosen, the last for Escape.
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
