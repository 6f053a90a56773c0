//! From the lists of a FOLD frame to a sheet.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;

use super::error::{FoldError, FrameNumber};
use super::frames::{FrameFields, check_vertices};
use super::triangulate::{MOST_CORNERS, triangulate};
use crate::{Assignment, CreaseKind, Edge, Facet, FacetKind, Sheet};

/// A sheet and where its triangles come from.
#[derive(Debug)]
pub(super) struct Topology {
    pub(super) sheet: Sheet,
    /// The face of the file each triangle belongs to.
    pub(super) faces: Vec<u32>,
}

/// Builds the sheet of the key frame; `rest`: one position for each vertex, in which polygons are cut and edges
/// measured.
pub(super) fn build(
    key: &FrameFields,
    polygons: &[Vec<u32>],
    rest: &[DVec3],
) -> Result<Topology, FoldError> {
    let most = u32::MAX as usize;
    let corners = polygons.iter().map(Vec::len).sum();
    for (what, found) in [("vertices", rest.len()), ("corners of faces", corners)] {
        if found > most {
            return Err(FoldError::TooMany { what, found, limit: most });
        }
    }
    let mut faces = Vec::new();
    let mut triangles = Vec::new();
    for (face, polygon) in polygons.iter().enumerate() {
        validate(face, polygon, rest.len())?;
        let cut = triangulate(face, polygon, rest)?;
        faces.extend(cut.iter().map(|_| face as u32));
        triangles.extend(cut);
    }
    let (face_facets, facets) = facets(key, polygons, &triangles, &faces)?;
    let edges = edges(key, &triangles, &faces, rest.len())?;
    let unit_length = match key.unit_length {
        Some(value) if value > 0.0 => value,
        Some(value) => return Err(FoldError::UnitLength { value }),
        None => mean_side(polygons, rest),
    };
    let sheet = Sheet {
        vertices: rest.iter().map(|p| p.truncate()).collect(),
        edges,
        faces: triangles,
        face_facets,
        facets,
        unit_length,
    };
    Ok(Topology { sheet, faces })
}

fn validate(face: usize, polygon: &[u32], vertices: usize) -> Result<(), FoldError> {
    let key = "faces_vertices";
    if !(3..=MOST_CORNERS).contains(&polygon.len()) {
        return Err(FoldError::Corners { face, corners: polygon.len(), limit: MOST_CORNERS });
    }
    let mut sorted = polygon.to_vec();
    sorted.sort_unstable();
    if let Some(pair) = sorted.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(FoldError::RepeatedVertex { key, element: face, vertex: pair[0] });
    }
    check_vertices(key, face, polygon, vertices)
}

/// The facet of each triangle and the facets: those of `faces_foldmotion:facet`, otherwise the faces of the file.
fn facets(
    key: &FrameFields,
    polygons: &[Vec<u32>],
    triangles: &[[u32; 3]],
    faces: &[u32],
) -> Result<(Vec<u32>, Vec<Facet>), FoldError> {
    let plain = |polygon| Facet { polygon, row: 0, column: 0, kind: FacetKind::Plain };
    let Some(named) = &key.facets else {
        let facets = polygons.iter().cloned().map(plain).collect();
        return Ok((faces.to_vec(), facets));
    };
    let name = "faces_foldmotion:facet";
    let count = |found| FoldError::Count {
        frame: FrameNumber(0),
        key: name,
        found,
        expected: polygons.len(),
        of: "faces_vertices",
    };
    if named.len() != polygons.len() {
        return Err(count(named.len()));
    }
    let most = named.iter().copied().max().map_or(0, |m| m as usize + 1);
    if most > polygons.len() {
        return Err(FoldError::TooMany {
            what: "facets named by faces_foldmotion:facet",
            found: most,
            limit: polygons.len(),
        });
    }
    let face_facets: Vec<u32> = faces.iter().map(|&f| named[f as usize]).collect();
    let mut of_facet = vec![Vec::new(); most];
    for (triangle, &facet) in triangles.iter().zip(&face_facets) {
        of_facet[facet as usize].push(*triangle);
    }
    let facets = of_facet.iter().map(|t| plain(outline(t))).collect();
    Ok((face_facets, facets))
}

