//! A computed motion with its findings, before anything is written.

use std::time::Duration;

use foldmotion_check::{CollisionReport, FittedBox, upright_box};
use foldmotion_pattern::{Frame, LayerOrder, Motion};
use foldmotion_solver::quasi_static::Jam;

use super::engine::EngineRun;
use super::fold_angles::FoldAngleReport;
use super::jam::JamReport;
use super::layers::LayerOrderReport;
use super::outcome::Outcome;
use super::path::PathReport;
use super::series::FrameFigures;
use super::stop::StopReport;
use super::symmetry::SymmetryReport;
use crate::Study;
use crate::resolve::subject::Subject;

/// The collision report, layer orders and figures of a motion.
#[derive(Debug, Clone)]
pub struct Findings {
    /// The verdict, with its evidence.
    pub collision: CollisionReport,
    /// The order of the triangles that coincide, with the index of the frame.
    pub layer_orders: Vec<(usize, LayerOrder)>,
    /// Strain, bending, energy and separation of each frame.
    pub series: Vec<FrameFigures>,
}

/// A computed motion with its findings: the result of [`Study::compute`].
#[derive(Debug)]
pub struct Folded {
    /// The motion, placed as it is displayed and written.
    pub motion: Motion,
    /// The findings of its check.
    pub findings: Findings,
    /// The box of its last state.
    pub compact: FittedBox,
    /// How the motion ended, with the reason.
    pub outcome: Outcome,
    pub(crate) jam: Option<JamReport>,
    pub(crate) stop: Option<StopReport>,
    /// The flat state of a pattern whose motion ended short of it.
    pub(crate) layer_order: Option<LayerOrderReport>,
    /// How close the creases came to their targets.
    pub(crate) fold_angles: FoldAngleReport,
    /// How well a sheet of units keeps its mirror symmetries.
    pub(crate) symmetry: Vec<SymmetryReport>,
    pub(crate) computed: EngineRun,
    pub(crate) path: PathReport,
    /// Seconds of all runs of the engine.
    pub(crate) engine_seconds: f64,
    pub(crate) check_seconds: f64,
    /// The number of threads that computed it.
    pub(crate) threads: usize,
}

impl Folded {
    /// Whether every stage reached its end in equilibrium.
    pub fn is_converged(&self) -> bool {
        self.computed.stages.iter().all(|stage| stage.converged)
    }

    /// Where contact stopped the motion.
    pub fn jam(&self) -> Option<&Jam> {
        self.computed.jam.as_ref()
    }

    /// The wall-clock time of engine and check.
    pub fn duration(&self) -> Duration {
        let seconds = self.engine_seconds + self.check_seconds;
        Duration::try_from_secs_f64(seconds).unwrap_or_default()
    }
}

impl Study {
    /// The box of each frame of `motion`: along the axes for units, which are placed by their exact states, and along the
    /// principal axes for an imported pattern.
    pub fn boxes(&self, motion: &Motion) -> Vec<FittedBox> {
        let measure = |frame: &Frame| match &self.subject {
            Subject::Units(_) => upright_box(&frame.positions),
            Subject::Imported(_) => self.subject.measured_box(&frame.positions),
        };
        motion.frames.iter().map(measure).collect()
    }
}
