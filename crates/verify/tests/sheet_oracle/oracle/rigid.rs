//! Rigid parts in relative translation: aimed at a feature of the other part, or at random.

use super::{
    class::Class,
    distance::{swept_distance, to_f64},
    exact::{Convex, Point, UNIT, minus, plus},
    mesh::{Mesh, WHOLE, place},
    part::{Part, between, sixteenths},
    scene::{Scene, Truth},
    undo::{Bodies, displacements},
};
use foldmotion_random::Random;

/// τ of the default options with unit length 1.
pub(crate) const TOLERANCE: f64 = 1e-6;

/// A point on a part with three directions: along it, in its surface, and out of it.
struct Aim {
    at: Point,
    along: Point,
    aside: Point,
    out: Point,
}

/// A share of a vector in sixteenths.
fn times(v: Point, n: i64) -> Point {
    v.map(|c| c * n / 16)
}

fn unit(i: usize) -> Point {
    let mut e = [0; 3];
    e[i] = UNIT;
    e
}

/// The vector doubled or halved to a length near the unit; a multiple of 2¹⁰ stays a multiple of 2⁸.
fn near_unit(mut v: Point) -> Point {
    let largest = |v: Point| v.iter().map(|c| c.abs()).max().unwrap_or(0);
    while v != [0; 3] && largest(v) < UNIT / 2 {
        v = v.map(|c| c * 2);
    }
    while largest(v) > 2 * UNIT {
        v = v.map(|c| c / 2);
    }
    v
}

/// A direction near the normal of three points, in sixteenths.
fn normal(a: Point, b: Point, c: Point) -> Point {
    let [p, q, r] = [a, b, c].map(to_f64);
    let n = (q - p).cross(r - p).normalize_or(glam::DVec3::Z);
    n.to_array().map(|c| sixteenths((c * 16.0).round() as i64))
}

/// The feature that a part is aimed at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Feature {
    Interior,
    Diagonal,
    Crease,
    InteriorVertex,
    Border,
}

fn aim(part: &Part, mesh: &Mesh, feature: Feature, random: &mut Random) -> Aim {
    let at = |v: usize| place(&mesh.vertices[v], &part.corners);
    let edges: Vec<_> = mesh.edges().into_iter().collect();
    let is_wanted = |beside: &[usize]| match (feature, beside) {
        (Feature::Diagonal | Feature::InteriorVertex, [f, g]) => {
            mesh.polygon_of[*f] == mesh.polygon_of[*g]
        }
        (Feature::Crease, [f, g]) => mesh.polygon_of[*f] != mesh.polygon_of[*g],
        (Feature::Border, [_]) => true,
        _ => false,
    };
    let wanted: Vec<_> = edges.iter().filter(|(_, beside)| is_wanted(beside)).collect();
    let aimed = if wanted.is_empty() { None } else { Some(wanted[random.index(wanted.len())]) };
    let triangle = aimed.map_or_else(|| random.index(mesh.triangles.len()), |(_, f)| f[0]);
    let corners = mesh.triangles[triangle];
    let [a, b] = aimed.map_or([corners[0], corners[1]], |(ends, _)| *ends);
    let c = corners.into_iter().find(|v| *v != a && *v != b).unwrap_or(a);
    let share = [4, 8, 8, 12][random.index(4)];
    let along = minus(at(b), at(a));
    let place = match (feature, aimed) {
        (Feature::Interior, _) | (_, None) => {
            plus(plus(at(a), times(along, 4)), times(minus(at(c), at(a)), 8))
        }
        (Feature::InteriorVertex, _) => inner_vertex(mesh, [a, b]).map_or(at(a), at),
        _ => plus(at(a), times(along, share)),
    };
    let beside = aimed.map_or_else(|| vec![triangle], |(_, beside)| beside.clone());
    let normals = beside.iter().map(|&f| {
        let [p, q, r] = mesh.triangles[f].map(at);
        normal(p, q, r)
    });
    Aim {
        at: place,
        along: near_unit(along),
        aside: near_unit(minus(at(c), at(a))),
        out: near_unit(normals.fold([0; 3], plus)),
    }
}

/// The end of an edge around which all edges have two triangles.
fn inner_vertex(mesh: &Mesh, ends: [usize; 2]) -> Option<usize> {
    let edges = mesh.edges();
    ends.into_iter().find(|v| edges.iter().all(|(e, beside)| !e.contains(v) || beside.len() == 2))
}

/// A length in multiples of 2⁻²⁶ that is zero, less than half of τ, or several times τ.
fn slight(random: &mut Random) -> i64 {
    let sign = [-1, 1][random.index(2)];
    sign * [0, 0, 0, 17, 27, 268, 6711][random.index(7)]
}

