//! The file picker, driven by keyboard and mouse.

use std::fs;
use std::path::Path;

use eframe::egui::{Key, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use tempfile::TempDir;

use super::super::Appearance;
use super::super::tests::{builder, drawn};
use super::*;

struct App {
    picker: FilePicker,
    picked: Option<PickerResult>,
}

fn harness(picker: FilePicker, appearance: Appearance) -> Harness<'static, App> {
    let app = App { picker, picked: None };
    let builder = builder(appearance, vec2(800.0, 600.0)).with_step_dt(0.02);
    let show = |ui: &mut eframe::egui::Ui, app: &mut App| {
        if app.picked.is_none() {
            app.picked = app.picker.show(ui.ctx());
        }
    };
    let mut harness = builder.build_ui_state(show, app);
    harness.run();
    harness
}

/// A folder with two scenes, a picture, a hidden file and two folders.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for name in ["shelter.toml", "Spiral.TOML", "notes.txt", ".hidden.toml"] {
        fs::write(folder.path().join(name), "").unwrap();
    }
    for name in ["imported", "other"] {
        fs::create_dir(folder.path().join(name)).unwrap();
    }
    fs::write(folder.path().join("imported/miura.toml"), "").unwrap();
    folder
}

fn open(folder: &Path) -> FilePicker {
    FilePicker::open("Open a scene", &["toml"], folder, &[])
}

fn save(folder: &Path, name: &str) -> FilePicker {
    FilePicker::save("Save the scene", &["toml"], folder, name, &[])
}

fn file_of(harness: &Harness<'_, App>) -> PathBuf {
    match &harness.state().picked {
        Some(PickerResult::File(path)) => path.clone(),
        other => panic!("{other:?} {:?}", harness.state().picker),
    }
}

fn typed(harness: &mut Harness<'_, App>, text: &str) {
    harness.event(eframe::egui::Event::Text(text.to_owned()));
    harness.run();
}

fn press(harness: &mut Harness<'_, App>, key: Key) {
    harness.key_press(key);
    harness.run();
}

#[test]
fn folders_come_first_and_only_fitting_files_are_listed() {
    let folder = folder();
    let names = |hidden| {
        let entries = folder::read(folder.path(), &["toml"], hidden).unwrap();
        entries.into_iter().map(|e| e.name).collect::<Vec<_>>()
    };
    assert_eq!(names(false), ["imported", "other", "shelter.toml", "Spiral.TOML"]);
    assert_eq!(names(true), ["imported", "other", ".hidden.toml", "shelter.toml", "Spiral.TOML"]);
}

#[test]
fn arrows_and_enter_go_into_a_folder_and_choose_a_file() {
    let folder = folder();
    let mut harness = harness(open(folder.path()), Appearance::Dark);
    press(&mut harness, Key::ArrowDown);
    press(&mut harness, Key::Enter);
    assert!(harness.state().picker.folder.ends_with("imported"));
    press(&mut harness, Key::ArrowDown);
    press(&mut harness, Key::Enter);
    assert!(file_of(&harness).ends_with("imported/miura.toml"));
}

#[test]
fn backspace_goes_up_and_escape_cancels() {
    let folder = folder();
    let mut harness = harness(open(&folder.path().join("imported")), Appearance::Dark);
    press(&mut harness, Key::Backspace);
    let picker = &harness.state().picker;
    assert_eq!(picker.folder, folder.path().canonicalize().unwrap());
    assert_eq!(picker.selected, Some(0));
    press(&mut harness, Key::Escape);
    assert_eq!(harness.state().picked, Some(PickerResult::Cancelled));
}

#[test]
fn typing_narrows_the_list_tab_completes_and_a_wrong_name_says_so() {
    let folder = folder();
    let mut harness = harness(open(folder.path()), Appearance::Dark);
    typed(&mut harness, "spi");
    assert_eq!(harness.state().picker.shown.len(), 1);
    press(&mut harness, Key::Tab);
    assert_eq!(harness.state().picker.typed, "Spiral.TOML");
    typed(&mut harness, "x");
    press(&mut harness, Key::Enter);
    harness.get_by_label_contains("file not found");
    press(&mut harness, Key::Backspace);
    press(&mut harness, Key::Enter);
    assert!(file_of(&harness).ends_with("Spiral.TOML"));
}

