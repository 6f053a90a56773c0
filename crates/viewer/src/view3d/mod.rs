//! The 3D view of the sheet: camera, drawing on the GPU, picking.
//!
//! A picture is drawn only when something has changed, so an idle window uses no processor time. Without a GPU, or if
//! it fails, egui's painter draws a simpler picture.

mod creases;
mod fallback;
mod gpu;
mod interaction;
mod orbit_camera;
mod paints;
mod pick;
mod picture;
mod prepared;
mod projection;
mod segments;
#[cfg(test)]
mod tests;

use eframe::egui::emath::GuiRounding as _;
use eframe::egui::{self, Color32, Rect, Response, Role, Sense, TextureId, Ui, pos2};
use eframe::egui_wgpu::RenderState;
use foldmotion_record::View;
use glam::DVec3;

use self::fallback::FallbackRenderer;
use self::gpu::{Gpu, LossMonitor};
use self::orbit_camera::CameraTransition;
use self::pick::ProjectedVertices;
use self::prepared::PreparedSheet;
use self::projection::Projection;

pub(crate) use self::creases::CreaseClasses;
pub(crate) use self::orbit_camera::OrbitCamera;
pub(crate) use self::picture::{Colours, Overlay, Picture, Shape, VertexPull};

/// The number of times that drawing is tried again on one device.
const TRIES: u32 = 3;

/// The 3D view of a window.
#[derive(Default)]
pub(crate) struct View3d {
    id: Option<egui::Id>,
    orbit: OrbitCamera,
    transition: Option<CameraTransition>,
    /// Points to fit once the size of the view is known.
    pending_fit: Option<Vec<DVec3>>,
    /// The centre of the sheet, around which the view turns.
    pivot: DVec3,
    was_shown: bool,
    prepared: Option<PreparedSheet>,
    points: ProjectedVertices,
    /// The vertex that is being pulled.
    pulled: Option<u32>,
    fallback: FallbackRenderer,
    gpu: Option<Gpu>,
    monitor: Option<LossMonitor>,
    failures: u32,
    error: Option<String>,
}

/// What is under the pointer, and what the user does in the view.
#[derive(Debug, Default)]
pub(crate) struct ViewResponse {
    /// The vertex under the pointer: within 12 points and not hidden by the sheet.
    pub(crate) vertex: Option<u32>,
    /// The triangle under the pointer.
    pub(crate) face: Option<u32>,
    /// The vertex that is being pulled, with its target in the plane through it parallel to the screen.
    pub(crate) pull: Option<VertexPull>,
}

impl View3d {
    /// The id of the view, to test for the keyboard focus; `None` before it was shown.
    pub(crate) fn id(&self) -> Option<egui::Id> {
        self.id
    }

    /// The camera; during a transition, the camera at its end.
    pub(crate) fn orbit(&self) -> OrbitCamera {
        self.transition.as_ref().map_or(self.orbit, CameraTransition::end)
    }

    /// Sets the camera without a transition.
    pub(crate) fn set_orbit(&mut self, orbit: OrbitCamera) {
        self.orbit = orbit;
        self.transition = None;
        self.was_shown = true;
    }

    /// Moves the camera by `displacement`, together with a sheet that is now shown elsewhere.
    pub(crate) fn translate(&mut self, displacement: DVec3) {
        let orbit = self.orbit();
        self.set_orbit(OrbitCamera { centre: orbit.centre + displacement, ..orbit });
    }

    /// Turns to one of the standard views, see [`View::NAMES`].
    pub(crate) fn look(&mut self, view: View) {
        let mut to = self.orbit();
        to.set_view(view, self.pivot);
        self.move_to(to);
    }

    /// Switches between perspective and parallel projection.
    pub(crate) fn set_perspective(&mut self, perspective: bool) {
        self.orbit.perspective = perspective;
        let to = OrbitCamera { perspective, ..self.orbit() };
        self.move_to(to);
    }

    /// Shows all `points` as large as possible.
    pub(crate) fn fit(&mut self, points: Vec<DVec3>) {
        self.pending_fit = Some(points);
    }

    /// The number of pictures that the GPU has drawn.
    pub(crate) fn drawn(&self) -> u64 {
        self.gpu.as_ref().map_or(0, |gpu| gpu.count)
    }

    /// Why the GPU does not draw, if it should.
    pub(crate) fn error(&self) -> Option<&str> {
        self.error.as_deref()
    }

    fn move_to(&mut self, to: OrbitCamera) {
        self.transition = (to != self.orbit).then(|| CameraTransition::new(self.orbit, to));
    }

    /// The smallest and the largest width of the view.
    fn widths(&self) -> [f64; 2] {
        let radius = self.prepared.as_ref().map_or(1.0, |prepared| prepared.sphere.radius);
        [1e-3, 1e2].map(|part| part * radius.max(f64::MIN_POSITIVE))
    }

