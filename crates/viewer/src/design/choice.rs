//! Choices, switches and texts that may be left out.

use eframe::egui::{self, RichText, TextEdit, Ui};
use foldmotion_study::Scene;

use super::form::{Field, Form};
use super::number::control_width;

/// One way to choose, with its name and what it means.
pub(super) type Way<T> = (T, &'static str, &'static str);

impl Form<'_> {
    /// A row with a menu. `ways`: the first is the one that holds where the key is left out, and choosing it leaves it out.
    pub(super) fn menu<T: PartialEq + Copy>(
        &mut self,
        ui: &mut Ui,
        field: &Field,
        ways: &[Way<T>],
        of: impl Fn(&mut Scene) -> &mut Option<T>,
    ) {
        self.row(ui, field, |form, ui, label| {
            let given = *of(&mut form.scene);
            let shown = ways.iter().find(|way| Some(way.0) == given);
            let text = match (shown, ways.first()) {
                (Some(way), _) => RichText::new(way.1),
                (None, Some(way)) => RichText::new(way.1).weak(),
                (None, None) => RichText::new("none").weak(),
            };
            let menu = egui::ComboBox::from_id_salt(&*field.key)
                .selected_text(text)
                .truncate()
                .width(control_width(ui));
            let mut chosen = None;
            let response = menu.show_ui(ui, |ui| {
                for (index, (way, name, tip)) in ways.iter().enumerate() {
                    let is_chosen = Some(*way) == given || (index == 0 && given.is_none());
                    let text = if index == 0 {
                        format!("{name} (default)")
                    } else {
                        (*name).to_owned()
                    };
                    let mut option = ui.selectable_label(is_chosen, text);
                    if !tip.is_empty() {
                        option = option.on_hover_text(*tip);
                    }
                    if option.clicked() {
                        chosen = Some(if index == 0 { None } else { Some(*way) });
                    }
                }
            });
            let response = response.response.labelled_by(label);
            if let Some(chosen) = chosen.filter(|&chosen| chosen != given) {
                *of(&mut form.scene) = chosen;
                form.record(field.undo, response.id, false);
            }
        });
    }

    /// A row with a check box; the key is left out where it would say what holds without it.
    pub(super) fn switch(
        &mut self,
        ui: &mut Ui,
        field: &Field,
        default: bool,
        of: impl Fn(&mut Scene) -> &mut Option<bool>,
    ) {
        self.part(ui, &field.key, |form, ui| {
            let mut is_on = of(&mut form.scene).unwrap_or(default);
            let response = ui.checkbox(&mut is_on, field.name).on_hover_text(field.tip);
            if response.changed() {
                *of(&mut form.scene) = (is_on != default).then_some(is_on);
                form.record(field.undo, response.id, false);
            }
        });
        self.errors_of(ui, &field.key);
    }

    /// A row with a text that is taken once it is complete: by Enter or by leaving the field.
    pub(super) fn text(
        &mut self,
        ui: &mut Ui,
        field: &Field,
        hint: &'static str,
        value: &str,
    ) -> Option<String> {
        let mut entered = None;
        self.row(ui, field, |form, ui, label| {
            let id = form.id(&field.key).with("text");
            let mut text = ui
                .data(|data| data.get_temp::<String>(id))
                .unwrap_or_else(|| value.to_owned());
            let edit = TextEdit::singleline(&mut text)
                .id(id)
                .hint_text(hint)
                .desired_width(control_width(ui) - 8.0);
            let response = ui.add(edit).labelled_by(label);
            if response.lost_focus() {
                ui.data_mut(|data| data.remove::<String>(id));
                let is_given_up = ui.input(|input| input.key_pressed(egui::Key::Escape));
                if !is_given_up && text != value {
                    form.record(field.undo, id, false);
                    entered = Some(text);
                }
            } else if response.has_focus() {
                ui.data_mut(|data| data.insert_temp(id, text));
            }
        });
        entered
    }
}
