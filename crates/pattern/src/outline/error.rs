//! What can be wrong with an outline file.

use thiserror::Error;

/// What can be wrong with an outline file; lines count from 1.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum OutlineError {
    /// The ending names no format.
    #[error(
        "the ending {ending:?} names no outline format; use .csv (x, z a line), .dat (airfoil) or .dxf (polyline)"
    )]
    UnknownEnding {
        /// What the file's name ends with.
        ending: String,
    },
    /// The file cannot be read.
    #[error("cannot be read: {message}")]
    Read {
        /// Why.
        message: String,
    },
    /// The file is too large.
    #[error("it has {size} bytes; at most {limit} are read: thin the outline")]
    TooLarge {
        /// Its bytes.
        size: u64,
        /// The most.
        limit: u64,
    },
    /// A coordinate is no number.
    #[error("line {line}: {value:?} is no finite number")]
    NotANumber {
        /// Where.
        line: usize,
        /// What stands there.
        value: String,
    },
    /// A line does not hold two coordinates.
    #[error("line {line}: {count} values; two are needed, x and z")]
    NotAPoint {
        /// Where.
        line: usize,
        /// How many values stand there.
        count: usize,
    },
    /// The file holds no points.
    #[error("it holds no points; {expected}")]
    Empty {
        /// What was looked for.
        expected: &'static str,
    },
    /// An airfoil in Lednicer's order has other numbers of points than it announces.
    #[error(
        "line {line}: {upper} points of the upper and {lower} of the lower side are announced, but {found} points follow"
    )]
    PointCounts {
        /// Where the numbers stand.
        line: usize,
        /// Points of the upper side.
        upper: f64,
        /// Points of the lower side.
        lower: f64,
        /// Points in the file.
        found: usize,
    },
    /// A drawing in DXF's binary form.
    #[error("it is a binary DXF; save it as ASCII DXF")]
    BinaryDxf,
    /// A DXF file is not made of pairs of group code and value.
    #[error("line {line}: {value:?} is no group code; is this an ASCII DXF?")]
    GroupCode {
        /// Where.
        line: usize,
        /// What stands there.
        value: String,
    },
    /// A DXF file has no end.
    #[error("line {line}: the drawing ends here without EOF: the file was cut off; save it again")]
    CutOff {
        /// Its last line.
        line: usize,
    },
    /// A polyline has another number of vertices than it announces.
    #[error(
        "line {line}: the polyline announces {announced} vertices (code 90), but {found} follow; save the drawing again"
    )]
    VertexCount {
        /// Where it begins.
        line: usize,
        /// What it announces.
        announced: usize,
        /// What there is.
        found: usize,
    },
    /// A drawing without polyline holds a curve.
    #[error(
        "line {line}: {entity} is not read; turn it into one LWPOLYLINE of straight segments (in most programs: explode or \
         flatten, then join)"
    )]
    Entity {
        /// Where.
        line: usize,
        /// What stands there.
        entity: &'static str,
    },
    /// More than two segments meet.
    #[error(
        "line {line}: more than two LINEs meet at an end of this one; leave the one chain that is the profile"
    )]
    Branch {
        /// Where one of them begins.
        line: usize,
    },
    /// Segments that do not meet the others.
    #[error(
        "line {line}: this LINE is not joined to the chain of the others; leave one chain, the profile, without gaps"
    )]
    SeveralChains {
        /// Where it begins.
        line: usize,
    },
    /// A drawing holds several polylines.
    #[error(
        "it holds {count} polylines (the second one starts at line {line}); leave one, the profile"
    )]
    SeveralPolylines {
        /// How many.
        count: usize,
        /// Where the second one starts.
        line: usize,
    },
    /// A polyline has arcs.
    #[error(
        "line {line}: the polyline has an arc (bulge {value}); only straight segments are read: turn arcs into points first"
    )]
    Bulge {
        /// Where.
        line: usize,
        /// The bulge.
        value: String,
    },
    /// A polyline is fitted by a spline in the drawing.
    #[error(
        "line {line}: the polyline is curve-fitted or a mesh (flags {flags}); decompose it into a plain polyline"
    )]
    CurvedPolyline {
        /// Where.
        line: usize,
        /// Group code 70.
        flags: u32,
    },
}
