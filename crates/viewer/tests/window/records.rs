//! Recording what is shown.

use std::path::Path;

use eframe::egui::{Key, Modifiers};
use foldmotion_study::scene::{OutputChoice, RecordScene};
use foldmotion_study::{SceneSource, Study};

use crate::driver::{SMALL, Window};

/// Records the same motion as `foldmotion record` does, into files that do not depend on the camera.
fn recorded(output: OutputChoice, folder: &Path) {
    let source = SceneSource::new(Path::new("scene.toml"), SMALL.to_owned());
    let study = Study::resolve(&source).unwrap();
    let folded = study.compute(&|_, _| true).unwrap();
    let record = RecordScene {
        outputs: Some(vec![output]),
        seconds: Some([0.25; 2]),
        ..RecordScene::default()
    };
    let files = study.record_as(&folded, &record, folder, &|_, _| true);
    assert!(!files.unwrap().is_empty());
}

#[test]
fn a_run_is_recorded_as_film_figure_and_model() {
    let mut window = Window::over(SMALL);
    window.run_scene();
    window.press_with(Modifiers::COMMAND, Key::E);
    let folder = window.folder.path().join("seen");
    window.enter("folder", &folder.display().to_string());
    window.enter("width, pixels", "120");
    window.enter("height, pixels", "90");
    window.enter("film, seconds", "0.5");
    assert!(window.is_on("film, GIF"));
    window.click("figure of states, SVG");
    window.click("3D file with the motion, GLB");
    window.click("Record now");
    window.until_said("Recorded ");
    let mut files: Vec<_> =
        std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let of = |ending: &str| {
        let mut of = files.iter().filter(|path| path.extension().is_some_and(|e| e == ending));
        of.next().unwrap_or_else(|| panic!("no {ending} in {files:?}"))
    };
    let gif = std::fs::read(of("gif")).unwrap();
    assert_eq!(&gif[..6], b"GIF89a");
    assert_eq!(gif[6..10], [120, 0, 90, 0], "as large as was asked");
    let svg = std::fs::read_to_string(of("svg")).unwrap();
    assert!(svg.contains("<svg") && svg.contains("<path"), "{}", &svg[..200]);
    let other = window.folder.path().join("other");
    recorded(OutputChoice::Glb, &other);
    let model = |path: &Path| {
        let glb = std::fs::read(path).unwrap();
        // The text before the numbers contains the settings of the recording, including the camera.
        let text = u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize;
        assert_eq!(&glb[..4], b"glTF");
        glb[20 + text..].to_vec()
    };
    let name = of("glb").file_name().unwrap();
    let same = model(of("glb")) == model(&other.join(name));
    assert!(same, "the same model");
}

#[test]
fn a_preview_is_not_recorded_and_a_run_is_offered() {
    let mut window = Window::over(SMALL);
    window.until_preview();
    window.press_with(Modifiers::COMMAND, Key::E);
    assert!(window.has("A preview cannot be recorded. Run the scene first."));
    assert!(!window.has("Record now"));
    window.click("Run the scene");
    window.until("it can be recorded", |w| w.is_enabled("Record now"));
    window.click("Close");
    assert!(!window.has("Record now"));
}

#[test]
fn nothing_is_recorded_without_an_output_or_a_folder() {
    let mut window = Window::over(SMALL);
    window.run_scene();
    window.press(Key::F6);
    assert!(window.is_enabled("Record now"));
    window.click("film, GIF");
    assert!(!window.is_enabled("Record now"), "{}", window.all_words());
    window.click("film, GIF");
    window.enter("folder", "");
    assert!(!window.is_enabled("Record now"));
}

#[test]
fn a_folder_that_cannot_be_written_is_an_error_that_names_it() {
    let mut window = Window::over(SMALL);
    window.run_scene();
    window.press(Key::F6);
    let file = window.path().join("below-a-file");
    window.enter("folder", &file.display().to_string());
    window.click("Record now");
    window.until_said("The recording failed");
    assert!(window.says("scene.toml"));
}

#[test]
fn the_folder_is_chosen_in_the_window() {
    let mut window = Window::over(SMALL);
    window.run_scene();
    window.press(Key::F6);
    window.click("Choose…");
    let folder = window.folder.path().join("chosen");
    window.enter("Name", &folder.display().to_string());
    assert_eq!(window.value("folder"), folder.display().to_string());
}
