//! Bad scenes are refused with the key, the line, the value and a remedy, before anything is computed.

use std::path::Path;

use foldmotion_study::{SceneSource, Study};

/// A valid scene, which the tests make invalid.
pub(crate) const GOOD: &str = "\
[profile]
control_points = [[7.0, 0.0], [5.0, 2.0], [2.0, 2.0], [0.0, 0.0]]
length = 3.0
[sheet]
width = 2.0
rows = 3
columns = 2
case = \"E\"
";

pub(crate) fn refusal(text: &str) -> String {
    let source = SceneSource::new(Path::new("scene.toml"), text.to_owned());
    match Study::resolve(&source) {
        Ok(_) => panic!("accepted:\n{text}"),
        Err(error) => {
            assert_eq!(error.status(), 2, "{error}");
            error.to_string()
        }
    }
}

#[test]
fn the_scene_that_the_cases_change_is_valid() {
    let source = SceneSource::new(Path::new("scene.toml"), GOOD.to_owned());
    assert!(Study::resolve(&source).is_ok());
}

/// Each case: a text of the scene, its replacement, and texts that the message must contain.
#[test]
fn every_bad_value_is_refused_by_key_line_and_value() {
    let cases: &[(&str, &str, &[&str])] = &[
        ("width = 2.0", "width = -2.0", &["scene.toml:5", "sheet.width = -2.0", "positive"]),
        ("width = 2.0", "width = 0.0", &["sheet.width = 0.0", "positive"]),
        ("width = 2.0", "width = nan", &["sheet.width = nan", "positive"]),
        ("width = 2.0", "width = \"wide\"", &["scene.toml:5"]),
        ("width = 2.0", "width = 2.1", &["sheet.width = 2.1", "w = h"]),
        ("width = 2.0", "breadth = 2.0", &["scene.toml:5", "breadth"]),
        ("rows = 3", "rows = 0", &["scene.toml:6", "sheet.rows = 0"]),
        ("rows = 3", "rows = -3", &["sheet.rows = -3"]),
        ("rows = 3", "rows = 2.5", &["scene.toml:6"]),
        ("columns = 2", "columns = 99999999999", &["sheet.columns = 99999999999"]),
        ("columns = 2", "", &["sheet.columns", "missing"]),
        ("case = \"E\"", "case = \"X\"", &["scene.toml:8"]),
        ("case = \"E\"", "case = \"T\"", &["sheet.width = 2.0", "w < h"]),
        ("case = \"E\"", "case = \"S\"", &["w > h"]),
        ("case = \"E\"", "case = \"E\"\nlambda = 0.5", &["sheet.lambda = 0.5", "SII"]),
        ("case = \"E\"", "case = \"E\"\noffset = 0.5", &["sheet.offset = 0.5"]),
        ("length = 3.0", "length = -1.0", &["profile.length = -1.0", "positive"]),
        ("length = 3.0", "length = inf", &["profile.length = inf"]),
        ("length = 3.0", "length = 3.0\nmodel = \"shelter\"", &["profile.control_points"]),
        ("length = 3.0", "length = 3.0\nknots = [0.0, 1.0]", &["profile.knots", "needs 8"]),
        ("[2.0, 2.0], ", "", &["profile.control_points", "at least 4"]),
        ("[2.0, 2.0]", "[nan, 2.0]", &["profile.control_points", "finite"]),
        ("[2.0, 2.0]", "[2.0]", &["scene.toml:2"]),
        // A loop: the middle control points change sides.
        ("[5.0, 2.0], [2.0, 2.0]", "[-20.0, 9.0], [27.0, 9.0]", &["crosses itself"]),
        (
            "length = 3.0",
            "length = 3.0\nclosed = \"smooth\"\n[motion]\nframes = 7",
            &["motion.frames = 7", "even"],
        ),
    ];
    for (from, to, words) in cases {
        assert!(GOOD.contains(from), "{from}");
        let message = refusal(&GOOD.replacen(from, to, 1));
        for word in *words {
            assert!(message.contains(word), "{to}: {word:?} is missing in: {message}");
        }
    }
}

