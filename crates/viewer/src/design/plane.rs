//! A view of a plane with equal scales on both axes. The wheel zooms; dragging with the right button moves.

use eframe::egui::{self, Align2, Color32, FontId, Pos2, Rect, Response, Stroke, Ui, pos2, vec2};
use glam::DVec2;

use super::number::short;

/// The smallest distance between grid lines, points.
const GRID_PITCH: f64 = 36.0;
/// The largest zoom factor relative to the fitted view.
const ZOOM: f64 = 1e4;
/// Margin around the fitted contents, points.
const MARGIN: f32 = 22.0;

/// Where the plane is shown on the screen. The second axis points up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Plane {
    pub(super) rect: Rect,
    pub(super) centre: DVec2,
    /// Points on the screen per unit of length.
    pub(super) scale: f64,
}

impl Plane {
    /// The plane in which the box from `low` to `high` fills `rect`.
    fn fitted(rect: Rect, [low, high]: [DVec2; 2]) -> Self {
        let room = rect.shrink(MARGIN.min(rect.size().min_elem() / 4.0)).size();
        let size = (high - low)
            .max(DVec2::splat(1e-9 * (low.abs().max(high.abs()).max_element() + 1e-90)));
        let scale = (f64::from(room.x) / size.x).min(f64::from(room.y) / size.y);
        Self { rect, centre: low.midpoint(high), scale: scale.clamp(1e-99, 1e99) }
    }

    /// The position of a point on the screen, clamped to coordinates that can be drawn.
    pub(super) fn to_screen(self, point: DVec2) -> Pos2 {
        let offset = (point - self.centre) * self.scale;
        let kept = |x: f64| {
            if x.is_nan() { 0.0 } else { x.clamp(-1e4, 1e4) as f32 }
        };
        self.rect.center() + vec2(kept(offset.x), -kept(offset.y))
    }

    /// The point at a position on the screen.
    pub(super) fn to_plane(self, place: Pos2) -> DVec2 {
        let offset = place - self.rect.center();
        self.centre + self.vector(offset)
    }

    /// A displacement on the screen, in units of the plane.
    pub(super) fn vector(&self, way: egui::Vec2) -> DVec2 {
        DVec2::new(f64::from(way.x), -f64::from(way.y)) / self.scale
    }

    /// Draws a labelled grid whose lines are 1, 2 or 5 times a power of ten apart, with stronger axes.
    pub(super) fn paint_grid(&self, ui: &Ui, painter: &egui::Painter) {
        let step = round_step(GRID_PITCH / self.scale);
        let weak = ui.visuals().weak_text_color().gamma_multiply(0.25);
        let font = FontId::proportional(9.0);
        let text = ui.visuals().weak_text_color();
        let write = |place: Pos2, value: f64| {
            let label = label(value, step);
            painter.text(place, Align2::LEFT_BOTTOM, label, font.clone(), text);
        };
        let (low, high) =
            (self.to_plane(self.rect.left_bottom()), self.to_plane(self.rect.right_top()));
        let lines = |low: f64, high: f64| {
            let first = (low / step).ceil();
            (0..200).map(move |k| (first + f64::from(k)) * step).take_while(move |&x| x <= high)
        };
        let stroke = |at: f64| {
            let width = if at.abs() < step / 2.0 { 1.6 } else { 0.8 };
            Stroke::new(width, weak)
        };
        for x in lines(low.x, high.x) {
            let at = self.to_screen(DVec2::new(x, self.centre.y)).x;
            painter.vline(at, self.rect.y_range(), stroke(x));
            let place = pos2(at + 2.0, self.rect.bottom() - 1.0);
            write(place, x);
        }
        for z in lines(low.y, high.y) {
            let at = self.to_screen(DVec2::new(self.centre.x, z)).y;
            painter.hline(self.rect.x_range(), at, stroke(z));
            if at < self.rect.bottom() - 14.0 {
                let place = pos2(self.rect.left() + 2.0, at);
                write(place, z);
            }
        }
    }
}

fn label(at: f64, step: f64) -> String {
    if at.abs() < step / 2.0 { "0".to_owned() } else { short(at) }
}

/// The smallest number that is 1, 2 or 5 times a power of ten and not less than `least`.
pub(super) fn round_step(least: f64) -> f64 {
    let power = 10.0_f64.powf(least.max(1e-99).log10().floor());
    [1.0, 2.0, 5.0]
        .into_iter()
        .map(|factor| factor * power)
        .find(|&step| step >= least)
        .unwrap_or(10.0 * power)
}

/// The bounding box of points; a box around the origin if there are none.
pub(super) fn bounds(points: impl IntoIterator<Item = DVec2>) -> [DVec2; 2] {
    let start = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    let [low, high] = points
        .into_iter()
        .filter(|p| p.is_finite())
        .fold(start, |[low, high], p| [low.min(p), high.max(p)]);
    if low.x <= high.x { [low, high] } else { [DVec2::splat(-1.0), DVec2::splat(1.0)] }
}

/// The view that the user has chosen; until then, the view that fits the contents.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct PlaneView {
    chosen: Option<(DVec2, f64)>,
}

impl PlaneView {
    /// Returns to the view that fits the contents.
    pub(super) fn fit(&mut self) {
        self.chosen = None;
    }

