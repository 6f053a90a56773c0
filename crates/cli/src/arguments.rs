//! The arguments of all commands.

use std::path::PathBuf;

use crate::threads::parse_threads;
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
    /// Fold the sheet of a scene, check it for collisions, report and record the motion
    ///
    /// Exit status: 0 folded; 1 the sheet passes through itself; 2 bad input; 3 the sheet did not fold to its end, or the
    /// collision check stayed undecided, or the run failed or was interrupted.
    Run(RunArguments),
    /// Decide whether the motion in a FOLD file passes through itself, and write a certificate
    ///
    /// Exit status: 0 free or touching, 1 a penetration was found, 2 bad input, 3 undecided or interrupted. With
    /// --verify: 0 verified, free or touching; 1 verified, penetrating; 2 the certificate is false, or about another
    /// motion, or bad input; 3 not verified or interrupted.
    Check(CheckArguments),
    /// Make films, figures and 3D files of the motion in a FOLD file
    ///
    /// Writes motion.gif, motion.mp4, frames/0001.png and so on, figure.svg and figure.pdf (states side by side),
    /// motion.glb, state-0.5.obj, state-0.5.stl, and motion.pvd with vtk/0001.vtp and so on. If the folder of the motion holds its certificate.json, the first
    /// penetration is marked. Other files in the folder are kept.
    ///
    /// Exit status: 0 done, 2 bad input, 3 the files could not be written or interrupted.
    Record(RecordArguments),
    /// Reproduce every table and figure of the paper and compare its numbers with ours
    ///
    /// Writes figures as SVG and PNG, paper.json and index.html. Finished parts are reused by the next run.
    ///
    /// Exit status: 0 done; 2 bad input; 3 the run failed or was interrupted (finished parts are kept).
    Paper(PaperArguments),
    /// Write the crease pattern for cutting and folding: SVG, DXF and FOLD in millimetres
    ///
    /// Mountain creases are red (#f00), valley creases blue (#00f), the outline to cut black (#000), each on a layer of
    /// its own, creases before the outline, seen from the front. In SVG the opacity of a crease is its fold angle divided by
    /// 180 degrees, as Origami Simulator reads it; the dashes only help the reader. DXF is R12, FOLD 1.2. Lengths are those of
    /// the scene in profile.unit (the unit "unit" counts as 1 mm), unless --scale or --width is given.
    ///
    /// Exit status: 0 done, 2 bad input, 3 the files could not be written or interrupted.
    Pattern(PatternArguments),
    /// Open the window: view a motion, edit its scene, run it and record it
    ///
    /// Opens a scene, a crease pattern (.fold, .svg and others) or a motion (.fold with frames); without a file,
    /// whatever was open last.
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
    /// The scene file, or a crease pattern: .fold, .svg, .cp, .opx, .orh, .obj or .dxf
    pub(crate) scene: PathBuf,
    /// Folder for the results. Default: out/ and the name of the file
    #[arg(long)]
    pub(crate) out: Option<PathBuf>,
    /// Override a key of the scene, such as sheet.columns=5
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) set: Vec<String>,
    /// How much work the engine may do, in seconds (60) or in its own steps (20000steps). The motion then ends at the state
    /// reached, with exit status 3
    #[arg(long, value_name = "SECONDS|STEPS")]
    pub(crate) budget: Option<String>,
    /// Number of threads to use. Default: one for each core
    #[arg(long, value_parser = parse_threads)]
    pub(crate) threads: Option<usize>,
    /// The device that runs the dynamic engine
    #[arg(long, value_enum, default_value_t = DeviceChoice::Cpu)]
    pub(crate) device: DeviceChoice,
    /// Also replace files in the folder that this command did not make
    #[arg(long)]
    pub(crate) force: bool,
    /// Print neither progress nor the table
    #[arg(long)]
    pub(crate) quiet: bool,
    /// Print report.json, and nothing else, on stdout
    #[arg(long)]
    pub(crate) json: bool,
}

/// `foldmotion view`.
#[derive(Debug, Args)]
pub(crate) struct ViewArguments {
    /// A scene, a crease pattern or a motion
    pub(crate) file: Option<PathBuf>,
    /// When the window closes, print frame times, state times and memory use on stderr
    #[arg(long)]
    pub(crate) timings: bool,
    /// Number of threads to use. Default: one for each core
    #[arg(long, value_parser = parse_threads)]
    pub(crate) threads: Option<usize>,
}

/// Where the dynamic engine runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum DeviceChoice {
    /// The processor
    Cpu,
    /// A GPU: whichever the driver offers
    Gpu,
    /// A hardware GPU for large sheets if there is one, otherwise the processor
    Auto,
}

/// `foldmotion check`.
#[derive(Debug, Args)]
pub(crate) struct CheckArguments {
    /// The motion: a FOLD file with frames
    pub(crate) motion: PathBuf,
    /// Folder for certificate.json. Default: out/ and the name of the file
    #[arg(long)]
    pub(crate) out: Option<PathBuf>,
    /// Prove the statement of this certificate.json again by a second method; writes nothing
    #[arg(long, value_name = "CERTIFICATE", conflicts_with_all = ["out", "tolerance", "stop_at", "json", "force"])]
    pub(crate) verify: Option<PathBuf>,
    /// Facets that overlap by no more than this touch, in units of the file's foldmotion:unitLength or, if it has none, of
    /// the mean side of its faces. Default: 1e-6
    #[arg(long, value_name = "X", value_parser = parse_tolerance, allow_negative_numbers = true)]
    pub(crate) tolerance: Option<f64>,
    /// Stop the check at the next frame once more than N pairs of triangles penetrate; 0 means no limit. Default: 4096
    #[arg(long, value_name = "N")]
    pub(crate) stop_at: Option<usize>,
    /// Number of threads to use. Default: one for each core
    #[arg(long, value_parser = parse_threads)]
    pub(crate) threads: Option<usize>,
    /// Also replace files in the folder that this command did not make
    #[arg(long)]
    pub(crate) force: bool,
    /// Print neither progress nor the table
    #[arg(long)]
    pub(crate) quiet: bool,
    /// Print certificate.json, and nothing else, on stdout
    #[arg(long)]
    pub(crate) json: bool,
}

/// `foldmotion paper`.
#[derive(Debug, Args)]
pub(crate) struct PaperArguments {
    /// Folder for the results
    #[arg(long, default_value = "out/paper")]
    pub(crate) out: PathBuf,
    /// Only these parts, for example table1,fig6. All parts: table1, table2, fig1 to fig10, unfoldings, cases, certificates, figA1
    #[arg(long, value_name = "PARTS")]
    pub(crate) only: Option<String>,
    /// Number of threads to use. Default: one for each core
    #[arg(long, value_parser = parse_threads)]
    pub(crate) threads: Option<usize>,
    /// Also replace files in the folder that this command did not make
    #[arg(long)]
    pub(crate) force: bool,
    /// Print neither progress nor the summary
    #[arg(long)]
    pub(crate) quiet: bool,
    /// Print paper.json, and nothing else, on stdout
    #[arg(long)]
    pub(crate) json: bool,
}

fn parse_tolerance(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(tolerance) if tolerance > 0.0 && tolerance < 0.1 => Ok(tolerance),
        _ => Err("expected a number above 0 and below 0.1, such as 1e-6".to_owned()),
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
