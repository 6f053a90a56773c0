//! How a profile ends.

use serde::{Deserialize, Serialize};

/// How a profile ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Closure {
    /// The profile has two ends.
    #[default]
    Open,
    /// The profile returns to its start and has a corner there.
    Corner,
    /// The profile returns to its start with continuous first and second derivatives.
    Smooth,
}
