//! How closely the motion of a symmetric sheet is symmetric.

use std::collections::HashSet;
use std::fmt::Write as _;

use foldmotion_geometry::{Number, RigidMotion};
use foldmotion_pattern::{Frame, Motion, Sheet};
use glam::{DVec2, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Vertices closer than this, in units of h, count as the same.
const SAME: f64 = 1e-7;

/// A frame further than this from its mirror image is no longer symmetric, in units of h. Rounding and the tolerance of
/// equilibrium leave less than 1e-6.
const BROKEN: f64 = 1e-6;

/// How well the motion keeps a mirror symmetry of its crease pattern and its first state.
///
/// A symmetric sheet that folds symmetrically at first and differs from its mirror image later has buckled: the symmetric
/// equilibrium became unstable, and rounding decides which of two mirrored paths it takes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SymmetryReport {
    /// The mirror: across the width or along the profile.
    pub mirror: Mirror,
    /// The largest distance of a vertex from its mirror image over all frames, each fitted by a rigid motion, in
    /// units of h.
    pub largest: f64,
    /// The motion time of the largest distance.
    pub largest_t: f64,
    /// The motion time of the first frame with a distance above 1e-6 h; null if there is none.
    pub broken_t: Option<f64>,
}

/// A mirror of a sheet of units.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Mirror {
    /// Swaps the two ends of every row.
    Across,
    /// Swaps the first row and the last.
    Along,
}

impl Mirror {
    const ALL: [Self; 2] = [Self::Across, Self::Along];

    /// The direction of the mirror, as part of a sentence.
    fn words(self) -> &'static str {
        match self {
            Self::Across => "across the width",
            Self::Along => "along the profile",
        }
    }

    fn image(self, point: DVec2, sum: DVec2) -> DVec2 {
        match self {
            Self::Across => DVec2::new(point.x, sum.y - point.y),
            Self::Along => DVec2::new(sum.x - point.x, point.y),
        }
    }
}

impl SymmetryReport {
    /// The reports of all mirrors that map the edges of the sheet and the first frame of `motion` to themselves.
    pub(crate) fn all(motion: &Motion) -> Vec<Self> {
        let reports = Mirror::ALL.into_iter().filter_map(|mirror| {
            let images = images(&motion.sheet, mirror)?;
            Self::of(mirror, &images, motion)
        });
        reports.collect()
    }

    /// The report of a mirror; `None` if the first frame is not symmetric. `images` has the mirror image of each vertex.
    fn of(mirror: Mirror, images: &[usize], motion: &Motion) -> Option<Self> {
        let h = motion.sheet.unit_length;
        let mut report =
            Self { mirror, largest: 0.0, largest_t: motion.frames.first()?.time, broken_t: None };
        for (index, Frame { time, positions }) in motion.frames.iter().enumerate() {
            let distance = asymmetry(positions, images) / h;
            let is_broken = distance > BROKEN;
            if index == 0 && is_broken {
                return None;
            }
            if distance > report.largest {
                (report.largest, report.largest_t) = (distance, *time);
            }
            if is_broken {
                report.broken_t.get_or_insert(*time);
            }
        }
        Some(report)
    }

    /// A line for the terminal.
    pub(crate) fn line(&self) -> String {
        let mut line = format!(
            "mirrored {}, vertices differ by {:.1} h at most (t = {:.4})",
            self.mirror.words(),
            Number(self.largest),
            self.largest_t
        );
        if let Some(t) = self.broken_t {
            // Writing into a string cannot fail.
            let _ = write!(
                line,
                "; symmetric until t = {t:.4}, where the sheet buckles or its schedule is not symmetric"
            );
        }
        line
    }
}

/// The mirror image of each vertex; `None` if the sheet is not its own mirror image.
fn images(sheet: &Sheet, mirror: Mirror) -> Option<Vec<usize>> {
    let near = SAME * sheet.unit_length;
    let points = &sheet.vertices;
    let low = points.iter().copied().reduce(DVec2::min)?;
    let high = points.iter().copied().reduce(DVec2::max)?;
    let mut by_x: Vec<usize> = (0..points.len()).collect();
    by_x.sort_by(|&i, &j| points[i].x.total_cmp(&points[j].x));
    let image = |point: &DVec2| {
        let image = mirror.image(*point, low + high);
        let from = by_x.partition_point(|&i| points[i].x < image.x - near);
        let close = by_x[from..].iter().copied();
        close
            .take_while(|&i| points[i].x <= image.x + near)
            .find(|&i| points[i].distance(image) <= near)
    };
    let images: Vec<usize> = points.iter().map(image).collect::<Option<_>>()?;
    let sorted = |[a, b]: [usize; 2]| [a.min(b), a.max(b)];
    let edges = sheet.edges.iter().map(|edge| (edge, edge.vertices.map(|v| v as usize)));
    let known: HashSet<_> =
        edges.clone().map(|(edge, ends)| (sorted(ends), edge.assignment.letter())).collect();
    let mut mirrored =
        edges.map(|(edge, ends)| (sorted(ends.map(|v| images[v])), edge.assignment.letter()));
    mirrored.all(|edge| known.contains(&edge)).then_some(images)
}

/// The largest distance of `positions` from their mirror image after the best rigid fit.
fn asymmetry(positions: &[DVec3], images: &[usize]) -> f64 {
    let reflect = |&i: &usize| positions[i] * DVec3::new(1.0, -1.0, 1.0);
    let reflected: Vec<DVec3> = images.iter().map(reflect).collect();
    let fit = RigidMotion::best_fit(&reflected, positions);
    let pairs = reflected.iter().zip(positions);
    pairs.map(|(&image, &p)| fit.apply(image).distance(p)).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests;
