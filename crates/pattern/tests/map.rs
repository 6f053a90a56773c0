//! Map folding: exact states, angles, box, and an order of layers that no crease pierces.

#![expect(clippy::unwrap_used, reason = "a test stops where a value is missing")]

use std::f64::consts::PI;

use foldmotion_pattern::{Assignment, Case, CreaseKind, Unit, UnitSheet, common_flap};
use glam::DVec3;

const H: f64 = 1.3;

fn maps() -> Vec<UnitSheet> {
    let mut maps = Vec::new();
    for (case, width, lambda, offset) in [
        (Case::E, 1.0, None, None),
        (Case::T, 0.7, None, None),
        (Case::S, 1.6, None, None),
        (Case::SII, 1.6, Some(0.7), None),
        (Case::SII, 1.6, Some(0.7), Some(0.0)),
        (Case::Plain, 2.5, None, None),
    ] {
        let unit = Unit::new(case, width * H, H, lambda, offset).unwrap();
        for (rows, columns) in [(1, 1), (1, 4), (3, 1), (4, 3)] {
            maps.push(UnitSheet::map_folded(&vec![unit; rows], columns).unwrap());
        }
    }
    let unequal = common_flap(1.6, &[1.0, 1.7, 0.9], 0.7, None).unwrap();
    maps.push(UnitSheet::map_folded(&unequal, 3).unwrap());
    maps
}

#[test]
fn one_facet_a_unit_covers_it_counter_clockwise() {
    for map in maps() {
        let sheet = &map.sheet;
        assert_eq!(sheet.facets.len(), map.rows * map.columns);
        for (facet, units) in sheet.facets.iter().zip(0..) {
            let corner = |i: usize| sheet.vertices[facet.polygon[i % facet.polygon.len()] as usize];
            let area: f64 =
                (0..facet.polygon.len()).map(|i| corner(i).perp_dot(corner(i + 1)) / 2.0).sum();
            let expected = map.unit.width * map.row_units()[facet.row as usize].height;
            assert!((area / expected - 1.0).abs() < 1e-13, "unit {units}");
        }
        let of = |face: usize| &sheet.facets[sheet.face_facets[face] as usize];
        for (face, corners) in sheet.faces.iter().enumerate() {
            let y = corners.map(|v| sheet.vertices[v as usize].y);
            let middle = y.iter().sum::<f64>() / 3.0 / map.unit.width;
            assert_eq!(middle.floor(), f64::from(of(face).column));
        }
    }
}

#[test]
fn the_folded_map_is_isometric_to_the_sheet_and_has_the_angles_of_its_table() {
    for map in maps() {
        let (sheet, compact) = (&map.sheet, map.compact());
        for edge in &sheet.edges {
            let [a, b] = edge.vertices.map(|v| v as usize);
            let rest = sheet.vertices[a].distance(sheet.vertices[b]);
            assert!((compact[a].distance(compact[b]) / rest - 1.0).abs() < 1e-13);
        }
        let measured = sheet.fold_angles(&compact);
        for (angle, &expected) in measured.iter().zip(map.compact_angles()) {
            // A half turn has no sign in a single state.
            let error = angle.map_or(0.0, |a| (a.abs() - expected.abs()).abs());
            assert!(error < 1e-7, "{angle:?} is not {expected}");
        }
    }
}

#[test]
fn only_the_lines_between_units_are_creases_and_all_of_them_are() {
    for map in maps() {
        let mut lengths = [0.0; 2];
        for edge in map.sheet.edges.iter().filter(|e| e.is_crease()) {
            let [a, b] = edge.vertices.map(|v| map.sheet.vertices[v as usize]);
            match edge.kind {
                CreaseKind::Row => lengths[0] += a.distance(b),
                CreaseKind::Column => lengths[1] += a.distance(b),
                other => panic!("{other:?} is no crease of a map"),
            }
        }
        let width = map.unit.width * map.columns as f64;
        let height: f64 = map.row_units().iter().map(|u| u.height).sum();
        let expected = [width * (map.rows - 1) as f64, height * (map.columns - 1) as f64];
        for (found, expected) in lengths.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12, "{found} != {expected}");
        }
    }
}

#[test]
fn the_box_is_one_unit_and_the_layers_are_as_many_as_the_units() {
    for map in maps() {
        let compact = map.compact();
        let low = compact.iter().copied().reduce(DVec3::min).unwrap();
        let high = compact.iter().copied().reduce(DVec3::max).unwrap();
        let closed = map.closed_form().unwrap();
        assert!((high - low).distance(closed.extents.into()) < 1e-13);
        assert_eq!(map.map_layers(), Some(map.rows * map.columns));
        if map.has_equal_rows() {
            assert_eq!(closed.extents, [map.unit.height, map.unit.width, 0.0]);
        }
    }
}

