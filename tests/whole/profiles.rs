//! Built-in profiles and outline files become sheets.

use std::path::Path;

use foldmotion_study::{SceneSource, UnitStudy, models};

fn resolve(text: &str) -> UnitStudy {
    let source = SceneSource::new(Path::new("scene.toml"), text.to_owned());
    UnitStudy::resolve(&source).unwrap_or_else(|e| panic!("{text}: {e}"))
}

#[test]
fn every_built_in_profile_resolves_in_every_case_with_the_same_polygon_and_width() {
    for model in models() {
        let target = resolve(&format!("[profile]\nmodel = \"{}\"", model.name));
        let width = target.units.unit.width * target.units.columns as f64;
        assert_eq!(target.units.columns, model.columns.e);
        for (case, columns) in
            [("T", model.columns.t), ("S", model.columns.s), ("SII", model.columns.s)]
        {
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
        ("bunny", 30),
    ] {
        let study = resolve(&format!(
            "[profile]\nmodel = \"{name}\"\n[sheet]\nrows = {rows}\ncolumns = 1\ncase = \"E\"\n"
        ));
        assert_eq!(study.units.rows, rows);
        assert!(study.division.max_residual <= 1e-13);
    }
}

/// A folder with an outline file and a scene that names it.
fn beside(name: &str, outline: &str, more: &str) -> (tempfile::TempDir, SceneSource) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(name), outline).unwrap();
    let scene = format!(
        "[profile]\nfile = \"{name}\"\n{more}\n[sheet]\nrows = 8\ncolumns = 2\ncase = \"E\"\n"
    );
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, scene).unwrap();
    let source = SceneSource::read(&path).unwrap();
    (folder, source)
}

const SECTION: &str = "Section\n1.0 0.001\n0.6 0.07\n0.3 0.1\n0.05 0.05\n0.0 0.0\n0.05 -0.03\n0.3 -0.04\n0.6 -0.02\n1.0 -0.001\n";

#[test]
fn points_of_the_scene_and_the_same_points_in_a_table_give_the_same_study() {
    let own = resolve(
        "[profile]\npoints = [[4, 0], [3, 1.5], [1, 2], [0, 0]]\n[sheet]\nrows = 8\ncolumns = 2\ncase = \"E\"\n",
    );
    assert!(own.profile_source.contains("points of the scene"));
    let (_folder, source) = beside("hill.csv", "x,z\n4,0\n3,1.5\n1,2\n0,0\n", "");
    let study = UnitStudy::resolve(&source).unwrap();
    assert_eq!(study.division.points, own.division.points);
    assert_eq!(study.profile_source, "points of hill.csv");
    assert!(!study.profile.is_closed());
    assert!(study.fit.largest > 0.0 && study.fit.mean < study.fit.largest);
}

#[test]
fn an_airfoil_file_and_a_closed_polyline_become_closed_sheets() {
    let (_folder, source) = beside("wing.dat", SECTION, "length = 8.0");
    let wing = UnitStudy::resolve(&source).unwrap();
    assert!(wing.profile.is_closed());
    assert!((wing.division.mean_length - 1.0).abs() < 1e-13);
    let dxf =
        "0\nLWPOLYLINE\n70\n1\n10\n0\n20\n0\n10\n3\n20\n0\n10\n4\n20\n2\n10\n1\n20\n3\n0\nEOF\n";
    let (_folder, source) = beside("plot.dxf", dxf, "closed = \"smooth\"");
    let plot = UnitStudy::resolve(&source).unwrap();
    assert_eq!(plot.division.points.first(), plot.division.points.last());
}

#[test]
fn a_drawing_may_close_its_polyline_by_a_long_side_and_be_a_chain_of_lines() {
    let long = "0\nLWPOLYLINE\n90\n4\n70\n1\n10\n0\n20\n0\n10\n1\n20\n3\n10\n2\n20\n3\n10\n9\n20\n0\n0\nEOF\n";
    let (_folder, source) = beside("plot.dxf", long, "");
    assert!(UnitStudy::resolve(&source).unwrap().profile.is_closed());
    let line = |[x, y, u, v]: [i32; 4]| format!("0\nLINE\n10\n{x}\n20\n{y}\n11\n{u}\n21\n{v}\n");
    let lines = [[2, 1, 1, 0], [0, 0, 1, 0], [2, 1, 4, 1]].map(line).concat();
    let (_folder, source) = beside("plot.dxf", &format!("{lines}0\nEOF\n"), "");
    let study = UnitStudy::resolve(&source).unwrap();
    assert!(!study.profile.is_closed());
    assert_eq!(study.division.points[0], glam::DVec2::ZERO);
}

