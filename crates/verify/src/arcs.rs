//! Which directions of D = { d : max d·a − min d·b ≤ τ } are connected in D, exactly.
//!
//! The overlap h(d) = max d·a − min d·b is the support function of the convex polytope K = { a − b }. On the cone of
//! directions for which one corner of K is the highest, h is the height of that corner. Its local minima on the sphere
//! are the normals of facets of K, and two of them are connected at the level at which a path along the edges of K
//! connects them: an edge of K is an arc between the normals of its two facets. The set of all possible facet normals,
//! with all arcs between them, contains these paths and consists of paths itself, so it gives the same level; that also
//! holds if K is flat.

use glam::DVec3;

use crate::moving_pair::{COORDINATES, PairPose};

/// Cross products shorter than this share of the product of their factors have no direction.
const PARALLEL: f64 = 1e-12;
/// Directions whose cosine is below this have no unique arc between them.
const OPPOSITE: f64 = -0.999_999;

fn differences(pose: &PairPose) -> impl Iterator<Item = DVec3> {
    let PairPose { a, b } = *pose;
    (0..9).map(move |k| a[k / 3] - b[k % 3])
}

/// The largest overlap on the arc from u to v, two unit directions that are not opposite.
///
/// The height of a corner along the arc is x cos φ + y sin φ: it is largest at an end, or equals hypot(x, y) if it
/// rises at one end and falls at the other.
pub(crate) fn highest(pose: &PairPose, u: DVec3, v: DVec3) -> f64 {
    let cosine = u.dot(v);
    let across = v - u * cosine;
    let sine = across.length();
    if sine < 1e-15 {
        return pose.overlap(u).max(pose.overlap(v));
    }
    let across = across / sine;
    let heights = differences(pose).map(|corner| {
        let (x, y) = (corner.dot(u), corner.dot(across));
        if y > 0.0 && y * cosine < x * sine { x.hypot(y) } else { x.max(corner.dot(v)) }
    });
    heights.fold(f64::NEG_INFINITY, f64::max)
}

pub(crate) fn is_arc_within(pose: &PairPose, u: DVec3, v: DVec3, limit: f64) -> bool {
    u.dot(v) > OPPOSITE && highest(pose, u, v) <= limit
}

/// The point at which the descent from a direction leaves the cone of its corner of K and reaches an edge of K.
fn foot(pose: &PairPose, from: DVec3) -> Option<DVec3> {
    let top = differences(pose).max_by(|p, q| p.dot(from).total_cmp(&q.dot(from)))?;
    let down = (from * top.dot(from) - top).try_normalize()?;
    let leaves = differences(pose).filter_map(|corner| {
        let over = corner - top;
        let (x, y) = (over.dot(from), over.dot(down));
        (y > 0.0).then(|| (-x).max(0.0).atan2(y))
    });
    let first = leaves.fold(f64::INFINITY, f64::min);
    let angle = first.min(std::f64::consts::FRAC_PI_2);
    (from * angle.cos() + down * angle.sin()).try_normalize()
}

/// The possible normals of facets of K, and those in their planes, in both senses. Triangles may be edges or points.
pub(crate) fn normals(pose: &PairPose) -> Vec<DVec3> {
    let sides = |t: &[DVec3; 3]| [t[1] - t[0], t[2] - t[1], t[0] - t[2]];
    let (a, b) = (sides(&pose.a), sides(&pose.b));
    let mut normals = Vec::with_capacity(74);
    let mut push = |u: DVec3, v: DVec3| {
        let n = u.cross(v);
        let length = n.length();
        let has_direction = length > PARALLEL * u.length() * v.length();
        let unit = has_direction.then(|| n / length);
        normals.extend(unit.into_iter().flat_map(|n| [n, -n]));
        unit
    };
    let normal_a = push(a[0], a[1]);
    let normal_b = push(b[0], b[1]);
    let mut between = None;
    for u in a {
        for v in b {
            between = push(u, v).or(between);
        }
    }
    let is_flat = normal_a.is_none() && normal_b.is_none();
    let planes = [normal_a, normal_b, between.filter(|_| is_flat)];
    for n in planes.into_iter().flatten() {
        for side in a.into_iter().chain(b) {
            push(n, side);
        }
    }
    // If everything lies near a line, cross products of sides are inaccurate.
    let longest = a.into_iter().chain(b);
    let longest = longest.max_by(|u, v| u.length_squared().total_cmp(&v.length_squared()));
    for (side, axis) in longest.into_iter().flat_map(|u| COORDINATES.map(|v| (u, v))) {
        push(side, axis);
    }
    normals
}

/// The depth: the smallest overlap over all directions, if it is positive.
pub(crate) fn depth(pose: &PairPose) -> f64 {
    let overlaps = normals(pose).into_iter().map(|n| pose.overlap(n));
    overlaps.fold(f64::INFINITY, f64::min)
}

