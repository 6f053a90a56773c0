//! Folds every crease pattern of a folder and prints the table of docs/src/pattern-table.md.
//!
//! `cargo run --release -p foldmotion-study --no-default-features --example pattern_table FOLDER` folds with contact, two
//! files at a time, each with a budget of 60 seconds for the engine. `--seconds S` sets another budget, `--set KEY=VALUE`
//! a value of every scene, such as `--set motion.contact=false`.
//!
//! The exit status is 1 if a file was refused.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "an example that prints its table")]

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use foldmotion_study::report::Outcome;
use foldmotion_study::{Report, SceneSource, Study};

/// Files that are folded at a time.
const WORKERS: usize = 2;
const COLUMNS: [&str; 10] = [
    "file",
    "triangles",
    "outcome",
    "verdict",
    "largest error",
    "mean error",
    "without contact",
    "peak strain",
    "snaps",
    "seconds",
];

/// The options of the command line.
struct Options {
    folder: PathBuf,
    settings: Vec<String>,
}

fn arguments() -> Result<Options, Box<dyn Error>> {
    let (mut folder, mut settings) = (None, Vec::new());
    let mut seconds = "60".to_owned();
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--seconds" => seconds = arguments.next().ok_or("--seconds needs a number")?,
            "--set" => settings.push(arguments.next().ok_or("--set needs KEY=VALUE")?),
            _ => folder = Some(PathBuf::from(argument)),
        }
    }
    settings.push(format!("motion.budget={seconds}"));
    settings.push("record.outputs=[]".to_owned());
    Ok(Options { folder: folder.ok_or("a folder is needed")?, settings })
}

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let options = arguments()?;
    let mut files = Vec::new();
    for entry in std::fs::read_dir(&options.folder)? {
        let path = entry?.path();
        if path.is_file() && path.extension().is_none_or(|extension| extension != "md") {
            files.push(path);
        }
    }
    files.sort();
    let rows: Vec<Mutex<Option<Row>>> = files.iter().map(|_| Mutex::new(None)).collect();
    let next = AtomicUsize::new(0);
    std::thread::scope(|scope| {
        for _ in 0..WORKERS {
            scope.spawn(|| {
                while let Some((file, row)) = {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    files.get(index).zip(rows.get(index))
                } {
                    let folded = Row::of(file, &options.settings);
                    eprintln!("{}", folded.line);
                    if let Ok(mut row) = row.lock() {
                        *row = Some(folded);
                    }
                }
            });
        }
    });
    println!("| {} |", COLUMNS.join(" | "));
    println!("|{}", "---|".repeat(COLUMNS.len()));
    let rows: Vec<Row> =
        rows.into_iter().filter_map(|row| row.into_inner().ok().flatten()).collect();
    for row in &rows {
        println!("{}", row.line);
    }
    let count = |kind: &str| rows.iter().filter(|row| row.kind == kind).count();
    let kinds =
        ["folded", "jammed", "not-converged", "stopped", "collides", "undecided", "refused"];
    let counts = kinds.map(|kind| format!("{} {kind}", count(kind)));
    println!("\n{} files: {}.", rows.len(), counts.join(", "));
    Ok(ExitCode::from(u8::from(count("refused") > 0)))
}

/// A line of the table.
struct Row {
    kind: String,
    line: String,
}

impl Row {
    fn of(file: &Path, settings: &[String]) -> Self {
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        let started = Instant::now();
        match fold(file, settings) {
            Ok(report) => Self::folded(&name, &report, started.elapsed().as_secs_f64()),
            Err(error) => {
                let reason = error.to_string().replace(['|', '\n'], " ");
                let empty = " | ".repeat(COLUMNS.len() - 3);
                Self {
                    kind: "refused".to_owned(),
                    line: format!("| {name} | | refused: {reason} |{empty}|"),
                }
            }
        }
    }

    fn folded(name: &str, report: &Report, seconds: f64) -> Self {
        let peak = report.stages.iter().map(|stage| stage.peak_strain).fold(0.0, f64::max);
        let snaps: usize = report.stages.iter().map(|stage| stage.snaps.len()).sum();
        let angles = &report.fold_angles;
        let without = angles.mean_error_without_contact_deg;
        let cells = [
            name.to_owned(),
            report.pattern.face_count.to_string(),
            report.outcome.headline(),
            report.collision.verdict.to_string(),
            format!("{:.1}°", angles.largest_error_deg),
            format!("{:.1}°", angles.mean_error_deg),
            without.map_or_else(String::new, |error| format!("{error:.1}°")),
            format!("{:.1} %", 100.0 * peak),
            snaps.to_string(),
            format!("{seconds:.1}"),
        ];
        Self { kind: kind(&report.outcome), line: format!("| {} |", cells.join(" | ")) }
    }
}

/// The kind of an outcome as the report has it.
fn kind(outcome: &Outcome) -> String {
    serde_json::to_value(outcome.kind)
        .ok()
        .and_then(|value| value.as_str().map(str::to_owned))
        .unwrap_or_default()
}

fn fold(file: &Path, settings: &[String]) -> Result<Report, Box<dyn Error>> {
    let mut source = SceneSource::read(file)?;
    for setting in settings {
        source.set(setting)?;
    }
    let folder = tempfile::tempdir()?;
    Ok(Study::resolve(&source)?.run(folder.path(), &|_, _| true)?)
}
