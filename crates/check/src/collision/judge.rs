//! The judgement of one pair of triangles in one interval.

use foldmotion_geometry::collide::{
    Approach, ApproachBounds, Axis, Effort, Feature, Limits, MovingPair, Outcome, PairCertificate,
    PairCrossing, PairPose, Side, certify, closest_approach, comes_within, enough_clearance,
};
use glam::DVec3;

use super::{closest_features::ClosestFeatures, face_pair::FacePair, report::PenetrationKind};

/// Pairs nearer than this multiple of τ count as near.
const NEAR: f64 = 1.01;
/// Features farther apart than this multiple of τ are not in contact.
const MET: f64 = 8.0;

/// What happened to a pair in an interval.
#[derive(Debug)]
pub(super) enum Judgement {
    Passed {
        side: Side,
        effort: Effort,
        is_touching: bool,
        /// Whether the parts of the triangles that are not shared may come within τ.
        is_near: bool,
        distance: DistanceBounds,
    },
    /// The pair gets deeper than τ, or leaves the side it was followed on.
    Penetrates(PenetrationEvidence),
    /// The side of the pair could not be determined.
    Undecided {
        /// Whether the parts of the triangles that are not shared may come within τ.
        is_near: bool,
        distance: DistanceBounds,
    },
}

/// Bounds of the distance of a pair in an interval.
#[derive(Debug, Clone, Copy)]
pub(super) struct DistanceBounds {
    /// The closest approach, if it may be closer than those known.
    pub(super) approach: Option<Approach>,
    /// A lower bound of the distance throughout the interval; infinite for pairs that are not measured.
    pub(super) at_least: f64,
}

impl DistanceBounds {
    pub(super) const NOT_MEASURED: Self = Self { approach: None, at_least: f64::INFINITY };
}

impl From<ApproachBounds> for DistanceBounds {
    fn from(found: ApproachBounds) -> Self {
        Self { approach: found.nearest, at_least: found.at_least }
    }
}

/// A penetration in the time and the coordinates of the interval.
#[derive(Debug, Clone)]
pub(super) struct PenetrationEvidence {
    pub(super) contact: f64,
    pub(super) passed: f64,
    pub(super) kind: PenetrationKind,
    pub(super) vertices: Vec<u32>,
    pub(super) point: DVec3,
    /// The distance between the features that meet; 0 for pairs that start deeper than τ.
    gap: f64,
    pub(super) depth: f64,
    pub(super) distance: DistanceBounds,
}

impl PenetrationEvidence {
    /// Whether the triangles are in contact when they leave their side. A pair that lost its side because no path of
    /// directions was found may be apart by then.
    pub(super) fn is_in_contact(&self, tolerance: f64) -> bool {
        self.gap <= MET * tolerance
    }

    /// Whether the triangles are deeper than τ at an instant: then no push by τ separates them.
    pub(super) fn is_sure(&self, tolerance: f64) -> bool {
        use PenetrationKind::{EdgeEdge, VertexFacet};
        matches!(self.kind, EdgeEdge | VertexFacet) && self.depth > tolerance
    }
}

/// A pair that left its side in an interval.
#[derive(Debug, Clone)]
pub(super) struct Suspect {
    pub(super) frame: usize,
    pub(super) times: [f64; 2],
    pub(super) evidence: PenetrationEvidence,
}

/// What is known about a pair before it is judged.
#[derive(Debug, Clone, Copy)]
pub(super) struct PairTest<'a> {
    pub(super) limits: &'a Limits,
    /// The closest approach matters only if it is nearer than this, a length; `None` if the facets share a vertex.
    pub(super) nearer_than: Option<f64>,
    /// Whether the pair is already known to touch.
    pub(super) has_touched: bool,
}

