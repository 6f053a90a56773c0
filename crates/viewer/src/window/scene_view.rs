//! The middle of the window: toolbar, sheet, and the text over it.

use std::sync::Arc;
use std::time::Duration;

use eframe::egui::accesskit::Role;
use eframe::egui::epaint::RectShape;
use eframe::egui::{
    Align2, Checkbox, Color32, ComboBox, FontId, Painter, Rect, RichText, ScrollArea, Sense,
    Stroke, StrokeKind, Ui, Vec2, WidgetInfo, pos2, vec2,
};
use eframe::egui_wgpu::RenderState;
use foldmotion_check::Verdict;
use foldmotion_pattern::{Facet, FacetKind, Sheet};
use foldmotion_record::{Style, colour_of};
use glam::{DMat3, DVec3};

use super::Viewer;
use super::shown_motion::{MotionSource, ShownMotion};
use crate::results::{outcome_colour, verdict_colour};
use crate::settings::{Colour, Command, keys_of, name_of};
use crate::timeline::number;
use crate::view3d::{Colours, CreaseClasses, Overlay, Picture, Shape, VertexPull};

/// Duration of a flash of penetrating facets, seconds.
const FLASH: f64 = 0.9;

impl Viewer {
    /// Shows the toolbar and the view.
    pub(super) fn scene_view(&mut self, ui: &mut Ui, render_state: Option<&RenderState>) {
        self.tools(ui);
        let Some(shown) = self.shown_motion() else {
            ui.centered_and_justified(|ui| {
                let words = if self.resolved.errors.is_empty() {
                    "…"
                } else {
                    "No sheet yet. See the status bar."
                };
                ui.label(RichText::new(words).weak());
            });
            return;
        };
        self.update_state(&shown);
        let rect = ui.available_rect_before_wrap();
        let pull = self.picture(ui, render_state, &shown);
        if pull != self.display.pulled
            && let Some(interaction) = &self.jobs.interaction
        {
            interaction.pull(pull.map(|pull| (pull.vertex, pull.target)));
        }
        self.display.pulled = pull;
        self.text_over_view(ui, rect, &shown);
    }