#[test]
fn the_ranks_count_the_layers() {
    for map in maps() {
        let units = (0..map.rows as u32).flat_map(|i| (0..map.columns as u32).map(move |j| (i, j)));
        let mut ranks: Vec<u64> = units.map(|(i, j)| map.map_rank(i, j)).collect();
        ranks.sort_unstable();
        let all: Vec<u64> = (0..(map.rows * map.columns) as u64).collect();
        assert_eq!(ranks, all);
    }
}

/// Of a grid vertex, three of the four creases have one sign and the fourth the other (Maekawa).
#[test]
fn every_vertex_of_the_map_folds_flat() {
    for map in maps() {
        let check = map.check();
        assert!(check.is_developable() && check.is_flat_foldable());
        let crossings = check.vertices.iter().filter(|v| v.sectors.len() == 4);
        assert_eq!(crossings.count(), (map.rows - 1) * (map.columns - 1));
    }
}

#[test]
fn a_crease_of_the_wrong_sign_does_not_fold_flat() {
    let unit = Unit::new(Case::S, 1.6, 1.0, None, None).unwrap();
    let mut map = UnitSheet::map_folded(&[unit; 3], 3).unwrap();
    let at = |e: &foldmotion_pattern::Edge| e.kind == CreaseKind::Column && e.row == 1;
    for edge in map.sheet.edges.iter_mut().filter(|e| at(e)) {
        edge.assignment = match edge.assignment {
            Assignment::Mountain => Assignment::Valley,
            _ => Assignment::Mountain,
        };
    }
    assert!(!map.check().is_flat_foldable());
}

#[test]
fn every_two_triangles_of_different_units_that_overlap_have_their_order() {
    for map in maps() {
        let order = map.compact_order();
        let facet = |f: u32| &map.sheet.facets[map.sheet.face_facets[f as usize] as usize];
        for (f, g, sign) in order.iter() {
            let (a, b) = (facet(f), facet(g));
            let above = map.map_rank(a.row, a.column) > map.map_rank(b.row, b.column);
            let g_faces_up = (b.row + b.column).is_multiple_of(2);
            assert_eq!(sign, if above == g_faces_up { 1 } else { -1 });
        }
        // Each triangle lies on its own image in every other unit of its parity.
        let units = map.rows * map.columns;
        assert!(order.len() >= units * (units - 1));
        for (edge, &angle) in map.sheet.edges.iter().zip(map.compact_angles()) {
            if let ([Some(f), Some(g)], true) = (edge.faces, angle != 0.0) {
                assert_eq!(order.sign(f, g), Some(if angle > 0.0 { 1 } else { -1 }));
            }
        }
    }
}

/// Creases that fold over one segment, seen across it: each joins two layers on one side, and the spans of any two
/// creases on the same side are nested or apart, never interleaved (the taco-taco condition of flat foldings). Between
/// the two layers of a crease no layer runs on through it: every unit ends at these lines.
#[test]
fn no_two_creases_of_the_folded_map_cross_each_other() {
    for map in maps().into_iter().filter(UnitSheet::has_equal_rows) {
        assert_eq!(crossings(&map, |i, j| map.map_rank(i, j)), 0);
    }
    let unit = Unit::new(Case::E, 1.0, 1.0, None, None).unwrap();
    let map = UnitSheet::map_folded(&[unit; 4], 3).unwrap();
    let row_by_row = |i: u32, j: u32| u64::from(i * 3 + j);
    assert!(crossings(&map, row_by_row) > 0, "a wrong order is found");
}

fn crossings(map: &UnitSheet, rank: impl Fn(u32, u32) -> u64) -> usize {
    let (rows, columns) = (map.rows as u32, map.columns as u32);
    // The four sides of the stack; each crease between two units lies on one of them.
    let mut sides: [Vec<(u64, u64)>; 4] = Default::default();
    for i in 0..rows {
        for j in 0..columns {
            let here = rank(i, j);
            if j + 1 < columns {
                let other = rank(i, j + 1);
                sides[j as usize % 2].push((here.min(other), here.max(other)));
            }
            if i + 1 < rows {
                let other = rank(i + 1, j);
                sides[2 + i as usize % 2].push((here.min(other), here.max(other)));
            }
        }
    }
    let cross = |a: (u64, u64), b: (u64, u64)| a.0 < b.0 && b.0 < a.1 && a.1 < b.1;
    sides
        .iter()
        .map(|side| {
            let pairs = side.iter().flat_map(|&a| side.iter().map(move |&b| (a, b)));
            pairs.filter(|&(a, b)| cross(a, b)).count()
        })
        .sum()
}

#[test]
fn the_compact_angles_of_a_map_are_half_turns() {
    for map in maps() {
        let angles = map.compact_angles();
        assert!(angles.iter().all(|a| [0.0, PI].contains(&a.abs())));
    }
}
