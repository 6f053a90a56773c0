//! The oracle for sheets: random moving sheets with their truth, decided on their union.
//!
//! The truth does not depend on triangles: parts are polygons, and each is triangulated at random afterwards.
//!
//! - Two rigid parts in relative translation (every class except the last four): contact of two convex polygons along a
//!   straight path is decided in integers (`exact`). Penetration is decided by paths displaced by small vectors
//!   (`undo`): if a path displaced by less than τ meets nothing, nothing is through; if all paths displaced by up to 2
//!   τ meet something, it counts as penetrating. In between no verdict is required. The smallest distance of the parts
//!   is computed in f64 (`distance`), and no verdict is required between 0.7 τ and 1.5 τ.
//! - Sheets that fold (`folding`): heights linear in time are compared in integers.
//! - In addition to both, a yardstick (`yardstick`).

pub(crate) mod class;
mod distance;
mod exact;
mod folding;
pub(crate) mod mesh;
mod part;
mod rigid;
pub(crate) mod scene;
pub(crate) mod trial;
mod undo;
pub(crate) mod yardstick;
