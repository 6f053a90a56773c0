//! Where one part of the sheet passes through another, and how deep.

use foldmotion_geometry::triangle_triangle;
use glam::DVec3;

use super::cell::{Cell, IntervalEnds, piercing};
use super::topology::Topology;

/// The first instant after a passage at which the depth is measured: 2⁻³⁴ of the interval.
const FIRST_INSTANT: f64 = 1.0 / (1u64 << 34) as f64;

/// The features that meet, the point at which they do, and the depth.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CrossingEvidence {
    /// A vertex and the three of a facet, the ends of two edges, or the ends of an edge and the three of a facet.
    pub(crate) vertices: Vec<u32>,
    /// The point at which they meet.
    pub(crate) point: DVec3,
    /// The largest distance found by which the nearer end of an edge lies beyond a facet that the edge pierces; 0 if
    /// the parts have passed through each other at an instant.
    pub(crate) depth: f64,
}

impl CrossingEvidence {
    /// The evidence for an edge that pierces a facet at an instant.
    pub(super) fn of_piercing(
        topology: &Topology,
        edge: u32,
        face: u32,
        positions: &[DVec3],
    ) -> Self {
        let [p, q] = topology.ends(edge);
        let at = |v: u32| positions[v as usize];
        let corners = topology.corners(face);
        let meeting = triangle_triangle(&[p, q, q].map(at), &corners.map(at));
        Self {
            vertices: [p, q].into_iter().chain(corners).collect(),
            point: meeting.on_a,
            depth: depth(topology, edge, face, positions).unwrap_or(0.0),
        }
    }

    /// The evidence for a passage between two times of an interval; at the second the features are apart again.
    pub(super) fn of_passage(
        topology: &Topology,
        cell: Cell,
        ends: IntervalEnds<'_>,
        times: [f64; 2],
    ) -> Self {
        let moving = cell.moving(topology, ends);
        let pose = moving.at(times[1]);
        let mut vertices = cell.corners(topology).concat();
        vertices.dedup();
        let around = pierced_around(topology, cell);
        let at_instant = |share: f64| {
            let [start, end] = ends.0;
            let positions: Vec<DVec3> =
                start.iter().zip(end).map(|(p, q)| p.lerp(*q, share)).collect();
            let depths =
                around.iter().filter_map(|&(edge, face)| depth(topology, edge, face, &positions));
            depths.fold(0.0, f64::max)
        };
        let later = std::iter::successors(Some(FIRST_INSTANT), |after| Some(2.0 * after));
        let instants = later.map(|after| times[1] + after).take_while(|&t| t < 1.0);
        Self {
            vertices,
            point: triangle_triangle(&pose.a, &pose.b).on_a,
            depth: instants.chain([1.0]).map(at_instant).fold(0.0, f64::max),
        }
    }
}

/// The edges at each feature, paired with the triangles around the other.
fn pierced_around(topology: &Topology, cell: Cell) -> Vec<(u32, u32)> {
    let [a, b] = cell.corners(topology);
    let edges_at = |corners: [u32; 3]| -> Vec<u32> {
        let at = corners.iter().flat_map(|&v| &topology.vertex_edges[v as usize]);
        at.copied().collect()
    };
    let faces_at = |corners: [u32; 3]| -> Vec<u32> {
        let at = corners.iter().flat_map(|&v| &topology.vertex_faces[v as usize]);
        at.copied().collect()
    };
    let mut pairs: Vec<(u32, u32)> = [(a, b), (b, a)]
        .into_iter()
        .flat_map(|(edges, faces)| {
            let faces = faces_at(faces);
            let pair = move |edge: u32| faces.clone().into_iter().map(move |face| (edge, face));
            edges_at(edges).into_iter().flat_map(pair)
        })
        .collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

/// The distance by which the nearer end of an edge lies beyond a triangle without a common vertex; `None` if the edge
/// does not pierce it.
fn depth(topology: &Topology, edge: u32, face: u32, positions: &[DVec3]) -> Option<f64> {
    let ends = topology.ends(edge);
    let corners = topology.corners(face);
    if ends.iter().any(|v| corners.contains(v)) {
        return None;
    }
    piercing(topology, edge, face, positions).filter(|&pierced| pierced != 0)?;
    let [p, q, r] = corners.map(|v| positions[v as usize]);
    let normal = (q - p).cross(r - p).try_normalize()?;
    let heights = ends.map(|v| normal.dot(positions[v as usize] - p).abs());
    Some(heights[0].min(heights[1]))
}