impl PairTest<'_> {
    /// Judges a pair that starts on `side`; `None` stands for a pair that starts deeper than τ.
    pub(super) fn judge(
        &self,
        pair: &FacePair,
        moving: &MovingPair,
        side: Option<&Side>,
    ) -> Judgement {
        let record_penetration = |evidence: PenetrationEvidence| {
            Judgement::Penetrates(PenetrationEvidence {
                distance: self.distance(moving),
                ..evidence
            })
        };
        let Some(side) = side else {
            return record_penetration(starts_deep(pair, &moving.start, self.limits));
        };
        let passage = match certify(moving, side, self.limits) {
            Outcome::Passed(passage) => passage,
            Outcome::Crossed(crossing) => {
                return record_penetration(self.evidence(pair, moving, &crossing));
            }
            Outcome::Undecided { .. } => {
                return Judgement::Undecided {
                    is_near: may_be_near(pair, moving, 0.0, self.limits),
                    distance: self.distance(moving),
                };
            }
        };
        self.passed(pair, moving, passage)
    }

    fn distance(&self, moving: &MovingPair) -> DistanceBounds {
        self.nearer_than.map_or(DistanceBounds::NOT_MEASURED, |bound| {
            DistanceBounds::from(closest_approach(moving, bound, self.limits))
        })
    }

    fn passed(&self, pair: &FacePair, moving: &MovingPair, passage: PairCertificate) -> Judgement {
        let is_near = may_be_near(pair, moving, passage.clearance, self.limits);
        if pair.shared > 0 {
            return Judgement::Passed {
                side: passage.side,
                effort: passage.effort,
                is_touching: is_near,
                is_near,
                distance: DistanceBounds::NOT_MEASURED,
            };
        }
        let tolerance = self.limits.tolerance;
        let clearance = passage.clearance - self.limits.margin;
        let may_touch = !self.has_touched && clearance <= tolerance;
        let wanted = self.nearer_than.unwrap_or(0.0);
        let bound = if may_touch { wanted.max(2.0 * tolerance) } else { wanted };
        let is_news = clearance < enough_clearance(bound, self.limits);
        let found = is_news.then(|| closest_approach(moving, bound, self.limits));
        let at_least = found.map_or(0.0, |found| found.at_least).max(clearance);
        let approach = found.and_then(|found| found.nearest);
        let distance = DistanceBounds {
            approach: approach.filter(|approach| approach.closest.distance < wanted),
            at_least: at_least.max(0.0),
        };
        Judgement::Passed {
            side: passage.side,
            effort: passage.effort,
            // A pair is called free only if that is proved.
            is_touching: may_touch && at_least <= tolerance,
            is_near,
            distance: if self.nearer_than.is_some() {
                distance
            } else {
                DistanceBounds::NOT_MEASURED
            },
        }
    }

    fn evidence(
        &self,
        pair: &FacePair,
        moving: &MovingPair,
        crossing: &PairCrossing,
    ) -> PenetrationEvidence {
        // At the instant at which the pair gets too deep its features still meet; later they may be far through each
        // other.
        let pose = moving.at(crossing.passed);
        let is_deep = crossing.depth > self.limits.tolerance;
        let features = features(pair, &pose, &crossing.axis, self.limits);
        let (kind, depth) = match pair.shared {
            0 if is_deep => (kind_of(&features), crossing.depth),
            0 => (PenetrationKind::PassedThrough, crossing.depth.max(0.0)),
            1 => (PenetrationKind::AroundVertex, crossing.reach),
            _ => (PenetrationKind::FoldedThrough, crossing.reach),
        };
        PenetrationEvidence {
            contact: crossing.contact,
            passed: crossing.passed,
            kind,
            vertices: vertices(pair, &features),
            point: features.point,
            gap: features.distance,
            depth,
            distance: DistanceBounds::NOT_MEASURED,
        }
    }
}

