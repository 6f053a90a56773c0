//! The section of the sheet and the division.

use eframe::egui::Ui;
use foldmotion_study::Draft;
use foldmotion_study::scene::{
    CaseChoice, DivisionChoice, FacingChoice, FoldingChoice, UnequalChoice,
};

use super::choice::Way;
use super::curve::{columns_case, model};
use super::form::{Field, Form, note};
use super::number::{Number, short};
use super::unit_size::{USUAL_LAMBDA, UnitSize, own_case};

const CASES: [Way<CaseChoice>; 6] = [
    (
        CaseChoice::E,
        "E",
        "square units, w = h (section 2 of the paper)",
    ),
    (
        CaseChoice::T,
        "T",
        "tall units, w < h, split mid vertices (figure 3)",
    ),
    (
        CaseChoice::S,
        "S",
        "short units, w > h, side pads (figure 4)",
    ),
    (
        CaseChoice::SII,
        "SII",
        "short units with side and centre pads (figure 5)",
    ),
    (
        CaseChoice::Plain,
        "plain",
        "unmodified rectangles (figures 3a-d, 4a-d)",
    ),
    (
        CaseChoice::Auto,
        "auto",
        "E where w = h, T below, S above, or SII if lambda is given",
    ),
];

const FACINGS: [Way<FacingChoice>; 2] = [
    (
        FacingChoice::Left,
        "left",
        "on the left of the curve, seen along it",
    ),
    (FacingChoice::Right, "right", "on the right of it"),
];

const UNEQUAL: [Way<UnequalChoice>; 3] = [
    (
        UnequalChoice::Refuse,
        "refuse",
        "rows of unequal height are refused",
    ),
    (
        UnequalChoice::OwnCase,
        "own case",
        "each row takes E, T or S by its own w/h",
    ),
    (
        UnequalChoice::CommonFlap,
        "common flap",
        "all rows have one flap width, a = lambda min(h, w) / 2",
    ),
];

const FOLDINGS: [Way<FoldingChoice>; 2] = [
    (
        FoldingChoice::Waterbomb,
        "waterbomb",
        "every unit folds: the paper's compact state",
    ),
    (
        FoldingChoice::Map,
        "map",
        "the lines between units fold, columns first, then rows",
    ),
];

const DIVISIONS: [Way<DivisionChoice>; 3] = [
    (
        DivisionChoice::EqualLength,
        "equal length",
        "segments of equal length (equations 1 and 2)",
    ),
    (
        DivisionChoice::Parametric,
        "parametric",
        "even in the parameter of the curve",
    ),
    (
        DivisionChoice::DouglasPeucker,
        "Douglas-Peucker",
        "split where the curve is farthest from its segment",
    ),
];

/// What the section remembers.
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
        form.part(ui, "sheet.case", |form, ui| {
            ui.horizontal_wrapped(|ui| {
                ui.spacing_mut().item_spacing.x = 3.0;
                ui.label("case")
                    .on_hover_text("how the units are creased; w/h says which can be");
                ui.add_space(4.0);
                for (case, name, tip) in CASES {
                    let why_not = own_case(case)
                        .and_then(|own| UnitSize::of(form, Some(case))?.contradiction(own))
                        .filter(|_| case != given);
                    let option = ui.add_enabled_ui(why_not.is_none(), |ui| {
                        ui.selectable_label(case == given, name)
                    });
                    let option = option.inner.accessible_name(format!("case {name}"));
                    let option = option
                        .on_hover_text(tip)
                        .on_disabled_hover_text(why_not.unwrap_or_default());
                    if option.clicked() && case != given {
                        chosen = Some((case, option.id));
                    }
                }
            });
        });
        if let Some((case, id)) = chosen {
            self.choose(form, case);
            form.record("change the case", id, false);
        }
        form.errors_of(ui, "sheet.case");
    }

    /// Takes a case, with λ and d only where they belong to it.
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
    let field = Field::new(
        "sheet.width",
        "width W",
        "change the width",
        "W = Nc w, the width of the sheet; without it W = Nc h of case E (section 4.1), or that of the built-in profile",
    );
    let number = Number::within(1e-6..=1e6).default(default).hint("needed");
    form.number(ui, &field, &number, |scene| &mut scene.sheet.width);
    let built_in = model(&form.scene);
    let rows = size.map(|size| size.rows as f64);
    let field = Field::new(
        "sheet.rows",
        "rows Nr",
        "change the rows",
        "Nr, the segments the curve is divided into",
    );
    let number = Number::within(1.0..=1000.0).default(rows).hint("needed");
    form.whole(ui, &field, number, |scene| &mut scene.sheet.rows);
    let case = columns_case(form.scene.sheet.case);
    let columns = built_in.map(|model| model.columns.of(case) as f64);
    let field = Field::new(
        "sheet.columns",
        "columns Nc",
        "change the columns",
        "Nc, the units across the width",
    );
    let number = Number::within(1.0..=1000.0).default(columns).hint("needed");
    form.whole(ui, &field, number, |scene| &mut scene.sheet.columns);
    let text = match size {
        Some(UnitSize {
            width: Some(w),
            height: h,
            ..
        }) => {
            format!("w = {}, h = {}, w/h = {}", short(w), short(h), short(w / h))
        }
        Some(UnitSize { height: h, .. }) => format!("h = {}; w needs a width", short(h)),
        None => "w and h are not known yet".to_owned(),
    };
    ui.label(note(ui, text))
        .on_hover_text("the unit: w = W/Nc, h the mean length of a segment");
}

