//! Visible areas and lines against rays.

use crate::common::*;
use foldmotion_pattern::{Assignment, Case, LayerOrder, Sheet, Unit, UnitSheet};
use foldmotion_record::{Camera, Paper, Surface, TIE_TOLERANCE, View, Visible, VisibleArea};
use glam::{DVec2, DVec3};

/// The camera's picture in pixels.
const PAGE: [u32; 2] = [640, 480];

/// A state of a sheet and who looks at it.
struct State<'a> {
    sheet: &'a Sheet,
    positions: &'a [DVec3],
    order: &'a LayerOrder,
    camera: Camera,
}

impl State<'_> {
    fn visible(&self) -> Visible {
        let paper = Paper::new(self.sheet, self.order);
        Surface::new(&paper, self.positions, &self.camera, &plain()).visible()
    }

    fn corners(&self, face: u32) -> [DVec3; 3] {
        self.sheet.faces[face as usize].map(|v| self.positions[v as usize])
    }

    fn normal(&self, face: u32) -> DVec3 {
        let [a, b, c] = self.corners(face);
        (b - a).cross(c - a).normalize_or_zero()
    }

    /// Every triangle that the ray through `point` of the screen meets, with its height towards the viewer: Möller and
    /// Trumbore 1997 in the world.
    fn hits(&self, origin: DVec3) -> Vec<(u32, f64)> {
        let toward = self.camera.toward();
        let mut hits = Vec::new();
        for face in 0..self.sheet.faces.len() as u32 {
            let [a, b, c] = self.corners(face);
            let (ab, ac) = (b - a, c - a);
            let p = toward.cross(ac);
            let determinant = ab.dot(p);
            if self.normal(face).dot(toward).abs() < 1e-9 {
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

    /// Whether `f` is before `g`, by the rule that [`Surface::in_front`] states, in lengths of the world.
    fn is_before(&self, (f, height): (u32, f64), (g, other): (u32, f64)) -> bool {
        let toward = self.camera.toward();
        let [n_f, n_g] = [f, g].map(|face| self.normal(face));
        let slant = n_f.dot(toward).abs().min(n_g.dot(toward).abs()).max(0.26);
        let is_close = (height - other).abs() * slant < TIE_TOLERANCE * self.sheet.unit_length;
        let same_side = (n_f.dot(n_g) > 0.0) == (n_f.dot(toward) * n_g.dot(toward) > 0.0);
        let is_parallel = n_f.dot(n_g).abs() > 0.866 && same_side;
        let above = self.order.sign(f, g);
        match above {
            Some(sign) if is_close && is_parallel => (sign > 0) == (n_g.dot(toward) > 0.0),
            _ => height > other,
        }
    }

    /// The triangle before all others on the ray through `origin`; `Err` where none or no single one is.
    fn front(&self, origin: DVec3) -> Option<Result<u32, ()>> {
        let hits = self.hits(origin);
        if hits.is_empty() {
            return None;
        }
        let before_all = |hit: &&(u32, f64)| {
            let mut others = hits.iter().filter(|other| other.0 != hit.0);
            others.all(|other| self.is_before(**hit, *other))
        };
        let mut front = hits.iter().filter(before_all).map(|hit| hit.0);
        Some(match (front.next(), front.next()) {
            (Some(one), None) => Ok(one),
            _ => Err(()),
        })
    }

    /// A point of the world seen at `point` of the screen.
    fn origin(&self, point: DVec2) -> DVec3 {
        let toward = self.camera.toward();
        let across = toward.any_orthonormal_vector();
        let axes = [across, toward.cross(across)];
        let zero = self.camera.project(DVec3::ZERO).truncate();
        let [a, b] = axes.map(|axis| self.camera.project(axis).truncate() - zero);
        let rest = point - zero;
        let determinant = a.perp_dot(b);
        let parts = [rest.perp_dot(b), a.perp_dot(rest)].map(|part| part / determinant);
        axes[0] * parts[0] + axes[1] * parts[1]
    }
}

/// Whether `point` lies inside `area`, by crossings.
fn holds(area: &VisibleArea, point: DVec2) -> bool {
    let mut inside = false;
    for ring in &area.rings {
        for (i, &a) in ring.iter().enumerate() {
            let b = ring[(i + 1) % ring.len()];
            let crosses = (a.y > point.y) != (b.y > point.y);
            if crosses && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x) {
                inside = !inside;
            }
        }
    }
    inside
}

fn segment_distance(point: DVec2, a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let s = (point - a).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
    point.distance(a + along * s.clamp(0.0, 1.0))
}

/// Compared and wrong points.
#[derive(Debug, Default, Clone, Copy)]
struct Count {
    compared: usize,
    wrong: usize,
    /// Where no triangle is before all others.
    circles: usize,
}

/// The areas at random points of the triangles, and of the page.
fn compare_areas(state: &State<'_>, visible: &Visible, points: usize) -> Count {
    let mut random = fastrand::Rng::with_seed(11);
    let mut count = Count::default();
    for k in 0..points {
        let point = if k % 4 == 0 {
            DVec2::new(random.f64() * 640.0, random.f64() * 480.0)
        } else {
            let faces = state.sheet.faces.len() as u32;
            let [a, b, c] = state.corners(random.u32(..faces));
            let (s, t) = (random.f64(), random.f64());
            let inside = a + (b - a) * (s * (1.0 - t)) + (c - a) * (s * t);
            state.camera.project(inside).truncate()
        };
        let near = |ring: &Vec<DVec2>| {
            let ends = ring.iter().zip(ring.iter().cycle().skip(1));
            ends.map(|(&a, &b)| segment_distance(point, a, b)).any(|distance| distance < 1e-4)
        };
        if visible.areas.iter().flat_map(|area| &area.rings).any(near) {
            continue;
        }
        let found: Vec<u32> =
            visible.areas.iter().filter(|area| holds(area, point)).map(|area| area.face).collect();
        count.compared += 1;
        let is_right = match state.front(state.origin(point)) {
            None => found.is_empty(),
            Some(Ok(face)) => found == [face],
            Some(Err(())) => {
                count.circles += 1;
                found.len() == 1
            }
        };
        count.wrong += usize::from(!is_right);
    }
    count
}

/// The lines at random points: seen where the triangle on one side is in front just beside it.
fn compare_lines(state: &State<'_>, visible: &Visible, points: usize) -> Count {
    const BESIDE: f64 = 1e-3;
    let mut random = fastrand::Rng::with_seed(5);
    let mut count = Count::default();
    let drawn = |index: &u32| state.sheet.edges[*index as usize].assignment != Assignment::Facet;
    let edges: Vec<u32> = (0..state.sheet.edges.len() as u32).filter(drawn).collect();
    for _ in 0..points {
        let index = edges[random.usize(..edges.len())];
        let edge = &state.sheet.edges[index as usize];
        let ends = edge.vertices.map(|v| state.positions[v as usize]);
        let place = ends[0].lerp(ends[1], random.f64());
        let point = state.camera.project(place).truncate();
        let [start, end] = ends.map(|p| state.camera.project(p).truncate());
        let parts = visible.lines.iter().filter(|line| line.edge == index);
        let near_end = |p: DVec2| p.distance(point) < 20.0 * BESIDE;
        if start.distance(end) < 1.0 || parts.clone().flat_map(|line| line.ends).any(near_end) {
            continue;
        }
        // A line of another facet that runs along it within the step beside it cannot be told apart.
        let others = edges.iter().map(|&other| &state.sheet.edges[other as usize]);
        let along = |other: &foldmotion_pattern::Edge| {
            let [a, b] = other.vertices.map(|v| state.positions[v as usize]);
            let [a, b] = [a, b].map(|p| state.camera.project(p).truncate());
            let distance = segment_distance(point, a, b);
            distance > 1e-9 && distance < 3.0 * BESIDE
        };
        if others.into_iter().any(along) {
            continue;
        }
        let is_front = |face: u32| {
            let apex = state.sheet.apex(face, edge).unwrap();
            let apex = state.camera.project(state.positions[apex as usize]).truncate();
            let inward = (apex - start).reject_from(end - start).normalize_or_zero();
            state.front(state.origin(point + inward * BESIDE)) == Some(Ok(face))
        };
        let sides: Vec<u32> = edge.faces.into_iter().flatten().collect();
        let flat = |face: u32| state.normal(face).dot(state.camera.toward()).abs() > 1e-6;
        if !sides.iter().all(|&face| flat(face)) {
            continue;
        }
        let expected = sides.into_iter().any(is_front);
        let found = parts
            .map(|line| segment_distance(point, line.ends[0], line.ends[1]))
            .any(|distance| distance < 1e-5);
        count.compared += 1;
        count.wrong += usize::from(expected != found);
    }
    count
}

/// Looks at `positions` from everywhere that matters.
fn states<'a>(
    units: &'a UnitSheet,
    positions: &'a [DVec3],
    order: &'a LayerOrder,
) -> Vec<State<'a>> {
    let views = [View::Iso, View::Front, View::Top, View::Side];
    views
        .map(|view| State {
            sheet: &units.sheet,
            positions,
            order,
            camera: Camera::fit(view, positions.iter().copied(), PAGE, 0.05).unwrap(),
        })
        .into_iter()
        .collect()
}

