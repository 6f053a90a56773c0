//! The effect of each command.

use std::path::{Path, PathBuf};

use eframe::egui::{Context, ViewportCommand};
use foldmotion_record::View;
use foldmotion_study::UnitDraft;
use foldmotion_study::scene::ProfileScene;

use super::dialogs::{Dialog, NextAction};
use super::{Viewer, motion_keys};
use crate::document::{Document, SaveError};
use crate::settings::{Appearance, Colour, Command, FilePicker, apply};
use crate::timeline::Repeat;
use crate::work::{Interaction, open, run};

/// Extensions of files that can be opened.
const OPENED: [&str; 10] = ["toml", "fold", "svg", "cp", "opx", "orh", "obj", "dxf", "json", "txt"];

/// Extensions of outline files for profiles.
const OUTLINES: [&str; 3] = ["csv", "dat", "dxf"];

impl Viewer {
    pub(super) fn perform(&mut self, command: Command, ctx: &Context) {
        match command {
            Command::New => self.confirm_unsaved(NextAction::New, ctx),
            Command::Open => self.confirm_unsaved(NextAction::ChooseFile, ctx),
            Command::Save => self.save_document(),
            Command::SaveAs => self.choose_save_path(),
            Command::Quit => ctx.send_viewport_cmd(ViewportCommand::Close),
            Command::Undo => {
                if let Some(label) = self.document.undo() {
                    self.notify(format!("Undone: {label}"), true);
                }
            }
            Command::Redo => {
                if let Some(label) = self.document.redo() {
                    self.notify(format!("Redone: {label}"), true);
                }
            }
            Command::Run => self.run(),
            Command::Cancel => self.cancel(),
            Command::Interact => self.toggle_interaction(),
            Command::Record => self.settings.panels.record = true,
            Command::DarkLight | Command::Presentation => self.change_appearance(command, ctx),
            Command::Help => self.shows_help = true,
            Command::PanelText if self.must_fix_text => self.must_fix_text = false,
            _ if self.move_time(command) || self.look(command) => {}
            _ => self.switch(command),
        }
    }

    /// Executes a command that changes the motion time; returns whether this is one.
    fn move_time(&mut self, command: Command) -> bool {
        let shown = self.shown_motion();
        let frames = shown.as_ref().map_or(&[][..], |shown| &shown.marks.frames);
        match command {
            Command::Play => self.playback.toggle(),
            Command::PreviousFrame => self.playback.step(frames, false),
            Command::NextFrame => self.playback.step(frames, true),
            Command::Start => self.playback.go_to(self.playback.range[0]),
            Command::Planar => self.playback.go_to(1.0),
            Command::Compact => self.playback.go_to(2.0),
            Command::Slower => self.playback.change_speed(false),
            Command::Faster => self.playback.change_speed(true),
            Command::Loop => {
                self.playback.repeat = match self.playback.repeat {
                    Repeat::Once => Repeat::Loop,
                    Repeat::Loop => Repeat::BackAndForth,
                    Repeat::BackAndForth => Repeat::Once,
                };
            }
            _ => return false,
        }
        self.display.follows_run &=
            matches!(command, Command::Slower | Command::Faster | Command::Loop);
        true
    }

    /// Executes a command that moves the camera; returns whether this is one.
    fn look(&mut self, command: Command) -> bool {
        match command {
            Command::ViewFront => self.view3d.look(View::Front),
            Command::ViewSide => self.view3d.look(View::Side),
            Command::ViewTop => self.view3d.look(View::Top),
            Command::ViewIsometric => self.view3d.look(View::Iso),
            Command::Fit => {
                let mut shown = self.display.state.positions.to_vec();
                shown.extend(self.shown_boxes());
                self.view3d.fit(shown);
            }
            _ => return false,
        }
        true
    }

    /// The corners of the boxes that are shown.
    fn shown_boxes(&self) -> Vec<glam::DVec3> {
        let view = &self.settings.view;
        let wanted = [view.compact_box, view.closed_form_box];
        let boxes = self.shown_motion().map_or([None; 2], |shown| shown.boxes);
        let is_shown = self.playback.time > 1.0;
        let boxes = boxes.into_iter().zip(wanted);
        let shown = boxes.filter_map(|(bounds, wanted)| bounds.filter(|_| wanted && is_shown));
        shown.flat_map(corners).collect()
    }

