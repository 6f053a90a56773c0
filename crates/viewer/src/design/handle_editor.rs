//! Dragging and editing of control points and interpolation points.

use eframe::egui::{
    self, Event, EventFilter, Id, Key, PointerButton, Rect, Response, Sense, Stroke, Ui, Vec2, vec2,
};
use glam::DVec2;

use super::curve::{handles_mut, remove_handle};
use super::form::Form;
use super::number::Number;
use super::plane::{Plane, PlaneView, round_step};

/// If a curve has more points than this, only the curve is drawn.
pub(super) const MAX_HANDLES: usize = 400;
/// Size of the area around a point in which it can be grabbed, points on the screen.
const REACH: f32 = 16.0;

/// The selected point and the drag in progress.
#[derive(Debug, Default)]
pub(super) struct HandleEditor {
    selected: Option<usize>,
    /// The position of the point when the drag began.
    origin: Option<DVec2>,
    /// Whether the view is pinned only while the drag lasts.
    holds_view: bool,
}

/// A user action on a point.
enum HandleAction {
    Move(DVec2, bool),
    Remove,
}

impl HandleEditor {
    pub(super) fn select(&mut self, index: usize) {
        self.selected = Some(index);
    }

    pub(super) fn select_none(&mut self) {
        self.selected = None;
    }

    pub(super) fn paint_polygon(
        form: &Form<'_>,
        ui: &Ui,
        painter: &egui::Painter,
        plane: &Plane,
        points: &[DVec2],
    ) {
        let profile = &form.scene.profile;
        if profile.control_points.is_none() {
            return;
        }
        let again = points.first().filter(|_| profile.closed.is_some());
        let line = points.iter().chain(again).map(|&p| plane.to_screen(p)).collect();
        let colour = ui.visuals().weak_text_color();
        painter.line(line, Stroke::new(1.0, colour));
    }

    /// Shows the points and applies the user's action on one of them.
    pub(super) fn show(
        &mut self,
        form: &mut Form<'_>,
        ui: &Ui,
        painter: &egui::Painter,
        plane: &Plane,
        points: &[DVec2],
        view: &mut PlaneView,
    ) {
        self.selected = self.selected.filter(|&index| index < points.len());
        let mut action = None;
        for (index, &point) in points.iter().enumerate() {
            let id = form.id("point").with(index);
            let place = plane.to_screen(point);
            let is_held = ui.ctx().is_being_dragged(id);
            if !plane.rect.contains(place) && !is_held {
                continue;
            }
            let rect = Rect::from_center_size(place, vec2(REACH, REACH));
            let response = ui.interact(rect, id, Sense::click_and_drag());
            let kind =
                if form.scene.profile.control_points.is_some() { "control point" } else { "point" };
            response.widget_info(|| {
                let name = format!("{kind} {}", index + 1);
                egui::WidgetInfo::labeled(egui::accesskit::Role::GraphicsObject, true, name)
            });
            self.paint(ui, painter, place, &response, index);
            if let Some(done) = self.action(ui, &response, plane, view, index, point) {
                action = Some((index, done, id));
            }
        }
        if let Some((index, action, id)) = action {
            self.apply(form, index, &action, id);
        }
    }

    /// Applies an action on a point to the scene.
    fn apply(&mut self, form: &mut Form<'_>, index: usize, action: &HandleAction, id: Id) {
        let profile = &mut form.scene.profile;
        match action {
            &HandleAction::Move(point, ongoing) => {
                if let Some(moved) = handles_mut(profile).and_then(|p| p.get_mut(index)) {
                    *moved = point.into();
                    form.record("move point", id, ongoing);
                }
            }
            HandleAction::Remove => {
                if remove_handle(profile, index) {
                    self.selected = None;
                    form.record("remove point", id, false);
                }
            }
        }
    }

    fn paint(
        &self,
        ui: &Ui,
        painter: &egui::Painter,
        place: egui::Pos2,
        response: &Response,
        index: usize,
    ) {
        let is_selected = self.selected == Some(index);
        let visuals = ui.visuals();
        let fill = if is_selected { visuals.selection.bg_fill } else { visuals.extreme_bg_color };
        let lively = is_selected || response.hovered() || response.dragged();
        let stroke = if lively {
            Stroke::new(2.0, visuals.strong_text_color())
        } else {
            Stroke::new(1.4, visuals.text_color())
        };
        painter.circle(place, if lively { 5.0 } else { 4.0 }, fill, stroke);
    }

