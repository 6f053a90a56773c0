//! Chains to unfold.

use std::f64::consts::{PI, TAU};

use foldmotion_geometry::unfolding::Chain;
use foldmotion_geometry::{Closure, DivisionOptions, Profile, divide};
use glam::DVec2;

/// r = √θ, both arms to θ = 6π, in 2 · `half` equal segments from the centre outwards.
pub(crate) fn fermat_spiral(half: usize) -> Vec<DVec2> {
    let at = |angle: f64| DVec2::from_angle(angle) * angle.sqrt();
    // Distances from a point of the arm increase along it up to at least 1.5.
    let next = |last: f64, length: f64| {
        last_where([last, last + 1.5], |angle| at(angle).distance(at(last)) < length)
    };
    let arm = |length: f64| -> Vec<f64> {
        let angles = std::iter::successors(Some(0.0), |&last| Some(next(last, length)));
        angles.take(half + 1).collect()
    };
    let scale = 1.0 / half as f64;
    let length = last_where([10.0 * scale, 80.0 * scale], |length| arm(length)[half] < 6.0 * PI);
    let points: Vec<DVec2> = arm(length).into_iter().map(at).collect();
    let other = points[1..].iter().rev().map(|&p| -p);
    other.chain(points.iter().copied()).collect()
}

/// The number between the two up to which `holds` is true.
fn last_where([mut low, mut high]: [f64; 2], holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..60 {
        let middle = low.midpoint(high);
        if holds(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// A polygon around points at the given radii, closed.
pub(crate) fn star(radii: &[f64]) -> Vec<DVec2> {
    let count = radii.len();
    let point = |k: usize| DVec2::from_angle(TAU * k as f64 / count as f64) * radii[k % count];
    (0..count).chain([0]).map(point).collect()
}

/// The camber line and thickness of NACA 0012, from the trailing edge around and back (Abbott and von Doenhoff 1959,
/// section 6.2, with the last coefficient that closes the trailing edge).
pub(crate) fn airfoil(half: usize) -> Vec<DVec2> {
    let surface = |k: usize, side: f64| {
        let x = 0.5 * (1.0 + (PI * k as f64 / half as f64).cos());
        let z = 0.6
            * (0.2969 * x.sqrt() - 0.1260 * x - 0.3516 * x.powi(2) + 0.2843 * x.powi(3)
                - 0.1036 * x.powi(4));
        DVec2::new(x, if k == 0 { 0.0 } else { side * z })
    };
    let upper = (0..half).map(|k| surface(k, 1.0));
    upper.chain((0..=half).rev().map(|k| surface(k, -1.0))).collect()
}

/// A capital omega divided into `rows` equal segments.
pub(crate) fn omega(rows: usize) -> Vec<DVec2> {
    let half = [
        [2.0, 0.0],
        [1.4, 0.0],
        [0.75, 0.0],
        [0.45, 0.12],
        [0.55, 0.45],
        [1.15, 0.95],
        [1.25, 1.7],
        [0.8, 2.4],
    ];
    let right = half.into_iter().map(DVec2::from);
    let left = right.clone().rev().map(|p| DVec2::new(-p.x, p.y));
    let points: Vec<_> = right.chain([DVec2::new(0.0, 2.65)]).chain(left).collect();
    let profile = Profile::new(&points, Closure::Open).unwrap();
    divide(&profile, rows, &DivisionOptions::default()).unwrap().points
}

pub(crate) fn open(points: &[DVec2]) -> Chain {
    Chain::new(points, false).unwrap()
}

pub(crate) fn closed(points: &[DVec2]) -> Chain {
    Chain::new(points, true).unwrap()
}

/// The turns scaled to the deployment fraction.
pub(crate) fn scaled(chain: &Chain, fraction: f64) -> Vec<f64> {
    chain.turns().iter().map(|t| t * fraction).collect()
}