    fn switch(&mut self, command: Command) {
        let (view, panels) = (&mut self.settings.view, &mut self.settings.panels);
        if command == Command::PanelDesign && panels.text {
            // The design panel takes the place of the text.
            (panels.text, panels.design) = (false, true);
            return;
        }
        let switch = match command {
            Command::Perspective => &mut view.perspective,
            Command::Creases => &mut view.creases,
            Command::Profile => &mut view.profile,
            Command::CompactBox => &mut view.compact_box,
            Command::ClosedFormBox => &mut view.closed_form_box,
            Command::PanelDesign => &mut panels.design,
            Command::PanelPlots => &mut panels.plots,
            Command::PanelVerdict => &mut panels.verdict,
            Command::PanelRecord => &mut panels.record,
            Command::PanelText => &mut panels.text,
            other => {
                view.colour = match other {
                    Command::ColourStrain => Colour::Strain,
                    Command::ColourBending => Colour::Bending,
                    Command::ColourUnit => Colour::Unit,
                    Command::ColourLayer => Colour::Layer,
                    _ => Colour::Plain,
                };
                return;
            }
        };
        *switch = !*switch;
        self.view3d.set_perspective(self.settings.view.perspective);
    }

    fn change_appearance(&mut self, command: Command, ctx: &Context) {
        if command == Command::DarkLight {
            self.settings.appearance = Appearance::other(ctx);
        } else {
            self.settings.scale = self.settings.scale.next();
        }
        apply(ctx, self.settings.appearance, self.settings.scale.factor());
    }

    pub(super) fn run(&mut self) {
        if self.display.file.is_some() {
            self.notify("A motion file cannot be run. Open its scene instead.", false);
            return;
        }
        if self.jobs.run.is_some() {
            self.notify("A run is in progress. Cancel it first (Esc).", false);
            return;
        }
        let Some(study) = self.resolved.study.clone() else {
            let words = self.resolved.errors.first().map_or_else(
                || "The scene is still being resolved.".to_owned(),
                |error| error.message.clone(),
            );
            self.notify(words, false);
            return;
        };
        self.jobs.preview = None;
        self.jobs.interaction = None;
        self.jobs.best_rate = 0;
        let scene = motion_keys(self.document.scene());
        let (states, job) = run(&study, self.repaint.clone());
        self.jobs.run = Some(((scene, states), job));
        self.display.follows_run = true;
        self.playback.is_playing = false;
    }

    fn cancel(&mut self) {
        if let Some((_, run)) = &self.jobs.run {
            run.stop();
        } else if let Some((_, job)) = &self.jobs.recording {
            job.stop();
        } else if self.jobs.interaction.is_some() {
            self.jobs.interaction = None;
        } else if let Some((_, job)) = &self.jobs.opening {
            job.stop();
        }
    }

    /// Lets the user move the sheet by hand from its current state, or ends that.
    fn toggle_interaction(&mut self) {
        if self.jobs.interaction.take().is_some() {
            self.timings.rate("moving by hand", self.jobs.best_rate as f64);
            self.display.pulled = None;
            return;
        }
        let (Some(study), Some(shown)) = (self.resolved.study.clone(), self.shown_motion()) else {
            self.notify("The sheet can be moved by hand once the scene is resolved.", false);
            return;
        };
        if self.display.file.is_some() || self.is_stale(&shown) {
            self.notify("Only the sheet of the current scene can be moved by hand.", false);
            return;
        }
        self.jobs.best_rate = 0;
        self.playback.is_playing = false;
        let from = (self.playback.time, shown.state(self.playback.time));
        let start = (!shown.is_exact()).then_some(from);
        if start.is_none() {
            self.playback.go_to(self.playback.range[0]);
        }
        self.jobs.interaction = Some(Interaction::start(study, start, self.repaint.clone()));
    }

    /// Opens a file in the background.
    pub(super) fn open(&mut self, path: PathBuf) {
        let job = open(path.clone(), self.repaint.clone());
        self.jobs.opening = Some((path, job));
    }

    pub(super) fn choose_file(&mut self) {
        let recent = self.settings.recent.folders();
        let folder = self.folder();
        self.dialog = Dialog::Open(FilePicker::open("Open", &OPENED, &folder, &recent));
    }

