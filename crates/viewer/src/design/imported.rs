//! The section of a crease pattern that comes from a file.

use eframe::egui::{RichText, Ui};
use foldmotion_study::scene::{PatternScene, UnknownChoice};
use foldmotion_study::{Draft, ImportedStudy, Scene};

use super::choice::Way;
use super::closed_forms::{Measurements, fact};
use super::form::{Field, Form, NOTE_SIZE};
use super::number::{AccessibleName, Number, control_width, short};
use super::profile::UNITS;

const UNKNOWNS: [Way<UnknownChoice>; 2] = [
    (UnknownChoice::Refuse, "refuse", "the file is refused"),
    (UnknownChoice::Ignore, "ignore", "they are left out"),
];

/// Reads a key of `[pattern]`; only called where the scene has one.
fn of(scene: &mut Scene) -> &mut PatternScene {
    scene.pattern.get_or_insert_default()
}

pub(super) fn show(measurements: &mut Measurements, form: &mut Form<'_>, ui: &mut Ui) {
    form.section(
        ui,
        "Pattern",
        true,
        &["pattern", "profile", "sheet", "division"],
        |form, ui| {
            show_file(form, ui);
            show_fold(form, ui);
            show_reading(form, ui);
            if let Some(Draft::Imported(study)) = form.draft {
                measurements.update(form);
                show_facts(study, measurements, ui);
            }
        },
    );
}

fn show_file(form: &mut Form<'_>, ui: &mut Ui) {
    let field = Field::new(
        "pattern.file",
        "file",
        "choose the pattern",
        "a crease pattern beside the scene: .fold, or .svg in Origami Simulator's colours",
    );
    let path = of(&mut form.scene).file.clone();
    if let Some(file) = form.text(ui, &field, "pattern.fold", &path) {
        of(&mut form.scene).file = file;
    }
    let field = Field::new(
        "pattern.unit",
        "unit",
        "change the unit",
        "what a length of 1 in the file is; what the file says where left out",
    );
    let given = form.scene.pattern.as_ref().and_then(|pattern| pattern.unit);
    form.row(ui, &field, |form, ui, label| {
        let shown = UNITS.iter().find(|way| Some(way.0) == given);
        let text = shown.map_or(RichText::new("as the file says").weak(), |way| {
            RichText::new(way.1)
        });
        let menu = eframe::egui::ComboBox::from_id_salt("unit")
            .selected_text(text)
            .width(control_width(ui));
        let mut chosen = None;
        let response = menu.show_ui(ui, |ui| {
            if ui
                .selectable_label(given.is_none(), "as the file says")
                .clicked()
            {
                chosen = Some(None);
            }
            for (unit, name, tip) in UNITS {
                let option = ui
                    .selectable_label(given == Some(unit), name)
                    .on_hover_text(tip);
                if option.clicked() {
                    chosen = Some(Some(unit));
                }
            }
        });
        let response = response.response.labelled_by(label);
        if let Some(unit) = chosen.filter(|&unit| unit != given) {
            of(&mut form.scene).unit = unit;
            form.record(field.undo, response.id, false);
        }
    });
}

fn show_fold(form: &mut Form<'_>, ui: &mut Ui) {
    let field = Field::new(
        "pattern.fold_percent",
        "fold %",
        "change how far it folds",
        "percent of its fold angles, from -100 (inside out) to 100",
    );
    let number = Number::within(-100.0..=100.0).default(100.0).speed(0.5);
    form.number(ui, &field, &number, |scene| &mut of(scene).fold_percent);
    let field = Field::new(
        "pattern.stages",
        "frames are stages",
        "switch the stages",
        "whether frames of a FOLD file with fold angles are the stages of the motion",
    );
    form.switch(ui, &field, true, |scene| &mut of(scene).stages);
    let field = Field::new(
        "pattern.fixed",
        "fixed facet",
        "change the fixed facet",
        "the facet that stays in place, by its number in the preview; what the file says where left out",
    );
    form.row(ui, &field, |form, ui, label| {
        let width = ui.available_width() - 70.0;
        let given = form
            .scene
            .pattern
            .as_ref()
            .and_then(|pattern| pattern.fixed.clone());
        let is_none = given.as_ref().is_some_and(Vec::is_empty);
        let mut first = given.as_ref().and_then(|list| list.first().copied());
        let hint = if is_none { "none" } else { "by file" };
        let number = Number::within(0.0..=1e6).whole().hint(hint);
        let spoken = AccessibleName::By(label);
        if form.whole_cell(ui, field.undo, spoken, &number, width, &mut first) {
            of(&mut form.scene).fixed = first.map(|facet| vec![facet]);
        }
        let none = ui
            .selectable_label(is_none, "none")
            .on_hover_text("no facet stays in place");
        if none.clicked() {
            of(&mut form.scene).fixed = (!is_none).then(Vec::new);
            form.record(field.undo, none.id, false);
        }
    });
}

/// How the file is read.
fn show_reading(form: &mut Form<'_>, ui: &mut Ui) {
    let field = Field::new(
        "pattern.unknown",
        "unknown lines",
        "change what becomes of unknown lines",
        "what becomes of strokes and elements that mean nothing in a crease pattern",
    );
    form.menu(ui, &field, &UNKNOWNS, |scene| &mut of(scene).unknown);
    let field = Field::new(
        "pattern.vertex_tolerance",
        "merge within",
        "change the vertex tolerance",
        "ends of lines up to this far apart, in lengths of the file, are one vertex; 1e-4 of the diagonal of an SVG and 1e-9 of \
         that of a FOLD file where left out",
    );
    let number = Number::within(0.0..=1e3).hint("by diagonal").speed(1e-3);
    form.number(ui, &field, &number, |scene| &mut of(scene).vertex_tolerance);
    let field = Field::new(
        "pattern.curve_tolerance",
        "flatten curves",
        "change the curve tolerance",
        "Bézier curves become chords that stray by no more than this, in parts of the diagonal",
    );
    let number = Number::within(1e-6..=0.1).hint("refuse").speed(1e-5);
    form.number(ui, &field, &number, |scene| &mut of(scene).curve_tolerance);
}

fn show_facts(study: &ImportedStudy, measurements: &Measurements, ui: &mut Ui) {
    let imported = &study.imported;
    ui.add_space(4.0);
    if let Some(title) = &imported.title {
        fact(ui, "title", title, "what the file calls itself");
    }
    let length = format!("{} {}", short(imported.sheet.unit_length), study.unit_name);
    fact(
        ui,
        "mean edge",
        &length,
        "what gap and tolerances are measured in",
    );
    measurements.counts.show(ui);
    let stages = study.waypoints.len();
    if stages > 1 {
        fact(ui, "stages", &stages.to_string(), "of the file");
    }
    if let Some(facet) = study.fixed {
        fact(
            ui,
            "stays",
            &format!("facet {facet}"),
            "the facet that stays in place",
        );
    }
    for warning in &imported.warnings {
        let text = RichText::new(warning.to_string())
            .size(NOTE_SIZE)
            .color(ui.visuals().warn_fg_color);
        ui.add(eframe::egui::Label::new(text).wrap());
    }
}
