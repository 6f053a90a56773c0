//! The kinds of scenes.

use foldmotion_random::Random;

use super::{folding, rigid, scene::Scene};

/// The classes of scenes, each with its own stream of random numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Class {
    Interior,
    Diagonal,
    Crease,
    InteriorVertex,
    Parallel,
    Slide,
    Along,
    Beside,
    TouchAndBack,
    Static,
    Stack,
    Tube,
    Thin,
    Random,
    ClosingFold,
    Layers,
    Flap,
    OwnCrease,
}

impl Class {
    pub(crate) const ALL: [Self; 18] = [
        Self::Interior,
        Self::Diagonal,
        Self::Crease,
        Self::InteriorVertex,
        Self::Parallel,
        Self::Slide,
        Self::Along,
        Self::Beside,
        Self::TouchAndBack,
        Self::Static,
        Self::Stack,
        Self::Tube,
        Self::Thin,
        Self::Random,
        Self::ClosingFold,
        Self::Layers,
        Self::Flap,
        Self::OwnCrease,
    ];

    pub(crate) fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|class| format!("{class:?}") == name)
    }

    /// The stream of random numbers of a scene.
    pub(crate) fn random(self, number: u64) -> Random {
        Random::new(((self as u64) << 48) ^ number.wrapping_mul(0x2545_f491_4f6c_dd1d))
    }

    /// A scene of the class; the numbers left in the stream vary it.
    pub(crate) fn scene(self, random: &mut Random) -> Scene {
        match self {
            Self::ClosingFold | Self::Layers | Self::Flap | Self::OwnCrease => {
                folding::scene(self, random)
            }
            _ => rigid::scene(self, random),
        }
    }
}
