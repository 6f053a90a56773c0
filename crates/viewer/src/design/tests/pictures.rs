//! Pictures of the panel, dark and light. If FOLDMOTION_PICTURES names a folder, they are saved there to be looked at.

use std::collections::BTreeSet;
use std::path::Path;

use eframe::egui::Theme;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use foldmotion_study::SceneSource;

use super::super::SceneError;
use super::test_panel::{TestPanel, click, panel_of, scenes};

/// Draws the panel and returns the number of colours in the picture.
fn colours(harness: &mut Harness<'static, TestPanel>, name: &str) -> usize {
    let picture = harness.render().unwrap();
    if let Ok(folder) = std::env::var("FOLDMOTION_PICTURES") {
        picture.save(Path::new(&folder).join(format!("{name}.png"))).unwrap();
    }
    picture.pixels().map(|pixel| pixel.0).collect::<BTreeSet<_>>().len()
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn a_narrow_panel_shows_a_selected_point_the_unit_under_the_pointer_and_errors() {
    let path = scenes().join("omega-sii.toml");
    for (theme, name) in [(Theme::Dark, "dark"), (Theme::Light, "light")] {
        let mut harness = panel_of(&SceneSource::read(&path).unwrap(), theme, 1400.0);
        harness.set_size(eframe::egui::vec2(320.0, 1400.0));
        harness.run();
        click(&mut harness, "control point 5");
        let message = "omega.toml:9:9: sheet.width = -4.8: must be a positive, finite number";
        harness.state_mut().errors = vec![
            SceneError::new(Some("sheet.width"), &message),
            SceneError::new(Some("division"), &"the profile cannot be divided"),
        ];
        harness.run();
        let pattern = harness.get_by_label("crease pattern").rect();
        harness.hover_at(pattern.center() + eframe::egui::vec2(40.0, 8.0));
        harness.run();
        assert!(colours(&mut harness, &format!("narrow-{name}")) > 20);
    }
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn steps_own_camera_and_cases_that_contradict_are_drawn() {
    let text = "[profile]\nmodel = \"bunny\"\n[sheet]\ncase = \"S\"\nwidth = 30.0\n[material]\npreset = \"paper\"\n\
                fold_stiffness = 1.5\n[[motion.step]]\nstage = \"fold\"\nrows = [0, 3]\nto = 0.5\n[[motion.step]]\n\
                stage = \"unfold\"\ncreases = \"diagonals\"\nfrom = 0.25\nto = 0.75\nease = \"smooth\"\n[record]\n\
                size = [640, 480]\nthickened = 0.02\ncamera = { azimuth = 30.0, elevation = 20.0 }\n";
    for (theme, name) in [(Theme::Dark, "dark"), (Theme::Light, "light")] {
        let mut harness =
            panel_of(&SceneSource::new("own.toml".as_ref(), text.to_owned()), theme, 1900.0);
        for section in ["Sheet", "Closed forms", "Crease pattern", "Material", "Motion", "Record"] {
            click(&mut harness, section);
        }
        assert!(colours(&mut harness, &format!("own-{name}")) > 20);
    }
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn the_panel_is_drawn_dark_and_light() {
    for (theme, name) in [(Theme::Dark, "dark"), (Theme::Light, "light")] {
        for scene in ["shelter-sii", "omega-sii", "shelter-unequal", "imported/frame"] {
            let path = scenes().join(scene).with_extension("toml");
            let source = SceneSource::read(&path).unwrap();
            let mut harness = panel_of(&source, theme, 1400.0);
            let short = scene.replace('/', "-");
            assert!(colours(&mut harness, &format!("{short}-{name}")) > 20);
            for section in ["Profile", "Sheet", "Closed forms", "Pattern"] {
                if harness.query_by_label(section).is_some() {
                    click(&mut harness, section);
                }
            }
            for section in ["Material", "Motion", "Record"] {
                click(&mut harness, section);
            }
            harness.state_mut().errors = vec![SceneError::new(
                Some("motion.frames"),
                &"scene.toml:12:9: motion.frames = 3: must be an even number between 2 and 100000",
            )];
            harness.run();
            assert!(colours(&mut harness, &format!("{short}-{name}-rest")) > 20);
        }
    }
}
