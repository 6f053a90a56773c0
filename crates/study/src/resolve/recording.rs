//! `[record]`, resolved.

use std::ops::RangeInclusive;

use foldmotion_geometry::Number;
use foldmotion_record::{FilmOptions, Mp4, RecordError, Style, View};
use glam::DVec3;

use super::input::Input;
use crate::scene::{
    CameraChoice, CameraScene, ColourChoice, HoldScene, OutputChoice, ThickenedScene,
};
use crate::{Scene, StudyError};

/// The default motion times of figures and models.
pub(crate) const STATES: [f64; 5] = [0.0, 0.5, 1.0, 1.5, 2.0];

/// `[record]`, resolved.
#[derive(Debug, Clone)]
pub struct Recording {
    /// The outputs in order, each once.
    pub outputs: Vec<OutputChoice>,
    /// The options of films.
    pub film: FilmOptions,
    /// The motion times of figures and models in rising order; `None` for the default ones.
    pub at: Option<Vec<f64>>,
    /// The quantity that colours show.
    pub colour: ColourChoice,
    /// The thickness of solids in the motion's unit; `None` for surfaces.
    pub thickness: Option<f64>,
    /// Whether figures show the profile.
    pub has_profile: bool,
    /// Whether figures show the compact box.
    pub has_box: bool,
    /// Whether figures give the sizes of the sheet of units.
    pub has_dimensions: bool,
    /// The size of letters in figures, in millimetres.
    pub letters: f64,
    /// The scene with its title, for the source information of recorded files.
    pub(crate) scene: Scene,
}

impl Recording {
    pub(crate) fn has(&self, output: OutputChoice) -> bool {
        self.outputs.contains(&output)
    }
}

/// The largest number of states in a figure.
const MOST_STATES: usize = 100;

/// The colour of creases over colours that show values: a grey between the lightest and the darkest of them.
const NEUTRAL: [u8; 3] = [176, 176, 180];

/// The limits of the width of a picture and of the coordinates of its centre, in the motion's unit.
const NARROWEST: f64 = 1e-9;
const FARTHEST: f64 = 1e9;

/// The default size of letters in figures, that of captions in print, and its limits, in millimetres.
const LETTERS: f64 = 2.4;
const SIZES: RangeInclusive<f64> = 0.5..=20.0;

/// The turn of a turntable, in degrees.
const TURN: f64 = 360.0;

/// The colours and lines of pictures and figures. Over colours that show values, all creases are grey.
fn style(colour: ColourChoice) -> Style {
    match colour {
        ColourChoice::Paper => Style::default(),
        ColourChoice::Grey => Style::grey(),
        ColourChoice::Strain | ColourChoice::Bending => {
            Style { mountain: NEUTRAL, valley: NEUTRAL, line_width: 0.9, ..Style::default() }
        }
    }
}

/// Resolves the recording of a scene.
pub(crate) fn recording(input: &Input<'_>, title: String) -> Result<Recording, StudyError> {
    let record = &input.scene.record;
    let mut scene = input.scene.clone();
    scene.title = Some(title);
    let film = film(input)?;
    Ok(Recording {
        outputs: outputs(input, &film)?,
        film,
        at: states(input)?,
        colour: record.colour.unwrap_or(ColourChoice::Paper),
        thickness: thickness(input)?,
        has_profile: record.profile.unwrap_or(false),
        has_box: record.bounds.unwrap_or(true),
        has_dimensions: record.dimensions.unwrap_or(true),
        letters: letters(input)?,
        scene,
    })
}

fn outputs(input: &Input<'_>, film: &FilmOptions) -> Result<Vec<OutputChoice>, StudyError> {
    let mut outputs = input
        .scene
        .record
        .outputs
        .clone()
        .unwrap_or_else(|| vec![OutputChoice::Fold, OutputChoice::Gif, OutputChoice::Csv]);
    outputs.sort_unstable();
    outputs.dedup();
    if outputs.contains(&OutputChoice::Mp4) {
        if cfg!(not(feature = "mp4")) {
            let message = "mp4: this program was built without MP4; build it with --features mp4, which requires a C++ \
                           compiler, or use gif";
            return Err(input.error("record.outputs", message));
        }
        Mp4::<Vec<u8>>::check_size(film.size)
            .map_err(|e| input.error("record.size", format!("mp4: {e}")))?;
    }
    Ok(outputs)
}

