//! How the sheet is shown; remembered from one start to the next.

use serde::{Deserialize, Serialize};

use crate::timeline::Repeat;
use crate::view3d::CreaseClasses;

/// What colours show.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub(crate) enum Colour {
    /// The two sides of the paper.
    #[default]
    Plain,
    /// Bar strain.
    Strain,
    /// Facet bending.
    Bending,
    /// One tint a unit.
    Unit,
    /// The place in the stack.
    Layer,
}

impl Colour {
    pub(crate) const ALL: [Self; 5] = [
        Self::Plain,
        Self::Strain,
        Self::Bending,
        Self::Unit,
        Self::Layer,
    ];

    /// Its name on the screen.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            Self::Strain => "strain",
            Self::Bending => "bending",
            Self::Unit => "unit",
            Self::Layer => "layer",
        }
    }

    /// What it shows.
    pub(crate) fn about(self) -> &'static str {
        match self {
            Self::Plain => "front and back of the paper",
            Self::Strain => "the largest |l/l₀ − 1| of each triangle's edges, per cent",
            Self::Bending => "the largest fold angle inside each facet, degrees",
            Self::Unit => "neighbouring units in different tints",
            Self::Layer => "the place of each facet in the compact stack",
        }
    }

    /// The next one.
    pub(crate) fn next(self) -> Self {
        let at = Self::ALL.iter().position(|&c| c == self).unwrap_or(0);
        Self::ALL[(at + 1) % Self::ALL.len()]
    }
}

/// How the sheet is shown, and which panels are open.
#[expect(clippy::struct_excessive_bools, reason = "one switch each in the window")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct Looks {
    pub(crate) colour: Colour,
    pub(crate) creases: CreaseClasses,
    /// All creases, on or off at once.
    pub(crate) has_creases: bool,
    pub(crate) has_profile: bool,
    pub(crate) has_box: bool,
    pub(crate) has_closed_form: bool,
    pub(crate) perspective: bool,
    pub(crate) design: bool,
    pub(crate) results: bool,
    pub(crate) curves: bool,
    /// Whether the sheet is folded anew, without contact, after every edit.
    pub(crate) folds_at_once: bool,
    pub(crate) repeat: Repeat,
}

impl Default for Looks {
    fn default() -> Self {
        Self {
            colour: Colour::default(),
            creases: CreaseClasses::default(),
            has_creases: true,
            has_profile: true,
            has_box: false,
            has_closed_form: true,
            perspective: false,
            design: true,
            results: true,
            curves: true,
            folds_at_once: true,
            repeat: Repeat::default(),
        }
    }
}
