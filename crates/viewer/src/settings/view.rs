//! How the sheet is shown, and which panels are open.

use serde::{Deserialize, Serialize};

use crate::timeline::Repeat;
use crate::view3d::CreaseClasses;

/// The quantity that colours show.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub(crate) enum Colour {
    #[default]
    Plain,
    /// The largest strain of the edges of a triangle.
    Strain,
    /// The largest fold angle inside a facet.
    Bending,
    Unit,
    /// The position of each facet in the compact stack.
    Layer,
}

impl Colour {
    pub(crate) const ALL: [Self; 5] =
        [Self::Plain, Self::Strain, Self::Bending, Self::Unit, Self::Layer];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            Self::Strain => "strain",
            Self::Bending => "bending",
            Self::Unit => "unit",
            Self::Layer => "layer",
        }
    }

    pub(crate) fn about(self) -> &'static str {
        match self {
            Self::Plain => "Front and back of the paper",
            Self::Strain => "Largest strain |l/l₀ − 1| of each triangle's edges, per cent",
            Self::Bending => "Largest fold angle inside each facet, degrees",
            Self::Unit => "Neighbouring units in different tints",
            Self::Layer => "Position of each facet in the compact stack",
        }
    }
}

#[expect(clippy::struct_excessive_bools, reason = "each is a switch in the window")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct ViewSettings {
    pub(crate) colour: Colour,
    pub(crate) perspective: bool,
    /// Whether any creases are drawn.
    pub(crate) creases: bool,
    pub(crate) classes: CreaseClasses,
    pub(crate) profile: bool,
    pub(crate) compact_box: bool,
    pub(crate) closed_form_box: bool,
    /// Whether a preview is folded, without contact, after every edit.
    pub(crate) folds_at_once: bool,
    pub(crate) repeat: Repeat,
}

impl Default for ViewSettings {
    fn default() -> Self {
        Self {
            colour: Colour::default(),
            perspective: false,
            creases: true,
            classes: CreaseClasses::default(),
            profile: true,
            compact_box: false,
            closed_form_box: true,
            folds_at_once: true,
            repeat: Repeat::default(),
        }
    }
}

#[expect(clippy::struct_excessive_bools, reason = "each is a switch in the window")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct PanelSettings {
    pub(crate) design: bool,
    pub(crate) plots: bool,
    pub(crate) verdict: bool,
    pub(crate) record: bool,
    pub(crate) text: bool,
}

impl Default for PanelSettings {
    fn default() -> Self {
        Self { design: true, plots: true, verdict: true, record: false, text: false }
    }
}
