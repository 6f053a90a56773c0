//! The schedule: the target fold angle of every hinge along the motion.

use std::collections::BTreeSet;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use foldmotion_pattern::{Edge, Sheet};
use glam::DVec3;

mod step;
mod timing;
mod unfold_path;
mod waypoints;

pub use step::{CreaseGroup, ScheduleStep};
pub use timing::Ease;
pub use unfold_path::UnfoldPath;

use timing::Timing;
use unfold_path::FollowedPath;
use waypoints::Waypoints;

use crate::{Model, SolverError};

/// The largest target taken: a whole turn, twice what paper allows.
const MAX_ANGLE: f64 = std::f64::consts::TAU;

/// A stage of the motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Stage {
    /// Deployed to planar: motion time t from 0 to 1.
    Unfold,
    /// Planar to compact: motion time t from 1 to 2.
    Fold,
}

impl Stage {
    /// Both, in the order of the motion.
    pub const ALL: [Self; 2] = [Self::Unfold, Self::Fold];

    /// The name in reports and files.
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

    /// Its place in [`Self::ALL`].
    fn index(self) -> usize {
        match self {
            Self::Unfold => 0,
            Self::Fold => 1,
        }
    }
}

/// The target fold angle of every hinge as a function of stage and stage-local time s in [0, 1].
///
/// In `unfold` every crease goes from its deployed angle to 0, in `fold` from 0 to its compact angle: θ* = θ_deployed
/// (1 − p(s)), then θ* = θ_compact p(s), where p(s) = s unless a [`ScheduleStep`] names the crease; then it is 0 before
/// the step, 1 after it and follows its [`Ease`] in between. Given an [`UnfoldPath`], the row creases follow it in
/// `unfold` instead, at the progress p(s). Given waypoints, every crease passes through them in `fold`, at the progress
/// p(s). Facet hinges are held at 0 throughout. Hinges are numbered as in [`crate::Model`]: the edges of the sheet that
/// join two triangles, in the order of the sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Schedule {
    hinges: Vec<[Turn; 2]>,
    unfold_path: Option<FollowedPath>,
    waypoints: Option<Waypoints>,
}

