//! The exact oracle of the collision kernels: queries of every kind, decided in integers without rounding.

pub(crate) mod contact;
mod polynomial;
pub(crate) mod queries;
pub(crate) mod trial;
