//! Flat states and their orders of layers, by the rules of flat folding and without a motion.
//!
//! A pattern is folded flat by reflecting it at every crease ([`FlatState`]). Its facets are then put in order: for
//! every two that overlap, which one lies above the other is a variable, and conditions say which combinations of them
//! are possible. What follows from mountains, valleys and orders given by the file is propagated; pairs that are left
//! open fall into independent components, and each is searched by guesses that are taken back.
//!
//! Sources of the conditions: see [`ConditionCounts`]. That mountain and valley assignments with local flat-foldability
//! are not enough, and that deciding the order is NP-hard: Bern and Hayes 1996, "The complexity of flat origami".
//!
//! | module | contains |
//! |---|---|
//! | `placed` | where reflections at the creases bring each triangle |
//! | `flat_state` | closure, the vertices that do not fold flat |
//! | `pieces`, `convex` | convex pieces of facets, and the lines at which they are joined |
//! | `pairs` | which pieces overlap: the variables |
//! | `along_lines`, `conditions` | what meets along lines and over points: the conditions |
//! | `propagation`, `search` | what follows, and what is guessed |
//! | `given`, `contradiction` | orders that are given, and a small set of facets that have no order |
//! | `flat_folding` | all of it in turn |
//! | `write` | the flat state as FOLD |

mod along_lines;
mod conditions;
mod contradiction;
mod convex;
mod error;
mod flat_folding;
mod flat_state;
mod given;
mod pairs;
mod pieces;
mod placed;
mod propagation;
mod search;
mod write;

pub use conditions::ConditionCounts;
pub use error::LayerError;
pub use flat_folding::{FlatFolding, FoundLayers, LayerOptions};
pub use flat_state::FlatState;
