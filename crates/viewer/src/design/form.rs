//! The form over a scene: rows of controls, error messages beside them, and the edit that they make.

use std::borrow::Cow;
use std::collections::BTreeSet;

use eframe::egui::{self, Align, Id, Layout, RichText, Ui, UiBuilder, vec2};
use foldmotion_study::{Draft, Scene};

use super::{Change, DesignInput, SceneError};
use foldmotion_study::scene::fields::tip;

/// Font size of notes and error messages, points.
pub(super) const NOTE_SIZE: f32 = 11.0;
/// Width of the labels to the left of the controls, points.
pub(super) const LABEL_WIDTH: f32 = 100.0;
/// Tables of a scene that have a section; errors in other tables are shown at the top of the panel.
const TABLES: [&str; 8] =
    ["profile", "sheet", "division", "material", "motion", "check", "record", "pattern"];

/// A key of the scene that has a row in the panel. Its tooltip is the description in the schema.
#[derive(Debug, Clone)]
pub(super) struct Field {
    pub(super) key: Cow<'static, str>,
    /// The label to the left of the control, also its accessible name and the name of an edit to undo.
    pub(super) name: &'static str,
}

impl Field {
    pub(super) fn new(key: impl Into<Cow<'static, str>>, name: &'static str) -> Self {
        let key = key.into();
        debug_assert!(!tip(&key).is_empty(), "the schema lacks {key}");
        Self { key, name }
    }

    pub(super) fn tip(&self) -> &'static str {
        tip(&self.key)
    }
}

/// The scene while it is edited in one frame.
pub(super) struct Form<'a> {
    original: &'a Scene,
    /// The copy that the controls edit.
    pub(super) scene: Scene,
    pub(super) draft: Option<&'a Draft>,
    pub(super) draft_number: u64,
    id: Id,
    errors: &'a [SceneError],
    /// Keys whose errors were shown beside a control: in the previous frame, and so far in this frame.
    claimed: BTreeSet<String>,
    claims: BTreeSet<String>,
    gesture: Option<Id>,
    change: Option<(&'static str, bool)>,
}

impl<'a> Form<'a> {
    pub(super) fn new(
        ui: &Ui,
        input: &DesignInput<'a>,
        gesture: Option<Id>,
        claimed: BTreeSet<String>,
    ) -> Self {
        Self {
            original: input.scene,
            scene: input.scene.clone(),
            draft: input.draft,
            draft_number: input.draft_number,
            id: ui.make_persistent_id("design"),
            errors: input.errors,
            claimed,
            claims: BTreeSet::new(),
            gesture,
            change: None,
        }
    }

    /// The edit, the gesture in progress, and the keys whose errors were shown beside a control.
    pub(super) fn finish(self, ui: &Ui) -> (Option<Change>, Option<Id>, BTreeSet<String>) {
        if self.claims != self.claimed {
            ui.request_repaint();
        }
        // Text that cannot be parsed leaves the scene unchanged.
        let change = self.change.filter(|_| self.scene != *self.original);
        let change =
            change.map(|(label, continues)| Change { scene: self.scene, label, continues });
        (change, self.gesture, self.claims)
    }

    /// Records that control `by` has changed the scene; `ongoing` while its drag or key press lasts.
    pub(super) fn record(&mut self, label: &'static str, by: Id, ongoing: bool) {
        let continues = ongoing && self.gesture == Some(by);
        self.gesture = ongoing.then_some(by);
        self.change = Some((label, continues));
    }

    /// An id that does not depend on what is shown above.
    pub(super) fn id(&self, key: &str) -> Id {
        self.id.with(key)
    }

    /// A part of the panel whose ids do not depend on what is shown above.
    pub(super) fn scope<R>(
        &mut self,
        ui: &mut Ui,
        key: &str,
        add: impl FnOnce(&mut Self, &mut Ui) -> R,
    ) -> R {
        let builder = UiBuilder::new().scope_id(self.id(key));
        ui.scope_builder(builder, |ui| add(self, ui)).inner
    }

