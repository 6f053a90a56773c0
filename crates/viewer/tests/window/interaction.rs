//! The sheet in the hand.

use eframe::egui::Key;

use crate::driver::{SMALL, Window};

#[test]
fn a_sheet_in_the_hand_follows_the_timeline_until_it_is_let_go() {
    let mut window = Window::over(SMALL);
    window.until_preview();
    window.enter("t", "1.2");
    window.click("hand");
    assert!(window.is_on("hand") && window.says("in the hand: drag the timeline"));
    window.until("its first state", |w| w.words_over().starts_with("t = 1.2"));
    window.enter("t", "1.6");
    window.until("it has followed", |w| {
        w.words_over().starts_with("t = 1.6000, in the hand")
    });
    window.press(Key::H);
    assert!(!window.is_on("hand"));
    assert!(window.says("preview: without contact, not checked"));
    assert!(window.words_over().starts_with("t = 1.6000"));
}

#[test]
fn escape_lets_the_sheet_go() {
    let mut window = Window::over(SMALL);
    window.until_preview();
    window.press(Key::H);
    assert!(window.says("in the hand"));
    window.press(Key::Escape);
    assert!(!window.says("in the hand") && !window.is_on("hand"));
}

#[test]
fn an_edit_takes_the_new_sheet_and_lets_the_old_one_go() {
    let mut window = Window::over(SMALL);
    window.until_preview();
    window.press(Key::H);
    window.enter("columns Nc", "3");
    window.until_preview();
    assert!(!window.is_on("hand"), "{}", window.words_over());
}
