//! Small sheets that the tests fold.

use foldmotion_pattern::{
    Assignment, Case, CreaseKind, Edge, Facet, FacetKind, Facing, Sheet, Unit, UnitSheet,
};
use foldmotion_solver::Schedule;
use glam::{DVec2, DVec3};

/// Two triangles over the edge (0, 0)–(length, 0), with apexes at heights `left` above and `right` below it.
pub(crate) fn hinge(assignment: Assignment, length: f64, left: f64, right: f64) -> Sheet {
    let vertices = vec![
        DVec2::ZERO,
        DVec2::new(length, 0.0),
        DVec2::new(0.4 * length, left),
        DVec2::new(0.6 * length, -right),
    ];
    let edge = |vertices, faces, assignment, kind| Edge {
        vertices,
        assignment,
        kind,
        row: 0,
        column: 0,
        faces,
    };
    let border =
        |a, b, face| edge([a, b], [Some(face), None], Assignment::Border, CreaseKind::Border);
    let facet = |polygon: [u32; 3]| Facet {
        polygon: polygon.to_vec(),
        row: 0,
        column: 0,
        kind: FacetKind::Plain,
    };
    Sheet {
        vertices,
        edges: vec![
            edge([0, 1], [Some(0), Some(1)], assignment, CreaseKind::Diagonal),
            border(1, 2, 0),
            border(2, 0, 0),
            border(0, 3, 1),
            border(3, 1, 1),
        ],
        faces: vec![[0, 1, 2], [1, 0, 3]],
        face_facets: vec![0, 1],
        facets: vec![facet([0, 1, 2]), facet([1, 0, 3])],
        unit_length: 1.0,
    }
}

/// The positions of `hinge` folded rigidly by `angle`.
pub(crate) fn folded_hinge(sheet: &Sheet, angle: f64) -> Vec<DVec3> {
    let mut positions = sheet.planar();
    let apex = sheet.vertices[2];
    positions[2] = DVec3::new(apex.x, apex.y * angle.cos(), apex.y * angle.sin());
    positions
}

/// A sheet of units of height 1: w = 1 for E, 0.7 for T, 1.6 for S and SII (λ = 0.7).
pub(crate) fn units(case: Case, rows: usize, columns: usize) -> UnitSheet {
    scaled_units(case, rows, columns, 1.0)
}

/// The same, `scale` times as large.
pub(crate) fn scaled_units(case: Case, rows: usize, columns: usize, scale: f64) -> UnitSheet {
    let width = match case {
        Case::E => 1.0,
        Case::T | Case::Plain => 0.7,
        Case::S | Case::SII => 1.6,
    };
    let lambda = (case == Case::SII).then_some(0.7);
    let unit = Unit::new(case, width * scale, scale, lambda, None).unwrap();
    UnitSheet::new(unit, rows, columns).unwrap()
}

/// A polygon of segments of length `scale` that rises and falls as a shelter does.
pub(crate) fn arch(rows: usize, scale: f64) -> Vec<DVec2> {
    let slope = |row: usize| 1.2 - 2.4 * row as f64 / (rows as f64 - 1.0).max(1.0);
    let mut points = vec![DVec2::ZERO];
    for row in 0..rows {
        points.push(points[row] + DVec2::from_angle(slope(row)) * scale);
    }
    points
}

/// The deployed state on the arch, and the schedule from there to the compact state.
pub(crate) fn deployed(units: &UnitSheet) -> (Vec<DVec3>, Schedule) {
    let arch = arch(units.rows, units.unit.height);
    let start = units.deployed(&arch, Facing::Left).unwrap();
    let angles = units.deployed_angles(&arch, Facing::Left).unwrap();
    let schedule = Schedule::uniform(&units.sheet, &angles, units.compact_angles()).unwrap();
    (start, schedule)
}

/// Positions shaken by up to `size` along each axis, the same on every run.
pub(crate) fn shaken(positions: &[DVec3], size: f64) -> Vec<DVec3> {
    let noise = |i: usize| ((i as f64 * 12.9898).sin() * 43_758.547).fract() * size;
    let shake = |i| DVec3::new(noise(3 * i), noise(3 * i + 1), noise(3 * i + 2));
    positions.iter().enumerate().map(|(i, p)| *p + shake(i)).collect()
}
