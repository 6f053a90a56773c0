//! What makes a check impossible.

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
        /// Which frame.
        frame: usize,
        /// How many positions it has.
        found: usize,
        /// How many it should have.
        expected: usize,
    },
    /// A coordinate that is not a number or infinite.
    #[error("vertex {vertex} of frame {frame} is at {position}: coordinates must be finite")]
    NotFinite {
        /// Which frame.
        frame: usize,
        /// Which vertex.
        vertex: usize,
        /// Where it is.
        position: glam::DVec3,
    },
    /// Times must increase.
    #[error(
        "frame {frame} is at t = {time}, the frame before at t = {before}: times must increase"
    )]
    TimeOrder {
        /// Which frame.
        frame: usize,
        /// Its time.
        time: f64,
        /// The time of the frame before.
        before: f64,
    },
    /// A triangle without area has no sides.
    #[error(
        "triangle {face} of frame {frame} has the height {height:e}: more than {limit:e} is needed to tell its sides"
    )]
    DegenerateFace {
        /// Which frame.
        frame: usize,
        /// Which triangle.
        face: usize,
        /// Its least height.
        height: f64,
        /// The least height that can be judged.
        limit: f64,
    },
    /// A claim about facets that lie apart from each other contradicts where they are.
    #[error(
        "faceOrders has [{f}, {g}, {sign}] at frame {frame}: face {f} lies on the other side of face {g}; turn the sign round \
         or leave the entry out"
    )]
    FalseOrder {
        /// Which frame.
        frame: usize,
        /// The face that is said to lie above or below.
        f: u32,
        /// The face whose front is meant.
        g: u32,
        /// 1 above, -1 below.
        sign: i8,
    },
    /// A corner that does not exist.
    #[error("triangle {face} has the corner {vertex}: the sheet has {vertices} vertices")]
    CornerOutOfRange {
        /// Which triangle.
        face: usize,
        /// Its corner.
        vertex: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// Two triangles with the same corners.
    #[error("triangles {f} and {g} have the same corners: each may stand once")]
    DuplicateFace {
        /// One triangle.
        f: u32,
        /// The other.
        g: u32,
    },
    /// The tolerance cannot be used.
    #[error(
        "the touch tolerance is {} units of length: it must be positive, finite and below 0.1",
        Number(*value)
    )]
    ToleranceOutOfRange {
        /// The tolerance in units of h.
        value: f64,
    },
    /// The unit of length cannot be used.
    #[error("the unit of length is {value}: it must be positive and finite")]
    UnitLength {
        /// The unit.
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
        /// Which frame.
        frame: usize,
        /// The largest distance from the centre of the first frame.
        extent: f64,
        /// The bound of the rounding errors.
        margin: f64,
        /// The tolerance, a length.
        tolerance: f64,
    },
}
