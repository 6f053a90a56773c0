//! The distance of triangles compared with integer arithmetic without rounding: slivers, nearly parallel edges, small
//! offsets.
#![expect(clippy::unwrap_used, reason = "a test stops where a value is missing")]

use foldmotion_geometry::{segment_segment, triangle_triangle};
use foldmotion_random::Random;
use glam::DVec3;
use num_bigint::BigInt;

/// About a hundred roundings of lengths up to 4.
const ROUNDING: f64 = 1e-13;
/// Coordinates are integer multiples of this.
const UNIT: f64 = 1.0 / (1u64 << 40) as f64;

type Point = [i64; 3];
type Whole = [BigInt; 3];

fn minus(p: Point, q: Point) -> Whole {
    [0, 1, 2].map(|k| BigInt::from(p[k] - q[k]))
}

fn dot(u: &Whole, v: &Whole) -> BigInt {
    (0..3).map(|k| &u[k] * &v[k]).sum()
}

fn cross(u: &Whole, v: &Whole) -> Whole {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &u[i] * &v[j] - &u[j] * &v[i])
}

fn is_zero(x: &BigInt) -> bool {
    *x == BigInt::ZERO
}

/// A number of about 60 bits and an exponent of 2, accurate to 2⁻⁵⁸.
fn rounded(x: &BigInt) -> (f64, i32) {
    let shift = i64::try_from(x.bits()).unwrap() - 60;
    let top = if shift > 0 { x >> shift } else { x.clone() };
    let value = i64::try_from(top).unwrap() as f64;
    (value, i32::try_from(shift.max(0)).unwrap())
}

/// √(x / y) in units of length.
fn root(x: &BigInt, y: &BigInt) -> f64 {
    let ((p, i), (q, j)) = (rounded(x), rounded(y));
    (p / q * 2f64.powi(i - j)).sqrt() * UNIT
}

/// The distance from a point to a segment.
fn to_segment(p: Point, [from, to]: [Point; 2]) -> f64 {
    let (along, w) = (minus(to, from), minus(p, from));
    let (squared, t) = (dot(&along, &along), dot(&along, &w));
    let one = BigInt::from(1);
    if is_zero(&squared) || t <= BigInt::ZERO {
        return root(&dot(&w, &w), &one);
    }
    if t >= squared {
        let w = minus(p, to);
        return root(&dot(&w, &w), &one);
    }
    let normal = cross(&along, &w);
    root(&dot(&normal, &normal), &squared)
}

/// The distance from a point to the inside of a triangle; `None` if the point is not above it.
fn to_inside(p: Point, t: [Point; 3]) -> Option<f64> {
    let normal = cross(&minus(t[1], t[0]), &minus(t[2], t[0]));
    let squared = dot(&normal, &normal);
    let is_above = (0..3).all(|i| {
        let (from, to) = (t[i], t[(i + 1) % 3]);
        dot(&cross(&minus(to, from), &minus(p, from)), &normal) >= BigInt::ZERO
    });
    let height = dot(&normal, &minus(p, t[0]));
    (is_above && !is_zero(&squared)).then(|| root(&(&height * &height), &squared))
}

/// The distance between the lines of two segments; `None` if it is not attained inside both.
fn between_insides(a: [Point; 2], b: [Point; 2]) -> Option<f64> {
    let (u, v, w) = (minus(a[1], a[0]), minus(b[1], b[0]), minus(b[0], a[0]));
    let normal = cross(&u, &v);
    let squared = dot(&normal, &normal);
    let (s, t) = (dot(&cross(&w, &v), &normal), dot(&cross(&w, &u), &normal));
    let is_inside = |x: &BigInt| *x >= BigInt::ZERO && *x <= squared;
    let height = dot(&normal, &w);
    (!is_zero(&squared) && is_inside(&s) && is_inside(&t))
        .then(|| root(&(&height * &height), &squared))
}

fn of_segments(a: [Point; 2], b: [Point; 2]) -> f64 {
    let ends = a.map(|p| to_segment(p, b)).into_iter().chain(b.map(|p| to_segment(p, a)));
    ends.chain(between_insides(a, b)).fold(f64::INFINITY, f64::min)
}

/// Whether a segment passes through the inside of a triangle.
fn pierces([from, to]: [Point; 2], t: [Point; 3]) -> bool {
    let normal = cross(&minus(t[1], t[0]), &minus(t[2], t[0]));
    let heights = [from, to].map(|p| dot(&normal, &minus(p, t[0])));
    if &heights[0] * &heights[1] >= BigInt::ZERO {
        return false;
    }
    let along = minus(to, from);
    let turns = [0, 1, 2].map(|i| {
        let side = cross(&minus(t[i], from), &minus(t[(i + 1) % 3], from));
        dot(&side, &along)
    });
    turns.iter().all(|x| *x >= BigInt::ZERO) || turns.iter().all(|x| *x <= BigInt::ZERO)
}

