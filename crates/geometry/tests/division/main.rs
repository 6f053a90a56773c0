//! Division of profiles: equal segments on the curve, in order, with fixed ends; and what is refused.

#![expect(clippy::unwrap_used, reason = "builders of test profiles panic on a broken one")]

mod equal_length;
mod other_methods;
mod random_profiles;
mod refusals;

use foldmotion_geometry::{Closure, Division, DivisionOptions, Ending, Profile, divide};
use glam::DVec2;

fn profile(coordinates: &[[f64; 2]], closure: Closure) -> Profile {
    let points: Vec<_> = coordinates.iter().copied().map(DVec2::from).collect();
    Profile::new(&points, closure).unwrap()
}

fn wave() -> Profile {
    profile(
        &[[0.0, 0.0], [1.0, 2.0], [2.0, -1.0], [3.0, 1.5], [5.0, 0.0], [5.5, 2.0]],
        Closure::Open,
    )
}

fn equal(profile: &Profile, segments: usize) -> Division {
    divide(profile, segments, &DivisionOptions::default()).unwrap()
}

/// What every division promises, whatever its residual.
fn check_promises(profile: &Profile, division: &Division) {
    let Division { points, parameters, .. } = division;
    assert_eq!(points.len(), parameters.len());
    assert_eq!((parameters[0], parameters[parameters.len() - 1]), (0.0, 1.0));
    assert!(parameters.windows(2).all(|u| u[0] < u[1]), "order is kept");
    for (point, &u) in points.iter().zip(parameters) {
        assert_eq!(*point, profile.position(u), "bitwise on the curve");
    }
    if profile.is_closed() {
        assert_eq!(points.first(), points.last());
    }
    let lengths: Vec<_> = points.windows(2).map(|p| p[0].distance(p[1])).collect();
    let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
    assert!((mean - division.mean_length).abs() <= 1e-15 * mean);
    let worst = lengths.iter().map(|h| (h - mean).abs() / mean).fold(0.0, f64::max);
    assert!((worst - division.max_residual).abs() <= 1e-15 * (1.0 + worst));
    assert!(division.mean_residual <= division.max_residual);
    assert_eq!(
        division.converged(),
        matches!(division.ending, Ending::Tolerance | Ending::Rounding)
    );
}
