//! Whether two moving features ever meet, decided without rounding.
//!
//! All coordinates are f64, which are integers after multiplication by a power of two, and linear in t. A feature pair
//! meets at t if the signs of some polynomials at t say so (see [`Query::clauses`]). That set of instants is closed; if
//! it is not empty, its first instant in [0, 1] is 0 or a root of one of the polynomials that are not identically zero.
//! So it is enough to examine 0, 1 and those roots; if the features are not coplanar throughout, the roots of the
//! coplanarity polynomial suffice.

use std::cmp::Ordering;

use glam::DVec3;
use num_bigint::BigInt;

use super::polynomial::{Dyadic, Number, Polynomial};

/// A point on a straight path: its positions at t = 0 and at t = 1.
pub(crate) type Path = [DVec3; 2];

/// A pair of moving features.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Query {
    /// A vertex and a facet.
    VertexFacet(Path, [Path; 3]),
    /// Two edges.
    EdgeEdge([Path; 2], [Path; 2]),
}

/// A point whose coordinates are polynomials in t.
type Point = [Polynomial; 3];

fn minus(a: &Point, b: &Point) -> Point {
    [0, 1, 2].map(|i| a[i].minus(&b[i]))
}

fn dot(a: &Point, b: &Point) -> Polynomial {
    let [x, y, z] = [0, 1, 2].map(|i| a[i].times(&b[i]));
    x.plus(&y).plus(&z)
}

fn cross(a: &Point, b: &Point) -> Point {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| a[i].times(&b[j]).minus(&a[j].times(&b[i])))
}

/// m and e with `number` = m 2^e, m odd or 0.
fn parts(number: f64) -> (i64, i32) {
    let bits = number.to_bits();
    let exponent = ((bits >> 52) & 0x7ff) as i32;
    let fraction = (bits & ((1 << 52) - 1)).cast_signed();
    let (mantissa, exponent) = match exponent {
        0 => (fraction, -1074),
        _ => (fraction | (1 << 52), exponent - 1075),
    };
    if mantissa == 0 {
        return (0, i32::MAX);
    }
    let zeros = mantissa.trailing_zeros();
    let signed = if number < 0.0 { -mantissa } else { mantissa };
    (signed >> zeros, exponent + zeros.cast_signed())
}

/// The smallest exponent of finite numbers, by which all become integers.
fn least_exponent(numbers: impl Iterator<Item = f64>) -> i32 {
    numbers.map(|x| parts(x).1).min().unwrap_or(i32::MAX)
}

/// `number` / 2^`unit`, an integer by choice of `unit`.
fn whole(number: f64, unit: i32) -> BigInt {
    let (mantissa, exponent) = parts(number);
    match mantissa {
        0 => BigInt::default(),
        _ => BigInt::from(mantissa) << (exponent - unit),
    }
}

/// The paths as points of linear polynomials, all multiplied by the same power of two.
fn exact<const N: usize>(paths: [Path; N]) -> [Point; N] {
    let numbers = paths.iter().flatten().flat_map(DVec3::to_array);
    let unit = least_exponent(numbers);
    paths.map(|[p0, p1]| {
        [0, 1, 2].map(|i| {
            let start = whole(p0[i], unit);
            let step = whole(p1[i], unit) - &start;
            Polynomial::new(vec![start, step])
        })
    })
}

/// The sign that a polynomial must have.
#[derive(Debug, Clone, Copy)]
enum Wanted {
    Zero,
    Positive,
    NotNegative,
}

impl Wanted {
    fn admits(self, sign: Ordering) -> bool {
        match self {
            Self::Zero => sign == Ordering::Equal,
            Self::Positive => sign == Ordering::Greater,
            Self::NotNegative => sign != Ordering::Less,
        }
    }
}

/// Conditions that must hold together.
type Clause = Vec<(Polynomial, Wanted)>;

/// The origin lies on the segment from x to y: x × y = 0 and −x·y ≥ 0.
fn holds_origin(x: &Point, y: &Point) -> Clause {
    let components = cross(x, y).map(|c| (c, Wanted::Zero));
    let opposite = Polynomial::new(Vec::new()).minus(&dot(x, y));
    let mut clause = vec![(opposite, Wanted::NotNegative)];
    clause.extend(components);
    clause
}

