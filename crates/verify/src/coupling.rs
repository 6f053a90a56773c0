//! Whether the sides of a triangle to the two triangles at an edge fit together.
//!
//! Let B and B' share the edge e, and let d and d' be the directions in which A may be pushed off them. Both push A off
//! e, because D(A, B) ⊂ D(A, e). A push that changes from one to the other across e without A meeting e exists if d and
//! d' are connected in D(A, e). If e is farther than τ from A, D(A, e) is connected and nothing needs to be tested. If
//! the plane of A contains e, and A passes between B and B', D(A, e) falls into two parts, with d in one and d' in the
//! other: A passes through the edge, beside both triangles.

use glam::DVec3;

use crate::arcs::are_connected;
use crate::face_pair::FacePair;
use crate::moving_pair::{MovingPair, PairPose};
use crate::neighbourhood::{Neighbourhood, edges};
use crate::trail::{Trail, apart};

/// Directions that are connected at this multiple of τ are accepted.
pub(crate) const CLEAR: f64 = 1.25;
/// Directions that are not connected even at this multiple of τ surely do not fit together: near a corner of the
/// boundary, a push of a whole triangle may have to be longer than one that differs from point to point.
const SURE: f64 = 2.0;
/// The number of instants tested in an interval, besides the ends of steps.
const SAMPLES: u32 = 16;
/// The largest number of ends of steps that are tested.
const MOST_ENDS: usize = 64;

/// A pair that was followed in contact through an interval.
pub(crate) struct ContactPair<'a> {
    pub(crate) pair: &'a FacePair,
    pub(crate) moving: MovingPair,
    pub(crate) trail: &'a Trail,
    /// τ, a length.
    pub(crate) tolerance: f64,
}

/// What is known about a pair of triangles next to one that was followed in contact.
pub(crate) enum NeighbourState<'a> {
    Contact(&'a Trail),
    Apart,
    /// The pair has no side.
    Lost,
}

/// A triangle that passes through the edge between two others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct EdgePassage {
    pub(crate) face: u32,
    pub(crate) between: [u32; 2],
    /// The time, as a share of the interval.
    pub(crate) time: f64,
    /// Whether it surely passes through.
    pub(crate) is_sure: bool,
}

/// The passages of either triangle of a pair in contact through an edge of the other.
///
/// `beside`: what is known about a pair of triangles.
pub(crate) fn uncoupled<'a>(
    followed: &ContactPair<'_>,
    around: &Neighbourhood,
    beside: &dyn Fn([u32; 2]) -> (FacePair, MovingPair, NeighbourState<'a>),
) -> Vec<EdgePassage> {
    let mut all = Vec::new();
    let [f, g] = followed.pair.faces;
    for (wall, face) in [(f, g), (g, f)] {
        let corners = around.corners(wall);
        for edge in edges(around.corners(face)) {
            if edge.iter().all(|v| corners.contains(v)) {
                continue;
            }
            for other in around.beyond(face, edge) {
                let (pair, moving, known) = beside([wall.min(other), wall.max(other)]);
                let trail = match known {
                    NeighbourState::Lost => continue,
                    // Each two pairs are tested once.
                    NeighbourState::Contact(_) if other < face => continue,
                    NeighbourState::Contact(trail) => Some(trail),
                    NeighbourState::Apart => None,
                };
                let beyond = NeighbourPair { pair, moving, trail };
                let found = followed.uncoupled_at((wall, edge), &beyond);
                all.extend(found.map(|(time, is_sure)| EdgePassage {
                    face: wall,
                    between: [face, other],
                    time,
                    is_sure,
                }));
            }
        }
    }
    all
}

/// The pair of triangles beyond an edge.
struct NeighbourPair<'a> {
    pair: FacePair,
    moving: MovingPair,
    trail: Option<&'a Trail>,
}

impl ContactPair<'_> {
    /// The first tested instant at which the sides surely do not fit together, or else the first at which they do not.
    fn uncoupled_at(
        &self,
        (wall, edge): (u32, [u32; 2]),
        beyond: &NeighbourPair<'_>,
    ) -> Option<(f64, bool)> {
        let mut instants: Vec<f64> =
            (0..=SAMPLES).map(|k| f64::from(k) / f64::from(SAMPLES)).collect();
        instants.extend(thinned(self.trail));
        instants.extend(beyond.trail.into_iter().flat_map(thinned));
        instants.sort_by(f64::total_cmp);
        instants.dedup();
        let is_uncoupled = |t: f64, level: f64| {
            let here = oriented(self.pair, wall, self.trail.at(&self.moving, t));
            let there = match beyond.trail {
                Some(trail) => trail.at(&beyond.moving, t),
                None => apart(&beyond.moving, t),
            };
            let there = oriented(&beyond.pair, wall, there);
            if here.is_empty() || there.is_empty() {
                return false;
            }
            let mut poses = self.to_edge(wall, edge, t).into_iter();
            poses.any(|pose| !are_connected(&pose, &here, &there, level * self.tolerance))
        };
        instants.retain(|&t| is_uncoupled(t, CLEAR));
        let sure = instants.iter().find(|&&t| is_uncoupled(t, SURE));
        let first = instants.first().map(|&t| (t, false));
        sure.map(|&t| (t, true)).or(first)
    }

    /// The first triangle, and the edge instead of the second; if they share a vertex, the parts that they do not
    /// share.
    pub(crate) fn to_edge(&self, wall: u32, edge: [u32; 2], t: f64) -> Vec<PairPose> {
        let pose = self.moving.at(t);
        let FacePair { faces, a, b, .. } = self.pair;
        let (of_wall, of_face) =
            if faces[0] == wall { ((a, pose.a), (b, pose.b)) } else { ((b, pose.b), (a, pose.a)) };
        let kept_corners = |(corners, positions): (&[u32; 3], [DVec3; 3]),
                            kept: &dyn Fn(&u32) -> bool| {
            let both = corners.iter().zip(positions);
            let mut left: Vec<DVec3> = both.filter_map(|(v, p)| kept(v).then_some(p)).collect();
            left.resize(3, left.last().copied().unwrap_or_default());
            [left[0], left[1], left[2]]
        };
        let whole = kept_corners(of_wall, &|_| true);
        let line = kept_corners(of_face, &|v| edge.contains(v));
        let is_shared = |v: &u32| of_wall.0.contains(v) && edge.contains(v);
        if !edge.iter().any(is_shared) {
            return vec![PairPose { a: whole, b: line }];
        }
        let rest = kept_corners(of_wall, &|v| !is_shared(v));
        let end = kept_corners(of_face, &|v| edge.contains(v) && !is_shared(v));
        vec![PairPose { a: rest, b: line }, PairPose { a: whole, b: end }]
    }
}

/// The directions, oriented from the wall to the other triangle.
pub(crate) fn oriented(pair: &FacePair, wall: u32, mut directions: Vec<DVec3>) -> Vec<DVec3> {
    if pair.faces[0] != wall {
        for direction in &mut directions {
            *direction = -*direction;
        }
    }
    directions
}

fn thinned(trail: &Trail) -> Vec<f64> {
    let all: Vec<f64> = trail.instants().collect();
    let every = all.len().div_ceil(MOST_ENDS).max(1);
    all.into_iter().step_by(every).collect()
}