fn film(input: &Input<'_>) -> Result<FilmOptions, StudyError> {
    let scene = &input.scene.record;
    let standard = FilmOptions::default();
    let (standard_size, fps) = scene.standard_film();
    let (view, turn) = camera(input)?;
    let (centre, width) = aim(input)?;
    let film = FilmOptions {
        size: size(input, standard_size)?,
        fps: scene.fps.unwrap_or(fps),
        seconds: scene.seconds.unwrap_or(standard.seconds),
        hold: match scene.hold {
            None => standard.hold,
            Some(HoldScene::Each(seconds)) => [seconds; 3],
            Some(HoldScene::States(seconds)) => seconds,
        },
        playback: scene.playback.unwrap_or_default(),
        view,
        turn,
        centre,
        width,
        is_following: scene.follow.unwrap_or(standard.is_following),
        has_caption: scene.caption.unwrap_or(false),
        is_transparent: scene.transparent.unwrap_or(false),
        style: style(scene.colour.unwrap_or(ColourChoice::Paper)),
        ..standard
    };
    film.check().map_err(|e| {
        let key = match e {
            RecordError::FramesPerSecond { .. } => "record.fps",
            RecordError::Seconds { name: "hold", .. } => "record.hold",
            RecordError::Seconds { .. } => "record.seconds",
            RecordError::Turn { .. } => "record.camera",
            _ => "record.size",
        };
        input.error(key, e.to_string())
    })?;
    Ok(film)
}

fn size(input: &Input<'_>, standard: [u32; 2]) -> Result<[u32; 2], StudyError> {
    let Some([width, height]) = input.scene.record.size else {
        return Ok(standard);
    };
    let side = |n: i64| u32::try_from(n).ok().filter(|n| (1..=65_535).contains(n));
    if let (Some(width), Some(height)) = (side(width), side(height)) {
        return Ok([width, height]);
    }
    let message = "both sides must be between 1 and 65535 pixels";
    Err(input.error("record.size", message))
}

fn camera(input: &Input<'_>) -> Result<(View, f64), StudyError> {
    Ok(match input.scene.record.camera {
        None | Some(CameraScene::Preset(CameraChoice::Iso)) => (View::Iso, 0.0),
        Some(CameraScene::Preset(CameraChoice::Front)) => (View::Front, 0.0),
        Some(CameraScene::Preset(CameraChoice::Side)) => (View::Side, 0.0),
        Some(CameraScene::Preset(CameraChoice::Top)) => (View::Top, 0.0),
        Some(CameraScene::Preset(CameraChoice::Turntable)) => (View::Iso, TURN),
        Some(CameraScene::Own(own)) => {
            let (azimuth, elevation) = (own.azimuth, own.elevation);
            if !(azimuth.abs() <= 360.0 && elevation.abs() <= 90.0) {
                let message =
                    "azimuth must be between -360 and 360 degrees, elevation between -90 and 90";
                return Err(input.error("record.camera", message));
            }
            let view = View::Around { azimuth, elevation };
            (view, own.turn.unwrap_or(0.0))
        }
    })
}

/// The point in the middle of pictures and the length across them.
fn aim(input: &Input<'_>) -> Result<(Option<DVec3>, Option<f64>), StudyError> {
    let Some(CameraScene::Own(own)) = input.scene.record.camera else {
        return Ok((None, None));
    };
    let is_near = |c: f64| c.abs() <= FARTHEST;
    if !own.centre.iter().flatten().copied().all(is_near) {
        let message = format!("centre must be three numbers within ±{}", Number(FARTHEST));
        return Err(input.error("record.camera", message));
    }
    if !own.width.is_none_or(|w| (NARROWEST..=FARTHEST).contains(&w)) {
        let message =
            format!("width must be between {} and {}", Number(NARROWEST), Number(FARTHEST));
        return Err(input.error("record.camera", message));
    }
    Ok((own.centre.map(DVec3::from), own.width))
}

/// The size of letters in figures.
fn letters(input: &Input<'_>) -> Result<f64, StudyError> {
    let letters = input.scene.record.letters.unwrap_or(LETTERS);
    if SIZES.contains(&letters) {
        return Ok(letters);
    }
    let message = format!(
        "must be between {} and {} millimetres; captions in print have 2 to 3",
        SIZES.start(),
        SIZES.end()
    );
    Err(input.error("record.letters", message))
}

/// The motion times of the states; `None` for the default ones.
fn states(input: &Input<'_>) -> Result<Option<Vec<f64>>, StudyError> {
    let Some(at) = &input.scene.record.at else {
        return Ok(None);
    };
    let is_usable = (1..=MOST_STATES).contains(&at.len())
        && at.is_sorted_by(|a, b| a < b)
        && at.iter().all(|t| (0.0..=2.0).contains(t));
    if is_usable {
        return Ok(Some(at.clone()));
    }
    let message = format!(
        "must be 1 to {MOST_STATES} motion times in rising order, from 0 (deployed) through 1 (planar) to 2 (compact)"
    );
    Err(input.error("record.at", message))
}

/// The thickness of solids; `None` for surfaces.
fn thickness(input: &Input<'_>) -> Result<Option<f64>, StudyError> {
    let key = "record.thickened";
    match (input.scene.record.thickened, input.scene.material.thickness) {
        (None | Some(ThickenedScene::ByMaterial(false)), _) => Ok(None),
        (Some(ThickenedScene::By(thickness)), _) => input.length(key, thickness).map(Some),
        (Some(ThickenedScene::ByMaterial(true)), Some(thickness)) => {
            input.length("material.thickness", thickness).map(Some)
        }
        (Some(ThickenedScene::ByMaterial(true)), None) => {
            let message = "material.thickness is not set; set it, or set a thickness here";
            Err(input.error(key, message))
        }
    }
}
