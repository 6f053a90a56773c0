//! Equal division: equal, on the curve, in order, ends fixed; and what is refused.

#![expect(
    clippy::unwrap_used,
    reason = "builders of test profiles panic on a broken one"
)]

use foldmotion_geometry::{
    Closure, Division, DivisionMethod, DivisionOptions, Ending, GeometryError, Profile, divide,
    divide_from, divide_to_length, simplify,
};
use glam::DVec2;
use proptest::prelude::*;

fn profile(coordinates: &[[f64; 2]], closure: Closure) -> Profile {
    let points: Vec<_> = coordinates.iter().copied().map(DVec2::from).collect();
    Profile::new(&points, closure).unwrap()
}

fn wave() -> Profile {
    profile(
        &[
            [0.0, 0.0],
            [1.0, 2.0],
            [2.0, -1.0],
            [3.0, 1.5],
            [5.0, 0.0],
            [5.5, 2.0],
        ],
        Closure::Open,
    )
}

fn equal(profile: &Profile, segments: usize) -> Division {
    divide(profile, segments, &DivisionOptions::default()).unwrap()
}

/// What every division promises, whatever its residual.
fn check_promises(profile: &Profile, division: &Division) {
    let Division {
        points, parameters, ..
    } = division;
    assert_eq!(points.len(), parameters.len());
    assert_eq!(
        (parameters[0], parameters[parameters.len() - 1]),
        (0.0, 1.0)
    );
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
    let worst = lengths
        .iter()
        .map(|h| (h - mean).abs() / mean)
        .fold(0.0, f64::max);
    assert!((worst - division.max_residual).abs() <= 1e-15 * (1.0 + worst));
    assert!(division.mean_residual <= division.max_residual);
    assert_eq!(
        division.converged(),
        matches!(division.ending, Ending::Tolerance | Ending::Rounding)
    );
}

#[test]
fn a_wave_is_divided_into_equal_chords_for_every_number_of_segments() {
    let wave = wave();
    for segments in [1, 2, 3, 4, 5, 7, 9, 12, 26, 35, 100] {
        let division = equal(&wave, segments);
        check_promises(&wave, &division);
        assert!(division.converged());
        assert!(
            division.max_residual <= 1e-13,
            "{segments}: {}",
            division.max_residual
        );
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
    let line = profile(
        &[[1.0, 1.0], [2.0, 3.0], [2.5, 4.0], [4.0, 7.0], [5.0, 9.0]],
        Closure::Open,
    );
    for (k, point) in equal(&line, 8).points.iter().enumerate() {
        let expected = DVec2::new(1.0, 1.0) + DVec2::new(4.0, 8.0) * (k as f64 / 8.0);
        assert!(
            (*point - expected).length() < 1e-14,
            "{point} != {expected}"
        );
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
    let corners = [
        [0.0, 0.0],
        [4.0, -1.0],
        [6.0, 2.0],
        [3.0, 5.0],
        [-2.0, 4.0],
        [-1.5, 2.0],
    ];
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
            assert!(matches!(
                error,
                GeometryError::SegmentCount { minimum: 3, .. }
            ));
        }
    }
}

/// Four legs up and down; `copies` of each turning point make it rounder (2) or a corner (3).
fn zigzag(width: f64, copies: usize) -> Profile {
    let turns = [0.0, 2.0, 0.0, 2.0, 0.0];
    let points: Vec<_> = turns
        .iter()
        .enumerate()
        .flat_map(|(k, z)| vec![[k as f64 * width, *z]; copies])
        .collect();
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
            assert!(
                division.converged(),
                "{width} {copies} {segments}: {:?}",
                division.ending
            );
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
        // Three chords of this point-symmetric curve bifurcate on the way: they are refused.
        assert_eq!(division.max_residual <= 1e-13, segments != 3, "{segments}");
        assert_eq!(division.converged(), segments != 3);
    }
}

