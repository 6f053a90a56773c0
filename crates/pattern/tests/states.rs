//! Counts, states and fold angles of sheets of units against the exact geometry.

#![expect(clippy::unwrap_used, reason = "a test stops where a value is missing")]
#![expect(clippy::cast_possible_wrap, reason = "counts of small sheets")]

use std::collections::BTreeSet;
use std::f64::consts::{FRAC_PI_2, PI};

use foldmotion_pattern::{
    Case, CreaseKind, Edge, FacetKind, FacetModel, Facing, Sheet, Unit, UnitSheet,
};
use glam::{DVec2, DVec3};

type Parameters = (Case, f64, Option<f64>, Option<f64>);

const CASES: &[Parameters] = &[
    (Case::E, 1.0, None, None),
    (Case::T, 0.7, None, None),
    (Case::T, 0.31, None, None),
    (Case::S, 1.6, None, None),
    (Case::S, 1.05, None, None),
    (Case::SII, 1.6, Some(0.7), None),
    (Case::SII, 1.6, Some(0.7), Some(0.0)),
    (Case::SII, 3.0, Some(0.2), Some(1.1)),
    (Case::Plain, 0.7, None, None),
    (Case::Plain, 1.3, None, None),
    (Case::Plain, 2.5, None, None),
];
const SIZES: &[(usize, usize)] = &[(1, 1), (1, 4), (2, 1), (3, 2), (7, 5)];

fn sheet((case, width, lambda, offset): Parameters, rows: usize, columns: usize) -> UnitSheet {
    // h = 1.3 so that no formula passes because h is 1.
    let h = 1.3;
    let unit = Unit::new(case, width * h, h, lambda, offset.map(|d| d * h)).unwrap();
    UnitSheet::new(unit, rows, columns).unwrap()
}

/// Every case, size and way to cut facets.
fn every_sheet() -> impl Iterator<Item = UnitSheet> {
    let models = [FacetModel::OneDiagonal, FacetModel::Symmetric];
    let of_model = move |model| {
        CASES.iter().flat_map(move |&c| {
            let sheet = move |&(rows, columns): &(usize, usize)| sheet(c, rows, columns);
            SIZES.iter().map(sheet).map(move |s| s.with_facet_model(model))
        })
    };
    models.into_iter().flat_map(of_model)
}

/// An open polygon of equal segments with turns to both sides.
fn polygon(rows: usize, length: f64) -> Vec<DVec2> {
    let mut points = vec![DVec2::new(0.3, -0.2)];
    for row in 0..rows {
        let direction = DVec2::from_angle(2.5 + 0.7 * (row as f64 * 1.3).sin());
        points.push(points[row] + direction * length);
    }
    points
}

fn largest_strain(sheet: &Sheet, positions: &[DVec3]) -> f64 {
    let strain = |e: &Edge| {
        let [a, b] = e.vertices.map(|v| v as usize);
        let rest = sheet.vertices[a].distance(sheet.vertices[b]);
        (positions[a].distance(positions[b]) / rest - 1.0).abs()
    };
    sheet.edges.iter().map(strain).fold(0.0, f64::max)
}

/// Fold angles agree modulo a whole turn.
fn angle_error(sheet: &Sheet, positions: &[DVec3], expected: &[f64]) -> f64 {
    let measured = sheet.fold_angles(positions);
    let off = |(m, e): (&Option<f64>, &f64)| {
        m.map_or(0.0, |m| ((m - e + PI).rem_euclid(2.0 * PI) - PI).abs())
    };
    measured.iter().zip(expected).map(off).fold(0.0, f64::max)
}

#[test]
fn vertices_and_facets_are_as_many_as_the_geometry_counts() {
    let counts =
        [(CASES[0], 126, 210), (CASES[1], 164, 210), (CASES[3], 192, 270), (CASES[5], 328, 363)];
    for (case, vertices, facets) in counts {
        let sheet = sheet(case, 7, 5).sheet;
        assert_eq!((sheet.vertices.len(), sheet.facets.len()), (vertices, facets), "{case:?}");
    }
}

