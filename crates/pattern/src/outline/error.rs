//! What can be wrong with an outline file.

use thiserror::Error;

/// Errors of reading an outline file; lines count from 1.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum OutlineError {
    /// The ending names no format.
    #[error(
        "the ending {ending:?} names no outline format; use .csv (x, z a line), .dat (airfoil) or .dxf (polyline)"
    )]
    UnknownEnding {
        /// The ending of the file name.
        ending: String,
    },
    /// The file cannot be read.
    #[error("cannot be read: {message}")]
    Read {
        /// The reason, as the system or library gave it.
        message: String,
    },
    /// The file is too large.
    #[error("it has {size} bytes; at most {limit} are read: thin the outline")]
    TooLarge {
        /// The size of the file, bytes.
        size: u64,
        /// The largest number allowed.
        limit: u64,
    },
    /// A coordinate is not a number.
    #[error("line {line}: {value:?} is not a finite number")]
    NotANumber {
        /// The number of the line in the file, from 1.
        line: usize,
        /// The text found there.
        value: String,
    },
    /// A line does not hold two coordinates.
    #[error("line {line}: {count} values; two are needed, x and z")]
    NotAPoint {
        /// The number of the line in the file, from 1.
        line: usize,
        /// The number of values found there.
        count: usize,
    },
    /// The file holds no points.
    #[error("it holds no points; {expected}")]
    Empty {
        /// What the file should have contained.
        expected: &'static str,
    },
    /// An airfoil in Lednicer's order has other numbers of points than it announces.
    #[error(
        "line {line}: {upper} points of the upper and {lower} of the lower side are announced, but {found} points follow"
    )]
    PointCounts {
        /// The number of the line with the two counts, from 1.
        line: usize,
        /// Points of the upper side.
        upper: f64,
        /// Points of the lower side.
        lower: f64,
        /// The number of points in the file.
        found: usize,
    },
    /// A drawing in DXF's binary form.
    #[error("it is a binary DXF; save it as ASCII DXF")]
    BinaryDxf,
    /// A DXF file is not made of pairs of group code and value.
    #[error("line {line}: {value:?} is not a group code; is this an ASCII DXF?")]
    GroupCode {
        /// The number of the line in the file, from 1.
        line: usize,
        /// The text found there.
        value: String,
    },
    /// A DXF file has no end.
    #[error("line {line}: the drawing ends here without EOF: the file was cut off; save it again")]
    CutOff {
        /// The number of the last line of the file.
        line: usize,
    },
    /// A polyline has another number of vertices than it announces.
    #[error(
        "line {line}: the polyline announces {announced} vertices (code 90), but {found} follow; save the drawing again"
    )]
    VertexCount {
        /// The number of the line where it begins, from 1.
        line: usize,
        /// The number of vertices that it announces.
        announced: usize,
        /// The number of vertices found.
        found: usize,
    },
    /// A drawing without polyline holds a curve.
    #[error(
        "line {line}: {entity} is not read; turn it into one LWPOLYLINE of straight segments (in most programs: explode or \
         flatten, then join)"
    )]
    Entity {
        /// The number of the line in the file, from 1.
        line: usize,
        /// The kind of entity found there.
        entity: &'static str,
    },
    /// More than two segments meet.
    #[error(
        "line {line}: more than two LINEs meet at an end of this one; leave the one chain that is the profile"
    )]
    Branch {
        /// The number of the line where one of them begins.
        line: usize,
    },
    /// Segments that do not meet the others.
    #[error(
        "line {line}: this LINE is not joined to the chain of the others; leave one chain, the profile, without gaps"
    )]
    SeveralChains {
        /// The number of the line where it begins, from 1.
        line: usize,
    },
    /// A drawing holds several polylines.
    #[error(
        "it holds {count} polylines (the second one starts at line {line}); leave one, the profile"
    )]
    SeveralPolylines {
        /// The number of separate curves.
        count: usize,
        /// The number of the line where the second one starts.
        line: usize,
    },
    /// A polyline has arcs.
    #[error(
        "line {line}: the polyline has an arc (bulge {value}); only straight segments are read: turn arcs into points first"
    )]
    Bulge {
        /// The number of the line in the file, from 1.
        line: usize,
        /// The bulge of the polyline segment.
        value: String,
    },
    /// A polyline is fitted by a spline in the drawing.
    #[error(
        "line {line}: the polyline is curve-fitted or a mesh (flags {flags}); decompose it into a plain polyline"
    )]
    CurvedPolyline {
        /// The number of the line in the file, from 1.
        line: usize,
        /// The flags of the polyline, group code 70.
        flags: u32,
    },
}
