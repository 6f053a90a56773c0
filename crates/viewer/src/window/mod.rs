//! The window: its state, and what happens in a frame.
//!
//! The text of the scene is authoritative ([`Document`]). Everything else follows from it in the background
//! ([`crate::work`]) and is shown when it is ready: the draft at once, a preview of the motion some hundred
//! milliseconds later, and a run with its verdict when the user asks for one. Nothing that takes long happens in a
//! frame.

mod commands;
mod dialogs;
mod menu;
mod plots;
mod poll;
mod record_panel;
mod scene_view;
mod shown_motion;
mod shown_state;
mod text_panel;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use eframe::egui::{self, CentralPanel, Panel, ScrollArea, Ui};
use foldmotion_study::{Draft, OpenedFile, OpenedMotion, Preview, Scene, Study};

use crate::design::{DesignInput, DesignPanel, SceneError};
use crate::document::Document;
use crate::options::ViewOptions;
use crate::results::results;
use crate::settings::{Settings, UnsavedScenes, apply};
use crate::timeline::{Marks, Playback, Plots, Timeline};
use crate::timings::{Activity, Timings};
use crate::view3d::View3d;
use crate::work::{
    CheckedMotion, FinishedRun, Interaction, Job, RepaintSignal, Resolver, SheetState, StateFeed,
};

use self::dialogs::Dialog;
use self::record_panel::RecordPanel;
use self::shown_motion::ShownMotion;
use self::shown_state::ShownState;

/// The window.
#[expect(clippy::struct_excessive_bools, reason = "independent flags of the window")]
pub struct Viewer {
    document: Document,
    settings: Settings,
    unsaved: Option<UnsavedScenes>,
    design: DesignPanel,
    view3d: View3d,
    playback: Playback,
    timings: Timings,
    prints_timings: bool,
    repaint: RepaintSignal,
    resolved: ResolvedScene,
    display: Display,
    jobs: Jobs,
    dialog: Dialog,
    record_panel: RecordPanel,
    /// The notice in the status bar: its text, whether it is good news, and since when it is shown.
    notice: Option<(String, bool, Instant)>,
    shows_help: bool,
    /// Whether the text is shown because it has an error that must be corrected there.
    must_fix_text: bool,
    /// Whether the window closes without asking again.
    is_closing: bool,
}

/// What the scene resolves to.
struct ResolvedScene {
    resolver: Resolver,
    /// The revision of the document that was submitted last, and the serial number of the request.
    requested: Option<(u64, u64)>,
    /// The last valid draft, with the serial number of its request and its scene.
    draft: Option<(u64, Scene, Arc<Draft>)>,
    /// The study of the current scene.
    study: Option<Arc<Study>>,
    errors: Vec<SceneError>,
}

/// What is shown, and of which motion.
#[derive(Default)]
struct Display {
    /// The exact states or a preview of the last valid draft, and the last run, each with its scene.
    draft: Option<(Scene, Arc<ShownMotion>)>,
    run: Option<(Scene, Arc<ShownMotion>)>,
    /// A motion file that was opened instead of a scene.
    file: Option<Arc<ShownMotion>>,
    state: ShownState,
    next_key: u64,
    title: String,
    /// Whether to fit the view to the next motion.
    fits: bool,
    /// Whether the view follows the current run.
    follows_run: bool,
    /// The vertex that is being pulled, and its target.
    pulled: Option<crate::view3d::VertexPull>,
    /// The triangle and the vertex under the pointer.
    pointed: Option<(u32, Option<u32>)>,
}

/// A job with the data that its result will be combined with.
type Pending<A, T> = Option<(A, Job<T>)>;

/// Jobs in the background.
#[derive(Default)]
struct Jobs {
    preview: Pending<(Scene, Arc<Draft>), Preview>,
    run: Pending<(Scene, StateFeed), FinishedRun>,
    interaction: Option<Interaction>,
    opening: Pending<PathBuf, OpenedFile>,
    checking: Pending<Arc<OpenedMotion>, CheckedMotion>,
    recording: Pending<PathBuf, Vec<String>>,
    /// The highest number of states per second of the current run or interaction.
    best_rate: usize,
}

