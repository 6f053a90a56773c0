//! The smallest separation: between its bounds, in both proofs.
#![expect(clippy::unwrap_used, reason = "a test stops where a value is missing")]
#![expect(clippy::disallowed_methods, reason = "the tests compare the two proofs")]

#[path = "../../check/tests/collision/sheets.rs"]
#[expect(dead_code, reason = "shared with tests that use more of it")]
mod sheets;

use std::{fs::File, path::Path};

use foldmotion_check::{CollisionOptions, CollisionReport, Separation, Verdict, collisions};
use foldmotion_geometry::triangle_triangle;
use foldmotion_pattern::{FoldError, FoldFile, LayerOrder, Motion};
use foldmotion_random::Random;
use foldmotion_verify::verify;
use glam::{DQuat, DVec2, DVec3};
use sheets::{motion, sheet};

/// The tolerance of the options: τ in units of length.
const TOLERANCE: f64 = 1e-6;

fn judge(motion: &Motion) -> CollisionReport {
    collisions(motion, &CollisionOptions::default(), &|_| true).unwrap()
}

/// Reads a motion of the test data.
fn read(name: &str) -> Motion {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/verdict-cases");
    let open = || File::open(folder.join(name)).unwrap();
    let file = FoldFile::read(open()).unwrap();
    let mut frames = Vec::new();
    let kept = file.frames::<FoldError>(open(), &mut |frame, _| {
        frames.push(frame);
        Ok(())
    });
    kept.unwrap();
    Motion { sheet: file.sheet, frames, compact_order: LayerOrder::default() }
}

fn accuracy(separation: &Separation) -> f64 {
    (0.01 * TOLERANCE).max(1e-4 * separation.attained)
}

/// The separation of a motion, with bounds as close to each other as promised, confirmed by the second proof.
fn separation(motion: &Motion, case: &str) -> (Separation, Verdict) {
    let report = judge(motion);
    let separation = report.min_separation.unwrap();
    assert!(separation.is_tight, "{case}: {separation:?}");
    let open = separation.attained - separation.distance;
    assert!(open >= 0.0 && open <= accuracy(&separation), "{case}: {separation:?}");
    let verification = verify(motion, &report);
    let refuted = verification.refuted.iter().map(|r| r.field.as_str());
    let open = verification.unproved.iter().map(|u| u.what.as_str());
    let mut errors = refuted
        .filter(|field| field.starts_with("min_separation"))
        .chain(open.filter(|what| *what == "the closest approach"));
    let error = errors.next();
    assert_eq!(error, None, "{case}: {separation:?} {verification:#?}");
    (separation, report.verdict)
}

/// The motion rotated and displaced.
fn placed(motion: &Motion, turn: DQuat, shift: DVec3) -> Motion {
    let mut placed = motion.clone();
    for frame in &mut placed.frames {
        for p in &mut frame.positions {
            *p = turn * *p + shift;
        }
    }
    placed
}

#[test]
fn the_true_separations_of_pairs_that_pass_closely_are_found() {
    let cases = [
        ("sep7_5e-06_3.3e-11.fold", 5.735e-6, 5.745e-6, Verdict::Free),
        ("sep7_2e-05_1e-10.fold", 2.285e-5, 2.295e-5, Verdict::Free),
        ("pair_verify_6506.fold", 3.8e-11, 4e-11, Verdict::Touching),
        ("false_touching_min.fold", 1.915e-5, 1.925e-5, Verdict::Free),
    ];
    let mut random = Random::new(5);
    for (name, low, high, expected) in cases {
        let motion = read(name);
        for place in 0..6 {
            let turn = DQuat::from_axis_angle(random.vector().normalize(), 3.0 * random.number());
            let (turn, shift) =
                if place == 0 { (DQuat::IDENTITY, DVec3::ZERO) } else { (turn, random.vector()) };
            let case = format!("{name} in place {place}");
            let placed = placed(&motion, turn, shift);
            let (found, verdict) = separation(&placed, &case);
            assert!(verify(&placed, &judge(&placed)).is_verified(), "{case}");
            assert_eq!(verdict, expected, "{case}: {found:?}");
            assert!(found.distance <= high, "{case}: {found:?}");
            assert!(found.attained >= low, "{case}: {found:?}");
        }
    }
}

#[test]
fn a_bound_that_is_too_high_is_refuted() {
    for name in ["sep7_5e-06_3.3e-11.fold", "sep7_2e-05_1e-10.fold", "false_touching_min.fold"] {
        let motion = read(name);
        let report = judge(&motion);
        let found = report.min_separation.unwrap();
        let with = |separation: Separation| CollisionReport {
            min_separation: Some(separation),
            ..report.clone()
        };
        let is_refuted = |separation: Separation| {
            let verification = verify(&motion, &with(separation));
            let fields = verification.refuted.iter().map(|r| &r.field);
            fields.into_iter().any(|f| f.starts_with("min_separation"))
        };
        assert!(!is_refuted(found), "{name}");
        let too_high = 1.01 * found.distance;
        assert!(is_refuted(Separation { distance: too_high, ..found }), "{name}");
        // What is attained at the first frame is an upper bound too; only the motion refutes the lower one.
        let first = motion.frames[0].positions.as_slice();
        let corners = |f: usize| motion.sheet.faces[f].map(|v| first[v as usize]);
        let at_first = triangle_triangle(&corners(0), &corners(1));
        let loose = Separation {
            attained: at_first.distance / motion.sheet.unit_length,
            is_tight: false,
            time: motion.frames[0].time,
            points: [at_first.on_a, at_first.on_b],
            ..found
        };
        assert!(!is_refuted(loose), "{name}");
        assert!(is_refuted(Separation { distance: too_high, ..loose }), "{name}");
        assert!(is_refuted(Separation { is_tight: true, ..loose }), "{name}");
        // A distance that is not attained, or is attained elsewhere, is not accepted either.
        let lower = found.attained - 0.001 * found.attained;
        let (attained, distance) = (lower, 0.9 * lower);
        let is_tight = false;
        let shifted = [found.points[0], found.points[1] + (found.points[1] - found.points[0])];
        for wrong in [
            Separation { points: shifted, ..found },
            Separation { time: 0.5, ..found },
            Separation { attained: 2.0 * found.attained, is_tight, ..found },
            Separation { attained, distance, is_tight, ..found },
            Separation { distance: f64::NAN, ..found },
        ] {
            assert!(is_refuted(wrong), "{name}: {wrong:?}");
        }
    }
}

