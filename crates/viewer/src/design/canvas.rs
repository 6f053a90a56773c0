//! The profile canvas: the curve Γ, its division, and the points that shape it, which can be dragged.

use eframe::egui::{self, Stroke, Ui};
use foldmotion_geometry::Profile;
use foldmotion_study::scene::ProfileScene;
use foldmotion_study::{Draft, UnitDraft};
use glam::DVec2;

use super::curve::{add_handle, handles, own_profile, vectors};
use super::form::Form;
use super::handle_editor::{HandleEditor, MAX_HANDLES, rounded_on};
use super::plane::{Plane, PlaneView, bounds, canvas, message};

/// Number of points at which the curve is sampled for drawing.
const SAMPLES: usize = 600;
/// The largest number of division points that are drawn.
const MAX_DIVISION_POINTS: usize = 2000;

/// State of the canvas that lasts from frame to frame.
#[derive(Debug, Default)]
pub(super) struct Canvas {
    pub(super) view: PlaneView,
    pub(super) handle_editor: HandleEditor,
    traced: Option<SampledCurve>,
}

/// The sampled curve that was drawn last, and what it was sampled from.
#[derive(Debug)]
struct SampledCurve {
    scene: ProfileScene,
    /// The number of the draft that the curve comes from, if the scene alone does not define the curve.
    draft_number: Option<u64>,
    profile: Option<Profile>,
    points: Vec<DVec2>,
}

impl SampledCurve {
    fn new(form: &Form<'_>) -> Self {
        let scene = &form.scene.profile;
        let from_file = scene.file.is_some();
        let profile = if from_file {
            form.draft.and_then(Draft::units).map(|draft| draft.profile.clone())
        } else {
            own_profile(scene)
        };
        let sample = |profile: &Profile| {
            let at = |k: usize| profile.position(k as f64 / SAMPLES as f64);
            (0..=SAMPLES).map(at).collect()
        };
        Self {
            scene: scene.clone(),
            draft_number: from_file.then_some(form.draft_number),
            points: profile.as_ref().map(sample).unwrap_or_default(),
            profile,
        }
    }

    fn is_of(&self, form: &Form<'_>) -> bool {
        let profile = &form.scene.profile;
        let number = profile.file.is_some().then_some(form.draft_number);
        self.draft_number == number && self.scene == *profile
    }
}

impl Canvas {
    /// Shows the canvas and applies the user's edits to the form.
    pub(super) fn show(&mut self, form: &mut Form<'_>, ui: &mut Ui) {
        let traced = self.traced.as_ref();
        if traced.is_none_or(|traced| !traced.is_of(form)) {
            self.traced = Some(SampledCurve::new(form));
        }
        let points = handles(&form.scene.profile).map(|points| vectors(points)).unwrap_or_default();
        let curve = self.traced.as_ref().map(|traced| traced.points.as_slice()).unwrap_or_default();
        let size = bounds(curve.iter().chain(&points).copied());
        let is_bare = points.is_empty() && curve.is_empty();
        let height = (ui.available_width() * 0.66).clamp(170.0, 300.0);
        let (response, painter) = canvas(ui, height, "profile canvas");
        let plane = self.view.plane(ui, &response, size);
        plane.paint_grid(ui, &painter);
        self.paint_curve(form, ui, &painter, &plane);
        if points.len() > MAX_HANDLES {
            message(ui, &painter, &plane, "too many points to drag");
            return;
        }
        HandleEditor::paint_polygon(form, ui, &painter, &plane, &points);
        self.handle_editor.show(form, ui, &painter, &plane, &points, &mut self.view);
        self.add_point(form, &response, &plane, points.is_empty());
        if response.clicked() {
            self.handle_editor.select_none();
        }
        if is_bare {
            message(ui, &painter, &plane, "no curve yet");
        }
    }

    fn add_point(
        &mut self,
        form: &mut Form<'_>,
        response: &egui::Response,
        plane: &Plane,
        has_none: bool,
    ) {
        if has_none || !response.double_clicked() {
            return;
        }
        let Some(place) = response.interact_pointer_pos() else {
            return;
        };
        let place = rounded_on(plane, plane.to_plane(place));
        if let Some(index) = add_handle(&mut form.scene.profile, place) {
            self.handle_editor.select(index);
            form.record("add point", response.id, false);
        }
    }

    /// Draws the curve Γ with its division points and segments.
    fn paint_curve(&self, form: &Form<'_>, ui: &Ui, painter: &egui::Painter, plane: &Plane) {
        let Some(traced) = &self.traced else { return };
        let line = traced.points.iter().map(|&p| plane.to_screen(p)).collect();
        painter.line(line, Stroke::new(2.0, ui.visuals().text_color()));
        let draft = form.draft.and_then(Draft::units);
        let (Some(profile), Some(draft)) = (&traced.profile, draft) else {
            return;
        };
        let colour = ui.visuals().hyperlink_color;
        let chords = chords(profile, draft).map(|p| plane.to_screen(p));
        let chords: Vec<_> = chords.collect();
        let radius = if chords.len() > 60 { 1.8 } else { 2.5 };
        for place in &chords {
            painter.circle_filled(*place, radius, colour);
        }
        painter.line(chords, Stroke::new(1.2, colour));
    }
}

/// The points that divide the curve, in the units of the scene.
fn chords<'a>(profile: &'a Profile, draft: &'a UnitDraft) -> impl Iterator<Item = DVec2> + 'a {
    let parameters = draft.division.parameters.iter().take(MAX_DIVISION_POINTS);
    parameters.map(|&u| profile.position(u))
}