/// λ and d, where they mean something or stand in the scene.
fn show_widths(form: &mut Form<'_>, ui: &mut Ui) {
    let sheet = &form.scene.sheet;
    let size = UnitSize::of(form, sheet.case).and_then(|size| Some((size.width?, size.height)));
    let is_common_flap = sheet.unequal == Some(UnequalChoice::CommonFlap);
    let is_sii = sheet.case == Some(CaseChoice::SII);
    let may_be_sii = matches!(sheet.case, None | Some(CaseChoice::Auto))
        && size.is_some_and(|(w, h)| w > h * (1.0 + foldmotion_pattern::EQUAL_WIDTH_TOLERANCE));
    let means_something = is_sii || may_be_sii || is_common_flap;
    if means_something || sheet.lambda.is_some() {
        let field = Field::new(
            "sheet.lambda",
            "λ",
            "change lambda",
            "0 < λ < 1 scales the flaps of case SII, a = λh/2 (section 3), or a common flap, a = λ min(h, w)/2, λ ≤ 1",
        );
        let hint = if is_sii { "needed" } else { "none" };
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
        let field = Field::new(
            "sheet.offset",
            "offset d",
            "change the offset",
            "0 ≤ d < w1' = w/2 − λh/2: half the centre pad (figure 5); w1'/2 where left out",
        );
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
    let field = Field::new(
        "sheet.facing",
        "flaps stand",
        "change the facing",
        "the side of the curve, seen along it, on which the flaps stand",
    );
    form.menu(ui, &field, &FACINGS, |scene| &mut scene.sheet.facing);
    let field = Field::new(
        "sheet.unequal",
        "unequal rows",
        "change what becomes of unequal rows",
        "what becomes of rows of unequal height, which a division other than into equal lengths gives (figure 10)",
    );
    form.menu(ui, &field, &UNEQUAL, |scene| &mut scene.sheet.unequal);
    let field = Field::new(
        "sheet.folding",
        "folds as",
        "change the folding",
        "how the flat sheet folds",
    );
    form.menu(ui, &field, &FOLDINGS, |scene| &mut scene.sheet.folding);
}

fn show_division(form: &mut Form<'_>, ui: &mut Ui) {
    let field = Field::new(
        "division.method",
        "division",
        "change the division",
        "how the curve is divided into segments (section 2 of the paper)",
    );
    form.menu(ui, &field, &DIVISIONS, |scene| &mut scene.division.method);
    let is_split = form.scene.division.method == Some(DivisionChoice::DouglasPeucker);
    let field = Field::new(
        "division.tolerance",
        "tolerance",
        "change the tolerance",
        "equal length: the iteration ends once |R_max| is at most this; Douglas-Peucker: the largest distance from the curve, \
         over its length, from which the rows follow",
    );
    let number = if is_split {
        Number::within(1e-6..=0.5).hint("by rows").speed(1e-4)
    } else {
        Number::within(0.0..=0.1).default(1e-14)
    };
    form.number(ui, &field, &number, |scene| &mut scene.division.tolerance);
    let field = Field::new(
        "division.max_iterations",
        "iterations",
        "change the iterations",
        "iterations of the division at most",
    );
    let number = Number::within(1.0..=10_000.0).default(200.0);
    form.whole(ui, &field, number, |scene| {
        &mut scene.division.max_iterations
    });
}