impl Query {
    /// The coplanarity polynomial, and the clauses one of which must hold if it vanishes.
    fn clauses(&self) -> (Polynomial, Vec<Clause>) {
        match *self {
            Self::VertexFacet(vertex, [a, b, c]) => {
                let [p, a, b, c] = exact([vertex, a, b, c]);
                vertex_in_facet(&minus(&a, &p), &minus(&b, &p), &minus(&c, &p))
            }
            Self::EdgeEdge([a0, a1], [b0, b1]) => edges_cross(&exact([a0, a1, b0, b1])),
        }
    }

    /// Whether the features share a point at some t in [0, 1].
    pub(crate) fn meets(&self) -> bool {
        if self.is_apart_along_a_coordinate() {
            return false;
        }
        let (coplanar, clauses) = self.clauses();
        let holds = |number: &Number| {
            let holds = |(p, wanted): &(Polynomial, Wanted)| wanted.admits(p.sign_at(number));
            clauses.iter().any(|clause| clause.iter().all(holds))
        };
        let ends = [0, 1].map(|end| Number::Dyadic(Dyadic::new(end, 0)));
        let is_coplanar = |number: &&Number| coplanar.sign_at(number) == Ordering::Equal;
        if ends.iter().filter(is_coplanar).any(holds) {
            return true;
        }
        if !coplanar.is_zero() {
            return coplanar.roots_inside().iter().any(holds);
        }
        let polynomials = clauses.iter().flatten().map(|(p, _)| p);
        polynomials.flat_map(Polynomial::roots_inside).any(|t| holds(&t))
    }

    /// Compares given numbers only: if one feature is below the other at both ends, it is so throughout.
    fn is_apart_along_a_coordinate(&self) -> bool {
        let (a, b): (&[Path], &[Path]) = match self {
            Self::VertexFacet(vertex, facet) => (&[*vertex], facet),
            Self::EdgeEdge(a, b) => (a, b),
        };
        let is_below = |a: &[Path], b: &[Path], axis: usize| {
            (0..2).all(|end| a.iter().all(|p| b.iter().all(|q| p[end][axis] < q[end][axis])))
        };
        (0..3).any(|axis| is_below(a, b, axis) || is_below(b, a, axis))
    }
}

/// The origin in the triangle x, y, z: with n = x × y + y × z + z × x ≠ 0 it lies in its plane and on the inner side of
/// each edge; otherwise, and on the rim, it lies on an edge.
fn vertex_in_facet(x: &Point, y: &Point, z: &Point) -> (Polynomial, Vec<Clause>) {
    let sides = [cross(x, y), cross(y, z), cross(z, x)];
    let normal = cross(&minus(y, x), &minus(z, x));
    let mut inside = vec![(dot(&normal, &normal), Wanted::Positive)];
    inside.extend(sides.iter().map(|s| (dot(s, &normal), Wanted::NotNegative)));
    let clauses = vec![inside, holds_origin(x, y), holds_origin(y, z), holds_origin(z, x)];
    (dot(x, &sides[1]), clauses)
}

/// With u, v along the edges, w from the start of a to that of b and n = u × v ≠ 0, the coplanar edges cross where
/// s = (w × v)·n / n² and r = (w × u)·n / n² lie in [0, 1]; otherwise an end of one lies on the other.
fn edges_cross([a0, a1, b0, b1]: &[Point; 4]) -> (Polynomial, Vec<Clause>) {
    let (u, v, w) = (minus(a1, a0), minus(b1, b0), minus(b0, a0));
    let normal = cross(&u, &v);
    let squared = dot(&normal, &normal);
    let mut inside = vec![(squared.clone(), Wanted::Positive)];
    for along in [&v, &u] {
        let place = dot(&cross(&w, along), &normal);
        inside.push((squared.minus(&place), Wanted::NotNegative));
        inside.push((place, Wanted::NotNegative));
    }
    let on = |p: &Point, q0: &Point, q1: &Point| holds_origin(&minus(q0, p), &minus(q1, p));
    let clauses = vec![inside, on(a0, b0, b1), on(a1, b0, b1), on(b0, a0, a1), on(b1, a0, a1)];
    (dot(&w, &normal), clauses)
}

