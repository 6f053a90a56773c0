//! Why a file cannot be read as a crease pattern.

use foldmotion_geometry::Number;
use thiserror::Error;

use super::source::{Source, listed};
use crate::{FoldError, FrameNumber};

/// Errors of importing a crease pattern; each names the elements, the value found and what would be right.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ImportError {
    /// The file is too large.
    #[error("the file has {size} bytes: at most {limit} are read")]
    TooLarge {
        /// Its bytes.
        size: usize,
        /// The most.
        limit: usize,
    },
    /// Too many of something.
    #[error("there are {found} {what}: at most {limit} are read; thin the pattern")]
    TooMany {
        /// What.
        what: &'static str,
        /// How many were found when reading ended.
        found: usize,
        /// The most.
        limit: usize,
    },
    /// The tolerance of merging is out of range.
    #[error(
        "the merge tolerance is {}: it must lie between 1e-12 and 0.1 of the drawing's diagonal of {}", Number(*value), Number(*diagonal)
    )]
    Tolerance {
        /// The tolerance.
        value: f64,
        /// The diagonal.
        diagonal: f64,
    },
    /// The tolerance of flattened curves is out of range.
    #[error(
        "the tolerance of flattened curves is {}: it must lie between 1e-6 and 0.1 of the diagonal", Number(*value)
    )]
    CurveTolerance {
        /// The tolerance, in parts of the diagonal.
        value: f64,
    },
    /// The percentage of folding is out of range.
    #[error("the fold percentage is {}: it must lie between -1 and 1", Number(*value))]
    Percentage {
        /// The value.
        value: f64,
    },
    /// Not UTF-8.
    #[error("the bytes from {byte} on are no UTF-8")]
    NotUtf8 {
        /// The first bad byte.
        byte: usize,
    },
    /// Not XML, or a document type with entities, which are not read.
    #[error("this is no XML that is read here (entities are not): {message}")]
    Xml {
        /// What is wrong, with line and column.
        message: String,
    },
    /// XML, but no SVG.
    #[error("the root element is <{found}>: an SVG starts with <svg>")]
    NotSvg {
        /// The root element.
        found: String,
    },
    /// An attribute or property of an SVG element that cannot be read.
    #[error("{element}: {name} is {value:?}: {need}")]
    Attribute {
        /// The element.
        element: Source,
        /// The attribute or property.
        name: &'static str,
        /// Its value.
        value: String,
        /// What would be right.
        need: &'static str,
    },
    /// Strokes and elements without a meaning.
    #[error(
        "{} cannot be read: {}; known strokes are #000 border, #f00 mountain, #00f valley, #0f0 cut, #ff0 facet, \
         #f0f free hinge",
        listed(.elements), .reasons.join(", ")
    )]
    Unknown {
        /// The elements, in order.
        elements: Vec<Source>,
        /// Why, each once.
        reasons: Vec<String>,
    },
    /// A pattern too small, too large, or too far from the origin.
    #[error(
        "the pattern is {diagonal:e} across and reaches {farthest:e} from the origin: its diagonal must lie between 1e-30 \
         and 1e30, and the origin no more than a million diagonals away"
    )]
    Extent {
        /// The diagonal.
        diagonal: f64,
        /// The largest coordinate.
        farthest: f64,
    },
    /// No lines at all.
    #[error("there are no lines of a crease pattern")]
    Empty,
    /// Lines that bound nothing.
    #[error("the lines bound no facet: the pattern needs a closed border (#000 in SVG, B in FOLD)")]
    NoFaces,
    /// A border with the sheet on both sides.
    #[error(
        "{element} is a border with the sheet on both sides: draw a cut (#0f0 in SVG, C in FOLD) or a crease instead"
    )]
    BorderInside {
        /// The line.
        element: Source,
    },
    /// Splitting lines does not come to an end.
    #[error(
        "the lines still cross after {passes} rounds of splitting them within {tolerance:e}: use a smaller merge tolerance"
    )]
    Tangled {
        /// Rounds.
        passes: usize,
        /// The tolerance of merging.
        tolerance: f64,
    },
    /// A facet that cannot be cut into triangles.
    #[error(
        "facet {facet}, with {corners} corners and the sides {}, cannot be cut into triangles: it needs an area, and \
         its outline must not cross itself or pass through its own corners",
        listed(.sources)
    )]
    Facet {
        /// Its number.
        facet: usize,
        /// Its corners.
        corners: usize,
        /// Lines around it.
        sources: Vec<Source>,
    },
    /// More than two facets at an edge.
    #[error(
        "facets {facets:?} meet at the edge of vertices {vertices:?} ({}): at most 2 facets may",
        listed(.sources)
    )]
    NonManifold {
        /// The ends.
        vertices: [u32; 2],
        /// The facets.
        facets: Vec<u32>,
        /// The edge.
        sources: Vec<Source>,
    },
    /// Two facets on the same side of an edge: a folded state, or faces on each other.
    #[error(
        "facets {facets:?} lie on the same side of the edge of vertices {vertices:?} ({}): the pattern must be \
         unfolded, with its facets side by side",
        listed(.sources)
    )]
    Overlap {
        /// The ends.
        vertices: [u32; 2],
        /// The facets.
        facets: Vec<u32>,
        /// The edge.
        sources: Vec<Source>,
    },
    /// Pieces that nothing joins.
    #[error("the sheet is in {pieces} pieces, one with {}: only one can be folded", listed(.sources))]
    Disconnected {
        /// How many.
        pieces: usize,
        /// An element of each.
        sources: Vec<Source>,
    },
    /// FOLD that cannot be read.
    #[error(transparent)]
    Fold(#[from] FoldError),
    /// A list of a FOLD frame has another length than what it describes.
    #[error("{key} has {found} entries: {expected} are needed, one for each of {of}")]
    Count {
        /// The list.
        key: String,
        /// Its length.
        found: usize,
        /// The length needed.
        expected: usize,
        /// What it describes.
        of: &'static str,
    },
    /// An assignment that is no letter of FOLD.
    #[error("edges_assignment[{edge}] is {found:?}: B, M, V, F, U, C and J are known")]
    Assignment {
        /// The edge.
        edge: usize,
        /// What stands there.
        found: String,
    },
    /// A fold angle out of range.
    #[error("{key}[{edge}] is {degrees}: fold angles lie between -180 and 180 degrees")]
    FoldAngle {
        /// The list.
        key: String,
        /// The edge.
        edge: usize,
        /// The angle.
        degrees: f64,
    },
    /// A unit of length that FOLD does not know.
    #[error("frame_unit is {found:?}: unit, in, pt, m, cm, mm, um and nm are known")]
    Unit {
        /// What stands there.
        found: String,
    },
    /// A shape that is not flat.
    #[error(
        "{frame} is not flat: vertex {vertex} lies {height:e} off the plane of the others, more than {limit:e}; only a \
         flat crease pattern can be folded, in the key frame or in a frame of the class creasePattern"
    )]
    NotFlat {
        /// The frame.
        frame: FrameNumber,
        /// The vertex farthest off.
        vertex: usize,
        /// How far.
        height: f64,
        /// What is taken.
        limit: f64,
    },
}
