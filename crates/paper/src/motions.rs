//! The motions: compact boxes without contact, certificates with contact, states for figure A1.

use foldmotion_check::relative_error;
use foldmotion_pattern::{Case, Frame};
use foldmotion_record::positions_at;
use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::record::MotionRow;
use super::store::Store;
use super::targets::{CASES, inputs, scene, study};
use crate::PaperError;
use foldmotion_study::report::{BoxReport, ErrorReport};
use foldmotion_study::{Phase, Study};

/// Frames of a motion without contact: its equilibrium does not depend on them, and a figure needs few.
const FREE_FRAMES: usize = 60;
/// Frames of a motion with contact.
const CONTACT_FRAMES: usize = 120;

/// The profiles of figure A1, in its order.
pub(super) const CERTIFIED: [&str; 3] = ["shelter", "rolling-paper", "omega"];

/// The motion times of figure A1.
pub(super) const STRIP_TIMES: [f64; 5] = [0.0, 0.5, 1.0, 1.6, 2.0];

/// What is kept of a motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Folding {
    pub(super) row: MotionRow,
    /// The states at [`STRIP_TIMES`] as far as the motion came; empty without contact.
    pub(super) states: Vec<(f64, Vec<DVec3>)>,
}

/// Told how much of the motion is done, from 0 to 1; answers whether to go on.
pub(super) type Done<'a> = &'a (dyn Fn(f64) -> bool + Sync);

/// The name, the scene and the inputs of a motion.
fn part(model: &str, case: Case, contact: bool) -> [String; 3] {
    let (kind, frames) = if contact {
        ("certificate", CONTACT_FRAMES)
    } else {
        ("case", FREE_FRAMES)
    };
    let motion = format!("contact = {contact}\nframes = {frames}\n");
    let scene = scene(model, case, &motion);
    let inputs = inputs(model, &scene);
    [format!("{kind}-{model}-{}", case.name()), scene, inputs]
}

/// The motion if it has been made.
pub(super) fn finished(store: &Store, model: &str, case: Case, contact: bool) -> Option<Folding> {
    let [name, _, inputs] = part(model, case, contact);
    store.find(&name, &inputs)
}

/// The motion, made where it has not been.
pub(super) fn folding(
    store: &Store,
    model: &str,
    case: Case,
    contact: bool,
    done: Done<'_>,
) -> Result<Folding, PaperError> {
    let [name, scene, inputs] = part(model, case, contact);
    store.part(&name, &inputs, || fold(&study(scene)?, contact, done))
}

/// What figure A1 is drawn from.
pub(super) fn strip_inputs() -> String {
    let models = CERTIFIED.iter();
    let parts = models.flat_map(|model| CASES.map(|case| part(model, case, true).concat()));
    parts.collect()
}

fn fold(study: &Study, contact: bool, done: Done<'_>) -> Result<Folding, PaperError> {
    // Engine and check take about equally long; refinement repeats both.
    let share = |phase, part: f64| match phase {
        Phase::Check => 0.5 + 0.5 * part,
        _ => 0.5 * part,
    };
    let folded = study.compute(&|phase, part| done(share(phase, part)))?;
    let findings = &folded.findings;
    let strains = findings.series.iter().map(|figures| figures.peak_strain);
    let reached_t = folded.motion.frames.last().map_or(0.0, |f: &Frame| f.time);
    let row = MotionRow {
        verdict: findings.collision.verdict,
        first_penetration_t: findings.collision.first.as_ref().map(|p| p.time),
        min_separation: findings.collision.min_separation.map(|s| s.distance),
        frames: folded.motion.frames.len(),
        converged: folded.is_converged(),
        reached_t,
        jam_t: folded.jam().map(|jam| jam.time),
        peak_strain: strains.fold(0.0, f64::max),
        compact: BoxReport {
            extents: folded.compact.extents.into(),
            area: folded.compact.area,
            volume: folded.compact.volume,
        },
        rms_to_exact: folded
            .compact
            .rms_to_exact
            .map_or(0.0, |rms| rms / study.subject.sheet().unit_length),
        error: error_of(study, &folded.compact),
    };
    let mut states = Vec::new();
    if contact {
        let times = STRIP_TIMES.map(|time| time.min(reached_t));
        states.extend(times.map(|time| (time, positions_at(&folded.motion, time))));
    }
    Ok(Folding { row, states })
}

fn error_of(study: &Study, measured: &foldmotion_check::FittedBox) -> ErrorReport {
    let closed = study
        .subject
        .closed_form()
        .map_or([0.0; 3], |form| form.extents);
    let error = relative_error(measured, closed.into(), study.subject.sheet().unit_length);
    ErrorReport {
        extents: error.extents.into(),
        area: error.area,
        volume: error.volume,
    }
}
