//! The scene: a TOML file as data, exactly as the user wrote it. Unknown keys are refused. It is resolved into a
//! [`crate::Study`].

use foldmotion_pattern::Case;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

mod choice;
mod exact_array;
pub mod fields;
pub(crate) mod pattern;
pub(crate) mod record;
pub(crate) mod source;

pub use foldmotion_geometry::DivisionMethod;
pub use foldmotion_pattern::{FacetModel, Facing, Folding};
pub use foldmotion_solver::{CreaseGroup, Ease, Preset, Stage};

pub use self::choice::parse_choice;
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
    /// The title of the study, in reports and files.
    #[schemars(extend("x-default" = "the name of the file"))]
    pub title: Option<String>,
    /// A crease pattern from a file, instead of profile, division and sheet.
    pub pattern: Option<PatternScene>,
    /// The curve Γ in the x–z plane that the sheet approximates.
    #[serde(default)]
    pub profile: ProfileScene,
    /// The sheet of units: its width, its columns and their case.
    #[serde(default)]
    pub sheet: SheetScene,
    /// How Γ is divided into the segments that become the rows.
    #[serde(default)]
    pub division: DivisionScene,
    /// How stiff the sheet is, and how it is damped.
    #[serde(default)]
    pub material: MaterialScene,
    /// The engine, its frames, contact and the schedule.
    #[serde(default)]
    pub motion: MotionScene,
    /// The options of the collision check.
    #[serde(default)]
    pub check: CheckScene,
    /// Which files are written of the motion, and how films and figures look.
    #[serde(default)]
    pub record: RecordScene,
}

/// `[profile]`.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ProfileScene {
    /// A built-in profile; `foldmotion models` lists them. Alternatives: `control_points`, `points` or `file`.
    pub model: Option<String>,
    /// Points [x, z] that the curve passes through, as a cubic spline; at least 2.
    #[serde(deserialize_with = "exact_array::many")]
    #[schemars(extend("x-unit" = "profile.unit"))]
    pub points: Option<Vec<[f64; 2]>>,
    /// A file of such points, next to the scene: .csv (x, z on each line), .dat (an airfoil in Selig's or Lednicer's
    /// order) or .dxf (one polyline or chain of lines, ASCII).
    pub file: Option<String>,
    /// Control points [x, z] of a cubic NURBS curve with unit weights; at least 4.
    #[serde(deserialize_with = "exact_array::many")]
    #[schemars(extend("x-unit" = "profile.unit"))]
    pub control_points: Option<Vec<[f64; 2]>>,
    /// The knots of the NURBS curve of `control_points`.
    #[schemars(extend("x-default" = "clamped and uniform"))]
    pub knots: Option<Vec<f64>>,
    /// Whether the curve returns to its start, and how it meets it.
    #[serde(deserialize_with = "choice::optional")]
    #[schemars(extend("x-default" = "open; an outline from a file that says it is closed meets its start with a corner"))]
    pub closed: Option<Closed>,
    /// The curve is scaled so that the divided polygon has this length.
    #[schemars(extend("x-default" = "the curve as it is given", "x-unit" = "profile.unit", "minimum" = 1e-09, "maximum" = 1_000_000_000.0))]
    pub length: Option<f64>,
    /// The unit of length of the scene and of its results.
    #[serde(deserialize_with = "choice::optional")]
    #[schemars(extend("default" = "m"))]
    pub unit: Option<LengthUnit>,
}

