//! Home of the whole-program tests in `whole.rs`.
