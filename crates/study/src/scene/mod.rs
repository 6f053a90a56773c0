//! The scene: exactly what the user wrote.
//!
//! A TOML file; unknown keys are refused. [`crate::Study`] is what becomes of it.

use foldmotion_pattern::Case;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

mod choice;
mod exact_array;
pub(crate) mod pattern;
pub(crate) mod record;
pub(crate) mod source;

pub use foldmotion_geometry::DivisionMethod;
pub use foldmotion_pattern::{FacetModel, Facing, Folding};
pub use foldmotion_solver::{CreaseGroup, Ease, Preset, Stage};

pub use self::pattern::PatternScene;
pub use self::record::{
    CameraChoice, CameraScene, ColourChoice, HoldScene, OutputChoice, OwnCamera, Playback,
    RecordScene, ThickenedScene,
};

/// A scene file.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "foldmotion scene")]
pub struct Scene {
    /// Title of the study; the file's name where it is left out.
    pub title: Option<String>,
    /// A crease pattern of a file, in place of profile, sheet and division.
    pub pattern: Option<PatternScene>,
    /// The curve Γ in the x–z plane.
    #[serde(default)]
    pub profile: ProfileScene,
    /// The sheet of units.
    #[serde(default)]
    pub sheet: SheetScene,
    /// How Γ is divided into segments.
    #[serde(default)]
    pub division: DivisionScene,
    /// Stiffness and damping.
    #[serde(default)]
    pub material: MaterialScene,
    /// The engine and its frames.
    #[serde(default)]
    pub motion: MotionScene,
    /// Tolerances of the verdict.
    #[serde(default)]
    pub check: CheckScene,
    /// Results to write.
    #[serde(default)]
    pub record: RecordScene,
}

/// `[profile]`.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ProfileScene {
    /// A built-in profile (`foldmotion models` lists them); or give `control_points`, `points` or `file`.
    pub model: Option<String>,
    /// Points [x, z] that the curve runs through, as a cubic spline, at least 2.
    #[serde(deserialize_with = "exact_array::many")]
    pub points: Option<Vec<[f64; 2]>>,
    /// A file of such points, beside the scene: .csv (x, z a line), .dat (airfoil, Selig's or Lednicer's order) or .dxf (one
    /// polyline or chain of lines, ASCII).
    pub file: Option<String>,
    /// Control points [x, z] of a cubic NURBS with unit weights, at least 4.
    #[serde(deserialize_with = "exact_array::many")]
    pub control_points: Option<Vec<[f64; 2]>>,
    /// Knots of that curve; clamped and uniform where left out.
    pub knots: Option<Vec<f64>>,
    /// Whether the curve returns to its start, with a corner there or smoothly; outlines in files that say they are closed,
    /// with a corner where left out.
    #[serde(deserialize_with = "choice::optional")]
    pub closed: Option<Closed>,
    /// Scales Γ so that the divided polygon has this length.
    pub length: Option<f64>,
    /// The unit of length; `m` where left out.
    #[serde(deserialize_with = "choice::optional")]
    pub unit: Option<LengthUnit>,
}

/// How a closed profile meets its start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Closed {
    /// With a corner.
    Corner,
    /// Smoothly.
    Smooth,
}

/// FOLD's units of length.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum LengthUnit {
    /// No physical unit.
    Unit,
    /// Inches.
    In,
    /// Points, 1/72 inch.
    Pt,
    /// Metres.
    #[default]
    M,
    /// Centimetres.
    Cm,
    /// Millimetres.
    Mm,
    /// Micrometres.
    Um,
    /// Nanometres.
    Nm,
}

impl LengthUnit {
    /// The name in scene and FOLD files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Unit => "unit",
            Self::In => "in",
            Self::Pt => "pt",
            Self::M => "m",
            Self::Cm => "cm",
            Self::Mm => "mm",
            Self::Um => "um",
            Self::Nm => "nm",
        }
    }

    /// Its length in millimetres; none for the unit that has no physical length.
    pub fn millimetres(self) -> Option<f64> {
        match self {
            Self::Unit => None,
            Self::In => Some(25.4),
            Self::Pt => Some(25.4 / 72.0),
            Self::M => Some(1e3),
            Self::Cm => Some(10.0),
            Self::Mm => Some(1.0),
            Self::Um => Some(1e-3),
            Self::Nm => Some(1e-6),
        }
    }
}

