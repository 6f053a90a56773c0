//! Small pictures of the window, compared with reference pictures.

use eframe::egui::{Key, Modifiers, Theme, vec2};
use egui_kittest::{Harness, SnapshotOptions};

use crate::driver::{SMALL, Window};

/// A window of a small size, drawn by the GPU.
fn drawn(theme: Theme, text: &str) -> Window {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, text).unwrap();
    let builder = Harness::builder()
        .with_size(vec2(800.0, 560.0))
        .with_theme(theme)
        .with_render_cursor(false)
        .wgpu();
    Window::built(builder, folder, Some(path), None)
}

/// Compares with the reference picture of that name. Edges and shades may differ between drivers.
fn compare(window: &mut Window, name: &str) {
    window.harness.remove_cursor();
    // The camera comes to rest.
    window.harness.run_steps(12);
    window.hide_seconds();
    let options = SnapshotOptions::new().threshold(2.0).max_failed_pixels(1500);
    window.harness.snapshot_options(name, &options);
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn the_deployed_sheet_in_dark() {
    let mut window = drawn(Theme::Dark, SMALL);
    window.until_preview();
    compare(&mut window, "deployed-dark");
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn the_deployed_sheet_in_light() {
    let mut window = drawn(Theme::Light, SMALL);
    window.until_preview();
    compare(&mut window, "deployed-light");
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn half_folded_with_strain_after_a_run() {
    let mut window = drawn(Theme::Dark, SMALL);
    window.run_scene();
    window.press(Key::F2);
    window.enter("t", "1.5");
    window.press(Key::Num6);
    compare(&mut window, "half-folded-strain");
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn compact_with_its_boxes() {
    let mut window = drawn(Theme::Dark, SMALL);
    window.until_preview();
    window.press(Key::F4);
    window.press(Key::End);
    window.press(Key::B);
    window.press(Key::F);
    compare(&mut window, "compact-boxes");
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn the_record_dialog() {
    let mut window = drawn(Theme::Light, SMALL);
    window.run_scene();
    window.press_with(Modifiers::COMMAND, Key::E);
    compare(&mut window, "record-light");
}
