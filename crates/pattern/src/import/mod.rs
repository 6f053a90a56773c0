//! Crease patterns of others: FOLD 1.0 to 1.2, and drawings (SVG, `.cp`, `.opx`, `.orh`, OBJ and DXF).
//!
//! A file becomes a drawing: lines that are border, cut, mountain, valley, free hinge or facet line, each with its
//! target fold angle. Ends that nearly meet become one vertex, lines are split where they cross and touch, and lines that
//! end nowhere are left out. The faces of the planar graph that lie inside the border are the facets; they are cut into
//! triangles, and cuts are opened. FOLD files that list their faces skip the drawing.
//!
//! [`ImportedPattern::warnings`] name the elements that are changed or left out.
//!
//! **Flat only.** The solver takes its rest lengths and its flat facets from [`Sheet`](crate::Sheet)'s positions in the plane, so the
//! pattern must be flat. A FOLD file whose key frame is not in the plane z = 0 is turned into it if its vertices lie in
//! some plane, and refused otherwise ([`ImportError::NotFlat`]), unless one of its frames has the class
//! `creasePattern`: that frame is read then.
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
mod names;
mod obj;
mod open_cuts;
mod options;
mod orihime;
mod oripa;
mod pieces;
mod plan;
mod predicate;
mod prune;
mod rulings;
mod source;
mod split;
mod stroke;
mod svg;
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
/// How far from the origin a pattern may lie, in diagonals.
const FARTHEST: f64 = 1e6;

/// The facets of a drawing.
///
/// `scale`: how long its own unit is in the units of its points. `joins`: whether straight lines in pieces are joined.
fn plan_of(
    drawing: Drawing,
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
    let tolerance = merge.length(diagonal, scale)?;
    let mut graph = split::planar_graph(&drawing, tolerance, warnings)?;
    graph.drop_strays(&drawing.sources, warnings);
    if joins {
        graph.join_straight(tolerance, &drawing.sources, warnings);
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

/// Refuses files above the limit.
fn check_size(bytes: &[u8]) -> Result<(), ImportError> {
    if bytes.len() <= LARGEST_IMPORT_FILE {
        return Ok(());
    }
    Err(ImportError::TooLarge { size: bytes.len(), limit: LARGEST_IMPORT_FILE })
}
