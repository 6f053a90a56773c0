//! The certificate of the uniform motion.

use std::f64::consts::PI;

use foldmotion_geometry::first_crossing;
use foldmotion_geometry::unfolding::{Chain, SweepVerdict, certify};
use proptest::prelude::*;

use crate::chains::{airfoil, closed, fermat_spiral, omega, open, scaled, star};

fn uniform(chain: &Chain) -> SweepVerdict {
    certify(chain, chain.turns(), &scaled(chain, 0.0))
}

fn crosses_at(chain: &Chain, fraction: f64) -> bool {
    first_crossing(&chain.points(&scaled(chain, fraction)), false).is_some()
}

#[test]
fn a_fermat_spiral_scaled_down_crosses_itself_first_where_dense_sampling_finds_it() {
    let chain = open(&fermat_spiral(50));
    let SweepVerdict::Crosses { fraction, segments } = uniform(&chain) else {
        panic!("{:?}", uniform(&chain));
    };
    let deployed = 1.0 - fraction;
    assert!((deployed - 0.85).abs() < 0.02, "{deployed}");
    assert!(crosses_at(&chain, deployed - 1e-7), "{segments:?}");
    for k in 0..400 {
        let before = 1.0 + (deployed + 1e-7 - 1.0) * f64::from(k) / 399.0;
        assert!(!crosses_at(&chain, before), "{before}");
    }
    // The last crossing: the chain is clear from there on.
    let last = (0..1000)
        .map(|k| f64::from(k) / 1000.0)
        .rfind(|&f| (f < 0.8) && !crosses_at(&chain, f) && crosses_at(&chain, f + 1e-3));
    let clear = last.unwrap();
    assert!((clear - 0.34).abs() < 0.02, "{clear}");
    let tail = certify(&chain, &scaled(&chain, clear), &scaled(&chain, 0.0));
    assert_eq!(tail, SweepVerdict::Clear);
}

#[test]
fn airfoils_circles_and_omegas_unfold_uniformly() {
    for half in [3, 10, 40] {
        assert_eq!(uniform(&closed(&airfoil(half))), SweepVerdict::Clear, "{half}");
    }
    for count in [3, 4, 7, 40, 200] {
        let circle = closed(&star(&vec![1.0; count]));
        assert_eq!(uniform(&circle), SweepVerdict::Clear, "{count}");
    }
    for rows in [9, 14, 60] {
        assert_eq!(uniform(&open(&omega(rows))), SweepVerdict::Clear, "{rows}");
    }
}

#[test]
fn a_sweep_to_a_fold_of_a_half_turn_is_not_clear() {
    let straight = open(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]].map(Into::into));
    assert_eq!(certify(&straight, &[0.0], &[3.1]), SweepVerdict::Clear);
    for end in [PI, -PI, 4.0] {
        let verdict = certify(&straight, &[0.0], &[end]);
        assert!(matches!(verdict, SweepVerdict::Undecided { .. }), "{end}");
    }
}

#[test]
fn a_square_whose_ends_move_into_each_other_is_not_clear() {
    let square = closed(&star(&[1.0; 4]));
    let inwards: Vec<f64> = square.turns().iter().map(|t| t * 1.1).collect();
    let verdict = certify(&square, square.turns(), &inwards);
    assert_ne!(verdict, SweepVerdict::Clear);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn no_sample_of_a_clear_sweep_crosses_and_a_crossing_one_crosses_where_it_says(
        from in prop::collection::vec(-1.2..1.2f64, 3..14),
        to in prop::collection::vec(-1.2..1.2f64, 14),
    ) {
        let points: Vec<_> = (0..from.len() + 2).map(|k| [k as f64, 0.0].into()).collect();
        let chain = open(&points);
        prop_assume!(first_crossing(&chain.points(&from), false).is_none());
        let to = &to[..from.len()];
        let crosses = |fraction: f64| {
            let turns: Vec<f64> = from.iter().zip(to).map(|(a, b)| a + (b - a) * fraction).collect();
            first_crossing(&chain.points(&turns), false).is_some()
        };
        let (clear_until, met) = match certify(&chain, &from, to) {
            SweepVerdict::Clear => (1.0, None),
            SweepVerdict::Crosses { fraction, .. } => (fraction - 1e-5, Some(fraction)),
            SweepVerdict::Undecided { fraction, .. } => (fraction, None),
        };
        for k in 0..=300 {
            let fraction = clear_until * f64::from(k) / 300.0;
            prop_assert!(!crosses(fraction), "{fraction}");
        }
        if let Some(met) = met {
            prop_assert!(crosses(met) || crosses((met + 1e-9).min(1.0)));
        }
    }
}
