//! Curves and profiles compared with closed forms.

use foldmotion_geometry::{Closure, GeometryError, Nurbs, Profile};
use glam::{DMat2, DVec2};
use proptest::prelude::*;

fn points(coordinates: &[[f64; 2]]) -> Vec<DVec2> {
    coordinates.iter().copied().map(DVec2::from).collect()
}

fn control_points(counts: std::ops::Range<usize>) -> impl Strategy<Value = Vec<DVec2>> {
    prop::collection::vec((-5.0..5.0, -5.0..5.0).prop_map(|(x, z)| DVec2::new(x, z)), counts)
}

/// A clamped knot vector of uneven spans, one of them possibly empty, for `count` control points.
fn uneven_knots(count: usize) -> Vec<f64> {
    let inner =
        (1..count - 3).map(|k| [1.0, 1.5, 4.0, 4.0, 7.0, 7.25][k % 6] + 8.0 * (k / 6) as f64);
    let end = 8.0 * (count / 6 + 1) as f64;
    let mut knots = vec![-2.0; 4];
    knots.extend(inner);
    knots.extend([end; 4]);
    knots
}

#[test]
fn four_clamped_control_points_make_a_bezier_curve() {
    let p = points(&[[0.3, -1.0], [2.0, 4.0], [-3.0, 0.5], [1.0, 1.0]]);
    let curve = Nurbs::clamped(p.clone()).unwrap();
    for k in 0..=100 {
        let (u, v) = (f64::from(k) / 100.0, 1.0 - f64::from(k) / 100.0);
        let position =
            v * v * v * p[0] + 3.0 * v * v * u * p[1] + 3.0 * v * u * u * p[2] + u * u * u * p[3];
        let derivative =
            3.0 * (v * v * (p[1] - p[0]) + 2.0 * v * u * (p[2] - p[1]) + u * u * (p[3] - p[2]));
        let second = 6.0 * (v * (p[2] - 2.0 * p[1] + p[0]) + u * (p[3] - 2.0 * p[2] + p[1]));
        assert!((curve.position(u) - position).length() < 1e-14, "position at {u}");
        assert!((curve.derivative(u) - derivative).length() < 1e-13, "derivative at {u}");
        assert!((curve.second_derivative(u) - second).length() < 1e-12, "second at {u}");
    }
}

#[test]
fn a_clamped_curve_runs_exactly_from_its_first_to_its_last_control_point() {
    let p = points(&[[0.1, 0.7], [1.0, 2.0], [2.0, -1.0], [3.0, 3.0], [0.3, 0.9], [7.1, 0.1]]);
    let curve = Nurbs::with_knots(p.clone(), uneven_knots(6)).unwrap();
    assert_eq!(curve.position(0.0), p[0]);
    assert_eq!(curve.position(1.0), p[5]);
    assert_eq!(curve.position(-3.0), p[0]);
    assert_eq!(curve.position(9.0), p[5]);
    let breakpoints = curve.breakpoints();
    assert_eq!((breakpoints[0], breakpoints[breakpoints.len() - 1]), (0.0, 1.0));
    assert!(breakpoints.windows(2).all(|u| u[0] < u[1]));
}

#[test]
fn a_smooth_profile_returns_to_its_start_with_two_derivatives() {
    let p = points(&[[0.0, 0.0], [2.0, -1.0], [3.0, 1.0], [1.5, 3.0], [-1.0, 1.0]]);
    let profile = Profile::new(&p, Closure::Smooth).unwrap();
    assert_eq!(profile.position(0.0), profile.position(1.0));
    assert!((profile.derivative(0.0) - profile.derivative(1.0)).length() < 1e-12);
    let jump = profile.second_derivative(0.0) - profile.second_derivative(1.0);
    assert!(jump.length() < 1e-11, "jump {jump}");
    // The value of a uniform cubic B-spline at a knot is (P_{i−1} + 4 P_i + P_{i+1}) / 6.
    assert!((profile.position(0.0) - (p[0] + 4.0 * p[1] + p[2]) / 6.0).length() < 1e-15);
    let repeated: Vec<_> = p.iter().copied().chain([p[0]]).collect();
    assert_eq!(Profile::new(&repeated, Closure::Smooth).unwrap(), profile);
}