/// Two moving triangles, thinner by `thin` and nearer by `near`.
fn two_triangles(random: &mut Random, thin: f64, near: f64) -> Motion {
    let vertices = (0..6).map(|k| DVec2::new(f64::from(k), f64::from(k * k)));
    let sheet = sheet(vertices.collect(), vec![[0, 1, 2], [3, 4, 5]]);
    let turn = DQuat::from_axis_angle(random.vector().normalize(), 3.0 * random.number());
    let shape = DVec3::new(1.0, thin, 0.5 * near);
    let start: Vec<DVec3> = (0..6).map(|_| random.vector() * shape).collect();
    let states: Vec<Vec<DVec3>> = (0..3)
        .map(|_| {
            let drift = [random.vector() * shape, random.vector() * shape];
            let moved = |(k, p): (usize, &DVec3)| {
                let up = DVec3::Z * if k < 3 { 0.0 } else { near * (1.0 + 0.3 * drift[0].x) };
                turn * (*p + drift[k / 3] * 0.5 + up)
            };
            start.iter().enumerate().map(moved).collect()
        })
        .collect();
    motion(sheet, states)
}

/// The smallest distance at many instants, and how much smaller it may be between them.
fn sampled(motion: &Motion) -> (f64, f64) {
    const SAMPLES: u32 = 400;
    let (mut least, mut between) = (f64::INFINITY, 0.0f64);
    for pair in motion.frames.windows(2) {
        let [p, q] = [&pair[0].positions, &pair[1].positions];
        let at = |v: u32, s: f64| p[v as usize].lerp(q[v as usize], s);
        let corners = |f: usize, s: f64| motion.sheet.faces[f].map(|v| at(v, s));
        for k in 0..=SAMPLES {
            let s = f64::from(k) / f64::from(SAMPLES);
            least = least.min(triangle_triangle(&corners(0, s), &corners(1, s)).distance);
        }
        let moves: Vec<DVec3> = p.iter().zip(q).map(|(p, q)| *q - *p).collect();
        let speeds = moves[..3].iter().flat_map(|u| moves[3..].iter().map(|v| u.distance(*v)));
        between = speeds.fold(between, f64::max);
    }
    (least, between / f64::from(2 * SAMPLES))
}

#[test]
fn the_bounds_of_slivers_and_of_near_pairs_hold_what_dense_sampling_finds_in_both_proofs() {
    let mut random = Random::new(6);
    let mut verdicts = [0; 3];
    for case in 0..300 {
        let (thin, near) = (10f64.powi(-(case % 7)), 10f64.powi(-(case % 9)));
        let motion = two_triangles(&mut random, thin, near);
        let name = format!("case {case}");
        let (found, verdict) = separation(&motion, &name);
        let (least, slack) = sampled(&motion);
        assert!(found.distance <= least, "{name}: {found:?} above {least:e}");
        let allowed = slack + accuracy(&found);
        assert!(found.distance >= least - allowed, "{name}: {found:?} far below {least:e}");
        let is_free = verdict == Verdict::Free;
        assert_eq!(is_free, found.distance > TOLERANCE, "{name}: {found:?}");
        verdicts[verdict as usize] += 1;
    }
    assert!(verdicts[0] > 100 && verdicts[1] > 30, "{verdicts:?}");
}

#[test]
fn the_bounds_of_a_single_frame_are_those_of_its_triangles() {
    let mut random = Random::new(7);
    for case in 0..40 {
        let mut motion = two_triangles(&mut random, 0.1, 0.5);
        motion.frames.truncate(1);
        let (found, _) = separation(&motion, &format!("case {case}"));
        let corners =
            |f: usize| motion.sheet.faces[f].map(|v| motion.frames[0].positions[v as usize]);
        let exact = triangle_triangle(&corners(0), &corners(1)).distance;
        assert!(found.distance <= exact && (found.attained - exact).abs() < 1e-12);
    }
}

#[test]
fn an_exhausted_budget_is_reported() {
    let motion = read("sep7_5e-06_3.3e-11.fold");
    let hasty = CollisionOptions { budget: 8, ..CollisionOptions::default() };
    let report = collisions(&motion, &hasty, &|_| true).unwrap();
    let found = report.min_separation.unwrap();
    assert!(!found.is_tight && found.distance <= 5.745e-6, "{found:?}");
}
