//! Number fields for keys that may be omitted.

use std::ops::RangeInclusive;

use eframe::egui::{self, Id, Ui, vec2};
use foldmotion_study::Scene;

use super::form::{Field, Form};

/// Width of the button that resets a key to its default, points.
pub(super) const RESET_WIDTH: f32 = 20.0;

/// How a number is shown and dragged.
#[derive(Debug, Clone)]
pub(super) struct Number {
    /// The range of values that can be reached by dragging; typed values may lie outside.
    drag_range: RangeInclusive<f64>,
    /// The value that holds if the key is omitted.
    default: Option<f64>,
    /// The text of an empty field without a default.
    hint: &'static str,
    /// Change per point dragged. Default: a two-hundredth of the value.
    speed: Option<f64>,
    whole: bool,
}

impl Number {
    pub(super) fn within(drag_range: RangeInclusive<f64>) -> Self {
        Self { drag_range, default: None, hint: "none", speed: None, whole: false }
    }

    pub(super) fn default(mut self, value: impl Into<Option<f64>>) -> Self {
        self.default = value.into();
        self
    }

    pub(super) fn hint(mut self, hint: &'static str) -> Self {
        self.hint = hint;
        self
    }

    pub(super) fn speed(mut self, speed: f64) -> Self {
        self.speed = Some(speed);
        self
    }

    pub(super) fn whole(mut self) -> Self {
        self.whole = true;
        self.speed(0.1)
    }

    /// Shows the field, `width` points wide. An empty field is `None`. The caller compares `value` to learn whether it
    /// has changed.
    fn show(&self, ui: &mut Ui, width: f32, value: &mut Option<f64>) -> egui::Response {
        let start = self
            .default
            .unwrap_or_else(|| 1.0_f64.clamp(*self.drag_range.start(), *self.drag_range.end()));
        let editing = ui.memory(|memory| memory.has_focus(ui.next_auto_id()));
        let is_left_out = value.is_none();
        let (hint, default) = (self.hint, self.default);
        let text = move |number: f64, _: RangeInclusive<usize>| match (editing, is_left_out) {
            (true, true) => String::new(),
            (true, false) => format!("{number}"),
            (false, true) => default.map_or_else(|| hint.to_owned(), short),
            (false, false) => short(number),
        };
        if is_left_out {
            ui.visuals_mut().override_text_color = Some(ui.visuals().weak_text_color());
        }
        let size = value.or(self.default).unwrap_or(0.0).abs();
        let speed = self.speed.unwrap_or(size.max(0.02) / 200.0);
        let round = |number: f64| if self.whole { number.round() } else { number };
        let get_set = |new: Option<f64>| {
            if let Some(new) = new {
                *value = Some(round(new)).filter(|number| number.is_finite());
            }
            value.unwrap_or(start)
        };
        let field = egui::DragValue::from_get_set(get_set)
            .speed(speed)
            .update_while_editing(false)
            .min_size(vec2(width, ui.spacing().interact_size.y))
            .clip_text(true)
            .custom_formatter(text)
            .custom_parser(parsed);
        let response = ui.add(field);
        if response.dragged() {
            *value =
                value.map(|number| number.clamp(*self.drag_range.start(), *self.drag_range.end()));
        }
        response
    }
}

