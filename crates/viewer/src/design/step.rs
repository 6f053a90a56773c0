//! One step of the schedule.

use eframe::egui::{self, Frame, Id, Margin, Rect, RichText, Stroke, Ui, pos2, vec2};
use foldmotion_study::scene::{Stage, StepScene};

use super::form::{Field, Form};
use super::number::{AccessibleName, Number, control_width};
use foldmotion_study::scene::fields::choices;

/// The groups of creases that an imported pattern has.
const IMPORTED_CREASES: [&str; 3] = ["all", "mountains", "valleys"];

/// Access to the range of rows or columns of a step.
type Range = fn(&mut StepScene) -> &mut Option<Vec<i64>>;

/// A user action on a step in the list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum StepAction {
    Up,
    Down,
    Remove,
}

/// Shows step `index` of `count`; returns the action of a button that was clicked, and the button's id.
pub(super) fn show_step(
    form: &mut Form<'_>,
    ui: &mut Ui,
    index: usize,
    count: usize,
) -> Option<(StepAction, Id)> {
    let ground = ui.visuals().faint_bg_color;
    let frame = Frame::new().fill(ground).inner_margin(Margin::same(5)).corner_radius(3.0);
    frame
        .show(ui, |ui| {
            ui.set_width(ui.available_width());
            let order = form.scope(ui, &format!("motion.step.{index}"), |_, ui| {
                ui.horizontal(|ui| show_head(ui, index, count)).inner
            });
            form.errors_exactly_at(ui, &format!("motion.step.{index}"));
            show_creases(form, ui, index);
            show_timing(form, ui, index);
            order
        })
        .inner
}

fn show_head(ui: &mut Ui, index: usize, count: usize) -> Option<(StepAction, Id)> {
    let number = index + 1;
    ui.label(RichText::new(format!("step {number}")).strong());
    let buttons = [
        ("up", StepAction::Up, index > 0),
        ("down", StepAction::Down, index + 1 < count),
        ("remove", StepAction::Remove, true),
    ];
    let mut asked = None;
    for (name, order, is_possible) in buttons {
        let button = ui.add_enabled_ui(is_possible, |ui| icon_button(ui, order)).inner;
        let button = button.accessible_name(format!("{name} step {number}")).on_hover_text(name);
        if button.clicked() {
            asked = Some((order, button.id));
        }
    }
    asked
}

/// A small button with a drawn icon, because the fonts have no arrows.
fn icon_button(ui: &mut Ui, order: StepAction) -> egui::Response {
    let (rect, response) = ui.allocate_exact_size(vec2(18.0, 18.0), egui::Sense::click());
    response.widget_info(|| {
        egui::WidgetInfo::labeled(egui::accesskit::Role::Button, ui.is_enabled(), "")
    });
    let visuals = ui.style().interact(&response);
    let painter = ui.painter();
    painter.rect_filled(rect, visuals.corner_radius, visuals.weak_bg_fill);
    let stroke = Stroke::new(1.5, visuals.fg_stroke.color);
    let at = |x: f32, y: f32| rect.center() + vec2(x, y);
    match order {
        StepAction::Up => painter.line(vec![at(-4.0, 2.0), at(0.0, -2.5), at(4.0, 2.0)], stroke),
        StepAction::Down => painter.line(vec![at(-4.0, -2.0), at(0.0, 2.5), at(4.0, -2.0)], stroke),
        StepAction::Remove => {
            painter.line_segment([at(-3.5, -3.5), at(3.5, 3.5)], stroke);
            painter.line_segment([at(-3.5, 3.5), at(3.5, -3.5)], stroke)
        }
    };
    response
}

