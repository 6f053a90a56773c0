//! Seeded queries and triangle pairs of every kind that makes collision kernels fail.

use foldmotion_random::Random;
use glam::DVec3;

use super::contact::{Path, Query};

/// How a configuration is generated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Class {
    Random,
    NearDegenerate,
    Coplanar,
    Parallel,
    SharedCoordinates,
    SharedVertices,
    NoExtent,
    Identical,
    Static,
    Touching,
    Grazing,
    SubUlp,
    HugeOrTiny,
    Fast,
}

impl Class {
    pub(crate) const ALL: [Self; 14] = [
        Self::Random,
        Self::NearDegenerate,
        Self::Coplanar,
        Self::Parallel,
        Self::SharedCoordinates,
        Self::SharedVertices,
        Self::NoExtent,
        Self::Identical,
        Self::Static,
        Self::Touching,
        Self::Grazing,
        Self::SubUlp,
        Self::HugeOrTiny,
        Self::Fast,
    ];
}

/// The query of this class and number; the same for the same seed.
pub(crate) fn query(class: Class, number: u64) -> Query {
    let mut random = Random::new(number.wrapping_mul(0x2545_f491_4f6c_dd1d) ^ class as u64);
    let is_vertex_facet = random.index(2) == 0;
    let cut = if is_vertex_facet { 1 } else { 2 };
    let [p, q, r, s] = paths(class, cut, &mut random);
    if is_vertex_facet { Query::VertexFacet(p, [q, r, s]) } else { Query::EdgeEdge([p, q], [r, s]) }
}

/// The triangle pair of this class and number.
pub(crate) fn triangles(class: Class, number: u64) -> [[Path; 3]; 2] {
    let mut random = Random::new(number.wrapping_mul(0x9e6c_63d0_876a_3f6b) ^ class as u64);
    let [a0, a1, a2, b0, b1, b2] = paths(class, 3, &mut random);
    [[a0, a1, a2], [b0, b1, b2]]
}

/// Whether two triangles share a point at t = 0: an edge of one meets the facet of the other, as a vertex would that
/// runs along it.
pub(crate) fn start_in_contact([a, b]: &[[Path; 3]; 2]) -> bool {
    let still = |t: &[Path; 3]| t.map(|[p, _]| [p, p]);
    let has_edge_through = |a: &[Path; 3], b: &[Path; 3]| {
        let runs_through = |i: usize| {
            let along = [a[i][0], a[(i + 1) % 3][0]];
            Query::VertexFacet(along, still(b)).meets()
        };
        (0..3).any(runs_through)
    };
    has_edge_through(a, b) || has_edge_through(b, a)
}

/// The six vertex–facet and nine edge–edge queries of two triangles: triangles that start apart meet exactly if one of
/// them does.
pub(crate) fn queries_of([a, b]: &[[Path; 3]; 2]) -> Vec<Query> {
    let edge = |t: &[Path; 3], i: usize| [t[i], t[(i + 1) % 3]];
    let mut queries = Vec::with_capacity(15);
    for i in 0..3 {
        queries.push(Query::VertexFacet(a[i], *b));
        queries.push(Query::VertexFacet(b[i], *a));
        queries.extend((0..3).map(|j| Query::EdgeEdge(edge(a, i), edge(b, j))));
    }
    queries
}

/// N moving points: the first `cut` form one feature, the others the other.
fn paths<const N: usize>(class: Class, cut: usize, random: &mut Random) -> [Path; N] {
    match class {
        Class::Random => scattered(random),
        Class::NearDegenerate => {
            let base = [Class::Coplanar, Class::Touching, Class::SharedCoordinates];
            let paths = paths(base[random.index(3)], cut, random);
            let size = power(10.0, -16, -3, random);
            paths.map(|path: Path| path.map(|p| p + random.vector() * size))
        }
        Class::Coplanar => coplanar(random),
        Class::Parallel => parallel(cut, random),
        Class::SharedCoordinates => on_grid(random),
        Class::SharedVertices => shared(cut, random),
        Class::NoExtent => without_extent(cut, random),
        Class::Identical => identical(cut, random),
        Class::Static => {
            let base = [Class::Random, Class::Touching, Class::Coplanar, Class::SharedCoordinates];
            let moving: [Path; N] = paths(base[random.index(4)], cut, random);
            let end = random.index(2);
            moving.map(|path| [path[end]; 2])
        }
        Class::Touching => touching(cut, 1.0, random),
        Class::Grazing => grazing(cut, random),
        Class::SubUlp => {
            let base = [Class::Touching, Class::Grazing, Class::Coplanar, Class::Parallel];
            let mut moved = paths(base[random.index(4)], cut, random);
            for _ in 0..=random.index(3) {
                nudge(&mut moved[random.index(N)][random.index(2)], random);
            }
            moved
        }
        Class::HugeOrTiny => {
            let base = [Class::Random, Class::Touching, Class::Coplanar, Class::Parallel];
            let paths = paths(base[random.index(4)], cut, random);
            let scale = power(10.0, -280, 279, random);
            paths.map(|path: Path| path.map(|p| p * scale))
        }
        Class::Fast => {
            let speed = f64::from(1_u32 << random.index(30));
            touching(cut, speed, random)
        }
    }
}