#[test]
fn a_corner_profile_returns_to_its_first_control_point_whether_it_is_repeated_or_not() {
    let p = points(&[[0.0, 0.0], [2.0, -1.0], [3.0, 1.0], [1.5, 3.0], [-1.0, 1.0]]);
    let profile = Profile::new(&p, Closure::Corner).unwrap();
    let repeated: Vec<_> = p.iter().copied().chain([p[0]]).collect();
    assert_eq!(Profile::new(&repeated, Closure::Corner).unwrap(), profile);
    assert_eq!(profile.position(1.0), p[0]);
    let turn = profile.derivative(0.0).angle_to(profile.derivative(1.0)).abs();
    assert!(turn > 0.1, "a corner, not a smooth return: {turn}");
}

#[test]
fn the_length_of_a_straight_profile_is_the_distance_of_its_ends() {
    let p: Vec<_> =
        [0.0, 0.1, 0.15, 0.7, 0.75, 1.0].map(|s| DVec2::new(1.0 + 3.0 * s, 2.0 - 4.0 * s)).to_vec();
    let profile = Profile::with_knots(&p, &uneven_knots(6), Closure::Open).unwrap();
    assert!((profile.arc_length(1e-12) - 5.0).abs() < 1e-12);
}

#[test]
fn the_length_of_a_parabola_is_within_the_requested_accuracy() {
    // Degree-elevated quadratic Bézier (0,0) (½,0) (1,1): z = x², length √5/2 + asinh(2)/4.
    let p = points(&[[0.0, 0.0], [1.0 / 3.0, 0.0], [2.0 / 3.0, 1.0 / 3.0], [1.0, 1.0]]);
    let profile = Profile::new(&p, Closure::Open).unwrap();
    let exact = 5f64.sqrt() / 2.0 + 2f64.asinh() / 4.0;
    for k in 1..15 {
        let accuracy = 0.1f64.powi(k);
        let error = (profile.arc_length(accuracy) - exact).abs();
        assert!(error <= accuracy, "{error} > {accuracy}");
    }
}

#[test]
fn the_length_of_a_curve_that_stops_and_turns_back_is_found() {
    // Bézier 0, 1, −1, 0 on a line: u ↦ 3u(1−u)(1−2u) goes out to √3/6 and back, twice.
    let p = points(&[[0.0, 0.0], [1.0, 0.0], [-1.0, 0.0], [0.0, 0.0]]);
    let profile = Profile::new(&p, Closure::Open).unwrap();
    let error = (profile.arc_length(1e-10) - 4.0 * 3f64.sqrt() / 6.0).abs();
    assert!(error < 1e-10, "{error}");
}

#[test]
fn periodic_curves_around_a_circle_approach_its_circumference() {
    let error = |n: usize| {
        let turn = std::f64::consts::TAU / n as f64;
        // On a circle of control points (P_{i−1} + 4 P_i + P_{i+1}) / 6 shrinks the radius by (2 + cos turn) / 3.
        let radius = 3.0 / (2.0 + turn.cos());
        let p: Vec<_> = (0..n).map(|k| radius * DVec2::from_angle(turn * k as f64)).collect();
        let profile = Profile::new(&p, Closure::Smooth).unwrap();
        (profile.arc_length(1e-13) - std::f64::consts::TAU).abs()
    };
    let order = (error(8) / error(16)).log2();
    assert!((3.5..6.5).contains(&order), "fourth order or better: {order}");
    assert!(error(128) < 1e-7, "{:e}", error(128));
}

