//! Facets cut into triangles.

use std::collections::BTreeMap;

use glam::DVec2;
use spade::handles::{FixedDirectedEdgeHandle, FixedVertexHandle};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation as _};

use super::ImportError;
use super::plan::Plan;
use super::predicate::{from_segment, side};
use crate::layout::split;

/// A quadrilateral has a corner worth the name where its corners lie farther from the chords beside them than this, in
/// parts of the chord.
const FLAT_CORNER: f64 = 1e-3;

/// Triangles and the facet each belongs to.
#[derive(Debug, Default)]
pub(super) struct Triangles {
    pub(super) corners: Vec<[u32; 3]>,
    pub(super) facets: Vec<u32>,
}

/// The triangles of every facet, counter-clockwise, without new vertices.
///
/// Convex quadrilaterals are cut along the shorter diagonal (ties by the lowest vertex); facets with more corners, with
/// holes or with lines inside by the constrained Delaunay triangulation (Chew 1989).
///
/// # Errors
/// [`ImportError::Facet`] for a facet whose loops cross or have no area.
pub(super) fn triangles(plan: &Plan) -> Result<Triangles, ImportError> {
    let mut triangles = Triangles::default();
    for (index, loops) in plan.facets.iter().enumerate() {
        let cut = match loops.as_slice() {
            [one] => simple(one, &plan.points),
            _ => None,
        };
        let cut = cut
            .or_else(|| delaunay(loops, &plan.points))
            .ok_or_else(|| facet_error(plan, index))?;
        triangles.facets.extend(cut.iter().map(|_| index as u32));
        triangles.corners.extend(cut);
    }
    Ok(triangles)
}

fn facet_error(plan: &Plan, facet: usize) -> ImportError {
    let outline = plan.facets[facet].first();
    let corners: Vec<u32> = outline.into_iter().flatten().copied().collect();
    let is_side = |line: &&super::drawing::Line| line.ends.iter().all(|v| corners.contains(v));
    ImportError::Facet {
        facet,
        corners: corners.len(),
        sources: plan
            .lines
            .iter()
            .filter(is_side)
            .map(|line| plan.sources[line.source as usize].clone())
            .collect(),
    }
}

/// The triangles of a triangle or of a convex quadrilateral.
pub(super) fn simple(corners: &[u32], points: &[DVec2]) -> Option<Vec<[u32; 3]>> {
    let at = |i: usize| points[corners[i % corners.len()] as usize];
    let turns = |i: usize| side(at(i), at(i + 1), at(i + 2)) > 0.0;
    match corners.len() {
        3 => turns(0).then(|| split(points, corners)),
        4 => {
            let is_corner = |i: usize| {
                let chord = [at(i), at(i + 2)];
                let (off, _) = from_segment(chord, at(i + 1));
                turns(i) && off > FLAT_CORNER * chord[0].distance(chord[1])
            };
            (0..4).all(is_corner).then(|| split(points, corners))
        }
        _ => None,
    }
}

type Delaunay = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// The triangles on the left of the loops, up to the next loop.
fn delaunay(loops: &[Vec<u32>], points: &[DVec2]) -> Option<Vec<[u32; 3]>> {
    let mut mesh = Delaunay::new();
    let mut handles: BTreeMap<u32, FixedVertexHandle> = BTreeMap::new();
    let mut vertices = Vec::new();
    // In the order of their places, so that ties between diagonals do not depend on numbers.
    let mut corners: Vec<u32> = loops.iter().flatten().copied().collect();
    let place = |v: u32| points[v as usize];
    corners.sort_by(|&a, &b| {
        let (p, q) = (place(a), place(b));
        p.x.total_cmp(&q.x)
            .then(p.y.total_cmp(&q.y))
            .then(a.cmp(&b))
    });
    corners.dedup();
    for vertex in corners {
        let [x, y] = points[vertex as usize].to_array().map(without_dust);
        let handle = mesh.insert(Point2::new(x, y)).ok()?;
        // Two vertices in one point cannot both be corners.
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
        let is_there = mesh.exists_constraint(a, b);
        if a == b || (!is_there && mesh.try_add_constraint(a, b).is_empty()) {
            return None;
        }
    }
    for [a, b] in sides {
        // A side that passes through another corner is no single edge.
        inner.push(mesh.get_edge_from_neighbors(a, b)?.fix());
    }
    flood(&mesh, inner, &vertices)
}

/// The triangles reached from the left of `inner` without crossing a side; none where that leads outside.
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
    let inside = mesh
        .inner_faces()
        .filter(|face| is_inside[face.fix().index()]);
    Some(
        inside
            .map(|face| face.vertices().map(|v| vertices[v.index()]))
            .collect(),
    )
}

/// Coordinates too small for the triangulation are 0.
fn without_dust(coordinate: f64) -> f64 {
    if coordinate.abs() < spade::MIN_ALLOWED_VALUE {
        0.0
    } else {
        coordinate
    }
}
