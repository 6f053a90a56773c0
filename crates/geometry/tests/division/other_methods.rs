//! Division by other methods, and how well a division fits its profile.

use foldmotion_geometry::{
    Closure, DivisionMethod, DivisionOptions, Ending, GeometryError, divide, simplify,
};

use crate::{check_promises, equal, profile, wave};

#[test]
fn parametric_division_is_even_in_the_parameter() {
    let wave = wave();
    let options =
        DivisionOptions { method: DivisionMethod::Parametric, ..DivisionOptions::default() };
    let division = divide(&wave, 8, &options).unwrap();
    check_promises(&wave, &division);
    assert_eq!(division.parameters, [0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0]);
    assert_eq!(division.ending, Ending::Direct);
    assert!(division.max_residual > 0.1, "the wave is not run through evenly");
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
            let options = DivisionOptions { method, ..DivisionOptions::default() };
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
    assert!((fit.mean - 2.0 / 3.0 * sagitta).abs() < 0.01 * sagitta, "{fit:?}");
}

#[test]
fn tolerances_that_leave_one_segment_and_numbers_that_cannot_be_told_apart_are_refused() {
    assert!(matches!(
        simplify(&wave(), 0.9),
        Err(GeometryError::TooCoarse { segments: 1, minimum: 2, .. })
    ));
    for tolerance in [0.0, -1.0, f64::NAN, 1.0] {
        assert!(matches!(simplify(&wave(), tolerance), Err(GeometryError::SplitTolerance { .. })));
    }
    let line = profile(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]], Closure::Open);
    let options =
        DivisionOptions { method: DivisionMethod::DouglasPeucker, ..DivisionOptions::default() };
    assert!(matches!(
        divide(&line, 4, &options),
        Err(GeometryError::NothingToSplit { count: 4, possible: 1 })
    ));
}
