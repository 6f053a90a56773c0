//! The help sheet: keys, mouse gestures, terms, version and citation.

use eframe::egui::{Context, Grid, Id, Key, Modal, Modifiers, ScrollArea, Ui};

use super::appearance::modal_frame;
use super::shortcuts::{Group, SHORTCUTS, written};

/// The groups of commands in the two columns.
const COLUMNS: [&[Group]; 2] = [
    &[Group::File, Group::Edit, Group::Motion, Group::Time],
    &[Group::View, Group::Colours, Group::Window],
];

/// Mouse gestures: where, what they do, and how.
const MOUSE: [(&str, &[(&str, &str)]); 2] = [
    (
        "Mouse in the 3D view",
        &[
            ("turn", "drag"),
            ("move", "right drag or Shift drag"),
            ("zoom", "wheel or pinch"),
            ("fit to the window", "double click"),
            ("pull a vertex (by hand)", "drag it"),
        ],
    ),
    (
        "Mouse on the profile",
        &[
            ("move a point", "drag it"),
            ("add a point", "double click"),
            ("remove a point", "right click on it, or Delete"),
            ("move the canvas", "right or middle drag"),
            ("zoom", "wheel or pinch"),
        ],
    ),
];

const TERMS: [(&str, &str); 3] = [
    ("Touching", "Facets lie on each other and separate on the same side."),
    ("Penetrating", "Facets overlap by more than the tolerance, or separate on the other side."),
    ("Free", "No facets come within the tolerance of each other."),
];

const CITE: &str = "Please cite foldmotion with its version, and the paper it implements: Constructing foldable \
                    cylindrical surfaces via unfolded waterbomb origami units. CITATION.cff has the entries.";

pub(crate) fn show_help(ctx: &Context, open: &mut bool) {
    if !*open {
        return;
    }
    let room = ctx.content_rect().size();
    let modal = Modal::new(Id::unique("help")).frame(modal_frame(ctx));
    let modal = modal.show(ctx, |ui| {
        ui.set_width((room.x - 80.0).clamp(200.0, 760.0));
        ui.heading("Help");
        let height = (room.y - 140.0).max(80.0);
        let scroll = ScrollArea::vertical().auto_shrink([false, true]);
        let scroll = scroll.max_height(height).min_scrolled_height(height);
        scroll.show(ui, contents);
        ui.separator();
        let close = ui.button("Close").clicked();
        close || ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::F1))
    });
    if modal.should_close() || modal.inner {
        *open = false;
    }
}

fn contents(ui: &mut Ui) {
    ui.columns(2, |columns| {
        for (ui, groups) in columns.iter_mut().zip(COLUMNS) {
            for &group in groups {
                keys(ui, group);
            }
        }
    });
    ui.columns(2, |columns| {
        for (ui, (title, gestures)) in columns.iter_mut().zip(MOUSE) {
            let rows = gestures.iter();
            let rows = rows.map(|&(what, how)| (what.to_owned(), how.to_owned()));
            table(ui, title, rows);
        }
    });
    title(ui, "Terms");
    for (word, meaning) in TERMS {
        ui.horizontal_wrapped(|ui| {
            ui.strong(word);
            ui.label(meaning);
        });
    }
    title(ui, &format!("foldmotion {}", env!("CARGO_PKG_VERSION")));
    ui.label(CITE);
}

/// The commands of a group with their keys.
fn keys(ui: &mut Ui, group: Group) {
    let rows = SHORTCUTS.iter().filter(|shortcut| shortcut.group == group);
    let ctx = ui.ctx().clone();
    let rows = rows.map(|shortcut| {
        let keys = shortcut.keys.iter().map(|&keys| written(&ctx, keys));
        let keys: Vec<String> = keys.collect();
        (shortcut.name.to_owned(), keys.join(" or "))
    });
    let rows: Vec<_> = rows.collect();
    table(ui, group.name(), rows.into_iter());
}

fn table(ui: &mut Ui, name: &str, rows: impl Iterator<Item = (String, String)>) {
    title(ui, name);
    let half = 0.5 * ui.available_width() - 12.0;
    let grid = Grid::new(name).num_columns(2).spacing([8.0, 2.0]);
    let grid = grid.min_row_height(16.0).min_col_width(half).max_col_width(half);
    grid.show(ui, |ui| {
        for (what, how) in rows {
            ui.label(what);
            ui.label(how);
            ui.end_row();
        }
    });
}

fn title(ui: &mut Ui, text: &str) {
    ui.add_space(8.0);
    ui.strong(text);
}

#[cfg(test)]
mod tests {
    use eframe::egui::{Theme, vec2};
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;

    use super::super::Appearance;
    use super::super::tests::{builder, drawn};
    use super::*;

    fn harness(appearance: Appearance) -> Harness<'static, bool> {
        let builder = builder(appearance, vec2(900.0, 1000.0));
        builder.build_ui_state(|ui, open| show_help(ui.ctx(), open), true)
    }

    #[test]
    fn the_sheet_lists_every_command_with_its_keys() {
        let mut harness = harness(Appearance::Dark);
        harness.run();
        for shortcut in SHORTCUTS {
            harness.get_by_label(shortcut.name);
            let listed = COLUMNS.iter().any(|groups| groups.contains(&shortcut.group));
            assert!(listed, "{shortcut:?}");
        }
        harness.get_by_label_contains("F5");
        harness.get_by_label(&format!("foldmotion {}", env!("CARGO_PKG_VERSION")));
    }

    #[test]
    fn escape_f1_and_the_button_close_the_sheet() {
        for close in [Key::Escape, Key::F1] {
            let mut harness = harness(Appearance::Dark);
            harness.run();
            harness.key_press(close);
            harness.run();
            assert!(!harness.state(), "{close:?}");
        }
        let mut harness = harness(Appearance::Light);
        harness.run();
        harness.get_by_label("Close").click();
        harness.run();
        assert!(!harness.state());
    }

    #[test]
    #[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
    fn the_sheet_is_drawn_dark_and_light() {
        for (appearance, theme) in
            [(Appearance::Dark, Theme::Dark), (Appearance::Light, Theme::Light)]
        {
            let mut harness = harness(appearance);
            harness.run();
            assert_eq!(harness.ctx.theme(), theme);
            let lit = drawn(&mut harness, &format!("help-{}", appearance.name()), [450, 500]);
            assert_eq!(lit < 128, theme == Theme::Dark, "{lit}");
        }
    }
}
