//! `foldmotion record`.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use foldmotion_study::scene::{
    CameraChoice, CameraScene, ColourChoice, HoldScene, OutputChoice, OwnCamera, Playback,
    RecordScene, ThickenedScene,
};

use crate::arguments::parse_threads;

/// `foldmotion record`.
#[derive(Debug, Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is a flag of its own")]
pub(crate) struct RecordArguments {
    /// The motion, a FOLD file with frames
    #[arg(required_unless_present = "again")]
    pub(crate) motion: Option<PathBuf>,
    /// The folder of results; out/<file's name> where left out
    #[arg(long)]
    pub(crate) out: Option<PathBuf>,
    /// Make this recorded file again from what it says of its origin: beside it as NAME-again, or into --out; a file made
    /// from a motion looks for it beside itself, else name it as MOTION
    #[arg(long, value_name = "FILE", conflicts_with_all = FLAGS)]
    pub(crate) again: Option<PathBuf>,
    /// What to write, comma-separated: gif, mp4, png, svg, pdf, glb, obj, stl; gif where left out
    #[arg(long, value_delimiter = ',', value_parser = parse_output)]
    pub(crate) outputs: Option<Vec<OutputChoice>>,
    /// Motion times of the states in svg, pdf, obj and stl, such as 0,0.5,1,1.5,2
    #[arg(
        long,
        value_delimiter = ',',
        value_name = "T,…",
        allow_negative_numbers = true
    )]
    pub(crate) at: Option<Vec<f64>>,
    /// Pixels of films and pictures; where left out 960x720 with mp4 or png, else 480x360
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(crate) size: Option<[i64; 2]>,
    /// Film frames a second; where left out 30 with mp4 or png, else 10
    #[arg(long, allow_negative_numbers = true)]
    pub(crate) fps: Option<f64>,
    /// Seconds of the two stages; 3,5 where left out
    #[arg(long, value_name = "A,B", value_parser = parse_numbers::<2>)]
    pub(crate) seconds: Option<[f64; 2]>,
    /// Seconds the deployed, planar and compact states stand still, or one number for all; 0.5 where left out
    #[arg(long, value_name = "S|A,B,C", value_parser = parse_hold, allow_negative_numbers = true)]
    pub(crate) hold: Option<HoldScene>,
    /// How films run; forward where left out
    #[arg(long = "loop", value_name = "HOW", value_enum)]
    pub(crate) playback: Option<Loop>,
    /// iso, front, side, top, turntable, or AZIMUTH,ELEVATION in degrees, or those and TURN; iso where left out
    #[arg(long, value_parser = parse_camera, allow_hyphen_values = true)]
    pub(crate) camera: Option<CameraScene>,
    /// What colours show; paper where left out
    #[arg(long, value_enum)]
    pub(crate) colour: Option<Colour>,
    /// Pictures (png) and figures without background
    #[arg(long)]
    pub(crate) transparent: bool,
    /// Films tell stage and t
    #[arg(long)]
    pub(crate) caption: bool,
    /// Whether films come nearer where the sheet is small; true where left out
    #[arg(long, value_name = "true|false")]
    pub(crate) follow: Option<bool>,
    /// The size of letters in figures, millimetres; 2.4 where left out
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    pub(crate) letters: Option<f64>,
    /// OBJ and STL as solids of this thickness, in the motion's unit
    #[arg(long, value_name = "THICKNESS", allow_negative_numbers = true)]
    pub(crate) thickened: Option<f64>,
    /// Whether figures show the box of the compact state; true where left out
    #[arg(long = "box", value_name = "true|false")]
    pub(crate) bounds: Option<bool>,
    /// Threads to use; all cores where left out
    #[arg(long, value_parser = parse_threads)]
    pub(crate) threads: Option<usize>,
    /// Replace files in the folder of results that this command did not make
    #[arg(long)]
    pub(crate) force: bool,
    /// No progress and no list of files
    #[arg(long)]
    pub(crate) quiet: bool,
}

/// What --again takes from the file.
const FLAGS: [&str; 15] = [
    "outputs",
    "at",
    "size",
    "fps",
    "seconds",
    "hold",
    "playback",
    "camera",
    "colour",
    "transparent",
    "caption",
    "follow",
    "letters",
    "thickened",
    "bounds",
];

/// How films run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Loop {
    /// From the first state to the last
    Forward,
    /// To the last and back, so that a film that repeats has no jump
    BackAndForth,
}

/// What colours show.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Colour {
    /// The two sides of the paper
    Paper,
    /// Greys, for print
    Grey,
    /// The largest strain of a triangle's edges against the crease pattern
    Strain,
    /// The largest bend of a facet
    Bending,
}

