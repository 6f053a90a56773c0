//! The binary as a user sees it: exit status, stdout, stderr, files.

#![expect(clippy::unwrap_used, reason = "a test fails where something is missing")]

mod common;

use std::io::{BufRead as _, BufReader};
use std::process::{Command, Stdio};

use common::{assert_status, command, foldmotion, text};

fn scene(name: &str) -> String {
    format!("{}/../../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

const SMALL: [&str; 4] = ["--set", "record.size=[64, 48]", "--set", "motion.frames=20"];

#[test]
fn json_prints_exactly_the_report_and_quiet_prints_nothing() {
    let home = tempfile::tempdir().unwrap();
    let unit = scene("one-unit");
    let mut arguments = vec!["run", unit.as_str(), "--json", "--quiet"];
    arguments.extend(SMALL);
    let output = foldmotion(home.path(), &arguments);
    assert_status(&output, 0);
    let report = std::fs::read(home.path().join("out/one-unit/report.json")).unwrap();
    assert_eq!(text(&output.stdout), text(&report));
    assert_eq!(text(&output.stderr), "");
    arguments[2] = "--quiet";
    arguments.remove(3);
    assert_eq!(text(&foldmotion(home.path(), &arguments).stdout), "");
}

#[test]
fn a_run_prints_a_table_and_plain_progress() {
    let home = tempfile::tempdir().unwrap();
    let unit = scene("one-unit");
    let mut arguments = vec!["run", unit.as_str(), "--out", "here"];
    arguments.extend(SMALL);
    let output = foldmotion(home.path(), &arguments);
    let (out, err) = (text(&output.stdout), text(&output.stderr));
    assert!(out.contains("closed form") && out.contains("collisions: free"), "{out}");
    assert!(err.lines().any(|l| l.starts_with("fold ")) && err.contains("record"), "{err}");
    assert!(home.path().join("here/motion.gif").exists());
}

#[test]
fn a_penetration_is_status_1() {
    let home = tempfile::tempdir().unwrap();
    let short = scene("shelter-short-plain");
    let set = [
        "--set",
        "sheet.rows=2",
        "--set",
        "record.outputs=[]",
        "--set",
        "profile.length=2.0",
        "--quiet",
    ];
    let mut arguments = vec!["run", short.as_str()];
    arguments.extend(set);
    let output = foldmotion(home.path(), &arguments);
    assert_status(&output, 1);
}

#[test]
fn bad_input_is_status_2_and_writes_no_files() {
    let home = tempfile::tempdir().unwrap();
    let unit = scene("one-unit");
    for arguments in [
        vec!["run", "missing.toml"],
        vec!["run", unit.as_str(), "--set", "sheet.width=-1"],
        vec!["run", unit.as_str(), "--set", "sheet"],
        vec!["run", unit.as_str(), "--threads", "0"],
        vec!["run"],
        vec!["fly"],
    ] {
        let output = foldmotion(home.path(), &arguments);
        assert_status(&output, 2);
        assert!(!text(&output.stderr).contains("panicked"), "{arguments:?}");
        assert_eq!(std::fs::read_dir(home.path()).unwrap().count(), 0, "{arguments:?}");
    }
}

#[test]
fn an_output_folder_that_cannot_be_written_is_status_3() {
    let home = tempfile::tempdir().unwrap();
    std::fs::write(home.path().join("file"), "mine").unwrap();
    let unit = scene("one-unit");
    let output = foldmotion(home.path(), &["run", unit.as_str(), "--out", "file", "--quiet"]);
    assert_status(&output, 3);
    let error = text(&output.stderr);
    assert!(error.contains("file") && error.contains("--out"), "{error}");
    assert_eq!(std::fs::read_to_string(home.path().join("file")).unwrap(), "mine");
}

#[test]
fn the_scene_of_init_can_be_run_and_an_existing_file_is_kept() {
    let home = tempfile::tempdir().unwrap();
    let first = foldmotion(home.path(), &["init", "mine.toml"]);
    assert_eq!(first.status.code(), Some(0), "{}", text(&first.stderr));
    let written = std::fs::read_to_string(home.path().join("mine.toml")).unwrap();
    let second = foldmotion(home.path(), &["init", "mine.toml"]);
    assert_eq!(second.status.code(), Some(2));
    assert_eq!(std::fs::read_to_string(home.path().join("mine.toml")).unwrap(), written);
    // A penetration is a valid result as well.
    let set =
        ["run", "mine.toml", "--quiet", "--set", "record.outputs=[]", "--set", "motion.frames=20"];
    let run = foldmotion(home.path(), &set);
    assert!(matches!(run.status.code(), Some(0 | 1)), "{}", text(&run.stderr));
}

#[test]
fn models_lists_all_nine_with_rows_columns_and_source() {
    let home = tempfile::tempdir().unwrap();
    let output = foldmotion(home.path(), &["models"]);
    let text = text(&output.stdout);
    let lines: Vec<_> = text.lines().collect();
    assert_eq!(lines.len(), 18);
    for (name, units) in [
        ("shelter", "7 x 5 (E), 7 (T), 3 (S, SII) units, T to SII our choice; drawn"),
        ("chair", "9 x 4 (E), 6 (T), 2 (S, SII) units; drawn"),
        ("airfoil", "26 x 7 (E), 10 (T), 5 (S, SII) units, T to SII our choice; NACA 4415"),
        ("bunny", "100 x 5 (E), 8 (T), 3 (S, SII) units; silhouette of the Stanford"),
    ] {
        let at = lines.iter().position(|l| l.starts_with(&format!("{name} "))).unwrap();
        assert!(lines[at + 1].trim_start().starts_with(units), "{text}");
    }
}

#[test]
fn the_device_is_in_the_report_and_a_gpu_is_refused_for_the_quasi_static_engine() {
    let home = tempfile::tempdir().unwrap();
    let unit = scene("one-unit");
    let mut arguments = vec!["run", unit.as_str(), "--device", "gpu", "--quiet"];
    arguments.extend(SMALL);
    let output = foldmotion(home.path(), &arguments);
    assert_status(&output, 2);
    assert!(text(&output.stderr).contains("--set motion.engine=dynamic"));
    assert!(!home.path().join("out").exists());
    // A small sheet stays on the processor.
    arguments[3] = "auto";
    arguments.extend(["--set", "motion.engine=dynamic", "--json"]);
    let output = foldmotion(home.path(), &arguments);
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report["engine"]["device"], "cpu");
}

#[test]
fn a_crease_pattern_is_run_without_a_scene_whatever_the_case_of_its_extension() {
    let home = tempfile::tempdir().unwrap();
    let stored = format!("{}/../../scenes/imported/pop-up", env!("CARGO_MANIFEST_DIR"));
    for (ending, name) in [("svg", "card.SVG"), ("fold", "own.Fold")] {
        std::fs::copy(format!("{stored}.{ending}"), home.path().join(name)).unwrap();
        let mut arguments = vec!["run", name, "--set", "pattern.fold_percent=50"];
        arguments.extend(SMALL);
        let output = foldmotion(home.path(), &arguments);
        assert_status(&output, 0);
        let out = text(&output.stdout);
        assert!(out.contains("folded by 50 %") && out.contains("mean edge"), "{out}");
        let stem = name.split('.').next().unwrap();
        for file in ["motion.fold", "motion.gif", "motion.csv", "report.json"] {
            let path = home.path().join("out").join(stem).join(file);
            assert!(path.is_file(), "{}", path.display());
        }
    }
    let missing = foldmotion(home.path(), &["run", "gone.svg"]);
    assert_eq!(missing.status.code(), Some(2));
    assert!(text(&missing.stderr).contains("gone.svg"));
    let wrong = foldmotion(home.path(), &["run", "card.SVG", "--set", "pattern.fold_percent=x"]);
    assert_eq!(wrong.status.code(), Some(2));
    let pattern = foldmotion(home.path(), &["pattern", "card.SVG", "--out", "patterns"]);
    assert_status(&pattern, 0);
    assert!(home.path().join("patterns/pattern.svg").is_file());
}

#[cfg(all(feature = "window", unix, not(target_os = "macos")))]
#[test]
fn without_a_display_the_window_says_what_to_install_and_what_works_without() {
    let home = tempfile::tempdir().unwrap();
    let output = command(home.path(), &["view", &scene("one-unit")])
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .output()
        .unwrap();
    let err = text(&output.stderr);
    assert_status(&output, 3);
    assert!(err.contains("xvfb") && err.contains("foldmotion run"), "{err}");
    assert_eq!(text(&output.stdout), "");
}

#[cfg(feature = "window")]
#[test]
fn a_missing_file_is_bad_input_before_a_window_opens() {
    let home = tempfile::tempdir().unwrap();
    let output = foldmotion(home.path(), &["view", "nothing.toml"]);
    let err = text(&output.stderr);
    assert_status(&output, 2);
    assert!(err.contains("nothing.toml"), "{err}");
}

#[test]
fn a_second_run_keeps_the_films_of_the_first_and_files_of_the_user() {
    let home = tempfile::tempdir().unwrap();
    let unit = scene("one-unit");
    let run = |outputs: &str, more: &[&str]| {
        let outputs = format!("record.outputs={outputs}");
        let small = ["--set", "motion.frames=20", "--set", "record.size=[64, 48]"];
        let arguments = ["run", &unit, "--out", "here", "--set", &outputs];
        foldmotion(home.path(), &[&arguments[..], &small, more].concat())
    };
    assert_eq!(run("[\"fold\", \"gif\"]", &[]).status.code(), Some(0));
    let own = home.path().join("here/figure.pdf");
    std::fs::write(&own, "mine").unwrap();
    let second = run("[\"fold\", \"csv\"]", &[]);
    assert_eq!(second.status.code(), Some(0));
    assert!(text(&second.stderr).contains("figure.pdf"), "it is named");
    assert!(home.path().join("here/motion.gif").exists());
    let third = run("[\"pdf\"]", &[]);
    let said = text(&third.stderr);
    assert_eq!(third.status.code(), Some(2), "{said}");
    assert!(said.contains("figure.pdf") && said.contains("--force"), "{said}");
    assert_eq!(std::fs::read_to_string(&own).unwrap(), "mine");
    assert_eq!(run("[\"pdf\"]", &["--force"]).status.code(), Some(0));
    assert!(std::fs::read(&own).unwrap().starts_with(b"%PDF"));
}

#[test]
fn only_regular_files_are_read() {
    let home = tempfile::tempdir().unwrap();
    let pipe = home.path().join("pipe.toml");
    let made = Command::new("mkfifo").arg(&pipe).status().unwrap();
    assert!(made.success());
    let pipe = pipe.to_string_lossy();
    for arguments in [
        &["run", "/dev/zero"][..],
        &["run", "/dev/urandom"],
        &["run", &pipe],
        &["run", "."],
        &["check", "/dev/zero"],
        &["check", "/dev/zero", "--verify", "/dev/zero"],
        &["record", "/dev/zero"],
        &["record", "--again", "/dev/zero"],
        &["pattern", &pipe],
    ] {
        let output = foldmotion(home.path(), arguments);
        let said = text(&output.stderr);
        assert_status(&output, 2);
        assert!(
            said.contains("device or a pipe") || said.contains("folder"),
            "{arguments:?}: {said}"
        );
    }
}

#[test]
fn a_scene_above_the_limit_is_refused_with_its_size() {
    let home = tempfile::tempdir().unwrap();
    let size = (16 << 20) + 5;
    std::fs::write(home.path().join("a.toml"), vec![b'#'; size]).unwrap();
    std::fs::write(home.path().join("a.svg"), vec![b' '; size]).unwrap();
    for name in ["a.toml", "a.svg"] {
        let output = foldmotion(home.path(), &["run", name]);
        let said = text(&output.stderr);
        assert_status(&output, 2);
        assert!(said.contains(&format!("{size} bytes")), "{said}");
    }
}

/// Lines that cross each other so often that the first equilibrium takes minutes.
fn crossing_lines() -> String {
    let line = |[a, b, c, d]: [usize; 4], colour: &str| {
        format!("<line x1=\"{a}\" y1=\"{b}\" x2=\"{c}\" y2=\"{d}\" stroke=\"{colour}\"/>")
    };
    let pair = |k: usize| {
        let colour = match k {
            0 | 150 => "#000",
            _ if k.is_multiple_of(2) => "#f00",
            _ => "#00f",
        };
        let at = 6 * k;
        line([at, 0, at, 900], colour) + &line([0, at, 900, at], colour)
    };
    let lines: Vec<String> = (0..=150).map(pair).collect();
    let head = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1000 1000\">";
    format!("{head}{}</svg>", lines.concat())
}

#[test]
fn an_interrupt_ends_a_run_at_any_point_and_leaves_no_files() {
    let home = tempfile::tempdir().unwrap();
    std::fs::write(home.path().join("lines.svg"), crossing_lines()).unwrap();
    for signal in ["-INT", "-TERM"] {
        let mut run = command(home.path(), &["run", "lines.svg", "--out", "here/lines"]);
        let mut run = run.stderr(Stdio::piped()).spawn().unwrap();
        let lines = BufReader::new(run.stderr.take().unwrap()).lines();
        // The interrupt is sent once the engine works.
        let mut lines = lines.map(Result::unwrap);
        assert!(lines.any(|line| line.starts_with("fold")));
        let killed = Command::new("kill").arg(signal).arg(run.id().to_string()).status();
        assert!(killed.unwrap().success());
        assert_eq!(run.wait().unwrap().code(), Some(3), "{signal}");
        assert!(lines.any(|line| line.contains("interrupted")));
        let left = std::fs::read_dir(home.path().join("here")).unwrap();
        assert_eq!(left.count(), 0, "{signal}");
    }
}

#[test]
fn flags_and_files_that_exclude_each_other_are_named() {
    let home = tempfile::tempdir().unwrap();
    let unit = scene("one-unit");
    let outputs = "record.outputs=[\"fold\", \"obj\"]";
    let arguments = ["run", &unit, "--out", "here", "--set", outputs, "--set", "motion.frames=20"];
    assert_eq!(foldmotion(home.path(), &arguments).status.code(), Some(0));
    let motion = "here/motion.fold";
    let cases: [(&[&str], &[&str], &str); 2] = [
        (
            &["record", motion, "--again", "here/state-1.obj"],
            &["state-1.obj", motion, "omit"],
            "nothing",
        ),
        (&["check", motion, "--tolerance", "nan"], &["--tolerance", "nan", "1e-6"], "frame"),
    ];
    for (arguments, words, other) in cases {
        let output = foldmotion(home.path(), arguments);
        let said = text(&output.stderr);
        assert_status(&output, 2);
        assert!(words.iter().all(|word| said.contains(word)), "{said}");
        assert!(!said.contains(other), "{said}");
    }
}

#[test]
fn no_control_characters_of_a_file_reach_the_terminal() {
    let home = tempfile::tempdir().unwrap();
    let motion = r#"{"file_title": "a\u001b[31mred\u0007", "vertices_coords": [[0, 0], [1, 0], [1, 1], [0, 1]],
"edges_vertices": [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]], "edges_assignment": ["B", "B", "B", "B", "V"],
"faces_vertices": [[0, 1, 2], [0, 2, 3]], "file_frames": [{"frame_parent": 0, "frame_inherit": true},
{"frame_parent": 0, "frame_inherit": true, "vertices_coords": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0.5, 0.5, 0.7]]}]}"#;
    std::fs::write(home.path().join("a.fold"), motion).unwrap();
    let output = foldmotion(home.path(), &["check", "a.fold"]);
    let said = text(&output.stdout);
    assert_status(&output, 0);
    let is_command = |letter: char| letter.is_control() && letter != '\n';
    assert!(said.contains("red") && !said.contains(is_command), "{said:?}");
}
