//! The scene as text, for keys without a control and for scenes with errors.

use eframe::egui::{Align, FontId, Id, Layout, ScrollArea, TextEdit, TextStyle, Ui};

use super::Viewer;

impl Viewer {
    pub(super) fn text_panel(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            let label = ui.strong("scene as text");
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                if ui.button("Design").on_hover_text("Back to the design panel (F7)").clicked() {
                    self.settings.panels.text = false;
                    self.must_fix_text = false;
                }
            });
            label
        });
        if let Some(error) = self.document.parse_error() {
            ui.colored_label(ui.visuals().error_fg_color, error.to_string());
        } else if let Some(error) = self.resolved.errors.first() {
            ui.colored_label(ui.visuals().error_fg_color, &error.message);
        }
        let mut text = self.document.text().to_owned();
        let height = ui.available_height();
        ScrollArea::both().auto_shrink(false).max_height(height).show(ui, |ui| {
            let font: FontId = TextStyle::Monospace.resolve(ui.style());
            let editor = TextEdit::multiline(&mut text)
                // It has its own id so that it keeps the keyboard focus when messages above it come and go.
                .id(Id::unique("scene text"))
                .font(font)
                .desired_width(f32::INFINITY)
                .desired_rows(40)
                .code_editor();
            let response = ui.add(editor).accessible_name("Scene as text");
            if response.changed() {
                self.document.set_text(&text, true);
            }
            if response.lost_focus() {
                self.document.end_step();
            }
        });
    }
}
