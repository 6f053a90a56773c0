//! The section of the motion: engine, contact, schedule, check.

use eframe::egui::Ui;
use foldmotion_study::scene::{EngineChoice, Stage, StepScene};

use super::form::{Field, Form, note};
use super::number::Number;
use super::step::{StepAction, show_step};

pub(super) fn show(form: &mut Form<'_>, ui: &mut Ui) {
    form.section(ui, "Motion", false, &["motion", "check"], |form, ui| {
        show_engine(form, ui);
        show_contact(form, ui);
        if form.scene.pattern.is_none() || form.scene.motion.unfold.is_some() {
            let field = Field::new("motion.unfold", "unfolds");
            form.menu(ui, &field, "auto", |scene| &mut scene.motion.unfold);
        }
        let field = Field::new("check.touch_tolerance", "touch within");
        let number = Number::within(0.0..=0.1).default(1e-6);
        form.number(ui, &field, &number, |scene| &mut scene.check.touch_tolerance);
        show_steps(form, ui);
    });
}

fn show_engine(form: &mut Form<'_>, ui: &mut Ui) {
    let field = Field::new("motion.engine", "engine");
    form.menu(ui, &field, "quasi-static", |scene| &mut scene.motion.engine);
    let field = Field::new("motion.frames", "frames");
    let number = Number::within(2.0..=2000.0).default(240.0);
    form.whole(ui, &field, number, |scene| &mut scene.motion.frames);
}

fn show_contact(form: &mut Form<'_>, ui: &mut Ui) {
    let is_static = form.scene.motion.engine != Some(EngineChoice::Dynamic);
    let field = Field::new("motion.contact", "layers keep apart");
    form.switch(ui, &field, is_static, |scene| &mut scene.motion.contact);
    let field = Field::new("motion.gap", "gap");
    let number = Number::within(1e-6..=0.1).default(1e-3).speed(1e-5);
    form.number(ui, &field, &number, |scene| &mut scene.motion.gap);
    let field = Field::new("motion.final_gap", "gap in the end");
    let number = Number::within(1e-9..=0.1).default(1e-5).speed(1e-7);
    form.number(ui, &field, &number, |scene| &mut scene.motion.final_gap);
}

fn show_steps(form: &mut Form<'_>, ui: &mut Ui) {
    ui.add_space(2.0);
    let text = "Schedule: a crease without a step moves throughout its stage.";
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
    form.scope(ui, "add step", |form, ui| {
        let add = ui.button("add step").on_hover_text(
            "Adds a step: some creases, and the part of their stage in which they move.",
        );
        if add.clicked() {
            form.scene.motion.step.push(StepScene {
                stage: Stage::Fold,
                creases: None,
                ids: None,
                classes: None,
                edges: None,
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
