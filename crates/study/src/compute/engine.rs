//! The engines behind one face: what a run needs to know of a computed motion, whichever engine computed it.

use foldmotion_pattern::{FacetModel, Frame};
use foldmotion_solver::dynamic::{self, DynamicOptions, StageStatus};
use foldmotion_solver::quasi_static::{
    Contact, Jam, QuasiStaticOptions, StopReason, Support, run_quasi_static,
};
use foldmotion_solver::{Budget, Stage, Watcher};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::scene::EngineChoice;
use crate::{Study, StudyError};

/// A motion as an engine left it, with how it went.
#[derive(Debug)]
pub(crate) struct Computed {
    /// In order of time; positions in the scene's unit.
    pub(crate) frames: Vec<Frame>,
    /// One for each stage begun.
    pub(crate) stages: Vec<StageSummary>,
    /// Energy of the contact barriers and the number of contacts at each frame; empty without contact.
    pub(crate) contacts: Vec<ContactFigures>,
    /// Where contact stopped the motion.
    pub(crate) jam: Option<Jam>,
    /// Steps of the dynamic engine, Newton iterations of the quasi-static one.
    pub(crate) steps: u64,
    /// What it ran on.
    pub(crate) device: String,
}

/// How a stage went.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StageSummary {
    pub(crate) stage: Stage,
    pub(crate) converged: bool,
    /// Motion time of its last state.
    pub(crate) reached: f64,
    /// The largest unbalanced force left, as the engine states it.
    pub(crate) residual: f64,
    /// Steps, or Newton iterations.
    pub(crate) steps: u64,
    /// Load steps of the quasi-static engine, and those that had to be shortened.
    pub(crate) load_steps: Option<[u64; 2]>,
    /// What ended it where it did not converge.
    pub(crate) stop: Option<StopSummary>,
}

/// What ended a stage before its end.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StopSummary {
    pub(crate) reason: StopCause,
    /// The load step that the quasi-static engine tried last, in motion time.
    pub(crate) step: Option<f64>,
    /// The unbalanced force left, and how much of it counts as equilibrium.
    pub(crate) residual: f64,
    pub(crate) tolerance: f64,
}

/// Why a stage ended before its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum StopCause {
    /// No equilibrium was found further on.
    NoEquilibrium,
    /// The budget of steps or iterations was used up.
    OutOfSteps,
    /// The budget of time was used up.
    OutOfTime,
}

impl From<StopReason> for StopCause {
    fn from(reason: StopReason) -> Self {
        match reason {
            StopReason::NoEquilibrium => Self::NoEquilibrium,
            StopReason::OutOfIterations => Self::OutOfSteps,
            StopReason::OutOfTime => Self::OutOfTime,
        }
    }
}

/// Contact at one frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContactFigures {
    pub(crate) energy: f64,
    pub(crate) count: usize,
}

impl Study {
    /// Moves the sheet through its stages and records it at `extra_times` too. `watcher` is told its states.
    pub(crate) fn fold(
        &self,
        extra_times: &[f64],
        budget: Budget,
        watcher: Watcher<'_>,
    ) -> Result<Computed, StudyError> {
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
    ) -> Result<Computed, StudyError> {
        let options = DynamicOptions {
            stages: self.subject.stages().to_vec(),
            device: self.device,
            frames: self.frames,
            extra_times: extra_times.to_vec(),
            budget,
            ..DynamicOptions::default()
        };
        let run = dynamic::run(
            &self.model,
            &self.schedule,
            &self.subject.start(),
            &options,
            watcher,
        )?;
        let stages = run.stages.iter().map(|s| StageSummary {
            stage: s.stage,
            converged: s.is_converged(),
            reached: s.reached,
            residual: s.residual,
            steps: s.steps,
            load_steps: None,
            stop: (!s.is_converged()).then_some(StopSummary {
                reason: if s.status == StageStatus::OutOfTime {
                    StopCause::OutOfTime
                } else {
                    StopCause::OutOfSteps
                },
                step: None,
                residual: s.residual,
                tolerance: s.tolerance,
            }),
        });
        Ok(Computed {
            stages: stages.collect(),
            contacts: Vec::new(),
            jam: None,
            steps: run.steps,
            device: run.device,
            frames: run.frames,
        })
    }

    /// A sheet that is to move symmetrically is not held at one place.
    fn support(&self) -> Support {
        match self.subject.units() {
            Some(study) if study.units.facet_model() == FacetModel::Symmetric => Support::Floating,
            _ => Support::Triangle,
        }
    }

    fn fold_in_equilibrium(
        &self,
        extra_times: &[f64],
        budget: Budget,
        watcher: Watcher<'_>,
    ) -> Result<Computed, StudyError> {
        let contact = self.contact_gap.map(|gap| Contact { gap });
        let options = QuasiStaticOptions {
            stages: self.subject.stages().to_vec(),
            frames: self.frames,
            extra_times: extra_times.to_vec(),
            contact,
            budget,
            support: self.support(),
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
            stop: s.stop.map(|stop| StopSummary {
                reason: stop.reason.into(),
                step: Some(stop.step),
                residual: stop.residual,
                tolerance: stop.tolerance,
            }),
        });
        let contacts = run.figures.iter().map(|f| ContactFigures {
            energy: f.contact_energy,
            count: f.contacts,
        });
        Ok(Computed {
            stages: stages.collect(),
            contacts: if self.contact_gap.is_some() {
                contacts.collect()
            } else {
                Vec::new()
            },
            steps: run.stages.iter().map(|s| s.iterations as u64).sum(),
            device: "cpu".to_owned(),
            jam: run.jam,
            frames: run.frames,
        })
    }
}
