//! Fields, menus, sections and error messages.

use egui_kittest::kittest::{NodeT as _, Queryable as _};
use foldmotion_study::scene::{CaseChoice, CreaseGroup, EngineChoice, OutputChoice, Stage};
use foldmotion_study::{Scene, SceneSource};

use super::super::SceneError;
use super::test_panel::{click, drag, enter, panel, panel_of, scenes};

const SHELTER: &str =
    "[profile]\nmodel = \"shelter\"\n[sheet]\nwidth = 5.0\ncolumns = 3\ncase = \"S\"\n";

#[test]
fn a_panel_that_nobody_touches_changes_nothing() {
    let harness = panel(SHELTER);
    assert!(harness.state().changes.is_empty());
}

#[test]
fn a_typed_width_becomes_the_width_and_an_empty_field_omits_it() {
    let mut harness = panel(SHELTER);
    enter(&mut harness, "width W", "6.25");
    assert_eq!(harness.state().scene.sheet.width, Some(6.25));
    assert_eq!(harness.state().labels(), [("width W", false)]);
    enter(&mut harness, "width W", "");
    assert_eq!(harness.state().scene.sheet.width, None);
}

#[test]
fn entering_a_field_and_leaving_it_writes_nothing() {
    let mut harness = panel(
        "[profile]\nmodel = \"shelter\"\n[sheet]\nwidth = 5.123456789012345\ncolumns = 3\ncase = \"S\"\n",
    );
    for field in ["width W", "rows Nr", "columns Nc", "length", "tolerance"] {
        harness.get_by_label(field).focus();
        harness.run();
        harness.key_press(eframe::egui::Key::Enter);
        harness.run();
    }
    assert!(harness.state().changes.is_empty(), "{:?}", harness.state().labels());
}

#[test]
fn text_that_is_not_a_number_is_refused() {
    let mut harness = panel(SHELTER);
    for text in ["five", "NaN", "1e999"] {
        enter(&mut harness, "width W", text);
        assert_eq!(harness.state().scene.sheet.width, Some(5.0), "{text}");
    }
}

#[test]
fn a_typed_value_may_lie_beyond_where_a_drag_ends() {
    let mut harness = panel(SHELTER);
    enter(&mut harness, "rows Nr", "4000");
    assert_eq!(harness.state().scene.sheet.rows, Some(4000));
}

#[test]
fn a_reset_button_omits_the_key() {
    let mut harness = panel(SHELTER);
    click(&mut harness, "default of width W");
    assert_eq!(harness.state().scene.sheet.width, None);
}

#[test]
fn a_chosen_case_sets_the_keys_it_needs() {
    let mut harness = panel(SHELTER);
    click(&mut harness, "case SII");
    let sheet = &harness.state().scene.sheet;
    assert_eq!((sheet.case, sheet.lambda), (Some(CaseChoice::SII), Some(0.7)));
    enter(&mut harness, "λ", "0.6");
    click(&mut harness, "case S");
    let sheet = &harness.state().scene.sheet;
    assert_eq!((sheet.case, sheet.lambda), (Some(CaseChoice::S), None));
    click(&mut harness, "case SII");
    assert_eq!(harness.state().scene.sheet.lambda, Some(0.6));
    click(&mut harness, "case auto");
    assert_eq!(harness.state().scene.sheet.case, None);
}

#[test]
fn cases_that_contradict_the_unit_cannot_be_chosen() {
    let harness = panel(SHELTER);
    let disabled = |case: &str| harness.get_by_label(case).accesskit_node().is_disabled();
    let cases = ["case E", "case T", "case S", "case SII", "case plain", "case auto"];
    let expected = [true, true, false, false, false, false];
    assert_eq!(cases.map(disabled), expected);
}

#[test]
fn the_current_case_stays_enabled_even_if_w_h_rules_it_out() {
    let harness =
        panel("[profile]\nmodel = \"shelter\"\n[sheet]\nwidth = 5.0\ncolumns = 3\ncase = \"T\"\n");
    assert!(harness.state().draft.is_none());
    assert!(!harness.get_by_label("case T").accesskit_node().is_disabled());
    assert!(harness.get_by_label("case E").accesskit_node().is_disabled());
}

