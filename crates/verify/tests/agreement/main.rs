//! The second proof against the first.
#![expect(clippy::unwrap_used, reason = "a test stops where a value is missing")]
#![expect(
    clippy::disallowed_methods,
    clippy::disallowed_types,
    reason = "the tests compare the two proofs"
)]

mod edges;
mod layers;
#[path = "../../../check/tests/collision/sheets.rs"]
mod sheets;
mod stopping;

use std::f64::consts::PI;

use foldmotion_check::{CollisionOptions, CollisionReport, Verdict, collisions};
use foldmotion_pattern::{Case, Motion, Unit, UnitSheet};
use foldmotion_random::Random;
use foldmotion_verify::verify;
use glam::{DVec2, DVec3};
use sheets::{accordion, fold, motion, sheet};

fn judge(motion: &Motion) -> CollisionReport {
    collisions(motion, &CollisionOptions::default(), &|_| true).unwrap()
}

/// Checks that both proofs agree on a motion and returns the verdict.
fn agreed(motion: &Motion) -> Verdict {
    let report = judge(motion);
    let verification = verify(motion, &report);
    assert!(
        verification.is_verified(),
        "{:?}, {} touch, {} penetrate, {:?}: {verification:#?}",
        report.verdict,
        report.touching_pairs,
        report.penetrations.len(),
        report.min_separation
    );
    report.verdict
}

#[test]
fn sheets_of_every_kind_get_the_same_verdict_twice() {
    let channel = [1.8, 0.0, -1.8];
    let through: [&[f64]; 3] = [&[0.0; 4], &[0.0, 1.9, 3.3, 4.2], &[0.0, 1.9, 4.0, 5.0]];
    let ring: Vec<_> = (0..6).map(|k| f64::from(k) * PI / 3.0).collect();
    let cases = [
        (fold(3, &[&[0.0; 3], &channel, &[0.0; 3]], 7), Verdict::Free),
        (fold(4, &through, 12), Verdict::Penetrating),
        (fold(6, &[&ring, &[0.0; 6]], 10), Verdict::Touching),
        (accordion(8, 2, 20, 1e-3, 0.7), Verdict::Free),
        (accordion(8, 2, 20, 0.0, 0.7), Verdict::Touching),
        (accordion(8, 2, 20, -1e-3, 0.7), Verdict::Penetrating),
        (fold(2, &[&[0.0, 0.0], &[0.0, PI]], 20), Verdict::Touching),
        (fold(2, &[&[0.0, 0.0], &[0.0, PI + 0.01]], 20), Verdict::Penetrating),
    ];
    for (k, (motion, expected)) in cases.into_iter().enumerate() {
        println!("case {k}");
        assert_eq!(agreed(&motion), expected);
    }
}

#[test]
fn compact_stacks_touch_in_both_proofs() {
    let compact = |case, width, lambda| {
        let unit = Unit::new(case, width, 1.0, lambda, None).unwrap();
        let units = UnitSheet::new(unit, 3, 2).unwrap();
        let state = units.compact();
        motion(units.sheet, [state.clone(), state])
    };
    for (case, width, lambda) in [
        (Case::E, 1.0, None),
        (Case::T, 0.7, None),
        (Case::S, 1.6, None),
        (Case::SII, 1.6, Some(0.7)),
    ] {
        assert_eq!(agreed(&compact(case, width, lambda)), Verdict::Touching);
    }
}

#[test]
fn counts_of_work_are_not_part_of_the_statement_but_the_verdict_is() {
    let free = fold(3, &[&[0.0; 3], &[1.8, 0.0, -1.8], &[0.0; 3]], 7);
    let touching = accordion(8, 2, 20, 0.0, 0.7);
    for (motion, lie) in [(free, Verdict::Touching), (touching, Verdict::Free)] {
        let mut claim = judge(&motion);
        claim.touching_pairs += 1000;
        claim.pairs_tested.disjoint = 0;
        claim.decided_by.search += 7;
        assert!(verify(&motion, &claim).is_verified());
        claim.verdict = lie;
        let refuted = verify(&motion, &claim).refuted;
        assert!(refuted.iter().any(|r| r.field == "verdict"), "{lie:?}");
    }
}

/// Two triangles that tumble, sharing `shared` vertices.
fn tumbling(random: &mut Random, shared: u32) -> Motion {
    let vertices = (0..6 - shared).map(|k| DVec2::new(f64::from(k), f64::from(k * k)));
    let b = [[3, 4, 5], [0, 3, 4], [1, 0, 3]][shared as usize];
    let sheet = sheet(vertices.collect(), vec![[0, 1, 2], b]);
    let count = sheet.vertices.len();
    let start: Vec<DVec3> = (0..count).map(|_| random.vector()).collect();
    let shift = random.vector() * 0.8;
    let states = (0..4).map(|k| {
        let moved = |(i, p): (usize, &DVec3)| {
            let shift = if i > 2 { shift * f64::from(k) } else { DVec3::ZERO };
            *p + random.vector() * 0.25 + shift
        };
        start.iter().enumerate().map(moved).collect::<Vec<_>>()
    });
    let states: Vec<_> = states.collect();
    motion(sheet, states)
}

#[test]
fn both_proofs_agree_on_a_thousand_tumbling_pairs() {
    let mut random = Random::new(77);
    let mut counts = [[0; 2]; 3];
    for k in 0..1200 {
        let shared = k % 3;
        let motion = tumbling(&mut random, shared);
        println!("pair {k}");
        let verdict = agreed(&motion);
        counts[shared as usize][usize::from(verdict == Verdict::Penetrating)] += 1;
    }
    println!("{counts:?}");
    assert!(counts.iter().flatten().all(|&n| n >= 20), "{counts:?}");
}
