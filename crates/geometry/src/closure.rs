//! How a curve ends.

use serde::{Deserialize, Serialize};

/// How a profile ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Closure {
    /// It has two ends.
    #[default]
    Open,
    /// It returns to its start with a corner there.
    Corner,
    /// It returns to its start with continuous first and second derivative.
    Smooth,
}
