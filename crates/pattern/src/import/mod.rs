//! Crease patterns of others: FOLD 1.0 to 1.2, and drawings (SVG, `.cp`, `.opx`, `.orh`, OBJ and DXF).
//!
//! A file becomes a drawing: lines that are border, cut, mountain, valley, free hinge or facet line, each with its
//! target fold angle. Ends that nearly meet become one vertex, within a tolerance chosen from the drawing; lines are split
//! where they cross and touch, and lines that end nowhere are left out. The faces of the planar graph that lie inside the
//! border are the facets; they are cut into triangles, and cuts are opened. FOLD files whose listed faces fit their edges
//! skip the drawing.
//!
//! [`ImportedPattern::warnings`] name the elements that are changed or left out, [`ImportedPattern::mending`] counts what
//! was done about near misses and which creases are lost.
//!
//! **Flat only.** The solver takes its rest lengths and its flat facets from [`Sheet`](crate::Sheet)'s positions in the plane, so the
//! pattern must be flat. A FOLD file whose key frame is not in the plane z = 0 is turned into it if its vertices lie in
//! some plane, unless one of its frames has the class `creasePattern`: that frame is read then. A folded shape is laid out
//! flat by its faces; without faces it is refused ([`ImportError::NotFlat`]).
//!
//! **Bounds.** Files up to [`LARGEST_IMPORT_FILE`] bytes, [`MOST_LINES`] lines before and [`MOST_PIECES`] after splitting,
//! [`MOST_VERTICES`] vertices; of SVG [`MOST_NODES`] nodes, [`MOST_NESTED`] deep, [`MOST_STYLE_RULES`] style rules; of FOLD
//! [`MOST_STAGE_ANGLES`] fold angles of stages. Memory is bounded by some fifty times the file.

mod assemble;
mod border;
mod colour;
mod drawing;
mod drawn;
mod dxf;
mod encoding;
mod entities;
mod entries;
mod error;
mod fold;
mod format;
mod grid;
mod imported;
mod layer_names;
mod loops;
mod mending;
mod names;
mod obj;
mod open_cuts;
mod options;
mod orihime;
mod oripa;
mod paper_grid;
mod pieces;
mod plan;
mod predicate;
mod prune;
mod rulings;
mod source;
mod split;
mod stroke;
mod svg;
mod tolerance;
mod triangles;
mod unit;
mod unread;
mod vertices;
mod warning;
mod write_fold;

pub use error::ImportError;
pub use fold::import_fold;
pub use format::{PatternFileFormat, import_pattern};
pub use imported::{ImportedPattern, PatternStage};
pub use mending::{DroppedCrease, Mending};
pub use names::Names;
pub use options::{
    CURVE_TOLERANCE, CurvedFacets, ImportOptions, LARGEST_IMPORT_FILE, MOST_LINES, MOST_NESTED,
    MOST_NODES, MOST_PIECES, MOST_STAGE_ANGLES, MOST_STYLE_RULES, MOST_VERTICES, MergeTolerance,
    Pieces, UnknownElements,
};
pub use source::Source;
pub use svg::import_svg;
pub use unit::LengthUnit;
pub use warning::{Warning, WarningKind};

use glam::DVec2;

use drawing::Drawing;
use plan::Plan;
use warning::Warnings;

/// The least diagonal of a pattern; its inverse is the longest.
const LEAST_DIAGONAL: f64 = 1e-30;
/// How far from the origin a pattern is left, in diagonals.
const FAR: f64 = 1e3;
/// How far from the origin a pattern may lie, in diagonals.
const FARTHEST: f64 = 1e9;

/// The facets of a drawing, with what was mended in the units of its points.
///
/// `scale`: how long its own unit is in the units of its points. `joins`: whether straight lines in pieces are joined.
fn plan_of(
    mut drawing: Drawing,
    merge: MergeTolerance,
    scale: f64,
    joins: bool,
    warnings: &mut Warnings,
) -> Result<Plan, ImportError> {
    let [low, high] = drawing.bounds().ok_or(ImportError::Empty)?;
    if drawing.lines.len() > MOST_LINES {
        return Err(ImportError::TooMany {
            what: "lines",
            found: drawing.lines.len(),
            limit: MOST_LINES,
        });
    }
    let diagonal = check_extent(low, high)?;
    near_origin(&mut drawing.points, [low, high]);
    let mut graph = tolerance::mended(&drawing, merge, diagonal, scale, warnings)?;
    if joins {
        graph.join_straight(graph.mending.tolerance, &drawing.sources, warnings);
    }
    plan::plan(graph, drawing.sources, warnings)
}

/// The diagonal of a pattern between two corners.
///
/// # Errors
/// [`ImportError::Extent`] where it is too small, too large, or too far from the origin for f64 to tell its points apart.
fn check_extent(low: DVec2, high: DVec2) -> Result<f64, ImportError> {
    let diagonal = low.distance(high);
    let farthest = low.abs().max(high.abs()).max_element();
    if (LEAST_DIAGONAL..=1.0 / LEAST_DIAGONAL).contains(&diagonal)
        && farthest <= FARTHEST * diagonal
    {
        return Ok(diagonal);
    }
    Err(ImportError::Extent { diagonal, farthest })
}

/// Moves points that lie far from the origin, in their extents, there by the lower corner of their bounds: f64 tells near
/// points apart best.
fn near_origin(points: &mut [DVec2], [low, high]: [DVec2; 2]) {
    if low.abs().max(high.abs()).max_element() > FAR * low.distance(high) {
        for point in points {
            *point -= low;
        }
    }
}

/// Refuses files above the limit.
fn check_size(bytes: &[u8]) -> Result<(), ImportError> {
    if bytes.len() <= LARGEST_IMPORT_FILE {
        return Ok(());
    }
    Err(ImportError::TooLarge { size: bytes.len(), limit: LARGEST_IMPORT_FILE })
}
