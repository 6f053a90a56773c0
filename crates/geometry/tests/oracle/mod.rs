//! The exact oracle of the collision kernels: queries of every kind, decided in whole numbers without rounding.

pub(crate) mod contact;
mod polynomial;
pub(crate) mod queries;
#[path = "../../src/collide/random.rs"]
#[expect(dead_code, reason = "shared with the unit tests, which use more of it")]
pub(crate) mod random;
pub(crate) mod trial;
