//! Cuts opened: triangles on either side of a cut get vertices of their own.

use std::collections::BTreeMap;

use super::drawing::Role;

/// The sides of all triangles: for each pair of ends the corners at which the side starts, 3·triangle + corner.
pub(super) type Sides = BTreeMap<[u32; 2], Vec<u32>>;

/// The sides of `corners`.
pub(super) fn sides(corners: &[[u32; 3]]) -> Sides {
    let mut sides = Sides::new();
    for (triangle, c) in corners.iter().enumerate() {
        for k in 0..3 {
            let (a, b) = (c[k], c[(k + 1) % 3]);
            let start = (3 * triangle + k) as u32;
            sides.entry([a.min(b), a.max(b)]).or_default().push(start);
        }
    }
    sides
}

/// The corner at which the side that starts at `start` ends.
pub(super) fn end_of(start: u32) -> u32 {
    start - start % 3 + (start + 1) % 3
}

/// Numbers the vertices anew where cuts part them; `role`: of the line between two ends.
///
/// Corners at one vertex stay together if a path from triangle to triangle around the vertex joins them without
/// crossing a cut or a border, which is a cut inside the sheet. Returns for each new vertex the one it comes from; the
/// first part of a vertex keeps its number. Only vertices at which a cut ends are parted. `vertices`: how many there are.
pub(super) fn open_cuts(
    corners: &mut [[u32; 3]],
    vertices: usize,
    role: impl Fn([u32; 2]) -> Role,
) -> Vec<u32> {
    let mut joined: Vec<u32> = (0..3 * corners.len() as u32).collect();
    let mut is_cut = vec![false; vertices];
    for (ends, starts) in sides(corners) {
        let &[s, t] = starts.as_slice() else { continue };
        if matches!(role(ends), Role::Cut | Role::Border) {
            for v in ends {
                is_cut[v as usize] = true;
            }
            continue;
        }
        // The sides run against each other.
        join(&mut joined, s, end_of(t));
        join(&mut joined, end_of(s), t);
    }
    let mut origin: Vec<u32> = (0..vertices as u32).collect();
    let mut number: BTreeMap<(u32, u32), u32> = BTreeMap::new();
    let mut is_taken = vec![false; vertices];
    for corner in 0..joined.len() as u32 {
        let at = &mut corners[corner as usize / 3][corner as usize % 3];
        let vertex = *at;
        if !is_cut[vertex as usize] {
            continue;
        }
        let part = root(&mut joined, corner);
        *at = *number.entry((vertex, part)).or_insert_with(|| {
            if std::mem::replace(&mut is_taken[vertex as usize], true) {
                origin.push(vertex);
                origin.len() as u32 - 1
            } else {
                vertex
            }
        });
    }
    origin
}

/// The first of the elements joined with `element`.
pub(super) fn root(joined: &mut [u32], mut element: u32) -> u32 {
    while joined[element as usize] != element {
        let above = joined[joined[element as usize] as usize];
        joined[element as usize] = above;
        element = above;
    }
    element
}

/// Joins the sets of two elements.
pub(super) fn join(joined: &mut [u32], a: u32, b: u32) {
    let (a, b) = (root(joined, a), root(joined, b));
    joined[a.max(b) as usize] = a.min(b);
}