#[test]
fn unusable_control_points_and_knots_are_refused_with_their_evidence() {
    let good = points(&[[0.0, 0.0], [1.0, 1.0], [2.0, 1.0], [3.0, 0.0], [4.0, 2.0]]);
    let with = |knots: &[f64]| Profile::with_knots(&good, knots, Closure::Open).unwrap_err();
    assert!(matches!(
        Profile::new(&good[..3], Closure::Corner).unwrap_err(),
        GeometryError::TooFewControlPoints { count: 3, minimum: 4 }
    ));
    for bad in [f64::NAN, f64::INFINITY, -1e101] {
        let mut p = good.clone();
        p[2].y = bad;
        assert!(matches!(
            Profile::new(&p, Closure::Open).unwrap_err(),
            GeometryError::ControlPoint { index: 2, .. }
        ));
    }
    assert!(matches!(with(&[0.0; 8]), GeometryError::KnotCount { expected: 9, .. }));
    let knots = |inner: f64| [0.0, 0.0, 0.0, 0.0, inner, 1.0, 1.0, 1.0, 1.0];
    assert!(Profile::with_knots(&good, &knots(0.3), Closure::Open).is_ok());
    assert!(matches!(with(&knots(f64::NAN)), GeometryError::KnotNotFinite { index: 4, .. }));
    assert!(matches!(with(&knots(-0.5)), GeometryError::KnotsDecrease { index: 4, .. }));
    assert!(matches!(
        with(&knots(0.0)),
        GeometryError::KnotMultiplicity { count: 5, limit: 4, .. }
    ));
    assert!(matches!(with(&knots(1e-12)), GeometryError::KnotSpanTooNarrow { .. }));
    assert!(matches!(with(&[2.0; 9]), GeometryError::KnotRange { .. }));
    let unclamped: Vec<_> = (0..10).map(f64::from).collect();
    assert!(matches!(
        Profile::with_knots(&good, &unclamped, Closure::Corner).unwrap_err(),
        GeometryError::NotClosed { .. }
    ));
    assert_eq!(
        Profile::with_knots(&good, &unclamped, Closure::Smooth).unwrap_err(),
        GeometryError::KnotsOfSmoothProfile
    );
    let profile = Profile::new(&good, Closure::Open).unwrap();
    for factor in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(profile.scaled(factor), Err(GeometryError::Scale { .. })));
    }
    assert!(profile.scaled(1e100).is_err(), "out of range");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn derivatives_agree_with_central_differences(p in control_points(4..12), u in 0.01..0.99_f64) {
        let curve = Nurbs::with_knots(p.clone(), uneven_knots(p.len())).unwrap();
        let step = 1e-6;
        prop_assume!(curve.breakpoints().iter().all(|b| (b - u).abs() > 2.0 * step));
        let first = (curve.position(u + step) - curve.position(u - step)) / (2.0 * step);
        let second = (curve.derivative(u + step) - curve.derivative(u - step)) / (2.0 * step);
        let scale = 1.0 + curve.second_derivative(u).length();
        prop_assert!((first - curve.derivative(u)).length() < 1e-6 * scale);
        prop_assert!((second - curve.second_derivative(u)).length() < 1e-5 * scale);
    }

    #[test]
    fn moving_the_control_points_affinely_moves_the_curve(p in control_points(4..12), u in 0.0..=1.0) {
        // The translation part is the partition of unity.
        let map = |q: DVec2| DMat2::from_cols_array(&[0.3, -1.2, 2.0, 0.7]) * q + DVec2::new(100.0, -40.0);
        let knots = uneven_knots(p.len());
        let moved = Nurbs::with_knots(p.iter().copied().map(map).collect(), knots.clone()).unwrap();
        let curve = Nurbs::with_knots(p, knots).unwrap();
        prop_assert!((moved.position(u) - map(curve.position(u))).length() < 1e-12);
    }

    #[test]
    fn a_reversed_profile_is_the_same_curve_run_backwards(
        p in control_points(4..12), u in 0.0..=1.0, closure in prop::sample::select(&[Closure::Open, Closure::Corner, Closure::Smooth][..])
    ) {
        let profile = Profile::new(&p, closure).unwrap();
        let back = profile.reversed();
        prop_assert!((back.position(u) - profile.position(1.0 - u)).length() < 1e-12);
        prop_assert_eq!(back.position(0.0), back.position(if closure == Closure::Open { 0.0 } else { 1.0 }));
    }
}
