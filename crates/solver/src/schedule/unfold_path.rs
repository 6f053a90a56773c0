//! A path of the row creases along stage `unfold`.

use foldmotion_pattern::{CreaseKind, Sheet};

use super::{checked, hinge_edges};
use crate::SolverError;

/// By how much the path may start beside the deployed angles, radians: what rounding makes of them.
const START_TOLERANCE: f64 = 1e-9;

/// The fold angles of the row creases along stage `unfold`, piecewise linear in its progress.
///
/// All creases on one boundary between rows fold alike. Boundaries are numbered as [`foldmotion_pattern::Edge::row`]
/// numbers their creases, from 1.
#[derive(Debug, Clone, PartialEq)]
pub struct UnfoldPath {
    /// The progress of each knot, strictly ascending from 0 to 1.
    pub progress: Vec<f64>,
    /// At each knot the fold angle of every boundary, radians: the deployed angles at first, 0 at last.
    pub angles: Vec<Vec<f64>>,
}

impl UnfoldPath {
    /// The first error in its numbers.
    fn check(&self) -> Result<(), SolverError> {
        let knots = self.progress.len();
        let count = |what, expected, found| {
            if expected == found {
                Ok(())
            } else {
                Err(SolverError::Count { what, expected, found })
            }
        };
        count("knots of the unfold path", knots.max(2), knots)?;
        count("knots of the unfold path", knots, self.angles.len())?;
        for (knot, &value) in self.progress.iter().enumerate() {
            let is_in_order = match knot {
                0 => value == 0.0,
                _ if knot + 1 == knots => value == 1.0 && self.progress[knot - 1] < 1.0,
                _ => value > self.progress[knot - 1] && value < 1.0,
            };
            if !is_in_order {
                return Err(SolverError::PathProgress { knot, value });
            }
        }
        for angles in &self.angles {
            count("rows of the unfold path", self.angles[0].len(), angles.len())?;
            for (index, &angle) in angles.iter().enumerate() {
                checked("angle of the unfold path at row", index + 1, angle)?;
            }
        }
        Ok(())
    }

    /// The angle of a boundary, given as its place in the lists, at `progress`.
    fn angle(&self, boundary: usize, progress: f64) -> f64 {
        let last = self.progress.len() - 1;
        let next = self.progress.partition_point(|&p| p <= progress);
        let next = next.clamp(1, last);
        let [start, end] = [next - 1, next].map(|knot| self.progress[knot]);
        let share = ((progress - start) / (end - start)).clamp(0.0, 1.0);
        let [a, b] = [next - 1, next].map(|knot| self.angles[knot][boundary]);
        a * (1.0 - share) + b * share
    }

    /// The greatest rate of a boundary's angle, radians per unit of progress.
    fn fastest(&self, boundary: usize) -> f64 {
        let knots = self.progress.windows(2).zip(self.angles.windows(2));
        let rate = |(progress, angles): (&[f64], &[Vec<f64>])| {
            (angles[1][boundary] - angles[0][boundary]).abs() / (progress[1] - progress[0])
        };
        knots.map(rate).fold(0.0, f64::max)
    }
}

/// A path with the hinges that follow it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FollowedPath {
    path: UnfoldPath,
    /// The index of each hinge's boundary in the path; `None` for hinges that are not row creases.
    boundaries: Vec<Option<u32>>,
}

impl FollowedPath {
    /// Binds `path` to the row creases of `sheet`, whose hinges start at the angles `deployed`.
    pub(super) fn new(
        sheet: &Sheet,
        mut path: UnfoldPath,
        deployed: &[f64],
    ) -> Result<Self, SolverError> {
        path.check()?;
        let last = path.progress.len() - 1;
        let mut boundaries = Vec::with_capacity(deployed.len());
        for ((edge_index, edge), &angle) in hinge_edges(sheet).zip(deployed) {
            if !edge.is_crease() || edge.kind != CreaseKind::Row {
                boundaries.push(None);
                continue;
            }
            let boundary = edge.row as usize - 1;
            let Some(&start) = path.angles[0].get(boundary) else {
                return Err(SolverError::Count {
                    what: "rows of the unfold path",
                    expected: boundary + 1,
                    found: path.angles[0].len(),
                });
            };
            let end = path.angles[last][boundary];
            if (start - angle).abs() > START_TOLERANCE || end != 0.0 {
                return Err(SolverError::PathEnds {
                    edge: edge_index,
                    ends: [start, end],
                    deployed: angle,
                });
            }
            path.angles[0][boundary] = angle;
            boundaries.push(Some(boundary as u32));
        }
        Ok(Self { path, boundaries })
    }

    /// The angle of `hinge` at `progress`; `None` if it does not follow the path.
    pub(super) fn angle(&self, hinge: usize, progress: f64) -> Option<f64> {
        let boundary = self.boundaries[hinge]? as usize;
        Some(self.path.angle(boundary, progress))
    }

    /// The greatest rate of the angle of `hinge`, radians per unit of progress; `None` if it does not follow the path.
    pub(super) fn fastest(&self, hinge: usize) -> Option<f64> {
        let boundary = self.boundaries[hinge]? as usize;
        Some(self.path.fastest(boundary))
    }
}