/// How a closed profile meets its start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Closed {
    /// The curve meets its start with a corner.
    Corner,
    /// The curve meets its start smoothly.
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
    /// The unit of this name.
    pub(crate) fn named(name: &str) -> Option<Self> {
        let all = [Self::Unit, Self::In, Self::Pt, Self::M, Self::Cm, Self::Mm, Self::Um, Self::Nm];
        all.into_iter().find(|unit| unit.name() == name)
    }

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

    /// The length of the unit in millimetres; `None` for the unit without a physical length.
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
    /// The width W of the sheet, across all columns.
    #[schemars(extend("x-default" = "W = Nc·h in case E (section 4.1 of the paper); for a built-in profile, the width it has in case E", "x-unit" = "profile.unit", "minimum" = 1e-09, "maximum" = 1_000_000_000.0))]
    pub width: Option<f64>,
    /// The number of rows of units, Nr.
    #[schemars(extend("x-default" = "that of the built-in profile", "minimum" = 1, "maximum" = 1_000_000))]
    pub rows: Option<i64>,
    /// The number of columns of units, Nc.
    #[schemars(extend("x-default" = "that of the built-in profile in this case", "minimum" = 1, "maximum" = 1_000_000))]
    pub columns: Option<i64>,
    /// The case of the unit: how its width w compares with its height h.
    #[serde(deserialize_with = "choice::optional")]
    #[schemars(extend("default" = "auto"))]
    pub case: Option<CaseChoice>,
    /// The ratio λ of case SII, in (0, 1), or of a common flap width. With case `auto` it is not used if w/h makes
    /// the case E or T.
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub lambda: Option<f64>,
    /// The offset d of case SII, 0 ≤ d < w1' = w/2 − λh/2.
    #[schemars(extend("x-default" = "w1'/2", "x-unit" = "profile.unit"))]
    pub offset: Option<f64>,
    /// The side of Γ, seen along it from its start, on which the flaps stand.
    #[serde(deserialize_with = "choice::optional")]
    #[schemars(extend("default" = "left"))]
    pub facing: Option<Facing>,
    /// How rows of unequal height are treated, which a division other than `equal-length` produces.
    #[serde(deserialize_with = "choice::optional")]
    #[schemars(extend("default" = "refuse"))]
    pub unequal: Option<UnequalChoice>,
    /// How the flat sheet folds into its compact state.
    #[serde(deserialize_with = "choice::optional")]
    #[schemars(extend("default" = "waterbomb"))]
    pub folding: Option<Folding>,
}

/// How rows of unequal height are treated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum UnequalChoice {
    /// Rows of unequal height are refused.
    Refuse,
    /// Each has the case E, T or S by its own w/h. They are refused, with the reason, if the creases of neighbours do not meet.
    OwnCase,
    /// All have one flap width, a = λ·min(h, w)/2 of the lowest row, with `lambda` in (0, 1]. Default of `lambda`: 0.9.
    CommonFlap,
}

/// A case by name, or the case that follows from w/h.
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
    /// E if w = h within 1e-9, T if w is smaller, S if it is larger, or SII if λ is given.
    #[serde(rename = "auto")]
    Auto,
}

impl CaseChoice {
    /// The case; `None` if w/h decides.
    pub fn case(self) -> Option<Case> {
        match self {
            Self::E => Some(Case::E),
            Self::T => Some(Case::T),
            Self::S => Some(Case::S),
            Self::SII => Some(Case::SII),
            Self::Plain => Some(Case::Plain),
            Self::Auto => None,
        }
    }
}

/// `[division]`.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DivisionScene {
    /// The method that divides the profile.
    #[serde(deserialize_with = "choice::optional")]
    #[schemars(extend("default" = "equal-length"))]
    pub method: Option<DivisionMethod>,
    /// Equal length: the iteration ends once |R_max| is at most this. Douglas–Peucker: the largest distance from the
    /// curve, divided by its length; the number of rows follows from it.
    #[schemars(extend("default" = 1e-14, "minimum" = 0, "maximum" = 1))]
    pub tolerance: Option<f64>,
    /// The largest number of iterations.
    #[schemars(extend("default" = 200, "minimum" = 1, "maximum" = 1_000_000))]
    pub max_iterations: Option<i64>,
}

