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
        /// The frame with the error.
        frame: FrameNumber,
        /// The FOLD key that is missing or empty.
        key: &'static str,
        /// What is needed instead.
        need: &'static str,
    },
    /// A list has another length than what it describes.
    #[error("{frame}: {key} has {found} entries: {expected} are needed, one for each of {of}")]
    Count {
        /// The frame with the error.
        frame: FrameNumber,
        /// The FOLD key of the list.
        key: &'static str,
        /// The number of entries of the list.
        found: usize,
        /// The number of entries needed.
        expected: usize,
        /// The elements that the list describes.
        of: &'static str,
    },
    /// A frame with other faces than the key frame.
    #[error("{frame} has other faces_vertices than the key frame: one sheet must move throughout")]
    OtherTopology {
        /// The frame with the error.
        frame: FrameNumber,
    },
    /// A frame inherits from itself, from a later frame or from none.
    #[error(
        "{frame} inherits from frame {parent}: frame_parent must be 0 (the key frame) or an earlier frame, below {number}",
        number = frame.0
    )]
    Parent {
        /// The frame with the error.
        frame: FrameNumber,
        /// Its `frame_parent`, or `none`.
        parent: String,
    },
    /// Too many frames are needed again later by frames that inherit their coordinates.
    #[error(
        "{frame} is the {held}th frame whose coordinates later frames inherit: at most {limit} can be held at a time"
    )]
    HeldFrames {
        /// The frame with the error.
        frame: FrameNumber,
        /// The number of frames held at that moment.
        held: usize,
        /// The largest number of frames that are held.
        limit: usize,
    },
    /// A corner or end that does not exist.
    #[error("{key}[{element}] names vertex {vertex}: there are {vertices} vertices")]
    VertexOutOfRange {
        /// The FOLD key of the list.
        key: &'static str,
        /// The index of the face or edge in the list.
        element: usize,
        /// The index of the vertex.
        vertex: u32,
        /// The number of vertices of the file.
        vertices: usize,
    },
    /// An entry of `faceOrders` that does not order two faces.
    #[error(
        "{frame}: faceOrders[{entry}] is [{}, {}, {}]: it must name two faces below {faces} and one of the signs \
         -1, 0, 1",
        order.0, order.1, order.2
    )]
    FaceOrder {
        /// The frame with the error.
        frame: FrameNumber,
        /// The index of the entry in `faceOrders`.
        entry: usize,
        /// The entry: two faces and a sign.
        order: (u32, u32, i8),
        /// The number of faces of the file.
        faces: usize,
    },
    /// `faceOrders` put a face above another and below it.
    #[error(
        "{frame}: faceOrders[{entry}] gives faces {f} and {g} another order than an earlier entry"
    )]
    TwoOrders {
        /// The frame with the error.
        frame: FrameNumber,
        /// The index of the later of the two entries.
        entry: usize,
        /// The index of one face.
        f: u32,
        /// The index of the other face.
        g: u32,
    },
    /// A face with too few or too many corners.
    #[error("faces_vertices[{face}] has {corners} corners: between 3 and {limit} are needed")]
    Corners {
        /// The index of the face.
        face: usize,
        /// The number of corners of the face.
        corners: usize,
        /// The most a face may have.
        limit: usize,
    },
    /// A face or an edge names a vertex twice.
    #[error("{key}[{element}] names vertex {vertex} twice")]
    RepeatedVertex {
        /// The FOLD key of the list.
        key: &'static str,
        /// The index of the face or edge in the list.
        element: usize,
        /// The index of the vertex.
        vertex: u32,
    },
    /// A face without area.
    #[error(
        "faces_vertices[{face}] has no area: twice its area is {area:e}, more than {limit:e} is needed"
    )]
    ZeroArea {
        /// The index of the face.
        face: usize,
        /// Twice the area of the face at rest.
        area: f64,
        /// Twice the area that it must exceed.
        limit: f64,
    },
    /// A polygon that crosses or touches itself.
    #[error(
        "faces_vertices[{face}] cannot be cut into triangles: its outline must not cross or touch itself"
    )]
    NotSimple {
        /// The index of the face.
        face: usize,
    },
    /// More than two faces on an edge.
    #[error(
        "the edge {vertices:?} belongs to faces {faces:?}: at most 2 faces may meet at an edge"
    )]
    NonManifold {
        /// The vertices at the ends of the edge.
        vertices: [u32; 2],
        /// Three of the faces at the edge.
        faces: [u32; 3],
    },
    /// `foldmotion:unitLength` cannot be used.
    #[error("foldmotion:unitLength is {value}: it must be positive")]
    UnitLength {
        /// The value that was given.
        value: f64,
    },
    /// More elements than indices.
    #[error("there are {found} {what}: at most {limit} can be numbered")]
    TooMany {
        /// The name of the elements that are too many.
        what: &'static str,
        /// The number of elements found.
        found: usize,
        /// The largest number allowed.
        limit: usize,
    },
}
