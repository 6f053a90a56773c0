//! The command line: arguments in, exit status and messages out.
//!
//! ```text
//! foldmotion init scene.toml
//! foldmotion run scene.toml
//! foldmotion check out/scene/motion.fold --verify out/scene/certificate.json
//! ```

mod arguments;
mod init;
mod interrupt;
mod pattern;
mod progress;
mod record;
mod threads;

use std::ffi::OsString;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use arguments::{
    Arguments, CheckArguments, Command, DeviceChoice, PaperArguments, RunArguments, ViewArguments,
};
use clap::Parser as _;
use foldmotion_paper::{PaperError, PaperPart, paper};
use foldmotion_study::scene::EngineChoice;
use foldmotion_study::{
    CheckOptions, Destination, Device, PatternStudy, Phase, Published, SceneSource, Study,
    check_file, models, record_file, reproduce_file, verify_file,
};
use pattern::PatternArguments;
use progress::Reporter;
use record::RecordArguments;

/// The exit status for bad input or usage.
const BAD_INPUT: u8 = 2;
/// The exit status of a run that failed.
const FAILED: u8 = 3;

/// Why a command ends: a message for the user and the exit status.
struct Failure {
    message: String,
    status: u8,
}

impl<E: Into<PaperError>> From<E> for Failure {
    fn from(error: E) -> Self {
        let error = error.into();
        Self { message: error.to_string(), status: error.status() }
    }
}

/// Runs the command line `arguments`, of which the first is the name of the program; returns the exit status.
///
/// The first command of a process sets its number of threads and watches for Ctrl-C, which ends the process.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(help_or_error) => {
            // If even stderr is closed, nothing can be reported.
            let _ = help_or_error.print();
            return u8::try_from(help_or_error.exit_code()).unwrap_or(BAD_INPUT);
        }
    };
    let outcome = match arguments.command {
        Command::Run(run) => run_scene(&run),
        Command::Check(check) => check_motion(&check),
        Command::Record(record) => record_motion(&record),
        Command::Paper(paper) => rebuild_paper(&paper),
        Command::Pattern(pattern) => write_pattern(&pattern),
        Command::View(view) => open_window(&view),
        Command::Models => list_models(),
        Command::Init { file } => init::write_scene(&file).map(|()| 0),
    };
    match outcome {
        Ok(status) => status,
        Err(failure) => {
            warn(&failure.message);
            failure.status
        }
    }
}

fn run_scene(arguments: &RunArguments) -> Result<u8, Failure> {
    use_threads(arguments.threads)?;
    interrupt::watch()?;
    let (mut source, folder) =
        scene_and_folder(&arguments.scene, &arguments.set, arguments.out.as_ref())?;
    if let Some(budget) = &arguments.budget {
        source.set_by_flag("budget", "motion.budget", budget);
    }
    let reporter = Reporter::new(arguments.quiet);
    reporter.report(Phase::Read.name(), 0.0);
    let mut study = Study::resolve(&source)?;
    study.device = device(arguments.device, &study)?;
    if !arguments.quiet {
        for note in &study.notes {
            warn(note);
        }
    }
    let destination = Destination::from(&folder).replacing(arguments.force);
    let report = study.run(destination, &reporter.progress())?;
    reporter.finish();
    print_published(&report.published, arguments.quiet);
    if arguments.json {
        print(&report.to_json())?;
    } else if !arguments.quiet {
        print(&report.table())?;
        let headline = report.outcome.headline();
        print(&format!("results in {}\n{headline}\n", folder.display()))?;
    }
    Ok(explained(report.status(), &report.outcome.line()))
}

/// Explains on stderr an exit status that is not 0, also with `--quiet`; returns the status.
fn explained(status: u8, line: &str) -> u8 {
    if status != 0 {
        warn(line);
    }
    status
}

/// The device of `--device`.
///
/// # Errors
/// The engine of the study does not use a GPU.
fn device(choice: DeviceChoice, study: &Study) -> Result<Device, Failure> {
    match choice {
        DeviceChoice::Cpu => Ok(Device::Cpu),
        DeviceChoice::Auto => Ok(Device::Auto),
        DeviceChoice::Gpu if study.engine == EngineChoice::Dynamic => Ok(Device::Gpu),
        DeviceChoice::Gpu => Err(Failure {
            message: "--device gpu: the quasi-static engine runs on the processor; add --set motion.engine=dynamic, or omit --device"
                .to_owned(),
            status: 2,
        }),
    }
}

