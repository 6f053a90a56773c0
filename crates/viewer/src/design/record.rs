//! The section of what is recorded.

use eframe::egui::Ui;
use foldmotion_study::scene::{ColourChoice, HoldScene, LoopChoice, OutputChoice, ThickenedScene};

use super::choice::Way;
use super::form::{Field, Form};
use super::number::{AccessibleName, Number, control_width, short};

const DEFAULT_OUTPUTS: [OutputChoice; 3] =
    [OutputChoice::Fold, OutputChoice::Gif, OutputChoice::Csv];
const DEFAULT_SECONDS: [f64; 2] = [3.0, 5.0];
const DEFAULT_HOLD: f64 = 0.5;

const COLOURS: [Way<ColourChoice>; 4] = [
    (ColourChoice::Paper, "paper", "the two sides of the paper"),
    (ColourChoice::Grey, "grey", "the same in greys"),
    (
        ColourChoice::Strain,
        "strain",
        "the largest strain of a triangle's edges",
    ),
    (
        ColourChoice::Bending,
        "bending",
        "the largest bend of a facet",
    ),
];

const LOOPS: [Way<LoopChoice>; 2] = [
    (
        LoopChoice::Forward,
        "forward",
        "from the first state to the last",
    ),
    (
        LoopChoice::BackAndForth,
        "back and forth",
        "to the last and back, without a jump",
    ),
];

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
    form.part(ui, "record.outputs", |form, ui| {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 6.0;
            for output in OutputChoice::ALL {
                let given = form.scene.record.outputs.as_deref();
                let mut is_on = given.unwrap_or(&DEFAULT_OUTPUTS).contains(&output);
                let tip = tip_of(output);
                let response = ui.checkbox(&mut is_on, output.name()).on_hover_text(tip);
                if response.changed() {
                    let outputs = form
                        .scene
                        .record
                        .outputs
                        .get_or_insert(DEFAULT_OUTPUTS.to_vec());
                    outputs.retain(|&other| other != output);
                    if is_on {
                        outputs.push(output);
                    }
                    form.record("change the outputs", response.id, false);
                }
            }
        });
    });
    form.errors_of(ui, "record.outputs");
}

fn tip_of(output: OutputChoice) -> &'static str {
    match output {
        OutputChoice::Fold => "motion.fold and certificate.json",
        OutputChoice::Gif => "motion.gif",
        OutputChoice::Csv => "motion.csv and plots.svg",
        OutputChoice::Mp4 => "motion.mp4: H.264",
        OutputChoice::Png => "frames/0001.png on",
        OutputChoice::Svg => "figure.svg: states side by side",
        OutputChoice::Pdf => "figure.pdf: the same",
        OutputChoice::Glb => "motion.glb: glTF with the motion as morph targets",
        OutputChoice::Obj | OutputChoice::Stl => "a file for each of the states",
        OutputChoice::Html => "motion.html: the motion as one page for browsers",
    }
}

/// Two fields in a row; whether they have changed.
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
            if form.cell(
                ui,
                field.undo,
                AccessibleName::As(name),
                &number,
                width,
                &mut one,
            ) {
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
    let field = Field::new(
        "record.size",
        "pixels",
        "change the size",
        "pixels across and down",
    );
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
    let field = Field::new(
        "record.seconds",
        "seconds",
        "change the seconds",
        "seconds a stage: unfold, fold",
    );
    let number = Number::within(0.0..=60.0).speed(0.05);
    let mut value = form.scene.record.seconds;
    let names = ["seconds to unfold", "seconds to fold"];
    if pair(
        form,
        ui,
        &field,
        names,
        &number,
        DEFAULT_SECONDS,
        &mut value,
    ) {
        form.scene.record.seconds = value;
    }
    let field = Field::new(
        "record.fps",
        "frames a second",
        "change the frame rate",
        "film frames a second",
    );
    let (_, standard) = form.scene.record.standard_film();
    let number = Number::within(1.0..=60.0).default(standard).speed(0.2);
    form.number(ui, &field, &number, |scene| &mut scene.record.fps);
    show_hold(form, ui);
    let field = Field::new(
        "record.loop",
        "films run",
        "change how films run",
        "how films run",
    );
    form.menu(ui, &field, &LOOPS, |scene| &mut scene.record.playback);
}

fn show_hold(form: &mut Form<'_>, ui: &mut Ui) {
    let field = Field::new(
        "record.hold",
        "hold",
        "change the hold",
        "seconds the deployed, the flat and the compact state stand still; one number for all, or three",
    );
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
        _ => form
            .scene
            .record
            .hold
            .or(Some(HoldScene::Each(DEFAULT_HOLD))),
    };
    form.scene.record.hold = hold;
}

