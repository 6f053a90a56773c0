//! Errors that make a check impossible.

use foldmotion_geometry::Number;

/// Why a motion cannot be checked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CheckError {
    /// The caller asked to stop.
    #[error("the check was cancelled after {intervals} of the intervals between frames")]
    Cancelled {
        /// How many intervals had been judged.
        intervals: usize,
    },
    /// A motion needs at least one frame.
    #[error("the motion has no frames: at least 1 is needed")]
    NoFrames,
    /// A frame with the wrong number of positions.
    #[error("frame {frame} has {found} positions: the sheet has {expected} vertices")]
    FrameSize {
        /// The index of the frame.
        frame: usize,
        /// How many positions it has.
        found: usize,
        /// How many it needs: one for each vertex.
        expected: usize,
    },
    /// A coordinate that is not a number or infinite.
    #[error("vertex {vertex} of frame {frame} is at {position}: coordinates must be finite")]
    NotFinite {
        /// The index of the frame.
        frame: usize,
        /// The index of the vertex.
        vertex: usize,
        /// The position that was given.
        position: glam::DVec3,
    },
    /// Times must increase.
    #[error(
        "frame {frame} is at t = {time}, the frame before at t = {before}: times must increase"
    )]
    TimeOrder {
        /// The index of the frame.
        frame: usize,
        /// Its motion time.
        time: f64,
        /// The motion time of the frame before it.
        before: f64,
    },
    /// A triangle without area: its sides cannot be told apart.
    #[error(
        "triangle {face} of frame {frame} has the height {height:e}: more than {limit:e} is needed to tell its sides apart"
    )]
    DegenerateFace {
        /// The index of the frame.
        frame: usize,
        /// The index of the triangle.
        face: usize,
        /// Its smallest height, a length.
        height: f64,
        /// The smallest height that can be judged, a length.
        limit: f64,
    },
    /// A claim about facets that lie a gap apart contradicts their positions.
    #[error(
        "faceOrders has [{f}, {g}, {sign}] at frame {frame}: face {f} lies on the other side of face {g}; turn the sign round \
         or leave the entry out"
    )]
    FalseOrder {
        /// The index of the frame.
        frame: usize,
        /// The face that is claimed to lie above or below.
        f: u32,
        /// The face whose front the claim refers to.
        g: u32,
        /// 1 if the claim says above, −1 if it says below.
        sign: i8,
    },
    /// A triangle with a corner that does not exist.
    #[error("triangle {face} has the corner {vertex}: the sheet has {vertices} vertices")]
    CornerOutOfRange {
        /// The index of the triangle.
        face: usize,
        /// The index of the missing vertex.
        vertex: u32,
        /// How many vertices the sheet has.
        vertices: usize,
    },
    /// Two triangles with the same corners.
    #[error("triangles {f} and {g} have the same corners: each triangle may be listed only once")]
    DuplicateFace {
        /// The first of the two triangles.
        f: u32,
        /// The second of them.
        g: u32,
    },
    /// The tolerance is out of range.
    #[error(
        "the touch tolerance is {} units of length: it must be positive, finite and below 0.1",
        Number(*value)
    )]
    ToleranceOutOfRange {
        /// The tolerance in units of h.
        value: f64,
    },
    /// The unit of length is out of range.
    #[error("the unit of length is {value}: it must be positive and finite")]
    UnitLength {
        /// The unit of length that was given.
        value: f64,
    },
    /// Coordinates too large for the tolerance.
    #[error(
        "the touch tolerance of {:.3} is too small: it must be at least 4096 times the rounding, {:.3}, of frame {frame}, which \
         reaches {:.3} from the start",
        Number(*tolerance),
        Number(*margin),
        Number(*extent)
    )]
    ToleranceBelowRounding {
        /// The index of the frame.
        frame: usize,
        /// The largest distance from the centre of the first frame.
        extent: f64,
        /// The bound of the rounding errors, a length.
        margin: f64,
        /// The tolerance, a length.
        tolerance: f64,
    },
}
