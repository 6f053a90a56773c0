//! The user interface of the file picker.

use eframe::egui::text::CCursorRange;
use eframe::egui::text_edit::TextEditState;
use eframe::egui::{
    Button, Context, Id, Key, Memory, Modal, Modifiers, RichText, ScrollArea, TextEdit, TextStyle,
    Ui, text::CCursor,
};

use super::super::appearance::modal_frame;
use super::{FilePicker, PickerResult};

/// The largest number of parent folders shown.
const MAX_BREADCRUMBS: usize = 6;

impl FilePicker {
    /// Shows the picker; returns the result once, after which it must not be shown again.
    pub(crate) fn show(&mut self, ctx: &Context) -> Option<PickerResult> {
        let room = ctx.content_rect().size();
        let modal = Modal::new(Id::unique("picker")).frame(modal_frame(ctx));
        let modal = modal.show(ctx, |ui| {
            ui.set_width((room.x - 80.0).clamp(240.0, 640.0));
            let picked = self.press_keys(ui);
            ui.heading(&self.title);
            self.breadcrumbs(ui);
            ui.separator();
            let height = (room.y - 260.0).clamp(80.0, 380.0);
            let chosen = ui.horizontal_top(|ui| {
                self.list_bookmarks(ui, height);
                ui.vertical(|ui| self.list(ui, height)).inner
            });
            ui.separator();
            picked.or(chosen.inner).or(self.footer(ui))
        });
        if modal.inner.is_some() {
            return modal.inner;
        }
        if modal.should_close() {
            // Escape answers the question about overwriting first.
            if self.overwrites.take().is_none() {
                return Some(PickerResult::Cancelled);
            }
        }
        None
    }

    /// Handles keys that move through the list, unless another control has the focus.
    fn press_keys(&mut self, ui: &Ui) -> Option<PickerResult> {
        let focused = ui.memory(Memory::focused);
        if self.overwrites.is_some() || focused.is_some_and(|id| id != text_id()) {
            return None;
        }
        let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        for (key, by) in
            [(Key::ArrowDown, 1), (Key::ArrowUp, -1), (Key::PageDown, 12), (Key::PageUp, -12)]
        {
            if pressed(key) {
                self.step(by);
            }
        }
        if self.typed.is_empty() && pressed(Key::Backspace) {
            self.up();
        } else if !self.typed.is_empty() && pressed(Key::Tab) {
            self.complete();
        }
        if pressed(Key::Enter) { self.enter() } else { None }
    }

    /// Buttons for the parent folders.
    fn breadcrumbs(&mut self, ui: &mut Ui) {
        let mut way: Vec<_> = self.folder.ancestors().map(ToOwned::to_owned).collect();
        let hidden = way.len() > MAX_BREADCRUMBS;
        way.truncate(MAX_BREADCRUMBS);
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 3.0;
            if hidden {
                ui.weak("…");
            }
            for folder in way.into_iter().rev() {
                let name = folder.file_name().map(|name| name.to_string_lossy().into_owned());
                let name = name.unwrap_or_else(|| folder.display().to_string());
                let tip = folder.display().to_string();
                if ui.button(name).on_hover_text(tip).clicked() {
                    self.go(&folder);
                }
            }
        });
    }

    /// The home folder and recent folders.
    fn list_bookmarks(&mut self, ui: &mut Ui, height: f32) {
        ui.vertical(|ui| {
            ui.set_width(110.0);
            ui.set_height(height);
            for (name, folder) in self.bookmarks.clone() {
                let button = Button::new(&name).frame(false).truncate();
                let tip = folder.display().to_string();
                if ui.add(button).on_hover_text(tip).clicked() {
                    self.go(&folder);
                }
            }
        });
    }

    /// The folders and files. Only visible rows are laid out.
    fn list(&mut self, ui: &mut Ui, height: f32) -> Option<PickerResult> {
        let row = ui.text_style_height(&TextStyle::Button).max(ui.spacing().interact_size.y);
        let mut scroll = ScrollArea::vertical().auto_shrink([false, false]).max_height(height);
        if std::mem::take(&mut self.scrolls) {
            let gap = ui.spacing().item_spacing.y;
            let pitch = row + gap;
            let above = self.selected.unwrap_or(0) as f32 * pitch - 0.5 * height;
            let most = self.shown.len() as f32 * pitch - gap - height;
            scroll = scroll.vertical_scroll_offset(above.min(most).max(0.0));
        }
        if self.shown.is_empty() {
            ui.weak("No matching files");
            return None;
        }
        let mut entered = false;
        scroll.show_rows(ui, row, self.shown.len(), |ui, rows| {
            for row in rows {
                let entry = &self.entries[self.shown[row]];
                let name = if entry.is_folder {
                    RichText::new(format!("{}/", entry.name)).strong()
                } else {
                    RichText::new(&entry.name)
                };
                let button = Button::selectable(self.selected == Some(row), name).truncate();
                let response = ui.add(button);
                if response.clicked() {
                    self.selected = Some(row);
                    self.name_selected();
                }
                if response.double_clicked() {
                    self.selected = Some(row);
                    entered = true;
                    break;
                }
            }
        });
        if entered { self.enter() } else { None }
    }

    /// The text field, the error message and the buttons, or the question about overwriting.
    fn footer(&mut self, ui: &mut Ui) -> Option<PickerResult> {
        if let Some(path) = self.overwrites.clone() {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            ui.label(format!("{name} already exists. Overwrite it?"));
            return ui
                .horizontal(|ui| {
                    if ui.button("Keep it").clicked() {
                        self.overwrites = None;
                    }
                    ui.button("Overwrite").clicked().then_some(PickerResult::File(path))
                })
                .inner;
        }
        ui.horizontal(|ui| {
            let label = ui.label(if self.is_saving { "Name" } else { "Name or path" });
            let tabs = !self.typed.is_empty();
            let field = TextEdit::singleline(&mut self.typed).id(text_id()).lock_focus(tabs);
            let field = ui.add(field.desired_width(f32::INFINITY)).labelled_by(label.id);
            if field.changed() {
                self.message = None;
                self.filter();
            }
            if std::mem::take(&mut self.focuses) {
                field.request_focus();
                put_cursor_last(ui, &self.typed);
            }
        });
        if let Some(message) = &self.message {
            ui.colored_label(ui.visuals().error_fg_color, message);
        }
        self.buttons(ui)
    }

    fn buttons(&mut self, ui: &mut Ui) -> Option<PickerResult> {
        ui.horizontal(|ui| {
            let action = if self.is_saving { "Save" } else { "Open" };
            let entered = ui.button(action).clicked();
            let cancelled = ui.button("Cancel").clicked();
            if ui.checkbox(&mut self.hidden, "hidden files").changed() {
                self.read();
            }
            if !self.endings.is_empty() {
                ui.weak(format!(".{}", self.endings.join(" .")));
            }
            if cancelled {
                Some(PickerResult::Cancelled)
            } else if entered {
                self.enter()
            } else {
                None
            }
        })
        .inner
    }
}

fn text_id() -> Id {
    Id::unique("picker text")
}

/// Moves the cursor to the end of the text, after a completion.
fn put_cursor_last(ui: &Ui, text: &str) {
    let mut state = TextEditState::load(ui.ctx(), text_id()).unwrap_or_default();
    let end = CCursor::new(text.chars().count());
    state.cursor.set_char_range(Some(CCursorRange::one(end)));
    state.store(ui.ctx(), text_id());
}
