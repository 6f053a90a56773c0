//! How close the creases came to the fold angles they were driven to.

use std::f64::consts::TAU;

use foldmotion_pattern::{Assignment, Sheet};
use foldmotion_solver::quasi_static::FOLDED_WITHIN_DEG;
use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Differences of the fold angles in the last state from the targets of the end of the motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FoldAngleReport {
    /// The largest error of all mountain and valley creases, in degrees; 0 if there are none.
    pub largest_error_deg: f64,
    /// The mean error of these creases, in degrees.
    pub mean_error_deg: f64,
    /// The edge of the motion file with the largest error; null if there is no mountain or valley crease.
    pub edge: Option<usize>,
    /// The sheet counts as folded if no crease is further than this from its target, in degrees.
    pub tolerance_deg: f64,
    /// The mean error in degrees if the layers of the last state were then let through each other, which tells whether
    /// contact or the stiffness of the sheet keeps creases from their targets; null if the creases are near them, no
    /// layers push, or the motion ended early.
    #[serde(default)]
    pub mean_error_without_contact_deg: Option<f64>,
}

impl FoldAngleReport {
    /// Compares the state `positions` with `targets`, one angle for each edge in radians. Angles are compared modulo 360
    /// degrees: whether a crease passed 180 degrees is a question for the collision check.
    pub(crate) fn new(sheet: &Sheet, positions: &[DVec3], targets: &[f64]) -> Self {
        let angles = sheet.fold_angles(positions);
        let driven = [Assignment::Mountain, Assignment::Valley];
        let errors = sheet.edges.iter().zip(angles).zip(targets).enumerate();
        let errors = errors.filter_map(|(index, ((edge, angle), target))| {
            let angle = angle.filter(|_| driven.contains(&edge.assignment))?;
            let turn = (angle - target).rem_euclid(TAU);
            Some((index, turn.min(TAU - turn).to_degrees()))
        });
        let (mut sum, mut count) = (0.0, 0_u32);
        let mut largest: Option<(usize, f64)> = None;
        for (index, error) in errors {
            sum += error;
            count += 1;
            if largest.is_none_or(|(_, before)| error > before) {
                largest = Some((index, error));
            }
        }
        Self {
            largest_error_deg: largest.map_or(0.0, |(_, error)| error),
            mean_error_deg: sum / f64::from(count.max(1)),
            edge: largest.map(|(index, _)| index),
            tolerance_deg: FOLDED_WITHIN_DEG,
            mean_error_without_contact_deg: None,
        }
    }

    /// Whether every crease ends close to its target.
    pub(crate) fn is_folded(&self) -> bool {
        self.largest_error_deg <= self.tolerance_deg
    }

    /// The errors of the creases, as part of a sentence.
    pub(crate) fn words(&self) -> String {
        let without = self
            .mean_error_without_contact_deg
            .map_or_else(String::new, |error| format!("; without contact, {error:.1} on average"));
        format!(
            "creases end up to {:.1} degrees from their targets ({:.1} on average{without})",
            self.largest_error_deg, self.mean_error_deg
        )
    }
}