    pub(super) fn choose_save_path(&mut self) {
        let name = self.document.name_to_save();
        let recent = self.settings.recent.folders();
        let folder = self.folder();
        self.dialog =
            Dialog::Save(FilePicker::save("Save as", &["toml"], &folder, &name, &recent), None);
    }

    /// The folder of the scene, or the current folder if it has none.
    fn folder(&self) -> PathBuf {
        let beside = self.document.location().parent().map(Path::to_owned);
        let folder = beside.filter(|folder| folder.is_dir());
        folder.or_else(|| std::env::current_dir().ok()).unwrap_or_default()
    }

    fn save_document(&mut self) {
        match self.document.save() {
            Ok(()) => self.saved(),
            Err(SaveError::NoFile) => self.choose_save_path(),
            Err(SaveError::Changed { .. }) => self.dialog = Dialog::Changed,
            Err(error) => self.notify(error.to_string(), false),
        }
    }

    pub(super) fn saved(&mut self) {
        if let Some(path) = self.document.path().map(Path::to_owned) {
            self.settings.recent.add(&path);
            self.notify(format!("Saved {}", path.display()), true);
        }
        self.keep_unsaved();
    }

    /// Performs `then`, after asking about unsaved edits.
    pub(super) fn confirm_unsaved(&mut self, then: NextAction, ctx: &Context) {
        if self.document.is_modified() && self.display.file.is_none() {
            self.dialog = Dialog::Unsaved(then);
        } else {
            self.continue_with(then, ctx);
        }
    }

    pub(super) fn continue_with(&mut self, then: NextAction, ctx: &Context) {
        match then {
            NextAction::New => self.take_document(Document::new()),
            NextAction::ChooseFile => self.choose_file(),
            NextAction::Open(path) => self.open(path),
            NextAction::Quit => {
                self.is_closing = true;
                ctx.send_viewport_cmd(ViewportCommand::Close);
            }
        }
    }

    /// Keeps unsaved edits for the next start; deletes them once they are saved.
    pub(super) fn keep_unsaved(&mut self) {
        if let Some(unsaved) = &mut self.unsaved
            && let Err(error) = unsaved.keep(&self.document)
        {
            let words = format!("Unsaved edits could not be kept: {error}. Save the scene.");
            self.notify(words, false);
        }
    }

    /// Opens the first file that was dropped on the window; an outline becomes the profile of the scene.
    pub(super) fn take_dropped_files(&mut self, ctx: &Context) {
        let dropped = ctx.input(|i| i.raw.dropped_files.clone());
        let Some(path) = dropped.first().map(|file| file.path().to_owned()) else {
            return;
        };
        let ending = path.extension().unwrap_or_default().to_ascii_lowercase();
        if OUTLINES.iter().any(|outline| ending == *outline) && self.display.file.is_none() {
            self.take_outline(&path);
        } else {
            self.confirm_unsaved(NextAction::Open(path), ctx);
        }
    }

    /// Makes an outline file the profile. Rows, columns and width keep their values, even if they came from a built-in
    /// profile.
    fn take_outline(&mut self, path: &Path) {
        let mut scene = self.document.scene().clone();
        scene.profile = ProfileScene {
            file: Some(self.document.name_of(path)),
            unit: scene.profile.unit,
            length: scene.profile.length,
            ..ProfileScene::default()
        };
        let draft = self.resolved.draft.as_ref();
        if let Some(UnitDraft { units, .. }) = draft.and_then(|(.., draft)| draft.units()) {
            let sheet = &mut scene.sheet;
            sheet.rows = sheet.rows.or(i64::try_from(units.rows).ok());
            sheet.columns = sheet.columns.or(i64::try_from(units.columns).ok());
            sheet.width = sheet.width.or(Some(units.unit.width * units.columns as f64));
        }
        if !self.document.change(scene, "profile from an outline", false) {
            self.notify("The text of the scene has an error. Correct it there first (F7).", false);
        }
    }
}

/// The corners of a box, from its lower corner and its sides.
fn corners([low, sides]: [glam::DVec3; 2]) -> impl Iterator<Item = glam::DVec3> {
    let part = |k: u32, axis: u32| f64::from((k >> axis) & 1);
    (0..8).map(move |k| low + sides * glam::DVec3::new(part(k, 0), part(k, 1), part(k, 2)))
}