#[test]
fn a_middle_node_makes_four_triangles_of_a_quadrilateral_and_changes_nothing_else() {
    for &case in CASES {
        let plain = sheet(case, 4, 3);
        let symmetric = plain.clone().with_facet_model(FacetModel::Symmetric);
        let quadrilaterals = plain.sheet.facets.iter().filter(|f| f.polygon.len() == 4);
        let quadrilaterals = quadrilaterals.count();
        let size = |s: &Sheet| [s.vertices.len(), s.edges.len(), s.faces.len()];
        let more = [1, 3, 2].map(|n| n * quadrilaterals);
        let expected = std::array::from_fn(|i| size(&plain.sheet)[i] + more[i]);
        assert_eq!(size(&symmetric.sheet), expected);
        let kept = plain.sheet.vertices.len();
        assert_eq!(symmetric.pattern_vertices(), kept);
        assert_eq!(symmetric.sheet.vertices[..kept], plain.sheet.vertices);
        assert_eq!(symmetric.sheet.facets, plain.sheet.facets);
        let creases = |s: &UnitSheet| {
            let edges = s.sheet.edges.iter().zip(s.compact_angles());
            let drawn = edges.filter(|(e, _)| e.kind != CreaseKind::Facet);
            let of = |(e, angle): (&Edge, &f64)| (e.vertices, e.assignment, e.kind, *angle);
            drawn.map(of).collect::<Vec<_>>()
        };
        assert_eq!(creases(&symmetric), creases(&plain));
        assert_eq!(symmetric.check(), plain.check());
        assert_eq!(symmetric.with_facet_model(FacetModel::OneDiagonal), plain);
    }
}

#[test]
fn a_sheet_with_middle_nodes_is_its_own_mirror_image_and_one_with_diagonals_is_not() {
    for &case in &[CASES[1], CASES[3], CASES[5]] {
        for (model, is_symmetric) in
            [(FacetModel::Symmetric, true), (FacetModel::OneDiagonal, false)]
        {
            let s = sheet(case, 3, 2).with_facet_model(model);
            let (length, width) = (3.0 * s.unit.height, 2.0 * s.unit.width);
            let mirrors: [&dyn Fn(DVec2) -> DVec2; 2] =
                [&|v| DVec2::new(v.x, width - v.y), &|v| DVec2::new(-length - v.x, v.y)];
            let lines = |map: &dyn Fn(u32) -> u32| {
                let ends = s.sheet.edges.iter().map(|e| {
                    let mut ends = e.vertices.map(map);
                    ends.sort_unstable();
                    (ends, e.assignment.letter())
                });
                ends.collect::<BTreeSet<_>>()
            };
            let is_own = |mirror: &&dyn Fn(DVec2) -> DVec2| {
                let image = mirrored(&s.sheet, mirror);
                lines(&|v| v) == lines(&|v| image[v as usize])
            };
            assert_eq!(mirrors.iter().all(is_own), is_symmetric, "{case:?}");
        }
    }
}

/// The vertex at the mirror image of each.
fn mirrored(sheet: &Sheet, mirror: &dyn Fn(DVec2) -> DVec2) -> Vec<u32> {
    let at = |image: DVec2| {
        let near = |v: &DVec2| v.distance(image) < 1e-9;
        sheet.vertices.iter().position(near).unwrap() as u32
    };
    sheet.vertices.iter().map(|&v| at(mirror(v))).collect()
}

