//! The timeline bar for scrubbing, with marks for states, frames, penetrations and a jam.

use eframe::egui::{
    Align2, Button, ComboBox, DragValue, FontId, Key, Rect, Response, RichText, ScrollArea, Sense,
    Shape, Stroke, StrokeKind, Ui, WidgetInfo, pos2, vec2,
};

use super::axis::Axis;
use super::playback::{Playback, Repeat};
use super::plot::Plots;
use super::plot_view::show_plot;

const HEIGHT: f32 = 34.0;

/// What the bar marks.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Marks {
    /// The motion times of the frames.
    pub(crate) frames: Vec<f64>,
    /// The motion time that the motion reached.
    pub(crate) reached: Option<f64>,
    /// The motion times at which facets penetrate.
    pub(crate) penetrations: Vec<f64>,
    /// The motion time at which the motion jammed.
    pub(crate) jam: Option<f64>,
}

/// The timeline with its plots.
#[derive(Debug, Default)]
pub(crate) struct Timeline;

impl Timeline {
    /// Shows buttons, bar and plots; returns whether the user changed the motion time.
    pub(crate) fn show(ui: &mut Ui, playback: &mut Playback, marks: &Marks, plots: &Plots) -> bool {
        let mut moved = buttons(ui, playback, marks);
        let axis = Axis::within(ui.available_rect_before_wrap(), playback.range);
        let response = bar(ui, playback, marks, &axis);
        moved |= keys(ui, &response, playback, marks) | scrub(&response, &axis, playback);
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            for plot in &plots.plots {
                let response = show_plot(ui, plot, &axis, playback.time);
                moved |= scrub(&response, &axis, playback);
            }
        });
        moved
    }
}

/// Sets the motion time to where the pointer drags or clicks; returns whether it did.
fn scrub(response: &Response, axis: &Axis, playback: &mut Playback) -> bool {
    let is_moved = response.dragged() || response.clicked();
    let Some(pointer) = response.interact_pointer_pos().filter(|_| is_moved) else {
        return false;
    };
    playback.go_to(axis.time(pointer.x));
    true
}

/// With the keyboard focus, arrow keys step through frames, and Home and End go to the ends.
fn keys(ui: &Ui, response: &Response, playback: &mut Playback, marks: &Marks) -> bool {
    if !response.has_focus() {
        return false;
    }
    let [back, on, first, last] = ui.input(|i| {
        [Key::ArrowLeft, Key::ArrowRight, Key::Home, Key::End].map(|key| i.key_pressed(key))
    });
    if back || on {
        playback.step(&marks.frames, on);
    }
    if first || last {
        playback.go_to(playback.range[usize::from(last)]);
    }
    back || on || first || last
}

fn buttons(ui: &mut Ui, playback: &mut Playback, marks: &Marks) -> bool {
    let mut moved = false;
    ui.horizontal(|ui| {
        if icon(ui, Icon::Previous, "Previous frame", "comma") {
            playback.step(&marks.frames, false);
            moved = true;
        }
        let (sign, name) =
            if playback.is_playing { (Icon::Pause, "Pause") } else { (Icon::Play, "Play") };
        if icon(ui, sign, name, "space") {
            playback.toggle();
        }
        if icon(ui, Icon::Next, "Next frame", "period") {
            playback.step(&marks.frames, true);
            moved = true;
        }
        ui.separator();
        let label = ui.label("t");
        let mut time = playback.time;
        let field = DragValue::new(&mut time).range(playback.range[0]..=playback.range[1]);
        let field = ui.add(field.speed(0.002).fixed_decimals(4));
        if field
            .labelled_by(label.id)
            .on_hover_text("Motion time: 0 deployed, 1 planar, 2 compact")
            .changed()
        {
            playback.go_to(time);
            moved = true;
        }
        ui.label(RichText::new(stage_text(playback.time)).weak());
        ui.separator();
        let label = ui.label("speed");
        let [slowest, fastest] = Playback::SPEEDS;
        let field = DragValue::new(&mut playback.speed).range(slowest..=fastest).speed(0.02);
        ui.add(field.max_decimals(3).suffix("×")).labelled_by(label.id);
        ComboBox::from_id_salt("repeat")
            .selected_text(playback.repeat.name())
            .width(100.0)
            .show_ui(ui, |ui| {
                for repeat in Repeat::ALL {
                    ui.selectable_value(&mut playback.repeat, repeat, repeat.name());
                }
            })
            .response
            .accessible_name("At the end");
    });
    moved
}

