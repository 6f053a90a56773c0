//! The section of the sheet and the division.

use eframe::egui::Ui;
use foldmotion_study::Draft;
use foldmotion_study::scene::{CaseChoice, DivisionMethod, UnequalChoice};

use super::curve::{columns_case, model, own_case};
use super::form::{Field, Form, note};
use super::number::{Number, short};
use super::unit_size::{USUAL_LAMBDA, UnitSize};
use foldmotion_study::scene::fields::{choices, tip};

/// State of the section that lasts from frame to frame.
#[derive(Debug, Default)]
pub(super) struct SheetSection {
    /// λ and d of case SII while another case is chosen.
    set_aside: Option<(Option<f64>, Option<f64>)>,
}

impl SheetSection {
    pub(super) fn show(&mut self, form: &mut Form<'_>, ui: &mut Ui) {
        form.section(ui, "Sheet", true, &["sheet", "division"], |form, ui| {
            show_counts(form, ui);
            self.show_cases(form, ui);
            show_widths(form, ui);
            show_rest(form, ui);
            show_division(form, ui);
        });
    }

    fn show_cases(&mut self, form: &mut Form<'_>, ui: &mut Ui) {
        let given = form.scene.sheet.case.unwrap_or(CaseChoice::Auto);
        let mut chosen = None;
        form.scope(ui, "sheet.case", |form, ui| {
            ui.horizontal_wrapped(|ui| {
                ui.spacing_mut().item_spacing.x = 3.0;
                ui.label("case").on_hover_text(tip("sheet.case"));
                ui.add_space(4.0);
                for (name, meaning) in choices("sheet.case") {
                    let Ok(case) = serde_json::from_value::<CaseChoice>(name.into()) else {
                        continue;
                    };
                    let why_not = own_case(case)
                        .and_then(|own| UnitSize::of(form, Some(case))?.contradiction(own))
                        .filter(|_| case != given);
                    let option = ui.add_enabled_ui(why_not.is_none(), |ui| {
                        ui.selectable_label(case == given, name)
                    });
                    let option = option.inner.accessible_name(format!("case {name}"));
                    let option = option
                        .on_hover_text(meaning)
                        .on_disabled_hover_text(why_not.unwrap_or_default());
                    if option.clicked() && case != given {
                        chosen = Some((case, option.id));
                    }
                }
            });
        });
        if let Some((case, id)) = chosen {
            self.choose(form, case);
            form.record("case", id, false);
        }
        form.errors_of(ui, "sheet.case");
    }

    /// Chooses a case, keeping λ and d only if the case uses them.
    fn choose(&mut self, form: &mut Form<'_>, case: CaseChoice) {
        let sheet = &mut form.scene.sheet;
        sheet.case = (case != CaseChoice::Auto).then_some(case);
        let is_common_flap = sheet.unequal == Some(UnequalChoice::CommonFlap);
        if case == CaseChoice::SII {
            if sheet.lambda.is_none() {
                let (lambda, offset) = self.set_aside.take().unwrap_or_default();
                sheet.lambda = lambda.or(Some(USUAL_LAMBDA));
                sheet.offset = sheet.offset.or(offset);
            }
        } else if !is_common_flap && (sheet.lambda.is_some() || sheet.offset.is_some()) {
            self.set_aside = Some((sheet.lambda.take(), sheet.offset.take()));
        }
    }
}

fn show_counts(form: &mut Form<'_>, ui: &mut Ui) {
    let size = UnitSize::of(form, form.scene.sheet.case);
    let default = size.and_then(|size| Some(size.width? * size.columns as f64));
    let field = Field::new("sheet.width", "width W");
    let number = Number::within(1e-6..=1e6).default(default).hint("required");
    form.number(ui, &field, &number, |scene| &mut scene.sheet.width);
    let built_in = model(&form.scene);
    let rows = size.map(|size| size.rows as f64);
    let field = Field::new("sheet.rows", "rows Nr");
    let number = Number::within(1.0..=1000.0).default(rows).hint("required");
    form.whole(ui, &field, number, |scene| &mut scene.sheet.rows);
    let case = columns_case(form.scene.sheet.case);
    let columns = built_in.map(|model| model.columns.of(case) as f64);
    let field = Field::new("sheet.columns", "columns Nc");
    let number = Number::within(1.0..=1000.0).default(columns).hint("required");
    form.whole(ui, &field, number, |scene| &mut scene.sheet.columns);
    let text = match size {
        Some(UnitSize { width: Some(w), height: h, .. }) => {
            format!("w = {}, h = {}, w/h = {}", short(w), short(h), short(w / h))
        }
        Some(UnitSize { height: h, .. }) => format!("h = {}; w requires a width", short(h)),
        None => "w and h are not known yet".to_owned(),
    };
    ui.label(note(ui, text))
        .on_hover_text("The size of a unit: w = W/Nc, and h is the mean length of a segment.");
}

