//! Whether the sides of a triangle to the two on an edge fit together.
//!
//! Let B and B' share the edge e, and let d and d' be the directions in which A may be pushed off them. Both push A off e,
//! D(A, B) ⊂ D(A, e). A push that goes from the one to the other across e without A meeting e is there where d and d' are
//! connected in D(A, e). Where e runs farther than τ off A, D(A, e) is connected and nothing is asked. Where the plane of
//! A holds e, and A passes between B and B', D(A, e) falls into two parts, with d in the one and d' in the other: A passes
//! through the edge, beside both triangles.

use glam::DVec3;

use crate::arcs::are_connected;
use crate::face_pair::FacePair;
use crate::moving_pair::{MovingPair, PairPose};
use crate::neighbourhood::{Neighbourhood, edges};
use crate::trail::{Trail, apart};

/// Directions that are connected at this many τ are left alone.
pub(crate) const CLEAR: f64 = 1.25;
/// Those that are not connected at this many τ either are not so for sure: near a corner of the boundary a push of one
/// triangle as a whole has farther to go than one that differs from point to point.
const SURE: f64 = 2.0;
/// Instants looked at in an interval, besides the ends of steps.
const SAMPLES: u32 = 16;
/// At most so many ends of steps are looked at.
const MOST_ENDS: usize = 64;

/// A pair in an interval.
pub(crate) struct ContactPair<'a> {
    pub(crate) pair: &'a FacePair,
    pub(crate) moving: MovingPair,
    pub(crate) trail: &'a Trail,
    /// τ, a length.
    pub(crate) tolerance: f64,
}

/// What is asked of the pairs beside those followed in contact.
pub(crate) enum NeighbourState<'a> {
    Contact(&'a Trail),
    Apart,
    /// It has no side.
    Lost,
}

/// A triangle that passes through an edge between two others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct EdgePassage {
    pub(crate) face: u32,
    pub(crate) between: [u32; 2],
    /// The part of the interval gone.
    pub(crate) time: f64,
    /// Whether it surely does.
    pub(crate) is_sure: bool,
}

/// Where the first triangle of a pair followed in contact passes through an edge of the second, or the other way round.
///
/// `beside`: what is known of a pair of triangles.
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
                    // Looked at once.
                    NeighbourState::Contact(_) if other < face => continue,
                    NeighbourState::Contact(trail) => Some(trail),
                    NeighbourState::Apart => None,
                };
                let beyond = NeighbourPair {
                    pair,
                    moving,
                    trail,
                };
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

/// The pair beyond an edge.
struct NeighbourPair<'a> {
    pair: FacePair,
    moving: MovingPair,
    trail: Option<&'a Trail>,
}

impl ContactPair<'_> {
    /// The first instant looked at at which the sides surely do not fit together, or else do not.
    fn uncoupled_at(
        &self,
        (wall, edge): (u32, [u32; 2]),
        beyond: &NeighbourPair<'_>,
    ) -> Option<(f64, bool)> {
        let mut instants: Vec<f64> = (0..=SAMPLES)
            .map(|k| f64::from(k) / f64::from(SAMPLES))
            .collect();
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

    /// The first triangle, and the edge in the place of the second; what they do not share where they share a vertex.
    pub(crate) fn to_edge(&self, wall: u32, edge: [u32; 2], t: f64) -> Vec<PairPose> {
        let pose = self.moving.at(t);
        let FacePair { faces, a, b, .. } = self.pair;
        let (of_wall, of_face) = if faces[0] == wall {
            ((a, pose.a), (b, pose.b))
        } else {
            ((b, pose.b), (a, pose.a))
        };
        let places = |(corners, places): (&[u32; 3], [DVec3; 3]), kept: &dyn Fn(&u32) -> bool| {
            let both = corners.iter().zip(places);
            let mut left: Vec<DVec3> = both.filter_map(|(v, p)| kept(v).then_some(p)).collect();
            left.resize(3, left.last().copied().unwrap_or_default());
            [left[0], left[1], left[2]]
        };
        let whole = places(of_wall, &|_| true);
        let line = places(of_face, &|v| edge.contains(v));
        let is_shared = |v: &u32| of_wall.0.contains(v) && edge.contains(v);
        if !edge.iter().any(is_shared) {
            return vec![PairPose { a: whole, b: line }];
        }
        let rest = places(of_wall, &|v| !is_shared(v));
        let end = places(of_face, &|v| edge.contains(v) && !is_shared(v));
        vec![PairPose { a: rest, b: line }, PairPose { a: whole, b: end }]
    }
}

/// Directions from the wall to the other.
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
