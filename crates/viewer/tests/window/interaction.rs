//! Moving the sheet by hand.

use eframe::egui::Key;

use crate::driver::{SMALL, Window};

#[test]
fn a_sheet_moved_by_hand_follows_the_timeline_until_that_ends() {
    let mut window = Window::over(SMALL);
    window.until_preview();
    window.enter("t", "1.2");
    window.click("by hand");
    assert!(window.is_on("by hand") && window.says("moved by hand: drag the timeline"));
    window.until("its first state", |w| w.text_over_view().starts_with("t = 1.2"));
    window.enter("t", "1.6");
    window
        .until("it has followed", |w| w.text_over_view().starts_with("t = 1.6000, moved by hand"));
    window.press(Key::H);
    assert!(!window.is_on("by hand"));
    assert!(window.says("preview: without contact, not checked"));
    assert!(window.text_over_view().starts_with("t = 1.6000"));
}

#[test]
fn escape_ends_moving_the_sheet_by_hand() {
    let mut window = Window::over(SMALL);
    window.until_preview();
    window.press(Key::H);
    assert!(window.says("moved by hand"));
    window.press(Key::Escape);
    assert!(!window.says("moved by hand") && !window.is_on("by hand"));
}

#[test]
fn an_edit_shows_the_new_sheet_and_ends_moving_the_old_one() {
    let mut window = Window::over(SMALL);
    window.until_preview();
    window.press(Key::H);
    window.enter("columns Nc", "3");
    window.until_preview();
    assert!(!window.is_on("by hand"), "{}", window.text_over_view());
}
