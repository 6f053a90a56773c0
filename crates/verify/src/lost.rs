//! A pair of triangles that lost its side in an interval.

use std::collections::BTreeSet;

use crate::follow::{FollowOutcome, follow};
use crate::instant::depth;
use crate::moving_pair::MovingPair;
use crate::parts::disjoint_parts;
use crate::penetration::FoundPenetration;
use crate::side::{Limits, Side};

/// A pair without a side even at this multiple of τ surely changes sides.
const CLEAR: f64 = 2.0;

/// A set of pairs of triangles, the smaller index first.
pub(crate) type PairSet = BTreeSet<[u32; 2]>;

/// A pair that could not be followed to the end of an interval.
#[derive(Debug)]
pub(crate) struct LostSide {
    /// The penetration that was found, if any.
    pub(crate) found: Option<FoundPenetration>,
    /// Whether it is deeper than τ at an instant and shares no vertex.
    pub(crate) is_deep: bool,
    /// Whether it surely passes through, even with twice the tolerance.
    pub(crate) is_clear: bool,
    /// Whether the parts that the triangles do not share were followed to the end.
    pub(crate) are_parts_clean: bool,
}

impl LostSide {
    /// Examines a pair that lost its side. `is_open`: it may have begun on any side.
    pub(crate) fn new(
        moving: &MovingPair,
        (side, is_open): (&Side, bool),
        followed: Option<FoundPenetration>,
        limits: &Limits,
    ) -> Self {
        let depth = followed.as_ref().map_or(0.0, |found| found.crossing.depth);
        let is_deep = moving.shared == 0 && depth > limits.tolerance;
        let mut lost = Self { found: followed, is_deep, is_clear: is_deep, are_parts_clean: false };
        if is_deep {
            return lost;
        }
        let wide = Limits { tolerance: CLEAR * limits.tolerance, ..*limits };
        let from = |part: &MovingPair| {
            let all = Side::at_start(part, limits);
            all.filter(|_| is_open).unwrap_or_else(|| side.clone())
        };
        // A part of a triangle may have been on more sides than the whole.
        let any = |part: &MovingPair| {
            let all = Side::at_start(part, &wide);
            all.filter(|_| moving.shared > 0 && (!side.is_apart || is_open))
                .unwrap_or_else(|| side.clone())
        };
        let crosses = |part: &MovingPair| {
            let is_deep = depth_at(part, 0.0) > wide.tolerance;
            is_deep || matches!(follow(part, &any(part), &wide), FollowOutcome::Crosses(_))
        };
        let is_clean = |part: &MovingPair| {
            let followed = follow(part, &from(part), limits);
            matches!(followed, FollowOutcome::Clean { .. })
        };
        let parts = disjoint_parts(moving);
        lost.is_clear = parts.iter().any(crosses);
        lost.are_parts_clean = moving.shared > 0 && !lost.is_clear && parts.iter().all(is_clean);
        lost
    }
}

pub(crate) fn depth_at(moving: &MovingPair, t: f64) -> f64 {
    depth(moving, &moving.at(t))
}
