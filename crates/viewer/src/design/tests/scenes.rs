//! The panel over every scene in the repository.

use std::path::PathBuf;

use eframe::egui::{Event, Key, Modifiers, PointerButton, Theme, pos2, vec2};
use egui_kittest::kittest::Queryable as _;
use foldmotion_study::SceneSource;

use super::test_panel::{drag, panel_of, scenes};

fn all() -> Vec<PathBuf> {
    let files = |folder: PathBuf| {
        let entries = std::fs::read_dir(folder).unwrap();
        entries.map(|entry| entry.unwrap().path()).filter(|path| path.is_file())
    };
    let mut paths: Vec<PathBuf> = files(scenes()).chain(files(scenes().join("imported"))).collect();
    paths.sort();
    paths
}

#[test]
fn every_scene_is_shown_with_its_draft_without_it_and_with_that_of_another() {
    let mut other = None;
    assert!(all().len() > 20);
    for path in all() {
        let source = SceneSource::read(&path).unwrap();
        let mut harness = panel_of(&source, Theme::Dark, 4000.0);
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
    let mut harness = panel_of(&source, Theme::Light, 4000.0);
    for section in ["Material", "Motion", "Record"] {
        harness.get_by_label(section).click();
        harness.run();
    }
    assert!(harness.state().draft.is_none());
}

/// A random number generator with a fixed seed (Marsaglia 2003).
struct Random(u32);

impl Random {
    fn below(&mut self, below: u16) -> u16 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        (self.0 % u32::from(below)) as u16
    }
}

#[test]
fn random_clicks_and_typing_break_nothing() {
    const KEYS: [Key; 7] = [
        Key::ArrowUp,
        Key::ArrowLeft,
        Key::Delete,
        Key::Tab,
        Key::Enter,
        Key::Escape,
        Key::Backspace,
    ];
    let mut dice = Random(2_463_534_242);
    for scene in ["omega-sii", "shelter-unequal", "map-fold", "imported/frame"] {
        let source = SceneSource::read(&scenes().join(scene).with_extension("toml")).unwrap();
        let mut harness = panel_of(&source, Theme::Dark, 2400.0);
        for section in ["Material", "Motion", "Record"] {
            harness.get_by_label(section).click();
            harness.run();
        }
        for _ in 0..200 {
            let at = pos2(f32::from(dice.below(360)), f32::from(dice.below(2400)));
            match dice.below(6) {
                0 => {
                    let way =
                        vec2(f32::from(dice.below(80)) - 40.0, f32::from(dice.below(80)) - 40.0);
                    drag(&mut harness, at, way, 2);
                }
                1 => {
                    harness.event(Event::Text(
                        ["7", "-", "x", "1e308"][usize::from(dice.below(4))].to_owned(),
                    ));
                    harness.key_press(KEYS[usize::from(dice.below(7))]);
                }
                turn => {
                    let button =
                        if turn == 2 { PointerButton::Secondary } else { PointerButton::Primary };
                    harness.hover_at(at);
                    for pressed in [true, false] {
                        let modifiers = Modifiers::NONE;
                        harness.event(Event::PointerButton { pos: at, button, pressed, modifiers });
                    }
                }
            }
            harness.run_ok();
            harness.state_mut().redraft();
            harness.run_ok();
        }
        assert!(harness.state().changes.len() > 5, "{scene}");
        let real = harness.state().changes.windows(2).all(|pair| pair[0].scene != pair[1].scene);
        assert!(real, "{scene}: every change changes something");
    }
}