/// Parses a number. Empty text, which stands for an omitted key, becomes an infinite number.
fn parsed(text: &str) -> Option<f64> {
    let text = text.trim().replace('−', "-");
    if text.is_empty() {
        return Some(f64::INFINITY);
    }
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

/// Formats a number with at most six significant digits.
pub(super) fn short(number: f64) -> String {
    formatted(number, 6)
}

/// Formats a number with at most `digits` significant digits and without trailing zeros, in scientific notation with half as
/// many digits if it is very small or very large.
pub(super) fn formatted(number: f64, digits: usize) -> String {
    let size = number.abs();
    let text = if size != 0.0 && !(1e-3..1e6).contains(&size) {
        format!("{number:.*e}", digits / 2)
    } else {
        let whole_digits = size.trunc().to_string().len();
        format!("{number:.*}", digits.saturating_sub(whole_digits))
    };
    let (mantissa, exponent) = text.split_at(text.find('e').unwrap_or(text.len()));
    if mantissa.contains('.') {
        let mantissa = mantissa.trim_end_matches('0').trim_end_matches('.');
        format!("{mantissa}{exponent}")
    } else {
        text
    }
}

/// The width of a control that leaves room for a reset button, points.
pub(super) fn control_width(ui: &Ui) -> f32 {
    ui.available_width() - RESET_WIDTH - ui.spacing().item_spacing.x
}

/// The accessible name of a field.
#[derive(Debug, Clone, Copy)]
pub(super) enum AccessibleName<'a> {
    By(Id),
    As(&'a str),
}

impl Form<'_> {
    /// A row with a number field.
    pub(super) fn number(
        &mut self,
        ui: &mut Ui,
        field: &Field,
        number: &Number,
        of: impl Fn(&mut Scene) -> &mut Option<f64>,
    ) {
        let mut value = *of(&mut self.scene);
        if self.number_row(ui, field, number, &mut value) {
            *of(&mut self.scene) = value;
        }
    }

    /// A row with a field for a whole number.
    pub(super) fn whole(
        &mut self,
        ui: &mut Ui,
        field: &Field,
        number: Number,
        of: impl Fn(&mut Scene) -> &mut Option<i64>,
    ) {
        let mut value = of(&mut self.scene).map(|whole| whole as f64);
        if self.number_row(ui, field, &number.whole(), &mut value) {
            *of(&mut self.scene) = value.map(|number| number as i64);
        }
    }

    /// A row with a number field and its reset button; returns whether `value` has changed.
    fn number_row(
        &mut self,
        ui: &mut Ui,
        field: &Field,
        number: &Number,
        value: &mut Option<f64>,
    ) -> bool {
        let before = *value;
        self.row(ui, field, |form, ui, label| {
            let width = control_width(ui);
            let name = AccessibleName::By(label);
            form.cell(ui, field.name, name, number, width, value);
            if form.reset(ui, field, value.is_some()) {
                *value = None;
            }
        });
        *value != before
    }

    /// A number field; returns whether its value has changed.
    pub(super) fn cell(
        &mut self,
        ui: &mut Ui,
        undo: &'static str,
        spoken: AccessibleName<'_>,
        number: &Number,
        width: f32,
        value: &mut Option<f64>,
    ) -> bool {
        let before = *value;
        let response = ui.scope(|ui| number.show(ui, width, value)).inner;
        let is_changed = *value != before;
        if is_changed {
            self.record(undo, response.id, response.dragged());
        }
        match spoken {
            AccessibleName::By(label) => response.labelled_by(label),
            AccessibleName::As(name) => response.accessible_name(name),
        };
        is_changed
    }

    /// A field for a whole number; returns whether its value has changed.
    pub(super) fn whole_cell(
        &mut self,
        ui: &mut Ui,
        undo: &'static str,
        spoken: AccessibleName<'_>,
        number: &Number,
        width: f32,
        value: &mut Option<i64>,
    ) -> bool {
        let mut number_of = value.map(|whole| whole as f64);
        let is_changed = self.cell(ui, undo, spoken, number, width, &mut number_of);
        if is_changed {
            *value = number_of.map(|number| number as i64);
        }
        is_changed
    }

    /// A field for a number that cannot be omitted; returns the new value if it has changed.
    pub(super) fn required_cell(
        &mut self,
        ui: &mut Ui,
        undo: &'static str,
        name: &str,
        number: &Number,
        width: f32,
        before: f64,
    ) -> Option<f64> {
        let mut value = Some(before);
        let is_changed = self.cell(ui, undo, AccessibleName::As(name), number, width, &mut value);
        value.filter(|_| is_changed)
    }

    /// The button that resets a key to its default, or empty space if the key is omitted; returns whether it was
    /// clicked.
    pub(super) fn reset(&mut self, ui: &mut Ui, field: &Field, is_given: bool) -> bool {
        let size = vec2(RESET_WIDTH, ui.spacing().interact_size.y);
        if !is_given {
            ui.allocate_space(size);
            return false;
        }
        let button = egui::Button::new("×").frame(false).min_size(size);
        let response = ui
            .add(button)
            .accessible_name(format!("default of {}", field.name))
            .on_hover_text("Reset to the default");
        let clicked = response.clicked();
        if clicked {
            self.record(field.name, response.id, false);
        }
        clicked
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_few_digits_and_no_trailing_zeros() {
        let numbers = [0.0, 5.0, 100.0, 0.1 + 0.2, -123.456_7, 1e-14, -2.5e9];
        let texts = ["0", "5", "100", "0.3", "-123.457", "1e-14", "-2.5e9"];
        assert_eq!(numbers.map(short), texts);
        assert_eq!(formatted(2.0 / 3.0, 4), "0.667");
    }
}
