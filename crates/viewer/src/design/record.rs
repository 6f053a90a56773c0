//! The section of the files that a run writes.

use eframe::egui::Ui;
use foldmotion_study::scene::{HoldScene, OutputChoice, ThickenedScene};

use super::form::{Field, Form};
use super::number::{AccessibleName, Number, control_width, short};
use foldmotion_study::scene::fields::choices;

const DEFAULT_OUTPUTS: [OutputChoice; 3] =
    [OutputChoice::Fold, OutputChoice::Gif, OutputChoice::Csv];
const DEFAULT_SECONDS: [f64; 2] = [3.0, 5.0];
const DEFAULT_HOLD: f64 = 0.5;

pub(super) fn show(form: &mut Form<'_>, ui: &mut Ui) {
    form.section(ui, "Record", false, &["record"], |form, ui| {
        show_outputs(form, ui);
        show_size(form, ui);
        show_times(form, ui);
        super::camera::show(form, ui);
        show_looks(form, ui);
        show_states(form, ui);
        show_thickened(form, ui);
    });
}

fn show_outputs(form: &mut Form<'_>, ui: &mut Ui) {
    let tips = choices("record.outputs.0");
    form.scope(ui, "record.outputs", |form, ui| {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 6.0;
            for output in OutputChoice::ALL {
                let given = form.scene.record.outputs.as_deref();
                let mut is_on = given.unwrap_or(&DEFAULT_OUTPUTS).contains(&output);
                let tip = tips.iter().find(|(name, _)| *name == output.name());
                let tip = tip.map_or("", |(_, tip)| *tip);
                let response = ui.checkbox(&mut is_on, output.name()).on_hover_text(tip);
                if response.changed() {
                    let outputs = form.scene.record.outputs.get_or_insert(DEFAULT_OUTPUTS.to_vec());
                    outputs.retain(|&other| other != output);
                    if is_on {
                        outputs.push(output);
                    }
                    form.record("outputs", response.id, false);
                }
            }
        });
    });
    form.errors_of(ui, "record.outputs");
}

/// A row with two number fields; returns whether their values have changed.
fn pair(
    form: &mut Form<'_>,
    ui: &mut Ui,
    field: &Field,
    names: [&str; 2],
    number: &Number,
    default: [f64; 2],
    value: &mut Option<[f64; 2]>,
) -> bool {
    let before = *value;
    form.row(ui, field, |form, ui, _| {
        let width = (control_width(ui) - ui.spacing().item_spacing.x) / 2.0;
        for (index, name) in names.into_iter().enumerate() {
            let number = number.clone().default(default[index]);
            let mut one = value.map(|values| values[index]);
            if form.cell(ui, field.name, AccessibleName::As(name), &number, width, &mut one) {
                *value = one.map(|one| {
                    let mut values = before.unwrap_or(default);
                    values[index] = one;
                    values
                });
            }
        }
        if form.reset(ui, field, before.is_some()) {
            *value = None;
        }
    });
    *value != before
}

fn show_size(form: &mut Form<'_>, ui: &mut Ui) {
    let field = Field::new("record.size", "pixels");
    let given = form.scene.record.size;
    let mut value = given.map(|size| size.map(|pixels| pixels as f64));
    let number = Number::within(16.0..=4096.0).whole();
    let (standard, _) = form.scene.record.standard_film();
    let default = standard.map(f64::from);
    let names = ["pixels across", "pixels down"];
    if pair(form, ui, &field, names, &number, default, &mut value) {
        form.scene.record.size = value.map(|size| size.map(|pixels| pixels as i64));
    }
}

fn show_times(form: &mut Form<'_>, ui: &mut Ui) {
    let field = Field::new("record.seconds", "seconds");
    let number = Number::within(0.0..=60.0).speed(0.05);
    let mut value = form.scene.record.seconds;
    let names = ["seconds to unfold", "seconds to fold"];
    if pair(form, ui, &field, names, &number, DEFAULT_SECONDS, &mut value) {
        form.scene.record.seconds = value;
    }
    let field = Field::new("record.fps", "frames a second");
    let (_, standard) = form.scene.record.standard_film();
    let number = Number::within(1.0..=60.0).default(standard).speed(0.2);
    form.number(ui, &field, &number, |scene| &mut scene.record.fps);
    show_hold(form, ui);
    let field = Field::new("record.loop", "films run");
    form.menu(ui, &field, "forward", |scene| &mut scene.record.playback);
}

