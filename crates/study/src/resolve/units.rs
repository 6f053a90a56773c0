//! A sheet of units, resolved: profile, division, sheet and how it unfolds.

use std::time::Instant;

use foldmotion_geometry::{Division, Fit, Profile, RigidMotion};
use foldmotion_pattern::{CompactBox, LayerOrder, PatternCheck, UnitSheet};
use foldmotion_solver::{Schedule, ScheduleStep, Stage};
use glam::DVec3;

use super::input::Input;
use super::motion::schedule_error;
use super::profile::{DividedProfile, curve, division};
use super::rows::{steps_of, units};
use super::unfolding::Unfolding;
use super::unit::{MOST_ORDERED, Purpose, pattern_error, requested_case, too_many_layers};
use crate::scene::DivisionMethod;
use crate::{SceneSource, StudyError};

/// A sheet of units on a divided profile.
#[derive(Debug, Clone)]
pub struct UnitStudy {
    /// The curve Γ that the sheet approximates.
    pub profile: Profile,
    /// The origin of Γ: a built-in profile, or a key or file of the scene.
    pub profile_source: String,
    /// The division of Γ into segments.
    pub division: Division,
    /// The method of the division.
    pub division_method: DivisionMethod,
    /// The distances of Γ from its segments.
    pub fit: Fit,
    /// The wall-clock seconds of the division.
    pub division_seconds: f64,
    /// The sheet of units.
    pub units: UnitSheet,
    /// The pattern check.
    pub pattern: PatternCheck,
    /// The closed form of the compact box; `None` if the case has none.
    pub closed_form: Option<CompactBox>,
    /// The exact order of the layers in the compact state.
    pub compact_order: LayerOrder,
    /// The positions of the deployed state, at which the motion starts.
    pub deployed: Vec<DVec3>,
    /// The motion of the row creases in stage `unfold`.
    pub unfolding: Unfolding,
}

impl UnitStudy {
    /// Resolves profile, division, sheet and unfolding of a scene.
    ///
    /// # Errors
    /// The first unusable value, with file, line, key, value and remedy.
    pub fn resolve(source: &SceneSource) -> Result<Self, StudyError> {
        let scene = source.scene()?;
        let input = Input::new(source, &scene);
        Ok(unit_study(&input)?.0)
    }

    /// A state at motion time `time`, turned as figures show its stage: upright before the sheet is flat, then as the compact
    /// state lies. `positions` has one position for each vertex of the sheet.
    pub fn turned(&self, time: f64, positions: &[DVec3]) -> Vec<DVec3> {
        let fit = match time {
            t if t < 1.0 => RigidMotion::best_fit(positions, &self.deployed),
            1.0 => RigidMotion::best_fit(positions, &self.units.sheet.planar()),
            _ => RigidMotion::best_fit(positions, &self.units.compact()),
        };
        positions.iter().map(|&p| fit.apply(p)).collect()
    }
}

/// The divided profile and the sheet of units, without a motion.
pub(crate) struct ResolvedSheet {
    pub(crate) profile_source: String,
    pub(crate) divided: DividedProfile,
    division_seconds: f64,
    pub(crate) units: UnitSheet,
}

/// The sheet of units with its schedule.
pub(crate) fn unit_study(input: &Input<'_>) -> Result<(UnitStudy, Schedule), StudyError> {
    let ResolvedSheet { profile_source, divided, division_seconds, units } =
        lay_out(input, Purpose::Fold)?;
    let (profile, division) = (divided.profile, divided.division);
    let facing = input.scene.sheet.facing.unwrap_or_default();
    let deployed =
        units.deployed(&division.points, facing).map_err(|e| pattern_error(input, &e))?;
    let deployed_angles =
        units.deployed_angles(&division.points, facing).map_err(|e| pattern_error(input, &e))?;
    let steps = steps_of(input, &units)?;
    let mut schedule = Schedule::uniform(&units.sheet, &deployed_angles, units.compact_angles())?
        .with_steps(&units.sheet, &steps)
        .map_err(|e| schedule_error(input, e))?;
    let unfolding = unfolding(input, &profile, &division, &steps)?;
    if let Some(path) = unfolding.fold_angles(facing) {
        schedule = schedule.with_unfold_path(&units.sheet, path)?;
    }
    let study = UnitStudy {
        pattern: units.check(),
        closed_form: units.closed_form(),
        compact_order: compact_order(input, &units)?,
        profile,
        profile_source,
        division,
        division_method: divided.method,
        fit: divided.fit,
        division_seconds,
        units,
        deployed,
        unfolding,
    };
    Ok((study, schedule))
}

/// The layer order of the compact state, which check and films keep in memory.
fn compact_order(input: &Input<'_>, units: &UnitSheet) -> Result<LayerOrder, StudyError> {
    units.compact_order_within(MOST_ORDERED).ok_or_else(|| too_many_layers(input))
}

/// Divides the profile and lays out the sheet.
pub(crate) fn sheet(input: &Input<'_>) -> Result<ResolvedSheet, StudyError> {
    lay_out(input, Purpose::Show)
}

fn lay_out(input: &Input<'_>, purpose: Purpose) -> Result<ResolvedSheet, StudyError> {
    let curve = curve(input)?;
    let started = Instant::now();
    let divided = division(input, &curve)?;
    let division_seconds = started.elapsed().as_secs_f64();
    let columns = input.count(
        "sheet.columns",
        input.scene.sheet.columns,
        curve.model.map(|m| m.columns.of(requested_case(input))),
    )?;
    let units = units(input, curve.model, &divided.division, columns, purpose)?;
    Ok(ResolvedSheet { profile_source: curve.source, divided, division_seconds, units })
}

fn unfolding(
    input: &Input<'_>,
    profile: &Profile,
    division: &Division,
    steps: &[ScheduleStep],
) -> Result<Unfolding, StudyError> {
    let in_turn = steps
        .iter()
        .any(|step| step.stage == Stage::Unfold && (step.rows.is_some() || step.columns.is_some()));
    let requested = input.scene.motion.unfold.unwrap_or_default();
    Unfolding::new(requested, profile, division, in_turn)
        .map_err(|e| input.error("motion.unfold", e.to_string()))
}