#[test]
fn every_sheet_is_a_disc_of_counter_clockwise_triangles_that_fills_its_rectangle() {
    for s in every_sheet() {
        let sheet = &s.sheet;
        let euler =
            sheet.vertices.len() as i64 - sheet.edges.len() as i64 + sheet.faces.len() as i64;
        assert_eq!(euler, 1);
        let area = |f: &[u32; 3]| {
            let [a, b, c] = f.map(|v| sheet.vertices[v as usize]);
            (b - a).perp_dot(c - a) / 2.0
        };
        assert!(sheet.faces.iter().all(|f| area(f) > 0.0));
        let total: f64 = sheet.faces.iter().map(area).sum();
        let expected = (s.rows * s.columns) as f64 * s.unit.width * s.unit.height;
        assert!((total / expected - 1.0).abs() < 1e-13, "{total} != {expected}");
        for edge in sheet.edges.iter().filter(|e| e.is_hinge()) {
            for (face, from) in edge.faces.iter().zip([0, 1]) {
                let corners = sheet.faces[face.unwrap() as usize];
                let at = corners.iter().position(|&v| v == edge.vertices[from]).unwrap();
                assert_eq!(corners[(at + 1) % 3], edge.vertices[1 - from], "left face first");
            }
        }
    }
}

#[test]
fn every_exact_state_is_isometric_to_the_sheet() {
    for s in every_sheet() {
        let deployed = s.deployed(&polygon(s.rows, s.unit.height), Facing::Left).unwrap();
        for (name, state) in
            [("planar", s.sheet.planar()), ("compact", s.compact()), ("deployed", deployed)]
        {
            let strain = largest_strain(&s.sheet, &state);
            assert!(strain < 1e-13, "{:?} {name} {} x {}: {strain}", s.unit, s.rows, s.columns);
        }
    }
}

#[test]
fn measured_angles_of_the_compact_state_are_the_table_of_compact_angles() {
    for s in every_sheet() {
        let error = angle_error(&s.sheet, &s.compact(), s.compact_angles());
        assert!(error < 1e-7, "{:?} {} x {}: {error}", s.unit, s.rows, s.columns);
    }
}

#[test]
fn the_table_of_compact_angles_is_that_of_the_geometry() {
    for s in every_sheet() {
        for (edge, &angle) in s.sheet.edges.iter().zip(s.compact_angles()) {
            let [Some(a), Some(b)] = edge.faces.map(|f| {
                f.map(|f| {
                    let facet = s.sheet.face_facets[f as usize];
                    (facet, s.sheet.facets[facet as usize].clone())
                })
            }) else {
                assert_eq!(angle, 0.0);
                continue;
            };
            if a.0 == b.0 {
                assert_eq!((edge.kind, angle), (CreaseKind::Facet, 0.0));
                continue;
            }
            let mut kinds = [a.1.kind, b.1.kind];
            kinds.sort_by_key(|k| *k as u8);
            let expected = match kinds {
                [FacetKind::Flap, FacetKind::Tuck] | [FacetKind::Wall, FacetKind::Wall] => PI,
                [FacetKind::Tuck, FacetKind::Tuck] => -PI,
                [FacetKind::Flap, FacetKind::Flap] => {
                    // On a mid line the flaps' common edge joins two mid vertices, h − 2a long; else it is h long.
                    let [p, q] = edge.vertices.map(|v| s.sheet.vertices[v as usize]);
                    if p.distance(q) < s.unit.height * (1.0 - 1e-9) { PI } else { -PI }
                }
                [FacetKind::Flap, FacetKind::TopPad]
                | [FacetKind::Tuck | FacetKind::TopPad, FacetKind::Wall] => -FRAC_PI_2,
                [FacetKind::Flap, FacetKind::BottomPad]
                | [FacetKind::BottomPad, FacetKind::Wall] => FRAC_PI_2,
                other => panic!("no crease joins {other:?}"),
            };
            assert_eq!(angle, expected, "{:?} {kinds:?}", s.unit.case);
        }
    }
}

