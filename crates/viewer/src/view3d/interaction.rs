//! Mouse and keyboard in the view: turning, moving, zooming, and pulling a vertex.

use eframe::egui::{self, EventFilter, Key, PointerButton, Pos2, Rect, Response, StrokeKind, Ui};
use glam::{DVec2, DVec3};

use super::pick::Hit;
use super::picture::{Picture, VertexPull};
use super::projection::Projection;
use super::{View3d, ViewResponse};

/// Degrees per point of a drag.
const DEGREES_PER_POINT: f64 = 0.4;

/// Degrees per press of an arrow key.
const DEGREES_PER_KEY: f64 = 5.0;

/// Zoom factor per press of plus or minus.
const ZOOM_PER_KEY: f64 = 1.2;

/// Logarithm of the zoom factor per point of scrolling.
const LOG_ZOOM_PER_POINT: f64 = 1.0 / 200.0;

/// The longest duration of a frame that a camera transition takes into account, seconds.
const LONGEST_FRAME: f32 = 0.05;

/// The size of `rect` in points.
pub(super) fn size(rect: Rect) -> DVec2 {
    DVec2::new(f64::from(rect.width()), f64::from(rect.height()))
}

/// `at` in points from the upper left corner of `rect`.
pub(super) fn within(rect: Rect, at: Pos2) -> DVec2 {
    let at = at - rect.min;
    DVec2::new(f64::from(at.x), f64::from(at.y))
}

impl View3d {
    /// Moves the camera as the user asks, and continues a transition.
    pub(super) fn move_camera(
        &mut self,
        ui: &Ui,
        response: &Response,
        rect: Rect,
        picture: &Picture<'_>,
    ) {
        if response.clicked() || response.drag_started() {
            response.request_focus();
        }
        if response.double_clicked() && self.is_drawable(picture) {
            self.fit(picture.positions.to_vec());
        }
        let before = self.orbit;
        if self.pulled.is_none() {
            self.drag(ui, response, rect);
        }
        self.scroll(ui, response, rect);
        self.press_keys(ui, response);
        if self.orbit != before {
            self.transition = None;
        }
        self.apply_pending_fit(rect);
        self.step_transition(ui);
    }

    fn drag(&mut self, ui: &Ui, response: &Response, rect: Rect) {
        let by = response.drag_delta();
        let by = DVec2::new(f64::from(by.x), f64::from(by.y));
        let is_shifted = ui.input(|input| input.modifiers.shift);
        let pans = response.dragged_by(PointerButton::Secondary)
            || response.dragged_by(PointerButton::Middle)
            || (response.dragged_by(PointerButton::Primary) && is_shifted);
        if pans {
            let length = self.orbit.width / f64::from(rect.width());
            self.orbit.pan(DVec2::new(by.x, -by.y) * length);
        } else if response.dragged_by(PointerButton::Primary) && !response.drag_started() {
            // In the frame in which a drag begins it is not yet known whether it pulls a vertex.
            let [azimuth, elevation] = [-by.x, by.y].map(|points| points * DEGREES_PER_POINT);
            self.orbit.turn(azimuth, elevation, self.pivot);
        }
    }

    fn scroll(&mut self, ui: &Ui, response: &Response, rect: Rect) {
        let Some(at) = response.hover_pos() else {
            return;
        };
        let (scroll, pinch) = ui.input(|i| (i.smooth_scroll_delta.y, i.zoom_delta()));
        let factor = f64::from(pinch) * (f64::from(scroll) * LOG_ZOOM_PER_POINT).exp();
        if factor != 1.0 {
            let length = self.orbit.width / f64::from(rect.width());
            let at = (within(rect, at) - 0.5 * size(rect)) * length;
            self.orbit.zoom(factor, DVec2::new(at.x, -at.y), self.widths());
        }
    }

