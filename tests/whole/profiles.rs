//! Profiles: every built-in one becomes a sheet in every case.

use std::path::Path;

use foldmotion_study::{SceneSource, Study, models};

fn resolve(text: &str) -> Study {
    let source = SceneSource::new(Path::new("scene.toml"), text.to_owned());
    Study::resolve(&source).unwrap_or_else(|e| panic!("{text}: {e}"))
}

#[test]
fn every_built_in_profile_resolves_in_every_case_with_the_same_polygon_and_width() {
    for model in models() {
        let target = resolve(&format!("[profile]\nmodel = \"{}\"", model.name));
        let width = target.units.unit.width * target.units.columns as f64;
        assert_eq!(target.units.columns, model.columns.e);
        for (case, columns) in [
            ("T", model.columns.t),
            ("S", model.columns.s),
            ("SII", model.columns.s),
        ] {
            let lambda = if case == "SII" { "lambda = 0.7" } else { "" };
            let study = resolve(&format!(
                "[profile]\nmodel = \"{}\"\n[sheet]\ncase = \"{case}\"\n{lambda}\n",
                model.name
            ));
            let units = &study.units;
            assert_eq!((units.rows, units.columns), (model.rows, columns));
            assert_eq!(units.unit.case.name(), case);
            assert!((units.unit.width * columns as f64 - width).abs() < 1e-12 * width);
            assert_eq!(study.division.points, target.division.points);
        }
    }
}

#[test]
fn built_in_profiles_resolve_with_fewer_rows() {
    for (name, rows) in [
        ("shelter", 5),
        ("chair", 6),
        ("rolling-paper", 9),
        ("fermat-spiral", 80),
        ("omega", 12),
        ("mushroom", 8),
        ("whale", 12),
        ("airfoil", 8),
        ("bunny", 50),
    ] {
        let study = resolve(&format!(
            "[profile]\nmodel = \"{name}\"\n[sheet]\nrows = {rows}\ncolumns = 1\ncase = \"E\"\n"
        ));
        assert_eq!(study.units.rows, rows);
        assert!(study.division.max_residual <= 1e-13);
    }
}