    pub(super) fn is_fitted(&self) -> bool {
        self.chosen.is_none()
    }

    /// Keeps the view as it is, whatever the contents become.
    pub(super) fn pin(&mut self, plane: &Plane) {
        self.chosen = Some((plane.centre, plane.scale));
    }

    /// The plane in this frame, after zooming and moving.
    pub(super) fn plane(&mut self, ui: &Ui, response: &Response, bounds: [DVec2; 2]) -> Plane {
        let rect = response.rect;
        let fitted = Plane::fitted(rect, bounds);
        let mut plane = match self.chosen {
            Some((centre, scale)) => Plane { rect, centre, scale },
            None => fitted,
        };
        let moves = [egui::PointerButton::Secondary, egui::PointerButton::Middle];
        if moves.into_iter().any(|button| response.dragged_by(button)) {
            plane.centre -= plane.vector(response.drag_delta());
            self.pin(&plane);
        }
        if let Some(place) = response.hover_pos().filter(|_| response.contains_pointer()) {
            let factor = consume_zoom(ui);
            if factor != 1.0 {
                let scale = (plane.scale * factor).clamp(fitted.scale / ZOOM, fitted.scale * ZOOM);
                let fixed = plane.to_plane(place);
                plane.scale = scale;
                plane.centre += fixed - plane.to_plane(place);
                self.pin(&plane);
            }
        }
        plane
    }
}

/// The zoom factor of the wheel in this frame, which is then not used for scrolling.
fn consume_zoom(ui: &Ui) -> f64 {
    ui.input_mut(|input| {
        let scrolled = std::mem::take(&mut input.smooth_scroll_delta).y;
        f64::from(input.zoom_delta() * (scrolled * 0.004).exp())
    })
}

/// Writes a short message at the top of a canvas.
pub(super) fn message(ui: &Ui, painter: &egui::Painter, plane: &Plane, text: &str) {
    let place = plane.rect.center_top() + vec2(0.0, 4.0);
    let font = FontId::proportional(11.0);
    let colour = ui.visuals().weak_text_color();
    painter.text(place, Align2::CENTER_TOP, text, font, colour);
}

/// A frame with a background to draw in.
pub(super) fn canvas(ui: &mut Ui, height: f32, name: &str) -> (Response, egui::Painter) {
    let size = vec2(ui.available_width(), height);
    let (rect, response) = ui.allocate_exact_size(size, egui::Sense::click_and_drag());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Canvas, true, name));
    let painter = ui.painter_at(rect);
    let edge = ui.visuals().widgets.noninteractive.bg_stroke;
    painter.rect(rect, 3.0, ui.visuals().extreme_bg_color, edge, egui::StrokeKind::Inside);
    (response, painter)
}

/// Red for mountains and blue for valleys, as in the paper, legible on dark and light backgrounds.
pub(super) fn crease_colours(ui: &Ui) -> [Color32; 2] {
    if ui.visuals().dark_mode {
        [Color32::from_rgb(255, 105, 97), Color32::from_rgb(105, 170, 255)]
    } else {
        [Color32::from_rgb(200, 30, 30), Color32::from_rgb(30, 80, 200)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plane() -> Plane {
        let rect = Rect::from_min_size(pos2(10.0, 20.0), vec2(300.0, 200.0));
        Plane::fitted(rect, [DVec2::new(-3.0, 0.0), DVec2::new(3.0, 2.0)])
    }

    #[test]
    fn the_screen_and_the_plane_are_inverse_and_z_points_up() {
        let plane = plane();
        let point = DVec2::new(1.25, 0.5);
        let back = plane.to_plane(plane.to_screen(point));
        assert!(back.distance(point) < 1e-5, "{back}");
        assert!(plane.to_screen(DVec2::new(0.0, 1.0)).y < plane.to_screen(DVec2::ZERO).y);
    }

    #[test]
    fn what_is_fitted_lies_inside() {
        let plane = plane();
        for point in [DVec2::new(-3.0, 0.0), DVec2::new(3.0, 2.0)] {
            assert!(plane.rect.contains(plane.to_screen(point)));
        }
    }

    #[test]
    fn steps_of_grids_are_1_2_or_5_times_a_power_of_ten() {
        for (least, step) in [(0.9, 1.0), (1.1, 2.0), (2.1, 5.0), (5.1, 10.0), (0.03, 0.05)] {
            assert!((round_step(least) / step - 1.0).abs() < 1e-12, "{least}");
        }
    }

    #[test]
    fn points_that_are_not_finite_have_a_position() {
        let plane = plane();
        for x in [f64::NAN, f64::INFINITY, -1e100] {
            let place = plane.to_screen(DVec2::new(x, 0.0));
            assert!(place.x.is_finite() && place.y.is_finite());
        }
        assert_eq!(bounds([DVec2::NAN]), [DVec2::splat(-1.0), DVec2::splat(1.0)]);
        for size in [0.0, 1e-100, 1e100] {
            let fitted = Plane::fitted(plane.rect, [DVec2::splat(-size), DVec2::splat(size)]);
            assert!(fitted.scale.is_finite() && fitted.scale > 0.0);
        }
    }
}