impl std::fmt::Debug for Viewer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Viewer").finish_non_exhaustive()
    }
}

impl Viewer {
    /// The window with its options; `started` is the time at which the program started.
    pub fn new(
        creation: &eframe::CreationContext<'_>,
        options: ViewOptions,
        started: Instant,
    ) -> Self {
        let settings = Settings::load(creation.storage);
        let ctx = creation.egui_ctx.clone();
        apply(&ctx, settings.appearance, settings.scale.factor());
        let context = ctx.clone();
        let repaint = RepaintSignal::new(move || context.request_repaint());
        let unsaved = options.unsaved.clone().or_else(|| {
            let storage = creation.storage.and(eframe::storage_dir("foldmotion"));
            storage.map(|folder| folder.join("unsaved"))
        });
        let mut playback = Playback::default();
        playback.repeat = settings.view.repeat;
        let mut viewer = Self {
            document: Document::new(),
            unsaved: unsaved.and_then(|folder| UnsavedScenes::in_folder(&folder).ok()),
            design: DesignPanel::default(),
            view3d: View3d::default(),
            playback,
            timings: Timings::new(started),
            prints_timings: options.timings,
            resolved: ResolvedScene {
                resolver: Resolver::new(repaint.clone()),
                requested: None,
                draft: None,
                study: None,
                errors: Vec::new(),
            },
            display: Display { fits: true, ..Display::default() },
            jobs: Jobs::default(),
            dialog: Dialog::None,
            record_panel: RecordPanel::default(),
            notice: None,
            shows_help: false,
            must_fix_text: false,
            is_closing: false,
            settings,
            repaint,
        };
        viewer.view3d.set_perspective(viewer.settings.view.perspective);
        viewer.begin(options.file);
        viewer
    }

    /// Opens the given file, or offers unsaved scenes for recovery.
    fn begin(&mut self, file: Option<PathBuf>) {
        let unsaved = self.unsaved.as_ref();
        if let Some(path) = file {
            self.open(path);
        } else if unsaved.is_some_and(|unsaved| unsaved.recovered().next().is_some()) {
            self.dialog = Dialog::Restore;
        }
    }

    /// The motion that is shown: that of the current scene, if there is one.
    fn shown_motion(&self) -> Option<Arc<ShownMotion>> {
        if let Some(shown) = &self.display.file {
            return Some(Arc::clone(shown));
        }
        let scene = motion_keys(self.document.scene());
        let is_of_scene = |shown: &&(Scene, Arc<ShownMotion>)| shown.0 == scene;
        let run = self.display.run.as_ref();
        let draft = self.display.draft.as_ref();
        // A run says more than the draft of the same scene, even if both are out of date.
        let is_best = |draft: &&(Scene, Arc<ShownMotion>)| {
            is_of_scene(draft) || run.is_none_or(|run| run.0 != draft.0)
        };
        let best = run.filter(is_of_scene).or(draft.filter(is_best)).or(run);
        best.map(|(_, shown)| Arc::clone(shown))
    }

    /// Whether the shown motion does not belong to the current scene.
    fn is_stale(&self, shown: &ShownMotion) -> bool {
        let scene = motion_keys(self.document.scene());
        let mut candidates = self.display.run.iter().chain(&self.display.draft);
        self.display.file.is_none()
            && !candidates.any(|(of, other)| other.key == shown.key && *of == scene)
    }

    /// Whether a motion of the current scene will be shown soon.
    fn is_resolving(&self) -> bool {
        let revision = self.document.revision();
        let is_asked = self.resolved.requested.is_some_and(|(of, _)| of == revision);
        !is_asked || self.resolved.resolver.is_busy() || self.jobs.preview.is_some()
    }

    /// The latest state of the interaction, or of the run that is followed.
    fn live_state(&self) -> Option<SheetState> {
        let run = self.jobs.run.as_ref().filter(|_| self.display.follows_run);
        match (&self.jobs.interaction, run) {
            (Some(interaction), _) => interaction.states().latest(),
            (None, Some(((_, states), _))) => states.latest(),
            (None, None) => None,
        }
    }

