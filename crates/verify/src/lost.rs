//! A pair of triangles that lost its side in an interval.

use std::collections::BTreeSet;

use crate::follow::{FollowOutcome, follow};
use crate::instant::depth;
use crate::moving_pair::MovingPair;
use crate::parts::disjoint_parts;
use crate::penetration::FoundPenetration;
use crate::side::{Limits, Side};

/// A pair without a side with this many times τ surely changes sides.
const CLEAR: f64 = 2.0;

/// Pairs of triangles.
pub(crate) type PairSet = BTreeSet<[u32; 2]>;

/// A pair that was not followed to the end of an interval.
#[derive(Debug)]
pub(crate) struct LostSide {
    /// What was found, if anything.
    pub(crate) found: Option<FoundPenetration>,
    /// Whether it is deeper than τ at an instant and shares no vertex.
    pub(crate) is_deep: bool,
    /// Whether it surely passes through, also with twice the tolerance.
    pub(crate) is_clear: bool,
    /// Whether what it does not share was followed to the end.
    pub(crate) are_parts_clean: bool,
}

impl LostSide {
    /// Looks closer at a pair that lost its side. `is_open`: it may have begun on any.
    pub(crate) fn new(
        moving: &MovingPair,
        (side, is_open): (&Side, bool),
        followed: Option<FoundPenetration>,
        limits: &Limits,
    ) -> Self {
        let depth = followed.as_ref().map_or(0.0, |found| found.crossing.depth);
        let is_deep = moving.shared == 0 && depth > limits.tolerance;
        let mut lost = Self {
            found: followed,
            is_deep,
            is_clear: is_deep,
            are_parts_clean: false,
        };
        if is_deep {
            return lost;
        }
        let wide = Limits {
            tolerance: CLEAR * limits.tolerance,
            ..*limits
        };
        let from = |part: &MovingPair| {
            let all = Side::at_start(part, limits);
            all.filter(|_| is_open).unwrap_or_else(|| side.clone())
        };
        // A part may have been on more sides than the whole.
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
