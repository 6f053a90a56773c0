//! The motions of the paper: without contact for the compact boxes, with contact for certificates and figure A1.

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

/// The number of frames of a motion without contact, whose equilibrium does not depend on it.
const FREE_FRAMES: usize = 60;
/// The number of frames of a motion with contact.
const CONTACT_FRAMES: usize = 120;

/// The profiles of figure A1, in its order.
pub(super) const CERTIFIED: [&str; 3] = ["shelter", "rolling-paper", "omega"];

/// The motion times of figure A1.
pub(super) const STRIP_TIMES: [f64; 5] = [0.0, 0.5, 1.0, 1.6, 2.0];

/// A motion as it is stored.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct StoredMotion {
    pub(super) row: MotionRow,
    /// The states at [`STRIP_TIMES`], as far as the motion came; empty without contact.
    pub(super) states: Vec<(f64, Vec<DVec3>)>,
}

/// A function that is called with the share of a part that is done, from 0 to 1; returns whether to continue.
pub(super) type PartProgress<'a> = &'a (dyn Fn(f64) -> bool + Sync);

/// The name, the scene and the inputs of a motion.
fn part(model: &str, case: Case, contact: bool) -> [String; 3] {
    let (kind, frames) =
        if contact { ("certificate", CONTACT_FRAMES) } else { ("case", FREE_FRAMES) };
    let motion = format!("contact = {contact}\nframes = {frames}\n");
    let scene = scene(model, case, &motion);
    let inputs = inputs(model, &scene);
    [format!("{kind}-{model}-{}", case.name()), scene, inputs]
}

/// The stored motion; `None` if it has not been computed.
pub(super) fn finished(
    store: &Store,
    model: &str,
    case: Case,
    contact: bool,
) -> Option<StoredMotion> {
    let [name, _, inputs] = part(model, case, contact);
    store.find(&name, &inputs)
}

/// The stored motion, which is computed if necessary.
pub(super) fn folding(
    store: &Store,
    model: &str,
    case: Case,
    contact: bool,
    done: PartProgress<'_>,
) -> Result<StoredMotion, PaperError> {
    let [name, scene, inputs] = part(model, case, contact);
    store.part(&name, &inputs, || fold(&study(scene)?, contact, done))
}

/// The inputs of figure A1, as text.
pub(super) fn strip_inputs() -> String {
    let models = CERTIFIED.iter();
    let parts = models.flat_map(|model| CASES.map(|case| part(model, case, true).concat()));
    parts.collect()
}

fn fold(study: &Study, contact: bool, done: PartProgress<'_>) -> Result<StoredMotion, PaperError> {
    // Engine and check take about the same time, and refinement repeats both.
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
        compact: BoxReport::from(&folded.compact),
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
    Ok(StoredMotion { row, states })
}

fn error_of(study: &Study, measured: &foldmotion_check::FittedBox) -> ErrorReport {
    let closed_form = study.subject.closed_form();
    let extents = closed_form.map_or([0.0; 3], |form| form.extents);
    ErrorReport::new(measured, extents, study.subject.sheet().unit_length)
}
