//! The dynamic engine: the sheet as masses, springs and dampers, moved by explicit steps.
//!
//! [`run`] folds a sheet; [`InteractiveSheet`] lets a user move its time and pull at it; [`State`] is the moving sheet
//! itself, for callers that step it themselves.
//!
//! Forces as Origami Simulator defines them (Ghassaei, Demaine, Gershenfeld 2018): of a bar with ends a and b on its
//! first end k (l − l₀) towards b, plus 2 ζ √(k m) (vb − va), a damper on the whole relative velocity, so that it
//! resists rigid rotation too; of a hinge κ l₀ (θ* − θ) times the gradient of θ; of the corners of a triangle, if face
//! angles are held, φ (α₀ − α) times the gradient of α. Unlike there, the time step is bounded by the whole assembled
//! system, the motion is f64, and it ends where the forces balance.

#![expect(
    clippy::inline_always,
    reason = "a pass is compiled for the machine's vectors only where all of it is inlined"
)]

mod angle;
mod cost;
mod engine;
#[cfg(feature = "gpu")]
pub mod gpu;
mod increments;
mod interaction;
mod lanes;
mod layout;
mod options;
mod part;

mod passes;
mod recorder;
mod relaxation;
mod row_sums;
mod stability;
mod state;

pub use cost::StepCost;
pub use engine::run;
pub use interaction::{InteractiveSheet, Pull};
pub use lanes::instruction_set;
pub use options::{Device, DynamicOptions, Run, StageOutcome, StageStatus};
pub use state::State;
