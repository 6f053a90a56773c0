//! `[pattern]`: a crease pattern of a file.

use foldmotion_pattern::Unknown;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::scene::LengthUnit;
use crate::scene::choice;

/// `[pattern]`: a crease pattern of a file, in place of `[profile]`, `[sheet]` and `[division]`.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PatternScene {
    /// The file, beside the scene: .fold, or .svg in Origami Simulator's colours.
    pub file: String,
    /// What a length of 1 in the file is; what the file says where left out.
    #[serde(default, deserialize_with = "choice::optional")]
    pub unit: Option<LengthUnit>,
    /// How far it folds, in percent of its fold angles, from -100 to 100 (inside out); 100 where left out.
    pub fold_percent: Option<f64>,
    /// Whether the frames of a FOLD file that have fold angles are the stages of the motion, which then ends with the
    /// last; true where left out.
    pub stages: Option<bool>,
    /// Ends of lines up to this far apart, in lengths of the file, are one vertex; 1e-4 of the diagonal of an SVG and 1e-9
    /// of that of a FOLD file where left out.
    pub vertex_tolerance: Option<f64>,
    /// What becomes of strokes and elements that mean nothing in a crease pattern; `refuse` where left out.
    #[serde(default, deserialize_with = "choice::optional")]
    pub unknown: Option<Unknown>,
    /// Bézier curves become chords that stray from them by no more than this, in parts of the diagonal; without it they are
    /// unknown elements.
    pub curve_tolerance: Option<f64>,
    /// The index of the facet that stays in place, as a list of one; an empty one for none; what the file says where left
    /// out.
    pub fixed: Option<Vec<i64>>,
}
