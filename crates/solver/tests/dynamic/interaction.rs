//! A sheet moved interactively: it follows the time, gives way to a pull, and recovers.

use crate::sheets::{deployed, units};
use foldmotion_geometry::RigidMotion;
use foldmotion_pattern::{Case, UnitSheet};
use foldmotion_solver::dynamic::{InteractiveSheet, Pull};
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
    Sheet { model: Model::new(&units.sheet, &Material::default()).unwrap(), units, schedule, start }
}

impl Sheet {
    fn interaction(&self) -> InteractiveSheet<'_> {
        InteractiveSheet::new(&self.model, &self.schedule, &Stage::ALL, &self.start, 0.0).unwrap()
    }
}

fn settle(interaction: &mut InteractiveSheet<'_>) {
    for _ in 0..400 {
        interaction.advance(500).unwrap();
        if interaction.is_at_rest() {
            return;
        }
    }
    panic!("not at rest after 200 000 steps");
}

/// The largest distance of a vertex after the best rigid motion.
fn apart(from: &[DVec3], to: &[DVec3]) -> f64 {
    let fit = RigidMotion::best_fit(from, to);
    let pairs = from.iter().zip(to);
    pairs.map(|(&p, &q)| fit.apply(p).distance(q)).fold(0.0, f64::max)
}

#[test]
fn a_sheet_aimed_at_the_end_reaches_the_exact_compact_state_and_comes_back() {
    let sheet = sheet(3, 2);
    let mut interaction = sheet.interaction();
    interaction.aim(2.0);
    settle(&mut interaction);
    assert_eq!(interaction.time(), 2.0);
    assert!(interaction.fold_angle_error() < 1e-3, "{}", interaction.fold_angle_error());
    let compact = sheet.units.compact();
    assert!(apart(&interaction.positions(), &compact) < 1e-2);
    interaction.aim(0.0);
    settle(&mut interaction);
    assert!(apart(&interaction.positions(), &sheet.start) < 1e-2);
}

#[test]
fn a_sheet_can_be_taken_up_in_any_state_of_its_motion() {
    let sheet = sheet(2, 2);
    let mut first = sheet.interaction();
    first.aim(1.6);
    settle(&mut first);
    let middle = first.positions();
    let mut interaction =
        InteractiveSheet::new(&sheet.model, &sheet.schedule, &Stage::ALL, &middle, 1.6).unwrap();
    settle(&mut interaction);
    assert!(apart(&interaction.positions(), &middle) < 1e-4);
    let compact = sheet.units.compact();
    let mut interaction =
        InteractiveSheet::new(&sheet.model, &sheet.schedule, &Stage::ALL, &compact, 2.0).unwrap();
    settle(&mut interaction);
    assert!(apart(&interaction.positions(), &compact) < 1e-3);
}

#[test]
fn a_pulled_vertex_moves_towards_the_point_and_back_when_let_go() {
    let sheet = sheet(3, 2);
    let mut interaction = sheet.interaction();
    interaction.aim(1.5);
    settle(&mut interaction);
    let before = interaction.positions();
    for vertex in [0, before.len() / 2, before.len() - 1] {
        let point = before[vertex] + DVec3::new(0.4, -0.3, 1.0);
        interaction.pull(Some(Pull { vertex: vertex as u32, point }));
        settle(&mut interaction);
        let pulled = interaction.positions();
        let [was, is] = [before[vertex], pulled[vertex]].map(|p| p.distance(point));
        assert!(is < 0.9 * was, "vertex {vertex}: {is} of {was}");
        let middle = |p: &[DVec3]| p.iter().sum::<DVec3>() / p.len() as f64;
        assert!(middle(&pulled).distance(middle(&before)) < 0.5 * was, "it stays in place");
        interaction.pull(None);
        settle(&mut interaction);
        assert!(apart(&interaction.positions(), &before) < 1e-3, "vertex {vertex}");
        assert!(
            interaction.positions()[vertex].distance(before[vertex]) < 0.3,
            "it is where it was"
        );
    }
}

#[test]
fn violence_never_gives_a_position_that_is_no_number() {
    let sheet = sheet(3, 2);
    let mut interaction = sheet.interaction();
    let far = 100.0 * sheet.units.sheet.unit_length * 6.0;
    let count = sheet.start.len() as u32;
    for round in 0..2_000_u32 {
        interaction.aim(if round % 2 == 0 { 2.0 } else { 0.0 });
        if round % 7 == 0 {
            let turn = f64::from(round);
            interaction.pull(Some(Pull {
                vertex: round * 13 % count,
                point: far * DVec3::new(turn.cos(), turn.sin(), (2.0 * turn).cos()),
            }));
        }
        if let Err(error) = interaction.advance(10) {
            assert!(matches!(error, SolverError::Diverged { .. }), "{error}");
        }
        assert!(interaction.positions().iter().all(|p| p.is_finite()), "round {round}");
        assert!((0.0..=2.0).contains(&interaction.time()));
    }
    interaction.pull(None);
    interaction.aim(0.0);
    settle(&mut interaction);
    assert!(interaction.positions().iter().all(|p| p.is_finite()));
}

#[test]
fn what_does_not_fit_is_refused_or_ends_the_pull() {
    let sheet = sheet(1, 1);
    let new = |stages: &[Stage], start: &[DVec3], time: f64| {
        InteractiveSheet::new(&sheet.model, &sheet.schedule, stages, start, time).err()
    };
    let start = &sheet.start;
    assert!(matches!(new(&[], start, 0.0), Some(SolverError::Count { .. })));
    let short = &start[1..];
    assert!(matches!(new(&Stage::ALL, short, 0.0), Some(SolverError::Count { .. })));
    let lost = new(&Stage::ALL, start, f64::NAN);
    assert!(matches!(lost, Some(SolverError::NotFinite { .. })));
    let mut interaction = sheet.interaction();
    interaction.aim(f64::NAN);
    let point = DVec3::splat(f64::NAN);
    interaction.pull(Some(Pull { vertex: 0, point }));
    interaction.pull(Some(Pull { vertex: u32::MAX, point: DVec3::ZERO }));
    settle(&mut interaction);
    assert_eq!(interaction.time(), 0.0);
    assert!(apart(&interaction.positions(), start) < 1e-6);
    interaction.aim(7.0);
    settle(&mut interaction);
    assert_eq!(interaction.time(), 2.0);
}
