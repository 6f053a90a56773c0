//! Collision queries recorded by others, with their truth: the format of the benchmark of Wang, Ferguson, Schneider,
//! Jiang, Attene and Panozzo 2021 ("A large-scale benchmark and an inclusion-based algorithm for continuous collision
//! detection").
//!
//! The including crate must also have the module `oracle`.

pub(crate) mod file;
mod ratio;
