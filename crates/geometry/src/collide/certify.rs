//! The verdict on a pair of moving triangles.

use glam::DVec3;

use super::{
    Axis, Limits, MovingPair, PairPose,
    meeting::never_meet,
    walk::{Walk, widest},
};

/// The first steps tried, in turn: a coarse step may lose a part of D(t) that a fine one follows.
const FIRST_STEPS: [f64; 3] = [1.0, 1.0 / 16.0, 1.0 / 256.0];

/// On which side of each other two triangles are at an instant.
#[derive(Debug, Clone, PartialEq)]
pub enum Side {
    /// Strictly apart, along this axis among others.
    Apart(DVec3),
    /// In contact; axes that hold the parts of D(t) that can be reached without changing sides.
    Contact(Vec<DVec3>),
}

impl Side {
    /// The side at the first instant: apart where an axis separates, otherwise any side within the tolerance; none
    /// where the triangles are deeper than τ.
    pub fn at_start(pose: &PairPose, limits: &Limits) -> Option<Self> {
        if let Some(axis) = widest(pose, limits) {
            return Some(Self::Apart(axis));
        }
        let axes = pose.axes_within(limits.tolerance - limits.margin, limits);
        let directions: Vec<_> = axes.iter().map(|axis| axis.direction).collect();
        (!directions.is_empty()).then_some(Self::Contact(directions))
    }
}

/// What a certificate took.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Effort {
    /// One direction at rest separates throughout (or, for triangles that share an edge, one sign).
    AxisAtRest,
    /// Directions that turn along with the triangles separate.
    TurningAxis,
    /// All axes were tried.
    Search,
}

/// A pair that neither gets deeper than τ nor changes sides.
#[derive(Debug, Clone, PartialEq)]
pub struct Passage {
    /// The side at t = 1.
    pub side: Side,
    /// A lower bound of the distance; not positive where there may be contact. Meaningless for shared corners.
    pub clearance: f64,
    /// Whether some step is certified by touching only.
    pub in_contact: bool,
    /// What it took.
    pub effort: Effort,
}

/// A pair that gets deeper than τ, or leaves on the other side.
#[derive(Debug, Clone, PartialEq)]
pub struct Crossing {
    /// When the contact began that leads to the crossing; 0 if the pair starts in contact.
    pub contact: f64,
    /// When the overlap passed τ on the side the pair was followed on, to within 2⁻³³.
    pub passed: f64,
    /// An instant after `passed` at which the crossing was confirmed.
    pub confirmed: f64,
    /// The axis of the overlap at `confirmed`.
    pub axis: Axis,
    /// The largest overlap from its side at the sampled instants from `passed` on.
    pub reach: f64,
    /// The largest depth at the sampled instants from `passed` on: at most τ where the pair only changed sides.
    pub depth: f64,
}

/// The verdict on a pair over t in [0, 1].
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// Certified.
    Passed(Passage),
    /// Crossing, with its witness.
    Crossed(Crossing),
    /// Neither was found in the budget, or before steps became too short; the walk ended here.
    Undecided {
        /// The time up to which the pair is certified.
        time: f64,
    },
}

/// Certifies a pair from the side it starts on (see the module documentation).
///
/// `side`: from [`Side::at_start`], or the side the pair had at the end of the interval before. What the walk does not
/// certify is put to the vertex–facet and edge–edge queries, which need no axes: those of triangles that shrink to a
/// segment on the way are not defined.
pub fn certify(pair: &MovingPair, side: &Side, limits: &Limits) -> Outcome {
    let mut outcome = Outcome::Undecided { time: 0.0 };
    for first_step in FIRST_STEPS {
        outcome = Walk::new(pair, side.clone(), limits).run(first_step);
        let is_deep = matches!(&outcome, Outcome::Crossed(c) if c.depth > limits.tolerance);
        if is_deep || matches!(outcome, Outcome::Passed(_)) {
            break;
        }
    }
    if matches!(outcome, Outcome::Passed(_)) {
        return outcome;
    }
    passage_without_meeting(pair, side, limits).map_or(outcome, Outcome::Passed)
}

/// The passage of triangles that share no vertex, start apart, end apart and are proved to meet nowhere between.
fn passage_without_meeting(pair: &MovingPair, side: &Side, limits: &Limits) -> Option<Passage> {
    if pair.start.shared > 0 || matches!(side, Side::Contact(_)) {
        return None;
    }
    widest(&pair.start, limits)?;
    let at_end = widest(&pair.end, limits)?;
    never_meet(pair, limits).then_some(Passage {
        side: Side::Apart(at_end),
        clearance: limits.margin,
        in_contact: false,
        effort: Effort::Search,
    })
}

#[cfg(test)]
#[path = "certify_tests.rs"]
mod tests;
