//! No edit is lost when the window is closed or crashes.

use std::fs;

use eframe::App as _;
use eframe::egui::{ViewportCommand, ViewportEvent, ViewportId};

use crate::driver::{SMALL, Window};
use crate::files::edited;
use crate::storage::Storage;

fn ask_to_close(window: &mut Window) {
    let viewport = window.harness.input_mut().viewports.get_mut(&ViewportId::ROOT);
    viewport.unwrap().events.push(ViewportEvent::Close);
    window.harness.step();
}

/// A window that follows one that crashed with an edit, and the text with that edit.
fn after_a_crash() -> (Window, String) {
    let (mut window, text) = edited();
    window.harness.state_mut().save(&mut Storage::default());
    (window.killed(None), text)
}

#[test]
fn closing_without_edits_just_closes() {
    let mut window = Window::over(SMALL);
    window.until_preview();
    ask_to_close(&mut window);
    assert!(!window.asked_for(&ViewportCommand::CancelClose));
    assert!(!window.says("unsaved edits"));
}

#[test]
fn closing_with_edits_asks_and_does_what_is_answered() {
    for answer in ["Cancel", "Discard edits", "Keep for the next start", "Save"] {
        let (mut window, text) = edited();
        ask_to_close(&mut window);
        assert!(window.asked_for(&ViewportCommand::CancelClose));
        window.settle();
        window.node(answer).click();
        window.settle();
        let closes = window.asked_for(&ViewportCommand::Close);
        assert_eq!(closes, answer != "Cancel", "{answer}");
        if closes {
            ask_to_close(&mut window);
            assert!(!window.asked_for(&ViewportCommand::CancelClose), "it asks once");
            window.harness.state_mut().save(&mut Storage::default());
        }
        let on_disk = fs::read_to_string(window.path()).unwrap();
        assert_eq!(on_disk == text, answer == "Save", "{answer}");
        let next = window.killed(None);
        assert_eq!(next.has("Unsaved edits"), answer == "Keep for the next start", "{answer}");
    }
}

#[test]
fn the_edits_of_a_crashed_window_are_offered_to_the_next() {
    let (mut window, text) = after_a_crash();
    assert!(
        window.has("Unsaved edits") && window.says("unsaved changes to scene.toml, a moment ago")
    );
    window.click("Restore");
    assert_eq!(window.title(), "• scene.toml — foldmotion");
    assert_eq!(window.text(), text);
    // A restored scene is kept immediately.
    let mut window = window.killed(None);
    assert!(window.has("Unsaved edits"));
    window.click("Restore");
    window.undo();
    assert_eq!(window.text(), SMALL);
    window.harness.state_mut().save(&mut Storage::default());
    assert!(!window.killed(None).has("Unsaved edits"));
}

#[test]
fn offered_edits_can_be_kept_or_discarded() {
    let (mut window, _) = after_a_crash();
    window.click("Later");
    assert!(!window.has("Unsaved edits"));
    let mut window = window.killed(None);
    window.click("Discard");
    assert!(!window.has("Unsaved edits"));
    assert!(!window.killed(None).has("Unsaved edits"));
}