fn edges(t: [Point; 3]) -> [[Point; 2]; 3] {
    [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]]
}

fn of_triangles(a: [Point; 3], b: [Point; 3]) -> f64 {
    let meets =
        edges(a).into_iter().any(|e| pierces(e, b)) || edges(b).into_iter().any(|e| pierces(e, a));
    if meets {
        return 0.0;
    }
    let corners =
        a.iter().filter_map(|&p| to_inside(p, b)).chain(b.iter().filter_map(|&p| to_inside(p, a)));
    let pairs = edges(a).into_iter().flat_map(|e| edges(b).map(|f| of_segments(e, f)));
    corners.chain(pairs).fold(f64::INFINITY, f64::min)
}

/// A point with coordinates up to ± 2^bits.
fn point(random: &mut Random, bits: [u32; 3]) -> Point {
    bits.map(|b| random.integer(1 << b))
}

fn any_bits(random: &mut Random) -> u32 {
    random.index(41) as u32
}

fn real(p: Point) -> DVec3 {
    DVec3::from(p.map(|x| x as f64)) * UNIT
}

/// A map that keeps integers: a permutation of the coordinates and a shear by integer multiples.
fn sheared(p: Point, by: [i64; 2]) -> Point {
    let [x, y, z] = p;
    [y + by[0] * x, z + by[1] * x, x]
}

#[test]
fn the_distance_of_segments_nearly_parallel_is_exact_to_some_roundings() {
    let mut random = Random::new(1);
    for case in 0..20_000 {
        let (slope, lift) = (any_bits(&mut random), any_bits(&mut random));
        let by = [random.integer(2), random.integer(2)];
        let long = [40, slope, slope.min(lift)];
        let a = [(); 2].map(|()| sheared(point(&mut random, long), by));
        let up = 1i64 << lift;
        let b = [(); 2].map(|()| {
            let [x, y, z] = point(&mut random, long);
            sheared([x, y, z + up], by)
        });
        let exact = of_segments(a, b);
        let found = segment_segment(a.map(real), b.map(real));
        assert!(
            (found.distance - exact).abs() <= ROUNDING,
            "{case}: {:e} for {exact:e}",
            found.distance
        );
        assert_eq!(found.distance, found.on_a.distance(found.on_b));
    }
}

#[test]
fn the_distance_of_slivers_is_exact_to_some_roundings() {
    let mut random = Random::new(2);
    let mut kinds = [0; 3];
    for case in 0..20_000 {
        let by = [random.integer(2), random.integer(2)];
        let lift = any_bits(&mut random);
        let mut sliver = |up: i64| {
            let shape = [40, any_bits(&mut random).max(4), any_bits(&mut random)];
            [(); 3].map(|()| {
                let [x, y, z] = point(&mut random, shape);
                sheared([x, y, z + up], by)
            })
        };
        let (a, b) = (sliver(0), sliver(1 << lift));
        let exact = of_triangles(a, b);
        let found = triangle_triangle(&a.map(real), &b.map(real));
        assert!(
            (found.distance - exact).abs() <= ROUNDING,
            "{case}: {:e} for {exact:e}",
            found.distance
        );
        kinds[if exact == 0.0 {
            0
        } else if exact < 1e-6 {
            1
        } else {
            2
        }] += 1;
    }
    assert!(kinds.iter().all(|&n| n > 300), "{kinds:?}");
}

#[test]
fn the_exact_distance_knows_known_distances() {
    let one = 1i64 << 40;
    let a = [[0, 0, 0], [one, 0, 0], [0, one, 0]];
    let over = a.map(|[x, y, _]| [x / 4 + 1, y / 4 + 1, 3]);
    assert_eq!(of_triangles(a, over), 3.0 * UNIT);
    let through = [[9, 9, -one], [9, 9, one], [one, one, 0]];
    assert_eq!(of_triangles(a, through), 0.0);
    let beside = a.map(|[x, y, z]| [x + 2 * one, y, z]);
    assert_eq!(of_triangles(a, beside), 1.0);
    let crossing = [[one / 2, -one, 7], [one / 2, one, 7]];
    assert_eq!(of_segments([[0, 0, 0], [one, 0, 0]], crossing), 7.0 * UNIT);
}