/// Numbers parted by commas or spaces; none where one cannot be read.
fn numbers(text: &str) -> Option<Vec<f64>> {
    let parts = text.split([',', ' ', ';']).filter(|part| !part.is_empty());
    let number = |part: &str| part.parse().ok().filter(|number: &f64| number.is_finite());
    parts.map(number).collect()
}

fn show_looks(form: &mut Form<'_>, ui: &mut Ui) {
    let field = Field::new(
        "record.colour",
        "colour",
        "change the colours",
        "what colours show",
    );
    form.menu(ui, &field, &COLOURS, |scene| &mut scene.record.colour);
    let field = Field::new(
        "record.caption",
        "caption in films",
        "switch the caption",
        "whether films tell stage and t",
    );
    form.switch(ui, &field, false, |scene| &mut scene.record.caption);
    let field = Field::new(
        "record.follow",
        "films follow",
        "switch the following camera",
        "whether films come nearer where the sheet is small in the picture",
    );
    form.switch(ui, &field, true, |scene| &mut scene.record.follow);
    let field = Field::new(
        "record.transparent",
        "no background",
        "switch the background",
        "png pictures and figures without a background",
    );
    form.switch(ui, &field, false, |scene| &mut scene.record.transparent);
    let field = Field::new(
        "record.profile",
        "profile in figures",
        "switch the profile",
        "figures show the profile over the deployed state",
    );
    form.switch(ui, &field, false, |scene| &mut scene.record.profile);
    let field = Field::new(
        "record.box",
        "box in figures",
        "switch the box",
        "figures show the box of the compact state, its sizes and its closed form",
    );
    form.switch(ui, &field, true, |scene| &mut scene.record.bounds);
    let field = Field::new(
        "record.dimensions",
        "dimensions in figures",
        "switch the dimensions",
        "figures give h, w and the width at the planar state",
    );
    form.switch(ui, &field, true, |scene| &mut scene.record.dimensions);
    let field = Field::new(
        "record.letters",
        "letters in figures",
        "change the letters",
        "the size of letters in figures, millimetres",
    );
    let number = Number::within(0.5..=20.0).default(2.4).speed(0.02);
    form.number(ui, &field, &number, |scene| &mut scene.record.letters);
}

fn show_states(form: &mut Form<'_>, ui: &mut Ui) {
    let field = Field::new(
        "record.at",
        "states at",
        "change the states",
        "the motion times of the states in figures, OBJ and STL, rising: 0 deployed, 1 flat, 2 compact",
    );
    let given = form.scene.record.at.clone().unwrap_or_default();
    let text = given
        .iter()
        .map(|t| format!("{t}"))
        .collect::<Vec<_>>()
        .join(", ");
    if let Some(entered) = form.text(ui, &field, "0, 0.5, 1, 1.5, 2", &text)
        && let Some(times) = numbers(&entered)
    {
        form.scene.record.at = (!times.is_empty()).then_some(times);
    }
}

fn show_thickened(form: &mut Form<'_>, ui: &mut Ui) {
    let given = form.scene.record.thickened;
    let field = Field::new(
        "record.thickened",
        "solids",
        "change the solids",
        "OBJ and STL as solids: as thick as the material, or as given here",
    );
    form.row(ui, &field, |form, ui, _| {
        let kind = match given {
            None | Some(ThickenedScene::ByMaterial(false)) => 0,
            Some(ThickenedScene::ByMaterial(true)) => 1,
            Some(ThickenedScene::By(_)) => 2,
        };
        let ways = [
            ("no", None),
            ("by material", Some(ThickenedScene::ByMaterial(true))),
            ("own", Some(ThickenedScene::By(0.01))),
        ];
        for (index, (name, way)) in ways.into_iter().enumerate() {
            let option = ui.selectable_label(index == kind, name);
            let option = option.accessible_name(format!("solids {name}"));
            if option.clicked() && index != kind {
                form.scene.record.thickened = way;
                form.record(field.undo, option.id, false);
            }
        }
    });
    if let Some(ThickenedScene::By(thickness)) = given {
        form.part(ui, "own thickness", |form, ui| {
            ui.horizontal(|ui| {
                super::form::name(ui, "thick", "thickness of solids, in the unit of length");
                let width = control_width(ui);
                let number = Number::within(0.0..=1e3).speed(1e-4);
                let cell = form.required_cell(
                    ui,
                    field.undo,
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