/// The moving part about the origin, in coordinates along, aside and out: standing on the origin or passing through it.
fn mover(class: Class, random: &mut Random) -> Part {
    let mut part = match class {
        Class::Thin => Part::needle(random),
        Class::Random | Class::Stack | Class::Tube => Part::any(random),
        _ if random.index(4) == 0 => Part::any(random),
        _ => Part::plate(random),
    };
    // Plates lie in x–y; x is along; the second is out for a wall and aside for a plate that lies.
    let (x, y, z) = (unit(0), unit(1), unit(2));
    let tilt = plus(z, times(y, between(random, -8, 8)));
    let skew = plus(x, times(y, between(random, -8, 8)));
    let lies = matches!(class, Class::Parallel) || (class == Class::Slide && random.index(2) == 0);
    let columns = match random.index(6) {
        _ if lies => [x, y, z],
        _ if class == Class::Thin => [x, y, z],
        0 | 1 => [x, z, y],
        2 => [y, z, x],
        3 => [x, tilt, y],
        4 => [skew, z, y],
        _ => [(); 3].map(|()| [(); 3].map(|()| sixteenths(between(random, -16, 16)))),
    };
    if determinant(columns).abs() > 0.05 {
        part = part.mapped(columns, [0; 3]);
    }
    let lowest = part.corners.iter().map(|p| p[2]).min().unwrap_or(0);
    let lows: Vec<Point> = part.corners.iter().copied().filter(|p| p[2] == lowest).collect();
    let contact = match (random.index(4), lows.as_slice()) {
        (0, _) => [0; 3],
        (1, [p, q]) => plus(*p, times(minus(*q, *p), 8)),
        _ => lows[random.index(lows.len())],
    };
    part.centred_at(contact)
}

fn determinant(columns: [Point; 3]) -> f64 {
    let [a, b, c] = columns.map(to_f64);
    a.cross(b).dot(c)
}

/// The displacements of the moving part from its position at the aim.
fn path(class: Class, aim: &Aim, random: &mut Random) -> Vec<Point> {
    let high = between(random, 6, 24);
    let low = between(random, 2, 24);
    let oblique = [0, 0, 3, -5][random.index(4)];
    let up = plus(aim.out, times(aim.along, oblique));
    let at = |n: i64| times(up, n);
    let slide = plus(
        times(aim.along, between(random, -16, 16)),
        times(aim.aside, between(random, -12, 12)),
    );
    let far = times(slide, 40);
    let dip = |depth: i64| {
        let [x, y, z] = to_f64(aim.out).normalize_or(glam::DVec3::Z).to_array();
        [x, y, z].map(|c| (-c * depth as f64).round() as i64)
    };
    let depths = [0, 0, 0, 14, 27, -17, -268, -6711, 268, 700];
    let [d, e] = [(); 2].map(|()| depths[random.index(10)]);
    let leaves = [high, -low][random.index(2)];
    match (class, random.index(4)) {
        (Class::TouchAndBack, 0) => vec![at(high), dip(d), dip(d), at(low)],
        (Class::TouchAndBack, 1) => vec![at(high), dip(d), at(high), dip(e), at(high)],
        (Class::TouchAndBack, _) => vec![at(high), dip(d), at(low)],
        (Class::Slide, 0) => vec![at(high), dip(d), plus(dip(d), far), plus(at(leaves), far)],
        (Class::Slide, 1) => vec![dip(0), plus(slide, dip(e)), plus(slide, at(leaves)), at(-low)],
        (Class::Slide, _) => {
            vec![at(high), dip(d), plus(slide, dip(e)), plus(slide, at(leaves))]
        }
        (Class::Static, 0) => vec![at(0), at(0)],
        (Class::Static, 1) => vec![dip(d), dip(e), dip(d)],
        (Class::Static, _) => vec![at(-low); 2 + random.index(2)],
        (Class::Random, _) => {
            let any = |random: &mut Random| [(); 3].map(|()| sixteenths(between(random, -24, 24)));
            (0..2 + random.index(4)).map(|_| any(random)).collect()
        }
        (Class::Along, _) => {
            let from = plus(at(-low / 2), times(aim.along, 36));
            vec![from, plus(at(-low / 2), times(aim.along, between(random, -36, 8)))]
        }
        (_, 0) => vec![at(high), at(high / 2), at(-low / 2), at(-low)],
        (_, 1) => vec![at(high), at(-low), at(high)],
        _ => vec![at(high), at(-low)],
    }
}