#[test]
fn values_of_the_later_tables_are_refused_too() {
    let cases: &[(&str, &[&str])] = &[
        ("[motion]\nframes = 3", &["motion.frames = 3", "even"]),
        ("[motion]\nframes = 0", &["motion.frames = 0"]),
        ("[material]\naxial_stiffness = 0.0", &["material.axial_stiffness = 0.0"]),
        ("[material]\nfold_stiffness = -1.0", &["material.fold_stiffness = -1.0"]),
        ("[material]\ndamping_ratio = nan", &["material.damping_ratio = nan"]),
        (
            "[motion]\nengine = \"dynamic\"\ncontact = true",
            &["motion.contact = true", "quasi-static"],
        ),
        ("[motion]\ncontact = false\ngap = 1e-3", &["motion.gap = 1e-3", "contact is off"]),
        (
            "[[motion.step]]\nstage = \"fold\"\nrows = [5, 9]",
            &["motion.step.0.rows = [5, 9]", "scene.toml:11"],
        ),
        ("[[motion.step]]\nstage = \"fold\"\nrows = [-1]", &["motion.step.0.rows = [-1]"]),
        ("[[motion.step]]\nstage = \"fold\"\nfrom = 0.5\nto = 0.2", &["motion.step.0.to = 0.2"]),
        (
            "[[motion.step]]\nstage = \"fold\"\nto = 2.0",
            &["motion.step.0.to = 2.0", "between 0 and 1"],
        ),
        ("[[motion.step]]\nstage = \"fold\"\ncreases = \"pads\"", &["motion.step.0", "no crease"]),
        (
            "[[motion.step]]\nstage = \"fold\"\n[[motion.step]]\nstage = \"fold\"\nrows = [1]",
            &["motion.step.1", "overlap"],
        ),
        ("[[motion.step]]\nstage = \"refold\"", &["scene.toml:10"]),
        ("[motion]\ngap = 0.0", &["motion.gap = 0.0", "between"]),
        ("[motion]\ngap = 0.5", &["motion.gap = 0.5", "between"]),
        (
            "[motion]\ngap = 1e-3\n[material]\nthickness = 0.001",
            &["motion.gap = 1e-3", "thickness"],
        ),
        ("[material]\nthickness = -1.0", &["material.thickness = -1.0"]),
        ("[material]\npreset = \"steel\"", &["scene.toml"]),
        ("[motion]\nunfold = \"sideways\"", &["scene.toml", "energy"]),
        ("[check]\ntouch_tolerance = 0.0", &["check.touch_tolerance = 0.0"]),
        ("[check]\nstop_at = -1", &["check.stop_at = -1", "no limit"]),
        ("[check]\ntouch_tolerance = 1.0", &["check.touch_tolerance = 1.0"]),
        ("[division]\ntolerance = -1.0", &["division.tolerance = -1.0"]),
        ("[division]\nmax_iterations = 0", &["division.max_iterations = 0"]),
    ];
    refuses_all(cases);
}

/// Each case: a text that is added to the valid scene, and texts that the message must contain.
pub(crate) fn refuses_all(cases: &[(&str, &[&str])]) {
    for (text, words) in cases {
        let message = refusal(&format!("{GOOD}{text}\n"));
        for word in *words {
            assert!(message.contains(word), "{text}: {word:?} is missing in: {message}");
        }
    }
}

#[test]
fn lengths_and_tolerances_beyond_what_can_be_computed_are_refused_with_their_bound() {
    for (from, to, words) in [
        ("width = 2.0", "width = 1e308", ["sheet.width = 1e308", "1e9"]),
        ("width = 2.0", "width = 1e-308", ["sheet.width = 1e-308", "1e-9"]),
        ("length = 3.0", "length = 1e-308", ["profile.length = 1e-308", "1e-9"]),
        ("length = 3.0", "length = 1e300", ["profile.length = 1e300", "1e9"]),
        ("[2.0, 2.0]", "[1e300, 2.0]", ["profile.control_points", "1e100"]),
    ] {
        let message = refusal(&GOOD.replacen(from, to, 1));
        for word in words {
            assert!(message.contains(word), "{to}: {word}: {message}");
        }
        assert!(message.len() < 400, "{message}");
    }
    refuses_all(&[
        ("[record]\nthickened = 1e308", &["record.thickened = 1e308", "1e9"]),
        (
            "[material]\nthickness = 1e308\n[motion]\ncontact = false",
            &["material.thickness = 1e308"],
        ),
        (
            "[check]\ntouch_tolerance = 1e-300",
            &["check.touch_tolerance = 1e-300", "too small", "rounding needs"],
        ),
    ]);
}

#[test]
fn an_unknown_choice_is_refused_with_the_list_of_names() {
    for closed in ["true", "1", "[1]", "\"yes\""] {
        let text = GOOD.replace("length = 3.0", &format!("length = 3.0\nclosed = {closed}"));
        let message = refusal(&text);
        assert!(message.contains("scene.toml:4"), "{message}");
        assert!(message.contains("`corner` or `smooth`"), "{message}");
    }
    refuses_all(&[
        ("[motion]\nengine = 3", &["quasi-static", "dynamic"]),
        ("[record]\noutputs = [\"gif\", true]", &["`true`", "`glb`"]),
        ("[[motion.step]]\nstage = true", &["`unfold` or `fold`"]),
    ]);
}

