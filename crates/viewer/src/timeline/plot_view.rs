//! A plot, drawn along the axis of the timeline.

use eframe::egui::{
    Align2, Color32, FontId, Pos2, Rect, Response, Sense, Shape, Stroke, StrokeKind, Ui, Visuals,
    WidgetInfo, pos2, vec2,
};

use super::axis::Axis;
use super::plot::{Curve, Plot};

/// Height of a plot, points.
pub(super) const HEIGHT: f32 = 40.0;

/// Colours of curves that can be told apart with colour blindness (Okabe and Ito 2008).
const COLOURS: [[u8; 3]; 5] =
    [[0, 114, 178], [213, 94, 0], [0, 158, 115], [204, 121, 167], [230, 159, 0]];

/// The colour of curve `index`, lighter on a dark background.
fn colour(index: usize, visuals: &Visuals) -> Color32 {
    let [r, g, b] = COLOURS[index % COLOURS.len()];
    let colour = Color32::from_rgb(r, g, b);
    if visuals.dark_mode { colour.lerp_to_gamma(Color32::WHITE, 0.25) } else { colour }
}

/// Draws a plot and returns the response of its area, in which the user can scrub.
pub(super) fn show_plot(ui: &mut Ui, plot: &Plot, axis: &Axis, time: f64) -> Response {
    let width = ui.available_width();
    let (rect, response) = ui.allocate_exact_size(vec2(width, HEIGHT), Sense::click_and_drag());
    let name = format!("{} over motion time", plot.title);
    response.widget_info(|| {
        let words = readings(plot, time);
        WidgetInfo::labeled(eframe::egui::accesskit::Role::Image, true, format!("{name}: {words}"))
    });
    if ui.is_rect_visible(rect) {
        paint(ui, plot, axis, time, rect);
    }
    // The tooltip is not shown over the curves, where it would cover what is being scrubbed.
    let is_beside = response.hover_pos().is_some_and(|at| at.x < axis.span.min);
    if is_beside { response.on_hover_text(plot.about) } else { response }
}

fn paint(ui: &Ui, plot: &Plot, axis: &Axis, time: f64, rect: Rect) {
    let visuals = ui.visuals();
    let area = Rect::from_x_y_ranges(axis.span, rect.y_range()).shrink2(vec2(0.0, 2.0));
    let painter = ui.painter();
    painter.rect(
        area,
        2.0,
        visuals.extreme_bg_color,
        visuals.widgets.noninteractive.bg_stroke,
        StrokeKind::Inside,
    );
    let weak = visuals.weak_text_color();
    let levels = plot.levels();
    let font = FontId::proportional(10.0);
    let y = |level: f64| {
        let part = (level - levels[0]) / (levels[1] - levels[0]);
        area.bottom() - 3.0 - (area.height() - 6.0) * part as f32
    };
    for (level, anchor) in [(levels[1], Align2::RIGHT_TOP), (levels[0], Align2::RIGHT_BOTTOM)] {
        let value = if plot.is_logarithmic { 10_f64.powf(level) } else { level };
        let at = if level == levels[1] { area.top() } else { area.bottom() };
        painter.text(pos2(area.left() - 5.0, at), anchor, number(value), font.clone(), weak);
    }
    for whole in [0.0, 1.0, 2.0] {
        if (axis.times[0]..=axis.times[1]).contains(&whole) {
            let stroke = Stroke::new(1.0, weak.gamma_multiply(0.35));
            painter.vline(axis.x(whole), area.y_range(), stroke);
        }
    }
    if let Some((value, _)) = plot.reference
        && plot.shows(value)
    {
        let at = y(plot.level(value));
        let ends = [pos2(area.left(), at), pos2(area.right(), at)];
        painter.extend(Shape::dashed_line(&ends, Stroke::new(1.0, weak), 4.0, 3.0));
    }
    for (index, curve) in plot.curves.iter().enumerate() {
        let stroke = Stroke::new(1.4, colour(index, visuals));
        for piece in pieces(plot, curve, axis, &y) {
            painter.line(piece, stroke);
        }
    }
    let now = Stroke::new(1.0, visuals.strong_text_color());
    painter.vline(axis.x(time), area.y_range(), now);
    legend(ui, plot, time, area);
}