    /// The profile, the boxes and the points of penetration that are drawn over the sheet.
    fn overlays<'a>(
        &self,
        ui: &Ui,
        shown: &'a ShownMotion,
        penetrations: &'a [DVec3],
    ) -> Vec<Overlay<'a>> {
        let view = &self.settings.view;
        let visuals = ui.visuals();
        let (accent, weak) = (visuals.hyperlink_color, visuals.weak_text_color());
        let mut overlays = Vec::new();
        let mut add = |shape, colour, width| {
            overlays.push(Overlay { shape, colour, width });
        };
        // The profile is compared with the deployed sheet, the boxes with the compact one.
        let is_folding = self.playback.time > 1.0;
        if view.profile && !shown.profile.is_empty() && !is_folding {
            add(Shape::Path(&shown.profile), accent, 2.0);
        }
        for (wanted, bounds, colour) in [
            (view.compact_box, shown.boxes[0], weak),
            (view.closed_form_box, shown.boxes[1], accent),
        ] {
            if let Some([low, sides]) = bounds.filter(|_| wanted && is_folding) {
                let edges = DMat3::from_diagonal(sides);
                let edges = [edges.x_axis, edges.y_axis, edges.z_axis];
                add(Shape::Box(low, edges), colour, 1.2);
            }
        }
        if !penetrations.is_empty() {
            add(Shape::Dots(penetrations), visuals.error_fg_color, 9.0);
        }
        overlays
    }

    /// Draws the sheet; returns the vertex that is being pulled.
    fn picture(
        &mut self,
        ui: &mut Ui,
        render_state: Option<&RenderState>,
        shown: &ShownMotion,
    ) -> Option<VertexPull> {
        let (faces, points) = self.display.state.penetrating.clone();
        let overlays = self.overlays(ui, shown, &points);
        let view = &self.settings.view;
        let sheet = &shown.motion().sheet;
        let positions = Arc::clone(&self.display.state.positions);
        let state_key = self.display.state.key;
        let background = ui.visuals().panel_fill;
        let style = style(ui.visuals().dark_mode);
        let pulse = if faces.is_empty() { 0.0 } else { flash(ui) };
        let values = self.display.state.values(shown, sheet, view.colour);
        let colours = match (view.colour, values) {
            (_, Some((values, range, _))) => Colours::Values { values, range, key: state_key },
            (Colour::Unit, _) => Colours::Units,
            (Colour::Layer, _) => Colours::Layers,
            _ => Colours::Plain,
        };
        let creases = if view.creases { view.classes } else { CreaseClasses::NONE };
        let picture = Picture {
            sheet,
            sheet_key: shown.key,
            positions: &positions,
            state_key,
            layers: Some(&shown.layers),
            colours,
            creases,
            style: &style,
            background,
            overlays: &overlays,
            flash: &faces,
            pulse,
            pull: self.display.pulled,
            can_pull: self.jobs.interaction.is_some(),
        };
        let current = self.view3d.show(ui, render_state, &picture);
        self.display.pointed = current.face.map(|face| (face, current.vertex));
        current.pull
    }

    /// The text over the view: motion time, kind of motion and verdict.
    fn text_over_view(&mut self, ui: &Ui, rect: Rect, shown: &ShownMotion) {
        let painter = ui.painter_at(rect);
        let visuals = ui.visuals();
        let lines = self.lines_over_view(ui, shown);
        // The background is drawn first, but its size is only known once the text is laid out.
        let ground = painter.add(RectShape::filled(Rect::NOTHING, 0.0, Color32::TRANSPARENT));
        let mut area = Rect::from_min_size(rect.left_top() + vec2(12.0, 8.0), Vec2::ZERO);
        for (words, size, colour) in &lines {
            let font = FontId::proportional(*size);
            let room = (rect.width() - 24.0).max(1.0);
            let galley = painter.layout(words.clone(), font, *colour, room);
            let at = area.left_bottom() + vec2(0.0, 2.0);
            area |= Rect::from_min_size(at, galley.size());
            painter.galley(at, galley, *colour);
        }
        let colour = visuals.panel_fill.gamma_multiply(0.7);
        painter.set(ground, RectShape::filled(area.expand(4.0), 4.0, colour));
        ui.interact(area, ui.scope_id().with("words over"), Sense::hover()).widget_info(|| {
            let words: Vec<&str> = lines.iter().map(|line| line.0.as_str()).collect();
            WidgetInfo::labeled(Role::Label, true, words.join(", "))
        });
        let sheet = &shown.motion().sheet;
        if let Some(words) = self.pointed_text(sheet) {
            let corner = rect.left_bottom() + vec2(12.0, -10.0);
            let font = FontId::proportional(12.0);
            let colour = visuals.text_color();
            painter.text(corner, Align2::LEFT_BOTTOM, words, font, colour);
        }
        let colour = self.settings.view.colour;
        if let Some((_, range, title)) = self.display.state.values(shown, sheet, colour) {
            scale(&painter, ui, rect, range, title);
        }
    }

    fn pointed_text(&self, sheet: &Sheet) -> Option<String> {
        let (face, vertex) = self.display.pointed?;
        let facet = *sheet.face_facets.get(face as usize)?;
        let Facet { row, column, kind, .. } = sheet.facets.get(facet as usize)?;
        let place = match kind {
            FacetKind::Plain => String::new(),
            kind => format!(": {}, row {row}, column {column}", kind.name()),
        };
        let corner = vertex.map_or_else(String::new, |vertex| format!("; vertex {vertex}"));
        Some(format!("facet {facet}{place}{corner}"))
    }

    /// The lines over the view, with font size and colour.
    fn lines_over_view(&self, ui: &Ui, shown: &ShownMotion) -> Vec<(String, f32, Color32)> {
        const SMALL: f32 = 13.0;
        let visuals = ui.visuals();
        let (badge, colour) = self.badge(ui, shown);
        let time = format!("t = {:.4}", self.shown_time());
        let mut lines = vec![(time, 18.0, visuals.strong_text_color()), (badge, SMALL, colour)];
        if self.is_stale(shown) && !self.is_resolving() {
            let words = shown.out_of_date_text().to_owned();
            lines.push((words, SMALL, visuals.warn_fg_color));
        }
        let penetrating = self.display.state.penetrating.0.len();
        if penetrating > 0 {
            let words = format!("{penetrating} triangles penetrate here");
            lines.push((words, SMALL, visuals.error_fg_color));
        }
        lines
    }

    /// What kind of motion is shown and its verdict, with the colour of that text.
    fn badge(&self, ui: &Ui, shown: &ShownMotion) -> (String, Color32) {
        let visuals = ui.visuals();
        let accent = visuals.hyperlink_color;
        if let Some(interaction) = &self.jobs.interaction {
            let status = interaction.status();
            let mut words = "moved by hand: drag the timeline or pull a vertex".to_owned();
            if status.resets > 0 {
                words += "; it became unstable and was reset";
            }
            return (words, accent);
        }
        if let Some(((_, states), _)) = self.jobs.run.as_ref().filter(|_| self.display.follows_run)
        {
            let words = format!("running, {} states per second", states.rate());
            return (words, accent);
        }
        let checked = |verdict: Verdict| (verdict.to_string(), verdict_colour(ui, verdict));
        match &shown.source {
            MotionSource::Exact(_) => {
                ("exact states: deployed, planar, compact".to_owned(), visuals.weak_text_color())
            }
            MotionSource::Preview(_) => {
                ("preview: without contact, not checked".to_owned(), visuals.warn_fg_color)
            }
            MotionSource::Run { report, .. } => {
                (report.outcome.headline(), outcome_colour(ui, report.outcome.kind))
            }
            MotionSource::File { checked: found, .. } => match found {
                Some(found) => checked(found.certificate.verdict),
                None => ("not checked yet".to_owned(), visuals.weak_text_color()),
            },
        }
    }

    /// The motion time of what is shown.
    pub(super) fn shown_time(&self) -> f64 {
        self.live_state().map_or(self.playback.time, |state| state.time)
    }

    fn tools(&mut self, ui: &mut Ui) {
        let mut command = None;
        ScrollArea::horizontal().auto_shrink([false, true]).show(ui, |ui| {
            ui.horizontal(|ui| {
                let views = [
                    ("front", Command::ViewFront),
                    ("side", Command::ViewSide),
                    ("top", Command::ViewTop),
                    ("iso", Command::ViewIsometric),
                    ("fit", Command::Fit),
                ];
                for (name, wanted) in views {
                    let keys = keys_of(ui.ctx(), wanted);
                    let hint = format!("{} ({keys})", name_of(wanted));
                    if ui.button(name).on_hover_text(hint).clicked() {
                        command = Some(wanted);
                    }
                }
                ui.separator();
                let label = ui.label("colour");
                ComboBox::from_id_salt("colour")
                    .selected_text(self.settings.view.colour.name())
                    .width(76.0)
                    .show_ui(ui, |ui| {
                        for colour in Colour::ALL {
                            ui.selectable_value(&mut self.settings.view.colour, colour, colour.name())
                                .on_hover_text(colour.about());
                        }
                    })
                    .response
                    .labelled_by(label.id);
                ui.menu_button("creases", |ui| self.crease_switches(ui));
                ui.menu_button("overlays", |ui| self.overlay_switches(ui));
                ui.separator();
                let mut is_interacting = self.jobs.interaction.is_some();
                let hand = ui.toggle_value(&mut is_interacting, "by hand").on_hover_text(
                    "Move the sheet by hand: the timeline sets the fold angles, and vertices can be pulled (H)",
                );
                if hand.clicked() {
                    command = Some(Command::Interact);
                }
            });
        });
        if let Some(command) = command {
            self.perform(command, ui.ctx());
        }
    }

    fn crease_switches(&mut self, ui: &mut Ui) {
        let view = &mut self.settings.view;
        ui.checkbox(&mut view.creases, "creases");
        ui.separator();
        let classes = &mut view.classes;
        for (value, name) in [
            (&mut classes.mountains, "mountain"),
            (&mut classes.valleys, "valley"),
            (&mut classes.border, "border"),
            (&mut classes.free, "free"),
            (&mut classes.row, "rows"),
            (&mut classes.diagonal, "diagonals"),
            (&mut classes.vertical, "verticals"),
            (&mut classes.pad, "pads"),
            (&mut classes.column, "columns"),
        ] {
            ui.add_enabled(view.creases, Checkbox::new(value, name));
        }
    }

    fn overlay_switches(&mut self, ui: &mut Ui) {
        let view = &mut self.settings.view;
        ui.checkbox(&mut view.profile, "profile curve");
        ui.checkbox(&mut view.compact_box, "compact box, measured");
        ui.checkbox(&mut view.closed_form_box, "compact box, closed form")
            .on_hover_text("Equations 3 to 7 of the paper; shown while the sheet folds");
        if ui.checkbox(&mut view.perspective, "perspective").changed() {
            self.view3d.set_perspective(view.perspective);
        }
    }
}

