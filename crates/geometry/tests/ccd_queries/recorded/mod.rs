//! Collision queries recorded by others, with their truth: the format of the benchmark of Wang, Ferguson, Schneider,
//! Jiang, Attene and Panozzo 2021 ("A large-scale benchmark and an inclusion-based algorithm for continuous collision
//! detection").
//!
//! Needs the module `oracle` beside it in the crate.

pub(crate) mod file;
mod ratio;