#[test]
fn a_path_is_completed_step_by_step() {
    let folder = folder();
    let complete = |typed| folder::completed(folder.path(), typed, &["toml"]);
    assert_eq!(complete("im").as_deref(), Some("imported/"));
    assert_eq!(complete("imported/").as_deref(), Some("imported/miura.toml"));
    assert_eq!(complete("s").as_deref(), Some("shelter.toml"));
    assert_eq!(complete("none"), None);
    fs::write(folder.path().join("shelf.toml"), "").unwrap();
    assert_eq!(complete("s").as_deref(), Some("shel"));
    let home = std::env::home_dir().unwrap();
    assert_eq!(folder::resolve(folder.path(), "~/a"), home.join("a"));
    assert_eq!(folder::resolve(folder.path(), "~a"), folder.path().join("~a"));
}

#[test]
fn a_double_click_chooses_and_breadcrumbs_go_to_parent_folders() {
    let folder = folder();
    let mut harness = harness(open(&folder.path().join("imported")), Appearance::Dark);
    let name = folder.path().file_name().unwrap().to_str().unwrap().to_owned();
    harness.get_by_label(&name).click();
    harness.run();
    // Long enough that the next click does not count as a double click.
    harness.run_steps(30);
    for _ in 0..2 {
        harness.get_by_label("shelter.toml").click();
        harness.step();
    }
    harness.run();
    assert!(file_of(&harness).ends_with("shelter.toml"));
}

#[test]
fn saving_adds_the_ending_and_asks_before_it_overwrites() {
    let folder = folder();
    let mut fresh = harness(save(folder.path(), "new"), Appearance::Dark);
    press(&mut fresh, Key::Enter);
    assert_eq!(file_of(&fresh), folder.path().canonicalize().unwrap().join("new.toml"));

    let mut harness = harness(save(folder.path(), "shelter.toml"), Appearance::Dark);
    press(&mut harness, Key::Enter);
    harness.get_by_label("shelter.toml already exists. Overwrite it?");
    press(&mut harness, Key::Escape);
    assert!(harness.state().picked.is_none());
    press(&mut harness, Key::Enter);
    harness.get_by_label("Overwrite").click();
    harness.run();
    assert!(file_of(&harness).ends_with("shelter.toml"));
}

#[test]
fn saving_refuses_other_endings_and_folders_that_are_not_there() {
    let folder = folder();
    for (name, reason) in
        [("a.fold", "must end in .toml"), ("no/a", "folder not found"), ("", "Type a name")]
    {
        let mut harness = harness(save(folder.path(), name), Appearance::Dark);
        press(&mut harness, Key::Enter);
        harness.get_by_label_contains(reason);
    }
}

#[test]
fn a_folder_that_cannot_be_read_says_so() {
    let folder = folder();
    let harness = harness(open(&folder.path().join("gone")), Appearance::Dark);
    harness.get_by_label_contains("cannot be read");
}

#[test]
fn only_visible_rows_of_ten_thousand_files_are_laid_out() {
    let folder = tempfile::tempdir().unwrap();
    for k in 0..10_000 {
        fs::write(folder.path().join(format!("{k:05}.toml")), "").unwrap();
    }
    let mut harness = harness(open(folder.path()), Appearance::Dark);
    assert_eq!(harness.state().picker.shown.len(), 10_000);
    let laid_out = harness.get_all_by_label_contains(".toml").count();
    assert!(laid_out < 60, "{laid_out}");
    press(&mut harness, Key::ArrowUp);
    harness.get_by_label("09999.toml");
    press(&mut harness, Key::Enter);
    assert!(file_of(&harness).ends_with("09999.toml"));
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn the_picker_is_drawn_dark_and_light() {
    let folder = folder();
    for appearance in [Appearance::Dark, Appearance::Light] {
        let recent = [folder.path().join("imported")];
        let picker =
            FilePicker::open("Open a scene", &["toml", "fold", "svg"], folder.path(), &recent);
        let mut harness = harness(picker, appearance);
        press(&mut harness, Key::ArrowDown);
        drawn(&mut harness, &format!("picker-{}", appearance.name()), [400, 150]);
        let mut harness = self::harness(save(folder.path(), "shelter"), appearance);
        press(&mut harness, Key::Enter);
        let lit = drawn(&mut harness, &format!("picker-save-{}", appearance.name()), [400, 150]);
        assert_eq!(lit < 128, appearance == Appearance::Dark, "{lit}");
    }
}
