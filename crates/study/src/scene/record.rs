//! `[record]`: the outputs of a motion and their settings.

pub use foldmotion_record::Playback;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{choice, exact_array};

/// `[record]`.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RecordScene {
    /// The kinds of files to write in addition to the report.
    #[serde(deserialize_with = "choice::list")]
    #[schemars(extend("default" = ["fold", "gif", "csv"]))]
    pub outputs: Option<Vec<OutputChoice>>,
    /// The size of films and pictures, across and down.
    #[serde(deserialize_with = "exact_array::one")]
    #[schemars(extend("x-default" = "[960, 720] if `mp4` or `png` is written, otherwise [480, 360]", "x-unit" = "pixels"))]
    pub size: Option<[i64; 2]>,
    /// The number of film frames per second.
    #[schemars(extend("x-default" = "30 if `mp4` or `png` is written, otherwise 10", "x-unit" = "1/s", "minimum" = 0, "maximum" = 50))]
    pub fps: Option<f64>,
    /// How long films show stage unfold and stage fold.
    #[serde(deserialize_with = "exact_array::one")]
    #[schemars(extend("default" = [3.0, 5.0], "x-unit" = "s"))]
    pub seconds: Option<[f64; 2]>,
    /// How long the deployed, the planar and the compact state stand still: three numbers, or one for all.
    #[schemars(extend("default" = 0.5, "x-unit" = "s"))]
    pub hold: Option<HoldScene>,
    /// Whether films run forward only, or back as well.
    #[serde(rename = "loop")]
    #[serde(deserialize_with = "choice::optional")]
    #[schemars(extend("default" = "forward"))]
    pub playback: Option<Playback>,
    /// The position of the viewer: a preset, or angles.
    #[schemars(extend("default" = "iso"))]
    pub camera: Option<CameraScene>,
    /// Whether the camera of films moves closer where the sheet is small in the picture. With false all states have the same scale.
    /// A camera with a centre or a width stays where it is.
    #[schemars(extend("default" = true))]
    pub follow: Option<bool>,
    /// What the colours of films and figures show.
    #[serde(deserialize_with = "choice::optional")]
    #[schemars(extend("default" = "paper"))]
    pub colour: Option<ColourChoice>,
    /// Whether the pictures of `png` and the figures have no background.
    #[schemars(extend("default" = false))]
    pub transparent: Option<bool>,
    /// Whether films show the stage and the motion time t.
    #[schemars(extend("default" = false))]
    pub caption: Option<bool>,
    /// The motion times, in rising order, of the states shown in figures, OBJ and STL.
    #[schemars(extend("x-default" = "[0, 0.5, 1, 1.5, 2]; five evenly spaced times if the motion does not begin at 0"))]
    pub at: Option<Vec<f64>>,
    /// OBJ and STL as solids: `true` takes material.thickness, a number is the thickness.
    #[schemars(extend("x-default" = "surfaces", "x-unit" = "profile.unit"))]
    pub thickened: Option<ThickenedScene>,
    /// Whether figures show the profile above the deployed state.
    #[schemars(extend("default" = false))]
    pub profile: Option<bool>,
    /// Whether figures show the box of the compact state with its sizes and its closed form.
    #[serde(rename = "box")]
    #[schemars(extend("default" = true))]
    pub bounds: Option<bool>,
    /// Whether figures show h, w and the width W of a sheet of equal units at the planar state.
    #[schemars(extend("default" = true))]
    pub dimensions: Option<bool>,
    /// The font size of captions and labels in figures.
    #[schemars(extend("default" = 2.4, "x-unit" = "mm", "minimum" = 0.5, "maximum" = 20.0))]
    pub letters: Option<f64>,
}

/// The default size and frame rate of films if only a GIF is written, which then costs less time than folding a sheet.
const GIF_FILM: ([u32; 2], f64) = ([480, 360], 10.0);

/// The default size and frame rate of films that are also written as MP4 or pictures.
const FULL_FILM: ([u32; 2], f64) = ([960, 720], 30.0);

