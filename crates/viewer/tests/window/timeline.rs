//! Changing the motion time.

use eframe::egui::{Key, pos2, vec2};

use crate::driver::{SMALL, Window};

/// The position of motion time `t` (0 to 2) on the bar, which leaves 64 points on its left and 18 on its right.
fn place(window: &Window, t: f32) -> eframe::egui::Pos2 {
    let bar = window.node("Motion time").rect();
    let (first, last) = (bar.left() + 64.0, bar.right() - 18.0);
    pos2(first + (last - first) * t / 2.0, bar.top() + 10.0)
}

fn shown() -> Window {
    let mut window = Window::over(SMALL);
    window.until_preview();
    window
}

#[test]
fn the_bar_is_dragged_to_any_time() {
    let mut window = shown();
    let (from, to) = (place(&window, 0.0), place(&window, 1.5));
    window.drag(from, to - from);
    assert!((window.time() - 1.5).abs() < 0.01, "{}", window.time());
    assert!(window.says("folding, 50 %"));
    let said = format!("t = {:.4}", window.time());
    assert!(window.text_over_view().starts_with(&said), "{}", window.text_over_view());
    let (from, beyond) = (place(&window, 1.5), vec2(-3000.0, 0.0));
    window.drag(from, beyond);
    assert_eq!(window.time(), 0.0);
    assert!(window.has("deployed"));
}

#[test]
fn keys_step_frames_and_go_to_the_states() {
    let mut window = shown();
    for (key, t) in [
        (Key::ArrowRight, 1.0 / 60.0),
        (Key::Period, 2.0 / 60.0),
        (Key::ArrowLeft, 1.0 / 60.0),
        (Key::Comma, 0.0),
        (Key::Comma, 0.0),
        (Key::P, 1.0),
        (Key::End, 2.0),
        (Key::ArrowLeft, 2.0 - 1.0 / 60.0),
        (Key::Home, 0.0),
    ] {
        window.press(key);
        assert!((window.time() - t).abs() < 1e-12, "{key:?} {}", window.time());
    }
}

#[test]
fn the_bar_with_the_focus_takes_the_same_keys() {
    let mut window = shown();
    let middle = place(&window, 1.0);
    window.drag(middle, vec2(1.0, 0.0));
    assert!(window.node("Motion time").is_focused());
    for (key, t) in [
        (Key::Home, 0.0),
        (Key::ArrowRight, 1.0 / 60.0),
        (Key::End, 2.0),
        (Key::ArrowLeft, 2.0 - 1.0 / 60.0),
    ] {
        window.press(key);
        assert!((window.time() - t).abs() < 1e-12, "{key:?} {}", window.time());
    }
}

#[test]
fn a_time_is_typed_and_its_buttons_step() {
    let mut window = shown();
    window.enter("t", "1.25");
    assert_eq!(window.time(), 1.25);
    window.click("Next frame");
    assert!((window.time() - 76.0 / 60.0).abs() < 1e-12, "{}", window.time());
    window.click("Previous frame");
    assert!((window.time() - 1.25).abs() < 1e-12, "{}", window.time());
    window.enter("t", "7");
    assert_eq!(window.time(), 2.0);
}

#[test]
fn it_plays_at_its_speed_and_ends_as_was_chosen() {
    let mut window = shown();
    window.press(Key::L);
    assert_eq!(window.value("At the end"), "once");
    window.node("Play").click();
    window.harness.run_steps(3);
    let seconds = |window: &mut Window, steps: usize| {
        let before = window.time();
        window.harness.run_steps(steps);
        window.time() - before
    };
    // A step takes a twentieth of a second, a stage four seconds.
    assert!((seconds(&mut window, 8) - 0.1).abs() < 1e-6);
    window.harness.key_press(Key::Plus);
    window.harness.run_steps(2);
    assert_eq!(window.value("speed"), "2.00×");
    assert!((seconds(&mut window, 8) - 0.2).abs() < 1e-6);
    window.harness.run_steps(200);
    assert_eq!(window.time(), 2.0);
    assert!(window.has("Play"), "it has stopped");
    window.press(Key::L);
    assert_eq!(window.value("At the end"), "loop");
    window.node("Play").click();
    window.harness.run_steps(3);
    window.harness.run_steps(2);
    assert!(window.time() < 0.5 && window.has("Pause"), "it starts over");
    window.harness.run_steps(200);
    assert!(window.has("Pause"), "it goes on");
    window.press(Key::Space);
    assert!(window.has("Play"));
}

#[test]
fn curves_are_scrubbed_as_the_bar_is_and_say_their_values() {
    let mut window = shown();
    assert!(!window.says("separation, h over"), "a preview is not checked");
    window.run_scene();
    assert!(window.says("separation, h over"));
    let strip = window.rects_saying("bar strain, % over motion time").next().unwrap();
    let to = pos2(place(&window, 0.5).x, strip.center().y);
    window.drag(to - vec2(40.0, 0.0), vec2(40.0, 0.0));
    assert!((window.time() - 0.5).abs() < 0.01, "{}", window.time());
    window.press(Key::F3);
    assert!(!window.says("over motion time"));
    assert!(window.has("Motion time"));
}