    /// The user's action on a point in this frame.
    fn action(
        &mut self,
        ui: &Ui,
        response: &Response,
        plane: &Plane,
        view: &mut PlaneView,
        index: usize,
        point: DVec2,
    ) -> Option<HandleAction> {
        if response.clicked() || response.drag_started_by(PointerButton::Primary) {
            self.selected = Some(index);
            response.request_focus();
        }
        if response.gained_focus() {
            self.selected = Some(index);
        }
        if response.drag_started_by(PointerButton::Primary) {
            self.origin = Some(point);
            self.holds_view = view.is_fitted();
            view.pin(plane);
        }
        if response.drag_stopped() && std::mem::take(&mut self.holds_view) {
            view.fit();
        }
        if response.secondary_clicked() {
            return Some(HandleAction::Remove);
        }
        if response.dragged_by(PointerButton::Primary) {
            let way = response.total_drag_delta().unwrap_or(Vec2::ZERO);
            let moved = rounded_on(plane, self.origin.unwrap_or(point) + plane.vector(way));
            return (moved != point).then_some(HandleAction::Move(moved, true));
        }
        if response.has_focus() && self.selected == Some(index) {
            return key_action(ui, response, plane, point);
        }
        None
    }

    /// Number fields with the coordinates of the selected point.
    pub(super) fn show_fields(&mut self, form: &mut Form<'_>, ui: &mut Ui) {
        let Some(index) = self.selected else {
            let text =
                "Drag points to move them. Double-click adds a point, right-click removes it.";
            ui.add(egui::Label::new(super::form::note(ui, text)).wrap());
            return;
        };
        let Some(&[x, z]) = super::curve::handles(&form.scene.profile).and_then(|p| p.get(index))
        else {
            return;
        };
        let number =
            Number::within(-1e6..=1e6).speed(round_step((x.abs().max(z.abs()) / 500.0).max(1e-3)));
        form.scope(ui, "selected point", |form, ui| {
            ui.horizontal(|ui| {
                super::form::name(ui, &format!("point {}", index + 1), "The selected point");
                let width = ((ui.available_width() - 50.0) / 2.0).max(40.0);
                let mut place = [x, z];
                for (axis, name) in ["x", "z"].into_iter().enumerate() {
                    ui.label(name);
                    let spoken = format!("point {name}");
                    let cell =
                        form.required_cell(ui, "move point", &spoken, &number, width, place[axis]);
                    if let Some(new) = cell {
                        place[axis] = new;
                    }
                }
                let given = handles_mut(&mut form.scene.profile).and_then(|p| p.get_mut(index));
                if let Some(given) = given {
                    *given = place;
                }
            });
        });
    }
}

/// The action of a key press: arrow keys move the point, ten times as far with Shift; Delete and Backspace remove it.
fn key_action(ui: &Ui, response: &Response, plane: &Plane, point: DVec2) -> Option<HandleAction> {
    let filter =
        EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    let step = round_step(1.0 / plane.scale);
    let mut way = DVec2::ZERO;
    let mut removes = false;
    ui.input(|input| {
        for event in &input.events {
            let Event::Key { key, pressed: true, modifiers, .. } = event else {
                continue;
            };
            let step = if modifiers.shift { 10.0 * step } else { step };
            match key {
                Key::ArrowLeft => way.x -= step,
                Key::ArrowRight => way.x += step,
                Key::ArrowDown => way.y -= step,
                Key::ArrowUp => way.y += step,
                Key::Delete | Key::Backspace => removes = true,
                _ => {}
            }
        }
    });
    if removes {
        return Some(HandleAction::Remove);
    }
    let moved = (point + way) / step * 1e3;
    let moved = moved.round() / 1e3 * step;
    (way != DVec2::ZERO).then_some(HandleAction::Move(moved, true))
}

/// Rounds a point to a decimal place too small to see on the screen.
pub(super) fn rounded_on(plane: &Plane, point: DVec2) -> DVec2 {
    super::curve::rounded(point, 2e3 / plane.scale)
}