impl RecordScene {
    /// The default size in pixels and the default frame rate of films.
    pub fn standard_film(&self) -> ([u32; 2], f64) {
        let is_full = |output| matches!(output, &OutputChoice::Mp4 | &OutputChoice::Png);
        if self.outputs.iter().flatten().any(is_full) { FULL_FILM } else { GIF_FILM }
    }
}

/// The files that a run writes in addition to its report.
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
    /// `frames/0001.png` and so on: pictures at a constant frame rate.
    Png,
    /// `figure.svg`: states side by side, as lines and areas.
    Svg,
    /// `figure.pdf`: the same figure as PDF.
    Pdf,
    /// `motion.glb`: glTF with the motion as morph targets.
    Glb,
    /// `state-0.5.obj`: a file for each of the states `at`.
    Obj,
    /// `state-0.5.stl`: a file for each of the states `at`, as STL.
    Stl,
    /// `motion.html`: the motion, its plots, report and certificate as one page for browsers.
    Html,
    /// `motion.pvd` and `vtk/0001.vtp` and so on: every frame with strain and facet bending, for ParaView and PyVista.
    Vtk,
}

impl OutputChoice {
    /// Every output.
    pub const ALL: [Self; 12] = [
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
        Self::Vtk,
    ];

    /// The name in scene files, which is also the extension of its files, except for those of VTK.
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
            Self::Vtk => "vtk",
        }
    }
}

/// How long films show a state without motion, in seconds.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "hold must be a number of seconds, or three: [deployed, planar, compact]"
)]
pub enum HoldScene {
    /// The same time for all three states.
    Each(f64),
    /// The times of the deployed, the planar and the compact state.
    States([f64; 3]),
}

/// The position of the viewer.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "camera must be \"iso\", \"front\", \"side\", \"top\", \"turntable\", or a table such as \
                 { azimuth = -60, elevation = 32 } in degrees, with turn = 360 to go round, centre = [x, y, z] and width = w for \
                 a picture of your own"
)]
pub enum CameraScene {
    /// A preset by name.
    Preset(CameraChoice),
    /// A camera by angles.
    Own(OwnCamera),
}

/// The camera presets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum CameraChoice {
    /// From above, the front and the side.
    Iso,
    /// Along the width.
    Front,
    /// Along the profile.
    Side,
    /// From above.
    Top,
    /// As iso, with one turn around the motion over the film.
    Turntable,
}

/// A camera by its angles, in degrees.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OwnCamera {
    /// The direction of the viewer seen from above, counter-clockwise from +x: −90 is the front, 0 the side.
    #[schemars(extend("x-unit" = "degrees", "minimum" = -360, "maximum" = 360))]
    pub azimuth: f64,
    /// The height of the viewer above the plane z = 0, as an angle: 90 is the top.
    #[schemars(extend("x-unit" = "degrees", "minimum" = -90, "maximum" = 90))]
    pub elevation: f64,
    /// How far films go round the motion, at a constant speed.
    #[schemars(extend("default" = 0.0, "x-unit" = "degrees", "minimum" = -3600, "maximum" = 3600))]
    pub turn: Option<f64>,
    /// The point [x, y, z] in the middle of films and pictures.
    #[serde(default, deserialize_with = "exact_array::one")]
    #[schemars(extend("x-default" = "the middle of the motion", "x-unit" = "profile.unit"))]
    pub centre: Option<[f64; 3]>,
    /// The length shown across films and pictures. With a centre, figures show this much of each state, and more if a
    /// state is larger.
    #[schemars(extend("x-default" = "what all of the motion needs", "x-unit" = "profile.unit", "minimum" = 1e-09, "maximum" = 1_000_000_000.0))]
    pub width: Option<f64>,
}

/// What the colours of films and figures show.
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

/// The thickness of solids.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(untagged, expecting = "thickened must be true, false, or a thickness in profile.unit")]
pub enum ThickenedScene {
    /// The thickness of the material, or surfaces.
    ByMaterial(bool),
    /// A thickness in profile.unit.
    By(f64),
}
