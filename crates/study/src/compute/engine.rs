//! One interface to both engines.

use foldmotion_pattern::{FacetModel, Frame};
use foldmotion_solver::dynamic::{self, DynamicOptions, StageStatus};
use foldmotion_solver::quasi_static::{
    Jam, QuasiStaticOptions, Snap, SnapControl, Support, run_quasi_static,
};
use foldmotion_solver::{Budget, Stage, Watcher};

use super::stop::{StopCause, StopReport};
use crate::scene::EngineChoice;
use crate::{Study, StudyError};

/// A motion as an engine computed it, with a summary of its stages.
#[derive(Debug)]
pub(crate) struct EngineRun {
    /// The frames in order of time, with positions in the scene's unit.
    pub(crate) frames: Vec<Frame>,
    /// A summary of each stage that was begun.
    pub(crate) stages: Vec<StageSummary>,
    /// The contact at each frame; empty without contact.
    pub(crate) contacts: Vec<ContactFigures>,
    /// Where contact stopped the motion; `None` if it did not.
    pub(crate) jam: Option<Jam>,
    /// The gap that layers keep in the last state; `None` without contact.
    pub(crate) gap_reached: Option<f64>,
    /// The mean error of the creases, in radians, after layers in contact were let go; `None` if they were not.
    pub(crate) error_without_contact: Option<f64>,
    /// The number of steps of the dynamic engine, or of Newton iterations of the quasi-static one.
    pub(crate) steps: u64,
    /// The device: cpu, or the name of the GPU.
    pub(crate) device: String,
}

/// A summary of a stage.
#[derive(Debug, Clone)]
pub(crate) struct StageSummary {
    pub(crate) stage: Stage,
    pub(crate) converged: bool,
    /// The motion time of the last state.
    pub(crate) reached: f64,
    /// The largest unbalanced force left, in the units of the engine.
    pub(crate) residual: f64,
    /// The number of steps, or of Newton iterations.
    pub(crate) steps: u64,
    /// The number of load steps of the quasi-static engine, and of those that had to be shortened.
    pub(crate) load_steps: Option<[u64; 2]>,
    /// The snaps of the quasi-static engine.
    pub(crate) snaps: Vec<Snap>,
    /// What ended the stage; `None` if it converged.
    pub(crate) stop: Option<StopReport>,
}

/// The contact at one frame: its energy and the number of pairs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContactFigures {
    pub(crate) energy: f64,
    pub(crate) count: usize,
}

impl Study {
    /// Moves the sheet through its stages and records frames at `extra_times` too. `watcher` is called with each state.
    pub(crate) fn fold(
        &self,
        extra_times: &[f64],
        budget: Budget,
        watcher: Watcher<'_>,
    ) -> Result<EngineRun, StudyError> {
        match self.engine {
            EngineChoice::Dynamic => self.fold_dynamically(extra_times, budget, watcher),
            EngineChoice::QuasiStatic => self.fold_in_equilibrium(extra_times, budget, watcher),
        }
    }

    fn fold_dynamically(
        &self,
        extra_times: &[f64],
        budget: Budget,
        watcher: Watcher<'_>,
    ) -> Result<EngineRun, StudyError> {
        let options = DynamicOptions {
            stages: self.subject.stages().to_vec(),
            device: self.device,
            frames: self.frames,
            extra_times: extra_times.to_vec(),
            budget,
            ..DynamicOptions::default()
        };
        let run =
            dynamic::run(&self.model, &self.schedule, &self.subject.start(), &options, watcher)?;
        let stages = run.stages.iter().map(|s| StageSummary {
            stage: s.stage,
            converged: s.is_converged(),
            reached: s.reached,
            residual: s.residual,
            steps: s.steps,
            load_steps: None,
            snaps: Vec::new(),
            stop: (!s.is_converged()).then_some(StopReport {
                t: s.reached,
                reason: if s.status == StageStatus::OutOfTime {
                    StopCause::OutOfTime
                } else {
                    StopCause::OutOfSteps
                },
                load_step: None,
                residual: s.residual,
                residual_tolerance: s.tolerance,
            }),
        });
        Ok(EngineRun {
            stages: stages.collect(),
            contacts: Vec::new(),
            jam: None,
            gap_reached: None,
            error_without_contact: None,
            steps: run.steps,
            device: run.device,
            frames: run.frames,
        })
    }

    /// A symmetric sheet floats: holding one triangle would break the symmetry.
    fn support(&self) -> Support {
        match self.subject.units() {
            Some(study) if study.units.facet_model() == FacetModel::Symmetric => Support::Floating,
            _ => Support::Triangle,
        }
    }

    /// Sheets of units snap seldom, and their states are figures of a paper. A pattern that somebody drew may snap all
    /// the time.
    fn snap_control(&self) -> SnapControl {
        match self.subject.units() {
            Some(_) => SnapControl::Settle,
            None => SnapControl::PassThrough,
        }
    }

    fn fold_in_equilibrium(
        &self,
        extra_times: &[f64],
        budget: Budget,
        watcher: Watcher<'_>,
    ) -> Result<EngineRun, StudyError> {
        let options = QuasiStaticOptions {
            stages: self.subject.stages().to_vec(),
            frames: self.frames,
            extra_times: extra_times.to_vec(),
            contact: self.contact,
            budget,
            support: self.support(),
            snap_control: self.snap_control(),
            ..QuasiStaticOptions::default()
        };
        let run = run_quasi_static(
            &self.model,
            &self.schedule,
            &self.subject.start(),
            &options,
            watcher,
        )?;
        let stages = run.stages.iter().map(|s| StageSummary {
            stage: s.stage,
            converged: s.converged,
            reached: s.reached,
            residual: s.residual,
            steps: s.iterations as u64,
            load_steps: Some([s.load_steps as u64, s.shortened_steps as u64]),
            snaps: s.snaps.clone(),
            stop: s.stop.map(|stop| StopReport {
                t: stop.time,
                reason: stop.reason.into(),
                load_step: Some(stop.step),
                residual: stop.residual,
                residual_tolerance: stop.tolerance,
            }),
        });
        let contacts = run
            .figures
            .iter()
            .map(|f| ContactFigures { energy: f.contact_energy, count: f.contacts });
        Ok(EngineRun {
            stages: stages.collect(),
            contacts: if self.contact.is_some() { contacts.collect() } else { Vec::new() },
            steps: run.stages.iter().map(|s| s.iterations as u64).sum(),
            device: "cpu".to_owned(),
            jam: run.jam,
            gap_reached: run.gap_reached,
            error_without_contact: run.release.map(|release| release.without_contact),
            frames: run.frames,
        })
    }
}
