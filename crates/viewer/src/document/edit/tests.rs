//! Texts in every style, edited to mean other scenes.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use foldmotion_study::{FIRST_SCENE, Scene, SceneSource};
use proptest::prelude::*;
use toml::{Table, Value};

use super::edited;

fn parsed(text: &str) -> Scene {
    let source = SceneSource::new(Path::new("test.toml"), text.to_owned());
    source.scene().unwrap_or_else(|e| panic!("{e}\n{text}"))
}

fn to(text: &str, new: &Scene) -> String {
    edited(text, &parsed(text), new).unwrap()
}

/// Edits a text by a closure that changes its scene.
fn by(text: &str, change: impl FnOnce(&mut Scene)) -> String {
    let mut scene = parsed(text);
    change(&mut scene);
    let edited = to(text, &scene);
    assert_eq!(parsed(&edited), scene, "{edited}");
    edited
}

/// Keys of a scene with possible values.
const CHOICES: &[(&str, &[&str])] = &[
    ("title", &["\"A\"", "\"quote \\\" and é\"", "\"two words\""]),
    ("pattern.file", &["\"miura.svg\"", "\"../a b.fold\""]),
    ("pattern.unit", &["\"mm\"", "\"unit\""]),
    ("pattern.fold_percent", &["100.0", "-1e-9"]),
    ("pattern.stages", &["true", "false"]),
    ("pattern.fixed", &["[0]", "[]", "[7]"]),
    ("profile.model", &["\"shelter\"", "\"fermat-spiral\""]),
    (
        "profile.control_points",
        &[
            "[]",
            "[[1.0, 0.0]]",
            "[[1.0, 0.0], [0.7, 0.1]]",
            "[[0.0, 0.0], [0.7, 0.1], [0.5, 1e-3]]",
        ],
    ),
    ("profile.knots", &["[]", "[0.0, 0.5, 1.0]", "[0.0, 0.25, 0.5, 1.0]"]),
    ("profile.closed", &["\"corner\"", "\"smooth\""]),
    ("profile.length", &["7.0", "1e300"]),
    ("sheet.width", &["5.0", "4.75"]),
    ("sheet.rows", &["7", "12"]),
    ("sheet.columns", &["3"]),
    ("sheet.case", &["\"E\"", "\"SII\"", "\"plain\""]),
    ("sheet.lambda", &["0.1", "0.7"]),
    ("division.method", &["\"parametric\""]),
    ("division.tolerance", &["1e-14"]),
    ("material.preset", &["\"paper\"", "\"near-rigid\""]),
    ("material.fold_stiffness", &["0.7", "1e-7"]),
    ("motion.engine", &["\"dynamic\""]),
    ("motion.frames", &["240"]),
    ("motion.contact", &["true", "false"]),
    (
        "motion.step",
        &[
            "[{ stage = \"fold\" }]",
            "[{ stage = \"fold\", to = 0.5 }, { stage = \"fold\", creases = \"pads\", from = 0.5 }]",
            "[{ stage = \"unfold\", rows = [0, 3] }, { stage = \"fold\", to = 0.5 }, { stage = \"fold\", creases = \"pads\" }]",
        ],
    ),
    ("check.touch_tolerance", &["1e-6"]),
    ("record.outputs", &["[]", "[\"fold\", \"gif\"]", "[\"gif\", \"mp4\", \"pdf\"]"]),
    ("record.size", &["[960, 720]", "[960, 480]"]),
    ("record.hold", &["0.5", "[0.5, 1.0, 2.0]"]),
    (
        "record.camera",
        &[
            "\"iso\"",
            "{ azimuth = 30.0, elevation = 20.0 }",
            "{ azimuth = 31.0, elevation = 20.0, turn = 9.5 }",
        ],
    ),
    ("record.at", &["[0.0, 1.0]", "[0.0, 0.5, 1.0, 2.0]"]),
    ("record.thickened", &["true", "0.25"]),
];

/// A choice of a value for every key; 0 omits the key.
fn choices() -> impl Strategy<Value = Vec<usize>> {
    let each: Vec<_> = CHOICES.iter().map(|(_, values)| 0..=values.len()).collect();
    each
}

fn table_of(choice: &[usize]) -> Table {
    let mut text = Table::new();
    for (&(key, values), &index) in CHOICES.iter().zip(choice) {
        let needs = key.starts_with("pattern.") && choice[1] == 0;
        if index == 0 || needs {
            continue;
        }
        let value: Table = format!("v = {}", values[index - 1]).parse().unwrap();
        let value = value["v"].clone();
        match key.split_once('.') {
            None => text.insert(key.to_owned(), value),
            Some((group, key)) => {
                let group = text.entry(group).or_insert(Value::Table(Table::new()));
                group.as_table_mut().unwrap().insert(key.to_owned(), value)
            }
        };
    }
    text
}

/// The styles in which a scene can be written.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Style {
    Headers,
    Inline,
    Dotted,
    Windows,
}

const STYLES: [Style; 4] = [Style::Headers, Style::Inline, Style::Dotted, Style::Windows];

