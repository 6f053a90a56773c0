//! The order of layers, proved twice.

use std::f64::consts::PI;

use foldmotion_check::{
    Checker, Cluster, CollisionOptions, CollisionReport, LayerProof, LayerRule, Verdict,
};
use foldmotion_pattern::{Case, Frame, LayerOrder, Motion, Sheet, Unit, UnitSheet};
use foldmotion_verify::{Verification, Verifier};
use glam::DVec3;

use crate::sheets::{fold, folded, sheet, strip};
use foldmotion_random::Random;

/// The positions of a state, and the claims made there.
type State = (Vec<DVec3>, LayerOrder);

fn frame(k: usize, (positions, _): &State) -> Frame {
    Frame { time: k as f64, positions: positions.clone() }
}

fn judge(sheet: &Sheet, states: &[State]) -> CollisionReport {
    let options = CollisionOptions::default();
    let mut checker = Checker::new(sheet, &frame(0, &states[0]), &options).unwrap();
    checker.claim(&states[0].1, &|face| face).unwrap();
    for (k, state) in states.iter().enumerate().skip(1) {
        checker.advance(&frame(k, state)).unwrap();
        checker.claim(&state.1, &|face| face).unwrap();
    }
    checker.finish()
}

fn verify(sheet: &Sheet, states: &[State], claim: &CollisionReport) -> Verification {
    let mut verifier = Verifier::new(sheet, frame(0, &states[0]), claim);
    verifier.claim(&states[0].1, &|face| face);
    for (k, state) in states.iter().enumerate().skip(1) {
        verifier.advance(frame(k, state));
        verifier.claim(&state.1, &|face| face);
    }
    verifier.finish()
}

/// The report on which both proofs agree.
fn agreed(sheet: &Sheet, states: &[State]) -> CollisionReport {
    let report = judge(sheet, states);
    let verification = verify(sheet, states, &report);
    assert!(
        verification.is_verified(),
        "{:?}, {:?}: {verification:#?}",
        report.verdict,
        report.penetrations.first()
    );
    report
}

fn units(rows: usize, columns: usize) -> Vec<UnitSheet> {
    let cases = [
        (Case::E, 1.0, None),
        (Case::T, 0.7, None),
        (Case::S, 1.6, None),
        (Case::SII, 1.6, Some(0.7)),
    ];
    let sheet = |(case, width, lambda)| {
        let unit = Unit::new(case, width, 1.0, lambda, None).unwrap();
        UnitSheet::new(unit, rows, columns).unwrap()
    };
    cases.into_iter().map(sheet).collect()
}

/// The order with the claims about the pairs f < g reversed that `turns` selects; both directions alike.
fn turned(order: &LayerOrder, turns: &mut dyn FnMut(u32, u32) -> bool) -> LayerOrder {
    let mut changed = order.clone();
    for (f, g, sign) in order.iter().filter(|(f, g, _)| f < g) {
        if turns(f, g) {
            changed.insert(f, g, -sign);
            changed.insert(g, f, -order.sign(g, f).unwrap());
        }
    }
    changed
}

fn without(order: &LayerOrder, leaves: &mut dyn FnMut() -> bool) -> LayerOrder {
    let mut left = LayerOrder::default();
    for (f, g, sign) in order.iter().filter(|(f, g, _)| f < g) {
        if !leaves() {
            left.insert(f, g, sign);
            left.insert(g, f, order.sign(g, f).unwrap());
        }
    }
    left
}

#[test]
fn exact_compact_states_are_proved_twice_with_and_without_their_order() {
    for units in units(3, 2) {
        let ordered = [(units.compact(), units.compact_order())];
        let report = agreed(&units.sheet, &ordered);
        assert_eq!(report.verdict, Verdict::Touching);
        let orders = report.clusters.iter().map(|c| c.order);
        assert!(orders.clone().all(|order| order == LayerProof::Proved));
        let open = [(units.compact(), LayerOrder::default())];
        let orders = agreed(&units.sheet, &open).clusters;
        assert!(orders.iter().any(|c| c.order == LayerProof::Unproved));
    }
}

#[test]
fn swapped_layers_are_found_by_the_second_proof_alone() {
    for units in units(2, 2) {
        let order = units.compact_order();
        let clean = judge(&units.sheet, &[(units.compact(), order.clone())]);
        let mut pairs = order.iter().filter(|(f, g, _)| f < g).step_by(7);
        for (f, g, _) in &mut pairs {
            let swapped = turned(&order, &mut |a, b| (a, b) == (f, g));
            let states = [(units.compact(), swapped)];
            // The certificate of the right order is false for the swapped one.
            let verification = verify(&units.sheet, &states, &clean);
            let mut fields = verification.refuted.iter().map(|r| r.field.as_str());
            assert!(fields.any(|field| field == "penetrations"), "{f} {g}");
            agreed(&units.sheet, &states);
        }
        let mirrored = turned(&order, &mut |_, _| true);
        let states = [(units.compact(), mirrored)];
        assert!(!verify(&units.sheet, &states, &clean).refuted.is_empty());
        let rules = agreed(&units.sheet, &states).penetrations;
        let is_crease = |rule| rule == LayerRule::Crease;
        assert!(rules.iter().any(|p| is_crease(p.conflict.as_ref().unwrap().rule)));
    }
}

