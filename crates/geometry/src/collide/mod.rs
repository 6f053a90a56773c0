//! Collision kernels: a tree of boxes, the separating-axis certificate of two moving triangles, and the impacts of
//! vertices with facets and edges with edges.
//!
//! # What is certified
//!
//! Let the corners of triangles A and B move on straight lines. The overlap along a unit direction d is
//!
//! o_d(t) = max_i d·a_i(t) − min_j d·b_j(t),
//!
//! the depth at an instant is min_d o_d, and D(t) = { d : o_d(t) ≤ τ }. [`certify()`] looks for a continuous path d(t) ∈
//! D(t). If there is one, the depth never exceeds τ, and the triangles never change sides: changing sides means that d
//! jumps between components of D(t), as from n to −n while two plates are coplanar to within τ. Corners that are the
//! same vertices of the sheet overlap by exactly 0 and take part like the others.
//!
//! # Method
//!
//! Time advances in dyadic steps. Over a step the direction moves straight from one axis to another; the Bernstein
//! coefficients of the quadratics d(s)·p(s) bound every overlap (see `moving`). The axes tried at an instant are the
//! face normals of A − B, one of which lies in every component of D(t) (see [`PairPose::axes_within`]), and those
//! carried over. Between steps the path may change from one axis to another only along an arc shown to lie in D(t) or,
//! if the triangles are strictly apart, between separating axes, because their set is spherically convex.
//!
//! # Guarantee and its limits
//!
//! A pair that passes has such a path, in exact arithmetic on the given f64 numbers: every bound is tightened by
//! [`Limits::margin`], which covers rounding. The converse holds up to resolution: a pair is reported as crossing only
//! after an instant was found at which it is deeper than τ, or reaches deeper than τ beyond the side it was followed
//! on. If neither was found within the budget, the answer is undecided. A vertex that touches a facet and goes back
//! passes, one that goes through crosses, however fast. Only the number of steps grows: a facet that makes half a turn
//! while it is touched takes about ten thousand, however long it takes.
//!
//! # Vertex and facet, edge and edge
//!
//! Triangles that start apart meet first where a vertex meets a facet or an edge meets an edge. [`vertex_facet`] and
//! [`edge_edge`] decide that conservatively, with a minimum separation, and return the time from which on an impact is
//! possible. Their bounds are relative to the differences of the vertices, not to the extent, and they do not need an
//! area. [`certify()`] uses them before it reports a pair that starts and ends apart as crossing or undecided, because
//! the axes of triangles that shrink to segments during the motion are undefined. A pair cleared by them is farther
//! apart than the margin throughout, which is stronger than the guarantee above.
//!
//! Rounding, with u = 2⁻⁵³ and M_i the largest difference of the two features along coordinate i: a difference of
//! vertices is off by u M_i, and its interpolation at a dyadic t by 3 u M_i more. A height along d is then off by at
//! most 8 u Σ |d_i| M_i, and a Bernstein coefficient of the coplanarity cubic by 120 u M_x M_y M_z; the code allows 12
//! u and 128 u, and 2⁻⁹⁶⁰ for underflow after scaling to M ≤ 1. `patch.rs` derives them term by term; if either is left
//! out, the tests below find impacts that are missed.
//!
//! # Evidence
//!
//! `tests/exact_oracle.rs`, and `examples/exact_oracle.rs` at length, decide queries of every degenerate kind in
//! integers, without rounding: the kernels missed no impact and certified none as free, and no pair passed that is
//! deeper than τ at an instant. Limits: squares of coordinates must not overflow and fourth powers of edges must not
//! underflow (lengths between about 10⁻⁷⁵ and 10¹⁵⁰ for [`certify()`], which may refuse others; the queries scale their
//! input and accept whatever can be subtracted). Facets without area are handled safely, but may be refused.

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

/// The limits that a verdict depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// τ: overlaps up to this count as touching. A positive length.
    pub tolerance: f64,
    /// A bound of the rounding error of a projected coordinate: see [`Limits::margin_for`].
    pub margin: f64,
    /// The largest number of steps spent on a pair in an interval.
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
