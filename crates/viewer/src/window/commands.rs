//! What each command does.

use std::path::{Path, PathBuf};

use eframe::egui::{Context, ViewportCommand};
use foldmotion_record::View;
use foldmotion_study::UnitDraft;
use foldmotion_study::scene::ProfileScene;

use super::dialogs::{Dialog, Then};
use super::{Viewer, moving_part};
use crate::document::{Document, SaveError};
use crate::settings::{Colour, Command, Look, Picker, apply};
use crate::timeline::Repeat;
use crate::work::{Hold, Run, open};

/// Endings of files that can be opened.
const OPENED: [&str; 3] = ["toml", "fold", "svg"];

/// Endings of outlines of profiles.
const OUTLINES: [&str; 3] = ["csv", "dat", "dxf"];

impl Viewer {
    /// Does what was asked for.
    pub(super) fn perform(&mut self, command: Command, ctx: &Context) {
        match command {
            Command::New => self.unless_unsaved(Then::New, ctx),
            Command::Open => self.unless_unsaved(Then::ChooseFile, ctx),
            Command::Save => self.save_document(),
            Command::SaveAs => self.choose_place(),
            Command::Quit => ctx.send_viewport_cmd(ViewportCommand::Close),
            Command::Undo => {
                if let Some(label) = self.document.undo() {
                    self.say(format!("undone: {label}"), true);
                }
            }
            Command::Redo => {
                if let Some(label) = self.document.redo() {
                    self.say(format!("done again: {label}"), true);
                }
            }
            Command::Run => self.run(),
            Command::Cancel => self.cancel(),
            Command::Hand => self.take_in_hand(),
            Command::Record => self.settings.panels.record = true,
            Command::DarkLight | Command::Presentation => self.change_look(command, ctx),
            Command::Help => self.shows_help = true,
            Command::PanelText if self.mends_text => self.mends_text = false,
            _ if self.move_time(command) || self.look(command) => {}
            _ => self.switch(command),
        }
    }

    /// Commands that move in time; whether this is one.
    fn move_time(&mut self, command: Command) -> bool {
        let act = self.act();
        let frames = act.as_ref().map_or(&[][..], |act| &act.marks.frames);
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
        self.shown.follows_run &=
            matches!(command, Command::Slower | Command::Faster | Command::Loop);
        true
    }

    /// Commands that change what is seen of the sheet; whether this is one.
    fn look(&mut self, command: Command) -> bool {
        match command {
            Command::ViewFront => self.view3d.look(View::Front),
            Command::ViewSide => self.view3d.look(View::Side),
            Command::ViewTop => self.view3d.look(View::Top),
            Command::ViewIsometric => self.view3d.look(View::Iso),
            Command::Fit => {
                let mut shown = self.shown.pose.positions.to_vec();
                shown.extend(self.shown_boxes());
                self.view3d.fit(shown);
            }
            _ => return false,
        }
        true
    }

    /// The corners of the boxes that are shown.
    fn shown_boxes(&self) -> Vec<glam::DVec3> {
        let looks = &self.settings.view;
        let wanted = [looks.compact_box, looks.closed_form_box];
        let boxes = self.act().map_or([None; 2], |act| act.boxes);
        let is_shown = self.playback.time > 1.0;
        let boxes = boxes.into_iter().zip(wanted);
        let shown = boxes.filter_map(|(bounds, wanted)| bounds.filter(|_| wanted && is_shown));
        shown.flat_map(corners).collect()
    }

