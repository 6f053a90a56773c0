//! The window: what it holds, and how a frame of it goes.
//!
//! The scene's text is the truth ([`Document`]); everything else follows from it in the background ([`crate::work`]) and is
//! shown when it comes: the draft at once, a preview of the motion some hundred milliseconds later, a run with its verdict
//! when the user asks for one. Nothing that takes long happens in a frame.

mod act;
mod commands;
mod dialogs;
mod figures;
mod menu;
mod poll;
mod pose;
mod record_panel;
mod scene_view;
mod text_panel;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use eframe::egui::{self, CentralPanel, Panel, ScrollArea, Ui};
use foldmotion_study::{Draft, Opened, Preview, Scene, Study};

use crate::options::ViewOptions;
use crate::design::{DesignPanel, Facts, Fault};
use crate::document::Document;
use crate::results::results;
use crate::settings::{Settings, UnsavedScenes, apply};
use crate::timeline::{Curves, Marks, Playback, Timeline};
use crate::timings::{Pace, Timings};
use crate::view3d::View3d;
use crate::work::{Drafts, Hold, Job, Judged, Run, State, Wake};

use self::act::Act;
use self::dialogs::Dialog;
use self::pose::Pose;
use self::record_panel::RecordPanel;

/// The window.
#[expect(
    clippy::struct_excessive_bools,
    reason = "what is open over the window, each by itself"
)]
pub struct Viewer {
    document: Document,
    settings: Settings,
    unsaved: Option<UnsavedScenes>,
    design: DesignPanel,
    view3d: View3d,
    playback: Playback,
    timings: Timings,
    prints_timings: bool,
    wake: Wake,
    resolved: ResolvedScene,
    shown: Shown,
    jobs: Jobs,
    dialog: Dialog,
    record_panel: RecordPanel,
    /// What went wrong or well, and since when it is said.
    notice: Option<(String, bool, Instant)>,
    shows_help: bool,
    /// Whether the text is shown because the scene could not be read.
    mends_text: bool,
    /// Whether the window closes without asking again.
    is_closing: bool,
}

/// What became of the scene.
struct ResolvedScene {
    drafts: Drafts,
    /// The revision of the document that was asked about, and the number of the question.
    asked: Option<(u64, u64)>,
    /// The last good draft, with the number of its question and its scene.
    draft: Option<(u64, Scene, Arc<Draft>)>,
    /// The study of the scene as it stands.
    study: Option<Arc<Study>>,
    faults: Vec<Fault>,
}

/// What is shown of which motion.
#[derive(Default)]
struct Shown {
    /// Exact states or a preview of the last good draft, and the last run, each with its scene.
    draft: Option<(Scene, Arc<Act>)>,
    run: Option<(Scene, Arc<Act>)>,
    /// A motion that was opened in place of a scene.
    file: Option<Arc<Act>>,
    pose: Pose,
    next_key: u64,
    /// The title of the window.
    title: String,
    /// Whether the view is to be fitted to the next motion.
    fits: bool,
    /// Whether the view follows the run under way.
    follows_run: bool,
    /// The vertex that is pulled, and where to.
    pulled: Option<crate::view3d::Handle>,
    /// The triangle and the vertex under the pointer.
    pointed: Option<(u32, Option<u32>)>,
}

/// What is done in the background.
#[derive(Default)]
struct Jobs {
    preview: Option<(Scene, Arc<Draft>, Job<Preview>)>,
    run: Option<(Scene, Run)>,
    hold: Option<Hold>,
    opening: Option<(PathBuf, Job<Opened>)>,
    judging: Option<Job<Judged>>,
    recording: Option<(PathBuf, Job<Vec<String>>)>,
    /// The highest rate of states of the run or hand at hand.
    best_rate: usize,
}

impl std::fmt::Debug for Viewer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut debug = f.debug_struct("Viewer");
        debug
            .field("document", &self.document)
            .finish_non_exhaustive()
    }
}