#[test]
fn an_error_is_shown_once_at_its_control_or_else_in_its_section_or_at_the_top() {
    let mut harness = panel(SHELTER);
    let error = |key: Option<&str>, message: &str| SceneError::new(key, &message);
    harness.state_mut().errors = vec![
        error(Some("sheet.width"), "too wide"),
        error(Some("division"), "not divided"),
        error(None, "no such file"),
        error(Some("record.fps"), "too fast"),
    ];
    harness.run();
    let y = |label: &str| harness.get_by_label(label).rect().center().y;
    assert!(y("no such file") < y("Profile"));
    assert!(y("width W") < y("too wide") && y("too wide") < y("rows Nr"));
    assert!(y("Sheet") < y("not divided") && y("not divided") < y("width W"));
    assert!(y("Record") < y("too fast"), "below the header of a closed section");
}

#[test]
fn an_error_that_appears_does_not_take_the_focus() {
    let mut harness = panel(SHELTER);
    harness.get_by_label("rows Nr").focus();
    harness.run();
    harness.state_mut().errors = vec![SceneError::new(Some("sheet.width"), &"too wide")];
    harness.run();
    assert!(harness.get_by_label("rows Nr").is_focused());
}

#[test]
fn steps_are_added_filled_moved_and_removed() {
    let mut harness = panel(SHELTER);
    click(&mut harness, "Motion");
    click(&mut harness, "add step");
    click(&mut harness, "add step");
    let steps = |scene: &Scene| scene.motion.step.len();
    assert_eq!(steps(&harness.state().scene), 2);
    let first = harness.get_all_by_label("from").next().unwrap().rect().center();
    harness.hover_at(first);
    harness.run();
    harness.get_all_by_label("to").next().unwrap();
    harness.get_all_by_label("unfold").next().unwrap().click();
    harness.run();
    assert_eq!(harness.state().scene.motion.step[0].stage, Stage::Unfold);
    click(&mut harness, "down step 1");
    assert_eq!(harness.state().scene.motion.step[1].stage, Stage::Unfold);
    click(&mut harness, "remove step 1");
    assert_eq!(steps(&harness.state().scene), 1);
    enter(&mut harness, "from", "0.25");
    enter(&mut harness, "to", "0.5");
    let step = &harness.state().scene.motion.step[0];
    assert_eq!((step.from, step.to), (Some(0.25), Some(0.5)));
    let labels: Vec<&str> = harness.state().labels().into_iter().map(|(label, _)| label).collect();
    assert_eq!(labels[..2], ["add step", "add step"]);
    assert!(labels.contains(&"move step") && labels.contains(&"remove step"));
}

#[test]
fn a_menu_sets_a_key_and_its_default_omits_it() {
    let mut harness = panel(SHELTER);
    click(&mut harness, "Motion");
    click(&mut harness, "engine");
    click(&mut harness, "dynamic");
    assert_eq!(harness.state().scene.motion.engine, Some(EngineChoice::Dynamic));
    click(&mut harness, "engine");
    click(&mut harness, "quasi-static (default)");
    assert_eq!(harness.state().scene.motion.engine, None);
}

#[test]
fn outputs_start_from_the_defaults() {
    let mut harness = panel(SHELTER);
    click(&mut harness, "Record");
    click(&mut harness, "mp4");
    let outputs = harness.state().scene.record.outputs.clone().unwrap();
    let expected = [OutputChoice::Fold, OutputChoice::Gif, OutputChoice::Csv, OutputChoice::Mp4];
    assert_eq!(outputs, expected);
}

#[test]
fn a_switch_set_to_its_default_omits_the_key() {
    let mut harness = panel(SHELTER);
    click(&mut harness, "Motion");
    click(&mut harness, "layers keep apart");
    assert_eq!(harness.state().scene.motion.contact, Some(false));
    click(&mut harness, "layers keep apart");
    assert_eq!(harness.state().scene.motion.contact, None);
}

