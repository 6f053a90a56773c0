//! The motion of the row creases in stage `unfold`.

use foldmotion_geometry::unfolding::{Chain, SweepVerdict, TurnPath, certify, straighten};
use foldmotion_geometry::{Division, GeometryError, Profile};
use foldmotion_pattern::Facing;
use foldmotion_solver::UnfoldPath;

use crate::scene::UnfoldChoice;

/// The motion of the row creases from the deployed shape to the flat sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Unfolding {
    /// The choice of the scene.
    pub requested: UnfoldChoice,
    /// Whether the divided profile was proved not to cross itself.
    pub certified: bool,
    /// Where uniform scaling first makes the divided profile cross itself, as a part of the stage; `None` if it does not, or if
    /// that was not examined.
    pub crosses_at: Option<f64>,
    /// The path by energy; `None` if all turns are scaled together.
    pub path: Option<TurnPath>,
}

impl Unfolding {
    /// The unfolding of a divided profile.
    ///
    /// `auto` is uniform if that is proved not to cross, and otherwise by energy if that succeeds. Profiles with more segments
    /// than [`Chain`] accepts are unfolded uniformly, without a proof. If `in_turn`, rows start at different times, about which
    /// nothing is proved; `auto` is then uniform.
    ///
    /// # Errors
    /// Those of [`Chain::new`] and [`straighten`] if energy was requested.
    pub fn new(
        requested: UnfoldChoice,
        profile: &Profile,
        division: &Division,
        in_turn: bool,
    ) -> Result<Self, GeometryError> {
        let mut unfolding = Self { requested, certified: false, crosses_at: None, path: None };
        let chain = Chain::new(&division.points, profile.is_closed());
        if requested == UnfoldChoice::Energy {
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
        if requested == UnfoldChoice::Auto && !unfolding.certified && !in_turn {
            unfolding.path = straighten(&chain).ok();
            unfolding.certified = unfolding.path.is_some();
        }
        Ok(unfolding)
    }

    /// The method that was taken: uniform or energy.
    pub fn method(&self) -> UnfoldChoice {
        if self.path.is_some() { UnfoldChoice::Energy } else { UnfoldChoice::Uniform }
    }

    /// The path as fold angles of the row creases, for flaps on the side `facing`; `None` if uniform.
    pub(crate) fn fold_angles(&self, facing: Facing) -> Option<UnfoldPath> {
        let path = self.path.as_ref()?;
        // If the flaps are on the left of the profile, the front is on its right.
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
