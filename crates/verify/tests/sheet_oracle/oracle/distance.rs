//! The smallest distance of two polygons while one moves straight, in f64 (Gilbert, Johnson and Keerthi 1988).

use glam::DVec3;

use super::exact::{Convex, Point, UNIT};

pub(crate) fn to_f64(p: Point) -> DVec3 {
    let [x, y, z] = p.map(|c| c as f64 / UNIT as f64);
    DVec3::new(x, y, z)
}

/// The corner farthest along a direction.
fn farthest(corners: &[DVec3], direction: DVec3) -> DVec3 {
    let ahead = |a: &&DVec3, b: &&DVec3| a.dot(direction).total_cmp(&b.dot(direction));
    corners.iter().max_by(ahead).copied().unwrap_or_default()
}

/// The smallest distance of the convex hulls of `a` and of `b`, displaced by anything in the hull of `path`.
pub(crate) fn distance(a: &[DVec3], b: &[DVec3], path: &[DVec3]) -> f64 {
    let support = |d: DVec3| farthest(a, d) - farthest(b, -d) - farthest(path, -d);
    let mut simplex = vec![support(DVec3::X)];
    let mut nearest = simplex[0];
    for _ in 0..200 {
        let length = nearest.length_squared();
        if length < 1e-26 {
            return 0.0;
        }
        let next = support(-nearest);
        if length - nearest.dot(next) <= 1e-12 * length + 1e-24 || simplex.contains(&next) {
            break;
        }
        simplex.push(next);
        (nearest, simplex) = nearest_to_origin(&simplex);
        if simplex.len() == 4 {
            return 0.0;
        }
    }
    nearest.length()
}

/// The smallest distance of two polygons, one displaced from `from` straight to `to`.
pub(crate) fn swept_distance(a: &Convex, b: &Convex, from: Point, to: Point) -> f64 {
    let all = |corners: &[Point]| -> Vec<DVec3> { corners.iter().map(|&p| to_f64(p)).collect() };
    distance(&all(&a.corners), &all(&b.corners), &all(&[from, to]))
}

/// The point of a simplex nearest to the origin, and the corners it lies between.
fn nearest_to_origin(simplex: &[DVec3]) -> (DVec3, Vec<DVec3>) {
    let mut best = (DVec3::INFINITY, Vec::new());
    for subset in 1_u32..1 << simplex.len() {
        let corners: Vec<DVec3> =
            (0..simplex.len()).filter(|i| subset & (1 << i) != 0).map(|i| simplex[i]).collect();
        if let Some(point) = foot(&corners)
            && point.length_squared() < best.0.length_squared()
        {
            best = (point, corners);
        }
    }
    best
}

/// The foot of the origin on the hull of affinely independent points; `None` if it is not strictly inside.
fn foot(corners: &[DVec3]) -> Option<DVec3> {
    let inside = |weights: &[f64]| weights.iter().all(|&w| w > 0.0);
    let (a, rest) = corners.split_first()?;
    let d: Vec<DVec3> = rest.iter().map(|p| *p - *a).collect();
    match *d.as_slice() {
        [] => Some(*a),
        [e] => {
            let t = -a.dot(e) / e.length_squared();
            inside(&[t, 1.0 - t]).then(|| *a + e * t)
        }
        [e, f] => {
            let n = e.cross(f);
            let square = n.length_squared();
            let s = -a.cross(f).dot(n) / square;
            let t = -e.cross(*a).dot(n) / square;
            (square > 0.0 && inside(&[s, t, 1.0 - s - t])).then(|| n * (a.dot(n) / square))
        }
        [e, f, g] => {
            let volume = e.cross(f).dot(g);
            let s = -a.dot(f.cross(g)) / volume;
            let t = -a.dot(g.cross(e)) / volume;
            let u = -a.dot(e.cross(f)) / volume;
            (volume != 0.0 && inside(&[s, t, u, 1.0 - s - t - u])).then_some(DVec3::ZERO)
        }
        _ => None,
    }
}