    /// Shows `picture` in the whole area of `ui`. `render_state` is that of the window; `None` draws without a GPU.
    pub(crate) fn show(
        &mut self,
        ui: &mut Ui,
        render_state: Option<&RenderState>,
        picture: &Picture<'_>,
    ) -> ViewResponse {
        let size = ui.available_size().max(egui::Vec2::splat(1.0));
        let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
        let rect = rect.round_to_pixels(ui.pixels_per_point());
        name(&response, &self.orbit());
        self.id = Some(response.id);
        self.follow(picture);
        let size = interaction::size(rect);
        self.move_camera(ui, &response, rect, picture);
        let sphere = self.prepared.as_ref().map(|prepared| prepared.sphere);
        let overlays = segments::segments(picture);
        let ends = overlays.iter().flat_map(|segment| segment.ends);
        let sphere = sphere.unwrap_or_else(|| projection::Sphere::around([])).with(ends);
        let projection = Projection::new(&self.orbit, size, sphere);
        ui.painter().rect_filled(rect, 0.0, picture.background);
        if !self.is_drawable(picture) {
            return ViewResponse::default();
        }
        if let Some(texture) = self.texture(ui, render_state, picture, &projection, rect) {
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            ui.painter().image(texture, rect, whole, Color32::WHITE);
        } else {
            let painter = ui.painter_at(rect);
            self.fallback.paint(&painter, rect, picture, &projection, self.prepared.as_ref());
            self.note(ui, rect, render_state.is_some());
        }
        self.pick(ui, &response, rect, picture, &projection)
    }

    fn is_drawable(&self, picture: &Picture<'_>) -> bool {
        picture.is_whole() && self.prepared.as_ref().is_some_and(|prepared| prepared.is_finite)
    }

    /// Updates what is derived from the sheet and its state.
    fn follow(&mut self, picture: &Picture<'_>) {
        match &mut self.prepared {
            Some(prepared) => {
                prepared.follow(picture);
            }
            None => self.prepared = Some(PreparedSheet::new(picture)),
        }
        if self.is_drawable(picture) {
            self.pivot =
                self.prepared.as_ref().map_or(self.pivot, |prepared| prepared.sphere.middle);
            if !self.was_shown {
                self.pending_fit = Some(picture.positions.to_vec());
            }
        }
    }

    /// The texture that the GPU drew; `None` without a GPU.
    fn texture(
        &mut self,
        ui: &Ui,
        render_state: Option<&RenderState>,
        picture: &Picture<'_>,
        projection: &Projection,
        rect: Rect,
    ) -> Option<TextureId> {
        let render_state = render_state?;
        let monitor = self.monitor.take().filter(|w| w.monitors(render_state));
        let monitor = monitor.unwrap_or_else(|| {
            // This is another device, for example after a loss, so everything is created again.
            self.gpu = None;
            self.failures = 0;
            LossMonitor::new(render_state)
        });
        let loss = monitor.loss();
        self.monitor = Some(monitor);
        if self.failures > TRIES {
            return None;
        }
        let drawn = match loss {
            // Nothing is drawn on this device again.
            Some(reason) => {
                self.failures = TRIES;
                Err(reason)
            }
            None => self.drawn_by_gpu(ui, render_state, picture, projection, rect),
        };
        match drawn {
            Ok(texture) => {
                self.error = None;
                Some(texture)
            }
            Err(reason) => {
                self.gpu = None;
                self.failures += 1;
                self.error = Some(reason);
                ui.ctx().request_repaint();
                None
            }
        }
    }

    fn drawn_by_gpu(
        &mut self,
        ui: &Ui,
        render_state: &RenderState,
        picture: &Picture<'_>,
        projection: &Projection,
        rect: Rect,
    ) -> Result<TextureId, String> {
        let gpu = match self.gpu.take() {
            Some(gpu) => gpu,
            None => Gpu::new(render_state)?,
        };
        let gpu = self.gpu.insert(gpu);
        let prepared = self.prepared.as_ref().ok_or("the sheet is not prepared")?;
        let most = render_state.device.limits().max_texture_dimension_2d as f32;
        let wanted = rect.size() * ui.pixels_per_point();
        let part = (most / wanted.max_elem()).min(1.0);
        let view = gpu::FrameView {
            projection,
            prepared,
            size: [wanted.x, wanted.y].map(|side| pixels(side * part)),
            pixels_per_point: ui.pixels_per_point() * part,
        };
        gpu.show(picture, &view)
    }

    /// Says why the picture is a simpler one.
    fn note(&self, ui: &Ui, rect: Rect, has_gpu: bool) {
        let text = match &self.error {
            Some(reason) if has_gpu => format!("drawn without the GPU: {reason}"),
            _ => "drawn without a GPU".to_owned(),
        };
        let colour = ui.visuals().weak_text_color();
        let font = egui::TextStyle::Small.resolve(ui.style());
        let at = rect.left_bottom() + egui::vec2(8.0, -8.0);
        let painter = ui.painter_at(rect);
        let galley = painter.layout(text, font, colour, (rect.width() - 16.0).max(1.0));
        painter.galley(at - egui::vec2(0.0, galley.size().y), galley, colour);
    }
}

/// A length in whole pixels, at least one.
#[expect(clippy::cast_sign_loss, reason = "at least 1 before")]
fn pixels(side: f32) -> u32 {
    side.round().max(1.0) as u32
}

/// Describes the view and its camera to assistive technology.
fn name(response: &Response, orbit: &OrbitCamera) {
    response.widget_info(|| {
        let from = format!(
            "from azimuth {:.0}°, elevation {:.0}°, {:.2} wide{}",
            orbit.azimuth,
            orbit.elevation,
            orbit.width,
            if orbit.perspective { ", in perspective" } else { "" }
        );
        egui::WidgetInfo {
            current_text_value: Some(from),
            ..egui::WidgetInfo::labeled(Role::Canvas, true, "3D view")
        }
    });
}
