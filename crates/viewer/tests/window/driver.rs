//! A window under test: finds controls by name and waits for background jobs.

use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::{Duration, Instant};

use eframe::egui::accesskit::{Role, Toggled};
use eframe::egui::{Event, Key, Modifiers, Pos2, Rect, Vec2, ViewportCommand, vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use egui_kittest::{Harness, HarnessBuilder, Node};
use foldmotion_viewer::{ViewOptions, Viewer};
use tempfile::TempDir;

use crate::storage::Storage;
use crate::system::System;

/// The time limit for background jobs, for the slowest machine.
const PATIENCE: Duration = Duration::from_mins(2);

/// A sheet that is folded and checked quickly.
pub(crate) const SMALL: &str = "\
# A small shelter.
title = \"Small shelter\"

[profile]
model = \"shelter\"
length = 4.0   # metres

[sheet]
width = 4.0
rows = 4
columns = 2
case = \"S\"

[motion]
frames = 8
";

/// A scene with control points to drag.
pub(crate) const ARCH: &str = "\
[profile]
control_points = [[3.0, 0.0], [2.0, 0.0], [2.0, 2.5], [0.0, 3.5], [-2.0, 2.5], [-3.0, 0.0]]

[sheet]
rows = 4
columns = 2

[motion]
frames = 8
";

/// Unmodified short rectangles pass through each other (figures 4a-d of the paper).
pub(crate) const PENETRATING: &str = "\
[profile]
model = \"shelter\"
length = 4.0

[sheet]
width = 4.0
rows = 4
columns = 2
case = \"plain\"

[motion]
contact = false
frames = 24
";

/// The folder of scenes in the repository.
pub(crate) fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

/// A window with its own temporary folder.
pub(crate) struct Window {
    pub(crate) harness: Harness<'static, Viewer>,
    pub(crate) folder: TempDir,
    system: System,
}

impl Window {
    /// A window that was started without a file.
    pub(crate) fn empty() -> Self {
        Self::start(tempfile::tempdir().unwrap(), None, None)
    }

    /// A window with a scene file of this text.
    pub(crate) fn over(text: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scene.toml");
        std::fs::write(&path, text).unwrap();
        Self::start(folder, Some(path), None)
    }

    /// A window with this file.
    pub(crate) fn of(path: &Path) -> Self {
        Self::start(tempfile::tempdir().unwrap(), Some(path.to_owned()), None)
    }

    /// A window with or without a file, which keeps unsaved scenes in `folder` and has the settings in `storage`.
    pub(crate) fn start(folder: TempDir, file: Option<PathBuf>, storage: Option<&Storage>) -> Self {
        let builder = Harness::builder().with_size(vec2(1500.0, 1800.0));
        Self::built(builder, folder, file, storage)
    }

    pub(crate) fn built(
        builder: HarnessBuilder<Viewer>,
        folder: TempDir,
        file: Option<PathBuf>,
        storage: Option<&Storage>,
    ) -> Self {
        let options =
            ViewOptions { file, timings: false, unsaved: Some(folder.path().join("unsaved")) };
        let storage = storage.map(Storage::shared);
        let system = System::default();
        let plugin = system.clone();
        let builder = builder.with_step_dt(0.05).with_max_steps(12);
        let builder = builder.with_context_setup(|ctx| ctx.add_plugin(plugin));
        let harness = builder.build_eframe(|creation| {
            creation.storage = storage.map(|storage| storage as &dyn eframe::Storage);
            Viewer::new(creation, options, Instant::now())
        });
        Self { harness, folder, system }
    }

    /// The scene file of a window made by [`Self::over`].
    pub(crate) fn path(&self) -> PathBuf {
        self.folder.path().join("scene.toml")
    }

    /// Waits until `is_so`.
    #[track_caller]
    pub(crate) fn until(&mut self, what: &str, is_so: impl Fn(&Self) -> bool) {
        let started = Instant::now();
        while !is_so(self) {
            assert!(
                started.elapsed() < PATIENCE,
                "{what}: never; the window shows\n{}",
                self.all_words()
            );
            sleep(Duration::from_millis(4));
            self.harness.step();
        }
        self.harness.check_accessibility();
    }

    /// Waits until some text in the window contains `words`.
    #[track_caller]
    pub(crate) fn until_said(&mut self, words: &str) {
        self.until(words, |window| window.says(words));
    }

    /// Waits until a preview of the motion is shown.
    #[track_caller]
    pub(crate) fn until_preview(&mut self) {
        self.until("a preview", |window| {
            window.says("preview: without contact, not checked")
                && !window.text_over_view().contains("Out of date")
                && window.is_at_rest()
        });
    }

    /// Runs the scene and waits for its verdict.
    #[track_caller]
    pub(crate) fn run_scene(&mut self) {
        self.until("the scene is resolved", |window| window.is_enabled("Run"));
        self.press(Key::F5);
        self.until("the run has ended", |window| {
            window.says("pairs tested between") && !window.has("Cancel")
        });
    }

    fn is_at_rest(&self) -> bool {
        !self.says("Resolving…") && !self.says("Folding a preview…")
    }

    /// Runs frames until nothing changes any more.
    pub(crate) fn settle(&mut self) {
        let _ = self.harness.try_run();
        self.harness.check_accessibility();
    }

    /// All text in the window.
    pub(crate) fn all_words(&self) -> String {
        let nodes = self.harness.root().children_recursive();
        let words = nodes.filter_map(|node| {
            let node = node.accesskit_node();
            let label = if node.role() == Role::Label { node.value() } else { node.label() };
            label.map(|label| format!("{:?} {label}", node.role()))
        });
        words.collect::<Vec<_>>().join("\n")
    }

    /// Whether some text in the window contains `words`.
    pub(crate) fn says(&self, words: &str) -> bool {
        self.harness.query_all_by_label_contains(words).next().is_some()
    }

    /// The rectangles of texts that contain `words`.
    pub(crate) fn rects_saying<'a>(&'a self, words: &'a str) -> impl Iterator<Item = Rect> + 'a {
        let found = self.harness.query_all_by_label_contains(words);
        found.map(|node| node.rect())
    }

    /// The text over the view: motion time, kind of motion and verdict.
    pub(crate) fn text_over_view(&self) -> String {
        let found = self.harness.query_all_by_label_contains("t = ");
        let words = found.filter_map(|node| node.value());
        words.filter(|words| words.starts_with("t = ") && words.contains(", ")).collect()
    }

    /// Whether there is a control or text with exactly this name.
    pub(crate) fn has(&self, label: &str) -> bool {
        self.harness.query_all_by_label(label).next().is_some()
    }

    /// Whether a control is enabled.
    pub(crate) fn is_enabled(&self, label: &str) -> bool {
        let mut found = self.harness.query_all_by_label(label);
        found.any(|node| !node.accesskit_node().is_disabled())
    }

    /// Whether a switch is on.
    #[track_caller]
    pub(crate) fn is_on(&self, label: &str) -> bool {
        self.harness.get_by_label(label).accesskit_node().toggled() == Some(Toggled::True)
    }

    /// Whether the check boxes with this name are on.
    pub(crate) fn switches(&self, label: &str) -> Vec<bool> {
        let found = self.harness.query_all_by_label(label);
        let found = found.filter_map(|node| node.accesskit_node().toggled());
        found.map(|toggled| toggled == Toggled::True).collect()
    }

    /// The value of a field or menu.
    #[track_caller]
    pub(crate) fn value(&self, label: &str) -> String {
        self.harness.get_by_label(label).value().unwrap_or_default()
    }

    /// The motion time of the timeline.
    pub(crate) fn time(&self) -> f64 {
        let bar = self.harness.get_by_label("Motion time");
        bar.accesskit_node().numeric_value().unwrap()
    }

    #[track_caller]
    pub(crate) fn node<'a>(&'a self, label: &'a str) -> Node<'a> {
        self.harness.get_by_label(label)
    }

    #[track_caller]
    pub(crate) fn click(&mut self, label: &str) {
        self.harness.get_by_label(label).click();
        self.settle();
    }

    /// Chooses an entry of a menu; `item` is part of its name.
    #[track_caller]
    pub(crate) fn choose(&mut self, menu: &str, item: &str) {
        let menu = self.harness.get_all_by_label(menu).next();
        menu.unwrap().click();
        self.settle();
        let entries = self.harness.query_all_by_label_contains(item);
        let entry = entries.last();
        entry.unwrap_or_else(|| panic!("a menu has {item}")).click();
        self.settle();
    }

    pub(crate) fn press(&mut self, key: Key) {
        self.harness.key_press(key);
        self.settle();
    }

    pub(crate) fn press_with(&mut self, modifiers: Modifiers, key: Key) {
        self.harness.key_press_modifiers(modifiers, key);
        self.settle();
    }

    /// Presses keys and runs a single frame.
    pub(crate) fn strike(&mut self, modifiers: Modifiers, key: Key) {
        self.harness.event(Event::Key {
            key,
            physical_key: None,
            pressed: true,
            repeat: false,
            modifiers,
        });
        self.harness.step();
    }

    pub(crate) fn undo(&mut self) {
        self.press_with(Modifiers::COMMAND, Key::Z);
    }

    /// Replaces the text of a field and leaves the field.
    #[track_caller]
    pub(crate) fn enter(&mut self, label: &str, text: &str) {
        self.type_into(label, text);
        self.press(Key::Enter);
    }

    /// Replaces the text of a field and stays there.
    #[track_caller]
    pub(crate) fn type_into(&mut self, label: &str, text: &str) {
        self.harness.get_by_label(label).focus();
        self.settle();
        if !self.value(label).is_empty() {
            self.press_with(Modifiers::COMMAND, Key::A);
            self.press(Key::Backspace);
        }
        if !text.is_empty() {
            self.harness.get_by_label(label).type_text(text);
            self.settle();
        }
    }

    /// Clicks a link with this text.
    #[track_caller]
    pub(crate) fn follow_link(&mut self, words: &str) {
        let mut links = self.harness.query_all_by_role_and_label(Role::Link, words);
        links.next().unwrap_or_else(|| panic!("a link {words}")).click();
        drop(links);
        self.settle();
    }

    /// Drags from a position.
    pub(crate) fn drag(&mut self, from: Pos2, way: Vec2) {
        const STEPS: u16 = 4;
        self.harness.hover_at(from);
        self.harness.step();
        self.harness.drag_at(from);
        self.harness.step();
        for step in 1..=STEPS {
            self.harness.hover_at(from + way * f32::from(step) / f32::from(STEPS));
            self.harness.step();
        }
        self.harness.drop_at(from + way);
        self.settle();
    }

    /// The text of the scene, read from the text panel.
    pub(crate) fn text(&mut self) -> String {
        let is_shown = self.has("Scene as text");
        if !is_shown {
            self.press(Key::F7);
        }
        let text = self.value("Scene as text");
        if !is_shown {
            self.press(Key::F7);
        }
        text
    }

    /// Replaces the text of the scene.
    pub(crate) fn set_text(&mut self, text: &str) {
        let is_shown = self.has("Scene as text");
        if !is_shown {
            self.press(Key::F7);
        }
        self.type_into("Scene as text", text);
        if !is_shown {
            self.press(Key::F7);
        }
    }

    /// The title of the window.
    pub(crate) fn title(&self) -> String {
        self.system.title()
    }

    /// Whether the window has sent this command since the last call.
    pub(crate) fn asked_for(&self, command: &ViewportCommand) -> bool {
        self.system.was_asked_for(command)
    }

    /// Hides the durations of a run, which always differ.
    pub(crate) fn hide_seconds(&mut self) {
        let rows: Vec<Rect> = ["folded: ", " engine on "]
            .iter()
            .flat_map(|words| self.rects_saying(words).collect::<Vec<_>>())
            .collect();
        for row in rows {
            self.harness.mask(row);
        }
    }

    /// Ends the window as a crash would, and starts another with the same unsaved scenes.
    pub(crate) fn killed(self, file: Option<PathBuf>) -> Self {
        let Self { harness, folder, .. } = self;
        drop(harness);
        Self::start(folder, file, None)
    }
}
