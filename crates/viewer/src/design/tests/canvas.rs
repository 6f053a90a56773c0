//! Editing on the profile canvas.

use eframe::egui::{Key, Modifiers, PointerButton, Pos2, vec2};
use egui_kittest::kittest::Queryable as _;
use foldmotion_study::models;

use super::super::curve::own_profile;
use super::test_panel::{TestPanel, click, drag, enter, panel};

const ARCH: &str = "[profile]\ncontrol_points = [[3.0, 0.0], [2.0, 0.0], [2.0, 2.5], [0.0, 3.5], [-2.0, 2.5], [-3.0, 0.0]]\n\
                    [sheet]\nrows = 6\ncolumns = 2\n";

fn points(state: &TestPanel) -> Vec<[f64; 2]> {
    state.scene.profile.control_points.clone().unwrap()
}

/// Points on the screen per unit of length.
fn scale(harness: &egui_kittest::Harness<'static, TestPanel>) -> f64 {
    let at = |name: &str| harness.get_by_label(name).rect().center();
    let way = at("control point 1") - at("control point 6");
    f64::from(way.x) / 6.0
}

#[test]
fn a_dragged_control_point_moves_by_the_drag_over_the_scale() {
    let mut harness = panel(ARCH);
    let scale = scale(&harness);
    let from = harness.get_by_label("control point 4").rect().center();
    drag(&mut harness, from, vec2(24.0, -15.0), 4);
    let [x, z] = points(harness.state())[3];
    let error = (x - 24.0 / scale).abs().max((z - 3.5 - 15.0 / scale).abs());
    assert!(error < 0.6 / scale, "{x} {z} at {scale} points a unit");
    let labels = harness.state().labels();
    assert!(labels.len() >= 2, "{labels:?}");
    assert!(labels.iter().all(|(label, _)| *label == "move point"));
    let continues: Vec<bool> = labels.iter().map(|(_, continues)| *continues).collect();
    assert!(!continues[0] && continues[1..].iter().all(|c| *c), "{continues:?}");
}

#[test]
fn two_drags_are_two_changes_to_undo() {
    let mut harness = panel(ARCH);
    for _ in 0..2 {
        let from = harness.get_by_label("control point 3").rect().center();
        drag(&mut harness, from, vec2(12.0, 6.0), 3);
    }
    let starts = harness.state().labels().iter().filter(|(_, continues)| !continues).count();
    assert_eq!(starts, 2);
}

#[test]
fn a_double_click_on_the_polygon_adds_a_control_point_there() {
    let mut harness = panel(ARCH);
    let at = |name: &str| harness.get_by_label(name).rect().center();
    let middle = at("control point 4") + (at("control point 5") - at("control point 4")) * 0.5;
    double_click(&mut harness, middle);
    let points = points(harness.state());
    assert_eq!(points.len(), 7);
    let [x, z] = points[4];
    assert!((x + 1.0).abs() < 0.05 && (z - 3.0).abs() < 0.05, "{x} {z}");
    assert_eq!(harness.state().labels(), [("add point", false)]);
}

fn double_click(harness: &mut egui_kittest::Harness<'static, TestPanel>, at: Pos2) {
    harness.hover_at(at);
    harness.run();
    for _ in 0..2 {
        for pressed in [true, false] {
            harness.event(eframe::egui::Event::PointerButton {
                pos: at,
                button: PointerButton::Primary,
                pressed,
                modifiers: Modifiers::NONE,
            });
        }
        harness.step();
    }
    harness.run();
}

#[test]
fn points_are_removed_by_right_click_and_by_key_until_four_are_left() {
    let mut harness = panel(ARCH);
    harness.get_by_label("control point 2").click_secondary();
    harness.run();
    assert_eq!(points(harness.state()).len(), 5);
    for _ in 0..3 {
        click(&mut harness, "control point 3");
        harness.key_press(Key::Delete);
        harness.run();
    }
    assert_eq!(points(harness.state()).len(), 4);
}

#[test]
fn arrow_keys_move_the_selected_point_and_its_fields_set_it_exactly() {
    let mut harness = panel(ARCH);
    click(&mut harness, "control point 4");
    harness.run();
    harness.key_press(Key::ArrowRight);
    harness.run();
    let [x, z] = points(harness.state())[3];
    assert!(x > 0.0 && x < 0.2 && z == 3.5, "{x} {z}");
    enter(&mut harness, "point x", "0.125");
    enter(&mut harness, "point z", "3.75");
    assert_eq!(points(harness.state())[3], [0.125, 3.75]);
}

#[test]
fn a_model_is_converted_to_control_points_of_the_same_curve() {
    for model in models() {
        let mut harness = panel(&format!("[profile]\nmodel = \"{}\"\n", model.name));
        click(&mut harness, "edit as control points");
        let after = own_profile(&harness.state().scene.profile).unwrap();
        let before = model.profile().unwrap();
        for k in 0..=100 {
            let u = f64::from(k) / 100.0;
            let error = before.position(u).distance(after.position(u));
            assert!(error <= 1e-12 * before.magnitude(), "{} at {u}: {error}", model.name);
        }
        let heights = |state: &TestPanel| state.draft.as_ref().unwrap().units().unwrap().units.unit;
        let unit = heights(harness.state());
        harness.state_mut().redraft();
        assert_eq!(harness.state().errors, [], "{}", model.name);
        let again = heights(harness.state());
        assert!(
            (unit.height - again.height).abs() < 1e-9 && (unit.width - again.width).abs() < 1e-9
        );
    }
}

#[test]
fn the_canvas_stays_usable_without_a_draft_and_with_points_that_make_no_curve() {
    let mut harness = panel("[profile]\ncontrol_points = [[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]]\n");
    assert!(harness.state().draft.is_none());
    let from = harness.get_by_label("control point 2").rect().center();
    drag(&mut harness, from, vec2(0.0, 20.0), 2);
    assert!(points(harness.state())[1][1] < 1.0);
}

#[test]
fn the_wheel_zooms_and_the_right_button_moves_the_view_but_not_the_scene() {
    let mut harness = panel(ARCH);
    let before = scale(&harness);
    let centre = harness.get_by_label("profile canvas").rect().center();
    harness.hover_at(centre);
    harness.run();
    harness.event(eframe::egui::Event::MouseWheel {
        unit: eframe::egui::MouseWheelUnit::Point,
        delta: vec2(0.0, -40.0),
        phase: eframe::egui::TouchPhase::Move,
        source: eframe::egui::MouseWheelSource::Unknown,
        modifiers: Modifiers::NONE,
    });
    harness.run_steps(30);
    assert!(scale(&harness) < before * 0.95);
    click(&mut harness, "fit");
    assert!((scale(&harness) / before - 1.0).abs() < 1e-6);
    assert!(harness.state().changes.is_empty());
}

#[test]
fn a_curve_through_points_is_moved_by_its_points() {
    let mut harness = panel(
        "[profile]\npoints = [[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]]\n[sheet]\nrows = 4\ncolumns = 2\n",
    );
    let from = harness.get_by_label("point 2").rect().center();
    drag(&mut harness, from, vec2(0.0, 18.0), 3);
    let moved = harness.state().scene.profile.points.clone().unwrap();
    assert!(moved[1][1] < 1.0 && moved[1][0] == 1.0, "{moved:?}");
    click(&mut harness, "control points");
    assert!(harness.state().scene.profile.points.is_none());
    assert!(harness.state().scene.profile.control_points.is_some());
}
