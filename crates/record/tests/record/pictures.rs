//! Pictures of known scenes.

use crate::common::*;
use foldmotion_pattern::{Assignment, Case, LayerOrder, Sheet, Unit, UnitSheet};
use foldmotion_record::{Camera, Paper, RecordError, Style, Surface, View, picture};
use glam::{DMat3, DQuat, DVec2, DVec3};

/// The two squares with the second `gap` above the first and turned over, so that from above the first shows its
/// front and the second its back.
fn layers(gap: f64) -> (Sheet, Vec<DVec3>) {
    let sheet = two_squares();
    let mut positions = sheet.planar();
    for p in &mut positions[4..] {
        *p = DVec3::new(p.x, 1.0 - p.y, gap);
    }
    (sheet, positions)
}

/// The first square lies on the side `sign` of the second's front normal, which points down.
fn order(sign: i8) -> LayerOrder {
    let mut order = LayerOrder::default();
    for (f, g) in [(0, 2), (0, 3), (1, 2), (1, 3)] {
        order.insert(f, g, sign);
        // Seen from the first square, whose normal points up, the second lies on the same side of it.
        order.insert(g, f, sign);
    }
    order
}

fn colors() -> ([u8; 3], [u8; 3]) {
    let sheet = square(Assignment::Facet);
    let flat = sheet.planar();
    let none = LayerOrder::default();
    let front = middle(&from_above(&sheet, &flat, &none, &plain()));
    let back = middle(&from_above(&sheet, &turned_over(&flat), &none, &plain()));
    (front, back)
}

#[test]
fn the_covered_pixels_sum_to_the_area_of_a_triangle() {
    let vertices = [DVec2::ZERO, DVec2::new(1.0, 0.13), DVec2::new(0.21, 0.97)];
    let sheet = sheet(&vertices, &[[0, 1, 2]], &[]);
    let style = Style { front: [0; 3], ..plain() };
    for turn in 0..12_i32 {
        let rotation = DMat3::from_rotation_z(f64::from(turn) * 0.31);
        let foot = DVec3::new(0.3, 0.4, 0.0);
        let turned = |p: &DVec3| DVec3::new(0.5, 0.5, 0.0) + rotation * (p - foot);
        let positions: Vec<_> = sheet.planar().iter().map(turned).collect();
        let image = from_above(&sheet, &positions, &LayerOrder::default(), &style);
        let covered: f64 = image.pixels.iter().map(|p| 1.0 - linear(p[1])).sum();
        let area = 0.5 * vertices[1].perp_dot(vertices[2]) * camera().scale().powi(2);
        // The perimeter crosses about 130 pixels, each off by a few hundredths with either sign.
        assert!((covered - area).abs() < 1.0, "turn {turn}: {covered} for {area}");
    }
}

#[test]
fn two_triangles_of_a_square_show_no_seam() {
    let sheet = square(Assignment::Facet);
    for turn in 0..20_i32 {
        let rotation = DMat3::from_quat(DQuat::from_euler(
            glam::EulerRot::XYZ,
            0.05 * f64::from(turn),
            0.3,
            0.17 * f64::from(turn),
        ));
        let centre = DVec3::new(0.5, 0.5, 0.0);
        let turned = |p: &DVec3| centre + rotation * (p - centre);
        let positions: Vec<_> = sheet.planar().iter().map(turned).collect();
        let image = from_above(&sheet, &positions, &LayerOrder::default(), &plain());
        let corners: Vec<_> = positions.iter().map(|&p| camera().project(p)).collect();
        let flat = middle(&image);
        let mut interior = 0;
        for y in 0..SIZE[1] {
            for x in 0..SIZE[0] {
                let point = DVec2::new(f64::from(x), f64::from(y)) + 0.5;
                let distance = |i: usize| {
                    let (a, b) = (corners[i].truncate(), corners[(i + 1) % 4].truncate());
                    (b - a).normalize().perp_dot(a - point)
                };
                if (0..4).all(|i| distance(i) > 0.71) {
                    interior += 1;
                    let seen = image.pixel(x, y);
                    // The normals of both triangles round differently in the last bit.
                    let error = (0..3).map(|c| seen[c].abs_diff(flat[c])).max().unwrap();
                    assert!(error <= 1, "turn {turn}: {seen:?} beside {flat:?} at {x}, {y}");
                }
            }
        }
        assert!(interior > 400, "turn {turn} looks at {interior} pixels");
    }
}