impl RecordArguments {
    /// The same as a scene's `[record]`.
    pub(crate) fn scene(&self) -> RecordScene {
        RecordScene {
            outputs: self.outputs.clone(),
            size: self.size,
            fps: self.fps,
            seconds: self.seconds,
            hold: self.hold,
            playback: self.playback.map(|playback| match playback {
                Loop::Forward => Playback::Once,
                Loop::BackAndForth => Playback::BackAndForth,
            }),
            camera: self.camera,
            colour: self.colour.map(|colour| match colour {
                Colour::Paper => ColourChoice::Paper,
                Colour::Grey => ColourChoice::Grey,
                Colour::Strain => ColourChoice::Strain,
                Colour::Bending => ColourChoice::Bending,
            }),
            transparent: self.transparent.then_some(true),
            caption: self.caption.then_some(true),
            at: self.at.clone(),
            thickened: self.thickened.map(ThickenedScene::By),
            follow: self.follow,
            letters: self.letters,
            profile: None,
            bounds: self.bounds,
            dimensions: None,
        }
    }

    /// The folder of results.
    pub(crate) fn folder(&self, motion: &Path) -> PathBuf {
        let stem = motion.file_stem().unwrap_or_default();
        let folder = self.out.clone();
        folder.unwrap_or_else(|| PathBuf::from("out").join(stem))
    }
}

fn parse_output(text: &str) -> Result<OutputChoice, String> {
    let mut all = OutputChoice::ALL.into_iter();
    all.find(|output| output.name() == text)
        .ok_or_else(|| "there is gif, mp4, png, svg, pdf, glb, obj, stl and html".to_owned())
}

fn parse_size(text: &str) -> Result<[i64; 2], String> {
    let sides = text.split_once(['x', 'X', '×']);
    let sides = sides.and_then(|(w, h)| Some([w.trim().parse().ok()?, h.trim().parse().ok()?]));
    sides.ok_or_else(|| "two whole numbers are needed, such as 960x720".to_owned())
}

fn numbers(text: &str) -> Option<Vec<f64>> {
    text.split(',')
        .map(|part| part.trim().parse().ok())
        .collect()
}

fn parse_numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let found = numbers(text).and_then(|numbers| numbers.try_into().ok());
    found.ok_or_else(|| format!("{N} numbers with commas between are needed"))
}

fn parse_hold(text: &str) -> Result<HoldScene, String> {
    match numbers(text).as_deref() {
        Some(&[seconds]) => Ok(HoldScene::Each(seconds)),
        Some(&[deployed, planar, compact]) => Ok(HoldScene::States([deployed, planar, compact])),
        _ => Err("one number of seconds or three with commas between are needed".to_owned()),
    }
}

fn parse_camera(text: &str) -> Result<CameraScene, String> {
    let own = |azimuth, elevation, turn| {
        CameraScene::Own(OwnCamera {
            azimuth,
            elevation,
            turn,
            centre: None,
            width: None,
        })
    };
    let preset = match text {
        "iso" => CameraChoice::Iso,
        "front" => CameraChoice::Front,
        "side" => CameraChoice::Side,
        "top" => CameraChoice::Top,
        "turntable" => CameraChoice::Turntable,
        _ => {
            return match numbers(text).as_deref() {
                Some(&[azimuth, elevation]) => Ok(own(azimuth, elevation, None)),
                Some(&[azimuth, elevation, turn]) => Ok(own(azimuth, elevation, Some(turn))),
                _ => Err(
                    "there is iso, front, side, top, turntable, or AZIMUTH,ELEVATION in degrees"
                        .to_owned(),
                ),
            };
        }
    };
    Ok(CameraScene::Preset(preset))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_flags_become_values_or_are_refused() {
        assert_eq!(parse_size("64x48"), Ok([64, 48]));
        assert!(parse_size("64").is_err() && parse_size("64x4.5").is_err());
        assert_eq!(parse_hold("0.5"), Ok(HoldScene::Each(0.5)));
        assert_eq!(parse_hold("0,1,2"), Ok(HoldScene::States([0.0, 1.0, 2.0])));
        assert!(parse_hold("0,1").is_err());
        assert_eq!(parse_numbers::<2>("3,5"), Ok([3.0, 5.0]));
        let camera = parse_camera("-60, 30").unwrap_or(CameraScene::Preset(CameraChoice::Iso));
        assert!(matches!(camera, CameraScene::Own(own) if own.azimuth == -60.0));
        assert!(parse_camera("below").is_err() && parse_output("film").is_err());
    }
}
