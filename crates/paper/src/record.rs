//! `paper.json`: the computed numbers and those that the paper prints.

use foldmotion_check::Verdict;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use foldmotion_study::report::{BoxReport, ErrorReport};

/// `paper.json`. Lengths are in units of the rows' height h, angles in degrees. Parts that have not been made are
/// empty or null.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "foldmotion paper")]
pub struct PaperRecord {
    /// The version of foldmotion that made the record.
    pub version: String,
    /// Table 1; its timings are all that may differ between two records of the same version.
    pub table1: Vec<DivisionRow>,
    /// Table 2, and the rows and columns of the profiles that it omits.
    pub table2: Vec<CountRow>,
    /// The compact boxes of nine profiles in four cases.
    pub cases: Vec<CaseRow>,
    /// The nine profiles unfolded into the plane.
    pub unfoldings: Vec<UnfoldingRow>,
    /// The figures, with the files that show them.
    pub figures: Vec<FigureRow>,
}

/// A row of table 1.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DivisionRow {
    /// The name of the built-in profile.
    pub model: String,
    /// Nr, the number of rows of units.
    pub rows: usize,
    /// Nc, the number of columns in case E.
    pub columns: usize,
    /// |R_max|, the largest residual of equation 1.
    pub max_residual: f64,
    /// |R_ave|, the mean residual of equation 1.
    pub mean_residual: f64,
    /// Wall-clock seconds of the division, the shortest of five.
    pub seconds: f64,
    /// What the paper prints for this profile.
    pub paper: PrintedDivision,
}

/// What table 1 prints of a profile.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PrintedDivision {
    /// Nr, the number of rows as printed.
    pub rows: usize,
    /// Nc, the number of columns as printed.
    pub columns: usize,
    /// |R_max|, the largest residual as printed.
    pub max_residual: f64,
    /// |R_ave|, the mean residual as printed.
    pub mean_residual: f64,
    /// T, the seconds of the division as printed.
    pub seconds: f64,
}

/// A row of table 2.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CountRow {
    /// The name of the built-in profile.
    pub model: String,
    /// Nr, the number of rows of units.
    pub rows: usize,
    /// Nc in case E, in case T, and in cases S and SII.
    pub columns: [usize; 3],
    /// What the paper prints; null if the columns in T, S and SII are our choice.
    pub paper: Option<PrintedCounts>,
}

/// What table 2 prints of a profile.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PrintedCounts {
    /// The figure of the paper that shows the profile.
    pub figure: String,
    /// Nr, the number of rows as printed.
    pub rows: usize,
    /// Nc in case E, in case T, and in cases S and SII, as printed.
    pub columns: [usize; 3],
}

/// The compact state of a profile in a case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CaseRow {
    /// The name of the built-in profile.
    pub model: String,
    /// The case of the unit: E, T, S or SII.
    pub case: String,
    /// Nr, the number of rows of units.
    pub rows: usize,
    /// Nc, the number of columns of units.
    pub columns: usize,
    /// Whether the paper prints neither this Nc nor a figure of it.
    pub columns_ours: bool,
    /// The width w of the unit, in units of h.
    pub unit_width: f64,
    /// The compact box by equations 3 to 7.
    pub closed_form: BoxReport,
    /// The box of the exact compact state.
    pub exact: BoxReport,
    /// The box of the simulated compact state, without contact; null if it has not been computed.
    pub simulated: Option<BoxReport>,
    /// Simulated minus closed form, each divided by the closed form or, if that is 0, by h, h² or h³.
    pub simulated_error: Option<ErrorReport>,
    /// The verdict on the motion with contact if there is one, otherwise on the motion without; null if neither has
    /// been computed.
    pub verdict: Option<Verdict>,
    /// How the motion without contact went.
    pub motion: Option<MotionRow>,
    /// How the motion with contact went.
    pub certificate: Option<MotionRow>,
}

/// How a motion went.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MotionRow {
    /// Whether the sheet passes through itself.
    pub verdict: Verdict,
    /// The motion time of the first penetration.
    pub first_penetration_t: Option<f64>,
    /// The smallest distance of facets that share no vertex, in units of h.
    pub min_separation: Option<f64>,
    /// The number of frames recorded and checked, with straight paths between them.
    pub frames: usize,
    /// Whether both stages were computed to their end in equilibrium.
    pub converged: bool,
    /// The motion time of the last state.
    pub reached_t: f64,
    /// The motion time at which contact stopped the motion; null if it did not.
    pub jam_t: Option<f64>,
    /// The largest |l/l0 − 1| over all edges and frames.
    pub peak_strain: f64,
    /// The box of the last state, fitted to the exact compact state.
    pub compact: BoxReport,
    /// The root mean square distance of the last state from the exact compact state, in units of h.
    pub rms_to_exact: f64,
    /// The errors of that box against the closed form.
    pub error: ErrorReport,
}

/// A profile unfolded into the plane, checked frame by frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct UnfoldingRow {
    /// The name of the built-in profile.
    pub model: String,
    /// Nr, the number of rows of units.
    pub rows: usize,
    /// `uniform`: all hinge angles are scaled alike; `energy`: descent of the energy of Cantarella et al. (2004).
    pub method: String,
    /// Whether the profile crosses itself while it unfolds.
    pub verdict: Verdict,
    /// The part of the path still to go, from 1 to 0, at which the first penetration begins; for `uniform` the part
    /// of the hinge angles.
    pub crosses_at: Option<f64>,
    /// Whether the divided profile was proved not to cross itself at any instant.
    pub proved: bool,
    /// The number of frames that were checked.
    pub frames: usize,
}

/// A figure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FigureRow {
    /// The name of the figure, such as `fig1`.
    pub name: String,
    /// What the figure shows, in a sentence.
    pub caption: String,
    /// The files of the figure, as SVG and as PNG.
    pub files: [String; 2],
}

impl PaperRecord {
    /// As JSON, for `paper.json`.
    pub fn to_json(&self) -> String {
        // Plain data with string keys, which always serialises.
        let mut text = serde_json::to_string_pretty(self).unwrap_or_default();
        text.push('\n');
        text
    }
}
