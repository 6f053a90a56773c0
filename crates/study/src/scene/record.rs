//! `[record]`: what is written of a motion, and how it looks.

pub use foldmotion_record::Playback;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{choice, exact_array};

/// `[record]`.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RecordScene {
    /// `fold`, `gif` and `csv` where left out.
    #[serde(deserialize_with = "choice::list")]
    pub outputs: Option<Vec<OutputChoice>>,
    /// Pixels across and down; where left out [960, 720] if `mp4` or `png` are written, else [480, 360].
    #[serde(deserialize_with = "exact_array::one")]
    pub size: Option<[i64; 2]>,
    /// Film frames a second; where left out 30 if `mp4` or `png` are written, else 10.
    pub fps: Option<f64>,
    /// Seconds a stage; [3, 5] where left out.
    #[serde(deserialize_with = "exact_array::one")]
    pub seconds: Option<[f64; 2]>,
    /// Seconds the deployed, the planar and the compact state stand still, or one number for all; 0.5 where left out.
    pub hold: Option<HoldScene>,
    /// How films run; `forward` where left out.
    #[serde(rename = "loop")]
    #[serde(deserialize_with = "choice::optional")]
    pub playback: Option<Playback>,
    /// Where the viewer stands: a preset, or angles; `iso` where left out.
    pub camera: Option<CameraScene>,
    /// Whether films come nearer where the sheet is small, so that it fills a fair part of the picture; true where left out.
    /// With false all states have one scale. A camera with centre or width stays where it is.
    pub follow: Option<bool>,
    /// What colours show; `paper` where left out.
    #[serde(deserialize_with = "choice::optional")]
    pub colour: Option<ColourChoice>,
    /// Whether the pictures of `png` and the figures have no background; false where left out.
    pub transparent: Option<bool>,
    /// Whether films tell stage and t; false where left out.
    pub caption: Option<bool>,
    /// The motion times of the states in figures, OBJ and STL, rising; [0, 0.5, 1, 1.5, 2] where left out, five even ones
    /// where the motion does not begin at 0.
    pub at: Option<Vec<f64>>,
    /// OBJ and STL as solids: `true` for material.thickness, or a thickness in profile.unit; surfaces where left out.
    pub thickened: Option<ThickenedScene>,
    /// Whether figures show the profile over the deployed state; false where left out.
    pub profile: Option<bool>,
    /// Whether figures show the box of the compact state, its sizes and its closed form; true where left out.
    #[serde(rename = "box")]
    pub bounds: Option<bool>,
    /// Whether figures give h, w and the width W of a sheet of equal units at the planar state; true where left out.
    pub dimensions: Option<bool>,
    /// The size of letters in figures, millimetres; 2.4 where left out.
    pub letters: Option<f64>,
}

/// Pixels and frames a second of a GIF alone: drawing and packing it costs less than folding a sheet with contact.
const GIF_FILM: ([u32; 2], f64) = ([480, 360], 10.0);

/// The same of films that are also written as MP4 or pictures.
const FULL_FILM: ([u32; 2], f64) = ([960, 720], 30.0);

impl RecordScene {
    /// Pixels across and down, and frames a second, of films where the scene leaves them out.
    pub fn standard_film(&self) -> ([u32; 2], f64) {
        let is_full = |output| matches!(output, &OutputChoice::Mp4 | &OutputChoice::Png);
        if self.outputs.iter().flatten().any(is_full) {
            FULL_FILM
        } else {
            GIF_FILM
        }
    }
}

/// The files a run writes beside its report.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Deserialize, Serialize, JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum OutputChoice {
    /// `motion.fold` and `certificate.json`.
    Fold,
    /// `motion.gif`.
    Gif,
    /// `motion.csv` and `plots.svg`: strain, bending, energy and separation over t.
    Csv,
    /// `motion.mp4`: H.264.
    Mp4,
    /// `frames/0001.png` on, at a constant rate.
    Png,
    /// `figure.svg`: states side by side, as lines and areas.
    Svg,
    /// `figure.pdf`: the same.
    Pdf,
    /// `motion.glb`: glTF with the motion as morph targets.
    Glb,
    /// `state-0.5.obj`: a file for each of the states `at`.
    Obj,
    /// `state-0.5.stl`: likewise.
    Stl,
    /// `motion.html`: the motion, its plots, report and certificate as one page for browsers.
    Html,
}

impl OutputChoice {
    /// Every output.
    pub const ALL: [Self; 11] = [
        Self::Fold,
        Self::Gif,
        Self::Csv,
        Self::Mp4,
        Self::Png,
        Self::Svg,
        Self::Pdf,
        Self::Glb,
        Self::Obj,
        Self::Stl,
        Self::Html,
    ];

    /// Its name in scene files, which is also how its files end.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fold => "fold",
            Self::Gif => "gif",
            Self::Csv => "csv",
            Self::Mp4 => "mp4",
            Self::Png => "png",
            Self::Svg => "svg",
            Self::Pdf => "pdf",
            Self::Glb => "glb",
            Self::Obj => "obj",
            Self::Stl => "stl",
            Self::Html => "html",
        }
    }
}

/// Seconds a state stands still.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "hold must be a number of seconds, or three: [deployed, planar, compact]"
)]
pub enum HoldScene {
    /// All three alike.
    Each(f64),
    /// The deployed, the planar and the compact state.
    States([f64; 3]),
}

/// Where the viewer stands.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "camera must be \"iso\", \"front\", \"side\", \"top\", \"turntable\", or a table such as \
                 { azimuth = -60, elevation = 32 } in degrees, with turn = 360 to go round, centre = [x, y, z] and width = w for \
                 a picture of your own"
)]
pub enum CameraScene {
    /// By name.
    Preset(CameraChoice),
    /// By angles.
    Own(OwnCamera),
}

/// Camera presets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum CameraChoice {
    /// From above, in front and the side.
    Iso,
    /// Along the width.
    Front,
    /// Along the growing direction.
    Side,
    /// From above.
    Top,
    /// As iso, once round over the film.
    Turntable,
}

/// A camera by its angles, in degrees.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OwnCamera {
    /// Counter-clockwise seen from above, from +x to the viewer: −90 is front, 0 is side.
    pub azimuth: f64,
    /// Above the plane z = 0: 90 is top.
    pub elevation: f64,
    /// How far films go round the motion, evenly; 0 where left out.
    pub turn: Option<f64>,
    /// The point [x, y, z] in the middle of films and pictures, in the motion's unit; the middle of the motion where left
    /// out.
    #[serde(default, deserialize_with = "exact_array::one")]
    pub centre: Option<[f64; 3]>,
    /// The length shown across films and pictures, in the motion's unit; as much as all of the motion needs where left out.
    /// With a centre figures show as much of each state, and more where it is larger.
    pub width: Option<f64>,
}

/// What colours show.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum ColourChoice {
    /// The two sides of the paper.
    Paper,
    /// The same in greys, mountains dash-dotted and valleys dashed in figures.
    Grey,
    /// The largest strain of a triangle's edges against the crease pattern, with a scale.
    Strain,
    /// The largest bend of a facet, with a scale.
    Bending,
}

/// How thick solids are.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "thickened must be true, false, or a thickness in profile.unit"
)]
pub enum ThickenedScene {
    /// As the material says, or not at all.
    ByMaterial(bool),
    /// In profile.unit.
    By(f64),
}
