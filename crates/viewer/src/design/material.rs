//! The section of the material.

use eframe::egui::Ui;
use foldmotion_solver::Material;
use foldmotion_study::Scene;
use foldmotion_study::scene::{FacetModelChoice, PresetChoice};

use super::form::{Field, Form, note};
use super::number::Number;

/// A key of a constant.
type Of = fn(&mut Scene) -> &mut Option<f64>;

pub(super) fn show(form: &mut Form<'_>, ui: &mut Ui) {
    form.section(ui, "Material", false, &["material"], |form, ui| {
        show_presets(form, ui);
        let preset = form.scene.material.preset;
        let standard = preset
            .and_then(|preset| Material::preset(preset.name()))
            .unwrap_or_default();
        show_constants(form, ui, &standard);
        show_facet_model(form, ui);
        let field = Field::new(
            "material.thickness",
            "thickness",
            "change the thickness",
            "of the sheet, in its unit of length: layers come no closer than this; not with a gap",
        );
        let number = Number::within(0.0..=1e3).hint("none").speed(1e-4);
        form.number(ui, &field, &number, |scene| &mut scene.material.thickness);
    });
}

fn show_presets(form: &mut Form<'_>, ui: &mut Ui) {
    let ways = [
        (
            None,
            "standard",
            "Origami Simulator's constants, without its face-angle springs",
        ),
        (
            Some(PresetChoice::OrigamiSimulator),
            "Origami Simulator",
            "its constants, face-angle springs included",
        ),
        (
            Some(PresetChoice::Paper),
            "paper",
            "stiff bars, soft creases: strains below a per cent",
        ),
        (
            Some(PresetChoice::NearRigid),
            "near rigid",
            "bars that strain by less than a thousandth",
        ),
    ];
    let given = form.scene.material.preset;
    form.part(ui, "material.preset", |form, ui| {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 6.0;
            for (preset, name, tip) in ways {
                let option = ui.radio(preset == given, name).on_hover_text(tip);
                if option.clicked() && preset != given {
                    form.scene.material.preset = preset;
                    form.record("change the material", option.id, false);
                }
            }
        });
    });
    form.errors_of(ui, "material.preset");
    let text = "only ratios shape the fold; a key below replaces that of the material above";
    ui.label(note(ui, text));
}

fn show_facet_model(form: &mut Form<'_>, ui: &mut Ui) {
    let ways = [
        (
            None,
            "standard",
            "with a middle node, unless one is narrower than a tenth of its length",
        ),
        (
            Some(FacetModelChoice::Symmetric),
            "middle node",
            "quadrilateral facets are four triangles around a node: a symmetric sheet moves symmetrically",
        ),
        (
            Some(FacetModelChoice::OneDiagonal),
            "one diagonal",
            "quadrilateral facets are two triangles: fewer nodes, unsymmetric motions",
        ),
    ];
    let given = form.scene.material.facet_model;
    form.part(ui, "material.facet_model", |form, ui| {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 6.0;
            ui.label("facets");
            for (model, name, tip) in ways {
                let option = ui.radio(model == given, name).on_hover_text(tip);
                if option.clicked() && model != given {
                    form.scene.material.facet_model = model;
                    form.record("change how facets are cut", option.id, false);
                }
            }
        });
    });
    form.errors_of(ui, "material.facet_model");
}

fn show_constants(form: &mut Form<'_>, ui: &mut Ui, standard: &Material) {
    let constants: [(&str, &str, &str, f64, f64, Of); 5] = [
        (
            "material.axial_stiffness",
            "bars EA",
            "stiffness of the bars: EA over the length of each",
            standard.axial_stiffness,
            1e5,
            |s| &mut s.material.axial_stiffness,
        ),
        (
            "material.fold_stiffness",
            "creases",
            "stiffness of a crease per unit length",
            standard.fold_stiffness,
            1e3,
            |s| &mut s.material.fold_stiffness,
        ),
        (
            "material.facet_stiffness",
            "facets",
            "stiffness of a facet hinge per unit length",
            standard.facet_stiffness,
            1e5,
            |s| &mut s.material.facet_stiffness,
        ),
        (
            "material.face_angle_stiffness",
            "face angles",
            "stiffness of the angles of each triangle (Origami Simulator sets 0.2)",
            standard.face_angle_stiffness,
            1e3,
            |s| &mut s.material.face_angle_stiffness,
        ),
        (
            "material.damping_ratio",
            "damping ζ",
            "of the dampers along the bars",
            standard.damping_ratio,
            10.0,
            |s| &mut s.material.damping_ratio,
        ),
    ];
    for (key, name, tip, default, most, of) in constants {
        let field = Field::new(key, name, "change the material", tip);
        let number = Number::within(0.0..=most).default(default);
        form.number(ui, &field, &number, of);
    }
}
