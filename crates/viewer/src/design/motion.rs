//! The section of the motion: engine, contact, schedule, check.

use eframe::egui::Ui;
use foldmotion_study::scene::{EngineChoice, StageChoice, StepScene, UnfoldChoice};

use super::choice::Way;
use super::form::{Field, Form, note};
use super::number::Number;
use super::step::{StepAction, show_step};

const ENGINES: [Way<EngineChoice>; 2] = [
    (
        EngineChoice::QuasiStatic,
        "quasi-static",
        "equilibrium along the schedule, layers kept apart",
    ),
    (
        EngineChoice::Dynamic,
        "dynamic",
        "mass, spring, damper in explicit steps, without contact",
    ),
];

const UNFOLDS: [Way<UnfoldChoice>; 3] = [
    (
        UnfoldChoice::Auto,
        "auto",
        "uniform where that is proved not to cross, else energy",
    ),
    (
        UnfoldChoice::Uniform,
        "uniform",
        "all fold angles scaled together",
    ),
    (
        UnfoldChoice::Energy,
        "energy",
        "a path on which the profile does not cross itself (Cantarella et al. 2004)",
    ),
];

pub(super) fn show(form: &mut Form<'_>, ui: &mut Ui) {
    form.section(ui, "Motion", false, &["motion", "check"], |form, ui| {
        show_engine(form, ui);
        show_contact(form, ui);
        if form.scene.pattern.is_none() || form.scene.motion.unfold.is_some() {
            let field = Field::new(
                "motion.unfold",
                "unfolds",
                "change how it unfolds",
                "how the row creases move from the deployed shape to the flat sheet",
            );
            form.menu(ui, &field, &UNFOLDS, |scene| &mut scene.motion.unfold);
        }
        let field = Field::new(
            "check.touch_tolerance",
            "touch within",
            "change the touch tolerance",
            "τ in units of h: facets that overlap by no more only touch",
        );
        let number = Number::within(0.0..=0.1).default(1e-6);
        form.number(ui, &field, &number, |scene| {
            &mut scene.check.touch_tolerance
        });
        show_steps(form, ui);
    });
}

fn show_engine(form: &mut Form<'_>, ui: &mut Ui) {
    let field = Field::new(
        "motion.engine",
        "engine",
        "change the engine",
        "what moves the sheet",
    );
    form.menu(ui, &field, &ENGINES, |scene| &mut scene.motion.engine);
    let field = Field::new(
        "motion.frames",
        "frames",
        "change the frames",
        "an even number: the states t = 2k/frames are recorded",
    );
    let number = Number::within(2.0..=2000.0).default(240.0);
    form.whole(ui, &field, number, |scene| &mut scene.motion.frames);
}

fn show_contact(form: &mut Form<'_>, ui: &mut Ui) {
    let is_static = form.scene.motion.engine != Some(EngineChoice::Dynamic);
    let field = Field::new(
        "motion.contact",
        "layers keep apart",
        "switch the contact",
        "whether layers keep apart by the gap; quasi-static engine only",
    );
    form.switch(ui, &field, is_static, |scene| &mut scene.motion.contact);
    let field = Field::new(
        "motion.gap",
        "gap",
        "change the gap",
        "closest approach of layers in units of h, or of a pattern's mean edge; less where facets are small",
    );
    let number = Number::within(1e-6..=0.1).default(1e-3).speed(1e-5);
    form.number(ui, &field, &number, |scene| &mut scene.motion.gap);
}

fn show_steps(form: &mut Form<'_>, ui: &mut Ui) {
    ui.add_space(2.0);
    let text = "Schedule: creases that no step names follow the ramp of their stage";
    ui.label(note(ui, text));
    form.errors_exactly_at(ui, "motion.step");
    let count = form.scene.motion.step.len();
    let mut order = None;
    for index in 0..count {
        if let Some(asked) = show_step(form, ui, index, count) {
            order = Some((index, asked));
        }
    }
    if let Some((index, (asked, id))) = order {
        let steps = &mut form.scene.motion.step;
        let label = match asked {
            StepAction::Remove => {
                steps.remove(index);
                "remove step"
            }
            StepAction::Up => {
                steps.swap(index - 1, index);
                "move step"
            }
            StepAction::Down => {
                steps.swap(index, index + 1);
                "move step"
            }
        };
        form.record(label, id, false);
    }
    form.part(ui, "add step", |form, ui| {
        let add = ui
            .button("add step")
            .on_hover_text("some creases, and when in their stage they move");
        if add.clicked() {
            form.scene.motion.step.push(StepScene {
                stage: StageChoice::Fold,
                creases: None,
                rows: None,
                columns: None,
                from: None,
                to: None,
                ease: None,
            });
            form.record("add step", add.id, false);
        }
    });
}
