//! A check that ends early because many pairs penetrate, proved twice up to there.

use foldmotion_check::{CollisionOptions, CollisionReport, Verdict, collisions};
use foldmotion_pattern::Motion;
use foldmotion_verify::verify;
use glam::{DVec2, DVec3};

use crate::sheets::{motion, sheet};
use foldmotion_random::Random;

/// The number of squares along a side of a cloth.
const SQUARES: u32 = 10;
/// The limit of penetrating pairs.
const LIMIT: usize = 40;

/// Two crumpled cloths of 200 triangles, one of which sinks through the other at an angle in eight intervals.
fn cloths() -> Motion {
    let n = SQUARES + 1;
    let flat = |k: u32| DVec2::new(f64::from(k / n), f64::from(k % n));
    let vertices = (0..2 * n * n)
        .map(|k| flat(k % (n * n)) + f64::from(k / (n * n)) * DVec2::new(0.37, 20.29));
    let corners = (0..2 * SQUARES * SQUARES).flat_map(|k| {
        let (cloth, square) = (k / (SQUARES * SQUARES), k % (SQUARES * SQUARES));
        let p = cloth * n * n + square / SQUARES * n + square % SQUARES;
        [[p, p + n, p + n + 1], [p, p + n + 1, p + 1]]
    });
    let sheet = sheet(vertices.collect(), corners.collect());
    let mut random = Random::new(11);
    let crumple: Vec<f64> = (0..2 * n * n).map(|_| 0.1 * random.number()).collect();
    let states = (0..=8).map(|frame| {
        let place = |(v, &off): (usize, &f64)| {
            let is_upper = v >= (n * n) as usize;
            let at = sheet.vertices[v];
            let slanting = 0.5 + 0.2 * at.x - 0.35 * f64::from(frame);
            let height = if is_upper { slanting } else { 0.0 };
            DVec3::new(at.x, if is_upper { at.y - 20.0 } else { at.y }, height + off)
        };
        crumple.iter().enumerate().map(place).collect::<Vec<_>>()
    });
    let states: Vec<_> = states.collect();
    motion(sheet, states)
}

fn judge(motion: &Motion, stop_at: usize) -> CollisionReport {
    let options = CollisionOptions { stop_at, ..CollisionOptions::default() };
    collisions(motion, &options, &|_| true).unwrap()
}

#[test]
fn a_check_ends_at_the_frame_at_which_more_pairs_penetrate_than_allowed() {
    let motion = cloths();
    let (all, some) = (judge(&motion, 0), judge(&motion, LIMIT));
    assert_eq!(all.stopped, None);
    assert!(all.penetrations.len() > 400, "{}", all.penetrations.len());
    let stopped = some.stopped.unwrap();
    assert_eq!(some.verdict, Verdict::Penetrating);
    assert_eq!(stopped.time, motion.frames[stopped.frame].time);
    assert!(stopped.frame < 8 && some.penetrations.len() > LIMIT);
    let is_before = |frame| all.penetrations.iter().filter(move |p| p.frame < frame);
    assert!(is_before(stopped.frame).eq(&some.penetrations));
    assert!(is_before(stopped.frame - 1).count() <= LIMIT);
    assert_eq!(some.separation_series.len(), stopped.frame + 1);
    // If enough pairs are allowed, nothing stops, and every frame is judged.
    assert_eq!(judge(&motion, all.penetrations.len()), all);
}

#[test]
fn what_is_stated_of_a_stopped_check_is_proved_up_to_its_last_frame_and_no_more() {
    let motion = cloths();
    let claim = judge(&motion, LIMIT);
    let verification = verify(&motion, &claim);
    assert!(verification.is_verified(), "{verification:#?}");
    let refuted = |claim: &CollisionReport, field: &str| {
        let refuted = verify(&motion, claim).refuted;
        refuted.iter().any(|r| r.field == field)
    };
    let stopped = claim.stopped.unwrap();
    let changed = |frame, time, stop_at| {
        let mut claim = claim.clone();
        claim.stopped = Some(foldmotion_check::Stopped { frame, time, stop_at });
        claim
    };
    let count = claim.penetrations.len();
    for lie in [
        changed(stopped.frame, stopped.time, count),
        changed(stopped.frame, stopped.time, 0),
        changed(stopped.frame, stopped.time + 0.5, LIMIT),
        changed(100, stopped.time, LIMIT),
    ] {
        assert!(refuted(&lie, "stopped"), "{:?}", lie.stopped);
    }
    // If the check is said to have stopped elsewhere, or not at all, the penetrations differ.
    for k in [stopped.frame - 1, stopped.frame + 1] {
        let lie = changed(k, motion.frames[k].time, LIMIT);
        assert!(refuted(&lie, "penetrations"), "{k}");
    }
    let mut lie = claim.clone();
    lie.stopped = None;
    assert!(refuted(&lie, "penetrations"));
}
