//! Curves through given points: they pass through each, are smooth, and closed if requested; and what is refused.

use foldmotion_geometry::{Closure, GeometryError, Profile};
use glam::DVec2;

fn ring(count: usize, turn: f64) -> Vec<DVec2> {
    (0..count)
        .map(|k| {
            let angle = turn * k as f64 / count as f64;
            (2.0 + 0.3 * (3.0 * angle).cos()) * DVec2::from_angle(angle)
        })
        .collect()
}

/// The distance of p from the nearest of many points of the curve.
fn distance(profile: &Profile, p: DVec2) -> f64 {
    (0..=20_000)
        .map(|k| profile.position(f64::from(k) / 20_000.0).distance(p))
        .fold(f64::INFINITY, f64::min)
}

#[test]
fn the_curve_runs_through_every_point_with_two_continuous_derivatives() {
    for closure in [Closure::Open, Closure::Corner, Closure::Smooth] {
        let points = ring(17, 6.0);
        let profile = Profile::through(&points, closure).unwrap();
        let knots = profile.curve().breakpoints();
        let spans = points.len() - usize::from(closure == Closure::Open);
        assert_eq!(knots.len(), spans + 1);
        for (p, &u) in points.iter().zip(&knots) {
            assert!(profile.position(u).distance(*p) < 1e-14, "{closure:?} at {u}");
        }
        for &u in &knots[1..spans] {
            let (before, after) = (u - 1e-9, u + 1e-9);
            let jump = profile.derivative(after) - profile.derivative(before);
            assert!(jump.length() < 1e-5, "{jump}");
            let jump = profile.second_derivative(after) - profile.second_derivative(before);
            assert!(jump.length() < 1e-3, "{jump}");
        }
    }
}

#[test]
fn a_smooth_outline_closes_with_its_derivatives_and_a_corner_ends_without_curvature() {
    let points = ring(12, std::f64::consts::TAU);
    let smooth = Profile::through(&points, Closure::Smooth).unwrap();
    assert_eq!(smooth.position(1.0), smooth.position(0.0));
    assert!((smooth.derivative(1.0) - smooth.derivative(0.0)).length() < 1e-12);
    assert!((smooth.second_derivative(1.0) - smooth.second_derivative(0.0)).length() < 1e-9);
    let corner = Profile::through(&points, Closure::Corner).unwrap();
    assert_eq!(corner.position(1.0), points[0]);
    assert!((corner.derivative(1.0) - corner.derivative(0.0)).length() > 0.1);
    assert!(corner.second_derivative(0.0).length() < 1e-9);
    assert!(corner.second_derivative(1.0).length() < 1e-9);
}

#[test]
fn a_repeated_first_point_changes_nothing() {
    let mut points = ring(9, std::f64::consts::TAU);
    let once = Profile::through(&points, Closure::Smooth).unwrap();
    points.push(points[0]);
    assert_eq!(Profile::through(&points, Closure::Smooth).unwrap(), once);
}

#[test]
fn a_circle_is_approximated_to_the_fourth_power_of_the_spacing() {
    let error = |count: usize| {
        let circle: Vec<_> = (0..count)
            .map(|k| DVec2::from_angle(std::f64::consts::TAU * k as f64 / count as f64))
            .collect();
        let profile = Profile::through(&circle, Closure::Smooth).unwrap();
        (0..=5000)
            .map(|k| (profile.position(f64::from(k) / 5000.0).length() - 1.0).abs())
            .fold(0.0, f64::max)
    };
    let (coarse, fine) = (error(12), error(24));
    assert!(coarse < 1e-3 && coarse / fine > 12.0, "{coarse} {fine}");
}

#[test]
fn two_points_give_the_line_between_them() {
    let line = Profile::through(&[DVec2::ZERO, DVec2::new(3.0, 1.0)], Closure::Open).unwrap();
    assert!(line.position(0.25).distance(DVec2::new(0.75, 0.25)) < 1e-15);
}

#[test]
fn thousands_of_points_are_interpolated_too() {
    let points = ring(5000, 6.0);
    let profile = Profile::through(&points, Closure::Open).unwrap();
    for p in points.iter().step_by(997) {
        assert!(distance(&profile, *p) < 1e-3);
    }
    assert!(profile.check_simple().is_ok());
}

#[test]
fn points_that_make_no_curve_are_refused() {
    let through = |points: &[[f64; 2]], closure| {
        let points: Vec<_> = points.iter().copied().map(DVec2::from).collect();
        Profile::through(&points, closure).unwrap_err()
    };
    let open = Closure::Open;
    assert!(matches!(through(&[], open), GeometryError::PointCount { count: 0, .. }));
    assert!(matches!(through(&[[0.0, 0.0]], open), GeometryError::PointCount { .. }));
    let triangle = [[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]];
    assert!(matches!(
        through(&triangle, Closure::Corner),
        GeometryError::PointCount { minimum: 3, .. }
    ));
    assert!(matches!(
        through(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0]], open),
        GeometryError::RepeatedPoint { index: 1, .. }
    ));
    assert!(matches!(
        through(&[[0.0, 0.0], [0.0, 0.0]], open),
        GeometryError::RepeatedPoint { index: 0, .. }
    ));
    assert!(matches!(
        through(&[[0.0, 0.0], [f64::NAN, 0.0]], open),
        GeometryError::Point { index: 1, .. }
    ));
    let apart = [[0.0, 0.0], [1.0, 0.0], [2.0, 1.0], [3.0, 4.0], [4.0, 6.0], [5.0, 9.0]];
    assert!(matches!(through(&apart, Closure::Smooth), GeometryError::EndsApart { .. }));
    let many = vec![[0.0, 0.0]; 20_001];
    assert!(matches!(through(&many, open), GeometryError::PointCount { count: 20_001, .. }));
}
