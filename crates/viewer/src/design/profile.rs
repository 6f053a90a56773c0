//! The section of the profile.

use eframe::egui::{self, RichText, Ui};
use foldmotion_geometry::Profile;
use foldmotion_study::{Draft, models};

use super::canvas::Canvas;
use super::curve::{
    ProfileKind, into_control_points, into_file, into_model, into_points, model, own_profile,
};
use super::form::{Field, Form, note};
use super::number::{Number, control_width, short};

/// State of the section that lasts from frame to frame.
#[derive(Debug, Default)]
pub(super) struct ProfileSection {
    canvas: Canvas,
    /// Whether the user has chosen a file as the kind of profile but has not named it yet.
    names_file: bool,
}

impl ProfileSection {
    pub(super) fn show(&mut self, form: &mut Form<'_>, ui: &mut Ui) {
        form.section(ui, "Profile", true, &["profile"], |form, ui| {
            self.show_kinds(form, ui);
            self.canvas.show(form, ui);
            show_division(form, ui);
            self.show_buttons(form, ui);
            form.errors_of(ui, "profile.control_points");
            form.errors_of(ui, "profile.points");
            form.errors_of(ui, "profile.knots");
            show_keys(form, ui);
        });
    }

    /// The choice of the kind of profile, with the controls of that kind.
    fn show_kinds(&mut self, form: &mut Form<'_>, ui: &mut Ui) {
        let at = ProfileKind::of(&form.scene.profile);
        self.names_file &= at != ProfileKind::File;
        let shown = if self.names_file { ProfileKind::File } else { at };
        let ways = [
            (ProfileKind::Model, "built-in", "A profile of figure 6 and table 1 of the paper"),
            (
                ProfileKind::ControlPoints,
                "control points",
                "A cubic NURBS with unit weights (section 2 of the paper)",
            ),
            (ProfileKind::Points, "points", "A cubic spline through points"),
            (ProfileKind::File, "file", "Points from a .csv, .dat or .dxf file"),
        ];
        form.scope(ui, "profile kind", |form, ui| {
            ui.horizontal_wrapped(|ui| {
                for (kind, name, tip) in ways {
                    let option = ui.selectable_label(kind == shown, name).on_hover_text(tip);
                    if option.clicked() && kind != shown {
                        self.names_file = kind == ProfileKind::File;
                        if convert_to(form, kind) {
                            form.record("kind of profile", option.id, false);
                        }
                    }
                }
            });
        });
        match shown {
            ProfileKind::Model => show_models(form, ui),
            ProfileKind::File => show_file(form, ui),
            ProfileKind::ControlPoints | ProfileKind::Points => {}
        }
    }

    fn show_buttons(&mut self, form: &mut Form<'_>, ui: &mut Ui) {
        form.scope(ui, "profile buttons", |form, ui| {
            ui.horizontal(|ui| {
                if ui.small_button("fit").on_hover_text("Show the whole profile").clicked() {
                    self.canvas.view.fit();
                }
                if ProfileKind::of(&form.scene.profile) != ProfileKind::ControlPoints {
                    let edit = ui.small_button("edit as control points").on_hover_text(
                        "Convert the same curve to control points, which can be dragged",
                    );
                    if edit.clicked() && convert_to(form, ProfileKind::ControlPoints) {
                        form.record("edit as control points", edit.id, false);
                    }
                }
            });
        });
        let has_handles = super::curve::handles(&form.scene.profile).is_some();
        if has_handles {
            self.canvas.handle_editor.show_fields(form, ui);
        }
    }
}

/// Converts the curve to another kind; returns false if it stays as it is for now.
fn convert_to(form: &mut Form<'_>, kind: ProfileKind) -> bool {
    let drawn = form.draft.and_then(Draft::units).map(|draft| &draft.profile);
    match kind {
        ProfileKind::Model => {
            let name = models().first().map_or("shelter", |model| model.name);
            into_model(&mut form.scene, name);
            true
        }
        ProfileKind::ControlPoints => into_control_points(&mut form.scene, drawn),
        ProfileKind::Points => into_points(&mut form.scene, drawn),
        ProfileKind::File => false,
    }
}

fn show_models(form: &mut Form<'_>, ui: &mut Ui) {
    let field = Field::new("profile.model", "model");
    form.row(ui, &field, |form, ui, label| {
        let given = form.scene.profile.model.clone();
        let text = match &given {
            Some(name) => RichText::new(name),
            None => RichText::new("choose one").weak(),
        };
        let menu = egui::ComboBox::from_id_salt("model")
            .selected_text(text)
            .truncate()
            .width(control_width(ui));
        let mut chosen = None;
        let response = menu.show_ui(ui, |ui| {
            for model in models() {
                let ends = if model.is_closed() { "closed" } else { "open" };
                let text = format!("{} ({ends}): {}", model.name, model.title);
                let is_chosen = given.as_deref() == Some(model.name);
                if ui.selectable_label(is_chosen, text).clicked() && !is_chosen {
                    chosen = Some(model.name);
                }
            }
        });
        let response = response.response.labelled_by(label);
        if let Some(name) = chosen {
            into_model(&mut form.scene, name);
            form.record(field.name, response.id, false);
        }
    });
}

fn show_file(form: &mut Form<'_>, ui: &mut Ui) {
    let field = Field::new("profile.file", "file");
    let path = form.scene.profile.file.clone().unwrap_or_default();
    let entered = form.text(ui, &field, "outline.csv", &path);
    if let Some(file) = entered {
        into_file(&mut form.scene, file);
    }
}

/// The quality of the division, as numbers.
fn show_division(form: &Form<'_>, ui: &mut Ui) {
    let text = match form.draft.and_then(Draft::units) {
        None => "not divided yet".to_owned(),
        Some(draft) => {
            let division = &draft.division;
            format!(
                "{} segments, |R_max| {:.1e}, fit {} (mean {}){}",
                division.points.len() - 1,
                division.max_residual,
                short(draft.fit.largest),
                short(draft.fit.mean),
                scale_note(form, &draft.profile)
            )
        }
    };
    let tip = "|R_max| = max |h_k − h| / h (equation 1 of the paper). Fit: the largest and the mean distance of the \
               curve from its segments.";
    let label = egui::Label::new(note(ui, text)).wrap();
    ui.add(label).on_hover_text(tip);
}

/// The factor by which the curve is scaled to its length.
fn scale_note(form: &Form<'_>, drawn: &Profile) -> String {
    let Some(own) = own_profile(&form.scene.profile) else {
        return String::new();
    };
    let factor = drawn.magnitude() / own.magnitude();
    if factor.is_finite() && (factor - 1.0).abs() > 1e-9 {
        format!("; scaled by {}", short(factor))
    } else {
        String::new()
    }
}

fn show_keys(form: &mut Form<'_>, ui: &mut Ui) {
    let built_in = model(&form.scene);
    if built_in.is_none() || form.scene.profile.closed.is_some() {
        let field = Field::new("profile.closed", "ends");
        form.menu(ui, &field, "open", |scene| &mut scene.profile.closed);
    }
    let length = built_in.map(foldmotion_study::ProfileModel::length);
    let field = Field::new("profile.length", "length");
    let number = Number::within(1e-6..=1e6).default(length).hint("as drawn");
    form.number(ui, &field, &number, |scene| &mut scene.profile.length);
    let field = Field::new("profile.unit", "unit");
    form.menu(ui, &field, "m", |scene| &mut scene.profile.unit);
}
