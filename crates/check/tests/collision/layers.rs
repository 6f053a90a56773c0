//! The order of coincident layers: exact stacks, swapped layers, claims and rules.

use std::f64::consts::PI;

use foldmotion_check::{
    Checker, CollisionOptions, CollisionReport, LayerProof, LayerRule, PenetrationKind, Verdict,
};
use foldmotion_pattern::{Case, Frame, LayerOrder, Sheet, Unit, UnitSheet};
use glam::DVec3;

use crate::sheets::{fold, folded, strip};

fn unit_sheet(
    case: Case,
    width: f64,
    lambda: Option<f64>,
    rows: usize,
    columns: usize,
) -> UnitSheet {
    let unit = Unit::new(case, width, 1.0, lambda, None).unwrap();
    UnitSheet::new(unit, rows, columns).unwrap()
}

fn cases(rows: usize, columns: usize) -> Vec<UnitSheet> {
    vec![
        unit_sheet(Case::E, 1.0, None, rows, columns),
        unit_sheet(Case::T, 0.7, None, rows, columns),
        unit_sheet(Case::S, 1.6, None, rows, columns),
        unit_sheet(Case::SII, 1.6, Some(0.7), rows, columns),
    ]
}

/// Judges states, each with the claims made there.
fn judge(sheet: &Sheet, states: &[(Vec<DVec3>, LayerOrder)]) -> (CollisionReport, LayerOrder) {
    let mut checker: Option<Checker<'_>> = None;
    for (k, (positions, claims)) in states.iter().enumerate() {
        let frame = Frame { time: k as f64, positions: positions.clone() };
        if let Some(checker) = &mut checker {
            checker.advance(&frame).unwrap();
        } else {
            let options = CollisionOptions::default();
            checker = Some(Checker::new(sheet, &frame, &options).unwrap());
        }
        let checker = checker.as_mut().unwrap();
        checker.claim(claims, &|face| face).unwrap();
    }
    let checker = checker.unwrap();
    let order = checker.layer_order();
    (checker.finish(), order)
}

fn judge_state(units: &UnitSheet, claims: &LayerOrder) -> CollisionReport {
    judge(&units.sheet, &[(units.compact(), claims.clone())]).0
}

/// The order with f and g exchanged.
fn with_pair_swapped(order: &LayerOrder, f: u32, g: u32) -> LayerOrder {
    let mut swapped = order.clone();
    for (f, g) in [(f, g), (g, f)] {
        if let Some(sign) = order.sign(f, g) {
            swapped.insert(f, g, -sign);
        }
    }
    swapped
}

#[test]
fn the_exact_compact_states_are_proved_in_their_exact_order() {
    for units in cases(3, 2) {
        let order = units.compact_order();
        let report = judge_state(&units, &order);
        assert_eq!(report.verdict, Verdict::Touching, "{:?}", report.first);
        assert!(report.clusters.iter().all(|c| c.order == LayerProof::Proved));
        assert_eq!((report.claims.claimed, report.claims.ignored), (order.len(), 0));
        let pairs: usize = report.clusters.iter().map(|c| c.pairs).sum();
        assert_eq!(2 * pairs, order.len(), "{:?}", units.unit.case);
        // Without claims, only the orders of creases folded flat are known.
        let report = judge_state(&units, &LayerOrder::default());
        assert_eq!(report.verdict, Verdict::Touching, "{:?}", report.first);
        assert!(report.clusters.iter().any(|c| c.order == LayerProof::Unproved));
    }
}

#[test]
fn every_kind_of_rule_is_tested_in_the_compact_states() {
    let mut most = foldmotion_check::RuleCounts::default();
    for units in cases(3, 2) {
        for c in judge_state(&units, &units.compact_order()).clusters {
            most.taco_taco = most.taco_taco.max(c.rules.taco_taco);
            most.taco_tortilla = most.taco_tortilla.max(c.rules.taco_tortilla);
            most.tortilla_tortilla = most.tortilla_tortilla.max(c.rules.tortilla_tortilla);
            most.bent = most.bent.max(c.rules.bent);
            most.crease = most.crease.max(c.rules.crease);
            assert_eq!(c.rules.transitivity, c.pairs as u64);
        }
    }
    let all = [most.taco_taco, most.taco_tortilla, most.tortilla_tortilla, most.bent, most.crease];
    assert!(all.iter().all(|&n| n > 0), "{most:?}");
}