fn show_hold(form: &mut Form<'_>, ui: &mut Ui) {
    let field = Field::new("record.hold", "hold");
    let text = match form.scene.record.hold {
        None => String::new(),
        Some(HoldScene::Each(seconds)) => short(seconds),
        Some(HoldScene::States(states)) => states.map(short).join(", "),
    };
    let Some(entered) = form.text(ui, &field, "0.5", &text) else {
        return;
    };
    let hold = match numbers(&entered).as_deref() {
        Some([]) => None,
        Some(&[seconds]) => Some(HoldScene::Each(seconds)),
        Some(&[a, b, c]) => Some(HoldScene::States([a, b, c])),
        _ => form.scene.record.hold.or(Some(HoldScene::Each(DEFAULT_HOLD))),
    };
    form.scene.record.hold = hold;
}

/// The numbers in `text`, separated by commas, semicolons or spaces; `None` if one of them cannot be read.
fn numbers(text: &str) -> Option<Vec<f64>> {
    let parts = text.split([',', ' ', ';']).filter(|part| !part.is_empty());
    let number = |part: &str| part.parse().ok().filter(|number: &f64| number.is_finite());
    parts.map(number).collect()
}

fn show_looks(form: &mut Form<'_>, ui: &mut Ui) {
    let field = Field::new("record.colour", "colour");
    form.menu(ui, &field, "paper", |scene| &mut scene.record.colour);
    let field = Field::new("record.caption", "caption in films");
    form.switch(ui, &field, false, |scene| &mut scene.record.caption);
    let field = Field::new("record.follow", "films follow");
    form.switch(ui, &field, true, |scene| &mut scene.record.follow);
    let field = Field::new("record.transparent", "no background");
    form.switch(ui, &field, false, |scene| &mut scene.record.transparent);
    let field = Field::new("record.profile", "profile in figures");
    form.switch(ui, &field, false, |scene| &mut scene.record.profile);
    let field = Field::new("record.box", "box in figures");
    form.switch(ui, &field, true, |scene| &mut scene.record.bounds);
    let field = Field::new("record.dimensions", "dimensions in figures");
    form.switch(ui, &field, true, |scene| &mut scene.record.dimensions);
    let field = Field::new("record.letters", "letters in figures");
    let number = Number::within(0.5..=20.0).default(2.4).speed(0.02);
    form.number(ui, &field, &number, |scene| &mut scene.record.letters);
}

fn show_states(form: &mut Form<'_>, ui: &mut Ui) {
    let field = Field::new("record.at", "states at");
    let given = form.scene.record.at.clone().unwrap_or_default();
    let text = given.iter().map(|t| format!("{t}")).collect::<Vec<_>>().join(", ");
    if let Some(entered) = form.text(ui, &field, "0, 0.5, 1, 1.5, 2", &text)
        && let Some(times) = numbers(&entered)
    {
        form.scene.record.at = (!times.is_empty()).then_some(times);
    }
}

fn show_thickened(form: &mut Form<'_>, ui: &mut Ui) {
    let given = form.scene.record.thickened;
    let field = Field::new("record.thickened", "solids");
    form.row(ui, &field, |form, ui, _| {
        let kind = match given {
            None | Some(ThickenedScene::ByMaterial(false)) => 0,
            Some(ThickenedScene::ByMaterial(true)) => 1,
            Some(ThickenedScene::By(_)) => 2,
        };
        let options = [
            ("no", None),
            ("by material", Some(ThickenedScene::ByMaterial(true))),
            ("own", Some(ThickenedScene::By(0.01))),
        ];
        for (index, (name, value)) in options.into_iter().enumerate() {
            let option = ui.selectable_label(index == kind, name);
            let option = option.accessible_name(format!("solids {name}"));
            if option.clicked() && index != kind {
                form.scene.record.thickened = value;
                form.record(field.name, option.id, false);
            }
        }
    });
    if let Some(ThickenedScene::By(thickness)) = given {
        form.scope(ui, "own thickness", |form, ui| {
            ui.horizontal(|ui| {
                super::form::name(
                    ui,
                    "thick",
                    "The thickness of the solids, in the unit of length.",
                );
                let width = control_width(ui);
                let number = Number::within(0.0..=1e3).speed(1e-4);
                let cell = form.required_cell(
                    ui,
                    field.name,
                    "thickness of solids",
                    &number,
                    width,
                    thickness,
                );
                if let Some(new) = cell {
                    form.scene.record.thickened = Some(ThickenedScene::By(new));
                }
            });
        });
    }
}
