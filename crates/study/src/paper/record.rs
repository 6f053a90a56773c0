//! `paper.json`: what was found out, beside what the paper prints.

use foldmotion_check::Verdict;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::report::{BoxReport, ErrorReport};

/// `paper.json`. Lengths are in units of the rows' height h, angles in degrees. Parts that have not been made are
/// empty or null.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "foldmotion paper")]
pub struct PaperRecord {
    /// Version of foldmotion.
    pub version: String,
    /// Table 1; its timings are all that may differ between two records of one version.
    pub table1: Vec<DivisionRow>,
    /// Table 2, and the rows and columns of the profiles it leaves out.
    pub table2: Vec<CountRow>,
    /// Compact boxes of nine profiles in four cases.
    pub cases: Vec<CaseRow>,
    /// The nine profiles unfolded into the plane.
    pub unfoldings: Vec<UnfoldingRow>,
    /// The figures.
    pub figures: Vec<FigureRow>,
}

/// A row of table 1.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DivisionRow {
    /// The profile.
    pub model: String,
    /// Nr.
    pub rows: usize,
    /// Nc of case E.
    pub columns: usize,
    /// |R_max| (equation 1).
    pub max_residual: f64,
    /// |R_ave|.
    pub mean_residual: f64,
    /// Wall-clock seconds of the division, the least of five.
    pub seconds: f64,
    /// What the paper prints.
    pub paper: PrintedDivision,
}

/// What table 1 prints of a profile.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PrintedDivision {
    /// Nr.
    pub rows: usize,
    /// Nc.
    pub columns: usize,
    /// |R_max|.
    pub max_residual: f64,
    /// |R_ave|.
    pub mean_residual: f64,
    /// T (s).
    pub seconds: f64,
}

/// A row of table 2.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CountRow {
    /// The profile.
    pub model: String,
    /// Nr.
    pub rows: usize,
    /// Nc in case E, in T, in S and SII.
    pub columns: [usize; 3],
    /// What the paper prints; null where the columns in T, S and SII are ours.
    pub paper: Option<PrintedCounts>,
}

/// What table 2 prints of a profile.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PrintedCounts {
    /// The figure.
    pub figure: String,
    /// Nr.
    pub rows: usize,
    /// Nc in case E, in T, in S and SII.
    pub columns: [usize; 3],
}

/// The compact state of a profile in a case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CaseRow {
    /// The profile.
    pub model: String,
    /// E, T, S or SII.
    pub case: String,
    /// Nr.
    pub rows: usize,
    /// Nc.
    pub columns: usize,
    /// Whether the paper prints neither this Nc nor a figure of it.
    pub columns_ours: bool,
    /// w in units of h.
    pub unit_width: f64,
    /// Equations 3 to 7.
    pub closed_form: BoxReport,
    /// The box of the exact compact state.
    pub exact: BoxReport,
    /// The box of the simulated compact state, without contact; null where it has not been made.
    pub simulated: Option<BoxReport>,
    /// Simulated against closed form, each divided by the closed form or, where that is 0, by h, h², h³.
    pub simulated_error: Option<ErrorReport>,
    /// Of the motion with contact where there is one, else of the motion without: free, touching, penetrating or
    /// undecided; null where neither has been made.
    pub verdict: Option<Verdict>,
    /// The motion without contact.
    pub motion: Option<MotionRow>,
    /// The motion with contact.
    pub certificate: Option<MotionRow>,
}

/// How a motion went.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MotionRow {
    /// free, touching, penetrating or undecided.
    pub verdict: Verdict,
    /// Motion time of the first penetration.
    pub first_penetration_t: Option<f64>,
    /// Smallest distance of facets that share no vertex, in units of h.
    pub min_separation: Option<f64>,
    /// Frames recorded and judged, with straight paths between.
    pub frames: usize,
    /// Whether both stages were run to their end in equilibrium.
    pub converged: bool,
    /// Motion time of the last state.
    pub reached_t: f64,
    /// Motion time at which contact stopped the motion; null where it did not.
    pub jam_t: Option<f64>,
    /// Largest |l/l0 − 1| of all edges and frames.
    pub peak_strain: f64,
    /// The box of the last state, fitted to the exact compact state.
    pub compact: BoxReport,
    /// Root mean square distance of the last state to the exact compact state, in units of h.
    pub rms_to_exact: f64,
    /// That box against the closed form.
    pub error: ErrorReport,
}

/// A profile unfolded into the plane, judged frame by frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct UnfoldingRow {
    /// The profile.
    pub model: String,
    /// Nr.
    pub rows: usize,
    /// `uniform`: all hinge angles are scaled alike; `energy`: descent of the energy of Cantarella et al. (2004).
    pub method: String,
    /// free, touching, penetrating or undecided.
    pub verdict: Verdict,
    /// Part of the way still to go, from 1 to 0, at which the first penetration begins; the part of the hinge angles where
    /// they are scaled.
    pub crosses_at: Option<f64>,
    /// Whether the divided profile was proved not to cross itself at any instant between.
    pub proved: bool,
    /// Frames judged.
    pub frames: usize,
}

/// A figure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FigureRow {
    /// Its name, such as `fig1`.
    pub name: String,
    /// What it shows.
    pub caption: String,
    /// The files in the folder.
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