/// A power of `base` with an exponent from `least` to `greatest`.
fn power(base: f64, least: i16, greatest: i16, random: &mut Random) -> f64 {
    let count = usize::from(greatest.abs_diff(least)) + 1;
    base.powi(i32::from(least) + i32::from(random.index(count) as u16))
}

fn scattered<const N: usize>(random: &mut Random) -> [Path; N] {
    [(); N].map(|()| [random.vector(), random.vector()])
}

/// A point with integer coordinates from −2 to 2.
fn grid_point(random: &mut Random) -> DVec3 {
    (random.vector() * 2.5).round()
}

fn on_grid<const N: usize>(random: &mut Random) -> [Path; N] {
    [(); N].map(|()| [grid_point(random), grid_point(random)])
}

fn either<const N: usize>(random: &mut Random) -> [Path; N] {
    if random.index(2) == 0 { scattered(random) } else { on_grid(random) }
}

/// All points in one plane throughout.
fn coplanar<const N: usize>(random: &mut Random) -> [Path; N] {
    let (kind, level) = (random.index(3), random.number());
    either(random).map(|path: Path| {
        path.map(|p| match kind {
            0 => DVec3::new(p.x, p.y, level),
            1 => DVec3::new(p.x, p.y, p.x),
            _ => DVec3::new(level, p.y, p.y),
        })
    })
}

/// Parallel edges, or horizontal facets passing each other at heights that may vanish.
fn parallel<const N: usize>(cut: usize, random: &mut Random) -> [Path; N] {
    let mut paths: [Path; N] = on_grid(random);
    if cut == 2 {
        let factor = [1.0, -1.0, 2.0, 0.5][random.index(4)];
        let [p, q, r] = [paths[0], paths[1], paths[2]];
        paths[3] = [0, 1].map(|end| r[end] + (q[end] - p[end]) * factor);
        return paths;
    }
    let heights = [0.0, f64::EPSILON, -1e-9, 1.0, -0.5];
    let levels = [(); 2].map(|()| heights[random.index(5)]);
    for (k, path) in paths.iter_mut().enumerate() {
        for (p, level) in path.iter_mut().zip(levels) {
            p.z = if k < cut { level } else { 0.0 };
        }
    }
    paths
}

/// A point of one feature equals one of the other, at one end or throughout.
fn shared<const N: usize>(cut: usize, random: &mut Random) -> [Path; N] {
    let mut paths: [Path; N] = either(random);
    let (i, j) = (random.index(cut), cut + random.index(N - cut));
    let end = random.index(3);
    if end < 2 {
        paths[j][end] = paths[i][end];
    } else {
        paths[j] = paths[i];
    }
    paths
}

/// The second feature is a copy of the first, displaced at the ends by steps that may vanish.
fn identical<const N: usize>(cut: usize, random: &mut Random) -> [Path; N] {
    let mut paths: [Path; N] = either(random);
    let steps = [(); 2].map(|()| grid_point(random) * [0.0, 0.5, 1.0][random.index(3)]);
    for k in cut..N {
        let [p0, p1] = paths[(k - cut) % cut];
        paths[k] = [p0 + steps[0], p1 + steps[1]];
    }
    paths
}

/// Edges without length and facets without area, at one end or throughout.
fn without_extent<const N: usize>(cut: usize, random: &mut Random) -> [Path; N] {
    let mut paths: [Path; N] = either(random);
    match random.index(3) {
        0 => paths[N - 1] = paths[cut],
        1 => paths[cut..].fill([DVec3::ZERO, grid_point(random)]),
        _ => {
            // Three points on a line.
            let (from, to) = (paths[cut], paths[N - 2]);
            paths[N - 1] = [0, 1].map(|end| from[end].midpoint(to[end]));
        }
    }
    if random.index(2) == 0 {
        paths[cut - 1] = paths[0];
    }
    paths
}