/// Colours of paper and lines for the theme.
fn style(is_dark: bool) -> Style {
    let standard = Style::default();
    if !is_dark {
        return standard;
    }
    Style { border: [20, 20, 24], ..standard }
}

/// The current brightness of flashing triangles; requests the next frame.
fn flash(ui: &Ui) -> f32 {
    ui.ctx().request_repaint_after(Duration::from_millis(50));
    let part = (ui.input(|i| i.time) / FLASH).fract();
    (0.65 + 0.35 * (std::f64::consts::TAU * part).cos()) as f32
}

/// The colour scale of values, in the lower right corner.
fn scale(painter: &Painter, ui: &Ui, rect: Rect, range: [f64; 2], title: &str) {
    const SIZE: [f32; 2] = [160.0, 10.0];
    const STEPS: u32 = 32;
    let corner = rect.right_bottom() - vec2(SIZE[0] + 16.0, SIZE[1] + 30.0);
    let bar = Rect::from_min_size(corner, SIZE.into());
    for k in 0..STEPS {
        let [r, g, b] = colour_of(f64::from(k) / f64::from(STEPS - 1));
        let width = SIZE[0] / STEPS as f32;
        let place =
            Rect::from_min_size(bar.min + vec2(k as f32 * width, 0.0), vec2(width + 0.5, SIZE[1]));
        painter.rect_filled(place, 0.0, Color32::from_rgb(r, g, b));
    }
    let visuals = ui.visuals();
    let stroke = Stroke::new(1.0, visuals.weak_text_color());
    painter.rect_stroke(bar, 0.0, stroke, StrokeKind::Outside);
    let font = FontId::proportional(11.0);
    let ink = visuals.text_color();
    let write = |place, align, text: &str| painter.text(place, align, text, font.clone(), ink);
    let above = bar.center_top() - vec2(0.0, 4.0);
    write(above, Align2::CENTER_BOTTOM, title);
    for (x, value) in [(bar.left(), range[0]), (bar.right(), range[1])] {
        let below = pos2(x, bar.bottom() + 4.0);
        write(below, Align2::CENTER_TOP, &number(value));
    }
}
