//! How stage 1 moves the row creases.

use foldmotion_geometry::unfolding::{Chain, SweepVerdict, TurnPath, certify, straighten};
use foldmotion_geometry::{Division, GeometryError, Profile};
use foldmotion_pattern::Facing;
use foldmotion_solver::UnfoldPath;

use crate::scene::UnfoldChoice;

/// The motion of the row creases from the deployed shape to the flat sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Unfolding {
    /// What the scene asks for.
    pub asked: UnfoldChoice,
    /// Whether the divided profile was proved not to cross itself on the way.
    pub certified: bool,
    /// Where uniform scaling first makes the divided profile cross itself, as a share of stage 1; none where it does not,
    /// or was not looked at.
    pub crosses_at: Option<f64>,
    /// The path by energy; none where all turns are scaled together.
    pub path: Option<TurnPath>,
}

impl Unfolding {
    /// The unfolding of a divided profile.
    ///
    /// `auto` is uniform where that is proved clear, else by energy where that succeeds. Profiles of more segments than
    /// [`Chain`] takes are unfolded uniformly, without a proof. `in_turn`: whether rows start at times of their own, of
    /// which nothing is proved; `auto` is then uniform.
    ///
    /// # Errors
    /// Where energy was asked for: those of [`Chain::new`] and [`straighten`].
    pub fn new(
        asked: UnfoldChoice,
        profile: &Profile,
        division: &Division,
        in_turn: bool,
    ) -> Result<Self, GeometryError> {
        let mut unfolding = Self {
            asked,
            certified: false,
            crosses_at: None,
            path: None,
        };
        let chain = Chain::new(&division.points, profile.is_closed());
        if asked == UnfoldChoice::Energy {
            unfolding.path = Some(straighten(&chain?)?);
            unfolding.certified = !in_turn;
            return Ok(unfolding);
        }
        let Ok(chain) = chain else {
            return Ok(unfolding);
        };
        let flat = vec![0.0; chain.turns().len()];
        let verdict = certify(&chain, chain.turns(), &flat);
        if let SweepVerdict::Crosses { fraction, .. } = verdict {
            unfolding.crosses_at = Some(fraction);
        }
        unfolding.certified = !in_turn && verdict == SweepVerdict::Clear;
        if asked == UnfoldChoice::Auto && !unfolding.certified && !in_turn {
            unfolding.path = straighten(&chain).ok();
            unfolding.certified = unfolding.path.is_some();
        }
        Ok(unfolding)
    }

    /// Uniform or energy, whichever was taken.
    pub fn method(&self) -> UnfoldChoice {
        if self.path.is_some() {
            UnfoldChoice::Energy
        } else {
            UnfoldChoice::Uniform
        }
    }

    /// The path as fold angles of the row creases of a sheet whose flaps stand on the side `facing`.
    pub(crate) fn fold_angles(&self, facing: Facing) -> Option<UnfoldPath> {
        let path = self.path.as_ref()?;
        // The front lies on the right of the profile where the flaps stand on its left.
        let sign = match facing {
            Facing::Left => -1.0,
            Facing::Right => 1.0,
        };
        let angles = |turns: &Vec<f64>| turns.iter().map(|turn| sign * turn).collect();
        Some(UnfoldPath {
            progress: path.progress.clone(),
            angles: path.turns.iter().map(angles).collect(),
        })
    }
}