#[test]
fn a_triangle_behind_another_is_hidden_whatever_the_sequence_of_the_triangles() {
    let (sheet, positions) = layers(0.2);
    let none = LayerOrder::default();
    let (front, back) = colors();
    let image = from_above(&sheet, &positions, &none, &plain());
    assert_eq!(middle(&image), back);
    let below = from_above(&sheet, &turned_over(&positions), &none, &plain());
    assert_eq!(middle(&below), back, "from below the first square shows its back");
    assert_ne!(front, back);

    let vertices = sheet.vertices.clone();
    let faces = [[4, 6, 7], [0, 2, 3], [4, 5, 6], [0, 1, 2]];
    let shuffled = crate::common::sheet(&vertices, &faces, &[]);
    let styled = Style::default();
    assert_eq!(
        from_above(&sheet, &positions, &none, &styled),
        from_above(&shuffled, &positions, &none, &styled)
    );
}

#[test]
fn coincident_layers_follow_their_order_from_both_sides_and_flipping_it_flips_the_picture() {
    let (front, back) = colors();
    // On the front side of the second square is below it: there the second is seen from above.
    for (sign, above, below) in [(1, back, back), (-1, front, front)] {
        for gap in [0.0, 0.004, -0.004] {
            let (sheet, positions) = layers(gap);
            let image = from_above(&sheet, &positions, &order(sign), &plain());
            assert_eq!(middle(&image), above, "sign {sign}, gap {gap}, from above");
            let turned = turned_over(&positions);
            let image = from_above(&sheet, &turned, &order(sign), &plain());
            assert_eq!(middle(&image), below, "sign {sign}, gap {gap}, from below");
        }
    }
}

#[test]
fn one_recorded_direction_of_the_order_is_enough() {
    let (sheet, positions) = layers(0.0);
    for (sign, seen) in [(1, colors().1), (-1, colors().0)] {
        for swap in [false, true] {
            let mut half = LayerOrder::default();
            for (f, g, s) in order(sign).iter().filter(|&(f, g, _)| (f > g) == swap) {
                half.insert(f, g, s);
            }
            let image = from_above(&sheet, &positions, &half, &plain());
            assert_eq!(middle(&image), seen, "sign {sign}, swapped {swap}");
        }
    }
}

#[test]
fn depth_decides_beyond_the_tolerance_whatever_the_order_says() {
    let (front, back) = colors();
    for (gap, seen) in [(0.02, back), (-0.02, front)] {
        for sign in [1, -1] {
            let (sheet, positions) = layers(gap);
            let image = from_above(&sheet, &positions, &order(sign), &plain());
            assert_eq!(middle(&image), seen, "gap {gap}, sign {sign}");
        }
    }
}

#[test]
fn each_side_has_its_own_colour() {
    let sheet = square(Assignment::Facet);
    let flat = sheet.planar();
    let over = turned_over(&flat);
    let style = plain();
    let swapped = Style { front: style.back, back: style.front, ..plain() };
    let seen = |positions: &[DVec3], style: &Style| {
        middle(&from_above(&sheet, positions, &LayerOrder::default(), style))
    };
    assert_ne!(seen(&flat, &style), seen(&over, &style));
    assert_eq!(seen(&flat, &style), seen(&over, &swapped));
    assert_eq!(seen(&over, &style), seen(&flat, &swapped));
}

