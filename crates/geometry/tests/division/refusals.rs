//! What the caller chooses, and what is refused.

use foldmotion_geometry::{Closure, DivisionOptions, Ending, GeometryError, divide, divide_from};
use glam::DVec2;

use crate::{check_promises, profile, wave};

#[test]
fn the_iteration_limit_and_the_tolerance_are_the_callers() {
    let wave = wave();
    let with = |tolerance, max_iterations| {
        let options = DivisionOptions { tolerance, max_iterations, ..DivisionOptions::default() };
        divide(&wave, 9, &options)
    };
    let none = with(1e-14, 0).unwrap();
    check_promises(&wave, &none);
    assert_eq!(
        (none.ending, none.iterations, none.converged()),
        (Ending::Tolerance, 0, true),
        "followed chains need no iterations"
    );
    let loose = with(1e-3, 100).unwrap();
    assert!(loose.max_residual <= 1e-3 && loose.ending == Ending::Tolerance);
    let tight = with(1e-12, 100).unwrap();
    assert!(tight.iterations > loose.iterations);
    let exact = with(0.0, 100).unwrap();
    assert!(exact.converged() && exact.max_residual <= 1e-13);
    for tolerance in [-1.0, f64::NAN] {
        assert!(matches!(with(tolerance, 100), Err(GeometryError::Tolerance { .. })));
    }
}

#[test]
fn starts_that_do_not_increase_from_0_to_1_are_refused() {
    let refused = |start: &[f64]| divide_from(&wave(), start, &DivisionOptions::default()).is_err();
    assert!(refused(&[]));
    assert!(refused(&[0.0]));
    assert!(refused(&[0.0, 0.5, 0.5, 1.0]));
    assert!(refused(&[0.1, 0.5, 1.0]));
    assert!(refused(&[0.0, 0.5, 0.9]));
    assert!(refused(&[0.0, f64::NAN, 1.0]));
    assert!(!refused(&[0.0, 0.5, 1.0]));
}

#[test]
fn segments_below_what_f64_resolves_are_refused() {
    let options = DivisionOptions::default();
    let far =
        profile(&[[1e9, 0.0], [1e9, 1e-3], [1e9 + 1e-3, 1e-3], [1e9 + 1e-3, 0.0]], Closure::Open);
    assert!(matches!(divide(&far, 10, &options), Err(GeometryError::SegmentTooShort { .. })));
    let point = profile(&[[2.0, 1.0]; 4], Closure::Open);
    assert!(matches!(divide(&point, 1, &options), Err(GeometryError::SegmentTooShort { .. })));
    let origin = profile(&[[0.0, 0.0]; 5], Closure::Open);
    assert!(matches!(divide(&origin, 3, &options), Err(GeometryError::SegmentTooShort { .. })));
    assert!(matches!(divide(&wave(), 0, &options), Err(GeometryError::SegmentCount { .. })));
    assert!(matches!(
        divide(&wave(), usize::MAX, &options),
        Err(GeometryError::SegmentCount { .. })
    ));
}

#[test]
fn a_profile_that_crosses_itself_is_refused_with_the_point() {
    // Bézier (−1,0) (2,2) (−2,2) (1,0): symmetric in x, so it crosses itself on x = 0.
    let looped = profile(&[[-1.0, 0.0], [2.0, 2.0], [-2.0, 2.0], [1.0, 0.0]], Closure::Open);
    match divide(&looped, 9, &DivisionOptions::default()).unwrap_err() {
        GeometryError::CurveCrosses { parameters: [a, b], point } => {
            assert!(point.x.abs() < 1e-3, "{point}");
            assert!((a + b - 1.0).abs() < 1e-3 && a < b);
            assert!((looped.position(a) - point).length() < 1e-3);
        }
        other => panic!("{other}"),
    }
}

#[test]
fn a_profile_that_only_comes_close_to_itself_is_accepted() {
    // A hairpin: out and back at a distance; then the same with its strands changing sides.
    let hairpin = |gap: f64| {
        let points = [
            [0.0, 0.0],
            [3.0, 0.0],
            [6.0, 0.0],
            [9.0, gap / 2.0],
            [6.0, gap],
            [3.0, gap],
            [0.0, gap],
        ];
        divide(&profile(&points, Closure::Open), 40, &DivisionOptions::default())
    };
    assert!(hairpin(1e-3).is_ok());
    assert!(hairpin(1e-2).is_ok());
    let crossed =
        [[0.0, 0.0], [3.0, 0.0], [6.0, 0.0], [9.0, 5e-4], [6.0, 1e-3], [3.0, 1e-3], [0.0, -1e-3]];
    let refused = divide(&profile(&crossed, Closure::Open), 40, &DivisionOptions::default());
    assert!(matches!(refused, Err(GeometryError::CurveCrosses { .. })));
}

#[test]
fn an_open_profile_whose_ends_meet_is_refused_and_accepted_once_it_is_declared_closed() {
    let points = [[0.0, 0.0], [4.0, -1.0], [6.0, 2.0], [3.0, 5.0], [-2.0, 4.0], [0.0, 0.0]];
    let options = DivisionOptions::default();
    let open = divide(&profile(&points, Closure::Open), 9, &options);
    assert!(matches!(open, Err(GeometryError::CurveCrosses { .. })));
    assert!(divide(&profile(&points, Closure::Corner), 9, &options).is_ok());
}

#[test]
fn a_polygon_too_coarse_for_its_simple_profile_is_refused_with_its_segments() {
    // A narrow spiral arm: three turns, divided into so few chords that they cut across.
    let arm: Vec<_> = (0..60)
        .map(|k| {
            let angle = f64::from(k) * 0.35;
            let p = (1.0 + 0.06 * angle) * DVec2::from_angle(angle);
            [p.x, p.y]
        })
        .collect();
    let spiral = profile(&arm, Closure::Open);
    let options = DivisionOptions::default();
    assert!(divide(&spiral, 90, &options).is_ok());
    let refused = divide(&spiral, 9, &options);
    assert!(
        matches!(refused, Err(GeometryError::PolygonCrosses { segments: [a, b], .. }) if a < b),
        "{refused:?}"
    );
}