#[test]
fn bad_outlines_are_refused_with_file_line_value_and_remedy() {
    let repeated = "0,0\n1,1\n1,1\n2,0\n";
    let crossing = "0,0\n4,4\n4,0\n0,4\n";
    let many = (0..20_001).map(|k| format!("{k},0")).collect::<Vec<_>>().join("\n");
    let cut_off = "0\nLWPOLYLINE\n90\n4\n70\n1\n10\n0\n20\n0\n10\n3\n20\n0\n10\n4\n20\n2\n";
    let arc = "0\nARC\n10\n0\n20\n0\n40\n1\n0\nEOF\n";
    let cases: [(&str, &str, &str, &[&str]); 10] = [
        ("a.dxf", cut_off, "", &["profile.file", "line 18", "cut off"]),
        ("a.dxf", arc, "", &["profile.file", "line 2", "ARC"]),
        ("a.csv", "0,0\n1,oops\n", "", &["profile.file = \"a.csv\"", "line 2", "oops"]),
        ("a.csv", "0,0\n", "", &["profile.file", "1 points"]),
        ("a.csv", repeated, "", &["profile.file", "points 1 and 2", "remove"]),
        ("a.csv", crossing, "", &["profile.file", "crosses itself"]),
        ("a.csv", &many, "", &["20001 points"]),
        (
            "a.csv",
            "0,0\n1,0\n2,1\n3,4\n4,9\n5,14\n",
            "closed = \"corner\"",
            &["profile.closed", "away from its start"],
        ),
        (
            "a.dat",
            "Name
1 0
0.5
",
            "",
            &["profile.file", "line 3: 1 values"],
        ),
        ("a.step", "", "", &["step", ".csv", ".dat", ".dxf"]),
    ];
    for (name, outline, more, words) in cases {
        let (_folder, source) = beside(name, outline, more);
        let error = UnitStudy::resolve(&source).err().unwrap();
        assert_eq!(error.status(), 2);
        let message = error.to_string();
        for word in words {
            assert!(message.contains(word), "{word}: {message}");
        }
    }
}

fn refusal(text: &str) -> String {
    let source = SceneSource::new(Path::new("scene.toml"), text.to_owned());
    let error = UnitStudy::resolve(&source).err().unwrap();
    assert_eq!(error.status(), 2);
    error.to_string()
}

#[test]
fn unequal_divisions_are_refused_with_their_fit_unless_their_segments_are_equal() {
    for method in ["parametric", "douglas-peucker"] {
        let scene = format!("[profile]\nmodel = \"shelter\"\n[division]\nmethod = \"{method}\"\n");
        let message = refusal(&scene);
        for word in ["scene.toml:4", "7 segments", "on average", "equal-length"] {
            assert!(message.contains(word), "{word}: {message}");
        }
    }
    let straight = "[profile]\ncontrol_points = [[3, 0], [2, 0], [1, 0], [0, 0]]\n[sheet]\nrows = 3\ncolumns = 1\ncase = \"E\"\n[division]\nmethod = \"parametric\"\n";
    assert_eq!(resolve(straight).units.rows, 3);
}

#[test]
fn a_douglas_peucker_tolerance_replaces_the_rows_and_must_leave_two_segments() {
    let scene = |tolerance: &str, more: &str| {
        format!(
            "[profile]\nmodel = \"omega\"\n[division]\nmethod = \"douglas-peucker\"\ntolerance = {tolerance}\n{more}"
        )
    };
    assert!(refusal(&scene("0.01", "")).contains("segments that differ"));
    assert!(refusal(&scene("0.9", "")).contains("leaves 1"));
    assert!(refusal(&scene("0.0", "")).contains("division.tolerance"));
    let both = refusal(&scene("0.01", "[sheet]\nrows = 9\n"));
    assert!(both.contains("sheet.rows = 9") && both.contains("follow from"), "{both}");
}

#[test]
fn one_key_gives_the_curve() {
    let message = refusal("[profile]\nmodel = \"omega\"\nfile = \"a.csv\"\n");
    assert!(message.contains("profile.file") && message.contains("profile.model"), "{message}");
    let message = refusal("[profile]\npoints = [[0, 0], [1, 1]]\nknots = [0, 1]\n");
    assert!(message.contains("profile.knots"), "{message}");
}