    /// A collapsible section. Errors in its `tables` that no control shows are listed at its top.
    pub(super) fn section(
        &mut self,
        ui: &mut Ui,
        title: &'static str,
        open: bool,
        tables: &[&str],
        add: impl FnOnce(&mut Self, &mut Ui),
    ) {
        let wrong = self.errors.iter().any(|f| is_within(f, tables));
        let mut text = RichText::new(title).strong();
        if wrong {
            text = text.color(ui.visuals().error_fg_color);
        }
        let shown = egui::CollapsingHeader::new(text)
            .id_salt(self.id(title))
            .default_open(open)
            .show_unindented(ui, |ui| {
                self.scope(ui, title, |form, ui| {
                    form.unclaimed(ui, tables);
                    add(form, ui);
                    ui.add_space(6.0);
                });
            });
        if shown.body_returned.is_none() {
            self.unclaimed(ui, tables);
        }
    }

    /// A row: the name of a key on the left, its control on the right, and its errors below.
    pub(super) fn row(
        &mut self,
        ui: &mut Ui,
        field: &Field,
        add: impl FnOnce(&mut Self, &mut Ui, Id),
    ) {
        self.scope(ui, &field.key, |form, ui| {
            ui.horizontal(|ui| {
                let label = name(ui, field.name, field.tip());
                add(form, ui, label);
            });
        });
        self.errors_of(ui, &field.key);
    }

    pub(super) fn errors_of(&mut self, ui: &mut Ui, key: &str) {
        for error in self.errors {
            if let Some(at) = error.key.as_deref().filter(|at| is_at(at, key)) {
                self.claims.insert(at.to_owned());
                message(ui, error);
            }
        }
    }

    /// The errors of a key itself, without those of its elements.
    pub(super) fn errors_exactly_at(&mut self, ui: &mut Ui, key: &str) {
        for error in self.errors {
            if error.key.as_deref() == Some(key) {
                self.claims.insert(key.to_owned());
                message(ui, error);
            }
        }
    }

    /// The errors that belong to no section.
    pub(super) fn general_errors(&mut self, ui: &mut Ui) {
        for error in self.errors {
            if !is_within(error, &TABLES) {
                message(ui, error);
            }
        }
    }

    fn unclaimed(&self, ui: &mut Ui, tables: &[&str]) {
        for error in self.errors {
            let is_claimed = error.key.as_ref().is_some_and(|key| self.claimed.contains(key));
            if is_within(error, tables) && !is_claimed {
                message(ui, error);
            }
        }
    }
}

/// The name of a row, in a column of fixed width; returns the id of the label.
pub(super) fn name(ui: &mut Ui, text: &str, tip: &str) -> Id {
    let size = vec2(LABEL_WIDTH, ui.spacing().interact_size.y);
    let layout = Layout::left_to_right(Align::Center);
    let label = ui.allocate_ui_with_layout(size, layout, |ui| {
        ui.set_min_size(size);
        ui.add(egui::Label::new(text).truncate())
    });
    let label = label.inner;
    let id = label.id;
    if !tip.is_empty() {
        label.on_hover_text(tip);
    }
    id
}

/// A note beside the controls, smaller and paler than they are.
pub(super) fn note(ui: &Ui, text: impl Into<String>) -> RichText {
    let colour = ui.visuals().weak_text_color();
    RichText::new(text).size(NOTE_SIZE).color(colour)
}

fn message(ui: &mut Ui, error: &SceneError) {
    let text = RichText::new(&error.message).size(NOTE_SIZE).color(ui.visuals().error_fg_color);
    ui.add(egui::Label::new(text).wrap());
}

/// Whether the key `at` is `key` or an element of it.
fn is_at(at: &str, key: &str) -> bool {
    let rest = at.strip_prefix(key);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

fn is_within(error: &SceneError, tables: &[&str]) -> bool {
    let table = error.key.as_deref().and_then(|key| key.split('.').next());
    table.is_some_and(|table| tables.contains(&table))
}
