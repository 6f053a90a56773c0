//! Files are saved, opened, changed by other programs, dropped and remembered.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use eframe::App as _;
use eframe::egui::{DroppedFile, Key, Modifiers};
use egui_kittest::kittest::Queryable as _;

use crate::driver::{ARCH, SMALL, Window};
use crate::storage::Storage;

/// A window with [`SMALL`] and an edit that is not saved.
pub(crate) fn edited() -> (Window, String) {
    let mut window = Window::over(SMALL);
    window.until_preview();
    window.enter("width W", "6.5");
    assert_eq!(window.title(), "• scene.toml — foldmotion");
    (window, SMALL.replace("width = 4.0", "width = 6.5"))
}

#[test]
fn an_edit_is_saved_into_its_file() {
    let (mut window, text) = edited();
    window.press_with(Modifiers::COMMAND, Key::S);
    assert_eq!(fs::read_to_string(window.path()).unwrap(), text);
    assert!(window.says("Saved "));
    assert_eq!(window.title(), "scene.toml — foldmotion");
    window.undo();
    assert_eq!(window.title(), "• scene.toml — foldmotion");
}

#[test]
fn a_scene_is_saved_under_another_name_and_overwrites_only_when_told_to() {
    let (mut window, text) = edited();
    let other = window.folder.path().join("other.toml");
    window.press_with(Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    assert_eq!(window.value("Name"), "scene.toml");
    window.enter("Name", "other");
    assert_eq!(fs::read_to_string(&other).unwrap(), text);
    assert_eq!(fs::read_to_string(window.path()).unwrap(), SMALL);
    assert_eq!(window.title(), "other.toml — foldmotion");
    window.choose("File", "Save as");
    window.enter("Name", "scene.toml");
    assert!(window.says("scene.toml already exists"));
    window.click("Keep it");
    assert_eq!(fs::read_to_string(window.path()).unwrap(), SMALL);
    window.click("Save");
    window.click("Overwrite");
    assert_eq!(fs::read_to_string(window.path()).unwrap(), text);
}

#[test]
fn a_new_scene_asks_for_its_path_when_it_is_saved() {
    let mut window = Window::empty();
    window.press_with(Modifiers::COMMAND, Key::S);
    let path = window.folder.path().join("first");
    window.enter("Name", &path.display().to_string());
    assert!(path.with_extension("toml").is_file());
    assert_eq!(window.title(), "first.toml — foldmotion");
}

#[test]
fn another_scene_is_opened_through_the_window() {
    let mut window = Window::over(SMALL);
    window.until_preview();
    let other = window.folder.path().join("arch.toml");
    fs::write(&other, ARCH).unwrap();
    window.press_with(Modifiers::COMMAND, Key::O);
    window.enter("Name or path", "nothing.toml");
    assert!(window.says("file not found"));
    window.enter("Name or path", "arch");
    window.until("the other scene", |w| w.title() == "arch.toml — foldmotion");
    window.until_preview();
    assert_eq!(window.text(), ARCH);
    assert!(!window.says("Undo: "));
}

#[test]
fn the_window_asks_about_unsaved_edits_before_it_opens_another_scene() {
    for answer in ["Cancel", "Discard edits", "Save"] {
        let (mut window, text) = edited();
        window.press_with(Modifiers::COMMAND, Key::N);
        assert!(window.says("scene.toml has unsaved edits"));
        window.click(answer);
        let on_disk = fs::read_to_string(window.path()).unwrap();
        let title = window.title();
        match answer {
            "Cancel" => {
                assert_eq!(
                    (on_disk.as_str(), title.as_str()),
                    (SMALL, "• scene.toml — foldmotion")
                );
                assert_eq!(window.text(), text);
            }
            "Save" => assert_eq!((on_disk, title.as_str()), (text, "untitled.toml — foldmotion")),
            _ => assert_eq!(
                (on_disk.as_str(), title.as_str()),
                (SMALL, "untitled.toml — foldmotion")
            ),
        }
    }
}

#[test]
fn escape_answers_the_question_with_cancel() {
    let (mut window, text) = edited();
    window.press_with(Modifiers::COMMAND, Key::O);
    window.press(Key::Escape);
    assert!(!window.says("has unsaved edits"));
    assert_eq!(window.text(), text);
}

#[test]
fn a_file_that_another_program_has_changed_is_not_overwritten_without_asking() {
    for (answer, on_disk, title) in [
        ("Cancel", ARCH, "• scene.toml — foldmotion"),
        ("Reload", ARCH, "scene.toml — foldmotion"),
        ("Overwrite", "", "scene.toml — foldmotion"),
    ] {
        let (mut window, text) = edited();
        fs::write(window.path(), ARCH).unwrap();
        window.press_with(Modifiers::COMMAND, Key::S);
        assert!(window.says("was changed by another program"));
        window.click(answer);
        assert_eq!(window.title(), title, "{answer}");
        let expected = if on_disk.is_empty() { &text } else { on_disk };
        assert_eq!(fs::read_to_string(window.path()).unwrap(), expected, "{answer}");
        let shown = if answer == "Reload" { ARCH } else { &text };
        assert_eq!(window.text(), shown, "{answer}");
    }
}

#[derive(Debug)]
struct Dropped(PathBuf);

impl DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        fs::read(&self.0).map_err(|error| error.to_string())
    }
}

#[test]
fn a_dropped_file_is_opened_after_asking_about_unsaved_edits() {
    let (mut window, _) = edited();
    let other = window.folder.path().join("arch.toml");
    fs::write(&other, ARCH).unwrap();
    window.harness.input_mut().dropped_files = vec![Arc::new(Dropped(other))];
    window.settle();
    assert!(window.says("has unsaved edits"));
    window.click("Discard edits");
    window.until("the dropped scene", |w| w.title() == "arch.toml — foldmotion");
    window.until_preview();
}

#[test]
fn recent_files_are_remembered_and_opened_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    fs::write(&path, SMALL).unwrap();
    let mut storage = Storage::default();
    let mut window = Window::start(folder, Some(path.clone()), Some(&storage));
    window.until_preview();
    window.harness.state_mut().save(&mut storage);
    let Window { harness, folder, .. } = window;
    drop(harness);
    let mut window = Window::start(folder, None, Some(&storage));
    window.click("File");
    window.click("Open recent");
    let entry = window.harness.query_all_by_label_contains("scene.toml").last();
    entry.unwrap().click();
    window.until("the recent scene", |w| w.title() == "scene.toml — foldmotion");
}
