//! Rows of unequal height, skins and maps, from the scene to the report.

use std::path::Path;

use foldmotion_study::{Report, SceneSource, Study, clash_drawing};

fn source(scene: &str, set: &[&str]) -> SceneSource {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let mut source = SceneSource::read(&scenes.join(format!("{scene}.toml"))).unwrap();
    for assignment in set.iter().chain(&["record.outputs=[]"]) {
        source.set(assignment).unwrap();
    }
    source
}

fn run(scene: &str, set: &[&str]) -> Report {
    let home = tempfile::tempdir().unwrap();
    let study = Study::resolve(&source(scene, set)).unwrap();
    study.run(home.path(), &|_, _| true).unwrap()
}

fn largest_error(report: &Report) -> f64 {
    let error = report.compact.relative_error.unwrap();
    let all = error.extents.into_iter().chain([error.area, error.volume]);
    all.fold(0.0, |worst: f64, e| worst.max(e.abs()))
}

#[test]
fn unequal_rows_with_one_flap_width_fold_to_their_exact_box_with_and_without_contact() {
    for (contact, verdicts, tolerance) in [
        ("motion.contact=false", ["touching", "free"], 1e-6),
        ("motion.contact=true", ["free", "free"], 2e-2),
    ] {
        let report = run("shelter-unequal", &[contact]);
        let verdict = report.collision.verdict.name();
        assert!(verdicts.contains(&verdict), "{contact}: {verdict}");
        assert_eq!((report.case.as_deref().unwrap(), report.status()), ("SII", 0));
        assert!(report.compact.rms_to_exact.unwrap() < tolerance, "{contact}");
        if contact.ends_with("false") {
            assert!(largest_error(&report) < tolerance);
        }
        let rows = report.unequal_rows.unwrap();
        let total: f64 = rows.iter().map(|row| row.height).sum();
        assert!((total - 5.0).abs() < 1e-12);
        assert!(
            rows.iter()
                .any(|row| row.height > 1.2 * rows[0].height || row.height < rows[0].height / 1.2)
        );
        let skin = report.compact.skin.unwrap();
        for (measured, exact) in [(skin.upper, skin.exact_upper), (skin.lower, skin.exact_lower)] {
            assert_eq!(measured.facets, exact.facets);
            assert!(exact.facets > 0);
            assert!((measured.area / exact.area - 1.0).abs() < tolerance);
        }
    }
}

#[test]
fn a_short_sheet_lies_on_one_skin_plane_with_facets_and_on_the_other_with_edges() {
    let set = ["sheet.rows=3", "sheet.columns=2", "motion.contact=false"];
    let skin = run("shelter-s", &set).compact.skin.unwrap();
    assert_eq!((skin.upper.facets, skin.lower.facets), (6, 0));
    assert!(skin.lower.edges > 0 && skin.lower.area == 0.0);
    assert!((skin.upper.area / skin.exact_upper.area - 1.0).abs() < 1e-6);
}

#[test]
fn rows_in_cases_that_clash_are_refused_by_name_and_drawn() {
    let set = ["sheet.unequal=own-case", "sheet.width=2.0", "sheet.lambda=0.8"];
    let with_lambda = Study::resolve(&source("shelter-unequal", &set)).unwrap_err();
    assert!(with_lambda.to_string().contains("sheet.lambda"));
    let text = std::fs::read_to_string(
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/shelter-unequal.toml"),
    )
    .unwrap()
    .replace("lambda = 0.8\n", "")
    .replace("common-flap", "own-case");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.toml");
    std::fs::write(&path, text).unwrap();
    let own = SceneSource::read(&path).unwrap();
    let error = Study::resolve(&own).unwrap_err();
    assert_eq!(error.status(), 2);
    let message = error.to_string();
    assert!(message.contains("sheet.unequal") && message.contains("clash"), "{message}");
    let svg = clash_drawing(&own).unwrap().unwrap();
    assert!(svg.contains("class=\"clash\""));
    assert_eq!(clash_drawing(&source("shelter-s", &[])).unwrap(), None);
}

#[test]
fn unequal_rows_are_refused_unless_the_scene_allows_them() {
    let error = Study::resolve(&source("shelter-unequal", &["sheet.unequal=refuse"])).unwrap_err();
    assert!(error.to_string().contains("common-flap"), "{error}");
    let error = Study::resolve(&source("shelter-unequal", &["sheet.case=S"])).unwrap_err();
    assert!(error.to_string().contains("sheet.case"), "{error}");
}

#[test]
fn a_map_folds_to_one_unit_of_all_layers_beside_the_box_of_the_waterbomb_stack() {
    let report = run("map-fold", &[]);
    let map = report.map.as_ref().unwrap();
    assert_eq!((map.layers, report.status()), (12, 0));
    assert_eq!(report.collision.verdict.name(), "touching");
    let (h, w) = (report.unit.unwrap().height, report.unit.unwrap().width);
    for (found, expected) in report.compact.extents.into_iter().zip([h, w, 0.0]) {
        assert!((found - expected).abs() < 1e-6 * h, "{found} is not {expected}");
    }
    let waterbomb = map.waterbomb.unwrap();
    let a = report.unit.unwrap().flap;
    assert!((waterbomb.extents[0] - (4.0 * h - 3.0 * a)).abs() < 1e-12);
    assert!(report.pattern.flat_foldable && report.compact.skin.is_none());
}
