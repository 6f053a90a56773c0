//! Every shortcut executes its command, and none does while the user types.

use eframe::egui::{Key, Modifiers, ViewportCommand};

use crate::driver::{SMALL, Window};

/// What is inspected to see whether a command was executed.
type Probe = fn(&mut Window) -> String;

const CTRL: Modifiers = Modifiers::COMMAND;
const SHIFT: Modifiers = Modifiers::SHIFT;
const NONE: Modifiers = Modifiers::NONE;

/// The commands that do not change the scene, by their names in the help.
const LOOKS: [(&str, Modifiers, Key, Probe); 32] = [
    ("Play or pause", NONE, Key::Space, |w| w.has("Pause").to_string()),
    ("Next frame", NONE, Key::Period, time),
    ("Previous frame", NONE, Key::Comma, time),
    ("Compact state", NONE, Key::End, time),
    ("Planar state", NONE, Key::P, time),
    ("Deployed state", NONE, Key::Home, time),
    ("Slower", NONE, Key::Minus, |w| w.value("speed")),
    ("Faster", NONE, Key::Plus, |w| w.value("speed")),
    ("Loop", NONE, Key::L, |w| w.value("At the end")),
    ("Front view", NONE, Key::Num1, camera),
    ("Side view", NONE, Key::Num2, camera),
    ("Top view", NONE, Key::Num3, camera),
    ("Isometric view", NONE, Key::Num4, camera),
    ("Perspective", NONE, Key::V, camera),
    ("Colour: strain", NONE, Key::Num6, colour),
    ("Colour: facet bending", NONE, Key::Num7, colour),
    ("Colour: unit", NONE, Key::Num8, colour),
    ("Colour: layer", NONE, Key::Num9, colour),
    ("Colour: plain", NONE, Key::Num5, colour),
    ("Creases", NONE, Key::C, |w| switch(w, "creases", "creases")),
    ("Profile curve", NONE, Key::G, |w| switch(w, "overlays", "profile curve")),
    ("Compact box", NONE, Key::B, |w| switch(w, "overlays", "compact box, measured")),
    ("Closed-form box", SHIFT, Key::B, |w| switch(w, "overlays", "compact box, closed form")),
    ("Design panel", NONE, Key::F2, |w| w.has("profile canvas").to_string()),
    ("Plots", NONE, Key::F3, |w| w.says("over motion time").to_string()),
    ("Verdict", NONE, Key::F4, |w| w.says("pairs tested").to_string()),
    ("Record dialog", NONE, Key::F6, |w| w.has("Record now").to_string()),
    ("Scene as text", NONE, Key::F7, |w| w.has("Scene as text").to_string()),
    ("Larger, for presentations", NONE, Key::F9, |w| w.harness.ctx.zoom_factor().to_string()),
    ("Dark or light", NONE, Key::F10, |w| format!("{:?}", w.harness.ctx.theme())),
    ("Move the sheet by hand", NONE, Key::H, |w| w.is_on("by hand").to_string()),
    ("Shortcuts and help", NONE, Key::F1, |w| w.has("Help").to_string()),
];

fn time(window: &mut Window) -> String {
    window.time().to_string()
}

fn camera(window: &mut Window) -> String {
    window.value("3D view")
}

fn colour(window: &mut Window) -> String {
    window.value("colour")
}

/// The check boxes of this name in a menu over the view.
fn switch(window: &mut Window, menu: &str, label: &str) -> String {
    window.click(menu);
    let boxes = window.switches(label);
    window.press(Key::Escape);
    format!("{boxes:?}")
}

#[test]
fn every_shortcut_changes_what_it_names() {
    let mut window = Window::over(SMALL);
    window.run_scene();
    window.press(Key::Home);
    for (name, modifiers, key, look) in LOOKS {
        let before = look(&mut window);
        window.press_with(modifiers, key);
        assert_ne!(before, look(&mut window), "{name}");
        if ["Play or pause", "Scene as text", "Record dialog"].contains(&name) {
            window.press_with(modifiers, key);
            assert_eq!(before, look(&mut window), "{name} again");
        }
    }
    for (name, ..) in LOOKS {
        assert!(window.has(name), "the help names {name}");
    }
}

#[test]
fn fitting_shows_the_sheet_as_large_as_it_can_be() {
    let mut window = Window::over(SMALL);
    window.until_preview();
    window.press(Key::F);
    let deployed = camera(&mut window);
    window.press(Key::End);
    assert_eq!(camera(&mut window), deployed);
    window.press(Key::F);
    assert_ne!(camera(&mut window), deployed);
}

#[test]
fn shortcuts_of_files_and_runs_do_what_they_name() {
    let mut window = Window::over(SMALL);
    window.until("the scene is resolved", |w| w.is_enabled("Run"));
    window.press_with(CTRL, Key::S);
    assert!(window.says("Saved "));
    window.press_with(CTRL | SHIFT, Key::S);
    assert!(window.has("Name"));
    window.press(Key::Escape);
    window.press_with(CTRL, Key::O);
    assert!(window.has("Name or path"));
    window.press(Key::Escape);
    window.enter("width W", "6.5");
    window.press_with(CTRL, Key::Z);
    assert!(window.says("Undone: width W"));
    window.press_with(CTRL, Key::Y);
    assert!(window.says("Redone: width W"));
    window.press_with(CTRL, Key::Z);
    window.press_with(CTRL, Key::E);
    assert!(window.says("A preview cannot be recorded") || window.has("Record now"));
    window.until("the scene is resolved", |w| w.is_enabled("Run"));
    window.strike(CTRL, Key::R);
    assert!(window.has("Cancel"));
    window.strike(CTRL, Key::Q);
    assert!(window.asked_for(&ViewportCommand::Close));
    window.press_with(CTRL, Key::N);
    assert_eq!(window.title(), "untitled.toml — foldmotion");
}

#[test]
fn no_plain_shortcut_fires_while_the_user_types() {
    let mut window = Window::over(SMALL);
    window.run_scene();
    window.press(Key::P);
    let typed = LOOKS.iter().filter(|row| row.2.name().len() < 2 || !row.2.name().starts_with('F'));
    for (name, modifiers, key, look) in typed {
        let before = look(&mut window);
        window.node("width W").focus();
        window.settle();
        window.press_with(*modifiers, *key);
        assert_eq!(before, look(&mut window), "{name}");
    }
    assert_eq!(window.title(), "scene.toml — foldmotion");
}

#[test]
fn every_entry_of_the_menus_is_there() {
    let mut window = Window::over(SMALL);
    window.until_preview();
    for (menu, entry, words) in [
        ("View", "Top view", "elevation 90°"),
        ("Motion", "Compact state", "t = 2.0000"),
        ("Window", "Shortcuts and help", "Mouse in the 3D view"),
    ] {
        window.choose(menu, entry);
        let is_said = window.says(words) || camera(&mut window).contains(words);
        assert!(is_said, "{menu}, {entry}: {}", camera(&mut window));
    }
}
