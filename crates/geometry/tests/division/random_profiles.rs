//! Divisions of random profiles.

use foldmotion_geometry::{Closure, DivisionOptions, GeometryError, divide, divide_from};
use glam::DVec2;
use proptest::prelude::*;

use crate::{check_promises, profile};

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
