//! Menus, check boxes and text fields for keys of the scene.

use eframe::egui::{self, RichText, TextEdit, Ui};
use foldmotion_study::Scene;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::form::{Field, Form};
use super::number::control_width;
use foldmotion_study::scene::fields::choices;

impl Form<'_> {
    /// A row with a menu of the values that the schema allows. `default` names what holds if the key is omitted: one of the
    /// values, or something of its own. It is listed first, and choosing it omits the key.
    pub(super) fn menu<T>(
        &mut self,
        ui: &mut Ui,
        field: &Field,
        default: &'static str,
        of: impl Fn(&mut Scene) -> &mut Option<T>,
    ) where
        T: Copy + PartialEq + Serialize + DeserializeOwned,
    {
        self.menu_of(ui, field, default, choices(&field.key), of);
    }

    /// A row with a menu of the named values in `choices`, each with its description.
    pub(super) fn menu_of<T>(
        &mut self,
        ui: &mut Ui,
        field: &Field,
        default: &'static str,
        choices: Vec<(&'static str, &'static str)>,
        of: impl Fn(&mut Scene) -> &mut Option<T>,
    ) where
        T: Copy + PartialEq + Serialize + DeserializeOwned,
    {
        self.row(ui, field, |form, ui, label| {
            let given = *of(&mut form.scene);
            let given_name = given.and_then(|value| serde_json::to_value(value).ok());
            let given_name = given_name.as_ref().and_then(Value::as_str);
            let text = given_name.map_or_else(|| RichText::new(default).weak(), RichText::new);
            let menu = egui::ComboBox::from_id_salt(&*field.key)
                .selected_text(text)
                .truncate()
                .width(control_width(ui));
            let mut chosen = None;
            let response = menu.show_ui(ui, |ui| {
                let (first, others): (Vec<_>, Vec<_>) =
                    choices.into_iter().partition(|(name, _)| *name == default);
                let tip = first.first().map_or("", |(_, tip)| *tip);
                let is_chosen = given_name.is_none_or(|name| name == default);
                if option(ui, is_chosen, &format!("{default} (default)"), tip) {
                    chosen = Some(None);
                }
                for (name, tip) in others {
                    if option(ui, given_name == Some(name), name, tip) {
                        chosen = serde_json::from_value(name.into()).ok().map(Some);
                    }
                }
            });
            let response = response.response.labelled_by(label);
            if let Some(chosen) = chosen.filter(|&chosen| chosen != given) {
                *of(&mut form.scene) = chosen;
                form.record(field.name, response.id, false);
            }
        });
    }

    /// A row with a check box; the key is omitted if its value is the default.
    pub(super) fn switch(
        &mut self,
        ui: &mut Ui,
        field: &Field,
        default: bool,
        of: impl Fn(&mut Scene) -> &mut Option<bool>,
    ) {
        self.scope(ui, &field.key, |form, ui| {
            let mut is_on = of(&mut form.scene).unwrap_or(default);
            let response = ui.checkbox(&mut is_on, field.name).on_hover_text(field.tip());
            if response.changed() {
                *of(&mut form.scene) = (is_on != default).then_some(is_on);
                form.record(field.name, response.id, false);
            }
        });
        self.errors_of(ui, &field.key);
    }

    /// A row with a text field; its text is returned once the user presses Enter or leaves the field.
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
            let mut text =
                ui.data(|data| data.get_temp::<String>(id)).unwrap_or_else(|| value.to_owned());
            let edit = TextEdit::singleline(&mut text)
                .id(id)
                .hint_text(hint)
                .desired_width(control_width(ui) - 8.0);
            let response = ui.add(edit).labelled_by(label);
            if response.lost_focus() {
                ui.data_mut(|data| data.remove::<String>(id));
                let is_cancelled = ui.input(|input| input.key_pressed(egui::Key::Escape));
                if !is_cancelled && text != value {
                    form.record(field.name, id, false);
                    entered = Some(text);
                }
            } else if response.has_focus() {
                ui.data_mut(|data| data.insert_temp(id, text));
            }
        });
        entered
    }
}

/// An entry of a menu; returns whether it was clicked.
fn option(ui: &mut Ui, is_chosen: bool, name: &str, tip: &str) -> bool {
    let mut response = ui.selectable_label(is_chosen, name);
    if !tip.is_empty() {
        response = response.on_hover_text(tip);
    }
    response.clicked()
}