/// λ and d, if they have an effect or are in the scene.
fn show_widths(form: &mut Form<'_>, ui: &mut Ui) {
    let sheet = &form.scene.sheet;
    let size = UnitSize::of(form, sheet.case).and_then(|size| Some((size.width?, size.height)));
    let is_common_flap = sheet.unequal == Some(UnequalChoice::CommonFlap);
    let is_sii = sheet.case == Some(CaseChoice::SII);
    let may_be_sii = matches!(sheet.case, None | Some(CaseChoice::Auto))
        && size.is_some_and(|(w, h)| w > h * (1.0 + foldmotion_pattern::EQUAL_WIDTH_TOLERANCE));
    let means_something = is_sii || may_be_sii || is_common_flap;
    if means_something || sheet.lambda.is_some() {
        let field = Field::new("sheet.lambda", "λ");
        let hint = if is_sii { "required" } else { "none" };
        let number = Number::within(0.01..=if is_common_flap { 1.0 } else { 0.99 })
            .default(is_common_flap.then_some(0.9))
            .hint(hint)
            .speed(0.005);
        form.number(ui, &field, &number, |scene| &mut scene.sheet.lambda);
    }
    let sheet = &form.scene.sheet;
    if means_something && sheet.lambda.is_some() || is_common_flap || sheet.offset.is_some() {
        let limit = if is_common_flap {
            let draft = form.draft.and_then(Draft::units);
            draft.map(|draft| draft.units.unit.width / 2.0 - draft.units.unit.flap)
        } else {
            size.map(|(w, h)| w / 2.0 - sheet.lambda.unwrap_or(USUAL_LAMBDA) * h / 2.0)
        };
        let limit = limit.filter(|&limit| limit > 0.0);
        let field = Field::new("sheet.offset", "offset d");
        let number = Number::within(0.0..=limit.unwrap_or(1e6) * 0.999)
            .default(limit.map(|limit| limit / 2.0))
            .hint("w1'/2")
            .speed(limit.unwrap_or(1.0) / 200.0);
        form.number(ui, &field, &number, |scene| &mut scene.sheet.offset);
        if let Some(limit) = limit {
            let most = if is_common_flap { "≤" } else { "<" };
            let text = format!("0 < λ {most} 1; 0 ≤ d < {}", short(limit));
            ui.label(note(ui, text));
        }
    }
}

fn show_rest(form: &mut Form<'_>, ui: &mut Ui) {
    let field = Field::new("sheet.facing", "flaps stand");
    form.menu(ui, &field, "left", |scene| &mut scene.sheet.facing);
    let field = Field::new("sheet.unequal", "unequal rows");
    form.menu(ui, &field, "refuse", |scene| &mut scene.sheet.unequal);
    let field = Field::new("sheet.folding", "folds as");
    form.menu(ui, &field, "waterbomb", |scene| &mut scene.sheet.folding);
}

fn show_division(form: &mut Form<'_>, ui: &mut Ui) {
    let field = Field::new("division.method", "division");
    form.menu(ui, &field, "equal-length", |scene| &mut scene.division.method);
    let is_split = form.scene.division.method == Some(DivisionMethod::DouglasPeucker);
    let field = Field::new("division.tolerance", "tolerance");
    let number = if is_split {
        Number::within(1e-6..=0.5).hint("from rows").speed(1e-4)
    } else {
        Number::within(0.0..=0.1).default(1e-14)
    };
    form.number(ui, &field, &number, |scene| &mut scene.division.tolerance);
    let field = Field::new("division.max_iterations", "iterations");
    let number = Number::within(1.0..=10_000.0).default(200.0);
    form.whole(ui, &field, number, |scene| &mut scene.division.max_iterations);
}