fn sheets() -> [UnitSheet; 3] {
    [(Case::E, 1.0, None), (Case::S, 1.6, None), (Case::SII, 1.6, Some(0.7))].map(
        |(case, width, lambda)| {
            UnitSheet::new(Unit::new(case, width, 1.0, lambda, None).unwrap(), 3, 2).unwrap()
        },
    )
}

/// Straight from flat to compact: facets are torn and drive through each other.
fn between(units: &UnitSheet, part: f64) -> Vec<DVec3> {
    let pairs = units.sheet.planar().into_iter().zip(units.compact());
    pairs.map(|(p, q)| p.lerp(q, part)).collect()
}

/// How much `compare` compares over all sheets and states, of which nothing may be wrong.
fn compared_from_flat_to_compact(compare: fn(&State<'_>, &Visible, usize) -> Count) -> usize {
    let mut compared = 0;
    for units in sheets() {
        let order = units.compact_order();
        for part in [0.0, 0.3, 0.6, 0.9, 0.995, 1.0] {
            let positions = between(&units, part);
            for state in states(&units, &positions, &order) {
                let count = compare(&state, &state.visible(), 400);
                assert_eq!(count.wrong, 0, "{:?} {part}: {count:?}", units.unit.case);
                compared += count.compared;
            }
        }
    }
    compared
}

#[test]
fn areas_are_those_that_rays_meet_first_from_flat_to_compact() {
    let compared = compared_from_flat_to_compact(compare_areas);
    assert!(compared > 20_000, "{compared}");
}

#[test]
fn lines_are_seen_where_rays_beside_them_meet_their_triangles_first() {
    let compared = compared_from_flat_to_compact(compare_lines);
    assert!(compared > 10_000, "{compared}");
}

#[test]
fn a_sheet_seen_in_another_order_or_state_is_found_out() {
    let [_, units, _] = sheets();
    let order = units.compact_order();
    let mut turned = LayerOrder::default();
    for (f, g, sign) in order.iter() {
        turned.insert(f, g, -sign);
    }
    let compact = units.compact();
    let folded = between(&units, 0.6);
    for (positions, seen, seen_order) in
        [(&compact, &compact, &turned), (&folded, &between(&units, 0.62), &order)]
    {
        let state = &states(&units, positions, &order)[0];
        let other = &states(&units, seen, seen_order)[0];
        let other = State { camera: state.camera, ..*other };
        let visible = other.visible();
        assert!(compare_areas(state, &visible, 400).wrong > 4);
        assert!(compare_lines(state, &visible, 400).wrong > 4);
    }
}

/// Area inside the rings of `area`, holes taken off.
fn size(area: &VisibleArea) -> f64 {
    let ring = |ring: &Vec<DVec2>| -> f64 {
        let next = ring.iter().cycle().skip(1);
        ring.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum()
    };
    0.5 * area.rings.iter().map(ring).sum::<f64>().abs()
}

/// The state of `sheet` from above, 24 pixels a unit of length.
fn from_top<'a>(sheet: &'a Sheet, positions: &'a [DVec3], order: &'a LayerOrder) -> State<'a> {
    State { sheet, positions, order, camera: camera() }
}

