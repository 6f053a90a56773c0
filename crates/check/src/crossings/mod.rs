//! Whether parts of the sheet pass through each other, counted on the sheet as a whole.
//!
//! A pair of triangles that stays on one side of each other proves nothing of the sheet: a facet may pass through an
//! edge between two triangles beside each of them. This module decides whether it does, without directions.
//!
//! # Definition
//!
//! Let f(p, q, t) = x_p(t) − x_q(t) for points p, q of the sheet in simplices without a common vertex, and let N be
//! the set of (p, q, t) with |f| ≤ τ. The sheet *penetrates itself* where no map u, |u| ≤ τ, continuous in (p, q, t), takes
//! f + u off 0: where no push by τ undoes all meetings. (This is the deleted product obstruction of van Kampen 1932,
//! with a tolerance and over time.) It speaks of points; where the edges of the triangles run does not matter.
//!
//! Off N there is nothing to undo. In N the obstruction is counted on *cells*, pairs of simplices whose dimensions add up to 2
//! over time or to 3 at an instant: how often a vertex passes through a facet, an edge through an edge, and an edge
//! pierces a facet, with signs. A push near a vertex and an edge within τ of each other changes the counts as one turn
//! of the vertex around the edge does: by 1 in every facet at the edge and every edge at the vertex, at once. So:
//!
//! - for every vertex and facet, and every two edges, and every longest stretch of time in which they are within τ: the
//!   signed number of passages, plus a whole number for each stretch within in which the vertex is within τ of an edge of the facet
//!   (an end of one edge of the other edge), is 0. The whole number is the same for all that meet at that edge and
//!   vertex: around a true boundary there is one facet, and it is free; at an interior edge it leads from one facet to
//!   the next, and a passage through the sheet stays one.
//! - stretches in contact at the first frame begin with an unknown number of passages, such that the piercings at that
//!   instant are undone by them; stretches in contact at the last frame may end with any.
//!
//! These are linear equations in whole numbers. Where they have no solution the sheet penetrates; the first
//! equation without one, in order of time, is the witness. Where they have one, pushes undo every passage (obstructions of higher
//! order, which need a contact set of dimension 4 or more that closes up in itself, are not looked for).
//!
//! # What tolerances and rounding do
//!
//! - All vertices are moved by a fixed random offset of at most τ/4096, so that no two events coincide; what is proved
//!   of the moved motion for τ (1 − 1/32) holds of the given one for τ.
//! - "Within τ" is told to 1/64 (`contact_times`). What is not shown to be near counts as far: that can only
//!   leave an equation without a solution. Where that takes too long the pair is undecided.
//! - Passages are counted exactly (`vertex_passages`, `edge_passages`); where rounding hides one the pair is undecided.
//! - Pairs of triangles shown to be farther apart than τ have no cells; those found penetrating or undecided by their
//!   sides have cells that are not counted.

mod cell;
mod clearance;
mod contact;
mod counter;
mod evidence;
mod interval;
mod perturbation;
#[cfg(test)]
mod random;
mod system;
mod topology;

pub(crate) use counter::CrossingCounter;
pub(crate) use interval::{Interval, SheetCrossing};