    /// Updates the shown state.
    fn update_state(&mut self, shown: &ShownMotion) {
        let count = shown.motion().sheet.vertices.len();
        match self.live_state() {
            Some(state) if state.positions.len() == count => {
                let is_interacting = self.jobs.interaction.is_some();
                if !is_interacting {
                    self.playback.time = state.time;
                }
                self.display.state.show_live(&state, shown, is_interacting);
            }
            _ => self.display.state.show(shown, self.playback.time),
        }
    }

    /// The timeline, with space for plots if there are any.
    fn timeline_panel(&mut self, ui: &mut Ui) {
        let shown = self.shown_motion();
        let has_plots = shown.is_some_and(|shown| !shown.plots.plots.is_empty());
        let (name, height) = if has_plots && self.settings.panels.plots {
            ("plots", 312.0_f32)
        } else {
            ("bar", 72.0)
        };
        let panel = Panel::bottom(name).resizable(name == "plots");
        // In a small window, most of the space is for the sheet.
        let height = height.min(0.45 * ui.available_height()).max(72.0);
        panel.default_size(height).show(ui, |ui| self.timeline(ui));
    }

    fn timeline(&mut self, ui: &mut Ui) {
        let shown = self.shown_motion();
        let (none, no_plots) = (Marks::default(), Plots::default());
        let (marks, curves) = shown.as_ref().map_or((&none, &no_plots), |shown| {
            let curves = if self.settings.panels.plots { &shown.plots } else { &no_plots };
            (&shown.marks, curves)
        });
        if let Some(shown) = &shown {
            self.playback.set_range(shown.range());
        }
        if Timeline::show(ui, &mut self.playback, marks, curves) {
            self.display.follows_run = false;
        }
        self.settings.view.repeat = self.playback.repeat;
        if let Some(interaction) = &self.jobs.interaction {
            interaction.set_target_time(self.playback.time);
        }
    }

