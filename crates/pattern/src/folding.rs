//! The two ways in which a sheet of units folds.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How a sheet of units is folded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Folding {
    /// Each unit folds: the paper's compact states.
    #[default]
    Waterbomb,
    /// The lines between units fold: one unit, Nr·Nc layers thick.
    Map,
}

impl Folding {
    /// The name in scene files and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Waterbomb => "waterbomb",
            Self::Map => "map",
        }
    }
}
