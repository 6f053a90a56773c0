//! The section of a crease pattern that is imported from a file.

use eframe::egui::{RichText, Ui};
use foldmotion_study::scene::PatternScene;
use foldmotion_study::{Draft, ImportedStudy, Scene};

use super::closed_forms::{Measurements, value_row};
use super::form::{Field, Form, NOTE_SIZE};
use super::number::{AccessibleName, Number, short};

/// The table `[pattern]`; this section is only shown if the scene has one.
fn of(scene: &mut Scene) -> &mut PatternScene {
    scene.pattern.get_or_insert_default()
}

pub(super) fn show(measurements: &mut Measurements, form: &mut Form<'_>, ui: &mut Ui) {
    form.section(ui, "Pattern", true, &["pattern", "profile", "sheet", "division"], |form, ui| {
        show_file(form, ui);
        show_fold(form, ui);
        show_reading(form, ui);
        if let Some(Draft::Imported(study)) = form.draft {
            measurements.update(form);
            show_facts(study, measurements, ui);
        }
    });
}

fn show_file(form: &mut Form<'_>, ui: &mut Ui) {
    let field = Field::new("pattern.file", "file");
    let path = of(&mut form.scene).file.clone();
    if let Some(file) = form.text(ui, &field, "pattern.fold", &path) {
        of(&mut form.scene).file = file;
    }
    let field = Field::new("pattern.unit", "unit");
    form.menu(ui, &field, "as the file says", |scene| &mut of(scene).unit);
}

fn show_fold(form: &mut Form<'_>, ui: &mut Ui) {
    let field = Field::new("pattern.fold_percent", "fold %");
    let number = Number::within(-100.0..=100.0).default(100.0).speed(0.5);
    form.number(ui, &field, &number, |scene| &mut of(scene).fold_percent);
    let field = Field::new("pattern.stages", "frames are stages");
    form.switch(ui, &field, true, |scene| &mut of(scene).stages);
    let field = Field::new("pattern.fixed", "fixed facet");
    form.row(ui, &field, |form, ui, label| {
        let width = ui.available_width() - 70.0;
        let given = form.scene.pattern.as_ref().and_then(|pattern| pattern.fixed.clone());
        let is_none = given.as_ref().is_some_and(Vec::is_empty);
        let mut first = given.as_ref().and_then(|list| list.first().copied());
        let hint = if is_none { "none" } else { "from file" };
        let number = Number::within(0.0..=1e6).whole().hint(hint);
        let spoken = AccessibleName::By(label);
        if form.whole_cell(ui, field.name, spoken, &number, width, &mut first) {
            of(&mut form.scene).fixed = first.map(|facet| vec![facet]);
        }
        let none = ui.selectable_label(is_none, "none").on_hover_text("No facet stays in place.");
        if none.clicked() {
            of(&mut form.scene).fixed = (!is_none).then(Vec::new);
            form.record(field.name, none.id, false);
        }
    });
}

/// The keys that say how the file is read.
fn show_reading(form: &mut Form<'_>, ui: &mut Ui) {
    let field = Field::new("pattern.unknown", "unknown lines");
    form.menu(ui, &field, "auxiliary", |scene| &mut of(scene).unknown);
    let field = Field::new("pattern.vertex_tolerance", "merge within");
    let number = Number::within(0.0..=1e3).hint("from diagonal").speed(1e-3);
    form.number(ui, &field, &number, |scene| &mut of(scene).vertex_tolerance);
    let field = Field::new("pattern.curve_tolerance", "flatten curves");
    let number = Number::within(1e-6..=0.1).default(1e-3).speed(1e-5);
    form.number(ui, &field, &number, |scene| &mut of(scene).curve_tolerance);
    let field = Field::new("pattern.curved_facets", "curved facets");
    form.menu(ui, &field, "rulings", |scene| &mut of(scene).curved_facets);
    let field = Field::new("pattern.piece", "pieces");
    let piece = of(&mut form.scene).piece.clone().unwrap_or_default();
    if let Some(piece) = form.text(ui, &field, "main", &piece) {
        of(&mut form.scene).piece = Some(piece).filter(|piece| !piece.is_empty());
    }
}

fn show_facts(study: &ImportedStudy, measurements: &Measurements, ui: &mut Ui) {
    let imported = &study.imported;
    ui.add_space(4.0);
    if let Some(title) = &imported.title {
        value_row(ui, "title", title, "The title in the file.");
    }
    let length = format!("{} {}", short(imported.sheet.unit_length), study.unit_name);
    let tip = "The unit of the contact gap and of tolerances.";
    value_row(ui, "mean edge", &length, tip);
    measurements.counts.show(ui);
    let stages = study.waypoints.len();
    if stages > 1 {
        let tip = "Stages of the motion, from the frames of the file.";
        value_row(ui, "stages", &stages.to_string(), tip);
    }
    if let Some(facet) = study.fixed {
        let tip = "The facet that stays in place.";
        value_row(ui, "stays", &format!("facet {facet}"), tip);
    }
    for warning in &imported.warnings {
        let text =
            RichText::new(warning.to_string()).size(NOTE_SIZE).color(ui.visuals().warn_fg_color);
        ui.add(eframe::egui::Label::new(text).wrap());
    }
}
