//! The second proof of a collision verdict, by other means than the first.
//!
//! It shares with the first (`collision`, `foldmotion_geometry::collide`) the vector type, the sheet and the report it
//! examines, nothing else; a test reads these sources and fails where more is used.
//!
//! # What is proved
//!
//! That no pair of triangles gets deeper than τ or changes sides, but those listed as penetrating and those listed as
//! undecided; that those listed do so, when and how deep is stated; that no facets without a common vertex come nearer
//! than stated; which triangles lie on each other at the frames, in which order, and that these orders are possible
//! together but where a contradiction is listed; that the file claims nothing else. D(t) = { d : max d·a − min d·b ≤ τ }; a pair is clean where a continuous path of directions d(t) ∈ D(t)
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
//!   next is a quadratic, bounded by its coefficients. Where a line of closest points is ill known, the corners that
//!   should be level along it are made so. The stated lower bound is proved to within the larger of τ / 1000 and a
//!   hundred thousandth of it, and rounding; that the stated points lie on their triangles and are as far apart as
//!   stated, to 1e-9 of the unit of length.
//! - *Layers*: at each frame every pair near each other is looked at; how far two triangles overlap is the distance of 0
//!   from the rim of their difference { a − b }. The order of two is the side on which this proof followed them.
//! - *Order along a line*: a side of a layer is cut where what meets its line begins or ends. For each stretch, all
//!   half-planes that end in the line are sorted, by angle and then by order, which must be strict; going around, each
//!   hinge, and each layer that runs on across, must close before any that was open when it opened. That is taco–taco,
//!   taco–tortilla, tortilla–tortilla and bent creases at once. Where a stretch fails, or an order in it is open, what
//!   meets the hinge is tried one by one, to name it.
//! - *Order over a point*: every three layers that go round are looked for, one three after the other, and no region
//!   is theirs in common. The deepest stack is counted at the first corners of what two layers share, where it must
//!   have one.
//!
//! How deep a stack is, is stated as a number found: no more than the deepest. Counts of work (pairs tested, pairs found
//! to touch, rules tested) depend on the method and are no part of the statement. Between *free* and *touching* a
//! distance within 2 % of τ decides either way. Where a pair lies on the limit
//! of what is a layer, or was not followed to an end, a difference at its frame is named and not refuted.
//!
//! # Rounding
//!
//! Positions are relative to a corner of the pair of size L. A height along an axis that multiplies p lengths is wrong
//! by at most 256 ε L^(p + 1), which is taken off every bound. Where neither proof nor witness is found in the budget,
//! the pair is named and nothing is claimed.

mod account;
mod arcs;
mod around;
mod boxes;
mod choice;
mod closest;
mod cluster;
mod coupling;
mod distance;
mod instant;
mod layer;
mod line;
mod ordering;
mod outcome;
mod pair;
mod parts;
mod path;
mod penetration;
mod plane;
#[cfg(test)]
mod random;
mod separation;
mod span;
mod stated_order;
mod statement;
#[cfg(test)]
mod tests;
mod through;
mod trail;
mod verifier;
mod walk;

pub use outcome::{Refutation, Unproved, Verification};
pub use verifier::Verifier;
