//! Division into segments of equal length.

use foldmotion_geometry::{
    Closure, DivisionOptions, Ending, GeometryError, Profile, divide, divide_to_length,
};
use glam::DVec2;

use crate::{check_promises, equal, profile, wave};

#[test]
fn a_wave_is_divided_into_equal_chords_for_every_number_of_segments() {
    let wave = wave();
    for segments in [1, 2, 3, 4, 5, 7, 9, 12, 26, 35, 100] {
        let division = equal(&wave, segments);
        check_promises(&wave, &division);
        assert!(division.converged());
        assert!(division.max_residual <= 1e-13, "{segments}: {}", division.max_residual);
        assert_eq!(division.points.len(), segments + 1);
    }
}

#[test]
fn one_segment_is_the_chord_between_the_ends() {
    let division = equal(&wave(), 1);
    assert_eq!(division.points, [DVec2::ZERO, DVec2::new(5.5, 2.0)]);
    assert_eq!((division.iterations, division.max_residual), (0, 0.0));
    assert_eq!(division.mean_length, DVec2::new(5.5, 2.0).length());
}

#[test]
fn a_straight_profile_is_divided_as_a_ruler_is() {
    let line =
        profile(&[[1.0, 1.0], [2.0, 3.0], [2.5, 4.0], [4.0, 7.0], [5.0, 9.0]], Closure::Open);
    for (k, point) in equal(&line, 8).points.iter().enumerate() {
        let expected = DVec2::new(1.0, 1.0) + DVec2::new(4.0, 8.0) * (k as f64 / 8.0);
        assert!((*point - expected).length() < 1e-14, "{point} != {expected}");
    }
}

#[test]
fn two_segments_meet_where_the_perpendicular_bisector_cuts_the_profile() {
    let wave = wave();
    let middle = equal(&wave, 2).points[1];
    let (a, b) = (wave.position(0.0), wave.position(1.0));
    assert!((middle - (a + b) / 2.0).dot(b - a).abs() < 1e-13);
}

#[test]
fn closed_profiles_are_divided_from_their_start_back_to_it() {
    let corners = [[0.0, 0.0], [4.0, -1.0], [6.0, 2.0], [3.0, 5.0], [-2.0, 4.0], [-1.5, 2.0]];
    for closure in [Closure::Corner, Closure::Smooth] {
        let closed = profile(&corners, closure);
        for segments in [3, 4, 7, 26, 100] {
            let division = equal(&closed, segments);
            check_promises(&closed, &division);
            assert!(
                division.max_residual <= 1e-13,
                "{closure:?} {segments}: {}",
                division.max_residual
            );
        }
        for segments in [1, 2] {
            let error = divide(&closed, segments, &DivisionOptions::default()).unwrap_err();
            assert!(matches!(error, GeometryError::SegmentCount { minimum: 3, .. }));
        }
    }
}

/// Four legs up and down; `copies` of each turning point make it rounder (2) or a corner (3).
fn zigzag(width: f64, copies: usize) -> Profile {
    let turns = [0.0, 2.0, 0.0, 2.0, 0.0];
    let points: Vec<_> =
        turns.iter().enumerate().flat_map(|(k, z)| vec![[k as f64 * width, *z]; copies]).collect();
    profile(&points, Closure::Open)
}

#[test]
fn sharp_turns_and_corners_are_divided_too() {
    // Hairpins of 20° and corners of 90° and more, for every small number of segments.
    for (width, copies) in [(0.35, 1), (0.35, 2), (2.0, 3), (4.0, 3)] {
        let zigzag = zigzag(width, copies);
        for segments in 2..40 {
            let division = equal(&zigzag, segments);
            check_promises(&zigzag, &division);
            assert!(division.converged(), "{width} {copies} {segments}: {:?}", division.ending);
            assert!(division.max_residual <= 1e-13, "{}", division.max_residual);
        }
    }
}

#[test]
fn needle_sharp_corners_hold_no_division_up() {
    // Corners of 20°, in segments longer and shorter than the legs.
    let zigzag = zigzag(0.35, 3);
    for segments in 2..60 {
        let division = equal(&zigzag, segments);
        check_promises(&zigzag, &division);
        // Three chords of this point-symmetric curve bifurcate during the continuation: they are refused.
        assert_eq!(division.max_residual <= 1e-13, segments != 3, "{segments}");
        assert_eq!(division.converged(), segments != 3);
    }
}

