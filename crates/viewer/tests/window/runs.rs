//! Scenes are run in the background, and their verdicts are shown.

use std::path::Path;

use eframe::egui::Key;
use foldmotion_study::{Report, SceneSource, Study};

use crate::driver::{PENETRATING, SMALL, Window, scenes};

/// The report of the same scene from the library.
fn report_of(text: &str) -> Report {
    let source = SceneSource::new(Path::new("scene.toml"), text.to_owned());
    let study = Study::resolve(&source).unwrap();
    study.report_of(&study.compute(&|_, _| true).unwrap())
}

#[test]
fn a_run_shows_the_numbers_that_the_library_computes() {
    let mut window = Window::over(SMALL);
    window.run_scene();
    let report = report_of(SMALL);
    let collision = &report.collision;
    assert!(window.has("folded"), "{}", window.all_words());
    assert!(window.says(&report.outcome.reason));
    let tested = format!(
        "{}: {} pairs tested between {} frames",
        collision.verdict, collision.pairs_tested, report.path.frames
    );
    assert!(window.says(&tested), "{tested}\n{}", window.all_words());
    for extent in report.compact.extents {
        assert!(window.has(&format!("{extent:.5}")), "{extent}");
    }
    let strain = format!("largest strain {:.2e} at", report.stages[0].peak_strain);
    assert!(window.has(&strain), "{strain}");
    assert!(window.says("bar strain, % over motion time"));
    assert!(!window.says("of date: the scene has changed"));
}

#[test]
fn a_run_is_followed_and_then_shown_at_its_end() {
    let mut window = Window::of(&scenes().join("shelter-s.toml"));
    window.until("the scene is resolved", |w| w.is_enabled("Run"));
    window.press(Key::F5);
    assert!(window.has("Cancel") && window.is_on("follow"));
    window.until_said("states per second");
    let first = window.text_over_view();
    window.until("another state", |w| w.text_over_view() != first);
    window.click("follow");
    assert!(!window.says("states per second"));
    window.click("Cancel");
    window.until_said("The run was stopped");
    window.until("it may run again", |w| w.is_enabled("Run"));
    assert!(!window.says("pairs tested"));
}

#[test]
fn escape_cancels_a_run_and_a_second_run_has_to_wait() {
    let mut window = Window::of(&scenes().join("shelter-s.toml"));
    window.until("the scene is resolved", |w| w.is_enabled("Run"));
    window.press(Key::F5);
    window.press(Key::F5);
    assert!(window.says("Cancel it first"));
    window.press(Key::Escape);
    window.until_said("The run was stopped");
}

#[test]
fn an_edit_during_a_run_is_accepted_and_the_result_is_out_of_date_until_it_is_undone() {
    let mut window = Window::over(&SMALL.replace("frames = 8", "frames = 200"));
    window.until_preview();
    window.press(Key::F5);
    window.enter("width W", "6.5");
    assert!(window.text().contains("width = 6.5"), "taken while it runs");
    window.until("the run has ended", |w| w.says("pairs tested between") && !w.has("Cancel"));
    assert!(window.says("of date: the scene has changed"), "{}", window.all_words());
    window.until_preview();
    assert!(window.says("Last run (out of date"));
    window.undo();
    window.until("the run's own scene again", |w| !w.says("of date: the scene has changed"));
    let outcome = report_of(SMALL).outcome.headline();
    assert!(window.text_over_view().ends_with(&outcome), "{}", window.text_over_view());
}

#[test]
fn a_run_stays_visible_while_an_edit_is_invalid() {
    let mut window = Window::over(SMALL);
    window.run_scene();
    window.enter("width W", "-1");
    window.until_said("Out of date: the scene has changed since this run");
    assert!(window.says("pairs tested between"));
    assert!(!window.says("preview: without contact"));
}

#[test]
fn penetrations_are_shown_and_the_time_of_the_first_is_a_link() {
    let mut window = Window::over(PENETRATING);
    window.run_scene();
    let report = report_of(PENETRATING);
    assert_eq!(report.collision.verdict.name(), "penetrating");
    let first = report.collision.first.unwrap();
    assert!(window.says("collides at t = "), "{}", window.all_words());
    window.press(Key::Home);
    assert_eq!(window.time(), 0.0);
    window.follow_link(&format!("t\u{a0}=\u{a0}{:.4}", first.t));
    assert!((window.time() - first.t).abs() < 1e-12, "{} {}", window.time(), first.t);
    assert!(window.says("penetrate here"), "{}", window.text_over_view());
}

#[test]
fn a_scene_that_cannot_be_run_says_why() {
    let mut window = Window::over(&SMALL.replace("frames = 8", "frames = 3"));
    window.until_said("motion.frames");
    assert!(!window.is_enabled("Run"));
    window.press(Key::F5);
    assert!(window.says("motion.frames"));
    assert!(!window.has("Cancel"));
}