/// The stage and the creases of the step.
fn show_creases(form: &mut Form<'_>, ui: &mut Ui, index: usize) {
    let key = |key: &str| format!("motion.step.{index}.{key}");
    let is_imported = form.scene.pattern.is_some();
    let Some(step) = form.scene.motion.step.get(index) else {
        return;
    };
    let stage = step.stage;
    let given = serde_json::to_value(step.creases).unwrap_or_default();
    if !is_imported || stage == Stage::Unfold {
        let field = Field::new(key("stage"), "stage");
        form.row(ui, &field, |form, ui, _| {
            for (choice, name) in [(Stage::Unfold, "unfold"), (Stage::Fold, "fold")] {
                let option = ui.selectable_label(choice == stage, name);
                if option.clicked() && choice != stage {
                    if let Some(step) = form.scene.motion.step.get_mut(index) {
                        step.stage = choice;
                    }
                    form.record(field.name, option.id, false);
                }
            }
        });
    }
    let field = Field::new(key("creases"), "creases");
    let mut creases = choices(&field.key);
    if is_imported {
        creases.retain(|(name, _)| IMPORTED_CREASES.contains(name) || given == *name);
    }
    form.menu_of(ui, &field, "all", creases, |scene| &mut scene.motion.step[index].creases);
    let lists: [(&'static str, Range); 2] =
        [("rows", |step| &mut step.rows), ("columns", |step| &mut step.columns)];
    for (name, of) in lists {
        let step = form.scene.motion.step.get_mut(index);
        let is_given = step.is_some_and(|step| of(step).is_some());
        if !is_imported || is_given {
            let field = Field::new(key(name), name);
            show_range(form, ui, &field, index, of);
        }
    }
}

/// Fields for the first and the last row or column.
fn show_range(form: &mut Form<'_>, ui: &mut Ui, field: &Field, index: usize, of: Range) {
    form.row(ui, field, |form, ui, _| {
        let width = (control_width(ui) - 24.0) / 2.0;
        let Some(step) = form.scene.motion.step.get_mut(index) else {
            return;
        };
        let range = of(step).clone().unwrap_or_default();
        let ends = Number::within(0.0..=1000.0).whole();
        let (mut first, mut last) = (range.first().copied(), range.get(1).copied());
        let [spoken_first, spoken_last] =
            ["first", "last"].map(|end| format!("{end} of {}", field.name));
        let number = ends.clone().hint("all");
        let spoken = AccessibleName::As(&spoken_first);
        let first_changed = form.whole_cell(ui, field.name, spoken, &number, width, &mut first);
        ui.label("–");
        let number = ends.default(first.map(|first| first as f64)).hint("all");
        let spoken = AccessibleName::As(&spoken_last);
        let last_changed = form.whole_cell(ui, field.name, spoken, &number, width, &mut last);
        let range = match (first, last) {
            // Without a first index the range is empty; a last index alone starts at 0.
            (None, Some(last)) if last_changed => Some(vec![0, last]),
            (None, _) => None,
            (Some(first), None) => Some(vec![first]),
            (Some(first), Some(last)) => Some(vec![first, last]),
        };
        if (first_changed || last_changed)
            && let Some(step) = form.scene.motion.step.get_mut(index)
        {
            *of(step) = range;
        }
    });
}

/// When in the stage the creases move, and how.
fn show_timing(form: &mut Form<'_>, ui: &mut Ui, index: usize) {
    let key = |key: &str| format!("motion.step.{index}.{key}");
    let Some(step) = form.scene.motion.step.get(index) else {
        return;
    };
    paint_part(ui, step.from.unwrap_or(0.0), step.to.unwrap_or(1.0));
    let part = Number::within(0.0..=1.0).speed(0.005);
    let field = Field::new(key("from"), "from");
    form.number(ui, &field, &part.clone().default(0.0), |scene| &mut scene.motion.step[index].from);
    let field = Field::new(key("to"), "to");
    form.number(ui, &field, &part.default(1.0), |scene| &mut scene.motion.step[index].to);
    let field = Field::new(key("ease"), "ease");
    form.menu(ui, &field, "linear", |scene| &mut scene.motion.step[index].ease);
}

/// A bar for the stage, in which the part with the step is filled.
fn paint_part(ui: &mut Ui, from: f64, to: f64) {
    let size = vec2(ui.available_width(), 8.0);
    let (rect, response) = ui.allocate_exact_size(size, egui::Sense::hover());
    let at = |part: f64| rect.left() + rect.width() * part.clamp(0.0, 1.0) as f32;
    let part = Rect::from_min_max(
        pos2(at(from), rect.top()),
        pos2(at(to).max(at(from) + 1.0), rect.bottom()),
    );
    let painter = ui.painter_at(rect);
    painter.rect(
        rect,
        2.0,
        ui.visuals().widgets.inactive.weak_bg_fill,
        Stroke::NONE,
        egui::StrokeKind::Inside,
    );
    painter.rect_filled(part, 2.0, ui.visuals().selection.bg_fill);
    response.on_hover_text("The part of the stage in which the creases of this step move.");
}
