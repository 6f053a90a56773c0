//! The menus and the status bar.

use std::path::PathBuf;
use std::time::Duration;

use eframe::egui::{Button, Color32, MenuBar, ProgressBar, RichText, Ui};

use super::Viewer;
use super::dialogs::NextAction;
use crate::settings::{Appearance, Command, Group, apply, commands_of, keys_of, name_of};

/// How long a notice is shown.
const NOTICE: Duration = Duration::from_secs(12);

/// The menus with their groups of commands, after the menu of files.
const MENUS: [(&str, &[Group]); 4] = [
    ("Edit", &[Group::Edit]),
    ("Motion", &[Group::Motion, Group::Time]),
    ("View", &[Group::View, Group::Colours]),
    ("Window", &[Group::Window]),
];

impl Viewer {
    pub(super) fn menu(&mut self, ui: &mut Ui) {
        let mut wanted = None;
        MenuBar::new().ui(ui, |ui| {
            ui.menu_button("File", |ui| self.file_menu(ui, &mut wanted));
            for (name, groups) in MENUS {
                ui.menu_button(name, |ui| {
                    if name == "Window" {
                        self.appearance_menu(ui);
                    }
                    for (index, &group) in groups.iter().enumerate() {
                        if index > 0 {
                            ui.separator();
                        }
                        for command in commands_of(group) {
                            self.item(ui, command, &mut wanted);
                        }
                    }
                });
            }
            ui.separator();
            self.run_button(ui, &mut wanted);
        });
        if let Some(command) = wanted {
            let ctx = ui.ctx().clone();
            self.perform(command, &ctx);
        }
    }

    fn file_menu(&mut self, ui: &mut Ui, wanted: &mut Option<Command>) {
        self.item(ui, Command::New, wanted);
        self.item(ui, Command::Open, wanted);
        let mut chosen: Option<PathBuf> = None;
        ui.menu_button("Open recent", |ui| {
            let recent = self.settings.recent.existing_first();
            if recent.is_empty() {
                ui.weak("No files yet");
            }
            for (path, is_there) in recent {
                let button = Button::new(path.display().to_string());
                if ui.add_enabled(is_there, button).clicked() {
                    chosen = Some(path);
                }
            }
        });
        ui.separator();
        self.item(ui, Command::Save, wanted);
        self.item(ui, Command::SaveAs, wanted);
        ui.separator();
        self.item(ui, Command::Quit, wanted);
        if let Some(path) = chosen {
            let ctx = ui.ctx().clone();
            self.confirm_unsaved(NextAction::Open(path), &ctx);
        }
    }

    fn appearance_menu(&mut self, ui: &mut Ui) {
        ui.menu_button("Appearance", |ui| {
            for appearance in Appearance::ALL {
                if ui.radio(self.settings.appearance == appearance, appearance.name()).clicked() {
                    self.settings.appearance = appearance;
                    apply(ui.ctx(), appearance, self.settings.scale.factor());
                }
            }
        });
        ui.separator();
    }

    fn item(&self, ui: &mut Ui, command: Command, wanted: &mut Option<Command>) {
        let keys = keys_of(ui.ctx(), command);
        let (name, is_on) = match command {
            Command::Undo => (
                self.document.can_undo().map(|label| format!("Undo: {label}")),
                self.document.can_undo().is_some(),
            ),
            Command::Redo => (
                self.document.can_redo().map(|label| format!("Redo: {label}")),
                self.document.can_redo().is_some(),
            ),
            Command::Run => (None, self.resolved.study.is_some() && self.jobs.run.is_none()),
            Command::Cancel => (None, self.is_busy()),
            _ => (None, true),
        };
        let name = name.unwrap_or_else(|| name_of(command).to_owned());
        let button = Button::new(name).shortcut_text(keys);
        if ui.add_enabled(is_on, button).clicked() {
            *wanted = Some(command);
            ui.close();
        }
    }

    fn run_button(&mut self, ui: &mut Ui, wanted: &mut Option<Command>) {
        if let Some((_, run)) = &self.jobs.run {
            let progress = run.progress();
            let phase = progress.phase.map_or("start", |phase| phase.name());
            let bar = ProgressBar::new(progress.done as f32).desired_width(150.0);
            ui.add(bar.text(format!("{phase} {:.0} %", 100.0 * progress.done)));
            if ui.button("Cancel").on_hover_text("Esc").clicked() {
                *wanted = Some(Command::Cancel);
            }
            let mut follows = self.display.follows_run;
            let hint = "Show the sheet while it is computed";
            let follow = ui.checkbox(&mut follows, "follow").on_hover_text(hint);
            if follow.changed() {
                self.display.follows_run = follows;
            }
        } else {
            let is_on = self.resolved.study.is_some() && self.display.file.is_none();
            let button = Button::new(RichText::new("Run").strong());
            let keys = keys_of(ui.ctx(), Command::Run);
            let hint = format!("Fold, check and report ({keys})");
            if ui.add_enabled(is_on, button).on_hover_text(hint).clicked() {
                *wanted = Some(Command::Run);
            }
            ui.checkbox(&mut self.settings.view.folds_at_once, "preview").on_hover_text(
                "Fold the sheet after every edit, without contact and without a check",
            );
        }
    }

    /// The status bar: a notice, an error of the scene, or facts about the sheet.
    pub(super) fn status(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            let is_old = self.notice.as_ref().is_some_and(|(_, _, since)| since.elapsed() > NOTICE);
            if is_old {
                self.notice = None;
            }
            if let Some((words, is_good, _)) = &self.notice {
                let colour =
                    if *is_good { ui.visuals().text_color() } else { ui.visuals().error_fg_color };
                ui.colored_label(colour, words);
                ui.ctx().request_repaint_after(NOTICE);
                return;
            }
            if let Some(error) = self.resolved.errors.first() {
                ui.colored_label(ui.visuals().error_fg_color, &error.message);
                return;
            }
            self.facts(ui);
        });
    }

    fn facts(&self, ui: &mut Ui) {
        let Some(shown) = self.shown_motion() else {
            return;
        };
        let sheet = &shown.motion().sheet;
        let words = format!(
            "{} vertices, {} facets, {} frames",
            sheet.vertices.len(),
            sheet.facets.len(),
            shown.motion().frames.len()
        );
        ui.weak(words);
        if self.resolved.resolver.is_busy() {
            ui.weak("Resolving…");
        } else if self.jobs.preview.is_some() {
            ui.weak("Folding a preview…");
        } else if self.jobs.opening.is_some() {
            ui.weak("Opening…");
        } else if self.jobs.checking.is_some() {
            ui.weak("Checking…");
        }
        if let Some(error) = self.view3d.error() {
            ui.colored_label(Color32::from_rgb(200, 120, 0), error);
        }
    }
}