#[test]
fn a_triangle_with_a_needle_at_its_seam_may_stay_undivided_and_says_so() {
    let endings = (3..12).map(|segments| {
        let corners = [
            [0.0, 0.0],
            [4.0, 0.1],
            [4.0, 0.1],
            [4.0, 0.1],
            [4.0, -0.1],
            [4.0, -0.1],
            [4.0, -0.1],
        ];
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
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
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
fn parametric_division_is_even_in_the_parameter() {
    let wave = wave();
    let options = DivisionOptions {
        method: DivisionMethod::Parametric,
        ..DivisionOptions::default()
    };
    let division = divide(&wave, 8, &options).unwrap();
    check_promises(&wave, &division);
    assert_eq!(
        division.parameters,
        [0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0]
    );
    assert_eq!(division.ending, Ending::Direct);
    assert!(
        division.max_residual > 0.1,
        "the wave is not run through evenly"
    );
}

#[test]
fn douglas_peucker_keeps_the_curve_within_its_tolerance_and_fits_better_than_even_parameters() {
    let wave = wave();
    let length = wave.arc_length(1e-9);
    let mut before = 1;
    for tolerance in [0.05, 0.01, 1e-3, 1e-4] {
        let division = simplify(&wave, tolerance).unwrap();
        check_promises(&wave, &division);
        let fit = division.fit(&wave);
        assert!(fit.largest <= 1.002 * tolerance * length, "{fit:?}");
        assert!(fit.mean < fit.largest);
        let segments = division.points.len() - 1;
        assert!(segments > before);
        before = segments;
        // One segment fewer leaves the tolerance: the splits come in order of deviation here.
        let by_count = |segments, method| {
            let options = DivisionOptions {
                method,
                ..DivisionOptions::default()
            };
            divide(&wave, segments, &options).unwrap()
        };
        let fewer = by_count(segments - 1, DivisionMethod::DouglasPeucker);
        assert!(fewer.fit(&wave).largest > tolerance * length);
        let even = by_count(segments, DivisionMethod::Parametric);
        assert!(fit.largest < even.fit(&wave).largest);
    }
}

#[test]
fn the_fit_of_an_arc_is_its_sagitta() {
    // Three chords of a nearly circular Bézier quarter: sagitta r (1 − cos 15°), mean ⅔ of it.
    let k = 0.552_284_749_8;
    let arc = profile(&[[1.0, 0.0], [1.0, k], [k, 1.0], [0.0, 1.0]], Closure::Open);
    let fit = equal(&arc, 3).fit(&arc);
    let sagitta = 1.0 - (std::f64::consts::PI / 12.0).cos();
    assert!((fit.largest - sagitta).abs() < 0.01 * sagitta, "{fit:?}");
    assert!(
        (fit.mean - 2.0 / 3.0 * sagitta).abs() < 0.01 * sagitta,
        "{fit:?}"
    );
}

#[test]
fn tolerances_that_leave_one_segment_and_numbers_that_cannot_be_told_apart_are_refused() {
    assert!(matches!(
        simplify(&wave(), 0.9),
        Err(GeometryError::TooCoarse {
            segments: 1,
            minimum: 2,
            ..
        })
    ));
    for tolerance in [0.0, -1.0, f64::NAN, 1.0] {
        assert!(matches!(
            simplify(&wave(), tolerance),
            Err(GeometryError::SplitTolerance { .. })
        ));
    }
    let line = profile(
        &[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]],
        Closure::Open,
    );
    let options = DivisionOptions {
        method: DivisionMethod::DouglasPeucker,
        ..DivisionOptions::default()
    };
    assert!(matches!(
        divide(&line, 4, &options),
        Err(GeometryError::NothingToSplit {
            count: 4,
            possible: 1
        })
    ));
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
fn a_profile_is_scaled_to_the_polygon_length_asked_for() {
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
        assert!(
            division.max_residual <= 1e-13,
            "{factor}: {}",
            division.max_residual
        );
    }
    let tiny = wave().scaled(1e-120).unwrap();
    let refused = divide(&tiny, 12, &DivisionOptions::default());
    assert!(matches!(
        refused,
        Err(GeometryError::SegmentTooShort { .. })
    ));
}

#[test]
fn the_iteration_limit_and_the_tolerance_are_the_callers() {
    let wave = wave();
    let with = |tolerance, max_iterations| {
        let options = DivisionOptions {
            tolerance,
            max_iterations,
            ..DivisionOptions::default()
        };
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
        assert!(matches!(
            with(tolerance, 100),
            Err(GeometryError::Tolerance { .. })
        ));
    }
}

#[test]
fn starts_that_do_not_rise_from_0_to_1_are_refused() {
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
    let far = profile(
        &[
            [1e9, 0.0],
            [1e9, 1e-3],
            [1e9 + 1e-3, 1e-3],
            [1e9 + 1e-3, 0.0],
        ],
        Closure::Open,
    );
    assert!(matches!(
        divide(&far, 10, &options),
        Err(GeometryError::SegmentTooShort { .. })
    ));
    let point = profile(&[[2.0, 1.0]; 4], Closure::Open);
    assert!(matches!(
        divide(&point, 1, &options),
        Err(GeometryError::SegmentTooShort { .. })
    ));
    let origin = profile(&[[0.0, 0.0]; 5], Closure::Open);
    assert!(matches!(
        divide(&origin, 3, &options),
        Err(GeometryError::SegmentTooShort { .. })
    ));
    assert!(matches!(
        divide(&wave(), 0, &options),
        Err(GeometryError::SegmentCount { .. })
    ));
    assert!(matches!(
        divide(&wave(), usize::MAX, &options),
        Err(GeometryError::SegmentCount { .. })
    ));
}

#[test]
fn a_profile_that_crosses_itself_is_refused_with_the_place() {
    // Bézier (−1,0) (2,2) (−2,2) (1,0): symmetric in x, so it crosses itself on x = 0.
    let looped = profile(
        &[[-1.0, 0.0], [2.0, 2.0], [-2.0, 2.0], [1.0, 0.0]],
        Closure::Open,
    );
    match divide(&looped, 9, &DivisionOptions::default()).unwrap_err() {
        GeometryError::CurveCrosses {
            parameters: [a, b],
            point,
        } => {
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
        divide(
            &profile(&points, Closure::Open),
            40,
            &DivisionOptions::default(),
        )
    };
    assert!(hairpin(1e-3).is_ok());
    assert!(hairpin(1e-2).is_ok());
    let crossed = [
        [0.0, 0.0],
        [3.0, 0.0],
        [6.0, 0.0],
        [9.0, 5e-4],
        [6.0, 1e-3],
        [3.0, 1e-3],
        [0.0, -1e-3],
    ];
    let refused = divide(
        &profile(&crossed, Closure::Open),
        40,
        &DivisionOptions::default(),
    );
    assert!(matches!(refused, Err(GeometryError::CurveCrosses { .. })));
}

#[test]
fn an_open_profile_whose_ends_meet_is_refused_and_accepted_once_it_is_called_closed() {
    let points = [
        [0.0, 0.0],
        [4.0, -1.0],
        [6.0, 2.0],
        [3.0, 5.0],
        [-2.0, 4.0],
        [0.0, 0.0],
    ];
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

/// A star-shaped loop: radii around a centre, so it never crosses itself for moderate radii.
fn radii() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(0.7..1.5, 6..14)
}

fn ring(radii: &[f64], turn: f64) -> Vec<[f64; 2]> {
    let step = turn / radii.len() as f64;
    radii
        .iter()
        .enumerate()
        .map(|(k, r)| (*r * DVec2::from_angle(step * k as f64)).to_array())
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn random_open_and_closed_profiles_are_divided_equally(
        radii in radii(), segments in 3usize..120,
        closure in prop::sample::select(&[Closure::Open, Closure::Corner, Closure::Smooth][..])
    ) {
        let turn = if closure == Closure::Open { 5.0 } else { std::f64::consts::TAU };
        let profile = profile(&ring(&radii, turn), closure);
        let division = match divide(&profile, segments, &DivisionOptions::default()) {
            Ok(division) => division,
            Err(GeometryError::CurveCrosses { .. } | GeometryError::PolygonCrosses { .. }) => return Err(TestCaseError::reject("crosses")),
            Err(other) => return Err(TestCaseError::fail(other.to_string())),
        };
        check_promises(&profile, &division);
        prop_assert!(division.converged(), "{:?} {}", division.ending, division.max_residual);
        prop_assert!(division.max_residual <= 1e-12, "{}", division.max_residual);
    }

    #[test]
    fn random_rising_starts_reach_equal_length_too(radii in radii(), gaps in prop::collection::vec(0.2..1.0, 8..30)) {
        let profile = profile(&ring(&radii, 4.0), Closure::Open);
        let total: f64 = gaps.iter().sum();
        let mut start = vec![0.0];
        let mut sum = 0.0;
        for gap in &gaps[..gaps.len() - 1] {
            sum += gap / total;
            start.push(sum);
        }
        start.push(1.0);
        let division = divide_from(&profile, &start, &DivisionOptions::default()).unwrap();
        check_promises(&profile, &division);
        prop_assert!(division.max_residual <= 1e-12, "{:?} {}", division.ending, division.max_residual);
    }

    #[test]
    fn any_control_points_give_a_division_or_an_error_and_never_hang(
        points in prop::collection::vec(prop::array::uniform2(-3.0..3.0), 4..10), segments in 1usize..60,
        closure in prop::sample::select(&[Closure::Open, Closure::Corner, Closure::Smooth][..])
    ) {
        let profile = profile(&points, closure);
        if let Ok(division) = divide(&profile, segments, &DivisionOptions::default()) {
            check_promises(&profile, &division);
        }
    }
}
