//! Collision kernels: a tree of boxes, and the separating-axis certificate of two triangles in motion.
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
//! followed on; where neither was found in the budget the answer is undecided.

mod certify;
mod closest;
mod moving;
mod pose;
#[cfg(test)]
pub(crate) mod random;
mod tree;
mod walk;

pub use certify::{Crossing, Effort, Outcome, Passage, Side, certify};
pub use closest::{Approach, Approaches, closest_approach, enough_clearance};
pub use moving::MovingPair;
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
