//! The package of the whole-program tests, which are in `whole/`.
