//! The second proof of a collision verdict, by other means than the first.
//!
//! It shares with the first (`collision`, `crossings`, `foldmotion_geometry::collide`) the vector type, the sheet, the
//! report it examines, and what τ and a contact are; not the method: the first counts passages with signs, this one follows
//! directions. A test reads these sources and fails where more is used.
//!
//! # What is proved
//!
//! Let D(A, B, t) = { d : max d·a − min d·b ≤ τ } be the unit directions along which A may be pushed off B. A pair of
//! triangles is clean where a continuous path d(t) ∈ D(t) leads from the side it was on to the end. D(A, B) ⊂ D(A, e) for
//! an edge e of B; two pairs (A, B), (A, B') with e between B and B' fit together where their directions are connected in
//! D(A, e): then the pushes can be blended across e. Where they are not, A passes through the edge beside both.
//!
//! - No two triangles without a common vertex get deeper than τ but those listed.
//! - Wherever else a pair surely changes sides, or sides do not fit together across an edge, a penetration is listed
//!   around: of triangles that meet these, with a contact that begins no later than the interval ends.
//! - Up to the first that is listed, no edge goes through the sheet, at frames and halfway between, such that no push by
//!   τ undoes it.
//! - What is listed is found: as deep as stated; or by a change of sides; or by sides around that do not fit together, or
//!   an edge around that goes through the sheet (a triangle, the two at an edge, those around a vertex) such that no push
//!   by τ undoes it. Then what is named meets when and where stated.
//! - No facets without a common vertex come nearer than stated.
//! - Which triangles lie on each other at the frames, and that their orders, where known, are possible together over every
//!   point, and along every line where the file claims one of them, but for the contradictions listed.
//! - The file claims nothing else. What is neither proved nor refuted is named.
//!
//! # Where it is weaker than the first
//!
//! - Whether sides fit together is looked at at instants: ends of steps, and 17 in each interval. What passes through an
//!   edge and back out between two of them is not seen. Sides left open by a contact are narrowed down at frames only.
//! - Sides are held together pair by pair across edges. Directions that turn around a vertex without being contractible
//!   (a needle through a vertex, corners that meet corners) are not looked for; nor are those of triangles with a common
//!   vertex beyond what they do not share.
//! - A pair surely changes sides where it does so at 2 τ too, and sides surely do not fit together where they do not at
//!   2 τ; what keeps its side at 33/32 τ is clean, and sides that fit together at 1.25 τ are. In between, a pair is named
//!   and nothing is claimed.
//! - A penetration that is listed accounts for all that passes through around it from then on, and its pair is not
//!   followed any more.
//!
//! # How
//!
//! - *Pairs*: the swept box of every triangle against that of every other, one by one.
//! - *Paths*: each face normal, edge × edge and in-plane edge normal is a polynomial n(t) of degree 2 or 3 in time, as
//!   corners move straight; the heights n(t)·(b − a) are polynomials of degree 3 or 4. Their Bernstein coefficients
//!   over a stretch of time bound them; |n(t)| is bounded from below by its component along a fixed direction. Time is
//!   halved until one such axis proves the stretch.
//! - *Sides*: where triangles are apart by more than τ, D is connected, and any direction can be taken. Within τ an axis
//!   may be taken only if it is connected in D(t) to the side the pair is on. That is exact at an instant: the overlap is
//!   the support function of { a − b }; its minima are normals of facets, and the level at which two are connected is the
//!   least over ways along edges of the highest overlap on the way, which has a closed form on an arc.
//! - *Edges*: at instants, the sides of a triangle to the two on an edge are connected, in the same way, for the triangle
//!   and the edge, or what they do not share.
//! - *Piercings*: how often an edge goes through triangles oriented alike, with signs, does not change while its ends keep
//!   farther than τ off them and it does so off their rim.
//! - *Parts*: where triangles with common vertices lose their side, the largest simplices in them without a common vertex
//!   are followed by themselves.
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
//!   Orders of the file that fail are a contradiction. Where sides as they were followed do, the sheet may still be
//!   pushed apart another way: what passes through there is shown by *edges*, and the order is not proved.
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
mod bound;
mod boxes;
mod choice;
mod closest;
mod cluster;
mod coupling;
mod distance;
mod face_pair;
mod follow;
mod instant;
mod layer;
mod layer_state;
mod layering;
mod line;
mod listed;
mod lost;
mod moving_pair;
mod neighbourhood;
mod outcome;
mod parts;
mod path;
mod penetration;
mod piercing;
mod plane;
#[cfg(test)]
mod random;
mod separation;
mod side;
mod stacked;
mod stated_order;
mod statement;
mod through;
mod trail;
mod unlisted;
mod verifier;

pub use outcome::{Refutation, Unproved, Verification};
pub use verifier::Verifier;
