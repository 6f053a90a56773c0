//! What the user typed.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::pattern::PatternArguments;
use crate::record::RecordArguments;

/// Folds sheets of unfolded-waterbomb units from the deployed shape through the flat sheet into the compact stack,
/// proves whether they cross themselves, and records the motion.
#[derive(Debug, Parser)]
#[command(name = "foldmotion", version, about, max_term_width = 100)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Resolve a scene, fold, check, report, record
    ///
    /// Exit status: 0 done, 1 a penetration was found, 2 bad input, 3 the run failed or stayed undecided.
    Run(RunArguments),
    /// Decide whether any FOLD motion passes through itself, and certify it
    ///
    /// Exit status: 0 free or touching, 1 a penetration was found, 2 bad input, 3 undecided or interrupted. With
    /// --verify: 0 verified, free or touching; 1 verified, penetrating; 2 the certificate is false, or about another
    /// motion, or bad input; 3 not verified or interrupted.
    Check(CheckArguments),
    /// Make films, figures and 3D files of any FOLD motion
    ///
    /// motion.gif, motion.mp4, frames/0001.png on, figure.svg and figure.pdf (states side by side), motion.glb,
    /// state-0.5.obj and state-0.5.stl. Facets that penetrate are marked where a certificate.json of the motion lies
    /// beside it. Other files in the folder stay.
    ///
    /// Exit status: 0 done, 2 bad input, 3 the files could not be written or interrupted.
    Record(RecordArguments),
    /// Rebuild every table and figure of the paper, its numbers beside ours
    ///
    /// Writes figures as SVG and PNG, paper.json and index.html. Parts that are finished are reused.
    ///
    /// Exit status: 0 done, 2 bad input, 3 the run failed or was interrupted; finished parts stay.
    Paper(PaperArguments),
    /// Write the crease pattern for cutting and folding: SVG, DXF and FOLD in millimetres
    ///
    /// Mountain creases are red (#f00), valley creases blue (#00f), the outline to cut black (#000), each on a layer of
    /// its own, creases before the outline, seen from the front. In SVG a crease's opacity is its fold angle over 180
    /// degrees, as Origami Simulator reads it; its dashes are for the eye. DXF is R12, FOLD 1.2. Lengths are those of
    /// the scene in profile.unit (the unit "unit" counts as 1 mm), unless --scale or --width is given.
    ///
    /// Exit status: 0 done, 2 bad input, 3 the files could not be written or interrupted.
    Pattern(PatternArguments),
    /// Open the window: look at a fold, scrub it, change its scene, run it, record it
    ///
    /// Opens a scene, a crease pattern (.fold, .svg) or a motion (.fold with frames); without one, what was last open.
    /// Needs a display and a graphics adapter; Mesa's software Vulkan is enough.
    ///
    /// Exit status: 0 closed, 2 bad input, 3 there is no window.
    View(ViewArguments),
    /// List the built-in profiles
    Models,
    /// Write a commented scene to start from
    Init {
        /// The file to write; an existing one is kept
        #[arg(default_value = "scene.toml")]
        file: PathBuf,
    },
}

/// `foldmotion run`.
#[derive(Debug, Args)]
pub(crate) struct RunArguments {
    /// The scene file, or a crease pattern: .fold, or .svg in Origami Simulator's colours
    pub(crate) scene: PathBuf,
    /// The folder of results; out/<the file's name> where left out
    #[arg(long)]
    pub(crate) out: Option<PathBuf>,
    /// Override a key of the scene, such as sheet.columns=5
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) set: Vec<String>,
    /// How much work the engine may do, in seconds (60) or its own steps (20000steps): the motion then ends where it is,
    /// with exit status 3, and what was reached is kept
    #[arg(long, value_name = "SECONDS|STEPS")]
    pub(crate) budget: Option<String>,
    /// Threads to use; all cores where left out
    #[arg(long, value_parser = parse_threads)]
    pub(crate) threads: Option<usize>,
    /// Where the dynamic engine moves the sheet; auto takes a GPU for large sheets where there is a real one
    #[arg(long, value_enum, default_value_t = DeviceChoice::Cpu)]
    pub(crate) device: DeviceChoice,
    /// Replace files in the folder of results that this command did not make
    #[arg(long)]
    pub(crate) force: bool,
    /// No progress and no table
    #[arg(long)]
    pub(crate) quiet: bool,
    /// Print exactly report.json on stdout
    #[arg(long)]
    pub(crate) json: bool,
}