/// `[sheet]`.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SheetScene {
    /// W; may be left out for case E, where W = Nc·h (section 4.1 of the paper), and for built-in profiles, where W is that
    /// of case E.
    pub width: Option<f64>,
    /// Nr; that of the built-in profile where left out.
    pub rows: Option<i64>,
    /// Nc; that of the built-in profile in this case where left out.
    pub columns: Option<i64>,
    /// The case; `auto` where left out.
    #[serde(deserialize_with = "choice::optional")]
    pub case: Option<CaseChoice>,
    /// λ of case SII, in (0, 1), or of a common flap; `auto` leaves it out where w/h makes the case E or T.
    pub lambda: Option<f64>,
    /// d of case SII, 0 ≤ d < w1' = w/2 − λh/2; w1'/2 where left out.
    pub offset: Option<f64>,
    /// The side of Γ, seen along it, on which the flaps stand; `left` where left out.
    #[serde(deserialize_with = "choice::optional")]
    pub facing: Option<Facing>,
    /// What becomes of rows of unequal height, which a division other than `equal-length` gives; `refuse` where left out.
    #[serde(deserialize_with = "choice::optional")]
    pub unequal: Option<UnequalChoice>,
    /// How the flat sheet folds; `waterbomb` where left out.
    #[serde(deserialize_with = "choice::optional")]
    pub folding: Option<Folding>,
}

/// What becomes of rows of unequal height.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum UnequalChoice {
    /// They are refused.
    Refuse,
    /// Each takes E, T or S by its own w/h; refused, with the reason, where the creases of neighbours do not meet.
    OwnCase,
    /// All have one flap width, a = λ·min(h, w)/2 of the lowest row, with `lambda` in (0, 1], 0.9 where left out.
    CommonFlap,
}

/// A case by name, or the one that w/h allows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
pub enum CaseChoice {
    /// Square units.
    E,
    /// Tall units.
    T,
    /// Short units with side pads.
    S,
    /// Short units with side and centre pads.
    SII,
    /// Unmodified rectangles.
    #[serde(rename = "plain")]
    Plain,
    /// E where w = h within 1e-9, T below, S above, or SII if λ is given.
    #[serde(rename = "auto")]
    Auto,
}

impl CaseChoice {
    /// The case, by w and h where the scene leaves it open.
    pub fn resolve(self, width: f64, height: f64, lambda: Option<f64>) -> Case {
        match self {
            Self::E => Case::E,
            Self::T => Case::T,
            Self::S => Case::S,
            Self::SII => Case::SII,
            Self::Plain => Case::Plain,
            Self::Auto => Case::auto(width, height, lambda),
        }
    }
}

/// `[division]`.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DivisionScene {
    /// `equal-length` where left out.
    #[serde(deserialize_with = "choice::optional")]
    pub method: Option<DivisionMethod>,
    /// Equal length: the iteration ends once |R_max| is at most this; 1e-14 where left out. Douglas–Peucker: the largest
    /// distance from the curve, over its length; the rows follow from it.
    pub tolerance: Option<f64>,
    /// Iterations at most; 200 where left out.
    pub max_iterations: Option<i64>,
}

