//! A query converted to the motion of two triangles.

use foldmotion_pattern::Motion;
use foldmotion_random::Random;
use glam::{DVec2, DVec3};

use crate::{
    oracle::contact::{Path, Query},
    sheets::{motion, sheet},
};

/// The features of a query completed to triangles: A contains the vertex or the first edge, B the facet or the second
/// edge.
///
/// The added corners move along: two with the vertex, an apex with each edge. `completion`: 0 adds them on the side
/// away from the other feature, so that the features themselves are the first to meet; other numbers add them anywhere
/// nearby.
pub(crate) fn triangles(query: &Query, completion: u64) -> [[Path; 3]; 2] {
    let added = if completion == 0 { behind(query) } else { nearby(query, completion) };
    match *query {
        Query::VertexFacet(vertex, facet) => {
            let [e, f] = added.map(|offset| vertex.map(|p| p + offset));
            [[vertex, e, f], facet]
        }
        Query::EdgeEdge(a, b) => {
            let completed = |[p, q]: [Path; 2], offset: DVec3| {
                let apex = [0, 1].map(|end| p[end].midpoint(q[end]) + offset);
                [p, q, apex]
            };
            [completed(a, added[0]), completed(b, added[1])]
        }
    }
}

/// The two triangles as a motion of one interval; the unit of length is the mean side of the features.
pub(crate) fn as_motion(query: &Query, completion: u64) -> Motion {
    let corners = triangles(query, completion).concat();
    // The positions in the flat sheet do not affect the verdict.
    let flat = (0..6).map(|k| DVec2::new(f64::from(k), f64::from(k * k)));
    let mut sheet = sheet(flat.collect(), vec![[0, 1, 2], [3, 4, 5]]);
    sheet.unit_length = mean_side(query);
    let at = |end: usize| corners.iter().map(|path| path[end]).collect();
    motion(sheet, [at(0), at(1)])
}

/// The offsets of added corners on the side away from the other feature: from the vertex, or from the middle of each
/// edge.
fn behind(query: &Query) -> [DVec3; 2] {
    let (away, size) = (away(query), mean_side(query));
    match query {
        Query::VertexFacet(..) => {
            let (e, f) = away.any_orthonormal_pair();
            [e, f].map(|aside| (away + aside * 0.5) * (0.5 * size))
        }
        Query::EdgeEdge(..) => [away * size, -away * size],
    }
}

/// The offsets of added corners anywhere nearby, drawn from the query itself and the number.
fn nearby(query: &Query, completion: u64) -> [DVec3; 2] {
    let corners = corners_of(query);
    let numbers = corners.iter().flatten().flat_map(DVec3::to_array);
    let mixed = |seed: u64, x: f64| (seed ^ x.to_bits()).wrapping_mul(0x9e6c_63d0_876a_3f6b);
    let mut random = Random::new(numbers.fold(completion, mixed));
    let size = mean_side(query);
    [(); 2].map(|()| random.vector() * size)
}

/// The unit direction normal to both features at t = 0, from B to A.
fn away(query: &Query) -> DVec3 {
    let (across, apart) = match *query {
        Query::VertexFacet(v, [p, q, r]) => ((q[0] - p[0]).cross(r[0] - p[0]), v[0] - p[0]),
        Query::EdgeEdge([a, b], [c, d]) => ((b[0] - a[0]).cross(d[0] - c[0]), a[0] - c[0]),
    };
    let along =
        sides(query).iter().find_map(|[p, q]| (q[0] - p[0]).try_normalize()).unwrap_or(DVec3::X);
    let normal = across.try_normalize().unwrap_or_else(|| along.any_orthonormal_vector());
    if normal.dot(apart) < 0.0 { -normal } else { normal }
}

/// The vertices of the features.
fn corners_of(query: &Query) -> [Path; 4] {
    match *query {
        Query::VertexFacet(v, [p, q, r]) => [v, p, q, r],
        Query::EdgeEdge([a, b], [c, d]) => [a, b, c, d],
    }
}

/// The sides of the features.
fn sides(query: &Query) -> Vec<[Path; 2]> {
    match *query {
        Query::VertexFacet(_, [p, q, r]) => vec![[p, q], [q, r], [r, p]],
        Query::EdgeEdge(a, b) => vec![a, b],
    }
}

/// The mean length of the sides over both ends of the motion; 1 if the features have no sides.
fn mean_side(query: &Query) -> f64 {
    let sides = sides(query);
    let lengths = sides.iter().flat_map(|[p, q]| [0, 1].map(|end| p[end].distance(q[end])));
    let mean = lengths.sum::<f64>() / (2 * sides.len()) as f64;
    if mean > 0.0 { mean } else { 1.0 }
}