    fn side_panels(&mut self, ui: &mut Ui) {
        let shows_text = self.settings.panels.text || self.must_fix_text;
        if self.settings.panels.design || shows_text {
            Panel::left("design").default_size(348.0).size_range(280.0..=620.0).show(ui, |ui| {
                if shows_text {
                    self.text_panel(ui);
                } else {
                    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| self.design_panel(ui));
                }
            });
        }
        if self.settings.panels.verdict {
            Panel::right("verdict").default_size(300.0).size_range(220.0..=520.0).show(ui, |ui| {
                self.verdict_panel(ui);
            });
        }
    }

    fn design_panel(&mut self, ui: &mut Ui) {
        if self.display.file.is_some() {
            ui.add_space(8.0);
            ui.label("A motion file has no scene to edit. Open a scene or start a new one.");
            return;
        }
        let draft = self.resolved.draft.as_ref();
        let input = DesignInput {
            scene: self.document.scene(),
            draft: draft.map(|(_, _, draft)| &**draft),
            draft_number: draft.map_or(0, |(number, ..)| *number),
            errors: &self.resolved.errors,
        };
        if let Some(change) = self.design.show(ui, &input)
            && !self.document.change(change.scene, change.label, change.continues)
        {
            self.notify("The text of the scene has an error. Correct it there first (F7).", false);
        }
    }

    fn verdict_panel(&mut self, ui: &mut Ui) {
        let shown = self.shown_motion();
        let Some(shown) = shown else {
            ui.weak("No result yet");
            return;
        };
        if let Some(t) = self.findings(ui, &shown) {
            self.playback.go_to(t);
            self.display.follows_run = false;
        }
    }

    /// Shows what is known about the motion; returns the motion time that was clicked, if any.
    fn findings(&mut self, ui: &mut Ui, shown: &ShownMotion) -> Option<f64> {
        ui.add_space(6.0);
        if self.is_stale(shown) {
            ui.colored_label(ui.visuals().warn_fg_color, shown.out_of_date_text());
        }
        match &shown.source {
            shown_motion::MotionSource::Run { report, .. } => {
                self.write_button(ui, shown);
                results(ui, report)
            }
            shown_motion::MotionSource::File { checked, motion } => {
                crate::results::file_results(ui, motion.title(), checked.as_deref())
            }
            shown_motion::MotionSource::Exact(_) | shown_motion::MotionSource::Preview(_) => {
                ui.heading("Not run yet");
                ui.label(
                    "The sheet is a preview: folded quasi-statically, without contact between layers, and not checked. Nothing is proved about it.",
                );
                ui.add_space(6.0);
                let can_run = self.resolved.study.is_some() && self.jobs.run.is_none();
                let button = egui::Button::new("Run, check and report");
                if ui.add_enabled(can_run, button).clicked() {
                    self.run();
                }
                self.last_run(ui)
            }
        }
    }

    /// Shows the report of the last run, if it was of another scene; returns the motion time that was clicked, if any.
    fn last_run(&self, ui: &mut Ui) -> Option<f64> {
        let (_, last) = self.display.run.as_ref()?;
        let shown_motion::MotionSource::Run { report, .. } = &last.source else {
            return None;
        };
        ui.separator();
        let words = "Last run (out of date: the scene has changed since)";
        ui.colored_label(ui.visuals().warn_fg_color, words);
        results(ui, report)
    }

    /// Writes the results of a run into the folder that `foldmotion run` uses.
    fn write_button(&mut self, ui: &mut Ui, shown: &ShownMotion) {
        let folder = PathBuf::from("out").join(self.document.source().stem());
        let hint = format!(
            "Writes report.json, certificate.json, motion.fold and the scene's recordings into {}",
            folder.display()
        );
        let is_free = self.jobs.recording.is_none();
        let button = egui::Button::new("Write results");
        let button = ui.add_enabled(is_free, button).on_hover_text(hint);
        if button.clicked() {
            let job = shown.write(folder.clone(), self.repaint.clone());
            self.jobs.recording = job.map(|job| (folder, job));
        }
    }

    /// Shows a notice in the status bar for a while.
    fn notify(&mut self, words: impl Into<String>, is_good: bool) {
        self.notice = Some((words.into(), is_good, Instant::now()));
    }

    fn is_busy(&self) -> bool {
        let jobs = &self.jobs;
        jobs.run.is_some()
            || jobs.interaction.is_some()
            || jobs.recording.is_some()
            || jobs.checking.is_some()
    }
}

/// The scene without its title and recording, which do not affect the motion.
fn motion_keys(scene: &Scene) -> Scene {
    Scene { title: None, record: foldmotion_study::scene::RecordScene::default(), ..scene.clone() }
}

impl eframe::App for Viewer {
    fn ui(&mut self, ui: &mut Ui, frame: &mut eframe::Frame) {
        let activity = if self.is_busy() {
            Activity::Busy
        } else if self.playback.is_playing {
            Activity::Playing
        } else {
            Activity::Idle
        };
        self.timings.frame(activity, self.view3d.drawn() > 0);
        let ctx = ui.ctx().clone();
        self.poll(&ctx);
        let canvas = self.view3d.id();
        for command in crate::settings::pressed(&ctx, canvas) {
            self.perform(command, &ctx);
        }
        self.take_dropped_files(&ctx);
        self.playback.advance(f64::from(ctx.input(|i| i.stable_dt).min(0.1)));
        if self.playback.is_playing {
            ctx.request_repaint();
        }
        Panel::top("menu").show(ui, |ui| self.menu(ui));
        Panel::bottom("status").show(ui, |ui| self.status(ui));
        self.timeline_panel(ui);
        self.side_panels(ui);
        CentralPanel::default().show(ui, |ui| self.scene_view(ui, frame.wgpu_render_state()));
        self.dialogs(&ctx);
        self.ask_before_closing(&ctx);
        self.title(&ctx);
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        self.settings.store(storage);
        self.keep_unsaved();
    }

    fn auto_save_interval(&self) -> Duration {
        Duration::from_secs(3)
    }

    fn on_exit(&mut self) {
        self.keep_unsaved();
        if self.prints_timings {
            use std::io::Write as _;
            // There is nothing left to do if stderr is closed.
            let _ = write!(std::io::stderr(), "{}", self.timings.summary());
        }
    }
}