/// The scene with the values of `--set`, and the folder of its results.
fn scene_and_folder(
    scene: &Path,
    set: &[String],
    out: Option<&PathBuf>,
) -> Result<(SceneSource, PathBuf), Failure> {
    let mut source = SceneSource::read(scene)?;
    for assignment in set {
        source.set(assignment)?;
    }
    let folder = out.cloned().unwrap_or_else(|| PathBuf::from("out").join(source.stem()));
    Ok((source, folder))
}

fn check_motion(arguments: &CheckArguments) -> Result<u8, Failure> {
    use_threads(arguments.threads)?;
    interrupt::watch()?;
    if let Some(certificate) = &arguments.verify {
        return verify_certificate(arguments, certificate);
    }
    let stem = arguments.motion.file_stem().unwrap_or_default();
    let folder = arguments.out.clone().unwrap_or_else(|| PathBuf::from("out").join(stem));
    let mut options = CheckOptions::default();
    if let Some(tolerance) = arguments.tolerance {
        options.tolerance = tolerance;
    }
    if let Some(stop_at) = arguments.stop_at {
        options.stop_at = stop_at;
    }
    let reporter = Reporter::new(arguments.quiet);
    let checked = check_file(&arguments.motion, &options, &reporter.progress())?;
    let certificate = &checked.certificate;
    reporter.finish();
    // The verdict is printed even if the certificate cannot be written.
    if arguments.json {
        print(&certificate.to_json())?;
    } else if !arguments.quiet {
        print(&checked.table())?;
    }
    certificate.write(Destination::from(&folder).replacing(arguments.force))?;
    if !arguments.json && !arguments.quiet {
        let verdict = &certificate.verdict;
        print(&format!("certificate in {}\n{verdict}\n", folder.display()))?;
    }
    Ok(explained(certificate.status(), &certificate.line()))
}

fn verify_certificate(arguments: &CheckArguments, certificate: &Path) -> Result<u8, Failure> {
    let reporter = Reporter::new(arguments.quiet);
    let verified = verify_file(&arguments.motion, certificate, &reporter.progress())?;
    reporter.finish();
    if !arguments.quiet {
        print(&verified.table())?;
    }
    Ok(explained(verified.status(), &verified.line()))
}

fn record_motion(arguments: &RecordArguments) -> Result<u8, Failure> {
    use_threads(arguments.threads)?;
    interrupt::watch()?;
    let reporter = Reporter::new(arguments.quiet);
    let progress = reporter.progress();
    let (out, motion) = (arguments.out.as_deref(), arguments.motion.as_deref());
    if let Some(file) = &arguments.again {
        let copy = reproduce_file(file, motion, out, arguments.force, &progress)?;
        reporter.finish();
        for warning in &copy.warnings {
            warn(&format!("warning: {warning}"));
        }
        if !arguments.quiet {
            let same = if copy.is_same { "identical to" } else { "different from" };
            print(&format!("{}: {same} the file it reproduces\n", copy.path.display()))?;
        }
        return Ok(0);
    }
    // Without --again the argument is required.
    let motion = motion.unwrap_or(Path::new(""));
    let folder = arguments.folder(motion);
    let destination = Destination::from(&folder).replacing(arguments.force);
    let record = record_file(motion, &arguments.scene(), destination, &progress)?;
    reporter.finish();
    print_published(&record.published, arguments.quiet);
    if !arguments.quiet {
        let marks = match (record.is_checked, record.penetrates) {
            (true, true) => "penetrations are marked",
            (true, false) => "its certificate has no penetration to mark",
            _ => {
                "penetrations are not marked: there is no certificate.json of this motion next to it"
            }
        };
        let files = match record.files.len() {
            1 => "1 file".to_owned(),
            count => format!("{count} files"),
        };
        print(&format!("{files} in {}; {marks}\n", folder.display()))?;
    }
    Ok(0)
}