/// The turn of a hinge in one stage; at its other end the sheet is planar and the hinge at 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Turn {
    /// The fold angle in the deployed or the compact state, radians; along a path that turns a crease to and fro, its
    /// greatest rate for the unit of progress, as seen by [`Schedule::turns`].
    pub(crate) angle: f64,
    /// When the turn is made.
    pub(crate) timing: Timing,
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
        let turn = |angle| Turn { angle, timing: Timing::UNIFORM };
        let turns = |(index, edge): (usize, &Edge)| {
            if !edge.is_crease() {
                return Ok([turn(0.0); 2]);
            }
            Ok([
                turn(checked("deployed angle of edge", index, deployed_angles[index])?),
                turn(checked("compact angle of edge", index, compact_angles[index])?),
            ])
        };
        let hinges = hinge_edges(sheet).map(turns).collect::<Result<_, _>>()?;
        Ok(Self { hinges, unfold_path: None, waypoints: None })
    }

    /// The same schedule, with the row creases following `path` in `unfold`; steps go on timing them.
    ///
    /// `sheet` is the one the schedule was made for.
    ///
    /// # Errors
    /// [`SolverError::PathProgress`], [`SolverError::NotFinite`], [`SolverError::AngleOutOfRange`] where its numbers are out
    /// of order or range, [`SolverError::PathEnds`] where it does not lead from the deployed angles to 0,
    /// [`SolverError::Count`] where it or the sheet has another number of rows.
    pub fn with_unfold_path(
        mut self,
        sheet: &Sheet,
        path: UnfoldPath,
    ) -> Result<Self, SolverError> {
        self.check_sheet(sheet)?;
        let unfold = Stage::Unfold.index();
        let deployed: Vec<f64> = self.hinges.iter().map(|turns| turns[unfold].angle).collect();
        self.unfold_path = Some(FollowedPath::new(sheet, path, &deployed)?);
        Ok(self)
    }

    /// The same schedule, with the creases passing through `angles` in `fold`: lists of one angle for each edge,
    /// radians, evenly spaced in the progress of the stage, which ends at the last. Steps go on timing them.
    ///
    /// `sheet` is the one the schedule was made for. No waypoints change nothing.
    ///
    /// # Errors
    /// [`SolverError::Count`], [`SolverError::NotFinite`], [`SolverError::AngleOutOfRange`].
    pub fn with_waypoints(
        mut self,
        sheet: &Sheet,
        angles: &[Vec<f64>],
    ) -> Result<Self, SolverError> {
        self.check_sheet(sheet)?;
        let waypoints = Waypoints::new(sheet, angles)?;
        let Some(ends) = waypoints.last() else {
            return Ok(self);
        };
        for (turns, &end) in self.hinges.iter_mut().zip(ends) {
            turns[Stage::Fold.index()].angle = end;
        }
        self.waypoints = Some(waypoints);
        Ok(self)
    }

    fn check_sheet(&self, sheet: &Sheet) -> Result<(), SolverError> {
        let found = hinge_edges(sheet).count();
        if found == self.hinges.len() {
            return Ok(());
        }
        Err(SolverError::Count { what: "hinges of the sheet", expected: self.hinges.len(), found })
    }

    /// The same end angles, reached by `steps`; creases that no step of a stage names follow its uniform ramp.
    ///
    /// Steps given before are forgotten. `sheet` is the one the schedule was made for. A crease of a stage may be named
    /// by one step only.
    ///
    /// # Errors
    /// Each with the index of the step: [`SolverError::StepTime`], [`SolverError::StepDuration`],
    /// [`SolverError::StepRange`] where its numbers do not fit the stage or the sheet, [`SolverError::StepNamesNone`],
    /// [`SolverError::StepsOverlap`]; [`SolverError::Count`] for a sheet with another number of hinges.
    pub fn with_steps(self, sheet: &Sheet, steps: &[ScheduleStep]) -> Result<Self, SolverError> {
        self.with_steps_among(sheet, steps, &[])
    }

    /// As [`Self::with_steps`], where step k only moves creases whose edges are in `among[k]`; a step without a set
    /// moves all that it names.
    ///
    /// # Errors
    /// Those of [`Self::with_steps`].
    pub fn with_steps_among(
        mut self,
        sheet: &Sheet,
        steps: &[ScheduleStep],
        among: &[Option<BTreeSet<u32>>],
    ) -> Result<Self, SolverError> {
        self.check_sheet(sheet)?;
        let edges: Vec<(usize, &Edge)> = hinge_edges(sheet).collect();
        for turn in self.hinges.iter_mut().flatten() {
            turn.timing = Timing::UNIFORM;
        }
        // By which step each hinge is named in either stage.
        let mut named_by = vec![[None; 2]; edges.len()];
        for (index, step) in steps.iter().enumerate() {
            step.check(index, sheet)?;
            let stage = step.stage.index();
            let mut is_idle = true;
            let edges_of_step = among.get(index).and_then(Option::as_ref);
            let is_among =
                |edge: usize| edges_of_step.is_none_or(|edges| edges.contains(&(edge as u32)));
            let moves = |(edge, e): &(usize, &Edge)| step.names(e) && is_among(*edge);
            for (hinge, &(edge, _)) in edges.iter().enumerate().filter(|(_, edge)| moves(edge)) {
                is_idle = false;
                if let Some(earlier) = named_by[hinge][stage].replace(index) {
                    return Err(SolverError::StepsOverlap {
                        steps: [earlier, index],
                        stage: step.stage.name(),
                        edge,
                    });
                }
                self.hinges[hinge][stage].timing = step.timing();
            }
            if is_idle {
                return Err(SolverError::StepNamesNone { step: index });
            }
        }
        Ok(self)
    }

    /// Whether `start` (one position for each vertex) is a state of `model` from which this schedule can move it.
    ///
    /// # Errors
    /// [`SolverError::Count`] where positions or hinges are too few or too many, [`SolverError::NotFinite`].
    pub(crate) fn check_start(&self, model: &Model, start: &[DVec3]) -> Result<(), SolverError> {
        let counts = [
            ("start positions", model.node_count(), start.len()),
            ("scheduled hinges", model.hinges.len(), self.hinge_count()),
        ];
        for (what, expected, found) in counts {
            if expected != found {
                return Err(SolverError::Count { what, expected, found });
            }
        }
        match start.iter().position(|p| !p.is_finite()) {
            Some(index) => Err(SolverError::NotFinite { what: "start position of vertex", index }),
            None => Ok(()),
        }
    }

    /// The number of hinges.
    pub fn hinge_count(&self) -> usize {
        self.hinges.len()
    }

    /// The target fold angle of `hinge` in radians at stage-local time `s`, taken within [0, 1].
    ///
    /// Exact at both ends of the stage and of every step. Precondition: `hinge` < [`Self::hinge_count`].
    pub fn target(&self, stage: Stage, hinge: usize, s: f64) -> f64 {
        let Turn { angle, timing } = self.hinges[hinge][stage.index()];
        let progress = timing.progress(s);
        match (stage, &self.unfold_path) {
            (Stage::Unfold, Some(path)) => path.angle(hinge, progress).unwrap_or(0.0),
            (Stage::Unfold, None) => angle * (1.0 - progress),
            (Stage::Fold, _) => match &self.waypoints {
                Some(waypoints) => waypoints.angle(hinge, progress),
                None => angle * progress,
            },
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

    /// The turns of `stage` that differ in their timing, each with the largest angle, in radians, made with it or,
    /// along a path, the greatest rate for the unit of progress; `None` if nothing turns.
    pub(crate) fn turns(&self, stage: Stage) -> Vec<Turn> {
        let mut turns: Vec<Turn> = Vec::new();
        for (hinge, ends) in self.hinges.iter().enumerate() {
            let Turn { angle, timing } = ends[stage.index()];
            let rate = match (stage, &self.unfold_path) {
                (Stage::Unfold, Some(path)) => path.fastest(hinge),
                (Stage::Unfold, None) => None,
                (Stage::Fold, _) => self.waypoints.as_ref().map(|w| w.fastest(hinge)),
            };
            let angle = rate.unwrap_or(angle.abs());
            match turns.iter_mut().find(|turn| turn.timing == timing) {
                Some(turn) => turn.angle = turn.angle.max(angle),
                None if angle > 0.0 => turns.push(Turn { angle, timing }),
                None => {}
            }
        }
        turns
    }
}

/// The edges with a fold angle, each with its index in the sheet.
fn hinge_edges(sheet: &Sheet) -> impl Iterator<Item = (usize, &Edge)> {
    sheet.edges.iter().enumerate().filter(|(_, edge)| edge.is_hinge())
}

fn check_count(what: &'static str, sheet: &Sheet, angles: &[f64]) -> Result<(), SolverError> {
    if angles.len() == sheet.edges.len() {
        Ok(())
    } else {
        Err(SolverError::Count { what, expected: sheet.edges.len(), found: angles.len() })
    }
}

fn checked(what: &'static str, index: usize, value: f64) -> Result<f64, SolverError> {
    if !value.is_finite() {
        Err(SolverError::NotFinite { what, index })
    } else if value.abs() > MAX_ANGLE {
        Err(SolverError::AngleOutOfRange { what, index, value, limit: MAX_ANGLE })
    } else {
        Ok(value)
    }
}
