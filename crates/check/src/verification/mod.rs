//! The second proof of a collision verdict, by other means than the first.
//!
//! It shares with the first (`collision`, `foldmotion_geometry::collide`) the vector type, the sheet and the report it
//! examines, nothing else; a test reads these sources and fails where more is used.
//!
//! # What is proved
//!
//! That no pair of triangles gets deeper than τ or changes sides, but those listed as penetrating and those listed as
//! undecided; that those listed do so, when and how deep is stated; that no facets without a common vertex come nearer
//! than stated. D(t) = { d : max d·a − min d·b ≤ τ }; a pair is clean where a continuous path of directions d(t) ∈ D(t)
//! leads from the side it was on to the end.
//!
//! # How
//!
//! - *Pairs*: the swept box of every triangle against that of every other, one by one.
//! - *Paths*: each face normal, edge × edge and in-plane edge normal is a polynomial n(t) of degree 2 or 3 in time, as
//!   corners move straight; the heights n(t)·(b − a) are polynomials of degree 3 or 4. Their Bernstein coefficients
//!   over a stretch of time bound them; |n(t)| is bounded from below by its component along a fixed direction. Time is
//!   halved until one such axis proves the stretch.
//! - *Sides*: where the triangles are strictly apart, the separating directions form a convex cone, and any of them can
//!   be taken. In contact an axis may be taken only if an arc within D(t) joins it to the side the pair is on.
//! - *Shared vertices* have height 0 exactly and take part like the others; for two triangles on an edge e with apexes
//!   l, r the face normals give det(e, l, r), a cubic, and the in-plane normals (e × l)·(e × r), a quartic: one of them
//!   keeps its sign unless the fold angle passes ±180°.
//! - *Distance*: between two instants the gap along directions that go straight from one line of closest points to the
//!   next is a quadratic, bounded by its coefficients.
//!
//! # Rounding
//!
//! Positions are relative to a corner of the pair of size L. A height along an axis that multiplies p lengths is wrong
//! by at most 256 ε L^(p + 1), which is taken off every bound. Where neither proof nor witness is found in the budget,
//! the pair is named and nothing is claimed.

mod boxes;
mod distance;
mod instant;
mod outcome;
mod pair;
mod path;
mod penetration;
#[cfg(test)]
mod random;
mod span;
mod statement;
#[cfg(test)]
mod tests;
mod verifier;
mod walk;

pub use outcome::{Refutation, Unproved, Verification};
pub use verifier::Verifier;
