//! Sheets and motions built by hand.

use std::collections::BTreeMap;

use foldmotion_pattern::{
    Assignment, CreaseKind, Edge, Facet, FacetKind, Frame, LayerOrder, Motion, Sheet,
};
use glam::{DVec2, DVec3};

/// A sheet of triangles (counter-clockwise, each its own facet); the edges between them are valley creases.
pub(crate) fn sheet(vertices: Vec<DVec2>, faces: Vec<[u32; 3]>) -> Sheet {
    let mut sides: BTreeMap<(u32, u32), [Option<u32>; 2]> = BTreeMap::new();
    for (face, corners) in faces.iter().enumerate() {
        for i in 0..3 {
            let (from, to) = (corners[i], corners[(i + 1) % 3]);
            let slot = usize::from(from > to);
            sides.entry((from.min(to), from.max(to))).or_default()[slot] = Some(face as u32);
        }
    }
    let edges = sides.into_iter().map(|((v, w), faces)| Edge {
        vertices: [v, w],
        assignment: if faces.iter().all(Option::is_some) {
            Assignment::Valley
        } else {
            Assignment::Border
        },
        kind: CreaseKind::Row,
        row: 0,
        column: 0,
        faces,
    });
    let facets = faces.iter().map(|corners| Facet {
        polygon: corners.to_vec(),
        row: 0,
        column: 0,
        kind: FacetKind::Plain,
    });
    Sheet {
        edges: edges.collect(),
        facets: facets.collect(),
        face_facets: (0..faces.len() as u32).collect(),
        vertices,
        faces,
        unit_length: 1.0,
    }
}

/// A strip of `n` squares along x and `columns` along y, each a facet split into two triangles.
pub(crate) fn strip(n: u32, columns: u32) -> Sheet {
    let vertices = (0..=n)
        .flat_map(|i| (0..=columns).map(move |j| DVec2::new(f64::from(i), f64::from(j))))
        .collect();
    let at = |i: u32, j: u32| i * (columns + 1) + j;
    let faces = (0..n)
        .flat_map(|i| (0..columns).map(move |j| (i, j)))
        .flat_map(|(i, j)| {
            let [p, q, r, s] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[p, q, r], [p, r, s]]
        })
        .collect();
    into_squares(sheet(vertices, faces))
}

/// Makes triangles 2k and 2k + 1 the halves of one facet.
fn into_squares(mut sheet: Sheet) -> Sheet {
    for edge in &mut sheet.edges {
        if let [Some(f), Some(g)] = edge.faces
            && f / 2 == g / 2
        {
            edge.assignment = Assignment::Facet;
        }
    }
    for face in &mut sheet.face_facets {
        *face /= 2;
    }
    let halves = std::mem::take(&mut sheet.facets);
    sheet.facets = halves
        .chunks_exact(2)
        .map(|pair| Facet {
            polygon: [&pair[0].polygon[..], &pair[1].polygon[2..]].concat(),
            ..pair[0].clone()
        })
        .collect();
    sheet
}

/// The positions of a strip whose squares have the given directions in the x–z plane (angles from +x towards +z).
pub(crate) fn folded(sheet: &Sheet, directions: &[f64]) -> Vec<DVec3> {
    let mut profile = vec![DVec3::ZERO];
    for angle in directions {
        let last = profile[profile.len() - 1];
        profile.push(last + DVec3::new(angle.cos(), 0.0, angle.sin()));
    }
    let rows = sheet.vertices.len() / profile.len();
    let place = |(index, v): (usize, &DVec2)| profile[index / rows] + DVec3::Y * v.y;
    sheet.vertices.iter().enumerate().map(place).collect()
}

pub(crate) fn motion(sheet: Sheet, states: impl IntoIterator<Item = Vec<DVec3>>) -> Motion {
    let frames =
        states.into_iter().enumerate().map(|(k, positions)| Frame { time: k as f64, positions });
    Motion { frames: frames.collect(), sheet, compact_order: LayerOrder::default() }
}

/// The strip folded through states given by directions, with `between` frames from one to the next.
pub(crate) fn fold(n: u32, states: &[&[f64]], between: u32) -> Motion {
    let sheet = strip(n, 1);
    let mut all = vec![folded(&sheet, states[0])];
    for pair in states.windows(2) {
        for k in 1..=between {
            let s = f64::from(k) / f64::from(between);
            let mix = |(p, q): (&f64, &f64)| p + (q - p) * s;
            let directions: Vec<_> = pair[0].iter().zip(pair[1]).map(mix).collect();
            all.push(folded(&sheet, &directions));
        }
    }
    motion(sheet, all)
}

/// An accordion folded from flat to layers `gap` apart at their free ends, in `frames` intervals, rotated by `turn` in
/// total.
pub(crate) fn accordion(n: u32, columns: u32, frames: u32, gap: f64, turn: f64) -> Motion {
    let sheet = strip(n, columns);
    let steepest = std::f64::consts::FRAC_PI_2 - (gap / 2.0).asin();
    let states: Vec<_> = (0..=frames)
        .map(|k| {
            let s = f64::from(k) / f64::from(frames);
            let directions: Vec<_> =
                (0..n).map(|i| if i % 2 == 0 { steepest * s } else { -steepest * s }).collect();
            let q = glam::DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 2.0) / 3.0, turn * s);
            folded(&sheet, &directions).into_iter().map(|p| q * p).collect()
        })
        .collect();
    motion(sheet, states)
}
