//! The scene is edited in the design panel, and every edit can be undone.

use eframe::egui::{Key, Modifiers, vec2};

use crate::driver::{ARCH, SMALL, Window};

/// The lines of closed forms that are shown.
fn closed_forms(window: &Window) -> Vec<String> {
    let words = window.all_words();
    let lines = words.lines().filter(|line| line.contains(" × "));
    lines.map(str::to_owned).collect()
}

#[test]
fn a_dragged_control_point_changes_the_text_and_the_closed_forms_and_can_be_undone() {
    let mut window = Window::over(ARCH);
    window.until_preview();
    let before = closed_forms(&window);
    assert!(!before.is_empty(), "{}", window.all_words());
    let from = window.node("control point 4").rect().center();
    window.drag(from, vec2(18.0, -12.0));
    let moved = window.text();
    assert_ne!(moved, ARCH);
    assert!(!moved.contains("[0.0, 3.5]") && moved.contains("[2.0, 2.5]"), "{moved}");
    assert_eq!(window.title(), "• scene.toml — foldmotion");
    window.until_preview();
    assert_ne!(closed_forms(&window), before);
    window.undo();
    assert_eq!(window.text(), ARCH, "a drag is one change");
    assert!(window.says("Undone: move point"));
    assert_eq!(window.title(), "scene.toml — foldmotion");
    window.until_preview();
    assert_eq!(closed_forms(&window), before);
    window.press_with(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    assert_eq!(window.text(), moved);
}

#[test]
fn a_case_that_the_unit_allows_is_chosen_and_others_cannot_be() {
    let mut window = Window::over(SMALL);
    window.until_preview();
    for (case, is_enabled) in [
        ("case E", false),
        ("case T", false),
        ("case S", true),
        ("case SII", true),
        ("case plain", true),
    ] {
        assert_eq!(window.is_enabled(case), is_enabled, "{case}");
    }
    window.click("case SII");
    assert!(window.text().contains("case = \"SII\""));
    window.until_preview();
    assert!(window.says("SII: a = "), "{}", window.all_words());
    window.undo();
    assert_eq!(window.text(), SMALL);
}

#[test]
fn a_typed_width_is_written_beside_the_comments() {
    let mut window = Window::over(SMALL);
    window.until_preview();
    window.enter("width W", "6.5");
    let text = window.text();
    assert_eq!(text, SMALL.replace("width = 4.0", "width = 6.5"));
    window.until_preview();
    assert!(window.says("w/h = 3.25"), "{}", window.all_words());
}

#[test]
fn a_bad_value_says_so_under_its_control_and_the_sheet_stays() {
    let mut window = Window::over(SMALL);
    window.until_preview();
    window.enter("width W", "-1");
    window.until("the error of the width is shown", |window| {
        window.rects_saying("sheet.width").next().is_some()
    });
    window.until_said("Out of date: the scene has changed");
    assert!(window.says("preview: without contact, not checked"));
    let below = window.node("width W").rect();
    let next = window.node("rows Nr").rect();
    let errors: Vec<_> = window.rects_saying("sheet.width").collect();
    assert!(
        errors
            .iter()
            .any(|rect| rect.top() >= below.bottom() - 1.0 && rect.bottom() <= next.top() + 1.0),
        "{errors:?} not between {below:?} and {next:?}"
    );
    assert!(!window.is_enabled("Run"));
    window.undo();
    window.until("the error is gone", |window| window.rects_saying("sheet.width").next().is_none());
    window.until_preview();
}

#[test]
fn an_edit_in_the_panel_waits_for_a_text_without_errors() {
    let mut window = Window::over(SMALL);
    window.until_preview();
    let broken = SMALL.replace("[motion]", "[motion");
    window.set_text(&broken);
    window.enter("width W", "6.5");
    assert!(window.says("Correct it there first"), "{}", window.all_words());
    assert_eq!(window.text(), broken);
}

#[test]
fn typing_in_the_text_is_undone_in_one_step() {
    let mut window = Window::over(SMALL);
    window.press(Key::F7);
    window.set_text(ARCH);
    assert_eq!(window.text(), ARCH);
    window.press(Key::F7);
    window.undo();
    window.undo();
    assert_eq!(window.text(), SMALL);
}
