//! How a crease pattern is read, and how much of one.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::ImportError;

/// The most bytes of a file.
pub const LARGEST_IMPORT_FILE: usize = 16 << 20;
/// The most lines drawn, before they are split at crossings; the most edges of a FOLD file.
pub const MOST_LINES: usize = 50_000;
/// The most lines after splitting.
pub const MOST_PIECES: usize = 200_000;
/// The most vertices of a FOLD file.
pub const MOST_VERTICES: usize = 200_000;
/// The most elements, texts and comments of an SVG.
pub const MOST_NODES: u32 = 200_000;
/// The deepest nesting of elements of an SVG.
pub const MOST_NESTED: usize = 256;
/// The most rules of the style sheets of an SVG.
pub const MOST_STYLE_RULES: usize = 200;
/// The most fold angles in all frames of a FOLD file together.
pub const MOST_STAGE_ANGLES: usize = 10_000_000;

/// How far apart two points may lie to be one vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MergeTolerance {
    /// In parts of the diagonal of the drawing's bounding box, between 1e-12 and 0.1.
    Relative(f64),
    /// In the drawing's own units, before it is scaled to its physical size: Origami Simulator takes 3.
    Absolute(f64),
    /// From the drawing, between a millionth of the diagonal and 1/200: `least` unless another loses fewer lines.
    Chosen {
        /// The tolerance of a drawing without near misses, in parts of the diagonal.
        least: f64,
    },
}

impl MergeTolerance {
    /// For drawings: at least a tenth of a thousandth of the diagonal, 0.03 mm on a sheet of paper.
    pub const DRAWING: Self = Self::Chosen { least: 1e-4 };
    /// For files that list their vertices.
    pub const LISTED: Self = Self::Chosen { least: 1e-6 };

    /// The length, for a drawing with this diagonal whose units are `scale` long.
    pub(super) fn length(self, diagonal: f64, scale: f64) -> Result<f64, ImportError> {
        let relative = match self {
            Self::Relative(part) | Self::Chosen { least: part } => part,
            Self::Absolute(length) => length * scale / diagonal,
        };
        // Relative bounds keep every vertex apart in f64 and the drawing from falling into one.
        if (1e-12..=0.1).contains(&relative) {
            Ok(relative * diagonal)
        } else {
            Err(ImportError::Tolerance { value: relative * diagonal, diagonal })
        }
    }
}

/// What happens to elements that cannot be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum UnknownElements {
    /// Lines in other colours are auxiliary lines and are left out with a warning; the file is refused for anything else
    /// that cannot be read.
    #[default]
    Auxiliary,
    /// The file is refused, also for lines in other colours; the error names every such element.
    Refuse,
    /// Such elements are left out; a warning names them.
    Ignore,
}

/// How facets beside curved creases are cut into triangles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum CurvedFacets {
    /// Along lines that meet curved creases as nearly at right angles as they can, the rulings of a curved fold, so that
    /// the facets can bend; rulings that end on a straight border end in a vertex of their own there.
    #[default]
    Rulings,
    /// By the constrained Delaunay triangulation, as all other facets.
    Delaunay,
}

/// Which pieces of a drawing are read, if it has several that nothing joins.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Pieces {
    /// The one with the largest area and those at least half as large, side by side.
    #[default]
    Main,
    /// The one with the largest area.
    Largest,
    /// All of them, side by side.
    All,
    /// The one with a line of this id or class, or with this number, counted from 0 in the order of the file.
    Named(String),
}

/// How far chords stray from the curves they replace by default, in parts of the diagonal of the drawing.
pub const CURVE_TOLERANCE: f64 = 1e-3;

/// The options of reading a crease pattern.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ImportOptions {
    /// How far apart two points may lie to be one vertex; [`MergeTolerance::DRAWING`] in drawings and
    /// [`MergeTolerance::LISTED`] in FOLD if omitted.
    pub merge: Option<MergeTolerance>,
    /// What happens to strokes and elements that have no meaning here.
    pub unknown: UnknownElements,
    /// Curves become chords that stray from them by no more than this, in parts of the diagonal of the drawing, 1e-6 to
    /// 0.1; [`CURVE_TOLERANCE`] if omitted.
    pub curve_tolerance: Option<f64>,
    /// How facets beside curved creases are cut into triangles.
    pub curved_facets: CurvedFacets,
    /// Which pieces are read.
    pub pieces: Pieces,
}
