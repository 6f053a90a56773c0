//! The oracle for sheets: random sheets in motion with their truth, decided on their union.
//!
//! What is true does not depend on triangles: parts are polygons, and each is triangulated at random afterwards.
//!
//! - Two rigid parts in relative translation (every class but the last four): contact of two convex polygons along a
//!   straight path is decided in whole numbers (`exact`). Penetration is decided by paths displaced by small vectors
//!   (`undo`): a path displaced by less than τ that meets nothing proves that nothing is through; where all those
//!   displaced by up to 2 τ meet something, it is taken to be. In between no verdict is asked for. How near the parts come is computed
//!   in f64 (`distance`), and no verdict is asked for between 0.7 τ and 1.5 τ.
//! - Sheets that fold (`folding`): heights linear in time are compared in whole numbers.
//! - Beside both, a yardstick (`yardstick`).

pub(crate) mod class;
mod distance;
mod exact;
mod folding;
pub(crate) mod mesh;
mod part;
#[path = "../../../../geometry/tests/oracle/random.rs"]
pub(crate) mod random;
mod rigid;
pub(crate) mod scene;
pub(crate) mod trial;
mod undo;
pub(crate) mod yardstick;