fn still(class: Class, random: &mut Random) -> (Part, Feature) {
    let features = [Feature::Interior, Feature::Diagonal, Feature::InteriorVertex, Feature::Crease];
    let any = features[random.index(4)];
    let bent = |random: &mut Random| match random.index(3) {
        0 => Part::roof(random),
        1 => Part::strip(random),
        _ => Part::taco(random),
    };
    match class {
        Class::Interior => (Part::any(random), Feature::Interior),
        Class::Diagonal => (Part::plate(random), Feature::Diagonal),
        Class::Crease => (bent(random), Feature::Crease),
        Class::InteriorVertex => (Part::plate(random), Feature::InteriorVertex),
        Class::Beside => (Part::plate(random), Feature::Border),
        Class::Stack => (Part::stack(random), any),
        Class::Tube => (Part::tube(random), any),
        Class::Parallel => (Part::plate(random), [Feature::Diagonal, any][random.index(2)]),
        _ if random.index(3) == 0 => (bent(random), any),
        _ => (Part::plate(random), any),
    }
}

/// A random scene of two rigid parts.
pub(crate) fn scene(class: Class, random: &mut Random) -> Scene {
    loop {
        if let Some(scene) = attempt(class, random) {
            return scene;
        }
    }
}

/// A plate between the plates of a stack, or a part inside a tube: in, against a side, and out.
fn within(class: Class, random: &mut Random) -> Option<Scene> {
    let slip = |random: &mut Random| {
        let sign = [-1, 1][random.index(2)];
        sign * [0, 0, 0, 14, 27, 268, 6711][random.index(7)]
    };
    let far = sixteenths(44);
    if class == Class::Stack {
        let still = Part::stack(random);
        let moving = Part::plate(random);
        let level = |random: &mut Random, n: i64| sixteenths(n) + slip(random);
        let side = [0, 6, 6][random.index(3)];
        let top = level(random, side);
        let end = [level(random, 3), level(random, 6), level(random, 0), -far][random.index(4)];
        let aside = sixteenths(between(random, -8, 8));
        let path = [
            [far, 0, sixteenths(3)],
            [aside, 0, sixteenths(3)],
            [aside, aside, top],
            [aside, 0, end],
            [0, -far, end],
        ];
        let count = 3 + random.index(3);
        let mesh = Mesh::random(&still, random, false);
        return compose(class, &still, mesh, &moving, &path[..count], random);
    }
    let still = Part::tube(random);
    let [w, h] = [between(random, 2, 6), between(random, 2, 6)];
    let moving = match random.index(3) {
        0 => Part::extruded(&[[-w, -h], [w, -h], [w, h], [-w, h]], true, [-8, 8]),
        1 => Part::extruded(&[[-w, h], [0, -h], [w, h]], false, [-8, 8]),
        _ => Part::extruded(&[[-w, -h], [w, h]], false, [-6, 12]),
    };
    let against = |random: &mut Random| {
        let x = sixteenths([12 - w, w - 12, 8 - w, 3][random.index(4)]) + slip(random);
        let z = sixteenths([12 - h, h - 12, h - 8, 0][random.index(4)]) + slip(random);
        [[x, 0, 0], [0, 0, z], [0, 0, 0]][random.index(3)]
    };
    let path = [[0, far, 0], against(random), against(random), against(random), [0, -far, 0]];
    let count = 2 + random.index(4);
    let mesh = Mesh::random(&still, random, false);
    compose(class, &still, mesh, &moving, &path[..count], random)
}

fn attempt(class: Class, random: &mut Random) -> Option<Scene> {
    if matches!(class, Class::Stack | Class::Tube) && random.index(2) == 0 {
        return within(class, random);
    }
    let (mut part, feature) = still(class, random);
    if class != Class::Parallel && random.index(3) == 0 {
        // In quarters, so that what is built from it stays exact.
        let columns = [(); 3].map(|()| [(); 3].map(|()| sixteenths(4 * between(random, -4, 4))));
        if determinant(columns).abs() > 0.2 {
            part = part.mapped(columns, [0; 3]);
        }
    }
    let mesh = Mesh::random(&part, random, false);
    let aim = aim(&part, &mesh, feature, random);
    let moving = mover(class, random);
    let columns = [aim.along, aim.aside, aim.out];
    if determinant(columns).abs() < 0.05 {
        return None;
    }
    let mut moving = moving.mapped(columns, aim.at);
    let [along, aside] = [aim.along, aim.aside].map(|v| to_f64(v).normalize_or_zero());
    let shift = match class {
        Class::Beside => aside * slight(random) as f64,
        _ => aside * slight(random) as f64 + along * [0, 0, slight(random)][random.index(3)] as f64,
    };
    let shift = shift.to_array().map(|c| c.round() as i64);
    if random.index(2) == 0 || class == Class::Beside {
        moving = moving.centred_at(shift);
    }
    let kinds = [class, Class::TouchAndBack, Class::Slide, Class::Static, Class::TouchAndBack];
    let kind = match class {
        Class::Stack | Class::Tube | Class::Thin => kinds[random.index(5)],
        Class::Interior | Class::Diagonal | Class::Crease | Class::InteriorVertex => {
            kinds[[0, 0, 0, 1, 2, 3][random.index(6)]]
        }
        _ => class,
    };
    let path = path(kind, &aim, random);
    compose(class, &part, mesh, &moving, &path, random)
}