/// A dyadic instant, 0 and 1 among them.
fn instant(random: &mut Random) -> f64 {
    let shift = random.index(6) as u32;
    random.index((1 << shift) + 1) as f64 / f64::from(1_u32 << shift)
}

/// The points that are the vertex and the facet, or the ends of two edges: (p, a, b, c) or (a0, a1, b0, b1).
fn roles(cut: usize, random: &mut Random) -> (bool, [usize; 4]) {
    match (cut, random.index(2)) {
        (1, _) => (true, [0, 1, 2, 3]),
        (2, _) => (false, [0, 1, 2, 3]),
        (_, 0) => (true, [3, 0, 1, 2]),
        _ => (false, [0, 1, 3, 4]),
    }
}

/// Features that share a point exactly at a dyadic instant, on straight paths of velocities up to `speed`.
fn touching<const N: usize>(cut: usize, speed: f64, random: &mut Random) -> [Path; N] {
    let t = instant(random);
    let mut points = [(); N].map(|()| grid_point(random) * 4.0);
    let (is_vertex_facet, [p, q, r, s]) = roles(cut, random);
    if is_vertex_facet {
        // Integer weights with sum 4, so that the point is exact.
        let i = random.index(5);
        let j = random.index(5 - i);
        let weights = [i, j, 4 - i - j].map(|w| w as f64 * 0.25);
        points[p] = points[q] * weights[0] + points[r] * weights[1] + points[s] * weights[2];
    } else {
        let along = random.index(5) as f64 * 0.25;
        let meeting = points[p] + (points[q] - points[p]) * along;
        let factor = f64::from(1 << random.index(3));
        points[s] = points[r] + (meeting - points[r]) * factor;
    }
    points.map(|point| {
        let velocity = grid_point(random) * speed;
        [point - velocity * t, point + velocity * (1.0 - t)]
    })
}

/// A vertex that touches a tilting facet at a dyadic instant and goes back (for edges: one that does so on an edge in
/// the plane of the facet): the height above the plane is k s (t − t*)².
fn grazing<const N: usize>(cut: usize, random: &mut Random) -> [Path; N] {
    let at = instant(random);
    let tilt = power(2.0, -2, 2, random);
    let drift = power(2.0, -2, 2, random) * [1.0, -1.0][random.index(2)];
    let place = random.index(5) as f64 * 0.25;
    let [t0, t1] = [-at, 1.0 - at];
    let moving = |point: &dyn Fn(f64) -> DVec3| [point(t0), point(t1)];
    let mut paths: [Path; N] = on_grid(random);
    let (is_vertex_facet, [p, q, r, s]) = roles(cut, random);
    let touches = moving(&|t| DVec3::new(place + drift * t, 0.0, tilt * place * t));
    let tip = moving(&|t| DVec3::new(1.0, 0.0, tilt * t));
    if is_vertex_facet {
        paths[p] = touches;
        paths[q] = [DVec3::new(0.0, -1.0, 0.0); 2];
        paths[r] = [DVec3::new(0.0, 1.0, 0.0); 2];
        paths[s] = tip;
    } else {
        // The edge from the origin to the tip, and one from the vertex along y.
        paths[p] = [DVec3::ZERO; 2];
        paths[q] = tip;
        paths[r] = touches.map(|p| p - DVec3::Y);
        paths[s] = touches.map(|p| p + DVec3::Y);
    }
    let turn = random.index(3);
    paths.map(|path| {
        path.map(|p| match turn {
            0 => p,
            1 => DVec3::new(p.y, p.z, p.x),
            _ => DVec3::new(p.z, p.x, p.y),
        })
    })
}

/// Moves a coordinate by one to three ulps; most zeros by ulps of 1.
fn nudge(point: &mut DVec3, random: &mut Random) {
    let coordinate = &mut point[random.index(3)];
    let is_up = random.index(2) == 0;
    if *coordinate == 0.0 && random.index(8) > 0 {
        *coordinate = if is_up { f64::EPSILON } else { -f64::EPSILON };
    }
    for _ in 0..=random.index(3) {
        *coordinate = if is_up { coordinate.next_up() } else { coordinate.next_down() };
    }
}
