//! Directions along which two triangles are strictly apart at an instant.

use glam::DVec3;

use super::{Limits, PairPose};

/// The directions along which the triangles are strictly apart, with the gap.
pub(super) fn separating(pose: &PairPose, limits: &Limits) -> impl Iterator<Item = (DVec3, f64)> {
    let coordinates = [DVec3::X, DVec3::Y, DVec3::Z];
    let axes = pose.axes_within(limits.margin, limits);
    axes.into_iter()
        .map(|axis| axis.direction)
        .chain(coordinates.into_iter().flat_map(|d| [d, -d]))
        .map(|d| (d, pose.gap(d, limits)))
        .filter(|&(_, gap)| gap > limits.margin)
}

/// The direction along which the triangles are apart most clearly; `None` if no axis separates them.
pub(super) fn widest(pose: &PairPose, limits: &Limits) -> Option<DVec3> {
    separating(pose, limits)
        .reduce(|best, next| if next.1 > best.1 { next } else { best })
        .map(|(direction, _)| direction)
}
