//! The schedule: its targets against closed forms, its errors, and stepped schedules in the dynamic engine.

#![expect(clippy::unwrap_used, reason = "a test stops where a value is missing")]

mod errors;
mod motion;
mod targets;
mod unfold_path;

use foldmotion_pattern::{Case, Facing, Unit, UnitSheet};
use foldmotion_solver::{CreaseGroup, Ease, Schedule, ScheduleStep, Stage};
use glam::{DVec2, DVec3};

/// S of 3 × 2 units of height 1, and its deployed state and angles on a polygon that rises and falls.
struct Shelter {
    units: UnitSheet,
    deployed: Vec<DVec3>,
    uniform: Schedule,
}

fn shelter() -> Shelter {
    let unit = Unit::new(Case::S, 1.6, 1.0, None, None).unwrap();
    let units = UnitSheet::new(unit, 3, 2).unwrap();
    let mut polygon = vec![DVec2::ZERO];
    for slope in [1.2, 0.1, -1.0] {
        polygon.push(polygon[polygon.len() - 1] + DVec2::from_angle(slope));
    }
    let angles = units.deployed_angles(&polygon, Facing::Left).unwrap();
    Shelter {
        deployed: units.deployed(&polygon, Facing::Left).unwrap(),
        uniform: Schedule::uniform(&units.sheet, &angles, units.compact_angles()).unwrap(),
        units,
    }
}

fn step(stage: Stage, creases: CreaseGroup, from: f64, to: f64) -> ScheduleStep {
    ScheduleStep { stage, creases, rows: None, columns: None, from, to, ease: Ease::Linear }
}

/// A step of `fold` for all creases of `row`.
fn row_step(row: u32, from: f64, to: f64) -> ScheduleStep {
    ScheduleStep { rows: Some([row, row]), ..step(Stage::Fold, CreaseGroup::All, from, to) }
}
