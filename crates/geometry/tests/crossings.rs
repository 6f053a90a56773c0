//! Crossings of polylines compared with brute force, and cases built by hand.

use foldmotion_geometry::first_crossing;
use glam::DVec2;
use proptest::prelude::*;

fn crosses(points: &[[f64; 2]], closed: bool) -> bool {
    let points: Vec<_> = points.iter().copied().map(DVec2::from).collect();
    first_crossing(&points, closed).is_some()
}

#[test]
fn a_crossing_is_reported_with_its_segments_and_point() {
    let points = [[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [1.0, 2.0], [1.0, -1.0]].map(DVec2::from);
    let crossing = first_crossing(&points, false).unwrap();
    assert_eq!(crossing.segments, [0, 3]);
    assert_eq!(crossing.point, DVec2::new(1.0, 0.0));
}

#[test]
fn touching_counts_and_the_smallest_gap_does_not() {
    let touching = |z: f64| [[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [1.0, 2.0], [1.0, z]];
    assert!(crosses(&touching(0.0), false));
    assert!(!crosses(&touching(1e-300), false));
    assert!(crosses(&touching(-1e-300), false));
}

#[test]
fn neighbours_may_bend_but_not_fold_back() {
    assert!(!crosses(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]], false));
    assert!(!crosses(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1e-16]], false));
    assert!(crosses(&[[0.0, 0.0], [1.0, 0.0], [0.5, 0.0]], false));
    assert!(crosses(&[[0.0, 0.0], [0.0, 1.0], [0.0, -3.0]], false));
    assert!(crosses(&[[0.1, 0.1], [0.3, 0.3], [0.2, 0.2]], false));
}

#[test]
fn collinear_strands_that_overlap_cross() {
    let back = |x: f64| [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [x, 1.0], [x, 0.0], [x - 0.5, 0.0]];
    assert!(crosses(&back(1.25), false));
    assert!(!crosses(&[[0.0, 0.0], [1.0, 0.0], [1.5, 1.0], [2.0, 0.0], [3.0, 0.0]], false));
    assert!(crosses(
        &[[0.0, 0.0], [1.0, 0.0], [1.5, 1.0], [0.5, 1.0], [0.5, 0.0], [0.75, 0.0]],
        false
    ));
}

#[test]
fn a_closed_polygon_may_meet_itself_at_its_start_only() {
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]];
    assert!(!crosses(&square, true));
    assert!(crosses(&square, false));
    assert!(crosses(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [2.0, 0.0], [0.0, 0.0]], true));
    assert!(!crosses(&[[0.0, 0.0], [1.0, 0.0], [0.5, 1.0], [0.0, 0.0]], true));
}

#[test]
fn short_polylines_do_not_cross() {
    assert!(!crosses(&[], false));
    assert!(!crosses(&[[0.0, 0.0]], true));
    assert!(!crosses(&[[0.0, 0.0], [1.0, 0.0]], false));
}

#[test]
fn a_long_double_spiral_is_simple_until_one_point_is_moved_across() {
    let mut points: Vec<_> = (0..100_000)
        .map(|k| {
            let angle = 1.0 + f64::from(k) * 2e-3;
            angle * DVec2::from_angle(angle)
        })
        .collect();
    assert_eq!(first_crossing(&points, false), None);
    points[60_000] *= 1.06;
    let crossing = first_crossing(&points, false).unwrap();
    assert!(crossing.segments.iter().any(|s| (59_999..=60_000).contains(s)), "{crossing:?}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn the_tree_finds_a_crossing_exactly_where_brute_force_does(
        // Integers make touching and collinear cases common, and plain f64 exact.
        points in prop::collection::vec((0i32..40, 0i32..40), 2..14)
    ) {
        let mut points: Vec<_> = points.into_iter().map(|(x, z)| DVec2::new(f64::from(x), f64::from(z))).collect();
        points.dedup();
        let found = first_crossing(&points, false);
        prop_assert_eq!(found.is_some(), brute_force(&points));
    }
}

/// Segment pairs in rational arithmetic on integers: they share a point if the 2 × 2 system has a solution in [0, 1]².
fn brute_force(points: &[DVec2]) -> bool {
    let segments: Vec<_> = points.windows(2).map(|p| (p[0], p[1])).collect();
    (0..segments.len()).any(|i| {
        (i + 1..segments.len()).any(|j| {
            let ((a, b), (c, d)) = (segments[i], segments[j]);
            let (along, across, between) = (b - a, d - c, c - a);
            let determinant = along.perp_dot(across);
            if j == i + 1 {
                return determinant == 0.0 && along.dot(across) < 0.0;
            }
            if determinant != 0.0 {
                let (s, t) = (between.perp_dot(across), between.perp_dot(along));
                let inside =
                    |x: f64| (x * determinant.signum()) >= 0.0 && x.abs() <= determinant.abs();
                return inside(s) && inside(t);
            }
            let (from, to) = (between.dot(along), (d - a).dot(along));
            between.perp_dot(along) == 0.0
                && from.max(to) >= 0.0
                && from.min(to) <= along.length_squared()
        })
    })
}
