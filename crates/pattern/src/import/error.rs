//! Why a file cannot be read as a crease pattern.

use foldmotion_geometry::Number;
use thiserror::Error;

use super::source::{Source, listed};
use crate::{FoldError, FrameNumber};

impl ImportError {
    /// Whether another merge tolerance may help.
    pub(super) fn is_tangle(&self) -> bool {
        matches!(self, Self::Tangled { .. })
    }
}

/// Errors of importing a crease pattern; each names the elements, the value found and what would be right.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ImportError {
    /// The file is too large.
    #[error("the file has {size} bytes: at most {limit} are read")]
    TooLarge {
        /// The size of the file, bytes.
        size: usize,
        /// The largest number allowed.
        limit: usize,
    },
    /// Too many of something.
    #[error("there are {found} {what}: at most {limit} are read; thin the pattern")]
    TooMany {
        /// The name of the elements that are too many.
        what: &'static str,
        /// The number found when reading ended.
        found: usize,
        /// The largest number allowed.
        limit: usize,
    },
    /// The tolerance of merging is out of range.
    #[error(
        "the merge tolerance is {}: it must lie between 1e-12 and 0.1 of the drawing's diagonal of {}", Number(*value), Number(*diagonal)
    )]
    Tolerance {
        /// The tolerance that was given.
        value: f64,
        /// The diagonal of the drawing.
        diagonal: f64,
    },
    /// The tolerance of flattened curves is out of range.
    #[error(
        "pattern.curve_tolerance, the tolerance of curves, is {}: it must lie between 1e-6 and 0.1 of the diagonal",
        Number(*value)
    )]
    CurveTolerance {
        /// The tolerance, in parts of the diagonal.
        value: f64,
    },
    /// The percentage of folding is out of range.
    #[error("the fold percentage is {}: it must lie between -1 and 1", Number(*value))]
    Percentage {
        /// The value that was given.
        value: f64,
    },
    /// No crease pattern by its content and its extension.
    #[error(
        "this is no crease pattern that is read: FOLD (.fold, JSON), SVG, ORIPA and Oriedita (.cp, .opx), Orihime \
         (.orh), OBJ with lines and ASCII DXF are"
    )]
    Format,
    /// A line of a text file that cannot be read.
    #[error("line {line}: {value:?}: {need}")]
    Line {
        /// The line, counted from 1.
        line: usize,
        /// What the file has there.
        value: String,
        /// What is needed instead.
        need: &'static str,
    },
    /// Not UTF-8.
    #[error("the bytes from {byte} on are not UTF-8")]
    NotUtf8 {
        /// The index of the first byte that is not UTF-8.
        byte: usize,
    },
    /// Not UTF-16, which the file starts as.
    #[error("the file starts as UTF-16, but is cut off or has letters that are not UTF-16")]
    NotUtf16,
    /// Entities by which the file could grow without bound.
    #[error("the entities of the document type are not read: {reason}; save the file without them")]
    Entities {
        /// What is wrong with them.
        reason: &'static str,
    },
    /// Not XML.
    #[error("this is not XML: {message}")]
    Xml {
        /// What is wrong, with line and column.
        message: String,
    },
    /// XML, but not SVG.
    #[error("the root element is <{found}>: an SVG starts with <svg>")]
    NotSvg {
        /// The name of the root element.
        found: String,
    },
    /// An attribute or property of an SVG element that cannot be read.
    #[error("{element}: {name} is {value:?}: {need}")]
    Attribute {
        /// The element with the error.
        element: Source,
        /// The attribute or property.
        name: &'static str,
        /// The value as the file has it.
        value: String,
        /// What is needed instead.
        need: &'static str,
    },
    /// Strokes and elements without a meaning.
    #[error(
        "{} cannot be read: {}; known strokes are #000 border, #f00 mountain, #00f valley, #0f0 cut, #ff0 facet, \
         #f0f free hinge; pattern.unknown = \"ignore\" leaves out what cannot be read",
        listed(.elements), .reasons.join(", ")
    )]
    Unknown {
        /// The elements concerned, in the order of the file.
        elements: Vec<Source>,
        /// The reasons, each listed once.
        reasons: Vec<String>,
    },
    /// A pattern too small, too large, or too far from the origin.
    #[error(
        "the pattern is {diagonal:e} across and reaches {farthest:e} from the origin: its diagonal must lie between 1e-30 \
         and 1e30, and the origin no more than a thousand million diagonals away"
    )]
    Extent {
        /// The diagonal of the drawing.
        diagonal: f64,
        /// The largest coordinate by absolute value.
        farthest: f64,
    },
    /// The file has no lines.
    #[error("there are no lines of a crease pattern")]
    Empty,
    /// Lines that bound nothing.
    #[error("the lines bound no facet: the pattern needs a closed border (#000 in SVG, B in FOLD)")]
    NoFaces,
    /// Most creases would be left out.
    #[error(
        "of creases {} long, {} would be left out, for they end nowhere ({}): lines that miss each other by more than {} \
         do not meet; set pattern.vertex_tolerance to more than the largest miss",
        Number(*length), Number(*dropped), listed(.sources), Number(*tolerance)
    )]
    MostDropped {
        /// The length of the creases that would be left out, in units of the file.
        dropped: f64,
        /// The length of all creases, in units of the file.
        length: f64,
        /// The tolerance of merging, in units of the file.
        tolerance: f64,
        /// The first of the creases.
        sources: Vec<Source>,
    },
    /// Splitting lines does not come to an end.
    #[error(
        "the lines still cross after {passes} rounds of splitting them within {tolerance:e}: use a smaller merge tolerance"
    )]
    Tangled {
        /// The number of passes over all lines.
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
        /// The index of the facet.
        facet: usize,
        /// The number of corners of the face.
        corners: usize,
        /// The lines around the facet.
        sources: Vec<Source>,
    },
    /// More than two facets at an edge.
    #[error(
        "facets {facets:?} meet at the edge of vertices {vertices:?} ({}): at most 2 facets may",
        listed(.sources)
    )]
    NonManifold {
        /// The vertices at the ends of the edge.
        vertices: [u32; 2],
        /// The facets that meet at the edge.
        facets: Vec<u32>,
        /// The elements that the edge comes from.
        sources: Vec<Source>,
    },
    /// Two facets on the same side of an edge: a folded state, or faces on each other.
    #[error(
        "facets {facets:?} lie on the same side of the edge of vertices {vertices:?} ({}): the pattern must be \
         unfolded, with its facets side by side",
        listed(.sources)
    )]
    Overlap {
        /// The vertices at the ends of the edge.
        vertices: [u32; 2],
        /// The facets that meet at the edge.
        facets: Vec<u32>,
        /// The elements that the edge comes from.
        sources: Vec<Source>,
    },
    /// No piece has the name that was asked for.
    #[error(
        "no piece of the sheet is called {name:?}: it has the pieces 0 to {}, one with {}; pattern.piece also takes the \
         id or class of a line, \"main\", \"largest\" and \"all\"",
        .sources.len().saturating_sub(1), listed(.sources)
    )]
    Piece {
        /// The name that was asked for.
        name: String,
        /// One element of each piece.
        sources: Vec<Source>,
    },
    /// FOLD that cannot be read.
    #[error(transparent)]
    Fold(#[from] FoldError),
    /// A list of a FOLD frame has another length than what it describes.
    #[error("{key} has {found} entries: {expected} are needed, one for each of {of}")]
    Count {
        /// The FOLD key of the list.
        key: String,
        /// The number of entries of the list.
        found: usize,
        /// The number of entries needed.
        expected: usize,
        /// The elements that the list describes.
        of: &'static str,
    },
    /// An assignment that is no letter of FOLD.
    #[error("edges_assignment[{edge}] is {found:?}: B, M, V, F, U, C and J are known")]
    Assignment {
        /// The index of the edge.
        edge: usize,
        /// The text found there.
        found: String,
    },
    /// A fold angle out of range.
    #[error("{key}[{edge}] is {degrees}: fold angles lie between -180 and 180 degrees")]
    FoldAngle {
        /// The FOLD key of the list.
        key: String,
        /// The index of the edge.
        edge: usize,
        /// The fold angle, degrees.
        degrees: f64,
    },
    /// The stages of a recorded motion cannot be read.
    #[error(
        "foldmotion:stages: {message}; a list of lists of fold angles is needed, one entry for each edge"
    )]
    RecordedStages {
        /// What is wrong.
        message: String,
    },
    /// A unit of length that FOLD does not know.
    #[error("frame_unit is {found:?}: unit, in, pt, m, cm, mm, um and nm are known")]
    Unit {
        /// The text found there.
        found: String,
    },
    /// A shape that is not flat, without faces by which it could be laid out flat.
    #[error(
        "{frame} is not flat: vertex {vertex} lies {height:e} off the plane of the others, more than {limit:e}; give the \
         flat pattern in a frame of the class creasePattern, or faces_vertices, by which the shape is unfolded"
    )]
    NotFlat {
        /// The frame with the error.
        frame: FrameNumber,
        /// The vertex farthest from the plane.
        vertex: usize,
        /// The distance of that vertex from the plane.
        height: f64,
        /// The largest distance allowed.
        limit: f64,
    },
    /// A folded shape whose facets cannot be laid out flat side by side.
    #[error(
        "{frame} is folded in space and cannot be laid out flat: laid side by side, its faces place vertex {vertex} at \
         points {gap:e} apart, more than {limit:e}; cut edges (C) open the sheet, and a frame of the class \
         creasePattern gives its flat pattern"
    )]
    NotDevelopable {
        /// The frame with the shape.
        frame: FrameNumber,
        /// The vertex that two faces place apart.
        vertex: usize,
        /// How far apart.
        gap: f64,
        /// The largest distance allowed.
        limit: f64,
    },
}
