//! What is proved about a motion: the collision verdict, the strain, and the box of the compact state.
//!
//! # The collision verdict
//!
//! [`collisions`] judges every pair of triangles of a sheet over every interval between recorded frames, in which each
//! vertex moves on a straight line. Let τ be the touch tolerance. Facets *touch* if they come within τ, or overlap by
//! at most τ and leave contact on the side on which they entered it. They *penetrate* if they overlap by more than τ or
//! leave on the other side. The depth is the smallest overlap along any direction; across a crease folded past ±180° it
//! is the height, normal to the facets, of what lies beyond each other.
//!
//! What is proved, and under which assumptions:
//! - A verdict of *free* or *touching* is a proof for the frames as f64 numbers and straight paths between them. The
//!   tree drops only pairs whose swept boxes are disjoint, and every other pair has a separating-axis certificate
//!   (`foldmotion_geometry::collide`) without a gap in time. Rounding is bounded, not ignored.
//! - *Penetrating* is confirmed by an instant at which the overlap, seen from the side on which the pair was followed,
//!   exceeds τ. A pair whose deepest overlap equals τ to within rounding may come out either way, or undecided.
//! - Triangles in contact at the first frame may be on any side that D(t) allows there. Creases folded by exactly ±180°
//!   at the first frame are taken to be on the side of their assignment, other layers on the side that the file's
//!   `faceOrders` claim ([`Checker::claim`]).
//! - Triangles that lie on each other are tested as a stack: are the orders of its pairs possible together
//!   ([`Cluster`], [`LayerRule`])? A stack in which some orders are unknown is tested as far as they are known.
//! - Nothing is said about the paths the engine took between frames if they were not straight, nor about the thickness
//!   of the material.

mod collision;
mod crossings;
mod error;
mod extents;
mod layers;
mod straightness;
mod strain;

pub use collision::{
    Checker, CollisionOptions, CollisionReport, FilterCounts, PairCounts, Penetration,
    PenetrationKind, PenetrationSpan, Separation, Stopped, Undecided, Verdict, collisions,
    penetration_spans,
};
pub use error::CheckError;
pub use extents::{
    FittedBox, RelativeError, fitted_box, principal_box, relative_error, upright_box,
};
pub use layers::{
    Claims, Cluster, FlatLayers, LayerConflict, LayerProof, LayerRule, RuleCounts, flat_layers,
};
pub use straightness::straying;
pub use strain::{BarStrain, FacetBending, bar_strain, facet_bending};