/// Pairs of layers with nothing between them: no third layer is above one and below the other.
fn adjacent_pairs(units: &UnitSheet, order: &LayerOrder) -> Vec<(u32, u32)> {
    let positions = units.compact();
    let normal = |f: u32| {
        let [a, b, c] = units.sheet.faces[f as usize].map(|v| positions[v as usize]);
        (b - a).cross(c - a)
    };
    // Above along one normal for both, that of g.
    let is_above = |f: u32, g: u32, up: DVec3| {
        order.sign(f, g).map(|s| f64::from(s) * normal(g).dot(up) > 0.0)
    };
    let faces = 0..units.sheet.faces.len() as u32;
    let pairs = order.iter().filter(|&(f, g, _)| f < g);
    pairs
        .map(|(f, g, _)| (f, g))
        .filter(|&(f, g)| {
            let up = normal(g) * f64::from(order.sign(f, g).unwrap());
            !faces
                .clone()
                .any(|k| is_above(k, g, up) == Some(true) && is_above(f, k, up) == Some(true))
        })
        .collect()
}

#[test]
fn every_swap_of_two_adjacent_layers_of_a_compact_state_is_refused() {
    for units in cases(2, 2) {
        let order = units.compact_order();
        let swaps = adjacent_pairs(&units, &order);
        assert!(swaps.len() > 10);
        let mut missed = Vec::new();
        for &(f, g) in &swaps {
            let report = judge_state(&units, &with_pair_swapped(&order, f, g));
            let is_named = report.penetrations.iter().any(|p| {
                let conflict = p.conflict.as_ref().unwrap();
                p.kind == PenetrationKind::LayerOrder
                    && conflict.faces.contains(&f)
                    && conflict.faces.contains(&g)
            });
            if report.verdict != Verdict::Penetrating || !is_named {
                missed.push((f, g));
            }
        }
        assert!(missed.is_empty(), "{:?}: {missed:?} of {}", units.unit.case, swaps.len());
    }
}

/// A strip of `n` squares rolled or zigzagged flat.
fn flat_fold(n: u32, signs: &[f64]) -> foldmotion_pattern::Motion {
    let mut directions = vec![0.0];
    for sign in signs {
        directions.push(directions[directions.len() - 1] + sign * PI);
    }
    fold(n, &[&vec![0.0; n as usize], &directions], 24)
}

#[test]
fn the_order_follows_from_the_motion_and_outlives_contact() {
    let motion = flat_fold(2, &[1.0]);
    let states: Vec<_> =
        motion.frames.iter().map(|f| (f.positions.clone(), LayerOrder::default())).collect();
    let (report, order) = judge(&motion.sheet, &states);
    assert_eq!(report.verdict, Verdict::Touching);
    // A valley: each square lies on the front of the other. All four pairs of halves overlap, but the two that share a
    // side beside the diagonal only touch there.
    assert!(order.iter().all(|(_, _, sign)| sign == 1) && order.len() >= 6, "{order:?}");
    assert_eq!(report.clusters.len(), 1);
    let cluster = &report.clusters[0];
    assert_eq!((cluster.frames, cluster.layers), ([24, 24], 2));
    assert_eq!(cluster.order, LayerProof::Proved);
}

#[test]
fn a_claim_against_the_motion_is_a_penetration_that_names_the_pair() {
    let motion = flat_fold(2, &[1.0]);
    let mut states: Vec<_> =
        motion.frames.iter().map(|f| (f.positions.clone(), LayerOrder::default())).collect();
    let mut claims = LayerOrder::default();
    claims.insert(1, 3, -1);
    states[24].1 = claims.clone();
    let (report, _) = judge(&motion.sheet, &states);
    assert_eq!(report.verdict, Verdict::Penetrating);
    let first = report.first.unwrap();
    assert_eq!((first.faces, first.kind), ([1, 3], PenetrationKind::LayerOrder));
    assert_eq!(first.conflict.unwrap().rule, LayerRule::Claim);
    assert_eq!((first.time, first.frame, first.depth), (24.0, 24, 0.0));
    // Before the layers meet, the same claim is about no layers, and counted as ignored.
    states.truncate(12);
    states[11].1 = claims;
    let (report, _) = judge(&motion.sheet, &states);
    assert_eq!(report.verdict, Verdict::Free);
    assert_eq!((report.claims.claimed, report.claims.ignored), (1, 1));
}

#[test]
fn a_claim_at_the_first_frame_decides_the_side_from_then_on() {
    let plates = crate::sheets::sheet(
        [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (5.0, 0.0), (5.5, 0.0), (5.0, 0.5)]
            .map(glam::DVec2::from)
            .to_vec(),
        vec![[0, 1, 2], [3, 4, 5]],
    );
    let at = |z: f64| {
        let lower = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let upper = lower.map(|p| p * 0.5 + DVec3::new(0.1, 0.1, z));
        [lower, upper].concat()
    };
    let mut above = LayerOrder::default();
    above.insert(1, 0, 1);
    let none = LayerOrder::default();
    // 5e-7 below is within the tolerance: a square claimed to be above may not leave below.
    for start in [0.0, 5e-7, -5e-7] {
        for (end, verdict) in [(0.2, Verdict::Touching), (-0.2, Verdict::Penetrating)] {
            let claimed = [(at(start), above.clone()), (at(end), none.clone())];
            assert_eq!(judge(&plates, &claimed).0.verdict, verdict, "{start} {end}");
        }
    }
}

