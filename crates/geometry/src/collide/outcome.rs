//! The result of certifying a pair of moving triangles.

use glam::DVec3;

use super::{Axis, Limits, PairPose, separating::widest};

/// On which side of each other two triangles are at an instant.
#[derive(Debug, Clone, PartialEq)]
pub enum Side {
    /// Strictly apart, along this axis among others.
    Apart(DVec3),
    /// In contact; these axes represent the parts of D(t) that can be reached without changing sides.
    Contact(Vec<DVec3>),
}

impl Side {
    /// The side at the first instant: apart if an axis separates, otherwise any side within the tolerance; `None` if
    /// the triangles are deeper than τ.
    pub fn at_start(pose: &PairPose, limits: &Limits) -> Option<Self> {
        if let Some(axis) = widest(pose, limits) {
            return Some(Self::Apart(axis));
        }
        let axes = pose.axes_within(limits.tolerance - limits.margin, limits);
        let directions: Vec<_> = axes.iter().map(|axis| axis.direction).collect();
        (!directions.is_empty()).then_some(Self::Contact(directions))
    }
}

/// The work needed for a certificate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Effort {
    /// One direction at rest separates throughout (for triangles that share an edge: one sign does not change).
    AxisAtRest,
    /// Directions that turn along with the triangles separate.
    TurningAxis,
    /// All axes had to be tried.
    Search,
}

/// The certificate of a pair that neither gets deeper than τ nor changes sides.
#[derive(Debug, Clone, PartialEq)]
pub struct PairCertificate {
    /// The side of the pair at t = 1.
    pub side: Side,
    /// A lower bound of the distance; not positive if there may be contact. Meaningless for triangles that share
    /// corners.
    pub clearance: f64,
    /// Whether some step is certified only as touching.
    pub in_contact: bool,
    /// The work that the certificate needed.
    pub effort: Effort,
}

/// A pair that gets deeper than τ, or leaves contact on the other side.
#[derive(Debug, Clone, PartialEq)]
pub struct PairCrossing {
    /// The time at which the contact began that leads to the crossing; 0 if the pair starts in contact.
    pub contact: f64,
    /// The time at which the overlap passed τ on the side the pair was followed on, to within 2⁻³³.
    pub passed: f64,
    /// A time after `passed` at which the crossing was confirmed.
    pub confirmed: f64,
    /// The axis of the overlap at the time `confirmed`.
    pub axis: Axis,
    /// The largest overlap, seen from its side, at the sampled instants from `passed` on.
    pub reach: f64,
    /// The largest depth at the sampled instants from `passed` on: at most τ if the pair only changed sides.
    pub depth: f64,
}

/// The verdict on a pair over t in [0, 1].
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// The pair is certified.
    Passed(PairCertificate),
    /// The pair crosses, with the evidence.
    Crossed(PairCrossing),
    /// Neither was found within the budget, or before steps became too short.
    Undecided {
        /// The time up to which the pair is certified.
        time: f64,
    },
}