#[test]
fn the_deployed_state_lies_on_the_polygon_and_bends_only_the_hinges_between_rows() {
    for s in every_sheet() {
        let polygon = polygon(s.rows, s.unit.height);
        for facing in [Facing::Left, Facing::Right] {
            let deployed = s.deployed(&polygon, facing).unwrap();
            let angles = s.deployed_angles(&polygon, facing).unwrap();
            assert!(angle_error(&s.sheet, &deployed, &angles) < 1e-7);
            for (edge, &angle) in s.sheet.edges.iter().zip(&angles) {
                assert!(angle == 0.0 || edge.kind == CreaseKind::Row);
            }
            for p in &deployed {
                let on = polygon.windows(2).map(|q| {
                    let (d, r) = (q[1] - q[0], DVec2::new(p.x, p.z) - q[0]);
                    let t = (r.dot(d) / d.length_squared()).clamp(0.0, 1.0);
                    (r - d * t).length()
                });
                assert!(on.fold(f64::INFINITY, f64::min) < 1e-14);
            }
        }
    }
}

/// The flaps fold to the back of the sheet, so the front must lie on the other side of the profile.
#[test]
fn the_flaps_are_on_the_requested_side_of_the_profile() {
    let s = sheet(CASES[0], 3, 2);
    let polygon: Vec<DVec2> = (0..4).map(|k| DVec2::new(f64::from(k) * 1.3, 0.0)).collect();
    for (facing, front) in [(Facing::Left, -1.0), (Facing::Right, 1.0)] {
        let deployed = s.deployed(&polygon, facing).unwrap();
        let [a, b, c] = s.sheet.faces[0].map(|v| deployed[v as usize]);
        assert_eq!((b - a).cross(c - a).z.signum(), front);
    }
}

#[test]
fn a_polygon_of_another_length_is_refused() {
    let s = sheet(CASES[0], 3, 2);
    assert!(s.deployed(&polygon(2, 1.3), Facing::Left).is_err());
    assert!(s.deployed_angles(&polygon(5, 1.3), Facing::Left).is_err());
}

#[test]
fn the_rows_of_a_folded_plain_rectangle_turn_by_four_arctangents_of_h_over_w_less_a_half_turn() {
    for width in [0.7, 1.0, 1.6] {
        let s = sheet((Case::Plain, width, None, None), 4, 1);
        let compact = s.compact();
        // The corner line of each row, from its upper to its lower boundary.
        let direction = |row: usize| {
            let flap = s
                .sheet
                .facets
                .iter()
                .find(|f| f.row == row as u32 && f.kind == FacetKind::Flap)
                .unwrap();
            let mut ends: Vec<_> = flap
                .polygon
                .iter()
                .map(|&v| v as usize)
                .filter(|&v| (s.sheet.vertices[v].x / s.unit.height).fract().abs() < 1e-9)
                .collect();
            ends.sort_by(|&a, &b| s.sheet.vertices[b].x.total_cmp(&s.sheet.vertices[a].x));
            let d = compact[ends[1]] - compact[ends[0]];
            DVec2::new(d.x, d.z)
        };
        let expected = 4.0 * (1.0 / width).atan() - PI;
        for row in 0..3 {
            let (from, to) = (direction(row), direction(row + 1));
            let turn = from.perp_dot(to).atan2(from.dot(to));
            assert!(
                (turn.abs() - expected.abs()).abs() < 1e-12,
                "w/h = {width}: {turn} != {expected}"
            );
        }
    }
}

/// Figure 4d: above w = h the pair C2–C6 of a U^O unit changes places, at w = h it coincides.
#[test]
fn the_boundary_vertices_of_a_short_unit_change_places_as_w_passes_h() {
    let gap = |width: f64| {
        let s = sheet((Case::Plain, width, None, None), 1, 1);
        let compact = s.compact();
        let at = |x: f64| {
            let found =
                s.sheet.vertices.iter().position(|v| {
                    (v.x - x).abs() < 1e-9 && (v.y - s.unit.width / 2.0).abs() < 1e-9
                });
            compact[found.unwrap()]
        };
        let (c2, c6) = (at(0.0), at(-s.unit.height));
        c2.x - c6.x
    };
    assert!(gap(0.7) > 0.1);
    assert!(gap(1.0).abs() < 1e-12);
    assert!(gap(1.6) < -0.1);
}