/// `[material]`: Origami Simulator's constants; only their ratios shape the equilibrium.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MaterialScene {
    /// The constants to start from; keys beside it replace single ones.
    #[serde(deserialize_with = "choice::optional")]
    pub preset: Option<Preset>,
    /// Thickness of the sheet in profile.unit or the unit of the pattern: layers then come no closer than this. Not with motion.gap.
    pub thickness: Option<f64>,
    /// EA of the bars; 20 where left out.
    pub axial_stiffness: Option<f64>,
    /// Stiffness of a crease per unit length; 0.7 where left out.
    pub fold_stiffness: Option<f64>,
    /// Stiffness of a facet hinge per unit length; 0.7 where left out.
    pub facet_stiffness: Option<f64>,
    /// How quadrilateral facets of the units are cut into triangles; `symmetric` where left out, but `one-diagonal` for maps
    /// and where one is narrower than a tenth of its length. Not with a pattern of a file.
    pub facet_model: Option<FacetModel>,
    /// Stiffness of the angles of each triangle; 0 where left out (Origami Simulator sets 0.2).
    pub face_angle_stiffness: Option<f64>,
    /// ζ of the bars' dampers; 0.45 where left out.
    pub damping_ratio: Option<f64>,
}

/// `[motion]`.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MotionScene {
    /// `quasi-static` where left out.
    #[serde(deserialize_with = "choice::optional")]
    pub engine: Option<EngineChoice>,
    /// An even number; the states t = 2k/frames are recorded. 240 where left out.
    pub frames: Option<i64>,
    /// Whether layers keep apart; quasi-static engine only, where it is on unless set to false.
    pub contact: Option<bool>,
    /// Closest approach of layers, in units of h or, of a pattern, its mean edge; 1e-3 where left out, less where a pattern
    /// has small facets.
    pub gap: Option<f64>,
    /// How stage 1 unfolds the profile; `auto` where left out.
    #[serde(deserialize_with = "choice::optional")]
    pub unfold: Option<UnfoldChoice>,
    /// How much work the engine may do, in seconds (60 or "60 s") or in its own steps ("20000 steps"); the motion then
    /// ends where it is, with exit status 3. Default: 300 Newton iterations a state, or a million steps of settling a stage.
    pub budget: Option<BudgetScene>,
    /// The schedule: creases that no step names follow the ramp of their stage.
    pub step: Vec<StepScene>,
}

/// How the row creases move from the deployed shape to the flat sheet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum UnfoldChoice {
    /// All fold angles scaled together.
    Uniform,
    /// A path on which the profile does not cross itself (Cantarella, Demaine, Iben, O'Brien 2004).
    Energy,
    /// Uniform where that is proved not to cross, else energy.
    #[default]
    Auto,
}

impl UnfoldChoice {
    /// Its name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Energy => "energy",
            Self::Auto => "auto",
        }
    }
}

/// `[[motion.step]]`: some creases, and when in their stage they move.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StepScene {
    /// `unfold` or `fold`.
    #[serde(deserialize_with = "choice::required")]
    pub stage: Stage,
    /// The creases, by their place in the unit or by the way they fold; `all` where left out.
    #[serde(default, deserialize_with = "choice::optional")]
    pub creases: Option<CreaseGroup>,
    /// First and last row, both included, or one; every row where left out.
    pub rows: Option<Vec<i64>>,
    /// First and last column, both included, or one; every column where left out.
    pub columns: Option<Vec<i64>>,
    /// The part of the stage, from 0 to 1, at which they begin to move; 0 where left out.
    pub from: Option<f64>,
    /// The part of the stage at which they arrive; 1 where left out.
    pub to: Option<f64>,
    /// How they move; `linear` where left out.
    #[serde(default, deserialize_with = "choice::optional")]
    pub ease: Option<Ease>,
}

/// The engines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum EngineChoice {
    /// Equilibrium along the schedule.
    QuasiStatic,
    /// Mass, spring, damper, explicit steps.
    Dynamic,
}

impl EngineChoice {
    /// Its name in scenes and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::QuasiStatic => "quasi-static",
            Self::Dynamic => "dynamic",
        }
    }
}

/// `[check]`.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CheckScene {
    /// τ in units of h or, of a pattern, its mean edge: facets that overlap by no more touch; 1e-6 where left out.
    pub touch_tolerance: Option<f64>,
    /// Once more pairs of triangles than this penetrate, no later frame is judged; 0: no limit; default: 4096.
    pub stop_at: Option<i64>,
}

/// Seconds, or words with a unit.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum BudgetScene {
    /// Seconds.
    Seconds(f64),
    /// `60 s` or `20000 steps`.
    Words(String),
}
