//! How a sheet moves: the bar-and-hinge model, its schedule and its engines.
//!
//! A [`Model`] is built from a sheet and a [`Material`]; a [`Schedule`] says which fold angle every hinge is driven to
//! at which motion time, all creases alike or one [`ScheduleStep`] after the other.
//!
//! Fold angles are in radians, positive for valleys, followed past ±π. Inside the model lengths are in the sheet's
//! unit length h, masses are 1.

mod budget;
pub mod dynamic;
mod error;
mod face_angle;
mod gather;
mod locality;
mod material;
mod model;

pub mod quasi_static;
mod schedule;
mod snapshot;

pub use budget::Budget;
pub use error::SolverError;
pub use material::{Material, Preset};
pub use model::{Bar, EnergyByKind, FaceAngles, Hinge, HingeKind, Model};
pub use schedule::{CreaseGroup, Ease, Schedule, ScheduleStep, Stage, UnfoldPath};
pub use snapshot::{Snapshot, Watcher};
