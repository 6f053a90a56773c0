//! Fold angles to pass through in stage `fold`.

use foldmotion_pattern::Sheet;

use super::{check_count, checked, hinge_edges};
use crate::SolverError;

/// The fold angle of every hinge at each waypoint, evenly spaced in the progress of stage `fold`, which starts flat and
/// ends at the last one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Waypoints {
    angles: Vec<Vec<f64>>,
}

impl Waypoints {
    /// `angles`: at each waypoint one angle for each edge of `sheet`, radians; those of edges that are not creases are
    /// taken as 0.
    pub(super) fn new(sheet: &Sheet, angles: &[Vec<f64>]) -> Result<Self, SolverError> {
        let of_hinges = |angles: &Vec<f64>| {
            check_count("angles of a waypoint", sheet, angles)?;
            let angle = |(index, edge): (usize, &foldmotion_pattern::Edge)| {
                if edge.is_crease() {
                    checked("angle at a waypoint of edge", index, angles[index])
                } else {
                    Ok(0.0)
                }
            };
            hinge_edges(sheet).map(angle).collect()
        };
        let angles = angles.iter().map(of_hinges).collect::<Result<_, _>>()?;
        Ok(Self { angles })
    }

    /// The angles with which the stage ends; `None` without waypoints.
    pub(super) fn last(&self) -> Option<&[f64]> {
        self.angles.last().map(Vec::as_slice)
    }

    /// The angle of `hinge` at `progress`, exact at both ends of the stage.
    #[expect(clippy::cast_sign_loss, reason = "progress is not negative")]
    pub(super) fn angle(&self, hinge: usize, progress: f64) -> f64 {
        let position = progress * self.angles.len() as f64;
        let leg = (position.floor() as usize).min(self.angles.len() - 1);
        let [a, b] = self.leg(hinge, leg);
        let share = position - leg as f64;
        a * (1.0 - share) + b * share
    }

    /// The greatest rate of the angle of `hinge`, radians per unit of progress.
    pub(super) fn fastest(&self, hinge: usize) -> f64 {
        let turn = |leg| {
            let [a, b] = self.leg(hinge, leg);
            (b - a).abs()
        };
        let largest = (0..self.angles.len()).map(turn).fold(0.0, f64::max);
        largest * self.angles.len() as f64
    }

    /// The angles of `hinge` at both ends of a leg.
    fn leg(&self, hinge: usize, leg: usize) -> [f64; 2] {
        let from = leg.checked_sub(1).map_or(0.0, |k| self.angles[k][hinge]);
        [from, self.angles[leg][hinge]]
    }
}