    /// Arrow keys turn, and plus and minus zoom, while the view has the keyboard focus.
    fn press_keys(&mut self, ui: &Ui, response: &Response) {
        if !response.has_focus() {
            return;
        }
        let filter = EventFilter {
            horizontal_arrows: true,
            vertical_arrows: true,
            ..EventFilter::default()
        };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
        let pressed = |key| ui.input(|input| input.modifiers.is_none() && input.key_pressed(key));
        let turns = [
            (Key::ArrowLeft, [-1.0, 0.0]),
            (Key::ArrowRight, [1.0, 0.0]),
            (Key::ArrowUp, [0.0, 1.0]),
            (Key::ArrowDown, [0.0, -1.0]),
        ];
        for (_, by) in turns.iter().filter(|(key, _)| pressed(*key)) {
            let [azimuth, elevation] = by.map(|steps: f64| steps * DEGREES_PER_KEY);
            self.orbit.turn(azimuth, elevation, self.pivot);
        }
        let zooms = [
            (Key::Plus, ZOOM_PER_KEY),
            (Key::Equals, ZOOM_PER_KEY),
            (Key::Minus, 1.0 / ZOOM_PER_KEY),
        ];
        for (_, factor) in zooms.iter().filter(|(key, _)| pressed(*key)) {
            self.orbit.zoom(*factor, DVec2::ZERO, self.widths());
        }
    }

    /// Fits the pending points: immediately the first time, later in a transition.
    fn apply_pending_fit(&mut self, rect: Rect) {
        let Some(points) = self.pending_fit.take() else {
            return;
        };
        let mut to = self.orbit();
        to.fit(points, size(rect));
        if self.was_shown {
            self.move_to(to);
        } else {
            self.set_orbit(to);
        }
    }

    /// Advances the camera transition and requests the next frame.
    fn step_transition(&mut self, ui: &Ui) {
        if let Some(transition) = &mut self.transition {
            let seconds = ui.input(|input| input.stable_dt).min(LONGEST_FRAME);
            let (orbit, has_arrived) = transition.step(f64::from(seconds));
            self.orbit = orbit;
            if has_arrived {
                self.transition = None;
            }
            ui.ctx().request_repaint();
        }
    }

    /// Finds what is under the pointer, and handles pulling a vertex.
    pub(super) fn pick(
        &mut self,
        ui: &Ui,
        response: &Response,
        rect: Rect,
        picture: &Picture<'_>,
        projection: &Projection,
    ) -> ViewResponse {
        let pointer = response.hover_pos().filter(|_| !response.dragged());
        self.points.follow(picture, projection);
        let hit = self.hit(picture, pointer.map(|at| within(rect, at)));
        self.update_pulled_vertex(ui, response, rect, picture);
        let pull = self.pull(response, rect, picture, projection);
        let vertex = hit.vertex;
        self.mark(ui, response, rect, vertex.filter(|_| picture.can_pull));
        ViewResponse { vertex, face: hit.face, pull }
    }

    fn hit(&self, picture: &Picture<'_>, at: Option<DVec2>) -> Hit {
        match (&self.prepared, at) {
            (Some(prepared), Some(at)) => self.points.hit(picture, prepared, at),
            _ => Hit::default(),
        }
    }

    /// Grabs a vertex where a drag begins and releases it where the drag ends.
    fn update_pulled_vertex(
        &mut self,
        ui: &Ui,
        response: &Response,
        rect: Rect,
        picture: &Picture<'_>,
    ) {
        let is_held = response.dragged_by(PointerButton::Primary) && picture.can_pull;
        if !is_held {
            self.pulled = None;
        } else if response.drag_started() && !ui.input(|input| input.modifiers.shift) {
            let origin = ui.input(|input| input.pointer.press_origin());
            let hit = self.hit(picture, origin.map(|at| within(rect, at)));
            self.pulled = hit.vertex;
        }
    }

    fn pull(
        &self,
        response: &Response,
        rect: Rect,
        picture: &Picture<'_>,
        projection: &Projection,
    ) -> Option<VertexPull> {
        let vertex = self.pulled?;
        let at = response.interact_pointer_pos()?;
        let place: DVec3 = *picture.positions.get(vertex as usize)?;
        Some(VertexPull { vertex, target: projection.beside(place, within(rect, at)) })
    }

    /// Marks the vertex that can be grabbed, and the view if it has the keyboard focus.
    fn mark(&self, ui: &Ui, response: &Response, rect: Rect, vertex: Option<u32>) {
        let stroke = egui::Stroke::new(1.0, ui.visuals().hyperlink_color);
        if let Some(at) = vertex.and_then(|vertex| self.points.at(vertex)) {
            let at = rect.min + egui::vec2(at.x as f32, at.y as f32);
            ui.painter_at(rect).circle_stroke(at, 6.0, (2.0, stroke.color));
            ui.set_cursor_icon(egui::CursorIcon::Grab);
        }
        if response.has_focus() {
            ui.painter().rect_stroke(rect, 0.0, stroke, StrokeKind::Inside);
        }
    }
}