/// A rectangle of two squares with a crease of `assignment` on x = 0.5, and a flap above or below it.
fn creased(assignment: Assignment, flap_z: f64) -> (Sheet, Vec<DVec3>) {
    let v = DVec2::new;
    let vertices = [
        v(0.0, 0.0),
        v(0.5, 0.0),
        v(1.0, 0.0),
        v(1.0, 1.0),
        v(0.5, 1.0),
        v(0.0, 1.0),
        v(0.2, 0.1),
        v(0.8, 0.1),
        v(0.5, 0.45),
    ];
    let faces = [[0, 1, 4], [0, 4, 5], [1, 2, 4], [2, 3, 4], [6, 7, 8]];
    let sheet = sheet(&vertices, &faces, &[([1, 4], assignment)]);
    let mut positions = sheet.planar();
    positions[6..].iter_mut().for_each(|p| p.z = flap_z);
    (sheet, positions)
}

#[test]
fn a_crease_has_its_width_and_colour_and_is_hidden_where_its_facets_are() {
    let style = Style { line_width: 4.0, ..Style::default() };
    let kinds = [(Assignment::Mountain, style.mountain), (Assignment::Valley, style.valley)];
    for (assignment, color) in kinds {
        let (sheet, positions) = creased(assignment, -0.1);
        let image = from_above(&sheet, &positions, &LayerOrder::default(), &style);
        let (paper, _) = colors();
        // Row of y = 0.75, and of y = 0.25, where the flap may lie: the crease stands on column 48.
        for y in [27, 45] {
            let part = |x: u32| {
                let light = |c: [u8; 3]| DVec3::from(c.map(linear));
                let (from, to) = (light(paper), light(color));
                (light(image.pixel(x, y)) - from).dot(to - from) / (to - from).length_squared()
            };
            let width: f64 = (40..56).map(part).sum();
            assert!((width - 4.0).abs() < 0.05, "{assignment:?} is {width} wide");
            assert_eq!(image.pixel(48, y), color);
        }
        let (sheet, positions) = creased(assignment, 0.1);
        let image = from_above(&sheet, &positions, &LayerOrder::default(), &style);
        assert_eq!(image.pixel(48, 27), color, "free");
        assert_eq!(image.pixel(48, 45), paper, "hidden by the flap");
    }
}

#[test]
fn edges_inside_a_facet_are_not_drawn() {
    let style = Style { line_width: 4.0, ..Style::default() };
    let sheet = square(Assignment::Facet);
    let none = LayerOrder::default();
    let seen = middle(&from_above(&sheet, &sheet.planar(), &none, &style));
    assert_eq!(seen, colors().0);
}

#[test]
fn a_facet_seen_edge_on_still_shows_its_border() {
    let sheet = square(Assignment::Facet);
    let upright: Vec<_> = sheet.planar().iter().map(|p| DVec3::new(p.x, 0.5, p.y)).collect();
    let style = Style::default();
    let none = LayerOrder::default();
    let image = from_above(&sheet, &upright, &none, &style);
    assert!(middle(&image)[1] < 120, "{:?}", middle(&image));
    let without = from_above(&sheet, &upright, &none, &plain());
    assert!(without.pixels.iter().all(|&p| p == style.background));
}

/// Every triangle that a ray from `point` on the screen meets, with its distance from the viewer's plane: Möller and
/// Trumbore 1997 in the world, no projection.
fn ray_hits(sheet: &Sheet, positions: &[DVec3], origin: DVec3, toward: DVec3) -> Vec<(u32, f64)> {
    let mut hits = Vec::new();
    for (face, corners) in (0..).zip(&sheet.faces) {
        let [a, b, c] = corners.map(|v| positions[v as usize]);
        let (ab, ac) = (b - a, c - a);
        let p = toward.cross(ac);
        let determinant = ab.dot(p);
        if determinant.abs() < 1e-12 {
            continue;
        }
        let from_a = origin - a;
        let q = from_a.cross(ab);
        let (u, v) = (from_a.dot(p) / determinant, toward.dot(q) / determinant);
        if u >= 0.0 && v >= 0.0 && u + v <= 1.0 {
            hits.push((face, ac.dot(q) / determinant));
        }
    }
    hits
}

