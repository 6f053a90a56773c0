//! Whether parts of the sheet pass through each other, counted on the sheet as a whole.
//!
//! That every pair of triangles stays on its side proves nothing about the sheet: a facet may pass through the edge
//! between two triangles, beside each of them. This module decides whether that happens. It does not use directions.
//!
//! # Definition
//!
//! Let f(p, q, t) = x_p(t) − x_q(t) for points p, q of the sheet in simplices without a common vertex, and let N be the
//! set of (p, q, t) with |f| ≤ τ. The sheet *penetrates itself* if there is no map u with |u| ≤ τ, continuous in (p, q,
//! t), such that f + u is never 0: no push by τ undoes all meetings. (This is the deleted product obstruction of van
//! Kampen 1932, with a tolerance and over time.) The definition is about points; how the sheet is cut into triangles
//! does not matter.
//!
//! Outside N there is nothing to undo. In N the obstruction is counted on *cells*, pairs of simplices whose dimensions
//! add up to 2 over time or to 3 at an instant: how often, with signs, a vertex passes through a facet, an edge passes
//! through an edge, and an edge pierces a facet. A push near a vertex and an edge that are within τ of each other
//! changes these counts as one turn of the vertex around the edge does: by 1 in every facet at the edge and in every
//! edge at the vertex, all at once. So:
//!
//! - For every vertex and facet, every two edges, and every maximal time interval in which they are within τ, the
//!   following sum is 0: the signed number of passages plus an integer for each interval within it during which the
//!   vertex is within τ of an edge of the facet (or an end of one edge is within τ of the other edge). The integer is
//!   the same for everything that meets at that edge and vertex. At the true boundary there is one facet, so the
//!   integer is free; at an interior edge it carries a passage from one facet to the next, and a passage through the
//!   sheet remains one.
//! - Intervals of contact that include the first frame begin with an unknown number of passages, constrained by the
//!   piercings at that instant. Intervals of contact that include the last frame may end with any number.
//!
//! These are linear equations in integers. If they have no solution, the sheet penetrates, and the first equation in
//! order of time without a solution is the evidence. If they have a solution, pushes undo every passage. (Obstructions
//! of higher order, which need a closed contact set of dimension 4 or more, are not looked for.)
//!
//! # Tolerances and rounding
//!
//! - All vertices are moved by fixed random offsets of at most τ/4096, so that no two events coincide. What is proved
//!   about the moved motion with τ (1 − 1/32) holds for the given motion with τ.
//! - Contact times are accurate to 1/64 of the distance (`contact_times`). Features that are not shown to be near count
//!   as far apart: that can only leave an equation without a solution. If the search takes too long, the pair is
//!   undecided.
//! - Passages are counted exactly (`vertex_passages`, `edge_passages`). If rounding hides one, the pair is undecided.
//! - Pairs of triangles shown to be farther apart than τ have no cells. Pairs that were found penetrating or undecided
//!   by their sides have cells, which are excluded from the counts.

mod cell;
mod clearance;
mod contact;
mod counter;
mod evidence;
mod interval;
mod perturbation;
mod system;
mod topology;

pub(crate) use counter::CrossingCounter;
pub(crate) use interval::{Interval, SheetCrossing};
