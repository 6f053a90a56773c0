//! Whole-program tests: scene files in, results out.

#![expect(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test stops where something is missing"
)]

#[path = "whole/bad_input.rs"]
mod bad_input;
#[path = "whole/corpus.rs"]
mod corpus;
#[path = "whole/import.rs"]
mod import;
#[path = "whole/imported.rs"]
mod imported;
#[path = "whole/imported_errors.rs"]
mod imported_errors;
#[path = "whole/layers.rs"]
mod layers;
#[path = "whole/module_graph.rs"]
mod module_graph;
#[path = "whole/profiles.rs"]
mod profiles;
#[path = "whole/recording.rs"]
mod recording;
#[path = "whole/refinement.rs"]
mod refinement;
#[path = "whole/rows.rs"]
mod rows;
#[path = "whole/scenes.rs"]
mod scenes;
#[path = "whole/schemas.rs"]
mod schemas;
#[path = "whole/unfolding.rs"]
mod unfolding;
#[path = "whole/verdict_cases.rs"]
mod verdict_cases;
#[path = "whole/verify.rs"]
mod verify;
#[path = "whole/window.rs"]
mod window;
