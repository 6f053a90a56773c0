//! Whole-program tests: scene files in, results out.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test fails where something is missing")]

mod bad_input;
mod bad_record;
mod corpus;
mod cut_sheets;
mod import;
mod imported;
mod imported_errors;
mod imported_steps;
mod layers;
mod module_graph;
mod profiles;
mod recording;
mod refinement;
mod rows;
mod scenes;
mod schemas;
mod unfolding;
mod verdict_cases;
mod verify;
mod window;
