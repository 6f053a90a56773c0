//! Straightening by energy.

use foldmotion_geometry::unfolding::{Chain, SweepVerdict, TurnPath, certify, straighten};
use foldmotion_geometry::{GeometryError, first_crossing};
use glam::DVec2;
use proptest::prelude::*;

use crate::chains::{airfoil, closed, fermat_spiral, omega, open, star};

/// Straightens a chain and checks everything the path promises: its ends, its progress, a certificate of every piece,
/// and an exact test of dense samples.
fn straightened(chain: &Chain) -> TurnPath {
    let path = straighten(chain).unwrap();
    assert_eq!(path.turns[0], chain.turns());
    assert!(path.turns.last().unwrap().iter().all(|&t| t == 0.0));
    assert_eq!((path.progress[0], *path.progress.last().unwrap()), (0.0, 1.0));
    assert!(path.progress.windows(2).all(|p| p[0] < p[1]));
    for (index, piece) in path.turns.windows(2).enumerate() {
        assert_eq!(certify(chain, &piece[0], &piece[1]), SweepVerdict::Clear, "piece {index}");
    }
    for k in 0..=500 {
        let points = chain.points(&path.at(f64::from(k) / 500.0));
        let is_start = k == 0 && chain.is_closed();
        assert!(is_start || first_crossing(&points, false).is_none(), "sample {k}");
    }
    path
}

#[test]
fn a_fermat_spiral_is_straightened_without_a_crossing() {
    let path = straightened(&open(&fermat_spiral(50)));
    assert!((20..2000).contains(&path.steps), "{}", path.steps);
    assert!(path.turns.len() <= 40, "{}", path.turns.len());
}

#[test]
fn closed_profiles_open_at_their_seam_and_straighten() {
    for chain in [airfoil(4), airfoil(20), star(&[1.0; 3]), star(&[1.0; 30])] {
        straightened(&closed(&chain));
    }
    let gear: Vec<f64> = (0..60).map(|k| if k % 10 < 5 { 1.0 } else { 0.6 }).collect();
    straightened(&closed(&star(&gear)));
    straightened(&open(&omega(40)));
}

#[test]
fn a_chain_that_is_straight_or_one_segment_is_a_path_of_its_ends() {
    for count in [2, 3, 5] {
        let points: Vec<DVec2> = (0..count).map(|k| DVec2::X * f64::from(k)).collect();
        let path = straightened(&open(&points));
        assert_eq!((path.turns.len(), path.steps), (2, 0));
    }
}

#[test]
fn the_path_is_the_same_for_a_chain_moved_and_opposite_for_one_reflected() {
    let largest_difference = |points: &[DVec2], place: &dyn Fn(DVec2) -> DVec2, sign: f64| {
        let path = straightened(&open(points));
        let moved: Vec<DVec2> = points.iter().map(|&p| place(p)).collect();
        let other = straightened(&open(&moved));
        let differences = (0..=20).flat_map(|k| {
            let progress = f64::from(k) / 20.0;
            let pairs = path.at(progress).into_iter().zip(other.at(progress));
            pairs.map(|(a, b)| (a - sign * b).abs()).collect::<Vec<_>>()
        });
        differences.fold(0.0, f64::max)
    };
    let spiral = fermat_spiral(30);
    // Exact in f64: the results are identical.
    assert_eq!(largest_difference(&spiral, &|p| 2.0 * p.perp(), 1.0), 0.0);
    let reflected = |p: DVec2| DVec2::new(p.x, -p.y);
    assert_eq!(largest_difference(&spiral, &reflected, -1.0), 0.0);
    // Rounded: the descent amplifies small differences as long as it lasts.
    let moved = |p: DVec2| 3.0 * DVec2::from_angle(1.0).rotate(p) + DVec2::ONE;
    let difference = largest_difference(&omega(20), &moved, 1.0);
    assert!(difference < 1e-6, "{difference}");
}

#[test]
fn chains_that_cross_or_touch_themselves_are_refused_with_their_segments() {
    let loops =
        |z: f64| [[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [1.0, 2.0], [1.0, z]].map(DVec2::from);
    for z in [-1.0, 0.0] {
        match Chain::new(&loops(z), false) {
            Err(GeometryError::PolygonCrosses { segments, .. }) => assert_eq!(segments, [0, 3]),
            other => panic!("{other:?}"),
        }
    }
    assert!(Chain::new(&loops(1e-3), false).is_ok());
    assert!(Chain::new(&star(&[1.0; 8]), false).is_err(), "closed, but not said to be");
    assert!(matches!(
        Chain::new(&[DVec2::ZERO; 1], false),
        Err(GeometryError::SegmentCount { count: 0, .. })
    ));
    assert!(matches!(
        Chain::new(&[DVec2::ZERO, DVec2::X, DVec2::X], false),
        Err(GeometryError::RepeatedPoint { index: 1, .. })
    ));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn every_random_chain_that_does_not_cross_itself_is_straightened(
        turns in prop::collection::vec(-2.0..2.0f64, 4..24)
    ) {
        // As much of it as does not cross, and slightly away from it.
        let mut points = vec![DVec2::ZERO];
        let mut heading = 0.0;
        for turn in turns {
            let last = points[points.len() - 1];
            points.push(last + DVec2::from_angle(heading));
            heading += turn;
            if first_crossing(&points, false).is_some() {
                points.pop();
                break;
            }
        }
        prop_assume!(points.len() > 3);
        straightened(&open(&points));
    }
}