#[test]
fn a_triangle_with_a_needle_at_its_seam_may_stay_undivided_and_says_so() {
    let endings = (3..12).map(|segments| {
        let corners =
            [[0.0, 0.0], [4.0, 0.1], [4.0, 0.1], [4.0, 0.1], [4.0, -0.1], [4.0, -0.1], [4.0, -0.1]];
        let needle = profile(&corners, Closure::Corner);
        let division = equal(&needle, segments);
        check_promises(&needle, &division);
        assert_eq!(division.converged(), division.max_residual <= 1e-13);
        division.ending
    });
    assert!(endings.collect::<Vec<_>>().contains(&Ending::Tolerance));
}

#[test]
#[expect(clippy::cast_sign_loss, reason = "shares of counts are not negative")]
fn every_random_curve_without_a_seam_corner_is_divided_however_sharp_its_turns() {
    // A linear congruential generator (Knuth 1997, volume 2, section 3.3.4).
    let mut state = 7_u64;
    let mut unit = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut divided = 0;
    for curve in 0..900 {
        let count = 4 + (6.0 * unit()) as usize;
        let points: Vec<_> = (0..count).map(|_| [unit(), unit()]).collect();
        let closure = [Closure::Open, Closure::Smooth][curve % 2];
        let segments = 3 + (58.0 * unit()) as usize;
        let profile = profile(&points, closure);
        if let Ok(division) = divide(&profile, segments, &DivisionOptions::default()) {
            check_promises(&profile, &division);
            assert!(
                division.converged(),
                "curve {curve}, {closure:?}, {segments}: {}",
                division.max_residual
            );
            divided += 1;
        }
    }
    assert!(divided > 200, "{divided}");
}

#[test]
fn a_hundred_thousand_segments_reach_what_rounding_allows() {
    let wave = wave();
    let division = equal(&wave, 100_000);
    check_promises(&wave, &division);
    assert_eq!(division.ending, Ending::Rounding);
    assert!(division.max_residual < 1e-9, "{}", division.max_residual);
    assert!(division.iterations < 60, "{}", division.iterations);
}

#[test]
fn scaling_and_turning_the_profile_scales_and_turns_its_division() {
    let wave = wave();
    let turn = DVec2::from_angle(0.7);
    let moved: Vec<_> = wave
        .curve()
        .control_points()
        .iter()
        .map(|p| 37.0 * turn.rotate(*p) + DVec2::new(3.0, -8.0))
        .collect();
    let moved = Profile::new(&moved, Closure::Open).unwrap();
    let (here, there) = (equal(&wave, 12), equal(&moved, 12));
    for (a, b) in here.points.iter().zip(&there.points) {
        let expected = 37.0 * turn.rotate(*a) + DVec2::new(3.0, -8.0);
        assert!((expected - *b).length() < 1e-11, "{expected} != {b}");
    }
    let reversed = equal(&wave.reversed(), 12);
    for (a, b) in here.points.iter().zip(reversed.points.iter().rev()) {
        assert!((*a - *b).length() < 1e-12);
    }
}

#[test]
fn a_profile_is_scaled_to_the_requested_polygon_length() {
    let (scaled, division) =
        divide_to_length(&wave(), 7, 7.0, &DivisionOptions::default()).unwrap();
    check_promises(&scaled, &division);
    assert!((division.length() - 7.0).abs() < 1e-14);
    assert!((division.mean_length - 1.0).abs() < 1e-15);
    assert!(division.max_residual < 1e-13);
    for length in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = divide_to_length(&wave(), 7, length, &DivisionOptions::default());
        assert!(matches!(refused, Err(GeometryError::Length { .. })));
    }
}

#[test]
fn profiles_of_any_size_from_1e90_to_1e_minus_90_are_divided_alike() {
    for factor in [1e90, 1e40, 1e-40, 1e-90] {
        let scaled = wave().scaled(factor).unwrap();
        let division = equal(&scaled, 12);
        check_promises(&scaled, &division);
        assert!(division.max_residual <= 1e-13, "{factor}: {}", division.max_residual);
    }
    let tiny = wave().scaled(1e-120).unwrap();
    let refused = divide(&tiny, 12, &DivisionOptions::default());
    assert!(matches!(refused, Err(GeometryError::SegmentTooShort { .. })));
}
