//! Sheets whose rows have their own heights: exact states, angles, boxes, skins and layers.

#![expect(clippy::unwrap_used, reason = "a test stops where a value is missing")]

use std::f64::consts::PI;

use foldmotion_pattern::{
    Case, CreaseKind, Facing, Sheet, Unit, UnitSheet, common_flap, own_cases,
};
use glam::{DVec2, DVec3};

const HEIGHTS: [f64; 6] = [1.0, 1.7, 0.9, 1.25, 0.9, 3.1];

/// One flap width with centre and side pads, with side pads only, without pads; rows of cases E and T by their heights.
fn sheets() -> Vec<UnitSheet> {
    let sheet = |units: Vec<Unit>| UnitSheet::with_rows(&units, 3).unwrap();
    vec![
        sheet(common_flap(1.6, &HEIGHTS, 0.7, None).unwrap()),
        sheet(common_flap(1.6, &HEIGHTS, 1.0, None).unwrap()),
        sheet(common_flap(1.6, &HEIGHTS, 0.4, Some(0.0)).unwrap()),
        sheet(common_flap(0.5, &HEIGHTS, 1.0, None).unwrap()),
        sheet(common_flap(0.5, &HEIGHTS, 0.6, Some(0.05)).unwrap()),
        sheet(own_cases(0.9, &HEIGHTS).unwrap()),
    ]
}

fn largest_strain(sheet: &Sheet, positions: &[DVec3]) -> f64 {
    let strain = |e: &foldmotion_pattern::Edge| {
        let [a, b] = e.vertices.map(|v| v as usize);
        let rest = sheet.vertices[a].distance(sheet.vertices[b]);
        (positions[a].distance(positions[b]) / rest - 1.0).abs()
    };
    sheet.edges.iter().map(strain).fold(0.0, f64::max)
}

fn angle_error(sheet: &Sheet, positions: &[DVec3], expected: &[f64]) -> f64 {
    let off = |(m, e): (&Option<f64>, &f64)| {
        m.map_or(0.0, |m| ((m - e + PI).rem_euclid(2.0 * PI) - PI).abs())
    };
    let measured = sheet.fold_angles(positions);
    measured.iter().zip(expected).map(off).fold(0.0, f64::max)
}

/// A polygon whose segments are as long as the rows are high.
fn polygon() -> Vec<DVec2> {
    let mut points = vec![DVec2::new(0.3, -0.2)];
    for (row, height) in HEIGHTS.into_iter().enumerate() {
        let direction = DVec2::from_angle(2.5 + 0.7 * (row as f64 * 1.3).sin());
        points.push(points[row] + direction * height);
    }
    points
}

#[test]
fn every_exact_state_is_isometric_to_the_sheet() {
    for s in sheets() {
        let deployed = s.deployed(&polygon(), Facing::Left).unwrap();
        for state in [s.sheet.planar(), s.compact(), deployed] {
            let strain = largest_strain(&s.sheet, &state);
            assert!(strain < 1e-13, "{:?}: {strain}", s.unit);
        }
    }
}

#[test]
fn the_states_have_the_fold_angles_of_their_tables() {
    for s in sheets() {
        let compact = angle_error(&s.sheet, &s.compact(), s.compact_angles());
        assert!(compact < 1e-7, "{:?}: {compact}", s.unit);
        let deployed = s.deployed(&polygon(), Facing::Right).unwrap();
        let angles = s.deployed_angles(&polygon(), Facing::Right).unwrap();
        assert!(angle_error(&s.sheet, &deployed, &angles) < 1e-7);
    }
}

#[test]
fn the_compact_state_fills_the_box_of_the_sum_of_heights() {
    for s in sheets() {
        let points = s.compact();
        let low = points.iter().copied().reduce(DVec3::min).unwrap();
        let high = points.iter().copied().reduce(DVec3::max).unwrap();
        let (a, pads) = (s.unit.flap, s.unit.compact_width());
        let total: f64 = HEIGHTS.iter().sum();
        let expected = DVec3::new(total - 5.0 * a, 3.0 * pads, a);
        assert!((high - low).distance(expected) < 1e-13, "{:?}", s.unit);
        let closed = s.closed_form().unwrap();
        assert!(expected.distance(closed.extents.into()) < 1e-13);
        assert!((closed.volume - expected.element_product()).abs() < 1e-13);
    }
}