fn written(table: &Table, style: Style) -> String {
    let inline = |value: &Value| {
        let mut line = value.to_string();
        line.truncate(line.trim_end().len());
        line
    };
    let headers = || toml::to_string(table).unwrap();
    match style {
        Style::Headers => format!("# head\n\n{}", headers()),
        Style::Windows => format!("\u{feff}{}", headers().replace('\n', "\r\n")),
        Style::Inline => {
            let lines = table.iter().map(|(key, value)| format!("{key} = {}\n", inline(value)));
            lines.collect()
        }
        Style::Dotted => {
            let mut lines = String::new();
            for (key, value) in table {
                match value {
                    Value::Table(inner) => {
                        for (k, v) in inner {
                            writeln!(lines, "{key}.{k} = {} # beside", inline(v)).unwrap();
                        }
                    }
                    other => writeln!(lines, "{key} = {}", inline(other)).unwrap(),
                }
            }
            lines
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_text_of_any_style_edited_to_another_scene_means_that_scene(a in choices(), b in choices()) {
        let b: Scene = table_of(&b).try_into().unwrap();
        for style in STYLES {
            let text = written(&table_of(&a), style);
            let there = to(&text, &b);
            prop_assert_eq!(&parsed(&there), &b, "{}\nbecame\n{}", text, there);
            let back = to(&there, &parsed(&text));
            prop_assert_eq!(parsed(&back), parsed(&text), "{}\nbecame\n{}", there, back);
            prop_assert_eq!(there.starts_with('\u{feff}'), style == Style::Windows);
            if style == Style::Windows {
                prop_assert_eq!(there.matches('\n').count(), there.matches("\r\n").count());
            }
        }
    }

    #[test]
    fn every_scene_file_can_be_edited_to_any_other_scene_and_back(b in choices(), file in any::<prop::sample::Index>()) {
        let files = scene_files();
        let text = std::fs::read_to_string(file.get(&files)).unwrap();
        let b: Scene = table_of(&b).try_into().unwrap();
        let there = to(&text, &b);
        prop_assert_eq!(parsed(&there), b);
        prop_assert_eq!(parsed(&to(&there, &parsed(&text))), parsed(&text));
    }

    #[test]
    fn comments_above_keys_survive_any_edit_and_those_beside_a_value_go_with_it(a in choices(), b in choices()) {
        let (a, b) = (without_tables_that_go(table_of(&a)), without_tables_that_go(table_of(&b)));
        let mut text = String::from("# head\n\n");
        let mut beside = Vec::new();
        for (number, line) in toml::to_string(&a).unwrap().lines().enumerate() {
            if line.is_empty() {
                text += "\n";
                continue;
            }
            writeln!(text, "# above {number}.\n{line}  # beside {number}.").unwrap();
            beside.push((line.split('=').next().unwrap().trim().to_owned(), number));
        }
        let b: Scene = b.try_into().unwrap();
        let there = to(&text, &b);
        prop_assert_eq!(&parsed(&there), &b);
        prop_assert!(there.starts_with("# head\n"), "{}\nbecame\n{}", text, there);
        for (key, number) in beside {
            let above = format!("# above {number}.\n");
            prop_assert!(there.contains(&above), "{}: {}\nbecame\n{}", above, text, there);
            let kept = there.lines().any(|line| line.starts_with(&key) && line.contains(&format!("# beside {number}.")));
            let gone = !there.lines().any(|line| line.starts_with(&format!("{key} =")) || line.starts_with(&format!("{key}]")));
            prop_assert!(kept || gone || key.starts_with('['), "{}: {}\nbecame\n{}", key, text, there);
        }
    }
}

/// A scene without `[pattern]`, steps and `[record.camera]`, because removing these removes their comments.
fn without_tables_that_go(mut table: Table) -> Table {
    table.remove("pattern");
    table.insert("title".to_owned(), Value::from("one line"));
    if let Some(Value::Table(motion)) = table.get_mut("motion") {
        motion.remove("step");
    }
    if let Some(Value::Table(record)) = table.get_mut("record") {
        record.remove("camera");
    }
    table
}

fn scene_files() -> Vec<PathBuf> {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let folders = [scenes.clone(), scenes.join("imported")];
    let entries = folders.iter().flat_map(|folder| std::fs::read_dir(folder).unwrap());
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .collect();
    files.sort();
    assert!(files.len() >= 15, "{files:?}");
    files
}

#[test]
fn no_change_gives_identical_bytes() {
    for path in scene_files() {
        let text = std::fs::read_to_string(path).unwrap();
        assert_eq!(by(&text, |_| {}), text);
    }
    let odd = "title='x'\r\n[sheet]\nrows   =7#seven\n\n\n";
    assert_eq!(by(odd, |_| {}), odd);
}

#[test]
fn a_changed_value_keeps_its_position_and_its_comment() {
    let text = by(FIRST_SCENE, |scene| scene.sheet.rows = Some(9));
    assert_eq!(text, FIRST_SCENE.replace("rows = 7 ", "rows = 9 "));
    let whole = by("[sheet]\nwidth = 5 # W\n", |scene| {
        scene.sheet.width = Some(6.0);
    });
    assert_eq!(whole, "[sheet]\nwidth = 6 # W\n");
    let part = by("[sheet]\nwidth = 5 # W\n", |scene| {
        scene.sheet.width = Some(0.1 + 0.2);
    });
    assert_eq!(part, "[sheet]\nwidth = 0.30000000000000004 # W\n");
}

#[test]
fn a_new_key_is_placed_in_the_order_of_a_scene() {
    let text = by("[sheet]\nwidth = 5.0\n# why\ncase = \"S\"\n", |scene| {
        scene.sheet.rows = Some(3);
        scene.sheet.lambda = Some(0.5);
    });
    assert_eq!(text, "[sheet]\nwidth = 5.0\nrows = 3\n# why\ncase = \"S\"\nlambda = 0.5\n");
}

#[test]
fn a_new_table_is_placed_in_the_order_of_a_scene() {
    let text = by("# head\n\n[profile]\nmodel = \"shelter\"\n\n[record]\nfps = 30\n", |scene| {
        scene.title = Some("T".to_owned());
        scene.sheet.rows = Some(3);
    });
    let wanted = "# head\n\ntitle = \"T\"\n\n[profile]\nmodel = \"shelter\"\n\n[sheet]\nrows = 3\n\n[record]\nfps = 30\n";
    assert_eq!(text, wanted);
    let fresh = by("# only a comment", |scene| scene.sheet.rows = Some(3));
    assert_eq!(fresh, "# only a comment\n\n[sheet]\nrows = 3\n");
}

#[test]
fn a_point_between_others_leaves_their_lines_as_they_are() {
    let text = "[profile]\ncontrol_points = [\n    [0, 0],   # start\n    [2, 0],   # end\n]\n";
    let more = by(text, |scene| {
        scene.profile.control_points.as_mut().unwrap().insert(1, [1.0, 0.5]);
    });
    assert!(more.contains("    [0, 0],") && more.contains("    [2, 0],   # end\n]"), "{more}");
    assert!(more.contains("\n    [1.0, 0.5],"), "{more}");
    let moved = by(text, |scene| {
        scene.profile.control_points.as_mut().unwrap()[1][1] = 0.5;
    });
    assert_eq!(moved, text.replace("[2, 0]", "[2, 0.5]"));
    let line = by("[profile]\npoints = [[0, 0], [1, 1]]\n", |scene| {
        scene.profile.points = Some(vec![[-1.0, 0.0], [0.0, 0.0], [1.0, 1.0]]);
    });
    assert_eq!(line, "[profile]\npoints = [[-1.0, 0.0], [0, 0], [1, 1]]\n");
}

#[test]
fn many_new_points_are_written_one_per_line() {
    let text = by("[profile]\n", |scene| {
        scene.profile.points = Some((0..9).map(|k| [f64::from(k), 0.25]).collect());
    });
    assert!(text.contains("points = [\n    [0.0, 0.25],\n    [1.0, 0.25],"), "{text}");
    assert!(text.ends_with("[8.0, 0.25],\n]\n"), "{text}");
}

#[test]
fn steps_change_one_by_one() {
    let text = "[motion]\nframes = 60\n\n# first\n[[motion.step]]\nstage = \"fold\"\nto = 0.5 # half\n\n# second\n[[motion.step]]\nstage = \"fold\"\nfrom = 0.5\n\n[check]\n";
    let changed = by(text, |scene| scene.motion.step[1].from = Some(0.6));
    assert_eq!(changed, text.replace("from = 0.5", "from = 0.6"));
    let more = by(text, |scene| {
        let step = scene.motion.step[0].clone();
        scene.motion.step.insert(1, step);
    });
    let third = "\n[[motion.step]]\nstage = \"fold\"\nto = 0.5\n";
    assert_eq!(more, text.replace("half\n", &format!("half\n{third}")));
    let fewer = by(text, |scene| drop(scene.motion.step.remove(0)));
    assert!(fewer.contains("# second\n[[motion.step]]") && !fewer.contains("# half"), "{fewer}");
    let none = by(text, |scene| scene.motion.step.clear());
    assert_eq!(none, "[motion]\nframes = 60\n\n[check]\n");
}

#[test]
fn invalid_toml_is_not_edited() {
    let new = parsed("[sheet]\nrows = 3\n");
    assert_eq!(edited("[sheet\n", &Scene::default(), &new), None);
}

#[test]
fn a_text_that_does_not_mean_the_old_scene_never_panics() {
    let old = parsed(&written(&table_of(&vec![1; CHOICES.len()]), Style::Headers));
    let new = parsed(&written(
        &table_of(
            &vec![2; 1]
                .into_iter()
                .chain(CHOICES.iter().skip(1).map(|(_, v)| v.len()))
                .collect::<Vec<_>>(),
        ),
        Style::Headers,
    ));
    for text in [
        "",
        "sheet = 3\n",
        "motion.step = [1]\n[profile]\ncontrol_points = { a = 1 }\n",
        "[[sheet]]\n[[sheet]]\n",
        "[motion]\n[[motion.step]]\n",
    ] {
        assert!(edited(text, &old, &new).is_some(), "{text}");
    }
}