    fn switch(&mut self, command: Command) {
        let (view, panels) = (&mut self.settings.view, &mut self.settings.panels);
        if command == Command::PanelDesign && panels.text {
            // It stands where the text stands.
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

    fn change_look(&mut self, command: Command, ctx: &Context) {
        if command == Command::DarkLight {
            self.settings.look = Look::other(ctx);
        } else {
            self.settings.scale = self.settings.scale.next();
        }
        apply(ctx, self.settings.look, self.settings.scale.factor());
    }

    /// Starts a run of the scene as it stands.
    pub(super) fn run(&mut self) {
        if self.shown.file.is_some() {
            self.say("a motion file has nothing to run; open its scene", false);
            return;
        }
        if self.jobs.run.is_some() {
            self.say("a run is under way; cancel it first (Esc)", false);
            return;
        }
        let Some(study) = self.resolved.study.clone() else {
            let words = self.resolved.faults.first().map_or_else(
                || "the scene is still being resolved".to_owned(),
                |fault| fault.message.clone(),
            );
            self.say(words, false);
            return;
        };
        self.jobs.preview = None;
        self.jobs.hold = None;
        self.jobs.best_rate = 0;
        let scene = moving_part(self.document.scene());
        self.jobs.run = Some((scene, Run::start(&study, self.wake.clone())));
        self.shown.follows_run = true;
        self.playback.is_playing = false;
    }

    fn cancel(&mut self) {
        if let Some((_, run)) = &self.jobs.run {
            run.stop();
        } else if let Some((_, job)) = &self.jobs.recording {
            job.stop();
        } else if self.jobs.hold.is_some() {
            self.jobs.hold = None;
        } else if let Some((_, job)) = &self.jobs.opening {
            job.stop();
        }
    }

    /// Takes the sheet in the hand as it is shown, or lets it go.
    fn take_in_hand(&mut self) {
        if self.jobs.hold.take().is_some() {
            self.timings.rate("hand", self.jobs.best_rate as f64);
            self.shown.pulled = None;
            return;
        }
        let (Some(study), Some(act)) = (self.resolved.study.clone(), self.act()) else {
            self.say(
                "the sheet cannot be taken in the hand before the scene is resolved",
                false,
            );
            return;
        };
        if self.shown.file.is_some() || self.is_stale(&act) {
            self.say(
                "only the sheet of the scene as it stands can be taken in the hand",
                false,
            );
            return;
        }
        self.jobs.best_rate = 0;
        self.playback.is_playing = false;
        let from = (self.playback.time, act.state(self.playback.time));
        let start = (!act.is_exact()).then_some(from);
        if start.is_none() {
            self.playback.go_to(self.playback.range[0]);
        }
        self.jobs.hold = Some(Hold::start(study, start, self.wake.clone()));
    }

    /// Opens any file, in the background.
    pub(super) fn open(&mut self, path: PathBuf) {
        let job = open(path.clone(), self.wake.clone());
        self.jobs.opening = Some((path, job));
    }

    pub(super) fn choose_file(&mut self) {
        let recent = self.settings.recent.folders();
        let folder = self.folder();
        self.dialog = Dialog::Open(Picker::open("Open", &OPENED, &folder, &recent));
    }

    pub(super) fn choose_place(&mut self) {
        let name = self.document.name_to_save();
        let recent = self.settings.recent.folders();
        let folder = self.folder();
        self.dialog = Dialog::Save(
            Picker::save("Save as", &["toml"], &folder, &name, &recent),
            None,
        );
    }

    /// The folder of the scene; where the program was started for one that has none.
    fn folder(&self) -> PathBuf {
        let beside = self.document.place().parent().map(Path::to_owned);
        let folder = beside.filter(|folder| folder.is_dir());
        folder
            .or_else(|| std::env::current_dir().ok())
            .unwrap_or_default()
    }

    fn save_document(&mut self) {
        match self.document.save() {
            Ok(()) => self.saved(),
            Err(SaveError::NoFile) => self.choose_place(),
            Err(SaveError::Changed { .. }) => self.dialog = Dialog::Changed,
            Err(error) => self.say(error.to_string(), false),
        }
    }

    pub(super) fn saved(&mut self) {
        if let Some(path) = self.document.path().map(Path::to_owned) {
            self.settings.recent.add(&path);
            self.say(format!("saved {}", path.display()), true);
        }
        self.keep_unsaved();
    }

    /// Goes on with `then`, unless edits would be lost: then asks.
    pub(super) fn unless_unsaved(&mut self, then: Then, ctx: &Context) {
        if self.document.is_modified() && self.shown.file.is_none() {
            self.dialog = Dialog::Unsaved(then);
        } else {
            self.go_on(then, ctx);
        }
    }

    pub(super) fn go_on(&mut self, then: Then, ctx: &Context) {
        match then {
            Then::New => self.take_document(Document::new()),
            Then::ChooseFile => self.choose_file(),
            Then::Open(path) => self.open(path),
            Then::Quit => {
                self.is_closing = true;
                ctx.send_viewport_cmd(ViewportCommand::Close);
            }
        }
    }

    /// Keeps unsaved edits where the next start finds them; forgets them once they are saved.
    pub(super) fn keep_unsaved(&mut self) {
        if let Some(unsaved) = &mut self.unsaved
            && let Err(error) = unsaved.keep(&self.document)
        {
            let words = format!("unsaved edits cannot be kept: {error}; save the scene");
            self.say(words, false);
        }
    }

    /// Opens the first file that was dropped on the window; an outline becomes the profile of the scene.
    pub(super) fn take_dropped_files(&mut self, ctx: &Context) {
        let dropped = ctx.input(|i| i.raw.dropped_files.clone());
        let Some(path) = dropped.first().map(|file| file.path().to_owned()) else {
            return;
        };
        let ending = path.extension().unwrap_or_default().to_ascii_lowercase();
        if OUTLINES.iter().any(|outline| ending == *outline) && self.shown.file.is_none() {
            self.take_outline(&path);
        } else {
            self.unless_unsaved(Then::Open(path), ctx);
        }
    }

    /// Makes the outline in a file the profile. Rows, columns and width stay what they are, which a built-in profile brought.
    fn take_outline(&mut self, path: &Path) {
        let mut scene = self.document.scene().clone();
        scene.profile = ProfileScene {
            file: Some(self.document.name_of(path)),
            unit: scene.profile.unit,
            length: scene.profile.length,
            ..ProfileScene::default()
        };
        let units = self
            .resolved
            .draft
            .as_ref()
            .and_then(|(_, _, draft)| draft.units());
        if let Some(UnitDraft { units, .. }) = units {
            let sheet = &mut scene.sheet;
            sheet.rows = sheet.rows.or(i64::try_from(units.rows).ok());
            sheet.columns = sheet.columns.or(i64::try_from(units.columns).ok());
            sheet.width = sheet
                .width
                .or(Some(units.unit.width * units.columns as f64));
        }
        if !self.document.change(scene, "take an outline", false) {
            self.say(
                "the scene's text has an error; mend it there first (F7)",
                false,
            );
        }
    }
}

/// The corners of a box, from its lower corner and its sides.
fn corners([low, sides]: [glam::DVec3; 2]) -> impl Iterator<Item = glam::DVec3> {
    let part = |k: u32, axis: u32| f64::from((k >> axis) & 1);
    (0..8).map(move |k| low + sides * glam::DVec3::new(part(k, 0), part(k, 1), part(k, 2)))
}
