//! The bar-and-hinge model and the dynamic engine against closed forms, finite differences and exact states.

#![expect(clippy::unwrap_used, reason = "a test stops where a value is missing")]

mod energy;
mod folding;
mod interaction;
mod motion;
mod sheets;
