//! Opening scenes, crease patterns and motions.

use std::sync::Arc;

use foldmotion_study::{SceneSource, Study};

use crate::driver::{SMALL, Window, scenes};

#[test]
fn a_scene_shows_its_exact_states_and_then_a_preview() {
    let mut window = Window::of(&scenes().join("one-unit.toml"));
    window.until_said("exact states: deployed, planar, compact");
    assert!(window.says("t = 0.0000"));
    window.until_preview();
    assert_eq!(window.title(), "one-unit.toml — foldmotion");
    assert!(window.has("Not run yet") && window.says("121 frames"));
    assert_eq!(window.value("columns Nc"), "1");
}

#[test]
fn a_window_without_a_file_shows_a_scene_to_start_from() {
    let mut window = Window::empty();
    window.until_said("exact states");
    assert_eq!(window.title(), "untitled.toml — foldmotion");
}

#[test]
fn the_text_of_a_scene_with_errors_is_corrected_and_the_sheet_appears() {
    let mut window = Window::over(&SMALL.replace("rows = 4", "rows = four"));
    window.until_said("scene.toml:10");
    assert!(window.says("No sheet yet"));
    assert!(window.value("Scene as text").contains("rows = four"));
    window.set_text(SMALL);
    window.until_preview();
    assert!(!window.says("scene.toml:10") && !window.says("No sheet yet"));
    assert_eq!(window.title(), "• scene.toml — foldmotion");
}

#[test]
fn a_scene_with_an_unusable_value_says_so_at_its_control() {
    let mut window = Window::over(&SMALL.replace("columns = 2", "columns = -2"));
    window.until("the error", |w| w.says("sheet.columns"));
    window.enter("columns Nc", "2");
    window.until_preview();
    assert!(!window.says("sheet.columns"));
}

#[test]
fn crease_patterns_open_as_scenes_of_their_own() {
    for name in ["frame.svg", "miura.fold"] {
        let mut window = Window::of(&scenes().join("imported").join(name));
        window.until("the pattern", |w| w.has("fold %"));
        window.until("a sheet", |w| w.says("facets, "));
        assert!(window.title().starts_with(name), "{}", window.title());
        let file = format!("file = \"{name}\"");
        assert!(window.text().contains(&file), "{}", window.text());
    }
}

#[test]
fn a_motion_is_opened_and_checked() {
    let folder = tempfile::tempdir().unwrap();
    let text = SMALL.replace("frames = 8", "frames = 8\n[record]\noutputs = [\"fold\"]");
    let source = SceneSource::new(&folder.path().join("small.toml"), text);
    let study = Arc::new(Study::resolve(&source).unwrap());
    let out = folder.path().join("out");
    let report = study.run(&out, &|_, _| true).unwrap();
    let mut window = Window::of(&out.join("motion.fold"));
    let frames = report.path.frames;
    window.until_said(&format!("pairs tested between {frames} frames"));
    assert!(window.has(report.collision.verdict.name()), "{}", window.all_words());
    assert!(window.title().starts_with("Small shelter"), "{}", window.title());
    assert!(window.says("A motion file has no scene to edit"));
    assert!(!window.is_enabled("Run"));
}

#[test]
fn what_cannot_be_opened_is_named_and_the_scene_stays() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("nowhere.toml");
    let mut window = Window::start(folder, Some(path), None);
    window.until_said("nowhere.toml");
    assert_eq!(window.title(), "untitled.toml — foldmotion");
}
