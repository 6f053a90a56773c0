//! Stages and engine in the report.

use foldmotion_geometry::Number;
use foldmotion_solver::Stage;
use foldmotion_solver::quasi_static::Snap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::compute::engine::StageSummary;
use crate::compute::series::FrameFigures;
use crate::scene::EngineChoice;

/// The figures of a stage.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StageReport {
    /// The stage: unfold or fold, in this order.
    pub name: Stage,
    /// The largest |l/l0 − 1| over all edges and frames.
    pub peak_strain: f64,
    /// The motion time of the largest strain.
    pub peak_strain_t: f64,
    /// The mean |l/l0 − 1| over all edges and frames.
    pub mean_strain: f64,
    /// The largest bend of a facet, in degrees.
    pub peak_facet_bending_deg: f64,
    /// The motion time of the largest bend.
    pub peak_facet_bending_t: f64,
    /// The largest energy of each kind at any frame.
    pub peak_energy: EnergyReport,
    /// The largest number of pairs of primitives that push on each other at one frame.
    pub most_contacts: usize,
    /// Whether the stage was computed to its end in equilibrium.
    pub converged: bool,
    /// The motion time of the last state of the stage.
    pub reached_t: f64,
    /// The largest unbalanced force left, divided by the fold stiffness.
    pub residual: f64,
    /// The number of steps of the dynamic engine, or of Newton iterations of the quasi-static engine.
    pub steps: u64,
    /// The number of load steps of the quasi-static engine; null for the dynamic engine.
    pub load_steps: Option<u64>,
    /// The number of load steps that found no equilibrium and were repeated with a shorter step.
    pub shortened_load_steps: Option<u64>,
    /// The snaps, in order of time: parts of the motion in which the sheet was not in equilibrium, but on the way from
    /// one equilibrium to another.
    #[serde(default)]
    pub snaps: Vec<SnapReport>,
}

/// The number of snaps that are named on the terminal.
const NAMED_SNAPS: usize = 3;

impl StageReport {
    /// The snaps, those that released most energy by their times, as a line for the terminal.
    pub(crate) fn snap_line(&self) -> String {
        let mut largest: Vec<&SnapReport> = self.snaps.iter().collect();
        largest.sort_by(|a, b| b.energy_released.total_cmp(&a.energy_released));
        let named = largest.iter().take(NAMED_SNAPS).map(|snap| {
            let (from, to, energy) = (snap.from_t, snap.to_t, Number(snap.energy_released));
            format!("t = {from:.4} to {to:.4} ({energy:.2})")
        });
        let plural = if self.snaps.len() == 1 { "" } else { "s" };
        format!(
            "{} snap{plural} in stage {}, from one equilibrium to another; most energy released at {}",
            self.snaps.len(),
            self.name.name(),
            named.collect::<Vec<_>>().join(", ")
        )
    }
}

/// A snap: the sheet left its equilibrium and moved far to another.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SnapReport {
    /// The motion time of the last equilibrium before the snap.
    pub from_t: f64,
    /// The motion time of the first equilibrium after it; of the last state if it did not end.
    pub to_t: f64,
    /// The elastic energy that the sheet lost in it, in the unit of `peak_energy`.
    pub energy_released: f64,
    /// Whether the sheet came to rest in an equilibrium.
    pub is_over: bool,
}

impl SnapReport {
    fn new(snap: &Snap) -> Self {
        let Snap { from, to, energy_released, is_over } = *snap;
        Self { from_t: from, to_t: to, energy_released, is_over }
    }
}

/// Energy by kind, in units of EA·h at EA = 1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct EnergyReport {
    /// The energy of the bars, which stretch.
    pub bars: f64,
    /// The energy of the creases, which turn from their targets.
    pub creases: f64,
    /// The energy of the hinges inside facets.
    pub facets: f64,
    /// The energy of the angles of the triangles.
    pub face_angles: f64,
    /// The energy of contact between layers.
    pub contact: f64,
}

/// The engine.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct EngineReport {
    /// The engine: dynamic or quasi-static.
    pub name: EngineChoice,
    /// The closest approach of layers before they close at the end, in units of h; null without contact.
    pub contact_gap: Option<f64>,
    /// The closest approach of layers in the last state, in units of h: motion.final_gap, or more where the motion
    /// ended before the sheet closed; null without contact.
    pub final_gap: Option<f64>,
    /// The number of steps of all stages together.
    pub steps: u64,
    /// The wall-clock seconds of all runs of the engine.
    pub seconds: f64,
    /// The number of threads it could use.
    pub threads: usize,
    /// What it ran on: cpu, or the name of the GPU.
    pub device: String,
    /// The type of processor, and how many f64 numbers its vectors hold.
    pub instruction_set: String,
}

/// Wall-clock seconds of the parts of a run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SecondsReport {
    /// Strain, box and collisions, in seconds.
    pub check: f64,
    /// Films, figures and files, in seconds.
    pub record: f64,
    /// The whole run, in seconds of wall-clock time.
    pub total: f64,
}

impl SecondsReport {
    /// Zeros, for a report without timings.
    pub(crate) const NONE: Self = Self { check: 0.0, record: 0.0, total: 0.0 };
}

pub(super) fn stage_report(stage: &StageSummary, series: &[FrameFigures]) -> StageReport {
    let start = stage.stage.start_time();
    let within: Vec<&FrameFigures> =
        series.iter().filter(|f| (start..=start + 1.0).contains(&f.time)).collect();
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
        name: stage.stage,
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
        converged: stage.converged,
        reached_t: stage.reached,
        residual: stage.residual,
        steps: stage.steps,
        load_steps: stage.load_steps.map(|n| n[0]),
        shortened_load_steps: stage.load_steps.map(|n| n[1]),
        snaps: stage.snaps.iter().map(SnapReport::new).collect(),
    }
}
