//! The schedule: the target fold angle of every hinge along the motion.

use foldmotion_pattern::{Edge, Sheet};

use crate::SolverError;

/// The largest target taken: a whole turn, twice what paper allows.
const MAX_ANGLE: f64 = std::f64::consts::TAU;

/// A stage of the motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Stage {
    /// Deployed to planar: motion time t from 0 to 1.
    Unfold,
    /// Planar to compact: motion time t from 1 to 2.
    Fold,
}

impl Stage {
    /// Both, in the order of the motion.
    pub const ALL: [Self; 2] = [Self::Unfold, Self::Fold];

    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Unfold => "unfold",
            Self::Fold => "fold",
        }
    }

    /// The motion time t at which it starts.
    pub fn start_time(self) -> f64 {
        match self {
            Self::Unfold => 0.0,
            Self::Fold => 1.0,
        }
    }
}

/// The target fold angle of every hinge as a function of stage and stage-local time s in [0, 1].
///
/// A uniform linear ramp: in `unfold` every crease goes from its deployed angle to 0, in `fold` from 0 to its compact
/// angle. Facet hinges are held at 0 throughout. Hinges are numbered as in [`crate::Model`]: the edges of the sheet
/// that join two triangles, in the order of the sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Schedule {
    ramps: Vec<Ramp>,
}

/// The end angles of one hinge; both are 0 in the planar state.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Ramp {
    deployed: f64,
    compact: f64,
}

impl Schedule {
    /// The uniform schedule of `sheet`.
    ///
    /// `deployed_angles`, `compact_angles`: radians, one for each edge of the sheet; those of edges that are not
    /// creases between two triangles are ignored.
    ///
    /// # Errors
    /// [`SolverError::Count`] where a list has not one entry for each edge, [`SolverError::NotFinite`] where the
    /// angle of a crease is NaN or infinite, [`SolverError::AngleOutOfRange`] where it is beyond ±2π.
    pub fn uniform(
        sheet: &Sheet,
        deployed_angles: &[f64],
        compact_angles: &[f64],
    ) -> Result<Self, SolverError> {
        check_count("deployed angles", sheet, deployed_angles)?;
        check_count("compact angles", sheet, compact_angles)?;
        let ramp = |(index, edge): (usize, &Edge)| {
            if !edge.is_crease() {
                return Ok(Ramp {
                    deployed: 0.0,
                    compact: 0.0,
                });
            }
            Ok(Ramp {
                deployed: checked("deployed angle of edge", index, deployed_angles[index])?,
                compact: checked("compact angle of edge", index, compact_angles[index])?,
            })
        };
        let hinges = sheet
            .edges
            .iter()
            .enumerate()
            .filter(|(_, edge)| edge.is_hinge());
        let ramps = hinges.map(ramp).collect::<Result<_, _>>()?;
        Ok(Self { ramps })
    }

    /// The number of hinges.
    pub fn hinge_count(&self) -> usize {
        self.ramps.len()
    }

    /// The target fold angle of `hinge` in radians at stage-local time `s`, taken within [0, 1].
    ///
    /// Precondition: `hinge` < [`Self::hinge_count`].
    pub fn target(&self, stage: Stage, hinge: usize, s: f64) -> f64 {
        let ramp = self.ramps[hinge];
        let s = s.clamp(0.0, 1.0);
        match stage {
            Stage::Unfold => ramp.deployed * (1.0 - s),
            Stage::Fold => ramp.compact * s,
        }
    }

    /// Writes the target of every hinge at stage-local time `s` into `targets`.
    ///
    /// Precondition: `targets` has [`Self::hinge_count`] entries.
    pub fn targets(&self, stage: Stage, s: f64, targets: &mut [f64]) {
        for (hinge, target) in targets.iter_mut().enumerate() {
            *target = self.target(stage, hinge, s);
        }
    }

    /// The largest turn any hinge makes in `stage`, in radians.
    pub fn largest_turn(&self, stage: Stage) -> f64 {
        let turn = |hinge| (self.target(stage, hinge, 1.0) - self.target(stage, hinge, 0.0)).abs();
        (0..self.hinge_count()).map(turn).fold(0.0, f64::max)
    }
}

fn check_count(what: &'static str, sheet: &Sheet, angles: &[f64]) -> Result<(), SolverError> {
    if angles.len() == sheet.edges.len() {
        Ok(())
    } else {
        Err(SolverError::Count {
            what,
            expected: sheet.edges.len(),
            found: angles.len(),
        })
    }
}

fn checked(what: &'static str, index: usize, value: f64) -> Result<f64, SolverError> {
    if !value.is_finite() {
        Err(SolverError::NotFinite { what, index })
    } else if value.abs() > MAX_ANGLE {
        Err(SolverError::AngleOutOfRange {
            what,
            index,
            value,
            limit: MAX_ANGLE,
        })
    } else {
        Ok(value)
    }
}
