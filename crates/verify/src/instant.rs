//! The axes of two triangles at an instant.

use glam::DVec3;

use crate::arcs::{self, reached};
use crate::moving_pair::{COORDINATES, Feature, MovingPair, PairPose};

/// An axis at an instant.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Axis {
    /// The feature it is built from, and 1 or −1 for its sense.
    pub(crate) feature: (Feature, f64),
    /// The unit direction of the axis.
    pub(crate) direction: DVec3,
    /// max d·a − min d·b plus a bound of the rounding error, so that it is not less than the true overlap.
    pub(crate) overlap: f64,
    /// By how much the parts that are not shared are apart, minus a bound of the rounding error; positive if they are
    /// apart.
    pub(crate) room: f64,
}

/// All axes in both senses; those too short to have a direction are left out.
pub(crate) fn axes(moving: &MovingPair, pose: &PairPose) -> Vec<Axis> {
    let edges = |t: &[DVec3; 3]| [t[1] - t[0], t[2] - t[1], t[0] - t[2]];
    let (a, b) = (edges(&pose.a), edges(&pose.b));
    let (normal_a, normal_b) = (a[0].cross(a[1]), b[0].cross(b[1]));
    let mut axes = Vec::with_capacity(40);
    for feature in moving.features() {
        let (normal, power) = match feature {
            Feature::NormalA => (normal_a, 2),
            Feature::NormalB => (normal_b, 2),
            Feature::Edges(i, j) => (a[i].cross(b[j]), 2),
            Feature::SideA(i) => (normal_a.cross(a[i]), 3),
            Feature::SideB(j) => (normal_b.cross(b[j]), 3),
            Feature::AcrossA(j) => (normal_a.cross(b[j]), 3),
            Feature::AcrossB(i) => (normal_b.cross(a[i]), 3),
            Feature::BesideA => (a[0].cross(b[0]).cross(a[0]), 3),
            Feature::BesideB => (a[0].cross(b[0]).cross(b[0]), 3),
            Feature::Coordinate(k) => (COORDINATES[k], 0),
        };
        let length = normal.length();
        let margin = 256.0 * f64::EPSILON * moving.size.powi(power + 1) / length;
        if margin < 1e-3 * moving.size {
            push_both_ways(&mut axes, moving, pose, feature, (normal / length, margin));
        }
    }
    axes
}

fn push_both_ways(
    axes: &mut Vec<Axis>,
    moving: &MovingPair,
    pose: &PairPose,
    feature: Feature,
    (direction, margin): (DVec3, f64),
) {
    let height = |p: DVec3| direction.dot(p - pose.a[0]);
    let (a, b) = (pose.a.map(height), pose.b.map(height));
    let on_plane = moving.on_plane(feature);
    for sign in [1.0, -1.0] {
        let (a, b) = (a.map(|h| sign * h), b.map(|h| sign * h));
        let overlap = a[0].max(a[1]).max(a[2]) - b[0].min(b[1]).min(b[2]);
        let room = if moving.shared == 0 {
            -overlap
        } else if moving.may_clear(feature) {
            let below = (0..3).filter(|&i| !on_plane.a[i]).map(|i| -a[i]);
            let above = (0..3).filter(|&j| !on_plane.b[j]).map(|j| b[j]);
            let room = below.chain(above).fold(f64::INFINITY, f64::min);
            if room.is_finite() { room } else { 0.0 }
        } else {
            f64::NEG_INFINITY
        };
        axes.push(Axis {
            feature: (feature, sign),
            direction: direction * sign,
            overlap: overlap + margin,
            room: room - margin,
        });
    }
}

/// The direction along which what is not shared lies apart most clearly; `None` if no axis separates it.
pub(crate) fn roomiest(axes: &[Axis]) -> Option<DVec3> {
    let apart = axes.iter().filter(|axis| axis.room > 0.0);
    let best = apart.reduce(|p, q| if q.room > p.room { q } else { p });
    best.map(|axis| axis.direction)
}

/// The depth: the smallest overlap over all axes (exact if it is positive and the triangles share nothing).
pub(crate) fn depth(moving: &MovingPair, pose: &PairPose) -> f64 {
    let overlaps = axes(moving, pose).into_iter();
    let overlaps = overlaps.map(|axis| pose.overlap(axis.direction));
    overlaps.fold(arcs::depth(pose), f64::min)
}

/// The mean of the directions along which the triangles do not overlap, to within rounding.
pub(crate) fn inner(moving: &MovingPair, axes: &[Axis]) -> Option<DVec3> {
    let rounding = 1e-12 * moving.size;
    let rim = axes.iter().filter(|axis| axis.overlap <= rounding);
    rim.map(|axis| axis.direction).sum::<DVec3>().try_normalize()
}

/// The axes with an overlap of at most `limit` that are connected to a seed in D(t).
pub(crate) fn joined(pose: &PairPose, axes: &[Axis], seeds: &[DVec3], limit: f64) -> Vec<Axis> {
    let low: Vec<Axis> = axes.iter().copied().filter(|x| x.overlap <= limit).collect();
    let nodes: Vec<DVec3> = low.iter().map(|x| x.direction).collect();
    let is_reached = reached(pose, &nodes, seeds, limit);
    let both = low.into_iter().zip(is_reached);
    both.filter_map(|(axis, is_reached)| is_reached.then_some(axis)).collect()
}