/// Icons of buttons. They are drawn because not every font contains them.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Icon {
    Previous,
    Play,
    Pause,
    Next,
}

/// A button with an icon; returns whether it was clicked.
fn icon(ui: &mut Ui, icon: Icon, name: &str, key: &str) -> bool {
    let button = Button::new("").min_size(vec2(28.0, 22.0));
    let response = ui.add(button).accessible_name(name);
    let response = response.on_hover_text(format!("{name} ({key})"));
    let colour = ui.style().interact(&response).fg_stroke.color;
    let centre = response.rect.center();
    let painter = ui.painter();
    let triangle = |x: f32, direction: f32| {
        let corner = |dx: f32, dy: f32| centre + vec2(x + direction * dx, dy);
        let corners = vec![corner(-4.0, -5.0), corner(4.5, 0.0), corner(-4.0, 5.0)];
        painter.add(Shape::convex_polygon(corners, colour, Stroke::NONE));
    };
    let bar = |x: f32| {
        let size = vec2(3.0, 10.0);
        let rect = Rect::from_center_size(centre + vec2(x, 0.0), size);
        painter.rect_filled(rect, 0.5, colour);
    };
    match icon {
        Icon::Play => triangle(0.0, 1.0),
        Icon::Pause => [-3.0, 3.0].into_iter().for_each(bar),
        Icon::Previous => {
            bar(-5.0);
            triangle(1.5, -1.0);
        }
        Icon::Next => {
            triangle(-1.5, 1.0);
            bar(5.0);
        }
    }
    response.clicked()
}

/// The stage at motion time `t`.
fn stage_text(t: f64) -> String {
    match t {
        0.0 => "deployed".to_owned(),
        1.0 => "planar".to_owned(),
        2.0 => "compact".to_owned(),
        t if t < 1.0 => format!("unfolding, {:.0} %", 100.0 * t),
        t => format!("folding, {:.0} %", 100.0 * (t - 1.0)),
    }
}

fn bar(ui: &mut Ui, playback: &Playback, marks: &Marks, axis: &Axis) -> Response {
    let width = ui.available_width();
    let (rect, response) = ui.allocate_exact_size(vec2(width, HEIGHT), Sense::click_and_drag());
    let time = playback.time;
    response.widget_info(|| WidgetInfo::slider(true, time, "Motion time"));
    if response.clicked() || response.drag_started() {
        response.request_focus();
    }
    let visuals = ui.visuals();
    let painter = ui.painter();
    let middle = rect.top() + 10.0;
    let groove = Rect::from_x_y_ranges(axis.span, middle - 4.0..=middle + 4.0);
    let idle = visuals.widgets.inactive.bg_fill;
    painter.rect(groove, 3.0, idle, Stroke::NONE, StrokeKind::Inside);
    if let Some(reached) = marks.reached {
        let mut done = groove;
        done.set_right(axis.x(reached));
        painter.rect_filled(done, 3.0, visuals.selection.bg_fill.gamma_multiply(0.6));
    }
    let weak = visuals.weak_text_color();
    if marks.frames.len() as f32 * 3.0 < axis.span.span() {
        for &t in &marks.frames {
            let stroke = Stroke::new(1.0, weak.gamma_multiply(0.5));
            painter.vline(axis.x(t), middle - 2.0..=middle + 2.0, stroke);
        }
    }
    for (t, name) in [(0.0, "deployed"), (1.0, "planar"), (2.0, "compact")] {
        if (playback.range[0]..=playback.range[1]).contains(&t) {
            let x = axis.x(t);
            painter.vline(x, middle - 6.0..=middle + 8.0, Stroke::new(1.0, weak));
            let font = FontId::proportional(11.0);
            painter.text(pos2(x, middle + 9.0), Align2::CENTER_TOP, name, font, weak);
        }
    }
    let marked = visuals.error_fg_color;
    for &t in marks.penetrations.iter().chain(&marks.jam) {
        let stroke = Stroke::new(1.5, marked);
        painter.vline(axis.x(t), middle - 7.0..=middle + 7.0, stroke);
    }
    let x = axis.x(time);
    let knob = if response.dragged() || response.hovered() { 8.0 } else { 7.0 };
    let colour = visuals.hyperlink_color;
    painter.add(Shape::circle_filled(pos2(x, middle), knob, colour));
    let rim = if response.has_focus() { visuals.strong_text_color() } else { visuals.window_fill };
    painter.circle_stroke(pos2(x, middle), knob, Stroke::new(1.5, rim));
    response
}
