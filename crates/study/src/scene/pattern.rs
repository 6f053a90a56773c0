//! `[pattern]`: a crease pattern from a file.

use foldmotion_pattern::{CurvedFacets, UnknownElements};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::scene::LengthUnit;
use crate::scene::choice;

/// `[pattern]`: a crease pattern from a file, instead of `[profile]`, `[sheet]` and `[division]`.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PatternScene {
    /// The file, next to the scene: FOLD, SVG in the colours of Origami Simulator, .cp or .opx of ORIPA and Oriedita, .orh
    /// of Orihime, OBJ with lines, or ASCII DXF by layers and colours. Its content decides how it is read.
    pub file: String,
    /// The length that 1 stands for in the file.
    #[serde(default, deserialize_with = "choice::optional")]
    #[schemars(extend("x-default" = "what the file says"))]
    pub unit: Option<LengthUnit>,
    /// How far the pattern folds, as a percentage of its fold angles; negative values fold it inside out.
    #[schemars(extend("default" = 100.0, "x-unit" = "%", "minimum" = -100, "maximum" = 100))]
    pub fold_percent: Option<f64>,
    /// Whether the frames of a FOLD file that have fold angles are stages of the motion, which then ends with the
    /// last of them.
    #[schemars(extend("default" = true))]
    pub stages: Option<bool>,
    /// Ends of lines that are at most this far apart are the same vertex.
    #[schemars(extend("x-default" = "chosen from the drawing: 1e-4 to 1/200 of the diagonal, from 1e-6 on in a FOLD file", "x-unit" = "lengths of the file"))]
    pub vertex_tolerance: Option<f64>,
    /// How lines and elements without a meaning in a crease pattern are treated.
    #[serde(default, deserialize_with = "choice::optional")]
    #[schemars(extend("default" = "auxiliary"))]
    pub unknown: Option<UnknownElements>,
    /// Curves are replaced by chords that stray from them by at most this part of the diagonal.
    #[schemars(extend("default" = 1e-3, "minimum" = 1e-6, "maximum" = 0.1))]
    pub curve_tolerance: Option<f64>,
    /// How facets beside curved creases are cut into triangles.
    #[serde(default, deserialize_with = "choice::optional")]
    #[schemars(extend("default" = "rulings"))]
    pub curved_facets: Option<CurvedFacets>,
    /// Which pieces are folded, if nothing joins all pieces of the drawing: `main`, the largest and those at least half
    /// as large side by side; `largest`; `all`; the number of one, counted from 0 in the order of the file; or the id or
    /// class of one of its lines.
    #[schemars(extend("default" = "main"))]
    pub piece: Option<String>,
    /// The index of the facet that stays in place, as a list with one element; an empty list for none.
    #[schemars(extend("x-default" = "what the file says"))]
    pub fixed: Option<Vec<i64>>,
}