/// `foldmotion view`.
#[derive(Debug, Args)]
pub(crate) struct ViewArguments {
    /// A scene, a crease pattern or a motion
    pub(crate) file: Option<PathBuf>,
    /// Print times of frames and states, and memory, on stderr when the window is closed
    #[arg(long)]
    pub(crate) timings: bool,
    /// Threads to use; all cores where left out
    #[arg(long, value_parser = parse_threads)]
    pub(crate) threads: Option<usize>,
}

/// Where the dynamic engine runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum DeviceChoice {
    /// The processor
    Cpu,
    /// A GPU, whichever the driver offers
    Gpu,
    /// A real GPU for large sheets, else the processor
    Auto,
}

/// `foldmotion check`.
#[derive(Debug, Args)]
pub(crate) struct CheckArguments {
    /// The motion, a FOLD file with frames
    pub(crate) motion: PathBuf,
    /// The folder of certificate.json; out/<file's name> where left out
    #[arg(long)]
    pub(crate) out: Option<PathBuf>,
    /// Prove the statement of this certificate.json about the motion again by other means; nothing is written
    #[arg(long, value_name = "CERTIFICATE", conflicts_with_all = ["out", "tolerance", "stop_at", "json", "force"])]
    pub(crate) verify: Option<PathBuf>,
    /// Overlaps up to this are touching, in the file's foldmotion:unitLength or mean sides of a face; 1e-6 where left
    /// out
    #[arg(long, value_name = "X", value_parser = parse_tolerance, allow_negative_numbers = true)]
    pub(crate) tolerance: Option<f64>,
    /// End the check at the next frame once more than N pairs of triangles penetrate; 0: no limit; default: 4096
    #[arg(long, value_name = "N")]
    pub(crate) stop_at: Option<usize>,
    /// Threads to use; all cores where left out
    #[arg(long, value_parser = parse_threads)]
    pub(crate) threads: Option<usize>,
    /// Replace files in the folder of results that this command did not make
    #[arg(long)]
    pub(crate) force: bool,
    /// No progress and no table
    #[arg(long)]
    pub(crate) quiet: bool,
    /// Print exactly certificate.json on stdout
    #[arg(long)]
    pub(crate) json: bool,
}

/// `foldmotion paper`.
#[derive(Debug, Args)]
pub(crate) struct PaperArguments {
    /// The folder of results
    #[arg(long, default_value = "out/paper")]
    pub(crate) out: PathBuf,
    /// Only these parts, such as table1,fig6,figA1: table1, table2, fig1 to fig10, unfoldings, cases, certificates, figA1
    #[arg(long, value_name = "PARTS")]
    pub(crate) only: Option<String>,
    /// Threads to use; all cores where left out
    #[arg(long, value_parser = parse_threads)]
    pub(crate) threads: Option<usize>,
    /// Replace files in the folder of results that this command did not make
    #[arg(long)]
    pub(crate) force: bool,
    /// No progress and no summary
    #[arg(long)]
    pub(crate) quiet: bool,
    /// Print exactly paper.json on stdout
    #[arg(long)]
    pub(crate) json: bool,
}

fn parse_tolerance(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(tolerance) if tolerance > 0.0 && tolerance < 0.1 => Ok(tolerance),
        _ => Err("a number above 0 and below 0.1 is needed, such as 1e-6".to_owned()),
    }
}

pub(crate) fn parse_threads(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(threads @ 1..=1024) => Ok(threads),
        _ => Err("a number between 1 and 1024 is needed".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory as _;

    #[test]
    fn the_command_line_is_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn no_threads_are_refused() {
        assert!(
            Arguments::try_parse_from(["foldmotion", "run", "a.toml", "--threads", "0"]).is_err()
        );
        assert!(
            Arguments::try_parse_from(["foldmotion", "run", "a.toml", "--threads", "2"]).is_ok()
        );
    }
}