/// `[material]`: Origami Simulator's constants; only their ratios shape the equilibrium.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MaterialScene {
    /// The constants to start from; the keys below replace single constants.
    #[serde(deserialize_with = "choice::optional")]
    #[schemars(extend("x-default" = "the constants given below as defaults; `origami-simulator` for a pattern from a file"))]
    pub preset: Option<Preset>,
    /// The thickness of the sheet: layers come no closer than this. Excludes motion.gap.
    #[schemars(extend("x-default" = "none: layers keep motion.gap", "x-unit" = "profile.unit, or the unit of the pattern", "minimum" = 1e-09, "maximum" = 1_000_000_000.0))]
    pub thickness: Option<f64>,
    /// The axial stiffness EA of the bars.
    #[schemars(extend("default" = 20.0, "minimum" = 1e-09, "maximum" = 1_000_000_000_000.0))]
    pub axial_stiffness: Option<f64>,
    /// The stiffness of a crease per unit of its length.
    #[schemars(extend("default" = 0.7, "minimum" = 1e-09, "maximum" = 1_000_000_000_000.0))]
    pub fold_stiffness: Option<f64>,
    /// The stiffness of a hinge inside a facet per unit of its length.
    #[schemars(extend("default" = 0.7, "minimum" = 1e-09, "maximum" = 1_000_000_000_000.0))]
    pub facet_stiffness: Option<f64>,
    /// How the quadrilateral facets of units are cut into triangles. Does not apply to a pattern from a file.
    #[schemars(extend("x-default" = "`symmetric`; `one-diagonal` for maps, and if a facet is narrower than a tenth of its length"))]
    pub facet_model: Option<FacetModel>,
    /// The stiffness of the angles of each triangle. Origami Simulator sets 0.2, with the radius of the pattern as the unit of
    /// length.
    #[schemars(extend("x-default" = "0; 0.2 times the radius over the mean edge for a pattern from a file", "minimum" = 0, "maximum" = 1_000_000_000_000.0))]
    pub face_angle_stiffness: Option<f64>,
    /// The damping ratio ζ of the bars, used by the dynamic engine.
    #[schemars(extend("default" = 0.45, "minimum" = 0, "maximum" = 1000))]
    pub damping_ratio: Option<f64>,
}

/// `[motion]`.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MotionScene {
    /// The engine that computes the motion.
    #[serde(deserialize_with = "choice::optional")]
    #[schemars(extend("default" = "quasi-static"))]
    pub engine: Option<EngineChoice>,
    /// An even number of intervals: the states at t = 2k/frames are recorded.
    #[schemars(extend("default" = 240, "minimum" = 2, "maximum" = 100_000))]
    pub frames: Option<i64>,
    /// Whether layers are kept apart. Only the quasi-static engine has contact.
    #[schemars(extend("x-default" = "true with the quasi-static engine"))]
    pub contact: Option<bool>,
    /// The closest approach of layers. It has to fit next to the thinnest part of the sheet.
    #[schemars(extend("x-default" = "1e-3, or what fits next to the thinnest part of a pattern", "x-unit" = "h, or the mean edge of a pattern", "minimum" = 1e-06))]
    pub gap: Option<f64>,
    /// What the gap shrinks to in the last tenth of stage fold, so that the compact box meets the closed form. The same
    /// as motion.gap keeps the gap. Where contact keeps creases from their targets the gap does not shrink.
    #[schemars(extend("x-default" = "1e-5, or motion.gap if that is less", "x-unit" = "h, or the mean edge of a pattern", "minimum" = 1e-09))]
    pub final_gap: Option<f64>,
    /// How stage unfold flattens the profile.
    #[serde(deserialize_with = "choice::optional")]
    #[schemars(extend("default" = "auto"))]
    pub unfold: Option<UnfoldChoice>,
    /// How much work the engine may do, in seconds (60 or "60 s") or in its own steps ("20000 steps"). The motion
    /// then ends at the state reached, with exit status 3.
    #[schemars(extend("x-default" = "300 Newton iterations for each state, or a million settling steps for each stage"))]
    pub budget: Option<BudgetScene>,
    /// The schedule. Creases that no step names follow the ramp of their stage.
    pub step: Vec<StepScene>,
}

