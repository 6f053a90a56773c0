//! The middle of the window: the sheet, how it is shown, and what is said over it.

use std::time::Duration;

use eframe::egui::{
    Align, Align2, Color32, CornerRadius, FontId, Frame, Layout, Margin, Painter, Rect, RichText,
    ScrollArea, Stroke, StrokeKind, Ui, pos2, vec2,
};
use eframe::egui_wgpu::RenderState;
use foldmotion_record::{Style, View, colour_of};

use super::Viewer;
use super::act::Source;
use super::looks::Colour;
use crate::settings::Command;
use crate::timeline::number;
use crate::view3d::{Colours, Overlay, Picture, Shape};

/// How long a flash of penetrating facets lasts, seconds.
const FLASH: f64 = 0.9;

impl Viewer {
    /// The tools over the view, and the view.
    pub(super) fn scene_view(&mut self, ui: &mut Ui, render_state: Option<&RenderState>) {
        self.tools(ui);
        if self.act.is_none() {
            ui.centered_and_justified(|ui| {
                ui.label(RichText::new("no sheet yet: the design panel says what is missing").weak());
            });
            return;
        }
        let rect = ui.available_rect_before_wrap();
        let can_pull = self.hold.is_some();
        let pull = self.picture(ui, render_state, can_pull);
        if let Some(hold) = &self.hold {
            hold.pull(pull.map(|handle| (handle.vertex, self.from_shown(handle.target))));
        }
        self.words_over(&ui.painter_at(rect), ui, rect);
    }

    /// Draws the sheet; answers the vertex that is pulled.
    fn picture(
        &mut self,
        ui: &mut Ui,
        render_state: Option<&RenderState>,
        can_pull: bool,
    ) -> Option<crate::view3d::Handle> {
        let act = self.act.as_ref()?;
        let looks = &self.looks;
        let sheet = &act.motion().sheet;
        let (faces, points) = self.pose.penetrating.clone();
        let positions = std::sync::Arc::clone(&self.pose.positions);
        let state_key = self.pose.key;
        let visuals = ui.visuals();
        let background = visuals.panel_fill;
        let style = style(visuals.dark_mode);
        let accent = visuals.selection.stroke.color;
        let weak = visuals.weak_text_color();
        let marked = visuals.error_fg_color;
        let mut overlays: Vec<Overlay<'_>> = Vec::new();
        if looks.has_profile && !act.profile.is_empty() {
            overlays.push(Overlay { shape: Shape::Path(&act.profile), colour: accent, width: 2.0 });
        }
        for (wanted, bounds, colour) in [
            (looks.has_box, act.boxes[0], weak),
            (looks.has_closed_form, act.boxes[1], accent),
        ] {
            if let Some([low, sides]) = bounds.filter(|_| wanted && self.playback.time > 1.0) {
                let edges = glam::DMat3::from_diagonal(sides);
                let edges = [edges.x_axis, edges.y_axis, edges.z_axis];
                overlays.push(Overlay { shape: Shape::Box(low, edges), colour, width: 1.2 });
            }
        }
        if !points.is_empty() {
            overlays.push(Overlay { shape: Shape::Dots(&points), colour: marked, width: 9.0 });
        }
        let pulse = if faces.is_empty() { 0.0 } else { flash(ui) };
        let colours = match (looks.colour, self.pose.values(act, sheet, looks.colour)) {
            (_, Some((values, range, _))) => Colours::Values { values, range, key: state_key },
            (Colour::Unit, _) => Colours::Units,
            (Colour::Layer, _) => Colours::Layers,
            _ => Colours::Plain,
        };
        let creases = if looks.has_creases { looks.creases } else { looks.creases.none() };
        let picture = Picture {
            sheet,
            sheet_key: act.key,
            positions: &positions,
            state_key,
            layers: Some(&act.layers),
            colours,
            creases,
            style: &style,
            background,
            overlays: &overlays,
            flash: &faces,
            pulse,
            handle: None,
            can_pull,
        };
        let seen = self.view3d.show(ui, render_state, &picture);
        seen.pull
    }

    /// What is shown, and what it is worth.
    fn words_over(&mut self, painter: &Painter, ui: &Ui, rect: Rect) {
        let Some(act) = &self.act else { return };
        let visuals = ui.visuals();
        let (badge, colour) = match (&self.run, &self.hold, &act.source) {
            (Some(run), _, _) if self.follows_run => (
                format!("running: t = {:.3}, {} states", run.time(), run.states()),
                visuals.selection.stroke.color,
            ),
            (_, Some(_), _) => (
                "in the hand: drag the timeline, pull a vertex".to_owned(),
                visuals.selection.stroke.color,
            ),
            (_, _, Source::Exact(_)) => (
                "exact states: deployed, planar, compact".to_owned(),
                visuals.weak_text_color(),
            ),
            (_, _, Source::Preview(_)) => (
                "preview: without contact, not checked".to_owned(),
                visuals.warn_fg_color,
            ),
            (_, _, Source::Run { report, .. }) => {
                let verdict = &report.collision.verdict;
                (verdict.clone(), crate::results::verdict_colour(ui, verdict))
            }
            (_, _, Source::File(file)) => {
                let verdict = file.verdict.clone().unwrap_or_else(|| "not checked".to_owned());
                let colour = crate::results::verdict_colour(ui, &verdict);
                (verdict, colour)
            }
        };
        let corner = rect.left_top() + vec2(12.0, 10.0);
        let time = format!("t = {:.4}", self.shown_time());
        let font = FontId::proportional(18.0);
        let place = painter.text(corner, Align2::LEFT_TOP, time, font, visuals.strong_text_color());
        let below = place.left_bottom() + vec2(0.0, 3.0);
        let place = painter.text(below, Align2::LEFT_TOP, badge, FontId::proportional(13.0), colour);
        if self.is_stale() {
            let words = "of the scene before the last edits";
            let below = place.left_bottom() + vec2(0.0, 2.0);
            painter.text(below, Align2::LEFT_TOP, words, FontId::proportional(13.0), visuals.warn_fg_color);
        }
        let sheet = &act.motion().sheet;
        if let Some((_, range, title)) = self.pose.values(act, sheet, self.looks.colour) {
            scale(painter, ui, rect, range, title);
        }
    }