#[test]
fn both_proofs_agree_on_orders_left_out_and_turned_round_at_random() {
    let mut random = Random::new(5);
    let mut rules = std::collections::BTreeSet::new();
    for units in units(2, 2) {
        let order = units.compact_order();
        for k in 0..24 {
            let share = [-2.0, -0.8, -0.4, 0.2][k % 4];
            let claims = without(&order, &mut || random.number() < share);
            let share = [-0.98, -0.9, 0.0][k % 3];
            let claims = turned(&claims, &mut |_, _| random.number() < share);
            let report = agreed(&units.sheet, &[(units.compact(), claims)]);
            let conflicts = report.penetrations.iter().filter_map(|p| p.conflict.clone());
            rules.extend(conflicts.map(|c| c.rule));
        }
    }
    assert!(rules.len() >= 6, "{rules:?}");
}

fn states(motion: &Motion) -> Vec<State> {
    let state = |f: &Frame| (f.positions.clone(), LayerOrder::default());
    motion.frames.iter().map(state).collect()
}

/// A strip of squares folded flat by half turns.
fn flat_fold(signs: &[f64]) -> Motion {
    let mut directions = vec![0.0];
    for sign in signs {
        directions.push(directions[directions.len() - 1] + sign * PI);
    }
    let n = directions.len();
    fold(n as u32, &[&vec![0.0; n], &directions], 24)
}

#[test]
fn the_order_followed_from_a_motion_is_proved_twice_and_claims_against_it_are_found() {
    for signs in [&[1.0][..], &[-1.0, 1.0], &[1.0, -1.0, 1.0, -1.0]] {
        let motion = flat_fold(signs);
        let mut states = states(&motion);
        let clean = agreed(&motion.sheet, &states);
        let last = clean.clusters.last().unwrap();
        assert_eq!(last.order, LayerProof::Proved);
        let mut claims = LayerOrder::default();
        claims.insert(1, 3, if signs[0] > 0.0 { -1 } else { 1 });
        states[24].1 = claims;
        let verification = verify(&motion.sheet, &states, &clean);
        let mut fields = verification.refuted.iter().map(|r| r.field.as_str());
        assert!(fields.any(|field| field == "penetrations"));
        assert_eq!(agreed(&motion.sheet, &states).verdict, Verdict::Penetrating);
    }
}

#[test]
fn a_claim_at_the_first_frame_decides_the_side_in_both_proofs() {
    let flat = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let aside = [[5.0, 0.0], [5.5, 0.0], [5.0, 0.5]];
    let vertices = [flat, aside].concat().into_iter().map(glam::DVec2::from);
    let plates = sheet(vertices.collect(), vec![[0, 1, 2], [3, 4, 5]]);
    let at = |z: f64| {
        let lower = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let upper = lower.map(|p| p * 0.5 + DVec3::new(0.1, 0.1, z));
        [lower, upper].concat()
    };
    let mut above = LayerOrder::default();
    above.insert(1, 0, 1);
    for start in [0.0, 5e-7, -5e-7] {
        for (end, verdict) in [(0.2, Verdict::Touching), (-0.2, Verdict::Penetrating)] {
            let states = [(at(start), above.clone()), (at(end), LayerOrder::default())];
            assert_eq!(agreed(&plates, &states).verdict, verdict, "{start} {end}");
        }
    }
}

#[test]
fn rolled_up_squares_are_judged_alike_in_every_order_of_their_levels() {
    let sheet = strip(3, 1);
    let rolled = folded(&sheet, &[0.0, PI, 2.0 * PI]);
    for levels in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
        let mut order = LayerOrder::default();
        for f in 0..6_usize {
            for g in (0..6_usize).filter(|g| f / 2 != g / 2) {
                let facing = if g / 2 == 1 { -1 } else { 1 };
                let sign = if levels[f / 2] > levels[g / 2] { 1 } else { -1 };
                order.insert(f as u32, g as u32, facing * sign);
            }
        }
        let report = agreed(&sheet, &[(rolled.clone(), order)]);
        let is_possible = levels == [0, 2, 1] || levels == [1, 2, 0];
        assert_eq!(report.verdict == Verdict::Touching, is_possible);
    }
}

#[test]
fn every_statement_of_a_cluster_and_every_count_of_claims_is_held_to_what_is_found() {
    let units = &units(2, 2)[0];
    let states = [(units.compact(), units.compact_order())];
    let clean = agreed(&units.sheet, &states);
    let changes: [fn(&mut Cluster); 6] = [
        |c| c.frames[1] += 1,
        |c| c.times[0] -= 1.0,
        |c| {
            c.faces.pop();
        },
        |c| c.layers += 1,
        |c| c.pairs -= 1,
        |c| c.order = LayerProof::Unproved,
    ];
    let refuted = |report: &CollisionReport, field: &str| {
        let verification = verify(&units.sheet, &states, report);
        verification.refuted.iter().any(|r| r.field == field)
    };
    for (k, change) in changes.iter().enumerate() {
        let mut lie = clean.clone();
        change(&mut lie.clusters[0]);
        assert!(refuted(&lie, "clusters"), "{k}");
    }
    let mut lie = clean.clone();
    lie.clusters.pop();
    assert!(refuted(&lie, "clusters"));
    let mut lie = clean.clone();
    lie.clusters.push(clean.clusters[0].clone());
    assert!(refuted(&lie, "clusters"));
    let mut lie = clean;
    lie.claims.ignored += 1;
    assert!(refuted(&lie, "layer_orders"));
}
