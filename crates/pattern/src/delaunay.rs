//! The constrained Delaunay triangulation of a polygon with holes (Chew 1989).

use std::collections::BTreeMap;

use glam::DVec2;
use spade::handles::{FixedDirectedEdgeHandle, FixedVertexHandle};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation as _};

type Delaunay = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// The triangles on the left of the loops, up to the next loop, counter-clockwise and without new vertices.
///
/// `None` if loops cross or touch themselves or each other, or have no inside.
pub(crate) fn delaunay(loops: &[Vec<u32>], points: &[DVec2]) -> Option<Vec<[u32; 3]>> {
    let mut mesh = Delaunay::new();
    let mut handles: BTreeMap<u32, FixedVertexHandle> = BTreeMap::new();
    let mut vertices = Vec::new();
    // In the order of their positions, so that ties between diagonals do not depend on how vertices are numbered.
    let mut corners: Vec<u32> = loops.iter().flatten().copied().collect();
    let position = |v: u32| points[v as usize];
    corners.sort_by(|&a, &b| {
        let (p, q) = (position(a), position(b));
        p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)).then(a.cmp(&b))
    });
    corners.dedup();
    for vertex in corners {
        let [x, y] = points[vertex as usize].to_array().map(without_dust);
        let handle = mesh.insert(Point2::new(x, y)).ok()?;
        // Two vertices at one point cannot both be corners.
        if handle.index() != vertices.len() {
            return None;
        }
        vertices.push(vertex);
        handles.insert(vertex, handle);
    }
    let sides = loops.iter().flat_map(|l| {
        let next = l.iter().cycle().skip(1);
        l.iter().zip(next).map(|(a, b)| [handles[a], handles[b]])
    });
    let mut sides: Vec<[FixedVertexHandle; 2]> = sides.collect();
    sides.sort_by_key(|side| side.map(|v| v.index()));
    let mut inner: Vec<FixedDirectedEdgeHandle> = Vec::new();
    for &[a, b] in &sides {
        let exists = mesh.exists_constraint(a, b);
        if a == b || (!exists && mesh.try_add_constraint(a, b).is_empty()) {
            return None;
        }
    }
    for [a, b] in sides {
        // A side that passes through another corner is not a single edge.
        inner.push(mesh.get_edge_from_neighbors(a, b)?.fix());
    }
    flood(&mesh, inner, &vertices)
}

/// The triangles reached from the left of `inner` without crossing a side; `None` if that leads outside.
fn flood(
    mesh: &Delaunay,
    mut inner: Vec<FixedDirectedEdgeHandle>,
    vertices: &[u32],
) -> Option<Vec<[u32; 3]>> {
    let mut is_inside = vec![false; mesh.num_all_faces()];
    while let Some(edge) = inner.pop() {
        let face = mesh.directed_edge(edge).face().as_inner()?;
        if std::mem::replace(&mut is_inside[face.fix().index()], true) {
            continue;
        }
        for edge in face.adjacent_edges() {
            if !edge.is_constraint_edge() {
                inner.push(edge.rev().fix());
            }
        }
    }
    let inside = mesh.inner_faces().filter(|face| is_inside[face.fix().index()]);
    Some(inside.map(|face| face.vertices().map(|v| vertices[v.index()])).collect())
}

/// Coordinates too small for the triangulation are 0.
fn without_dust(coordinate: f64) -> f64 {
    if coordinate.abs() < spade::MIN_ALLOWED_VALUE { 0.0 } else { coordinate }
}