fn rebuild_paper(arguments: &PaperArguments) -> Result<u8, Failure> {
    use_threads(arguments.threads)?;
    interrupt::watch()?;
    let parts = match &arguments.only {
        Some(list) => PaperPart::parse_list(list)?,
        None => PaperPart::ALL.to_vec(),
    };
    let reporter = Reporter::new(arguments.quiet);
    let destination = Destination::from(&arguments.out).replacing(arguments.force);
    let run = paper(destination, &parts, &|part, done| {
        reporter.report(part.name(), done);
        interrupt::should_continue()
    })?;
    reporter.finish();
    if arguments.json {
        print(&run.record.to_json())?;
    } else if !arguments.quiet {
        let (computed, reused) = (run.computed, run.reused);
        let page = arguments.out.join("index.html");
        let page = page.display();
        print(&format!("{computed} parts computed, {reused} reused\nresults in {page}\n"))?;
    }
    Ok(0)
}

fn write_pattern(arguments: &PatternArguments) -> Result<u8, Failure> {
    interrupt::watch()?;
    let (source, folder) =
        scene_and_folder(&arguments.scene, &arguments.set, arguments.out.as_ref())?;
    let destination = Destination::from(&folder).replacing(arguments.force);
    let study = PatternStudy::resolve(&source);
    if study.is_err()
        && let Some(figure) = PatternStudy::write_clashes(&source, destination)?
        && !arguments.quiet
    {
        print(&format!("the rows are drawn in {}\n", figure.display()))?;
    }
    let summary =
        study?.write(destination, &arguments.options(), &|_, _| interrupt::should_continue())?;
    if !arguments.quiet {
        print(&summary)?;
        print(&format!("pattern in {}\n", folder.display()))?;
    }
    Ok(0)
}

#[cfg(feature = "window")]
fn open_window(arguments: &ViewArguments) -> Result<u8, Failure> {
    use foldmotion_viewer::{ViewOptions, view};
    use_threads(arguments.threads)?;
    // A missing file is reported here, not in a window that may not open.
    if let Some(file) = &arguments.file {
        foldmotion_study::require_file(file)?;
    }
    let options = ViewOptions {
        file: arguments.file.clone(),
        timings: arguments.timings,
        ..ViewOptions::default()
    };
    view(options)
        .map(|()| 0)
        .map_err(|error| Failure { message: error.to_string(), status: FAILED })
}

#[cfg(not(feature = "window"))]
fn open_window(arguments: &ViewArguments) -> Result<u8, Failure> {
    if let Some(file) = &arguments.file {
        foldmotion_study::require_file(file)?;
    }
    Err(Failure {
        message: "this program was built without the window; build it with --features window, or use `foldmotion run`"
            .to_owned(),
        status: FAILED,
    })
}

fn list_models() -> Result<u8, Failure> {
    for model in models() {
        let columns = model.columns;
        print(&format!(
            "{:<14} {}, {}\n{:15}{} x {} (E), {} (T), {} (S, SII) units{}; {}\n",
            model.name,
            model.title,
            if model.is_closed() { "closed" } else { "open" },
            "",
            model.rows,
            columns.e,
            columns.t,
            columns.s,
            if columns.ours { ", T to SII our choice" } else { "" },
            model.source
        ))?;
    }
    Ok(0)
}

fn use_threads(threads: Option<usize>) -> Result<(), Failure> {
    let Some(threads) = threads else {
        return Ok(());
    };
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build_global()
        .map_err(|e| Failure { message: format!("--threads {threads}: {e}"), status: FAILED })
}

/// Prints what happened to other files in the folder of results.
fn print_published(published: &Published, quiet: bool) {
    if !quiet {
        published.words().iter().for_each(|line| warn(line));
    }
}

/// Prints a line on stderr.
fn warn(line: &str) {
    // If even stderr is closed, nothing can be reported.
    let _ = writeln!(std::io::stderr(), "foldmotion: {}", sanitized(line));
}

/// A text without control characters, which a terminal would obey: names and titles come from files.
fn sanitized(text: &str) -> String {
    let is_control = |letter: char| letter.is_control() && letter != '\n' && letter != '\t';
    text.replace(is_control, "\u{fffd}")
}

/// Prints to stdout. A reader that has closed the pipe (`| head`) is not an error.
fn print(text: &str) -> Result<(), Failure> {
    match std::io::stdout().write_all(sanitized(text).as_bytes()) {
        Err(e) if e.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Failure { message: format!("stdout: {e}"), status: FAILED })
        }
        _ => Ok(()),
    }
}