    /// Buttons over the view.
    fn tools(&mut self, ui: &mut Ui) {
        let mut command = None;
        ScrollArea::horizontal().auto_shrink([false, true]).show(ui, |ui| {
            ui.horizontal(|ui| {
                let views = [
                    ("front", Command::ViewFront, View::Front),
                    ("side", Command::ViewSide, View::Side),
                    ("top", Command::ViewTop, View::Top),
                    ("iso", Command::ViewIso, View::Iso),
                ];
                for (name, wanted, _) in views {
                    if ui.button(name).on_hover_text(wanted.hint()).clicked() {
                        command = Some(wanted);
                    }
                }
                if ui.button("fit").on_hover_text(Command::Fit.hint()).clicked() {
                    command = Some(Command::Fit);
                }
                ui.separator();
                let label = ui.label("colour");
                eframe::egui::ComboBox::from_id_salt("colour")
                    .selected_text(self.looks.colour.name())
                    .width(76.0)
                    .show_ui(ui, |ui| {
                        for colour in Colour::ALL {
                            ui.selectable_value(&mut self.looks.colour, colour, colour.name())
                                .on_hover_text(colour.about());
                        }
                    })
                    .response
                    .labelled_by(label.id);
                ui.menu_button("creases", |ui| self.crease_switches(ui));
                ui.menu_button("overlays", |ui| self.overlay_switches(ui));
                ui.separator();
                let mut is_held = self.hold.is_some();
                let hand = ui.toggle_value(&mut is_held, "hand").on_hover_text(
                    "moves the sheet as masses and springs: the timeline sets the fold, a vertex can be pulled (H)",
                );
                if hand.clicked() {
                    command = Some(Command::Hand);
                }
            });
        });
        if let Some(command) = command {
            self.perform(command, ui.ctx());
        }
    }

    fn crease_switches(&mut self, ui: &mut Ui) {
        let looks = &mut self.looks;
        ui.checkbox(&mut looks.has_creases, "creases");
        ui.separator();
        let classes = &mut looks.creases;
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
            ui.add_enabled(looks.has_creases, eframe::egui::Checkbox::new(value, name));
        }
    }

    fn overlay_switches(&mut self, ui: &mut Ui) {
        let looks = &mut self.looks;
        ui.checkbox(&mut looks.has_profile, "profile curve");
        ui.checkbox(&mut looks.has_box, "compact box, measured");
        ui.checkbox(&mut looks.has_closed_form, "compact box, closed form")
            .on_hover_text("equations 3 to 7 of the paper; shown while the sheet folds");
        if ui.checkbox(&mut looks.perspective, "perspective").changed() {
            self.view3d.set_perspective(self.looks.perspective);
        }
    }
}

/// Paper and lines on the ground at hand.
fn style(is_dark: bool) -> Style {
    let standard = Style::default();
    if !is_dark {
        return standard;
    }
    Style {
        border: [20, 20, 24],
        ..standard
    }
}

/// The brightness of what flashes, now; asks for the next frame.
fn flash(ui: &Ui) -> f32 {
    ui.ctx().request_repaint_after(Duration::from_millis(50));
    let part = (ui.input(|i| i.time) / FLASH).fract();
    (0.65 + 0.35 * (std::f64::consts::TAU * part).cos()) as f32
}

/// The scale of values, in the lower right corner.
fn scale(painter: &Painter, ui: &Ui, rect: Rect, range: [f64; 2], title: &str) {
    const SIZE: [f32; 2] = [160.0, 10.0];
    const STEPS: u32 = 32;
    let corner = rect.right_bottom() - vec2(SIZE[0] + 16.0, SIZE[1] + 30.0);
    let bar = Rect::from_min_size(corner, SIZE.into());
    for k in 0..STEPS {
        let [r, g, b] = colour_of(f64::from(k) / f64::from(STEPS - 1));
        let width = SIZE[0] / STEPS as f32;
        let place = Rect::from_min_size(bar.min + vec2(k as f32 * width, 0.0), vec2(width + 0.5, SIZE[1]));
        painter.rect_filled(place, 0.0, Color32::from_rgb(r, g, b));
    }
    let visuals = ui.visuals();
    let stroke = Stroke::new(1.0, visuals.weak_text_color());
    painter.rect_stroke(bar, 0.0, stroke, StrokeKind::Outside);
    let font = FontId::proportional(11.0);
    let ink = visuals.text_color();
    painter.text(bar.center_top() - vec2(0.0, 4.0), Align2::CENTER_BOTTOM, title, font.clone(), ink);
    for (x, value) in [(bar.left(), range[0]), (bar.right(), range[1])] {
        painter.text(pos2(x, bar.bottom() + 4.0), Align2::CENTER_TOP, number(value), font.clone(), ink);
    }
}