impl Viewer {
    /// The window with what `options` ask for; `started`: when the program was.
    pub fn new(
        creation: &eframe::CreationContext<'_>,
        options: ViewOptions,
        started: Instant,
    ) -> Self {
        let settings = Settings::load(creation.storage);
        let ctx = creation.egui_ctx.clone();
        apply(&ctx, settings.look, settings.scale.factor());
        let waking = ctx.clone();
        let wake = Wake::new(move || waking.request_repaint());
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
                drafts: Drafts::new(wake.clone()),
                asked: None,
                draft: None,
                study: None,
                faults: Vec::new(),
            },
            shown: Shown {
                fits: true,
                ..Shown::default()
            },
            jobs: Jobs::default(),
            dialog: Dialog::None,
            record_panel: RecordPanel::default(),
            notice: None,
            shows_help: false,
            mends_text: false,
            is_closing: false,
            settings,
            wake,
        };
        viewer
            .view3d
            .set_perspective(viewer.settings.view.perspective);
        viewer.begin(options.file);
        viewer
    }

    /// Opens the file asked for; else offers what was left unsaved.
    fn begin(&mut self, file: Option<PathBuf>) {
        match file {
            Some(path) => self.open(path),
            None => {
                if self
                    .unsaved
                    .as_ref()
                    .is_some_and(|u| u.left().next().is_some())
                {
                    self.dialog = Dialog::Restore;
                }
            }
        }
    }

    /// The motion that is shown: that of the scene as it stands, if there is one.
    fn act(&self) -> Option<Arc<Act>> {
        if let Some(act) = &self.shown.file {
            return Some(Arc::clone(act));
        }
        let scene = moving_part(self.document.scene());
        let is_of_scene = |act: &&(Scene, Arc<Act>)| act.0 == scene;
        let run = self.shown.run.as_ref();
        let draft = self.shown.draft.as_ref();
        // A run says more than the draft of the same scene, even once both are old.
        let is_best = |draft: &&(Scene, Arc<Act>)| {
            is_of_scene(draft) || run.is_none_or(|run| run.0 != draft.0)
        };
        let best = run.filter(is_of_scene).or(draft.filter(is_best)).or(run);
        best.map(|(_, act)| Arc::clone(act))
    }

    /// Whether what is shown is not of the scene as it stands.
    fn is_stale(&self, act: &Act) -> bool {
        let scene = moving_part(self.document.scene());
        let mut acts = self.shown.run.iter().chain(&self.shown.draft);
        self.shown.file.is_none() && !acts.any(|(of, other)| other.key == act.key && *of == scene)
    }

    /// Whether what the scene moves is about to be shown.
    fn is_resolving(&self) -> bool {
        let revision = self.document.revision();
        let is_asked = self.resolved.asked.is_some_and(|(of, _)| of == revision);
        !is_asked || self.resolved.drafts.is_busy() || self.jobs.preview.is_some()
    }

    /// The state that is computed while it is shown: in the hand, or of the run that is followed.
    fn live(&self) -> Option<State> {
        let run = self.jobs.run.as_ref().filter(|_| self.shown.follows_run);
        match (&self.jobs.hold, run) {
            (Some(hold), _) => hold.live().newer(0),
            (None, Some((_, run))) => run.live().newer(0),
            (None, None) => None,
        }
    }

    /// Brings the pose up to date with what is shown now.
    fn pose(&mut self, act: &Act) {
        let count = act.motion().sheet.vertices.len();
        match self.live() {
            Some(state) if state.positions.len() == count => {
                let is_in_hand = self.jobs.hold.is_some();
                if !is_in_hand {
                    self.playback.time = state.time;
                }
                self.shown.pose.show_live(&state, act, is_in_hand);
            }
            _ => self.shown.pose.show(act, self.playback.time),
        }
    }

    /// The timeline, with room for curves where there are any.
    fn timeline_panel(&mut self, ui: &mut Ui) {
        let act = self.act();
        let has_curves = act.is_some_and(|act| !act.curves.panels.is_empty());
        let (name, height) = if has_curves && self.settings.panels.plots {
            ("plots", 312.0_f32)
        } else {
            ("bar", 72.0)
        };
        let panel = Panel::bottom(name).resizable(name == "plots");
        // A small window is for the sheet first.
        let height = height.min(0.45 * ui.available_height()).max(72.0);
        panel.default_size(height).show(ui, |ui| self.timeline(ui));
    }

    fn timeline(&mut self, ui: &mut Ui) {
        let act = self.act();
        let (none, no_curves) = (Marks::default(), Curves::default());
        let (marks, curves) = act.as_ref().map_or((&none, &no_curves), |act| {
            let curves = if self.settings.panels.plots {
                &act.curves
            } else {
                &no_curves
            };
            (&act.marks, curves)
        });
        if let Some(act) = &act {
            self.playback.set_range(act.range());
        }
        if Timeline::show(ui, &mut self.playback, marks, curves) {
            self.shown.follows_run = false;
        }
        self.settings.view.repeat = self.playback.repeat;
        if let Some(hold) = &self.jobs.hold {
            hold.aim(self.playback.time);
        }
    }

    fn side_panels(&mut self, ui: &mut Ui) {
        let shows_text = self.settings.panels.text || self.mends_text;
        if self.settings.panels.design || shows_text {
            Panel::left("design")
                .default_size(348.0)
                .size_range(280.0..=620.0)
                .show(ui, |ui| {
                    if shows_text {
                        self.text_panel(ui);
                    } else {
                        ScrollArea::vertical()
                            .auto_shrink(false)
                            .show(ui, |ui| self.design_panel(ui));
                    }
                });
        }
        if self.settings.panels.verdict {
            Panel::right("verdict")
                .default_size(300.0)
                .size_range(220.0..=520.0)
                .show(ui, |ui| {
                    self.verdict_panel(ui);
                });
        }
    }

    fn design_panel(&mut self, ui: &mut Ui) {
        if self.shown.file.is_some() {
            ui.add_space(8.0);
            ui.label("a motion file has no scene to edit; open or start a scene");
            return;
        }
        let draft = self.resolved.draft.as_ref();
        let facts = Facts {
            scene: self.document.scene(),
            draft: draft.map(|(_, _, draft)| &**draft),
            draft_number: draft.map_or(0, |(number, ..)| *number),
            faults: &self.resolved.faults,
        };
        if let Some(change) = self.design.show(ui, &facts)
            && !self
                .document
                .change(change.scene, change.label, change.continues)
        {
            self.say(
                "the scene's text has an error; mend it there first (F7)",
                false,
            );
        }
    }

    fn verdict_panel(&mut self, ui: &mut Ui) {
        let act = self.act();
        let Some(act) = act else {
            ui.weak("nothing yet");
            return;
        };
        if let Some(t) = self.findings(ui, &act) {
            self.playback.go_to(t);
            self.shown.follows_run = false;
        }
    }

    /// What is known of the motion; a motion time that was clicked.
    fn findings(&mut self, ui: &mut Ui, act: &Act) -> Option<f64> {
        ui.add_space(6.0);
        if self.is_stale(act) {
            ui.colored_label(
                ui.visuals().warn_fg_color,
                "of the scene before the last edits",
            );
        }
        match &act.source {
            act::Source::Run { report, .. } => {
                self.write_button(ui, act);
                results(ui, report)
            }
            act::Source::File { judged, motion } => {
                crate::results::file_results(ui, motion.title(), judged.as_deref())
            }
            act::Source::Exact(_) | act::Source::Preview(_) => {
                ui.heading("not run yet");
                ui.label(
                    "what is shown is a preview: quasi-static, its layers pass through each other, and nothing is proved of it",
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

    /// What was found out about the run of a scene before this one; a motion time that was clicked.
    fn last_run(&self, ui: &mut Ui) -> Option<f64> {
        let (_, last) = self.shown.run.as_ref()?;
        let act::Source::Run { report, .. } = &last.source else {
            return None;
        };
        ui.separator();
        let words = "the last run, of the scene before the last edits";
        ui.colored_label(ui.visuals().warn_fg_color, words);
        results(ui, report)
    }

    /// Writes the results of a run where `foldmotion run` would.
    fn write_button(&mut self, ui: &mut Ui, act: &Act) {
        let folder = PathBuf::from("out").join(self.document.source().stem());
        let hint = format!(
            "report.json, certificate.json, motion.fold and what the scene records, into {}",
            folder.display()
        );
        let is_free = self.jobs.recording.is_none();
        let button = egui::Button::new("Write results");
        if ui
            .add_enabled(is_free, button)
            .on_hover_text(hint)
            .clicked()
        {
            let job = act.write(folder.clone(), self.wake.clone());
            self.jobs.recording = job.map(|job| (folder, job));
        }
    }

    /// Says something at the foot of the window for a while.
    fn say(&mut self, words: impl Into<String>, is_good: bool) {
        self.notice = Some((words.into(), is_good, Instant::now()));
    }

    fn is_busy(&self) -> bool {
        let jobs = &self.jobs;
        jobs.run.is_some()
            || jobs.hold.is_some()
            || jobs.recording.is_some()
            || jobs.judging.is_some()
    }
}

/// What of a scene moves its sheet: not its title, nor what is recorded.
fn moving_part(scene: &Scene) -> Scene {
    Scene {
        title: None,
        record: foldmotion_study::scene::RecordScene::default(),
        ..scene.clone()
    }
}

impl eframe::App for Viewer {
    fn ui(&mut self, ui: &mut Ui, frame: &mut eframe::Frame) {
        let pace = if self.is_busy() {
            Pace::Busy
        } else if self.playback.is_playing {
            Pace::Playing
        } else {
            Pace::Idle
        };
        self.timings.frame(pace, self.view3d.drawn() > 0);
        let ctx = ui.ctx().clone();
        self.poll(&ctx);
        let canvas = self.view3d.id();
        for command in crate::settings::pressed(&ctx, canvas) {
            self.perform(command, &ctx);
        }
        self.take_dropped_files(&ctx);
        self.playback
            .advance(f64::from(ctx.input(|i| i.stable_dt).min(0.1)));
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
            // Nothing is left to do where stderr is closed.
            let _ = write!(std::io::stderr(), "{}", self.timings.summary());
        }
    }
}
