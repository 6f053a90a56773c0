//! The section of the material.

use eframe::egui::{Label, Ui};
use foldmotion_solver::{Material, Preset};
use foldmotion_study::Scene;

use super::form::{Field, Form, note};
use super::number::Number;

/// The value of a constant in the scene.
type Constant = fn(&mut Scene) -> &mut Option<f64>;

pub(super) fn show(form: &mut Form<'_>, ui: &mut Ui) {
    form.section(ui, "Material", false, &["material"], |form, ui| {
        let field = Field::new("material.preset", "preset");
        form.menu(ui, &field, "standard", |scene| &mut scene.material.preset);
        let text = "Only the ratios of the constants shape the fold. Constants given below replace those of the preset.";
        ui.add(Label::new(note(ui, text)).wrap());
        let of_pattern = form.scene.pattern.as_ref().map(|_| Preset::OrigamiSimulator);
        let preset = form.scene.material.preset.or(of_pattern);
        let preset = preset.map(Preset::material);
        show_constants(form, ui, &preset.unwrap_or_default());
        let field = Field::new("material.facet_model", "facets");
        form.menu(ui, &field, "automatic", |scene| {
            &mut scene.material.facet_model
        });
        let field = Field::new("material.thickness", "thickness");
        let number = Number::within(0.0..=1e3).hint("none").speed(1e-4);
        form.number(ui, &field, &number, |scene| &mut scene.material.thickness);
    });
}

fn show_constants(form: &mut Form<'_>, ui: &mut Ui, preset: &Material) {
    let constants: [(&str, &str, f64, f64, Constant); 5] = [
        ("material.axial_stiffness", "bars EA", preset.axial_stiffness, 1e5, |s| {
            &mut s.material.axial_stiffness
        }),
        ("material.fold_stiffness", "creases", preset.fold_stiffness, 1e3, |s| {
            &mut s.material.fold_stiffness
        }),
        ("material.facet_stiffness", "facet hinges", preset.facet_stiffness, 1e5, |s| {
            &mut s.material.facet_stiffness
        }),
        ("material.face_angle_stiffness", "face angles", preset.face_angle_stiffness, 1e3, |s| {
            &mut s.material.face_angle_stiffness
        }),
        ("material.damping_ratio", "damping ζ", preset.damping_ratio, 10.0, |s| {
            &mut s.material.damping_ratio
        }),
    ];
    for (key, name, default, most, of) in constants {
        let number = Number::within(0.0..=most).default(default);
        form.number(ui, &Field::new(key, name), &number, of);
    }
}
