//! A panel over a scene that applies every edit, as the window does.

use std::path::{Path, PathBuf};

use eframe::egui::{self, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use foldmotion_study::{Draft, Scene, SceneSource};

use super::super::{Change, DesignInput, DesignPanel, SceneError};

/// The panel with the state that the window keeps for it.
pub(super) struct TestPanel {
    panel: DesignPanel,
    pub(super) scene: Scene,
    pub(super) draft: Option<Draft>,
    pub(super) draft_number: u64,
    pub(super) errors: Vec<SceneError>,
    pub(super) changes: Vec<Change>,
}

/// A panel 360 points wide and tall enough to show all of it.
pub(super) fn panel(text: &str) -> Harness<'static, TestPanel> {
    let source = SceneSource::new(Path::new("test.toml"), text.to_owned());
    panel_of(&source, egui::Theme::Dark, 2600.0)
}

pub(super) fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

pub(super) fn panel_of(
    source: &SceneSource,
    theme: egui::Theme,
    height: f32,
) -> Harness<'static, TestPanel> {
    let state = TestPanel {
        panel: DesignPanel::default(),
        scene: source.scene().unwrap(),
        draft: Draft::resolve(source).ok(),
        draft_number: 1,
        errors: Vec::new(),
        changes: Vec::new(),
    };
    let show = |ui: &mut egui::Ui, state: &mut TestPanel| {
        let input = DesignInput {
            scene: &state.scene,
            draft: state.draft.as_ref(),
            draft_number: state.draft_number,
            errors: &state.errors,
        };
        if let Some(change) = state.panel.show(ui, &input) {
            state.scene = change.scene.clone();
            state.changes.push(change);
        }
    };
    let builder = Harness::builder().with_size(vec2(360.0, height)).with_theme(theme);
    let mut harness = builder.with_step_dt(0.05).with_max_steps(40).build_ui_state(show, state);
    harness.run();
    harness
}

impl TestPanel {
    /// Makes a draft of the current scene, as the window does in the background.
    pub(super) fn redraft(&mut self) {
        let text = toml::to_string(&self.scene).unwrap();
        let source = SceneSource::new(Path::new("test.toml"), text);
        self.draft_number += 1;
        self.errors.clear();
        match Draft::resolve(&source) {
            Ok(draft) => self.draft = Some(draft),
            Err(error) => self.errors.push(SceneError::new(error.key(), &error)),
        }
    }

    pub(super) fn labels(&self) -> Vec<(&'static str, bool)> {
        self.changes.iter().map(|change| (change.label, change.continues)).collect()
    }
}

/// Clicks a button or the header of a section.
pub(super) fn click(harness: &mut Harness<'static, TestPanel>, label: &str) {
    harness.get_by_label(label).click();
    harness.run();
}

/// Types text into the field with this name and leaves the field.
pub(super) fn enter(harness: &mut Harness<'static, TestPanel>, label: &str, text: &str) {
    harness.get_by_label(label).focus();
    harness.run();
    harness.key_combination_modifiers(egui::Modifiers::COMMAND, &[egui::Key::A]);
    harness.key_press(egui::Key::Backspace);
    harness.run();
    if !text.is_empty() {
        harness.get_by_label(label).type_text(text);
        harness.run();
    }
    harness.key_press(egui::Key::Enter);
    harness.run();
}

/// Drags from a position in `steps` moves.
pub(super) fn drag(
    harness: &mut Harness<'static, TestPanel>,
    from: egui::Pos2,
    way: egui::Vec2,
    steps: u16,
) {
    harness.hover_at(from);
    harness.run();
    harness.drag_at(from);
    harness.step();
    for step in 1..=steps {
        harness.hover_at(from + way * f32::from(step) / f32::from(steps));
        harness.step();
    }
    harness.drop_at(from + way);
    harness.run();
}
