//! The appearance of the window, and its use without a mouse.

use std::collections::BTreeSet;

use eframe::App as _;
use eframe::egui::{Key, Theme, vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use crate::driver::{SMALL, Window};
use crate::storage::Storage;

#[test]
fn dark_and_light_and_sizes_change_at_once_and_are_remembered() {
    let mut storage = Storage::default();
    let mut window = Window::over(SMALL);
    assert_eq!(window.harness.ctx.theme(), Theme::Dark);
    let dark = window.harness.ctx.global_style().visuals.panel_fill;
    window.press(Key::F10);
    assert_eq!(window.harness.ctx.theme(), Theme::Light);
    assert_ne!(window.harness.ctx.global_style().visuals.panel_fill, dark);
    window.press(Key::F9);
    assert_eq!(window.harness.ctx.zoom_factor(), 1.25);
    window.harness.state_mut().save(&mut storage);
    let Window { folder, .. } = window;
    let next = Window::start(folder, None, Some(&storage));
    assert_eq!(next.harness.ctx.zoom_factor(), 1.25);
}

#[test]
fn every_size_for_presentation_keeps_the_controls_within_the_window() {
    let mut window = Window::over(SMALL);
    window.until_preview();
    for factor in [1.25, 1.5, 2.0, 1.0] {
        window.press(Key::F9);
        window.settle();
        assert_eq!(window.harness.ctx.zoom_factor(), factor);
        let room = window.harness.ctx.content_rect();
        for label in ["Run", "Motion time", "Play", "3D view", "colour"] {
            let rect = window.node(label).rect();
            assert!(room.contains_rect(rect), "{label} at {rect:?} in {room:?} at {factor}");
        }
    }
}

#[test]
fn tab_reaches_the_controls() {
    let mut window = Window::over(SMALL);
    window.until_preview();
    let mut reached = BTreeSet::new();
    for _ in 0..300 {
        window.harness.key_press(Key::Tab);
        window.harness.run_steps(1);
        let focused = window.harness.root().children_recursive();
        let focused = focused.filter(|node| node.accesskit_node().is_focused());
        let names = focused.filter_map(|node| {
            let node = node.accesskit_node();
            let by = node.labelled_by().find_map(|label| label.value());
            node.label().or(by)
        });
        reached.extend(names);
    }
    for label in [
        "File",
        "Run",
        "front",
        "colour",
        "by hand",
        "3D view",
        "profile canvas",
        "width W",
        "case SII",
        "Play",
        "t",
        "speed",
        "Motion time",
        "Run, check and report",
    ] {
        assert!(reached.contains(label), "{label} not among {reached:?}");
    }
}

#[test]
fn help_opens_over_everything_and_closes() {
    let mut window = Window::over(SMALL);
    window.until_preview();
    window.press(Key::F1);
    assert!(window.has("Help") && window.has("Mouse in the 3D view"));
    assert!(window.harness.query_by_label("Move the sheet by hand").is_some());
    window.press(Key::Escape);
    assert!(!window.has("Mouse in the 3D view"));
}

#[test]
fn the_smallest_window_has_room_for_the_record_dialog() {
    let mut window = Window::over(SMALL);
    window.run_scene();
    // The smallest size that the system allows.
    window.harness.set_size(vec2(640.0, 420.0));
    window.press(Key::F6);
    window.settle();
    let room = window.harness.ctx.content_rect();
    for label in ["Record now", "film, GIF", "folder"] {
        let rect = window.node(label).rect();
        assert!(room.contains_rect(rect), "{label} at {rect:?} in {room:?}");
    }
}
