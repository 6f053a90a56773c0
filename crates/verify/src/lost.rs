//! A pair of triangles that lost its side in an interval.

use std::collections::BTreeSet;

use crate::instant::depth;
use crate::parts::disjoint_parts;
use crate::penetration::Found;
use crate::side::{Limits, Side};
use crate::span::Span;
use crate::walk::{Walked, walk};

/// A pair without a side with this many times τ surely changes sides.
const CLEAR: f64 = 2.0;

/// Pairs of triangles.
pub(crate) type Pairs = BTreeSet<[u32; 2]>;

/// A pair that was not followed to the end of an interval.
#[derive(Debug)]
pub(crate) struct Lost {
    /// What was found, if anything.
    pub(crate) found: Option<Found>,
    /// Whether it is deeper than τ at an instant and shares no vertex.
    pub(crate) is_deep: bool,
    /// Whether it surely passes through, also with twice the tolerance.
    pub(crate) is_clear: bool,
    /// Whether what it does not share was followed to the end.
    pub(crate) are_parts_clean: bool,
}

impl Lost {
    /// Looks closer at a pair that lost its side. `is_open`: it may have begun on any.
    pub(crate) fn new(
        span: &Span,
        (side, is_open): (&Side, bool),
        walked: Option<Found>,
        limits: &Limits,
    ) -> Self {
        let depth = walked.as_ref().map_or(0.0, |found| found.crossing.depth);
        let is_deep = span.shared == 0 && depth > limits.tolerance;
        let mut lost = Self {
            found: walked,
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
        let from = |part: &Span| {
            let all = Side::at_start(part, limits);
            all.filter(|_| is_open).unwrap_or_else(|| side.clone())
        };
        // A part may have been on more sides than the whole.
        let any = |part: &Span| {
            let all = Side::at_start(part, &wide);
            all.filter(|_| span.shared > 0 && (!side.is_apart || is_open))
                .unwrap_or_else(|| side.clone())
        };
        let crosses = |part: &Span| {
            let is_deep = depth_at(part, 0.0) > wide.tolerance;
            is_deep || matches!(walk(part, &any(part), &wide), Walked::Crosses(_))
        };
        let is_clean = |part: &Span| {
            let walked = walk(part, &from(part), limits);
            matches!(walked, Walked::Clean { .. })
        };
        let parts = disjoint_parts(span);
        lost.is_clear = parts.iter().any(crosses);
        lost.are_parts_clean = span.shared > 0 && !lost.is_clear && parts.iter().all(is_clean);
        lost
    }
}

pub(crate) fn depth_at(span: &Span, t: f64) -> f64 {
    depth(span, &span.at(t))
}