/// Whether two triangles at t = `eighths` / 8 overlap by more than `tolerance` along every normal of a facet or of two
/// edges, so that their depth exceeds it.
///
/// Along a normal n that is not normalised, the overlap o exceeds it if o > 0 and o² > τ² n². Triangles whose normals
/// all vanish, and coplanar ones, are never deep.
pub(crate) fn are_deeper_than(tolerance: f64, a: &[Path; 3], b: &[Path; 3], eighths: i32) -> bool {
    let corners = a.iter().chain(b).flatten().flat_map(DVec3::to_array);
    let unit = least_exponent(corners.chain([tolerance]));
    // Eight times the coordinates, so that they are integers.
    let exact = |[p0, p1]: &Path| {
        [0, 1, 2].map(|i| whole(p0[i], unit) * (8 - eighths) + whole(p1[i], unit) * eighths)
    };
    let (a, b) = (a.each_ref().map(exact), b.each_ref().map(exact));
    let tau = whole(tolerance, unit) * 8;
    let minus = |p: &[BigInt; 3], q: &[BigInt; 3]| [0, 1, 2].map(|i| &p[i] - &q[i]);
    let cross = |p: &[BigInt; 3], q: &[BigInt; 3]| {
        [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &p[i] * &q[j] - &p[j] * &q[i])
    };
    let dot = |p: &[BigInt; 3], q: &[BigInt; 3]| -> BigInt { (0..3).map(|i| &p[i] * &q[i]).sum() };
    let edges = |t: &[[BigInt; 3]; 3]| [0, 1, 2].map(|i| minus(&t[(i + 1) % 3], &t[i]));
    let (of_a, of_b) = (edges(&a), edges(&b));
    let mut normals = vec![cross(&of_a[0], &of_a[1]), cross(&of_b[0], &of_b[1])];
    normals.extend(of_a.iter().flat_map(|e| of_b.iter().map(|f| cross(e, f))));
    normals.retain(|n| n.iter().any(|x| *x != BigInt::default()));
    let is_deep = |n: &[BigInt; 3]| {
        let heights = |t: &[[BigInt; 3]; 3]| t.each_ref().map(|p| dot(p, n));
        let ([a0, a1, a2], [b0, b1, b2]) = (heights(&a), heights(&b));
        let (high_a, low_a) = ((&a0).max(&a1).max(&a2), (&a0).min(&a1).min(&a2));
        let (high_b, low_b) = ((&b0).max(&b1).max(&b2), (&b0).min(&b1).min(&b2));
        let overlap = (high_a - low_b).min(high_b - low_a);
        overlap > BigInt::default() && &overlap * &overlap > &tau * &tau * dot(n, n)
    };
    !normals.is_empty() && normals.iter().all(is_deep)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn still(x: f64, y: f64, z: f64) -> Path {
        [DVec3::new(x, y, z); 2]
    }

    fn path(from: [f64; 3], to: [f64; 3]) -> Path {
        [from.into(), to.into()]
    }

    fn plate() -> [Path; 3] {
        [still(0.0, 0.0, 0.0), still(4.0, 0.0, 0.0), still(0.0, 4.0, 0.0)]
    }

    fn vertex_meets(from: [f64; 3], to: [f64; 3]) -> bool {
        Query::VertexFacet(path(from, to), plate()).meets()
    }

    const ULP: f64 = f64::EPSILON;

    #[test]
    fn a_vertex_meets_a_plate_it_goes_through_or_reaches_and_no_other() {
        assert!(vertex_meets([1.0, 1.0, 1.0], [1.0, 1.0, -3.0]));
        assert!(vertex_meets([1.0, 1.0, 1.0], [1.0, 1.0, 0.0]));
        assert!(!vertex_meets([1.0, 1.0, 1.0], [1.0, 1.0, 5e-324]));
        assert!(vertex_meets([2.0, 2.0, 1.0], [2.0, 2.0, -1.0]), "on the rim");
        assert!(!vertex_meets([2.0, 2.0 + 2.0 * ULP, 1.0], [2.0, 2.0, -1.0]));
        assert!(vertex_meets([2.0, 2.0 - 2.0 * ULP, 1.0], [2.0, 2.0, -1.0]));
        assert!(vertex_meets([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]), "at a corner");
        assert!(!vertex_meets([-ULP, 0.0, 1.0], [0.0, 0.0, -1.0]));
    }

    #[test]
    fn a_vertex_in_the_plane_meets_the_plate_where_its_path_crosses_it() {
        assert!(vertex_meets([-1.0, 1.0, 0.0], [9.0, 1.0, 0.0]));
        assert!(!vertex_meets([-1.0, 1.0, 0.0], [-0.5, 3.0, 0.0]));
        assert!(vertex_meets([5.0, -1.0, 0.0], [3.0, 1.0, 0.0]), "along the rim");
        assert!(!vertex_meets([5.0 + 4.0 * ULP, -1.0, 0.0], [3.0 + 4.0 * ULP, 1.0, 0.0]));
        assert!(vertex_meets([-1.0, -1.0, 0.0], [1.0, 1.0, 0.0]), "through a corner");
        assert!(!vertex_meets([-1.0, 1.0, 0.0], [1.0, -1.0 - ULP, 0.0]));
        assert!(vertex_meets([-1.0, 1.0, 0.0], [1.0, -1.0, 0.0]), "grazes a corner");
    }

    #[test]
    fn a_facet_without_area_is_treated_as_its_edges() {
        let needle = [still(0.0, 0.0, 0.0), still(2.0, 2.0, 0.0), still(1.0, 1.0, 0.0)];
        let through = |x: f64| Query::VertexFacet(path([x, 1.5, 1.0], [x, 1.5, -1.0]), needle);
        assert!(through(1.5).meets() && !through(1.5 + ULP).meets());
        let point = [still(1.5, 1.5, 0.0); 3];
        let at = |x: f64| Query::VertexFacet(path([x, 1.5, 1.0], [x, 1.5, -2.0]), point);
        assert!(at(1.5).meets() && !at(1.5 + ULP).meets());
    }

    #[test]
    fn edges_meet_where_they_cross_touch_or_overlap() {
        let a = [still(-1.0, 0.0, 0.0), still(1.0, 0.0, 0.0)];
        let falls = |x: f64, y0: f64, y1: f64, z1: f64| {
            let end = |y: f64| path([x, y, 1.0], [x, y, z1]);
            Query::EdgeEdge(a, [end(y0), end(y1)]).meets()
        };
        assert!(falls(0.3, -1.0, 1.0, -1.0));
        assert!(falls(1.0, 0.0, 1.0, 0.0), "end on end");
        assert!(!falls(1.0 + ULP, 0.0, 1.0, 0.0));
        assert!(!falls(0.3, 5e-324, 1.0, -1.0));
        let slides = |x0: f64, y: f64| {
            let from = path([x0, y, 0.0], [x0 + 1.0, y, 0.0]);
            let to = path([x0 + 1.0, y, 0.0], [x0 + 2.0, y, 0.0]);
            Query::EdgeEdge(a, [from, to]).meets()
        };
        assert!(slides(-3.0, 0.0) && !slides(-3.0 - 4.0 * ULP, 0.0) && !slides(-0.5, 5e-324));
        let point = |x: f64| Query::EdgeEdge(a, [still(x, 0.0, 0.0); 2]).meets();
        assert!(point(1.0) && !point(1.0 + ULP));
    }

    #[test]
    fn a_vertex_that_touches_a_tilting_facet_and_goes_back_meets_it() {
        // Height over the plane through the y axis of slope k (t − t*): −k s (t − t*)², and an ulp more or less.
        let (at, k, s, x) = (0.375, 2.0, 0.5, 0.25);
        let tilt = |t: f64| DVec3::new(1.0, 0.0, k * (t - at));
        let facet = [still(0.0, -1.0, 0.0), still(0.0, 1.0, 0.0), [tilt(0.0), tilt(1.0)]];
        let vertex = |lift: f64| {
            [0.0, 1.0].map(|t| DVec3::new(x + s * (t - at), 0.0, k * x * (t - at) + lift))
        };
        assert!(Query::VertexFacet(vertex(0.0), facet).meets());
        assert!(Query::VertexFacet(vertex(0.25 * ULP), facet).meets());
        assert!(!Query::VertexFacet(vertex(-0.25 * ULP), facet).meets());
    }

    #[test]
    fn depth_is_exact_to_the_last_bit() {
        let plate = [still(-9.0, -9.0, 0.0), still(9.0, -9.0, 0.0), still(0.0, 9.0, 0.0)];
        let tip = |depth: f64| {
            let falls = path([0.0, 0.0, depth], [0.0, 0.0, -3.0 * depth]);
            [falls, still(0.1, 0.0, 1.0), still(0.0, 0.1, 1.0)]
        };
        let is_deep = |depth: f64, eighths| are_deeper_than(0.125, &plate, &tip(depth), eighths);
        assert!(is_deep(0.125 + ULP, 4), "half way it is deeper by its own depth");
        assert!(!is_deep(0.125, 4) && is_deep(0.125, 5) && !is_deep(0.125, 0));
        assert!(!are_deeper_than(0.125, &plate, &plate, 4), "coplanar");
    }
}
