//! The sheet in the hand.

use crate::sheets::{deployed, units};
use foldmotion_geometry::RigidMotion;
use foldmotion_pattern::{Case, UnitSheet};
use foldmotion_solver::dynamic::{Hand, Pull};
use foldmotion_solver::{Material, Model, Schedule, SolverError, Stage};
use glam::DVec3;

struct Sheet {
    units: UnitSheet,
    model: Model,
    schedule: Schedule,
    start: Vec<DVec3>,
}

fn sheet(rows: usize, columns: usize) -> Sheet {
    let units = units(Case::E, rows, columns);
    let (start, schedule) = deployed(&units);
    Sheet {
        model: Model::new(&units.sheet, &Material::default()).unwrap(),
        units,
        schedule,
        start,
    }
}

impl Sheet {
    fn held(&self) -> Hand<'_> {
        Hand::new(&self.model, &self.schedule, &Stage::ALL, &self.start, 0.0).unwrap()
    }
}

fn settle(hand: &mut Hand<'_>) {
    for _ in 0..400 {
        hand.advance(500).unwrap();
        if hand.is_at_rest() {
            return;
        }
    }
    panic!("not at rest after 200 000 steps");
}

/// The largest distance of a vertex after the best rigid motion.
fn apart(from: &[DVec3], to: &[DVec3]) -> f64 {
    let fit = RigidMotion::best_fit(from, to);
    let pairs = from.iter().zip(to);
    pairs
        .map(|(&p, &q)| fit.apply(p).distance(q))
        .fold(0.0, f64::max)
}

#[test]
fn a_sheet_aimed_at_the_end_reaches_the_exact_compact_state_and_comes_back() {
    let sheet = sheet(3, 2);
    let mut hand = sheet.held();
    hand.aim(2.0);
    settle(&mut hand);
    assert_eq!(hand.time(), 2.0);
    assert!(
        hand.fold_angle_error() < 1e-3,
        "{}",
        hand.fold_angle_error()
    );
    let compact = sheet.units.compact();
    assert!(apart(&hand.positions(), &compact) < 1e-2);
    hand.aim(0.0);
    settle(&mut hand);
    assert!(apart(&hand.positions(), &sheet.start) < 1e-2);
}

#[test]
fn a_sheet_can_be_taken_up_in_any_state_of_its_motion() {
    let sheet = sheet(2, 2);
    let mut first = sheet.held();
    first.aim(1.6);
    settle(&mut first);
    let middle = first.positions();
    let mut hand = Hand::new(&sheet.model, &sheet.schedule, &Stage::ALL, &middle, 1.6).unwrap();
    settle(&mut hand);
    assert!(apart(&hand.positions(), &middle) < 1e-4);
    let compact = sheet.units.compact();
    let mut hand = Hand::new(&sheet.model, &sheet.schedule, &Stage::ALL, &compact, 2.0).unwrap();
    settle(&mut hand);
    assert!(apart(&hand.positions(), &compact) < 1e-3);
}

#[test]
fn a_pulled_vertex_moves_towards_the_point_and_back_when_let_go() {
    let sheet = sheet(3, 2);
    let mut hand = sheet.held();
    hand.aim(1.5);
    settle(&mut hand);
    let before = hand.positions();
    for vertex in [0, before.len() / 2, before.len() - 1] {
        let point = before[vertex] + DVec3::new(0.4, -0.3, 1.0);
        hand.pull(Some(Pull {
            vertex: vertex as u32,
            point,
        }));
        settle(&mut hand);
        let pulled = hand.positions();
        let [was, is] = [before[vertex], pulled[vertex]].map(|p| p.distance(point));
        assert!(is < 0.9 * was, "vertex {vertex}: {is} of {was}");
        let middle = |p: &[DVec3]| p.iter().sum::<DVec3>() / p.len() as f64;
        assert!(
            middle(&pulled).distance(middle(&before)) < 0.5 * was,
            "it stays in place"
        );
        hand.pull(None);
        settle(&mut hand);
        assert!(apart(&hand.positions(), &before) < 1e-3, "vertex {vertex}");
        assert!(
            hand.positions()[vertex].distance(before[vertex]) < 0.3,
            "it is where it was"
        );
    }
}

#[test]
fn violence_never_gives_a_position_that_is_no_number() {
    let sheet = sheet(3, 2);
    let mut hand = sheet.held();
    let far = 100.0 * sheet.units.sheet.unit_length * 6.0;
    let count = sheet.start.len() as u32;
    for round in 0..2_000_u32 {
        hand.aim(if round % 2 == 0 { 2.0 } else { 0.0 });
        if round % 7 == 0 {
            let turn = f64::from(round);
            hand.pull(Some(Pull {
                vertex: round * 13 % count,
                point: far * DVec3::new(turn.cos(), turn.sin(), (2.0 * turn).cos()),
            }));
        }
        if let Err(error) = hand.advance(10) {
            assert!(matches!(error, SolverError::Diverged { .. }), "{error}");
        }
        assert!(
            hand.positions().iter().all(|p| p.is_finite()),
            "round {round}"
        );
        assert!((0.0..=2.0).contains(&hand.time()));
    }
    hand.pull(None);
    hand.aim(0.0);
    settle(&mut hand);
    assert!(hand.positions().iter().all(|p| p.is_finite()));
}

#[test]
fn what_no_hand_can_do_is_refused_or_lets_go() {
    let sheet = sheet(1, 1);
    let new = |stages: &[Stage], start: &[DVec3], time: f64| {
        Hand::new(&sheet.model, &sheet.schedule, stages, start, time).err()
    };
    let start = &sheet.start;
    assert!(matches!(
        new(&[], start, 0.0),
        Some(SolverError::Count { .. })
    ));
    let short = &start[1..];
    assert!(matches!(
        new(&Stage::ALL, short, 0.0),
        Some(SolverError::Count { .. })
    ));
    let lost = new(&Stage::ALL, start, f64::NAN);
    assert!(matches!(lost, Some(SolverError::NotFinite { .. })));
    let mut hand = sheet.held();
    hand.aim(f64::NAN);
    let point = DVec3::splat(f64::NAN);
    hand.pull(Some(Pull { vertex: 0, point }));
    hand.pull(Some(Pull {
        vertex: u32::MAX,
        point: DVec3::ZERO,
    }));
    settle(&mut hand);
    assert_eq!(hand.time(), 0.0);
    assert!(apart(&hand.positions(), start) < 1e-6);
    hand.aim(7.0);
    settle(&mut hand);
    assert_eq!(hand.time(), 2.0);
}
