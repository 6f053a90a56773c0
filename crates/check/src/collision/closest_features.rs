//! The features of two triangles that are nearest to each other: a corner and a facet, or two edges.

use foldmotion_geometry::{collide::PairPose, segment_segment, triangle_triangle};
use glam::DVec3;

use super::face_pair::FacePair;

/// A corner and a facet, or two edges, that are nearest to each other.
#[derive(Debug, Clone)]
pub(super) struct ClosestFeatures {
    /// The corner followed by the three of the facet, or the ends of both edges; each vertex once.
    pub(super) vertices: Vec<u32>,
    pub(super) point: DVec3,
    /// Whether the features are two edges.
    pub(super) are_edges: bool,
    pub(super) distance: f64,
}

impl ClosestFeatures {
    /// The features nearest to each other, leaving out those that share a vertex. The wanted kind is returned if its
    /// distance exceeds the smallest one by at most `slack`.
    pub(super) fn nearest(pair: &FacePair, pose: &PairPose, wants_edges: bool, slack: f64) -> Self {
        let (corner, edges) = (Self::corner_and_facet(pair, pose), Self::edges(pair, pose));
        let (wanted, other) = if wants_edges { (edges, corner) } else { (corner, edges) };
        if wanted.distance <= other.distance + slack { wanted } else { other }
    }

    /// The corner, among those not shared, that is nearest to the other facet.
    fn corner_and_facet(pair: &FacePair, pose: &PairPose) -> Self {
        let mut nearest = Self::far();
        for (of, at, facet, triangle) in
            [(&pair.a, &pose.a, &pair.b, &pose.b), (&pair.b, &pose.b, &pair.a, &pose.a)]
        {
            for i in pair.shared..3 {
                let distance = triangle_triangle(&[at[i]; 3], triangle).distance;
                if distance < nearest.distance {
                    nearest = Self {
                        vertices: [of[i]].into_iter().chain(*facet).collect(),
                        point: at[i],
                        are_edges: false,
                        distance,
                    };
                }
            }
        }
        nearest
    }

    fn edges(pair: &FacePair, pose: &PairPose) -> Self {
        let mut nearest = Self::far();
        let ends = |k: usize| [k, (k + 1) % 3];
        for (i, j) in (0..9).map(|k| (ends(k / 3), ends(k % 3))) {
            let (v, w) = (i.map(|k| pair.a[k]), j.map(|k| pair.b[k]));
            if v.iter().any(|vertex| w.contains(vertex)) {
                continue;
            }
            let closest = segment_segment(i.map(|k| pose.a[k]), j.map(|k| pose.b[k]));
            if closest.distance < nearest.distance {
                nearest = Self {
                    vertices: v.into_iter().chain(w).collect(),
                    point: closest.on_a.midpoint(closest.on_b),
                    are_edges: true,
                    distance: closest.distance,
                };
            }
        }
        nearest
    }

    fn far() -> Self {
        Self { vertices: Vec::new(), point: DVec3::ZERO, are_edges: false, distance: f64::INFINITY }
    }
}