#[test]
fn a_scene_of_an_imported_pattern_shows_its_keys_in_place_of_the_sheet() {
    let path = scenes().join("imported/frame.toml");
    let text = std::fs::read_to_string(&path).unwrap();
    let mut harness = panel_of(&SceneSource::new(&path, text), eframe::egui::Theme::Dark, 2600.0);
    assert!(harness.query_by_label("Sheet").is_none());
    enter(&mut harness, "fold %", "-40");
    let pattern = harness.state().scene.pattern.clone().unwrap();
    assert_eq!(pattern.fold_percent, Some(-40.0));
    click(&mut harness, "Motion");
    assert!(harness.query_by_label("unfolds").is_none());
    assert_eq!(harness.state().scene.motion.step[0].creases, Some(CreaseGroup::Mountains));
}

#[test]
fn a_text_is_taken_when_it_is_complete() {
    let mut harness = panel(SHELTER);
    click(&mut harness, "Record");
    enter(&mut harness, "states at", "0, 1.25, 2");
    assert_eq!(harness.state().scene.record.at, Some(vec![0.0, 1.25, 2.0]));
    assert_eq!(harness.state().changes.len(), 1);
}

#[test]
fn a_field_under_a_drag_is_one_change_to_undo() {
    let mut harness = panel(SHELTER);
    let from = harness.get_by_label("width W").rect().center();
    drag(&mut harness, from, eframe::egui::vec2(40.0, 0.0), 5);
    assert!(harness.state().scene.sheet.width.unwrap() > 5.0);
    let continues: Vec<bool> = harness.state().labels().iter().map(|label| label.1).collect();
    assert!(continues.len() > 2 && !continues[0] && continues[1..].iter().all(|c| *c));
}

#[test]
fn a_text_that_cannot_be_read_changes_nothing() {
    let mut harness = panel(SHELTER);
    click(&mut harness, "Record");
    enter(&mut harness, "states at", "0, half, 2");
    assert!(harness.state().changes.is_empty());
}

#[test]
fn the_rows_of_a_step_are_one_or_a_range_or_all() {
    let mut harness = panel(SHELTER);
    click(&mut harness, "Motion");
    click(&mut harness, "add step");
    let mut rows = |label: &str, text: &str| {
        enter(&mut harness, label, text);
        harness.state().scene.motion.step[0].rows.clone()
    };
    assert_eq!(rows("first of rows", "2"), Some(vec![2]));
    assert_eq!(rows("last of rows", "4"), Some(vec![2, 4]));
    assert_eq!(rows("first of rows", ""), None);
    assert_eq!(rows("last of rows", "3"), Some(vec![0, 3]));
}

#[test]
fn the_closed_forms_of_every_allowed_case_are_in_the_table() {
    let harness = panel(SHELTER);
    // Nr = 7, Nc = 3, W = 5, h = 1: equation 6 gives V = Nc (Nr + 1) / 4 (w - h) h² = 4. The size is shown in the table
    // and as the compact box of the draft.
    assert_eq!(harness.query_all_by_label("4 × 2 × 0.5").count(), 2);
    assert!(harness.query_by_label("needs w = h").is_some());
    assert!(harness.query_by_label("needs w < h").is_some());
    // SII: a = 0.35, x = 7 - 6 a, y = W - 2 Nc a.
    assert!(harness.query_by_label("4.9 × 2.9 × 0.35").is_some());
}

#[test]
fn nothing_is_wider_than_a_narrow_panel() {
    for scene in ["omega-sii", "shelter-unequal", "spiral-s", "imported/frame", "imported/miura"] {
        let path = scenes().join(scene).with_extension("toml");
        let source = SceneSource::read(&path).unwrap();
        let mut harness = panel_of(&source, eframe::egui::Theme::Dark, 4000.0);
        harness.set_size(eframe::egui::vec2(320.0, 4000.0));
        harness.run();
        for section in ["Material", "Motion", "Record"] {
            click(&mut harness, section);
        }
        click(&mut harness, "camera own");
        click(&mut harness, "solids own");
        click(&mut harness, "add step");
        for node in harness.root().children_recursive() {
            let node = node.accesskit_node();
            let right = node.raw_bounds().map_or(0.0, |bounds| bounds.x1);
            assert!(right <= 320.0, "{scene}: {:?} ends at {right}", node.label());
        }
    }
}