/// Whether simplices of the two triangles without a common vertex may come within τ of each other.
///
/// `clearance`: a lower bound of the distance between the parts that are not shared, for triangles that share at most
/// one vertex.
pub(super) fn may_be_near(
    pair: &FacePair,
    moving: &MovingPair,
    clearance: f64,
    limits: &Limits,
) -> bool {
    let reach = NEAR * limits.tolerance;
    let is_apart = match pair.shared {
        0 | 1 => clearance > reach,
        _ => moving.hinge_stays_within_right_angle(limits) && !is_sliver(pair, moving, reach),
    };
    !is_apart
        && disjoint_parts(pair.shared)
            .iter()
            .any(|&[a, b]| comes_within(&part(moving, a, b), reach, limits))
}

/// Whether an apex is so close to the line of the shared edge, at either end of the interval, that disjoint corners may
/// be near each other although the fold is open.
fn is_sliver(pair: &FacePair, moving: &MovingPair, reach: f64) -> bool {
    debug_assert_eq!(pair.shared, 2, "the edge is shared");
    let is_low = |pose: &PairPose, apex: DVec3| {
        let edge = pose.a[1] - pose.a[0];
        let area = edge.cross(apex - pose.a[0]);
        area.length() <= reach * edge.length()
    };
    [moving.start, moving.end].iter().any(|pose| is_low(pose, pose.a[2]) || is_low(pose, pose.b[2]))
}

/// The corners of the two triangles that span the largest simplices without a common vertex, shared corners first.
fn disjoint_parts(shared: usize) -> &'static [[[usize; 3]; 2]] {
    match shared {
        0 => &[[[0, 1, 2], [0, 1, 2]]],
        1 => &[[[1, 2, 2], [0, 1, 2]], [[0, 1, 2], [1, 2, 2]]],
        _ => &[
            [[2, 2, 2], [0, 1, 2]],
            [[0, 1, 2], [2, 2, 2]],
            [[0, 2, 2], [1, 2, 2]],
            [[1, 2, 2], [0, 2, 2]],
        ],
    }
}

fn part(moving: &MovingPair, a: [usize; 3], b: [usize; 3]) -> MovingPair {
    let of =
        |pose: &PairPose| PairPose { a: a.map(|i| pose.a[i]), b: b.map(|j| pose.b[j]), shared: 0 };
    MovingPair::new(of(&moving.start), of(&moving.end))
}

/// The evidence for a pair that is deeper than τ at the start of an interval.
pub(super) fn starts_deep(
    pair: &FacePair,
    pose: &PairPose,
    limits: &Limits,
) -> PenetrationEvidence {
    let axis = pose.depth();
    let features = features(pair, pose, &axis, limits);
    PenetrationEvidence {
        contact: 0.0,
        passed: 0.0,
        kind: match pair.shared {
            0 => kind_of(&features),
            1 => PenetrationKind::AroundVertex,
            _ => PenetrationKind::FoldedThrough,
        },
        vertices: vertices(pair, &features),
        point: features.point,
        gap: 0.0,
        depth: axis.overlap,
        distance: DistanceBounds::NOT_MEASURED,
    }
}

/// The closest features, of the kind that the axis suggests if those are as near as the others.
fn features(pair: &FacePair, pose: &PairPose, axis: &Axis, limits: &Limits) -> ClosestFeatures {
    let wants_edges = matches!(axis.feature, Feature::Edges(..));
    ClosestFeatures::nearest(pair, pose, wants_edges, limits.tolerance)
}

fn kind_of(features: &ClosestFeatures) -> PenetrationKind {
    if features.are_edges { PenetrationKind::EdgeEdge } else { PenetrationKind::VertexFacet }
}

/// The vertices of the features, each once; the four of the hinge for triangles that share an edge.
fn vertices(pair: &FacePair, features: &ClosestFeatures) -> Vec<u32> {
    if pair.shared == 2 {
        return vec![pair.a[0], pair.a[1], pair.a[2], pair.b[2]];
    }
    let mut distinct: Vec<u32> = Vec::with_capacity(4);
    for &vertex in &features.vertices {
        if !distinct.contains(&vertex) {
            distinct.push(vertex);
        }
    }
    distinct
}
