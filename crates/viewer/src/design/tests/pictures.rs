//! The panel drawn, dark and light. FOLDMOTION_PICTURES names a folder in which the pictures are left to be looked at.

use std::collections::BTreeSet;
use std::path::Path;

use eframe::egui::Theme;
use egui_kittest::Harness;
use foldmotion_study::SceneSource;

use super::super::Fault;
use super::bench::{Bench, bench_of, click, scenes};

/// Draws the panel; how many colours the picture has.
fn colours(harness: &mut Harness<'static, Bench>, name: &str) -> usize {
    let picture = harness.render().unwrap();
    if let Ok(folder) = std::env::var("FOLDMOTION_PICTURES") {
        picture
            .save(Path::new(&folder).join(format!("{name}.png")))
            .unwrap();
    }
    picture
        .pixels()
        .map(|pixel| pixel.0)
        .collect::<BTreeSet<_>>()
        .len()
}

#[test]
fn the_panel_is_drawn_dark_and_light() {
    for (theme, name) in [(Theme::Dark, "dark"), (Theme::Light, "light")] {
        for scene in [
            "shelter-sii",
            "omega-sii",
            "shelter-unequal",
            "imported/frame",
        ] {
            let path = scenes().join(scene).with_extension("toml");
            let source = SceneSource::read(&path).unwrap();
            let mut harness = bench_of(&source, theme, 1400.0);
            let short = scene.replace('/', "-");
            assert!(colours(&mut harness, &format!("{short}-{name}")) > 20);
            for section in ["Profile", "Sheet", "Closed forms", "Pattern"] {
                if egui_kittest::kittest::Queryable::query_by_label(&harness, section).is_some() {
                    click(&mut harness, section);
                }
            }
            for section in ["Material", "Motion", "Record"] {
                click(&mut harness, section);
            }
            harness.state_mut().faults = vec![Fault {
                key: Some("motion.frames".to_owned()),
                message: "scene.toml:12:9: motion.frames = 3: must be an even number between 2 and 100000".to_owned(),
            }];
            harness.run();
            assert!(colours(&mut harness, &format!("{short}-{name}-rest")) > 20);
        }
    }
}
