//! The second proof of a collision verdict, by other means than the first.
//!
//! The crate depends on `foldmotion-check` for the report that it verifies and for nothing else; `clippy.toml` bars its
//! checker. It does not depend on `foldmotion-geometry`, where the first proof keeps its kernels.
//!
//! # What the two proofs share
//!
//! They share the vector type, the sheet, the reader of FOLD files, the types of the report, and the meaning of τ and
//! of a contact. Their definitions differ: the first counts passages with signs, this one couples directions across
//! edges.
//!
//! Their code is separate, but part of it follows the same idea, in which a mistake could be made twice. Both follow a
//! pair of triangles through an interval along separating directions, in dyadic steps that are halved when a proof
//! fails and doubled when it succeeds. Both use Bernstein coefficients as bounds. Some constants are equal: the
//! shortest step, the step below which all axes are tried, 60° as the limit of a side, 10 τ as the width of a shared
//! edge.
//!
//! Different are the boxes (all pairs instead of a tree), the axes (polynomials in time instead of straight paths
//! between axes at two instants), the sides (exact connectivity on the sphere instead of links between axes), the
//! layers (brackets around a line instead of pairs of creases), and everything about the sheet as a whole.
//!
//! # What is proved
//!
//! Let D(A, B, t) = { d : max d·a − min d·b ≤ τ } be the unit directions along which A may be pushed off B. A pair of
//! triangles is clean if a continuous path d(t) ∈ D(t) leads from the side it was on to the end. D(A, B) ⊂ D(A, e) for
//! an edge e of B. Two pairs (A, B) and (A, B') with e between B and B' fit together if their directions are connected
//! in D(A, e): then the pushes can be blended across e. If they are not, A passes through the edge, beside both
//! triangles.
//!
//! - No two triangles without a common vertex get deeper than τ except those listed.
//! - Wherever else a pair surely changes sides, or sides surely do not fit together across an edge, a penetration is
//!   listed nearby: of triangles that share a vertex with these, with a contact that begins no later than the interval
//!   ends.
//! - Up to the first listed penetration, no edge passes through the sheet, at frames and halfway between them, in such
//!   a way that no push by τ undoes it.
//! - What is listed is found: as deep as stated; or by a change of sides; or by sides nearby that do not fit together;
//!   or by an edge nearby that passes through the sheet (a triangle, the two at an edge, or those around a vertex) such
//!   that no push by τ undoes it. Then the features named meet when and where stated.
//! - No facets without a common vertex come nearer than stated.
//! - The triangles that lie on each other at the frames are those stated, and their orders, as far as they are known,
//!   are possible together over every point, and along every line where the file claims one of them, except for the
//!   contradictions listed.
//! - The file claims nothing else about orders. What is neither proved nor refuted is named.
//!
//! # Where it is weaker than the first
//!
//! - Whether sides fit together is tested at instants: the ends of steps, and 17 in each interval. What passes through
//!   an edge and back out between two of them is not seen. Sides left open by a contact are narrowed down at frames
//!   only.
//! - Sides are coupled pair by pair across edges. Directions that turn around a vertex without being contractible (a
//!   needle through a vertex, corners that meet corners) are not considered; nor are those of triangles with a common
//!   vertex beyond the parts they do not share.
//! - A pair surely changes sides if it does so at 2 τ too, and sides surely do not fit together if they do not at 2 τ.
//!   A pair that keeps its side at 33/32 τ is clean, and sides that fit together at 1.25 τ are accepted. In between, a
//!   pair is named and nothing is claimed.
//! - A listed penetration accounts for everything that passes through nearby from then on, and its pair is no longer
//!   followed.
//!
//! # Method
//!
//! - *Pairs*: the swept box of every triangle is compared with that of every other, one by one.
//! - *Paths*: each face normal, cross product of edges and in-plane edge normal is a polynomial n(t) of degree 2 or 3
//!   in time, because corners move straight; the heights n(t)·(b − a) are polynomials of degree 3 or 4. Their Bernstein
//!   coefficients over a time interval bound them; |n(t)| is bounded from below by its component along a fixed
//!   direction. Time is halved until one such axis proves the interval.
//! - *Sides*: if triangles are apart by more than τ, D is connected, and any direction can be used. Within τ an axis
//!   may be used only if it is connected in D(t) to the side the pair is on. This is exact at an instant: the overlap
//!   is the support function of { a − b }; its minima are normals of facets, and the level at which two of them are
//!   connected is the smallest, over paths along edges, of the highest overlap on the path, which has a closed form on
//!   an arc.
//! - *Edges*: at instants, the sides of a triangle to the two triangles at an edge are connected, in the same way, for
//!   the triangle and the edge, or the parts they do not share.
//! - *Piercings*: how often an edge passes through triangles of one orientation, counted with signs, does not change
//!   while its ends stay farther than τ from them and it stays as far from their rim.
//! - *Parts*: if triangles with common vertices lose their side, the largest simplices in them without a common vertex
//!   are followed by themselves.
//! - *Shared vertices* have height 0 exactly and take part like the others. For two triangles at an edge e with apexes
//!   l and r the face normals give det(e, l, r), a cubic, and the in-plane normals (e × l)·(e × r), a quartic: one of
//!   them keeps its sign unless the fold angle passes ±180°.
//! - *Distance*: between two instants, the gap along directions that move straight from one line of closest points to
//!   the next is a quadratic, bounded by its coefficients. If a line of closest points is ill-conditioned, the corners
//!   that should be level along it are made so. The stated lower bound is proved to within the larger of τ / 1000 and a
//!   hundred thousandth of it, and rounding. The stated points lie on their triangles, and are as far apart as stated,
//!   to 1e-9 of the unit of length.
//! - *Layers*: at each frame every pair of nearby triangles is examined. How far two triangles overlap is the distance
//!   of 0 from the rim of their difference { a − b }. The order of two layers is the side on which this proof followed
//!   them.
//! - *Order along a line*: a side of a layer is cut where anything that meets its line begins or ends. For each piece,
//!   all half-planes bounded by the line are sorted, by angle and then by order, which must be strict. Going around,
//!   each hinge, and each layer that continues across the line, must close before any that was open when it opened.
//!   That covers taco–taco, taco–tortilla, tortilla–tortilla and bent creases at once. If a piece fails, or an order in
//!   it is unknown, what meets the hinge is tested one by one, to name it. A contradiction with orders of the file is
//!   reported. If it is between sides as they were followed, the sheet may still be pushed apart in another way:
//!   passages are shown by *edges*, and the order counts as not proved.
//! - *Order over a point*: all cycles of three layers are searched, and none may have a common region. The deepest
//!   stack is counted at the first corners of the common regions of two layers, one of which it must have.
//!
//! The stated depth of a stack is a number found: it is at most the deepest. Counts of work (pairs tested, pairs found
//! to touch, rules tested) depend on the method and are not part of the statement. Between *free* and *touching*, a
//! distance within 2 % of τ counts as either. If a pair lies on the limit of what counts as a layer, or was not
//! followed to the end, a difference at its frame is named and not refuted.
//!
//! # Rounding
//!
//! Positions are relative to a corner of the pair, whose size is L. A height along an axis that multiplies p lengths is
//! off by at most 256 ε L^(p + 1), which is subtracted from every bound. If neither a proof nor a counterexample is
//! found within the budget, the pair is named and nothing is claimed.

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
mod findings;
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
pub use verifier::{Verifier, verify};
