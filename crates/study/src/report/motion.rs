//! Stages and engine in the report.

use foldmotion_solver::Stage;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::compute::engine::StageSummary;
use crate::compute::series::FrameFigures;
use crate::scene::EngineChoice;

/// What happened in a stage.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StageReport {
    /// The stage: unfold or fold.
    pub name: Stage,
    /// Largest |l/l0 − 1| of all edges and frames.
    pub peak_strain: f64,
    /// Motion time of the largest strain.
    pub peak_strain_t: f64,
    /// Mean |l/l0 − 1| over edges and frames.
    pub mean_strain: f64,
    /// Largest bend of a facet, degrees.
    pub peak_facet_bending_deg: f64,
    /// Motion time of the largest bend.
    pub peak_facet_bending_t: f64,
    /// Largest energy of each kind at any frame.
    pub peak_energy: EnergyReport,
    /// Pairs of primitives that push on each other, at most at any frame.
    pub most_contacts: usize,
    /// Whether the stage was run to its end in equilibrium.
    pub converged: bool,
    /// Motion time of its last state.
    pub reached_t: f64,
    /// Largest unbalanced force left, over the fold stiffness.
    pub residual: f64,
    /// Steps of the dynamic engine, Newton iterations of the quasi-static one.
    pub steps: u64,
    /// Load steps of the quasi-static engine.
    pub load_steps: Option<u64>,
    /// Load steps that found no equilibrium and were tried again shorter.
    pub shortened_load_steps: Option<u64>,
}

/// Energy by kind, in units of EA·h at EA = 1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct EnergyReport {
    /// Of the bars.
    pub bars: f64,
    /// Of the creases.
    pub creases: f64,
    /// Of the facet hinges.
    pub facets: f64,
    /// Of the angles of the triangles.
    pub face_angles: f64,
    /// Of the contact barriers.
    pub contact: f64,
}

/// The engine.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct EngineReport {
    /// The engine: dynamic or quasi-static.
    pub name: EngineChoice,
    /// Closest approach of layers, units of h; null without contact.
    pub contact_gap: Option<f64>,
    /// Steps of all stages.
    pub steps: u64,
    /// Wall-clock seconds.
    pub seconds: f64,
    /// Threads it could use.
    pub threads: usize,
    /// What it ran on: cpu, or the name of the GPU.
    pub device: String,
    /// The processor, and the f64 numbers its vectors hold.
    pub instruction_set: String,
}

/// Wall-clock seconds of the parts of a run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SecondsReport {
    /// Strain, box and collisions.
    pub check: f64,
    /// Films and files.
    pub record: f64,
    /// Everything.
    pub total: f64,
}

impl SecondsReport {
    /// Of a report that tells none.
    pub(crate) const NONE: Self = Self {
        check: 0.0,
        record: 0.0,
        total: 0.0,
    };
}

pub(super) fn stage_report(outcome: &StageSummary, series: &[FrameFigures]) -> StageReport {
    let start = outcome.stage.start_time();
    let within: Vec<&FrameFigures> = series
        .iter()
        .filter(|f| (start..=start + 1.0).contains(&f.time))
        .collect();
    let peak = |value: fn(&FrameFigures) -> f64| {
        within
            .iter()
            .map(|f| (value(f), f.time))
            .fold((0.0, start), |a, b| if b.0 > a.0 { b } else { a })
    };
    let (peak_strain, peak_strain_t) = peak(|f| f.peak_strain);
    let (peak_facet_bending_deg, peak_facet_bending_t) = peak(|f| f.peak_bending_deg);
    let most = |value: fn(&FrameFigures) -> f64| peak(value).0;
    StageReport {
        name: outcome.stage,
        peak_strain,
        peak_strain_t,
        mean_strain: within.iter().map(|f| f.mean_strain).sum::<f64>() / within.len().max(1) as f64,
        peak_facet_bending_deg,
        peak_facet_bending_t,
        peak_energy: EnergyReport {
            bars: most(|f| f.energy.bars),
            creases: most(|f| f.energy.creases),
            facets: most(|f| f.energy.facets),
            face_angles: most(|f| f.energy.face_angles),
            contact: most(|f| f.contact_energy),
        },
        most_contacts: within.iter().map(|f| f.contacts).max().unwrap_or(0),
        converged: outcome.converged,
        reached_t: outcome.reached,
        residual: outcome.residual,
        steps: outcome.steps,
        load_steps: outcome.load_steps.map(|n| n[0]),
        shortened_load_steps: outcome.load_steps.map(|n| n[1]),
    }
}