#[test]
fn squares_that_penetrate_are_cut_where_their_planes_meet() {
    let sheet = two_squares();
    let mut positions = sheet.planar();
    // The second rises through the first at x = 0.25.
    for p in &mut positions[4..] {
        p.z = p.x - 0.25;
    }
    let none = LayerOrder::default();
    let state = from_top(&sheet, &positions, &none);
    let visible = state.visible();
    let seen = |faces: [u32; 2]| -> f64 {
        let areas = visible.areas.iter().filter(|area| faces.contains(&area.face));
        areas.map(size).sum::<f64>() / state.camera.scale().powi(2)
    };
    assert!((seen([0, 1]) - 0.25).abs() < 1e-5, "{}", seen([0, 1]));
    assert!((seen([2, 3]) - 0.75).abs() < 1e-5, "{}", seen([2, 3]));
    // The side y = 0 of the second is hidden as far as x = 0.25.
    let edge = sheet.edges.iter().position(|e| e.vertices == [4, 5]).unwrap();
    let lines = visible.lines.iter().filter(|line| line.edge == edge as u32);
    let length: f64 = lines.map(|line| line.ends[0].distance(line.ends[1])).sum();
    assert!((length / state.camera.scale() - 0.75).abs() < 1e-9, "{length}");
}

#[test]
fn where_an_order_runs_in_a_circle_every_point_still_has_one_triangle() {
    let corners = [DVec2::ZERO, DVec2::X, DVec2::new(0.4, 0.9)];
    let vertices: Vec<DVec2> = corners.into_iter().cycle().take(9).collect();
    let sheet = sheet(&vertices, &[[0, 1, 2], [3, 4, 5], [6, 7, 8]], &[]);
    let mut order = LayerOrder::default();
    for (f, g) in [(0, 1), (1, 2), (2, 0)] {
        order.insert(f, g, 1);
        order.insert(g, f, -1);
    }
    let lift = |(k, p): (usize, DVec3)| p + DVec3::new(0.1, 0.05, 0.002) * (k / 3) as f64;
    let positions: Vec<DVec3> = sheet.planar().into_iter().enumerate().map(lift).collect();
    let state = from_top(&sheet, &positions, &order);
    let visible = state.visible();
    let count = compare_areas(&state, &visible, 400);
    assert_eq!(count.wrong, 0, "{count:?}");
    assert!(count.circles > 100, "{count:?}");
    let paper = Paper::new(&sheet, &order);
    let surface = Surface::new(&paper, &positions, &state.camera, &plain());
    let middle = state.camera.project(DVec3::new(0.6, 0.4, 0.0)).truncate();
    let front = surface.front_at(middle).map(|front| front.face);
    let areas = visible.areas.iter().filter(|area| holds(area, middle));
    assert_eq!(areas.map(|area| area.face).collect::<Vec<_>>(), [front.unwrap()]);
}
