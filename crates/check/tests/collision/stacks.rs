//! Compact stacks of units: dozens of layers at zero distance.

use foldmotion_check::{CollisionOptions, CollisionReport, Verdict, collisions};
use foldmotion_pattern::{Case, Motion, Unit, UnitSheet};
use glam::DVec3;

use crate::sheets::motion;

fn judge(motion: &Motion) -> CollisionReport {
    collisions(motion, &CollisionOptions::default(), &|_| true).unwrap()
}

fn units() -> Vec<UnitSheet> {
    let sheet = |case, width, lambda| {
        let unit = Unit::new(case, width, 1.0, lambda, None).unwrap();
        UnitSheet::new(unit, 3, 2).unwrap()
    };
    vec![
        sheet(Case::E, 1.0, None),
        sheet(Case::T, 0.7, None),
        sheet(Case::S, 1.6, None),
        sheet(Case::SII, 1.6, Some(0.7)),
    ]
}

/// Positions with deterministic noise of at most `size` in each coordinate.
fn shaken(positions: &[DVec3], frame: u32, size: f64) -> Vec<DVec3> {
    let shake = |(i, p): (usize, &DVec3)| {
        let phase = i as f64 * 12.9898 + f64::from(frame) * 78.233;
        let noise = |k: f64| ((phase + k).sin() * 43_758.545_3).fract();
        *p + DVec3::new(noise(0.1), noise(0.2), noise(0.3)) * size
    };
    positions.iter().enumerate().map(shake).collect()
}

#[test]
fn the_exact_compact_states_touch_also_when_shaken_by_less_than_the_tolerance() {
    for units in units() {
        let compact = units.compact();
        let still = judge(&motion(units.sheet.clone(), [compact.clone()]));
        assert_eq!(still.verdict, Verdict::Touching, "{:?}", still.first);
        assert!(still.touching_pairs > 20);
        let states = (0..6).map(|k| shaken(&compact, k, 1e-7));
        let report = judge(&motion(units.sheet.clone(), states));
        assert_eq!(report.verdict, Verdict::Touching, "{:?}", report.first);
        assert_eq!(report.min_separation.unwrap().distance, 0.0);
    }
}

#[test]
fn compact_states_shaken_by_much_more_than_the_tolerance_penetrate() {
    for units in units() {
        let compact = units.compact();
        let states = (0..3).map(|k| shaken(&compact, k, 1e-3));
        let report = judge(&motion(units.sheet.clone(), states));
        assert_eq!(report.verdict, Verdict::Penetrating);
        assert!(report.undecided.is_empty(), "{:?}", report.undecided);
        let deepest = report.penetrations.iter().map(|p| p.depth);
        assert!(deepest.fold(0.0, f64::max) > 1e-4);
    }
}

#[test]
fn the_planar_state_is_free() {
    for units in units() {
        let report = judge(&motion(units.sheet.clone(), [units.sheet.planar()]));
        assert_eq!(report.verdict, Verdict::Free, "{:?}", report.first);
    }
}