#[test]
fn the_skin_areas_are_their_closed_forms() {
    for s in sheets() {
        let skin = s.skin(&s.compact(), 1e-12).unwrap();
        let [upper, lower] = s.skin_areas().unwrap();
        assert!((skin.upper.area - upper).abs() < 1e-13);
        assert!((skin.lower.area - lower).abs() < 1e-13);
    }
}

#[test]
fn every_vertex_is_developable_and_without_pads_flat_foldable() {
    for s in sheets() {
        let check = s.check();
        assert!(check.is_developable());
        assert_eq!(check.is_flat_foldable(), s.unit.compact_width() == 0.0);
    }
}

#[test]
fn facets_joined_by_a_crease_folded_flat_lie_on_the_side_the_crease_folds_to() {
    for s in sheets() {
        let order = s.compact_order();
        for (edge, &angle) in s.sheet.edges.iter().zip(s.compact_angles()) {
            let [Some(f), Some(g)] = edge.faces else {
                continue;
            };
            if angle.abs() > 3.0 && edge.kind != CreaseKind::Border {
                let expected = if angle > 0.0 { 1 } else { -1 };
                assert_eq!(order.sign(f, g), Some(expected), "{edge:?}");
            }
        }
    }
}

/// Folded flat, a row must not reach the row after the next: layers of both would share a place in the order.
#[test]
fn every_two_facets_that_overlap_in_the_compact_state_have_an_order() {
    for s in sheets() {
        let (positions, order) = (s.compact(), s.compact_order());
        let faces = s.sheet.faces.len();
        let corners = |f: usize| s.sheet.faces[f].map(|v| positions[v as usize]);
        for f in 0..faces {
            for g in f + 1..faces {
                let same_facet = s.sheet.face_facets[f] == s.sheet.face_facets[g];
                if !same_facet && overlap(corners(f), corners(g)) {
                    assert!(order.sign(f as u32, g as u32).is_some(), "{f} and {g}");
                }
            }
        }
    }
}

/// Whether two triangles lie in one plane and share some of its area: no edge of either separates them.
fn overlap(a: [DVec3; 3], b: [DVec3; 3]) -> bool {
    let normal = (a[1] - a[0]).cross(a[2] - a[0]).normalize();
    if b.iter().any(|&p| (p - a[0]).dot(normal).abs() > 1e-9) {
        return false;
    }
    let separated_by_an_edge_of = |t: [DVec3; 3], other: [DVec3; 3]| {
        (0..3).any(|i| {
            let (p, q, r) = (t[i], t[(i + 1) % 3], t[(i + 2) % 3]);
            let outwards = (q - p).cross(normal).normalize();
            let outwards = if (r - p).dot(outwards) > 0.0 { -outwards } else { outwards };
            other.iter().all(|&x| (x - p).dot(outwards) > -1e-9)
        })
    };
    !separated_by_an_edge_of(a, b) && !separated_by_an_edge_of(b, a)
}

#[test]
fn equal_rows_give_the_sheet_of_equal_units_bit_for_bit() {
    for (case, width, lambda) in [
        (Case::E, 1.0, None),
        (Case::T, 0.7, None),
        (Case::S, 1.6, None),
        (Case::SII, 1.6, Some(0.7)),
    ] {
        let h = 1.3;
        let unit = Unit::new(case, width * h, h, lambda, None).unwrap();
        let equal = UnitSheet::new(unit, 5, 3).unwrap();
        assert_eq!(UnitSheet::with_rows(&[unit; 5], 3).unwrap(), equal);
        assert_eq!(equal.sheet.vertices[equal.sheet.vertices.len() - 1].x, -5.0 * h);
    }
}

#[test]
fn a_sheet_of_unequal_rows_names_its_cases() {
    let names: Vec<String> = sheets().iter().map(UnitSheet::case_name).collect();
    assert_eq!(names, ["SII", "S+SII", "SII", "T", "SII", "E+T"]);
}
