//! The bounds of the closest approach compared with dense sampling.

use glam::{DQuat, DVec3};

use foldmotion_geometry::collide::{Limits, MovingPair, PairPose, accuracy, closest_approach};
use foldmotion_geometry::triangle_triangle;

use foldmotion_random::Random;

const LIMITS: Limits = Limits { tolerance: 1e-6, margin: 1e-14, budget: 20_000 };

type Corners = [DVec3; 3];

fn pair(start: [Corners; 2], end: [Corners; 2]) -> MovingPair {
    let pose = |[a, b]: [Corners; 2]| PairPose { a, b, shared: 0 };
    MovingPair::new(pose(start), pose(end))
}

/// The greatest speed of a point of A relative to one of B.
fn speed(pair: &MovingPair) -> f64 {
    let moves = |p: &Corners, q: &Corners| [0, 1, 2].map(|i| q[i] - p[i]);
    let (a, b) = (moves(&pair.start.a, &pair.end.a), moves(&pair.start.b, &pair.end.b));
    let speeds = a.iter().flat_map(|u| b.iter().map(move |v| u.distance(*v)));
    speeds.fold(0.0, f64::max)
}

/// The smallest distance at many instants, and at many near the smallest.
fn sampled(pair: &MovingPair) -> f64 {
    let distance = |t: f64| {
        let pose = pair.at(t);
        triangle_triangle(&pose.a, &pose.b).distance
    };
    let (mut from, mut to, mut least) = (0.0, 1.0, f64::INFINITY);
    for _ in 0..8 {
        let at = |k: u32| from + (to - from) * f64::from(k) / 400.0;
        let (k, found) = (0..=400)
            .map(|k| (k, distance(at(k))))
            .reduce(|p, q| if q.1 < p.1 { q } else { p })
            .unwrap();
        least = least.min(found);
        (from, to) = (at(k.saturating_sub(2)), at((k + 2).min(400)));
    }
    least
}

/// Checks the bounds against dense sampling and returns the distance.
fn hold(pair: &MovingPair, case: &str) -> f64 {
    let found = closest_approach(pair, f64::INFINITY, &LIMITS);
    let least = sampled(pair);
    let attained = found.nearest.unwrap().closest.distance;
    assert!(found.is_complete, "{case}: {found:?}, sampled {least:e}");
    assert!(found.at_least <= least, "{case}: {found:?} above {least:e}");
    assert!(found.at_least <= attained, "{case}: {found:?}");
    let allowed = accuracy(attained, &LIMITS);
    assert!(attained <= found.at_least + allowed, "{case}: {found:?}");
    // The distance changes by at most half a step of the samples times the speed.
    let slack = speed(pair) / 800.0 + allowed;
    assert!(found.at_least >= least - slack, "{case}: {found:?} far below {least:e}");
    let there = pair.at(found.nearest.unwrap().time);
    assert_eq!(triangle_triangle(&there.a, &there.b).distance, attained, "{case}");
    attained
}

fn turned(random: &mut Random) -> impl Fn(DVec3) -> DVec3 + use<> {
    let axis = random.vector().normalize();
    let turn = DQuat::from_axis_angle(axis, 3.0 * random.number());
    let shift = random.vector();
    move |p| turn * p + shift
}

#[test]
fn the_bounds_of_random_pairs_hold_what_dense_sampling_finds() {
    let mut random = Random::new(41);
    for case in 0..80 {
        let mut both = || [random.triangle(1.0), random.triangle(1.0).map(|p| p + DVec3::X * 1.5)];
        hold(&pair(both(), both()), &format!("random {case}"));
    }
}

#[test]
fn the_bounds_of_slivers_hold_what_dense_sampling_finds() {
    let mut random = Random::new(42);
    let mut apart = 0;
    for case in 0..120 {
        let thin = 10f64.powi(-(1 + case % 9));
        let place = turned(&mut random);
        let lift = DVec3::Z * 0.3 * 10f64.powi(-(case % 5));
        let mut both = || {
            let mut sliver = || random.triangle(1.0).map(|p| p * DVec3::new(1.0, thin, 0.1));
            [sliver().map(&place), sliver().map(|p| place(p + lift))]
        };
        let distance = hold(&pair(both(), both()), &format!("sliver {case}"));
        apart += usize::from(distance > 1e-6);
    }
    assert!(apart > 20, "{apart}");
}

#[test]
fn the_bounds_of_edges_nearly_parallel_hold_what_dense_sampling_finds() {
    let mut random = Random::new(43);
    for case in 0..120 {
        let angle = 10f64.powi(-(1 + case % 10));
        let gap = 10f64.powi(-(case % 8));
        let place = turned(&mut random);
        let edge_a = [DVec3::ZERO, DVec3::X];
        let edge_b = [DVec3::new(0.1, 0.0, 0.0), DVec3::new(0.9, angle, 0.0)];
        let mut both = || {
            let slip = random.vector() * angle * DVec3::new(1.0, 1.0, 0.0);
            let (up, down) = (random.number(), random.number());
            let a = [edge_a[0], edge_a[1], DVec3::new(0.5, up, -1.0)];
            let b = [edge_b[0], edge_b[1], DVec3::new(0.5, down, 1.0)];
            [a.map(&place), b.map(|p| place(p + slip + DVec3::Z * gap))]
        };
        let distance = hold(&pair(both(), both()), &format!("parallel {case}"));
        assert!(distance < 1.5 * gap + 4.0 * angle, "{case}: {distance:e}");
    }
}

#[test]
fn the_bounds_hold_where_a_corner_passes_an_edge_next_to_its_end() {
    let mut random = Random::new(44);
    for case in 0..150 {
        let gap = 3e-5 * 10f64.powi(-(case % 7)) * (2.0 + random.number());
        let below = 1e-9 * 10f64.powi(-(case % 5));
        let place = turned(&mut random);
        let a = |y: f64| {
            let corners = [[-gap, y, 0.0], [-0.17, 1.0 + y, 0.0], [-0.2, 1.43 + y, -0.385]];
            corners.map(|p| place(DVec3::from(p)))
        };
        let b = [[0.0, 0.0, -below], [0.0, 0.0, 0.67], [0.0064, -0.63, 0.55]];
        let b = b.map(|p| place(DVec3::from(p)));
        let distance = hold(&pair([a(0.04), b], [a(-0.0024), b]), &format!("passing {case}"));
        assert!(distance <= gap + accuracy(gap, &LIMITS), "{case}: {distance:e} {gap:e}");
    }
}

#[test]
fn a_pair_farther_than_the_bound_is_left_out() {
    let a = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let b = a.map(|p| p + DVec3::Z);
    let still = pair([a, b], [a, b]);
    let found = |bound: f64| closest_approach(&still, bound, &LIMITS);
    assert!(found(0.9).nearest.is_none() && found(1.1).nearest.is_some());
    assert!(found(0.9).is_complete && found(0.9).at_least >= 0.9 - accuracy(0.9, &LIMITS));
    assert!(found(0.9).at_least < 0.9);
}

#[test]
fn an_exhausted_budget_leaves_a_valid_bound() {
    let mut random = Random::new(45);
    let hasty = Limits { budget: 3, ..LIMITS };
    let mut incomplete = 0;
    for _ in 0..60 {
        let mut both = || [random.triangle(1.0), random.triangle(1.0).map(|p| p + DVec3::X * 1.5)];
        let pair = pair(both(), both());
        let found = closest_approach(&pair, f64::INFINITY, &hasty);
        assert!(found.at_least <= sampled(&pair));
        incomplete += usize::from(!found.is_complete);
    }
    assert!(incomplete > 10, "{incomplete}");
}
