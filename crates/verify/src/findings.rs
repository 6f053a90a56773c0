//! What the second proof finds about a pair of triangles in an interval.

use crate::lost::LostSide;
use crate::side::Side;
use crate::trail::Trail;

/// What was found about a pair in an interval.
#[derive(Default)]
pub(crate) struct PairFindings {
    pub(crate) side: Option<Side>,
    pub(crate) lost: Option<LostSide>,
    /// The side reached from the narrowed sides, which may be fewer.
    pub(crate) narrowed: Option<Side>,
    pub(crate) lost_narrowed: Option<LostSide>,
    /// How the pair was followed, if it was in contact.
    pub(crate) trail: Option<Trail>,
    pub(crate) touching: [bool; 2],
    pub(crate) nearer: Option<(f64, f64)>,
    pub(crate) unproved: Option<&'static str>,
    pub(crate) is_followed: bool,
    /// Whether nothing is claimed about the pair.
    pub(crate) is_skipped: bool,
}
