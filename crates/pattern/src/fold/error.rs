//! Why a FOLD file cannot be read as a motion.

use std::fmt;

use thiserror::Error;

/// A frame by its FOLD number: 0 is the key frame, k + 1 is `file_frames[k]`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FrameNumber(pub usize);

impl fmt::Display for FrameNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0.checked_sub(1) {
            None => write!(f, "the key frame"),
            Some(index) => write!(f, "file_frames[{index}]"),
        }
    }
}

/// Errors of reading FOLD; each names the element, the value found and what would be right.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum FoldError {
    /// Not JSON, not UTF-8, a key given twice, or a value of the wrong type or out of range.
    #[error("{location}: {message}")]
    Json {
        /// The frame, key and list element that was being read.
        location: String,
        /// What is wrong, with line and column.
        message: String,
    },
    /// A key that is needed is absent or empty.
    #[error("{frame} has no {key}: {need}")]
    Missing {
        /// Where.
        frame: FrameNumber,
        /// The key.
        key: &'static str,
        /// What would be right.
        need: &'static str,
    },
    /// A list has another length than what it describes.
    #[error("{frame}: {key} has {found} entries: {expected} are needed, one for each of {of}")]
    Count {
        /// Where.
        frame: FrameNumber,
        /// The list.
        key: &'static str,
        /// Its length.
        found: usize,
        /// The length needed.
        expected: usize,
        /// What it describes.
        of: &'static str,
    },
    /// A frame with other faces than the key frame.
    #[error("{frame} has other faces_vertices than the key frame: one sheet must move throughout")]
    OtherTopology {
        /// The frame.
        frame: FrameNumber,
    },
    /// A frame inherits from itself, from a later frame or from none.
    #[error(
        "{frame} inherits from frame {parent}: frame_parent must be 0 (the key frame) or an earlier frame, below {number}",
        number = frame.0
    )]
    Parent {
        /// The frame.
        frame: FrameNumber,
        /// Its `frame_parent`, or `none`.
        parent: String,
    },
    /// Too many frames are needed again later by frames that inherit their coordinates.
    #[error(
        "{frame} is the {held}th frame whose coordinates later frames inherit: at most {limit} can be held at a time"
    )]
    HeldFrames {
        /// The frame.
        frame: FrameNumber,
        /// Frames held.
        held: usize,
        /// The most that are.
        limit: usize,
    },
    /// A corner or end that does not exist.
    #[error("{key}[{element}] names vertex {vertex}: there are {vertices} vertices")]
    VertexOutOfRange {
        /// The list.
        key: &'static str,
        /// The face or edge.
        element: usize,
        /// The vertex.
        vertex: u32,
        /// How many there are.
        vertices: usize,
    },
    /// An entry of `faceOrders` that orders no two faces.
    #[error(
        "{frame}: faceOrders[{entry}] is [{}, {}, {}]: it must name two faces below {faces} and one of the signs \
         -1, 0, 1",
        order.0, order.1, order.2
    )]
    FaceOrder {
        /// The frame.
        frame: FrameNumber,
        /// Which entry.
        entry: usize,
        /// The entry.
        order: (u32, u32, i8),
        /// How many faces there are.
        faces: usize,
    },
    /// `faceOrders` put a face above another and below it.
    #[error(
        "{frame}: faceOrders[{entry}] gives faces {f} and {g} another order than an earlier entry"
    )]
    TwoOrders {
        /// The frame.
        frame: FrameNumber,
        /// The later entry.
        entry: usize,
        /// One face.
        f: u32,
        /// The other.
        g: u32,
    },
    /// A face with too few or too many corners.
    #[error("faces_vertices[{face}] has {corners} corners: between 3 and {limit} are needed")]
    Corners {
        /// The face.
        face: usize,
        /// Its corners.
        corners: usize,
        /// The most a face may have.
        limit: usize,
    },
    /// A vertex stands twice in a face or an edge.
    #[error("{key}[{element}] names vertex {vertex} twice")]
    RepeatedVertex {
        /// The list.
        key: &'static str,
        /// The face or edge.
        element: usize,
        /// The vertex.
        vertex: u32,
    },
    /// A face without area.
    #[error(
        "faces_vertices[{face}] has no area: twice its area is {area:e}, more than {limit:e} is needed"
    )]
    ZeroArea {
        /// The face.
        face: usize,
        /// Twice its area at rest.
        area: f64,
        /// What it must exceed.
        limit: f64,
    },
    /// A polygon that crosses or touches itself.
    #[error(
        "faces_vertices[{face}] cannot be cut into triangles: its outline must not cross or touch itself"
    )]
    NotSimple {
        /// The face.
        face: usize,
    },
    /// More than two faces on an edge.
    #[error(
        "the edge {vertices:?} belongs to faces {faces:?}: at most 2 faces may meet at an edge"
    )]
    NonManifold {
        /// The ends.
        vertices: [u32; 2],
        /// Three of the faces.
        faces: [u32; 3],
    },
    /// `foldmotion:unitLength` cannot be used.
    #[error("foldmotion:unitLength is {value}: it must be positive")]
    UnitLength {
        /// The value.
        value: f64,
    },
    /// More elements than indices.
    #[error("there are {found} {what}: at most {limit} can be numbered")]
    TooMany {
        /// What.
        what: &'static str,
        /// How many.
        found: usize,
        /// The most.
        limit: usize,
    },
}
