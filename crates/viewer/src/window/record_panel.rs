//! The record dialog: which files, in which size and folder.

use std::path::PathBuf;

use eframe::egui::{Button, Checkbox, DragValue, Grid, TextEdit, Ui};
use foldmotion_record::FilmOptions;
use foldmotion_study::scene::{CameraScene, ColourChoice, OutputChoice, OwnCamera, RecordScene};

use crate::settings::Colour;
use crate::view3d::OrbitCamera;

/// The outputs that the dialog offers, with their labels.
const OUTPUTS: [(OutputChoice, &str); 9] = [
    (OutputChoice::Gif, "film, GIF"),
    (OutputChoice::Mp4, "film, MP4"),
    (OutputChoice::Png, "film frames, PNG"),
    (OutputChoice::Svg, "figure of states, SVG"),
    (OutputChoice::Pdf, "figure of states, PDF"),
    (OutputChoice::Glb, "3D file with the motion, GLB"),
    (OutputChoice::Obj, "3D state, OBJ"),
    (OutputChoice::Stl, "3D state, STL"),
    (OutputChoice::Html, "web page, HTML"),
];

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RecordPanel {
    outputs: Vec<OutputChoice>,
    size: [u32; 2],
    seconds: f64,
    /// Whether figures and models show only the current state, not the five states of the whole motion.
    only_now: bool,
    /// The folder, as typed; `None` until the dialog is shown for a scene.
    pub(crate) folder: Option<String>,
}

/// What the user asks the dialog to do.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum RecordRequest {
    /// Record these outputs into the folder.
    Record(Box<RecordScene>, PathBuf),
    ChooseFolder,
    Close,
}

impl Default for RecordPanel {
    fn default() -> Self {
        Self {
            outputs: vec![OutputChoice::Gif],
            size: FilmOptions::default().size,
            seconds: 8.0,
            only_now: false,
            folder: None,
        }
    }
}

impl RecordPanel {
    /// Shows the dialog; `scene` is the `[record]` table of the scene.
    pub(crate) fn show(
        &mut self,
        ui: &mut Ui,
        scene: &RecordScene,
        current: &CurrentView,
    ) -> Option<RecordRequest> {
        let mut request = None;
        let mut folder = self.folder.take().unwrap_or_default();
        let about =
            "The camera is that of the view. Everything else is as in the scene's [record] table.";
        ui.label(about);
        self.files(ui);
        let words = format!("only t = {:.4} in figures and models", current.time);
        ui.checkbox(&mut self.only_now, words);
        ui.add_space(4.0);
        let label = ui.label("folder");
        ui.horizontal(|ui| {
            ui.add(TextEdit::singleline(&mut folder).desired_width(300.0)).labelled_by(label.id);
            if ui.button("Choose…").clicked() {
                request = Some(RecordRequest::ChooseFolder);
            }
        });
        ui.separator();
        ui.horizontal(|ui| {
            let is_ready = !self.outputs.is_empty() && !folder.trim().is_empty();
            let button = Button::new("Record now");
            if ui.add_enabled(is_ready, button).clicked() {
                let record = Box::new(self.record(scene, current));
                let folder = PathBuf::from(folder.trim());
                request = Some(RecordRequest::Record(record, folder));
            }
            if ui.button("Close").clicked() {
                request = Some(RecordRequest::Close);
            }
        });
        self.folder = Some(folder);
        request
    }

    fn switch(&mut self, ui: &mut Ui, output: OutputChoice, name: &str) {
        let is_there = output != OutputChoice::Mp4 || cfg!(feature = "mp4");
        let mut is_on = self.outputs.contains(&output);
        let check = ui.add_enabled(is_there, Checkbox::new(&mut is_on, name));
        let why_not = "This program was built without MP4; build it with --features full.";
        if check.on_disabled_hover_text(why_not).changed() {
            self.outputs.retain(|&o| o != output);
            if is_on {
                self.outputs.push(output);
            }
        }
    }

    /// The choice of outputs, and their size and duration.
    fn files(&mut self, ui: &mut Ui) {
        ui.add_space(4.0);
        Grid::new("outputs").num_columns(2).show(ui, |ui| {
            for pair in OUTPUTS.chunks(2) {
                for &(output, name) in pair {
                    self.switch(ui, output, name);
                }
                ui.end_row();
            }
        });
        ui.add_space(4.0);
        Grid::new("record").num_columns(2).show(ui, |ui| {
            let sides = ["width, pixels", "height, pixels"];
            for (name, pixels) in sides.into_iter().zip(&mut self.size) {
                let label = ui.label(name);
                let field = DragValue::new(pixels).range(16..=4096);
                ui.add(field).labelled_by(label.id);
                ui.end_row();
            }
            let label = ui.label("film, seconds");
            let field = DragValue::new(&mut self.seconds).range(0.1..=600.0).speed(0.1);
            ui.add(field).labelled_by(label.id);
            ui.end_row();
        });
    }

    /// The `[record]` table for the outputs and the current view.
    fn record(&self, scene: &RecordScene, current: &CurrentView) -> RecordScene {
        let orbit = &current.orbit;
        let camera = OwnCamera {
            azimuth: orbit.azimuth,
            elevation: orbit.elevation,
            turn: None,
            centre: Some(orbit.centre.to_array()),
            width: Some(orbit.width),
        };
        RecordScene {
            outputs: Some(self.outputs.clone()),
            size: Some(self.size.map(i64::from)),
            seconds: Some([self.seconds; 2].map(|seconds| 0.5 * seconds)),
            camera: Some(CameraScene::Own(camera)),
            colour: match current.colour {
                Colour::Strain => Some(ColourChoice::Strain),
                Colour::Bending => Some(ColourChoice::Bending),
                Colour::Plain | Colour::Unit | Colour::Layer => scene.colour,
            },
            at: if self.only_now { Some(vec![current.time]) } else { scene.at.clone() },
            profile: if current.is_file { None } else { scene.profile },
            ..scene.clone()
        }
    }
}

/// The view at the time of recording.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CurrentView {
    pub(crate) orbit: OrbitCamera,
    pub(crate) time: f64,
    pub(crate) colour: Colour,
    /// Whether it shows a motion file, which has no scene.
    pub(crate) is_file: bool,
}
