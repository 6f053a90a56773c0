//! The panel over every scene that comes with the project.

use std::path::PathBuf;

use eframe::egui::Theme;
use egui_kittest::kittest::Queryable as _;
use foldmotion_study::SceneSource;

use super::bench::{bench_of, scenes};

fn all() -> Vec<PathBuf> {
    let files = |folder: PathBuf| {
        let entries = std::fs::read_dir(folder).unwrap();
        entries
            .map(|entry| entry.unwrap().path())
            .filter(|path| path.is_file())
    };
    let mut paths: Vec<PathBuf> = files(scenes())
        .chain(files(scenes().join("imported")))
        .collect();
    paths.sort();
    paths
}

#[test]
fn every_scene_is_shown_with_its_draft_without_it_and_with_that_of_another() {
    let mut other = None;
    assert!(all().len() > 20);
    for path in all() {
        let source = SceneSource::read(&path).unwrap();
        let mut harness = bench_of(&source, Theme::Dark, 4000.0);
        for section in ["Material", "Motion", "Record"] {
            harness.get_by_label(section).click();
            harness.run();
        }
        assert!(harness.state().draft.is_some(), "{}", path.display());
        let own = harness.state_mut().draft.take();
        harness.state_mut().draft_number += 1;
        harness.run();
        harness.state_mut().draft = other.take();
        harness.state_mut().draft_number += 1;
        harness.run();
        other = own;
        assert!(harness.state().changes.is_empty(), "{}", path.display());
    }
}

#[test]
fn an_empty_scene_is_shown() {
    let source = SceneSource::new("new.toml".as_ref(), String::new());
    let mut harness = bench_of(&source, Theme::Light, 4000.0);
    for section in ["Material", "Motion", "Record"] {
        harness.get_by_label(section).click();
        harness.run();
    }
    assert!(harness.state().draft.is_none());
}