/// The curve on the screen, in pieces between gaps. Of all points in one column of pixels only the lowest and the
/// highest are kept, so that drawing does not slow down with thousands of frames.
fn pieces(plot: &Plot, curve: &Curve, axis: &Axis, y: &impl Fn(f64) -> f32) -> Vec<Vec<Pos2>> {
    let mut pieces: Vec<Vec<Pos2>> = Vec::new();
    let mut is_open = false;
    let mut column: Option<(f32, f32, f32, f32)> = None;
    let mut flush = |column: &mut Option<(f32, f32, f32, f32)>, is_open: &mut bool| {
        let Some((x, low, high, last)) = column.take() else {
            return;
        };
        if !*is_open {
            pieces.push(Vec::new());
        }
        *is_open = true;
        if let Some(piece) = pieces.last_mut() {
            if low < high {
                piece.extend([pos2(x, low), pos2(x, high)]);
            }
            piece.push(pos2(x, last));
        }
    };
    for &[t, value] in &curve.points {
        if !plot.shows(value) {
            flush(&mut column, &mut is_open);
            is_open = false;
            continue;
        }
        let (x, at) = (axis.x(t), y(plot.level(value)));
        column = match column {
            Some((first, low, high, _)) if x - first < 1.0 => {
                Some((first, low.min(at), high.max(at), at))
            }
            _ => {
                flush(&mut column, &mut is_open);
                Some((x, at, at, at))
            }
        };
    }
    flush(&mut column, &mut is_open);
    pieces
}

/// Title, and the values at `time` in the colours of their curves.
fn legend(ui: &Ui, plot: &Plot, time: f64, area: Rect) {
    let visuals = ui.visuals();
    let font = FontId::proportional(11.0);
    let painter = ui.painter().with_clip_rect(area);
    // The background is drawn first, but its size is only known once the text is laid out.
    let ground = painter.add(Shape::Noop);
    let corner = area.left_top() + vec2(5.0, 2.0);
    let mut place = Rect::from_min_size(corner, vec2(0.0, 0.0));
    let mut write = |text: String, colour: Color32| {
        let galley = painter.layout_no_wrap(text, font.clone(), colour);
        let gap = if place.width() > 0.0 { 8.0 } else { 0.0 };
        let at = place.right_top() + vec2(gap, 0.0);
        place |= Rect::from_min_size(at, galley.size());
        painter.galley(at, galley, colour);
    };
    write(plot.title.clone(), visuals.text_color());
    for (index, curve) in plot.curves.iter().enumerate() {
        let value = curve.at(time).filter(|v| v.is_finite());
        let value = value.map_or_else(|| "–".to_owned(), number);
        write(format!("{} {value}", curve.name), colour(index, visuals));
    }
    if let Some((value, name)) = plot.reference {
        write(format!("{name} {}", number(value)), visuals.weak_text_color());
    }
    let colour = visuals.extreme_bg_color.gamma_multiply(0.85);
    painter.set(ground, Shape::rect_filled(place.expand2(vec2(3.0, 0.0)), 2.0, colour));
}

/// The values at `time` as text.
fn readings(plot: &Plot, time: f64) -> String {
    let value = |curve: &Curve| {
        let value = curve.at(time).filter(|v| v.is_finite());
        format!("{} {}", curve.name, value.map_or_else(|| "none".to_owned(), number))
    };
    plot.curves.iter().map(value).collect::<Vec<_>>().join(", ")
}

/// Formats a number with about three significant digits.
pub(crate) fn number(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 {
        "0".to_owned()
    } else if !(1e-3..1e4).contains(&size) {
        format!("{value:.1e}")
    } else if size < 1.0 {
        format!("{value:.3}")
    } else if size < 100.0 {
        format!("{value:.2}")
    } else {
        format!("{value:.0}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::Rangef;

    #[test]
    fn numbers_are_short() {
        let numbers = [0.0, 0.25, 4.567, 123.4, 1.5e-7, 2.5e6].map(number);
        assert_eq!(numbers, ["0", "0.250", "4.57", "123", "1.5e-7", "2.5e6"]);
    }

    #[test]
    fn a_long_curve_keeps_its_peaks_and_gaps_in_few_points() {
        let mut points: Vec<[f64; 2]> =
            (0..=20_000).map(|k| [f64::from(k) / 10_000.0, 1.0]).collect();
        points[7_777][1] = 9.0;
        points[15_000][1] = f64::NAN;
        let plot = Plot {
            title: String::new(),
            about: "",
            is_logarithmic: false,
            curves: vec![Curve { name: "a", points }],
            reference: None,
        };
        let axis = Axis { times: [0.0, 2.0], span: Rangef::new(0.0, 300.0) };
        let pieces = pieces(&plot, &plot.curves[0], &axis, &|level| level as f32);
        assert_eq!(pieces.len(), 2, "a value that is no number is a gap");
        let all: Vec<Pos2> = pieces.concat();
        assert!(all.len() < 1_000, "{}", all.len());
        assert!(all.iter().any(|p| p.y == 9.0), "the peak is drawn");
    }
}