/// The corners of the union of `triangles`: those of its border, along it, where that is one loop, otherwise all by
/// index.
fn outline(triangles: &[[u32; 3]]) -> Vec<u32> {
    let sides = |t: &[u32; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
    let all: BTreeSet<[u32; 2]> = triangles.iter().flat_map(sides).collect();
    let next: BTreeMap<u32, u32> =
        all.iter().filter(|[a, b]| !all.contains(&[*b, *a])).map(|&[a, b]| (a, b)).collect();
    let corners: BTreeSet<u32> = triangles.iter().flatten().copied().collect();
    let on_border = |v: &u32| next.contains_key(v);
    let start = triangles.iter().flatten().copied().find(on_border);
    let mut border: Vec<u32> =
        std::iter::successors(start, |at| next.get(at).copied()).take(next.len() + 1).collect();
    let is_closed = border.len() > 1 && border.pop() == start;
    if is_closed && border.iter().copied().collect::<BTreeSet<_>>().iter().eq(next.keys()) {
        border
    } else {
        corners.into_iter().collect()
    }
}

/// Every edge of the triangles once: those of the file in its order, then the others by their ends.
fn edges(
    key: &FrameFields,
    triangles: &[[u32; 3]],
    faces: &[u32],
    vertices: usize,
) -> Result<Vec<Edge>, FoldError> {
    let listed = key.edges.as_deref().unwrap_or(&[]);
    let letters = key.assignments.as_deref().unwrap_or(&[]);
    if !letters.is_empty() && letters.len() != listed.len() {
        return Err(FoldError::Count {
            frame: FrameNumber(0),
            key: "edges_assignment",
            found: letters.len(),
            expected: listed.len(),
            of: "edges_vertices",
        });
    }
    let mut sides = sides(triangles);
    let mut edges = Vec::with_capacity(sides.len());
    for (element, &[a, b]) in listed.iter().enumerate() {
        check_vertices("edges_vertices", element, &[a, b], vertices)?;
        if a == b {
            return Err(FoldError::RepeatedVertex { key: "edges_vertices", element, vertex: a });
        }
        // Edges of no face do not move anything; one listed twice is one edge.
        if let Some(around) = sides.remove(&[a.min(b), a.max(b)]) {
            let letter = letters.get(element).map_or("F", String::as_str);
            edges.push(edge([a, b], &around, letter, faces)?);
        }
    }
    for (ends, around) in &sides {
        edges.push(edge(*ends, around, "F", faces)?);
    }
    Ok(edges)
}

/// A triangle at an edge, and whether it lies on the left of the edge from the smaller to the larger end.
type EdgeTriangle = (u32, bool);

/// The triangles at every edge, by its ends in order.
fn sides(triangles: &[[u32; 3]]) -> BTreeMap<[u32; 2], Vec<EdgeTriangle>> {
    let mut sides: BTreeMap<_, Vec<_>> = BTreeMap::new();
    for (triangle, &[p, q, r]) in triangles.iter().enumerate() {
        for [a, b] in [[p, q], [q, r], [r, p]] {
            let around = (triangle as u32, a < b);
            sides.entry([a.min(b), a.max(b)]).or_default().push(around);
        }
    }
    sides
}

fn edge(
    ends: [u32; 2],
    around: &[EdgeTriangle],
    letter: &str,
    faces: &[u32],
) -> Result<Edge, FoldError> {
    let forward = ends[0] < ends[1];
    let (joined, assignment) = match *around {
        [(f, left)] if left == forward => ([Some(f), None], Assignment::Border),
        [(f, _)] => ([None, Some(f)], Assignment::Border),
        // Faces that turn against each other have no common front, so that M and V say nothing.
        [(f, a), (g, b)] if a == b => ([Some(f), Some(g)], Assignment::Facet),
        [(f, left), (g, _)] => {
            let joined = if left == forward { [f, g] } else { [g, f] };
            let assignment = match letter {
                "M" => Assignment::Mountain,
                "V" => Assignment::Valley,
                _ => Assignment::Facet,
            };
            (joined.map(Some), assignment)
        }
        ref more => {
            let three = [0, 1, 2].map(|i| more.get(i).map_or(0, |m| faces[m.0 as usize]));
            return Err(FoldError::NonManifold { vertices: ends, faces: three });
        }
    };
    let is_border = assignment == Assignment::Border;
    Ok(Edge {
        vertices: ends,
        assignment,
        kind: if is_border { CreaseKind::Border } else { CreaseKind::Facet },
        row: 0,
        column: 0,
        faces: joined,
    })
}

/// The mean length of the sides of the polygons, each once.
fn mean_side(polygons: &[Vec<u32>], rest: &[DVec3]) -> f64 {
    let mut sides = BTreeSet::new();
    for polygon in polygons {
        let next = polygon.iter().cycle().skip(1);
        sides.extend(polygon.iter().zip(next).map(|(&a, &b)| (a.min(b), a.max(b))));
    }
    let length = |&(a, b): &(u32, u32)| rest[a as usize].distance(rest[b as usize]);
    sides.iter().map(length).sum::<f64>() / sides.len() as f64
}