fn compose(
    class: Class,
    still: &Part,
    mesh: Mesh,
    moving: &Part,
    path: &[Point],
    random: &mut Random,
) -> Option<Scene> {
    let all = still.corners.iter().chain(&moving.corners).chain(path);
    if all.flatten().any(|c| c.abs() > 5 * UNIT) || has_thin_part(class, moving) {
        return None;
    }
    let allows_slivers = class == Class::Thin;
    let mesh = joined(mesh, Mesh::random(moving, random, allows_slivers), still);
    if mesh.triangles.len() > 40 {
        return None;
    }
    let bodies = Bodies { still: still.pieces(), moving: moving.pieces(), path: path.to_vec() };
    if !bodies.still.iter().chain(&bodies.moving).all(Convex::is_plane) {
        return None;
    }
    let nearest = bodies.distance();
    let truth = truth(&bodies, nearest, allows_slivers);
    let separation =
        (!allows_slivers).then(|| nearest.min(own_distance(still)).min(own_distance(moving)));
    let mut part = still.clone();
    part.append(moving);
    let first = still.corners.len();
    let place = |shift: &Point| -> Vec<Point> {
        let moved = part.corners.iter().enumerate();
        moved.map(|(i, &p)| if i < first { p } else { plus(p, *shift) }).collect()
    };
    Some(Scene {
        frames: path.iter().map(place).collect(),
        part,
        mesh,
        truth,
        separation,
        allows_slivers,
    })
}

/// The truth decided by displaced paths; see [`super::undo`].
fn truth(bodies: &Bodies, nearest: f64, is_thin: bool) -> Truth {
    if nearest > 1.5 * TOLERANCE {
        return if is_thin { Truth::NotThrough } else { Truth::Free };
    }
    let small = displacements(0.5 * TOLERANCE);
    let along = |lengths: [f64; 3]| bodies.along_wedges(&lengths.map(|l| l * TOLERANCE));
    let is_undone = |choices: &[Point], densities: [i64; 2]| {
        densities.into_iter().any(|density| bodies.can_be_undone(choices, density))
    };
    if is_undone(&small, [1, 4]) || is_undone(&along([0.3, 0.6, 0.9]), [1, 4]) {
        return if nearest < 0.7 * TOLERANCE { Truth::Touching } else { Truth::NotThrough };
    }
    // In a narrow wedge, displacements of 2 τ lead out through its walls, but smaller ones of the right length do not.
    let tenths = (6..20).map(|tenth| 0.1 * f64::from(tenth) * TOLERANCE);
    if bodies.can_be_undone(&displacements(2.0 * TOLERANCE), 4)
        || tenths.into_iter().any(|r| bodies.can_be_undone(&displacements(r), 1))
        || is_undone(&along([1.0, 1.4, 1.8]), [1, 4])
    {
        return Truth::Open;
    }
    Truth::Penetrating
}

/// Whether the map has made a part so flat that its own facets come near each other.
fn has_thin_part(class: Class, part: &Part) -> bool {
    class != Class::Thin && own_distance(part) < 0.02
}

/// The smallest distance of polygons without a common corner.
fn own_distance(part: &Part) -> f64 {
    let pieces = part.pieces();
    let mut least = f64::INFINITY;
    for (f, p) in part.convex.iter().enumerate() {
        for (g, q) in part.convex.iter().enumerate().take(f) {
            let is_one = part.polygons.len() == 1;
            if !is_one && !p.iter().any(|c| q.contains(c)) {
                let distance = swept_distance(&pieces[f], &pieces[g], [0; 3], [0; 3]);
                least = least.min(distance);
            }
        }
    }
    least
}

/// Two triangulations beside each other.
fn joined(mut mesh: Mesh, other: Mesh, still: &Part) -> Mesh {
    let (first, corners) = (mesh.vertices.len(), still.corners.len());
    let polygons = mesh.outlines.len();
    let shifted = |w: Vec<(usize, i64)>| w.into_iter().map(|(c, w)| (c + corners, w)).collect();
    mesh.vertices.extend(other.vertices.into_iter().map(shifted));
    mesh.triangles.extend(other.triangles.into_iter().map(|t| t.map(|v| v + first)));
    mesh.polygon_of.extend(other.polygon_of.into_iter().map(|p| p + polygons));
    let outline = |o: Vec<usize>| o.into_iter().map(|v| v + first).collect();
    mesh.outlines.extend(other.outlines.into_iter().map(outline));
    debug_assert!(mesh.vertices.iter().all(|w| w.iter().map(|(_, w)| w).sum::<i64>() == WHOLE));
    mesh
}
