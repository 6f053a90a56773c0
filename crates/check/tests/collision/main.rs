//! The collision verdict against motions whose verdict is known.
#![expect(clippy::unwrap_used, reason = "a test stops where a value is missing")]

mod layers;
mod sheets;
mod stacks;
mod unrolling;
mod verdicts;
