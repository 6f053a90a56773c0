//! On which side of each other two triangles are.

use glam::DVec3;

use crate::arcs;
use crate::instant::{Axis, axes};
use crate::moving_pair::MovingPair;

/// Triangles with common vertices are clear of each other if they are apart by more than this share of their size.
const CLEAR_SHARE: f64 = 1e-3;

/// On which side of each other two triangles are.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Side {
    /// Whether they are apart by more than τ (`clearance`): then every separating direction can be reached from every
    /// other.
    pub(crate) is_apart: bool,
    /// Unit directions in the part of D(t) that the pair has reached; may be empty if the triangles are apart.
    pub(crate) directions: Vec<DVec3>,
}

/// The limits for following a pair.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Limits {
    /// τ, a length.
    pub(crate) tolerance: f64,
    /// The largest number of steps for a pair in an interval.
    pub(crate) budget: u32,
}

impl Side {
    /// Apart, along this direction among others.
    pub(crate) fn apart(direction: DVec3) -> Self {
        Self { is_apart: true, directions: vec![direction] }
    }

    /// In contact, with these directions reached.
    pub(crate) fn contact(directions: Vec<DVec3>) -> Self {
        Self { is_apart: false, directions }
    }

    /// The side at the first instant of a motion: any that D(t) allows; `None` if the triangles are deeper than τ.
    pub(crate) fn at_start(moving: &MovingPair, limits: &Limits) -> Option<Self> {
        let pose = moving.at(0.0);
        let all = axes(moving, &pose);
        if let Some(best) = clear_of(&all, clearance(moving, limits)) {
            return Some(Self::apart(best));
        }
        let within = all.iter().filter(|x| x.overlap <= limits.tolerance);
        let mut directions: Vec<_> = within.map(|x| x.direction).collect();
        if directions.is_empty() {
            let within = arcs::normals(&pose).into_iter();
            directions = within.filter(|&d| pose.overlap(d) <= limits.tolerance).collect();
        }
        let has_some = !directions.is_empty();
        has_some.then_some(Self::contact(directions))
    }
}

/// Triangles that are apart by more than this have only one side.
///
/// Corners on a plane through common vertices have no room, so that with common vertices more than τ is needed.
pub(crate) fn clearance(moving: &MovingPair, limits: &Limits) -> f64 {
    match moving.shared {
        0 => limits.tolerance,
        _ => limits.tolerance.max(CLEAR_SHARE * moving.size),
    }
}

/// The direction with the most room, if that exceeds the tolerance.
pub(crate) fn clear_of(axes: &[Axis], tolerance: f64) -> Option<DVec3> {
    let clear = axes.iter().filter(|axis| axis.room > tolerance);
    let best = clear.reduce(|p, q| if q.room > p.room { q } else { p });
    best.map(|axis| axis.direction)
}