#[test]
fn the_triangle_in_front_is_the_one_that_a_ray_meets_first() {
    let unit = Unit::new(Case::S, 1.6, 1.0, None, None).unwrap();
    let units = UnitSheet::new(unit, 3, 2).unwrap();
    let sheet = &units.sheet;
    let order = units.compact_order();
    let paper = Paper::new(sheet, &order);
    let (flat, compact) = (sheet.planar(), units.compact());
    let mut compared = 0;
    let mut random = fastrand::Rng::with_seed(7);
    let mut random = || random.f64();
    for part in [0.3, 0.6, 0.9, 1.0] {
        let pairs = flat.iter().zip(&compact);
        let state: Vec<_> = pairs.map(|(&p, &q)| p.lerp(q, part)).collect();
        for view in [View::Iso, View::Front, View::Top] {
            let camera = Camera::fit(view, state.iter().copied(), SIZE, 0.0).unwrap();
            let surface = Surface::new(&paper, &state, &camera, &plain());
            let toward = camera.toward();
            let front = |face: u32| {
                let [a, b, c] = sheet.faces[face as usize].map(|v| state[v as usize]);
                (b - a).cross(c - a).dot(toward) > 0.0
            };
            for corners in sheet.faces.iter().cycle().take(400) {
                let [a, b, c] = corners.map(|v| state[v as usize]);
                // Seen edge-on it only has points on the edges of its neighbours.
                if (b - a).cross(c - a).dot(toward).abs() < 1e-9 {
                    continue;
                }
                let (s, t) = (random(), random());
                let origin = a + (b - a) * (s * (1.0 - t)) + (c - a) * (s * t);
                let hits = ray_hits(sheet, &state, origin, toward);
                let nearest = hits.iter().map(|h| h.1).fold(f64::NEG_INFINITY, f64::max);
                let near: Vec<_> = hits.iter().filter(|h| nearest - h.1 < 0.05).collect();
                // Of layers that come close, the one above all others as seen; only exact layers have a known order.
                let is_above = |f: u32, g: u32| match order.sign(f, g) {
                    Some(sign) => (sign > 0) == front(g),
                    None => false,
                };
                let expected: Vec<u32> = match near[..] {
                    [] => continue,
                    [only] => vec![only.0],
                    _ if part < 1.0 => continue,
                    _ => {
                        let all = near.iter().map(|h| h.0);
                        let above_all =
                            |&f: &u32| near.iter().all(|h| h.0 == f || is_above(f, h.0));
                        all.filter(above_all).collect()
                    }
                };
                let point = camera.project(origin).truncate();
                if let [expected] = expected[..] {
                    let seen = surface.front_at(point).map(|candidate| candidate.face);
                    assert_eq!(seen, Some(expected), "{part} {view:?} at {point}");
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 2000, "{compared} rays compared");
}

#[test]
fn a_camera_shows_all_points_at_equal_scale_inside_its_margin() {
    let unit = Unit::new(Case::E, 1.0, 1.0, None, None).unwrap();
    let points = UnitSheet::new(unit, 3, 2).unwrap().sheet.planar();
    for (name, view) in View::NAMES {
        assert_eq!(View::from_name(name), Some(view));
        if matches!(view, View::Front | View::Side) {
            continue;
        }
        let camera = Camera::fit(view, points.iter().copied(), [640, 480], 0.1).unwrap();
        for &p in &points {
            let seen = camera.project(p);
            assert!((63.999..=576.001).contains(&seen.x), "{name}: {seen}");
            assert!((47.999..=432.001).contains(&seen.y), "{name}: {seen}");
            let q = points[0];
            let lengths = [p.distance(q) * camera.scale(), seen.distance(camera.project(q))];
            assert!((lengths[0] - lengths[1]).abs() < 1e-9, "{name}: {lengths:?}");
        }
    }
    assert_eq!(View::from_name("sideways"), None);
}

#[test]
fn pictures_of_bad_input_are_refused() {
    let sheet = square(Assignment::Facet);
    let flat = sheet.planar();
    let none = LayerOrder::default();
    let try_picture = |positions: &[DVec3], style: &Style, size: [u32; 2]| {
        picture(&sheet, positions, &none, &camera(), style, size).unwrap_err()
    };
    for size in [[0, 10], [10, 0], [65_536, 10], [65_535, 65_535]] {
        let error = try_picture(&flat, &plain(), size);
        assert!(matches!(error, RecordError::Size { .. }), "{error}");
    }
    let error = try_picture(&flat[1..], &plain(), SIZE);
    assert!(matches!(error, RecordError::VertexCount { found: 3, .. }), "{error}");
    let mut broken = flat.clone();
    broken[2].y = f64::NAN;
    let error = try_picture(&broken, &plain(), SIZE);
    assert!(matches!(error, RecordError::NotFinite { vertex: 2, .. }), "{error}");
    for line_width in [-1.0, f64::NAN, 1e9] {
        let style = Style { line_width, ..plain() };
        let error = try_picture(&flat, &style, SIZE);
        assert!(matches!(error, RecordError::LineWidth { .. }), "{error}");
    }
}

#[test]
fn cameras_of_bad_input_are_refused() {
    let points = square(Assignment::Facet).planar();
    for margin in [-0.1, 0.5, f64::NAN] {
        let error = Camera::fit(View::Iso, points.clone(), SIZE, margin).unwrap_err();
        assert!(matches!(error, RecordError::Margin { .. }), "{error}");
    }
    let bad = [
        vec![],
        vec![DVec3::ZERO, DVec3::NAN],
        vec![DVec3::splat(-1e308), DVec3::splat(1e308)],
        vec![DVec3::ZERO, DVec3::X * 1e308, DVec3::Y * 1e-320],
        vec![DVec3::ZERO, DVec3::X * 1e-320],
    ];
    for points in bad {
        let fitted = Camera::fit(View::Iso, points.clone(), SIZE, 0.0);
        if let Ok(camera) = fitted {
            let is_seen = |&p: &DVec3| camera.project(p).is_finite();
            assert!(points.iter().all(is_seen), "{points:?}");
        }
    }
    let error = Camera::fit(View::Iso, [], SIZE, 0.0).unwrap_err();
    assert!(matches!(error, RecordError::Extent { .. }), "{error}");
    let one = Camera::fit(View::Iso, [DVec3::ONE], SIZE, 0.0).unwrap();
    assert_eq!(one.project(DVec3::ONE).truncate(), DVec2::new(48.0, 36.0));
}

#[test]
fn layers_that_noise_drives_through_each_other_keep_their_faces_only_by_their_order() {
    let unit = Unit::new(Case::E, 1.0, 1.0, None, None).unwrap();
    let units = UnitSheet::new(unit, 3, 2).unwrap();
    let compact = units.compact();
    let size = [192, 144];
    let camera = Camera::fit(View::Front, compact.iter().copied(), size, 0.05).unwrap();
    // The noise a motion without contact leaves between frames, across the layers: up to 6e-3 h between two.
    let noisy: Vec<_> = (0_u32..)
        .zip(&compact)
        .map(|(i, &p)| p + DVec3::Y * 3e-3 * f64::from(i * 7919 % 101).sin())
        .collect();
    let changed = |order: &LayerOrder| {
        let paper = Paper::new(&units.sheet, order);
        let style = plain();
        let seen = [&compact, &noisy].map(|state| {
            let surface = Surface::new(&paper, state, &camera, &style);
            let at = |k: u32| DVec2::new(f64::from(k % 192), f64::from(k / 192)) + 0.37;
            let points = (0..192 * 144).map(at);
            let faces: Vec<_> =
                points.map(|p| surface.front_at(p).map(|candidate| candidate.face)).collect();
            faces
        });
        let differ = seen[0].iter().zip(&seen[1]).filter(|(a, b)| a != b);
        (differ.count(), seen[0].iter().flatten().count())
    };
    let (with_order, shown) = changed(&units.compact_order());
    assert!(shown > 4000, "{shown} points show paper");
    assert!(with_order * 200 < shown, "{with_order} of {shown} points flicker");
    let (without_order, _) = changed(&LayerOrder::default());
    assert!(without_order * 4 > shown, "only {without_order} of {shown} flicker");
}