/// How the row creases move from the deployed shape to the flat sheet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum UnfoldChoice {
    /// All fold angles are scaled together.
    Uniform,
    /// A path on which the profile does not cross itself (Cantarella, Demaine, Iben, O'Brien 2004).
    Energy,
    /// Uniform if that is proved not to cross, otherwise energy.
    #[default]
    Auto,
}

impl UnfoldChoice {
    /// The name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Energy => "energy",
            Self::Auto => "auto",
        }
    }
}

/// `[[motion.step]]`: some creases, and the part of their stage in which they move.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StepScene {
    /// The stage of the step: `unfold` or `fold`.
    #[serde(deserialize_with = "choice::required")]
    pub stage: Stage,
    /// The creases that move, by their position in the unit or by the direction in which they fold.
    #[serde(default, deserialize_with = "choice::optional")]
    #[schemars(extend("default" = "all"))]
    pub creases: Option<CreaseGroup>,
    /// The ids of the creases that move, of a pattern from a file: those of elements of an SVG or of groups around them,
    /// of objects and groups of an OBJ, or handles of a DXF.
    #[schemars(extend("x-default" = "every id"))]
    pub ids: Option<Vec<String>>,
    /// The classes of the creases that move, of a pattern from a file: those of elements of an SVG or of groups around
    /// them, layers of a DXF, or materials of an OBJ.
    #[schemars(extend("x-default" = "every class"))]
    pub classes: Option<Vec<String>>,
    /// The edges that move, of a pattern from a file, counted from 0: as a FOLD file lists them; in other formats as
    /// `pattern.fold` and `motion.fold` list them.
    #[schemars(extend("x-default" = "every edge"))]
    pub edges: Option<Vec<i64>>,
    /// The first and the last row that move, both included and counted from 0, or a single one.
    #[schemars(extend("x-default" = "every row"))]
    pub rows: Option<Vec<i64>>,
    /// The first and the last column that move, both included and counted from 0, or a single one.
    #[schemars(extend("x-default" = "every column"))]
    pub columns: Option<Vec<i64>>,
    /// The part of the stage at which the creases begin to move.
    #[schemars(extend("default" = 0.0, "minimum" = 0, "maximum" = 1))]
    pub from: Option<f64>,
    /// The part of the stage at which the creases arrive.
    #[schemars(extend("default" = 1.0, "minimum" = 0, "maximum" = 1))]
    pub to: Option<f64>,
    /// How the creases move between `from` and `to`.
    #[serde(default, deserialize_with = "choice::optional")]
    #[schemars(extend("default" = "linear"))]
    pub ease: Option<Ease>,
}

/// The engine that computes a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum EngineChoice {
    /// The sheet is in equilibrium at each step of the schedule.
    QuasiStatic,
    /// Masses, springs and dampers move in explicit time steps.
    Dynamic,
}

impl EngineChoice {
    /// The name in scenes and reports.
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
    /// The tolerance τ of the verdict: facets that overlap by no more than this touch. In a pattern whose thin parts lower
    /// the default of motion.gap below 1e-5, the default is a tenth of that gap.
    #[schemars(extend("default" = 1e-6, "x-unit" = "h, or the mean edge of a pattern", "minimum" = 0, "maximum" = 0.01))]
    pub touch_tolerance: Option<f64>,
    /// If more pairs of triangles than this penetrate, later frames are not checked; 0 means no limit.
    #[schemars(extend("default" = 4096, "minimum" = 0))]
    pub stop_at: Option<i64>,
}

/// A budget: seconds, or a text with a unit.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum BudgetScene {
    /// A number of seconds.
    Seconds(f64),
    /// A text such as `60 s` or `20000 steps`.
    Words(String),
}
