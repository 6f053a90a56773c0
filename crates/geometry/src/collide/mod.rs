//! Collision kernels: a tree of boxes, the separating-axis certificate of two triangles in motion, and when a vertex
//! meets a facet or an edge an edge.
//!
//! # What is certified
//!
//! Let the corners of triangles A and B move on straight lines. The overlap along a unit direction d is
//!
//! o_d(t) = max_i d·a_i(t) − min_j d·b_j(t),
//!
//! the depth at an instant is min_d o_d, and D(t) = { d : o_d(t) ≤ τ }. [`certify`] looks for a continuous path
//! d(t) ∈ D(t). Where there is one, the depth never exceeds τ, and the triangles never change sides: changing sides
//! is a jump of d between parts of D(t) that are not connected, as from n to −n while two plates are coplanar to
//! within τ. Corners that are the same vertices of the sheet overlap by exactly 0 and take part like the others.
//!
//! # How
//!
//! Time is walked in dyadic steps, the earliest first. Over a step the direction moves on a straight line between
//! two axes; the Bernstein coefficients of the quadratics d(s)·p(s) bound every overlap (see `moving`). The axes
//! tried at an instant are the face normals of A − B, one of which lies in every component of D(t) (see
//! [`PairPose::axes_within`]), and those carried over. Between steps the path may go from one axis to another only
//! along an arc shown to lie in D(t), or, where the triangles are strictly apart, between separating axes: their set
//! is spherically convex.
//!
//! # Guarantee and its limits
//!
//! A pair that passes has such a path, in exact arithmetic on the given f64 numbers: every bound is tightened by
//! [`Limits::margin`], which covers rounding. The converse holds up to resolution: a pair is reported as crossing
//! only after an instant was found at which it is deeper than τ, or reaches deeper than τ beyond the side it was
//! followed on; where neither was found in the budget the answer is undecided. A vertex that touches a facet and goes
//! back passes, one that goes through crosses, however fast; only the steps it takes grow: a facet that makes half a
//! turn while it is touched takes some ten thousand, whatever the time it does it in.
//!
//! # Vertex and facet, edge and edge
//!
//! Triangles that start apart meet first where a vertex meets a facet or an edge an edge. [`vertex_facet`] and
//! [`edge_edge`] decide that conservatively, with a minimum separation, and say from when on a meeting is possible.
//! Their bounds are relative to the differences of the vertices, not to the extent, and they need no area:
//! [`certify`] turns to them before it calls a pair crossing or undecided that starts and ends apart, because the
//! axes of triangles that shrink to segments on the way are not defined. A pair cleared by them is farther apart than
//! the margin throughout, which is the guarantee above with more to spare.
//!
//! Rounding, with u = 2⁻⁵³ and M_i the largest difference of the two features along coordinate i: a difference of
//! vertices is off by u M_i and its interpolation at a dyadic t by 3 u M_i more. A height along d is then off by at most
//! 8 u Σ |d_i| M_i, and a Bernstein coefficient of the coplanarity cubic by 120 u M_x M_y M_z; the code allows 12 u and
//! 128 u, and 2⁻⁹⁶⁰ for underflow after scaling to M ≤ 1. `patch.rs` derives them term by term; with either left
//! out the tests below find meetings missed.
//!
//! # What this is held to
//!
//! `tests/exact_oracle.rs`, and `examples/exact_oracle.rs` at length, decide queries of every degenerate kind in whole
//! numbers without rounding: no meeting was missed by the kernels, none certified free, and no pair that is deeper
//! than τ at an instant passed. Limits: squares of coordinates must not overflow and fourth powers of edges not
//! underflow (lengths between about 10⁻⁷⁵ and 10¹⁵⁰ for [`certify`], which may refuse others; the queries scale their
//! input and take any that can be subtracted). Facets without area are safe, but may be refused.

mod certifier;
mod certify;
mod clearest;
mod closest;
mod contact;
mod double_word;
mod impact;
mod moving;
mod moving_patch;
mod outcome;
mod passage;
mod patch;
mod pose;
#[cfg(test)]
pub(crate) mod random;
mod separating;
mod tree;

pub use certify::certify;
pub use closest::{Approach, ApproachBounds, accuracy, closest_approach, enough_clearance};
pub use contact::{comes_within, contact_times, corners_are_within, feature_distance};
pub use impact::{Impact, ImpactSearch, edge_edge, vertex_facet};
pub use moving::MovingPair;
pub use outcome::{Effort, Outcome, PairCertificate, PairCrossing, Side};
pub use passage::{Passage, edge_passages, sign_of_volume, vertex_passages};
pub use pose::{Axis, Feature, PairPose};
pub use tree::Tree;

/// The numbers a verdict depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// τ: overlaps up to this are touching. A length, positive.
    pub tolerance: f64,
    /// What rounding may change a projected coordinate by: see [`Limits::margin_for`].
    pub margin: f64,
    /// The most steps spent on a pair in an interval.
    pub budget: u32,
}

impl Limits {
    /// A bound of the rounding error of a height d·p, 64 ε `extent`.
    ///
    /// `extent`: the largest distance of a point from the origin. A height is a subtraction of the origin, at most one
    /// interpolation, a product of three terms and one halving: fewer than 20 roundings.
    pub fn margin_for(extent: f64) -> f64 {
        64.0 * f64::EPSILON * extent
    }
}