/// Which nodes are connected to a seed at a level; nodes above the level are not.
pub(crate) fn reached(pose: &PairPose, nodes: &[DVec3], seeds: &[DVec3], level: f64) -> Vec<bool> {
    let mut is_reached = vec![false; nodes.len()];
    let is_low: Vec<bool> = nodes.iter().map(|&n| pose.overlap(n) <= level).collect();
    let mut from: Vec<DVec3> = seeds.to_vec();
    from.extend(seeds.iter().filter_map(|&seed| {
        foot(pose, seed).filter(|&foot| is_arc_within(pose, seed, foot, level))
    }));
    while let Some(direction) = from.pop() {
        for k in 0..nodes.len() {
            if is_low[k] && !is_reached[k] && is_arc_within(pose, direction, nodes[k], level) {
                is_reached[k] = true;
                from.push(nodes[k]);
            }
        }
    }
    is_reached
}

/// Whether some direction of `from` is connected to some direction of `to` at a level.
pub(crate) fn are_connected(pose: &PairPose, from: &[DVec3], to: &[DVec3], level: f64) -> bool {
    let is_direct = |u: &DVec3| to.iter().any(|&v| is_arc_within(pose, *u, v, level));
    if from.iter().any(is_direct) {
        return true;
    }
    let mut nodes = normals(pose);
    let facets = nodes.len();
    nodes.extend(to);
    nodes.extend(
        to.iter()
            .filter_map(|&v| foot(pose, v).filter(|&foot| is_arc_within(pose, v, foot, level))),
    );
    reached(pose, &nodes, from, level)[facets..].contains(&true)
}

#[cfg(test)]
mod tests {
    use super::*;
    use foldmotion_random::Random;

    fn pose(random: &mut Random) -> PairPose {
        let mut triangle = || [(); 3].map(|()| random.vector());
        PairPose { a: triangle(), b: triangle() }
    }

    #[test]
    fn the_highest_overlap_of_an_arc_is_what_dense_samples_show() {
        let mut random = Random::new(31);
        for _ in 0..300 {
            let pose = pose(&mut random);
            let [u, v] = [(); 2].map(|()| random.vector().normalize());
            let sampled = (0..=4000).map(|k| {
                let d = u.lerp(v, f64::from(k) / 4000.0).normalize();
                pose.overlap(d)
            });
            let sampled = sampled.fold(f64::NEG_INFINITY, f64::max);
            let highest = highest(&pose, u, v);
            assert!((highest - sampled).abs() < 1e-5, "{highest} {sampled}");
        }
    }

    /// Whether `to` is connected to `from` at a level by short steps between directions that cover the sphere.
    fn flooded(pose: &PairPose, from: DVec3, to: DVec3, level: f64) -> bool {
        let count = 6000;
        let turn = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
        let all: Vec<DVec3> = (0..count)
            .map(|k| {
                let z = 1.0 - (2.0 * f64::from(k) + 1.0) / f64::from(count);
                let (sin, cos) = (turn * f64::from(k)).sin_cos();
                let r = (1.0 - z * z).sqrt();
                DVec3::new(r * cos, r * sin, z)
            })
            .chain([to])
            .filter(|&d| pose.overlap(d) <= level)
            .collect();
        let mut open = vec![from];
        let mut seen = vec![false; all.len()];
        while let Some(d) = open.pop() {
            for k in 0..all.len() {
                if !seen[k] && all[k].dot(d) > 0.998 {
                    seen[k] = true;
                    open.push(all[k]);
                }
            }
        }
        seen.last() == Some(&true)
    }

    #[test]
    fn two_directions_are_connected_where_a_flood_over_the_sphere_connects_them() {
        let mut random = Random::new(32);
        let mut counts = [0; 2];
        for k in 0..360 {
            let mut pose = pose(&mut random);
            pose.b = pose.b.map(|p| p * 0.3);
            if k % 2 == 0 {
                pose.b[2] = pose.b[1];
            }
            let mut low = normals(&pose);
            low.sort_by(|p, q| pose.overlap(*p).total_cmp(&pose.overlap(*q)));
            let u = low[0];
            let beyond = low.iter().find(|d| d.dot(u) < -0.5);
            let v = if k % 3 == 0 { low[4] } else { *beyond.unwrap() };
            let level = pose.overlap(v).max(0.0) + 0.12;
            let is_connected = are_connected(&pose, &[u], &[v], level);
            counts[usize::from(is_connected)] += 1;
            let slack = if is_connected { 0.1 } else { -0.11 };
            assert_eq!(flooded(&pose, u, v, level + slack), is_connected, "{k}");
        }
        assert!(counts.iter().all(|&n| n > 10), "{counts:?}");
    }

    #[test]
    fn an_edge_within_a_triangle_leaves_two_sides_and_one_off_it_leaves_one() {
        let a = [DVec3::ZERO, DVec3::X * 4.0, DVec3::Y * 4.0];
        let edge = |z: f64| {
            let p = DVec3::new(1.0, 1.0, z);
            [p, p + DVec3::X * 0.5, p + DVec3::X * 0.5]
        };
        let both = |pose: &PairPose| are_connected(pose, &[DVec3::Z], &[-DVec3::Z], 1e-3);
        assert!(!both(&PairPose { a, b: edge(0.0) }));
        let off = edge(0.0).map(|p| p - DVec3::X * 1.9);
        assert!(both(&PairPose { a, b: off }));
    }
}