#[test]
fn a_duplicate_key_is_named() {
    let message = refusal(&GOOD.replace("rows = 3", "rows = 3\nrows = 4"));
    assert!(message.contains("scene.toml:7") && message.contains("`rows`"), "{message}");
}

#[test]
fn a_title_is_a_single_line_without_control_characters() {
    for title in ["a\\u001b[31m", "a\\nb", "a\\u0007"] {
        let message = refusal(&format!("title = \"{title}\"\n{GOOD}"));
        assert!(message.contains("scene.toml:1") && message.contains("control"), "{message}");
        assert!(!message.contains('\u{1b}'), "{message:?}");
    }
}

#[test]
fn with_case_auto_lambda_is_ignored_with_a_note_if_the_case_is_e_or_t() {
    let open = GOOD.replace("case = \"E\"", "case = \"auto\"\nlambda = 0.5\noffset = 0.01");
    let resolve = |columns: i64| {
        let mut source = SceneSource::new(Path::new("scene.toml"), open.clone());
        source.set(&format!("sheet.columns={columns}")).unwrap();
        Study::resolve(&source).unwrap()
    };
    for (columns, case) in [(1, "SII"), (2, "E"), (3, "T")] {
        let study = resolve(columns);
        let units = &study.subject.units().unwrap().units;
        assert_eq!(units.case_name(), case);
        let said = study.notes.join("\n");
        let is_said = said.contains("scene.toml:9") && said.contains("sheet.lambda = 0.5");
        assert_eq!(is_said, case != "SII", "{said}");
        assert_eq!(said.contains("sheet.offset"), case != "SII", "{said}");
    }
}

#[test]
fn lambda_and_offset_out_of_range_are_refused() {
    let sii = GOOD.replace("width = 2.0", "width = 4.0").replace("\"E\"", "\"SII\"");
    assert!(refusal(&sii).contains("sheet.lambda"));
    for lambda in ["0.0", "1.0", "-0.1", "nan"] {
        let message = refusal(&format!("{sii}lambda = {lambda}\n"));
        assert!(message.contains(&format!("sheet.lambda = {lambda}")), "{message}");
    }
    for offset in ["-0.1", "0.75", "nan"] {
        let message = refusal(&format!("{sii}lambda = 0.5\noffset = {offset}\n"));
        assert!(message.contains(&format!("sheet.offset = {offset}")), "{message}");
    }
}

/// In the compact state of case E, all columns are in one plane, so that all layers of a row are pairs.
#[test]
fn a_sheet_with_too_many_layers_to_check_is_refused_before_it_is_folded() {
    let many = GOOD
        .replace("rows = 3", "rows = 200")
        .replace("columns = 2", "columns = 200")
        .replace("width = 2.0\n", "");
    let text = refusal(&many);
    for word in ["sheet.columns = 200", "coincide", "S, SII"] {
        assert!(text.contains(word), "{word:?} is missing in: {text}");
    }
    // This sheet would not fit into memory, so it has to be refused before it is laid out.
    let more = many.replace("columns = 200", "columns = 4000");
    assert!(refusal(&more).contains("coincide"));
    let short = many
        .replace("columns = 200", "columns = 200000")
        .replace("case = \"E\"", "case = \"S\"\nwidth = 300000.0");
    assert!(refusal(&short).contains("200 x 200000 units are more than 1000000"));
}

#[test]
fn a_closed_profile_needs_three_rows() {
    let closed = GOOD
        .replace("length = 3.0", "length = 2.0\nclosed = \"smooth\"")
        .replace("rows = 3", "rows = 2");
    let message = refusal(&closed);
    assert!(message.contains("sheet.rows = 2") && message.contains('3'), "{message}");
}

#[test]
fn a_scene_without_a_profile_or_with_an_unknown_model_is_refused() {
    assert!(refusal("[sheet]\nrows = 3\n").contains("foldmotion models"));
    let message = refusal("[profile]\nmodel = \"shed\"\n");
    assert!(message.contains("shelter") && message.contains("scene.toml:2"), "{message}");
}

#[test]
fn a_missing_file_is_refused_by_name() {
    let error = SceneSource::read(Path::new("no/such/scene.toml")).unwrap_err();
    assert_eq!(error.status(), 2);
    assert!(error.to_string().contains("no/such/scene.toml"));
}

#[test]
fn energy_is_refused_for_profiles_with_too_many_segments() {
    let long = GOOD.replace("rows = 3", "rows = 2001").replace("width = 2.0\n", "");
    let message = refusal(&format!("{long}[motion]\nunfold = \"energy\"\n"));
    for word in ["motion.unfold", "2001", "2000"] {
        assert!(message.contains(word), "{word:?} is missing in: {message}");
    }
}