#[test]
fn a_square_folded_into_another_pocket_cannot_be_claimed_between_its_layers() {
    // Three squares rolled up: 0 at the bottom, 2 inside the pocket of 0 and 1, or above both in a zigzag.
    let sheet = strip(3, 1);
    let rolled = folded(&sheet, &[0.0, PI, 2.0 * PI]);
    let claims = |levels: [i32; 3]| {
        let mut order = LayerOrder::default();
        let facing = [1, -1, 1];
        for f in 0..6_u32 {
            for g in (0..6_u32).filter(|g| f / 2 != g / 2) {
                let (a, b) = (f as usize / 2, g as usize / 2);
                order.insert(f, g, facing[b] * if levels[a] > levels[b] { 1 } else { -1 });
            }
        }
        order
    };
    let verdict = |levels| judge(&sheet, &[(rolled.clone(), claims(levels))]).0;
    // All creases are valleys: square 1 lies above 0, square 2 below 1.
    for levels in [[0, 2, 1], [1, 2, 0]] {
        assert_eq!(verdict(levels).verdict, Verdict::Touching, "{levels:?}");
    }
    for levels in [[0, 1, 2], [2, 1, 0], [1, 0, 2], [2, 0, 1]] {
        let report = verdict(levels);
        let rules = report.penetrations.iter().map(|p| p.conflict.as_ref().unwrap().rule);
        let is_named = rules.clone().any(|rule| rule == LayerRule::Crease);
        assert!(is_named && report.verdict == Verdict::Penetrating, "{levels:?}");
    }
}

#[test]
fn the_order_followed_from_a_motion_does_not_depend_on_threads() {
    let motion = flat_fold(5, &[1.0, -1.0, 1.0, -1.0]);
    let states: Vec<_> =
        motion.frames.iter().map(|f| (f.positions.clone(), LayerOrder::default())).collect();
    let expected = judge(&motion.sheet, &states);
    assert_eq!(expected.0.verdict, Verdict::Touching, "{:?}", expected.0.first);
    assert_eq!(expected.0.clusters[0].layers, 5);
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool.install(|| judge(&motion.sheet, &states)), expected);
    }
}

/// Two unit squares one above the other, `gap` apart; the front of the second faces up.
fn two_squares(gap: f64) -> (Sheet, Vec<DVec3>) {
    let mut sheet = strip(3, 1);
    // Without the square between them.
    let faces = [sheet.faces[0], sheet.faces[1], sheet.faces[4], sheet.faces[5]];
    let corner = |v: usize, x: f64, z: f64| DVec3::new(x, sheet.vertices[v].y, z);
    let mut positions: Vec<DVec3> = (0..8).map(|v| corner(v, 0.0, 0.0)).collect();
    for (v, x, z) in [(0, 0.0, 0.0), (2, 1.0, 0.0), (4, 0.0, gap), (6, 1.0, gap)] {
        for v in [v, v + 1] {
            positions[v] = corner(v, x, z);
        }
    }
    sheet = crate::sheets::sheet(sheet.vertices.clone(), faces.to_vec());
    (sheet, positions)
}

#[test]
fn claims_about_facets_a_gap_apart_are_compared_with_where_they_are() {
    let claimed = |gap: f64, sign: i8| {
        let (sheet, positions) = two_squares(gap);
        let (time, options) = (0.0, CollisionOptions::default());
        let frame = Frame { time, positions };
        let mut checker = Checker::new(&sheet, &frame, &options).unwrap();
        let mut order = LayerOrder::default();
        order.insert(2, 0, sign);
        let heard = checker.claim(&order, &|face| face);
        heard.map(|()| checker.finish().claims)
    };
    let claims = claimed(1e-3, 1).unwrap();
    assert_eq!((claims.claimed, claims.ignored), (1, 0));
    let error = claimed(1e-3, -1).unwrap_err().to_string();
    assert!(error.contains("faceOrders has [2, 0, -1] at frame 0"), "{error}");
    // Far apart they are not layers of one stack.
    for sign in [1, -1] {
        let claims = claimed(0.5, sign).unwrap();
        assert_eq!((claims.claimed, claims.ignored), (1, 1));
    }
}
