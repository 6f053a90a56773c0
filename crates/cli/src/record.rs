//! `foldmotion record`.

use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use foldmotion_study::scene::fields::{choices, tip};
use foldmotion_study::scene::{
    CameraScene, ColourChoice, HoldScene, OutputChoice, OwnCamera, Playback, RecordScene,
    ThickenedScene, parse_choice,
};

use crate::threads::parse_threads;

/// `foldmotion record`.
#[derive(Debug, Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is a flag of its own")]
pub(crate) struct RecordArguments {
    /// The motion: a FOLD file with frames
    #[arg(required_unless_present = "again")]
    pub(crate) motion: Option<PathBuf>,
    /// Folder for the results. Default: out/ and the name of the file
    #[arg(long)]
    pub(crate) out: Option<PathBuf>,
    /// Reproduce this recorded file from the scene or motion named inside it: next to it as NAME-again, or in --out. If the
    /// motion file has moved, specify it as MOTION
    #[arg(long, value_name = "FILE", conflicts_with_all = FLAGS)]
    pub(crate) again: Option<PathBuf>,
    /// Kinds of files to write, separated by commas: gif, mp4, png, svg, pdf, glb, obj, stl, html, vtk. Default: gif
    #[arg(long, value_delimiter = ',', value_name = "LIST", value_parser = parse_output)]
    pub(crate) outputs: Option<Vec<OutputChoice>>,
    #[arg(
        long,
        help = tip("record.at"),
        value_delimiter = ',',
        value_name = "T,…",
        allow_negative_numbers = true
    )]
    pub(crate) at: Option<Vec<f64>>,
    #[arg(long, help = tip("record.size"), value_name = "WxH", value_parser = parse_size)]
    pub(crate) size: Option<[i64; 2]>,
    #[arg(long, help = tip("record.fps"), allow_negative_numbers = true)]
    pub(crate) fps: Option<f64>,
    #[arg(long, help = tip("record.seconds"), value_name = "A,B", value_parser = parse_numbers::<2>)]
    pub(crate) seconds: Option<[f64; 2]>,
    #[arg(long, help = tip("record.hold"), value_name = "S|A,B,C", value_parser = parse_hold, allow_negative_numbers = true)]
    pub(crate) hold: Option<HoldScene>,
    #[arg(long = "loop", help = tip("record.loop"), value_name = "HOW", value_parser = choice::<Playback>("record.loop", parse_choice))]
    pub(crate) playback: Option<Playback>,
    /// iso, front, side, top, turntable, or AZIMUTH,ELEVATION or AZIMUTH,ELEVATION,TURN in degrees. Default: iso
    #[arg(long, value_parser = parse_camera, allow_hyphen_values = true)]
    pub(crate) camera: Option<CameraScene>,
    #[arg(long, help = tip("record.colour"), value_parser = choice::<ColourChoice>("record.colour", parse_choice))]
    pub(crate) colour: Option<ColourChoice>,
    #[arg(long, help = tip("record.transparent"))]
    pub(crate) transparent: bool,
    #[arg(long, help = tip("record.caption"))]
    pub(crate) caption: bool,
    #[arg(long, help = tip("record.follow"), value_name = "true|false")]
    pub(crate) follow: Option<bool>,
    #[arg(long, help = tip("record.letters"), value_name = "MM", allow_negative_numbers = true)]
    pub(crate) letters: Option<f64>,
    /// OBJ and STL as solids of this thickness, in the motion's unit
    #[arg(long, value_name = "THICKNESS", allow_negative_numbers = true)]
    pub(crate) thickened: Option<f64>,
    #[arg(long = "box", help = tip("record.box"), value_name = "true|false")]
    pub(crate) bounds: Option<bool>,
    /// Number of threads to use. Default: one for each core
    #[arg(long, value_parser = parse_threads)]
    pub(crate) threads: Option<usize>,
    /// Also replace files in the folder that this command did not make
    #[arg(long)]
    pub(crate) force: bool,
    /// Print neither progress nor the list of files
    #[arg(long)]
    pub(crate) quiet: bool,
}

/// The flags that `--again` excludes, because the file has their values.
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

impl RecordArguments {
    /// The flags as a scene's `[record]`.
    pub(crate) fn scene(&self) -> RecordScene {
        RecordScene {
            outputs: self.outputs.clone(),
            size: self.size,
            fps: self.fps,
            seconds: self.seconds,
            hold: self.hold,
            playback: self.playback,
            camera: self.camera,
            colour: self.colour,
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

    /// The output folder.
    pub(crate) fn folder(&self, motion: &Path) -> PathBuf {
        let stem = motion.file_stem().unwrap_or_default();
        let folder = self.out.clone();
        folder.unwrap_or_else(|| PathBuf::from("out").join(stem))
    }
}

/// Parses a choice of the scene key `key`; the help lists the names with their meanings.
fn choice<T: Clone + Send + Sync + 'static>(
    key: &str,
    parse: fn(&str) -> Result<T, String>,
) -> impl TypedValueParser<Value = T> {
    let names = choices(key).into_iter();
    let names = names.map(|(name, meaning)| PossibleValue::new(name).help(meaning));
    PossibleValuesParser::new(names).try_map(move |name| parse(&name))
}

fn parse_output(text: &str) -> Result<OutputChoice, String> {
    let mut all = OutputChoice::ALL.into_iter();
    all.find(|output| output.name() == text)
        .ok_or_else(|| "expected gif, mp4, png, svg, pdf, glb, obj, stl, html or vtk".to_owned())
}

fn parse_size(text: &str) -> Result<[i64; 2], String> {
    let sides = text.split_once(['x', 'X', '×']);
    let sides = sides.and_then(|(w, h)| Some([w.trim().parse().ok()?, h.trim().parse().ok()?]));
    sides.ok_or_else(|| "expected two whole numbers, such as 960x720".to_owned())
}

fn numbers(text: &str) -> Option<Vec<f64>> {
    text.split(',').map(|part| part.trim().parse().ok()).collect()
}

fn parse_numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let found = numbers(text).and_then(|numbers| numbers.try_into().ok());
    found.ok_or_else(|| format!("expected {N} numbers separated by commas"))
}

fn parse_hold(text: &str) -> Result<HoldScene, String> {
    match numbers(text).as_deref() {
        Some(&[seconds]) => Ok(HoldScene::Each(seconds)),
        Some(&[deployed, planar, compact]) => Ok(HoldScene::States([deployed, planar, compact])),
        _ => Err("expected one number of seconds, or three separated by commas".to_owned()),
    }
}

fn parse_camera(text: &str) -> Result<CameraScene, String> {
    let own = |azimuth, elevation, turn| {
        CameraScene::Own(OwnCamera { azimuth, elevation, turn, centre: None, width: None })
    };
    if let Ok(preset) = parse_choice(text) {
        return Ok(CameraScene::Preset(preset));
    }
    match numbers(text).as_deref() {
        Some(&[azimuth, elevation]) => Ok(own(azimuth, elevation, None)),
        Some(&[azimuth, elevation, turn]) => Ok(own(azimuth, elevation, Some(turn))),
        _ => {
            Err("expected iso, front, side, top, turntable, or AZIMUTH,ELEVATION in degrees"
                .to_owned())
        }
    }
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
        let camera = parse_camera("-60, 30").unwrap();
        assert!(matches!(camera, CameraScene::Own(own) if own.azimuth == -60.0));
        assert!(parse_camera("below").is_err() && parse_output("film").is_err());
    }
}
