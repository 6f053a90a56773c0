//! The motion that is shown, whatever its source, with everything the window shows of it.

use std::path::PathBuf;
use std::sync::Arc;

use foldmotion_check::{CollisionReport, PenetrationSpan, penetration_spans};
use foldmotion_geometry::{Profile, RigidMotion};
use foldmotion_pattern::{Frame, LayerOrder, Motion, UnitSheet};
use foldmotion_record::{Layers, positions_at};
use foldmotion_study::scene::RecordScene;
use foldmotion_study::{Draft, Folded, OpenedMotion, Preview, Report, Scene, Study, UnitDraft};
use glam::DVec3;

use super::plots::plots_of;
use crate::timeline::{Marks, Plots};
use crate::work::{CheckedMotion, FinishedRun, Job, RepaintSignal, record, record_opened, write};

/// Number of segments of the profile that are drawn.
const PROFILE_POINTS: u32 = 240;

/// The source of a motion.
#[derive(Debug)]
pub(crate) enum MotionSource {
    /// The exact deployed, planar and compact states of the scene, with nothing between them.
    Exact(Motion),
    /// A preview, folded quickly without contact and not checked.
    Preview(Motion),
    /// A run with its report.
    Run { study: Arc<Study>, folded: Arc<Folded>, report: Box<Report> },
    /// A motion file, with the result of its check once that is known.
    File { motion: Arc<OpenedMotion>, checked: Option<Box<CheckedMotion>> },
}

/// A motion with everything the window shows of it.
#[derive(Debug)]
pub(crate) struct ShownMotion {
    pub(crate) source: MotionSource,
    /// A number that differs between motions.
    pub(crate) key: u64,
    pub(crate) layers: Layers,
    pub(crate) plots: Plots,
    pub(crate) marks: Marks,
    spans: Vec<PenetrationSpan>,
    /// For each span, a point where the facets meet.
    contact_points: Vec<DVec3>,
    /// The profile Γ, placed where the deployed state is shown.
    pub(crate) profile: Vec<DVec3>,
    /// The rigid motion from the engine's coordinates to those that are shown.
    pub(crate) placement: RigidMotion,
    /// Lower corner and sides of two boxes: of the last state as measured, and of the closed form.
    pub(crate) boxes: [Option<[DVec3; 2]>; 2],
}

impl ShownMotion {
    /// The exact states of a draft.
    pub(crate) fn exact(draft: &Draft, key: u64) -> Self {
        let mut states = vec![draft.start()];
        let mut compact_order = LayerOrder::default();
        let mut first = 1.0;
        if let Some(UnitDraft { units, .. }) = draft.units() {
            states.extend([units.sheet.planar(), units.compact()]);
            compact_order = units.compact_order_within(MAX_ORDERED).unwrap_or_default();
            first = 0.0;
        }
        let frames = states
            .into_iter()
            .zip(0_u32..)
            .map(|(positions, k)| Frame { time: first + f64::from(k), positions });
        let motion =
            Motion { sheet: draft.sheet().clone(), frames: frames.collect(), compact_order };
        Self::new(MotionSource::Exact(motion), key).with_draft(draft)
    }

    pub(crate) fn preview(draft: &Draft, preview: Preview, scene: &Scene, key: u64) -> Self {
        let Preview { motion, series, boxes } = preview;
        let (closed_form, unit) = match draft {
            Draft::Units(units) => {
                let unit = scene.profile.unit.unwrap_or_default();
                (units.closed_form, unit.name())
            }
            Draft::Imported(study) => (None, study.unit_name),
        };
        let mut shown = Self::new(MotionSource::Preview(motion), key).with_draft(draft);
        shown.plots = plots_of(&series, &boxes, closed_form, unit);
        shown
    }

    pub(crate) fn run(finished: &FinishedRun, key: u64) -> Self {
        let FinishedRun { study, folded, report, boxes } = finished;
        let source = MotionSource::Run {
            study: Arc::clone(study),
            folded: Arc::clone(folded),
            report: Box::new(report.clone()),
        };
        let mut shown = Self::new(source, key);
        if let Some(units) = study.subject.units() {
            shown = shown.with_units(&units.units, &units.profile, &units.deployed);
        }
        let closed_form = study.subject.closed_form();
        let series = &folded.findings.series;
        shown.plots = plots_of(series, boxes, closed_form, study.unit_name);
        shown.add_collisions(&folded.findings.collision);
        shown.marks.jam = folded.jam().map(|jam| jam.time);
        shown
    }

    /// A motion file; `checked` is the result of its check, once that is known.
    pub(crate) fn file(
        motion: Arc<OpenedMotion>,
        checked: Option<CheckedMotion>,
        key: u64,
    ) -> Self {
        let unit = motion.unit_name().to_owned();
        let findings = checked.as_ref().map(|checked| Arc::clone(&checked.findings));
        let source = MotionSource::File { motion, checked: checked.map(Box::new) };
        let mut shown = Self::new(source, key);
        if let Some(findings) = findings {
            shown.plots = plots_of(&findings.series, &[], None, &unit);
            shown.add_collisions(&findings.collision);
        }
        shown
    }

    fn new(source: MotionSource, key: u64) -> Self {
        let mut shown = Self {
            source,
            key,
            layers: Layers::default(),
            plots: Plots::default(),
            marks: Marks::default(),
            spans: Vec::new(),
            contact_points: Vec::new(),
            profile: Vec::new(),
            placement: RigidMotion::IDENTITY,
            boxes: [None; 2],
        };
        let motion = shown.motion();
        let last = motion.frames.last().map_or(&[][..], |frame| &frame.positions);
        let layers = Layers::new(&motion.sheet, &motion.compact_order, last);
        let measured = bounds(last);
        let frames: Vec<f64> = motion.frames.iter().map(|frame| frame.time).collect();
        shown.marks.reached = frames.last().copied();
        shown.marks.frames = frames;
        shown.layers = layers;
        shown.boxes[0] = measured;
        shown
    }

    /// Adds the profile and the closed-form box of a draft.
    fn with_draft(self, draft: &Draft) -> Self {
        match draft.units() {
            Some(d) => self.with_units(&d.units, &d.profile, &d.deployed),
            None => self,
        }
    }

    fn with_units(mut self, units: &UnitSheet, profile: &Profile, deployed: &[DVec3]) -> Self {
        let first = self.motion().frames.first();
        if let Some(first) = first.filter(|frame| frame.positions.len() == deployed.len()) {
            self.placement = RigidMotion::best_fit(deployed, &first.positions);
            let point = |k: u32| {
                let p = profile.position(f64::from(k) / f64::from(PROFILE_POINTS));
                self.placement.apply(DVec3::new(p.x, 0.0, p.y))
            };
            self.profile = (0..=PROFILE_POINTS).map(point).collect();
        }
        if units.closed_form().is_some() {
            // The last state lies where the exact compact state does, so its box needs no placement.
            self.boxes[1] = bounds(&units.compact());
        }
        self
    }

    fn add_collisions(&mut self, collision: &CollisionReport) {
        self.spans = penetration_spans(self.motion(), collision);
        self.contact_points = collision.penetrations.iter().map(|p| p.point).collect();
        let mut times: Vec<f64> = self.spans.iter().map(|span| span.from).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        self.marks.penetrations = times;
    }

    pub(crate) fn motion(&self) -> &Motion {
        match &self.source {
            MotionSource::Exact(motion) | MotionSource::Preview(motion) => motion,
            MotionSource::Run { folded, .. } => &folded.motion,
            MotionSource::File { motion, .. } => motion.motion(),
        }
    }

    /// The motion file that was opened, if this is one.
    pub(crate) fn opened(&self) -> Option<&Arc<OpenedMotion>> {
        match &self.source {
            MotionSource::File { motion, .. } => Some(motion),
            _ => None,
        }
    }

    /// What to say if the scene has changed since this motion was computed.
    pub(crate) fn out_of_date_text(&self) -> &'static str {
        match self.source {
            MotionSource::Run { .. } => "Out of date: the scene has changed since this run",
            _ => "Out of date: the scene has changed",
        }
    }

    /// Whether there is nothing between its states.
    pub(crate) fn is_exact(&self) -> bool {
        matches!(self.source, MotionSource::Exact(_))
    }

    /// Whether it is a run or a motion file.
    pub(crate) fn can_be_recorded(&self) -> bool {
        matches!(self.source, MotionSource::Run { .. } | MotionSource::File { .. })
    }

    /// Records it in the background; `None` if it cannot be recorded.
    pub(crate) fn record(
        &self,
        scene: &RecordScene,
        folder: PathBuf,
        repaint: RepaintSignal,
    ) -> Option<Job<Vec<String>>> {
        let scene = scene.clone();
        match &self.source {
            MotionSource::Run { study, folded, .. } => {
                let (study, folded) = (Arc::clone(study), Arc::clone(folded));
                Some(record(study, folded, scene, folder, repaint))
            }
            MotionSource::File { motion, checked } => {
                let findings = checked.as_ref().map(|checked| &checked.findings);
                let (motion, findings) = (Arc::clone(motion), findings.cloned());
                Some(record_opened(motion, findings, scene, folder, repaint))
            }
            MotionSource::Exact(_) | MotionSource::Preview(_) => None,
        }
    }

    /// Writes all results of a run in the background; `None` if this is not a run.
    pub(crate) fn write(
        &self,
        folder: PathBuf,
        repaint: RepaintSignal,
    ) -> Option<Job<Vec<String>>> {
        match &self.source {
            MotionSource::Run { study, folded, .. } => {
                let (study, folded) = (Arc::clone(study), Arc::clone(folded));
                Some(write(study, folded, folder, repaint))
            }
            _ => None,
        }
    }

    /// The centre of the bounding box at motion time `t`.
    pub(crate) fn middle(&self, t: f64) -> Option<DVec3> {
        bounds(&self.state(t)).map(|[low, sides]| low + 0.5 * sides)
    }

    /// The vertices of the first, middle and last states, which show the extent of the motion.
    pub(crate) fn reach(&self) -> Vec<DVec3> {
        let frames = &self.motion().frames;
        let some = [0, frames.len() / 2, frames.len().saturating_sub(1)];
        some.iter()
            .filter_map(|&k| frames.get(k))
            .flat_map(|frame| frame.positions.iter().copied())
            .collect()
    }

    /// The first and the last motion time of the whole motion, even if it ended early.
    pub(crate) fn range(&self) -> [f64; 2] {
        let first = self.motion().frames.first().map_or(0.0, |frame| frame.time);
        [first.min(1.0), 2.0]
    }

    /// The state at motion time `t`; of exact states, the nearest one.
    pub(crate) fn state(&self, t: f64) -> Vec<DVec3> {
        let motion = self.motion();
        if matches!(self.source, MotionSource::Exact(_)) {
            let distance = |frame: &&Frame| (frame.time - t).abs();
            let nearest = |a: &&Frame, b: &&Frame| distance(a).total_cmp(&distance(b));
            let frame = motion.frames.iter().min_by(nearest);
            return frame.map_or_else(Vec::new, |frame| frame.positions.clone());
        }
        positions_at(motion, t)
    }

    /// The triangles that penetrate at motion time `t`, and the points where they met.
    pub(crate) fn penetrating(&self, t: f64) -> (Vec<u32>, Vec<DVec3>) {
        let now = self.spans.iter().zip(&self.contact_points);
        let now = now.filter(|(span, _)| span.from <= t && t <= span.to);
        let (mut faces, mut points) = (Vec::new(), Vec::new());
        for (span, &point) in now {
            faces.extend(span.faces);
            points.push(point);
        }
        (faces, points)
    }
}

/// The largest number of pairs in the layer order of exact states, which is computed while the user waits.
const MAX_ORDERED: usize = 500_000;

/// Lower corner and sides of the bounding box of `points`.
fn bounds(points: &[DVec3]) -> Option<[DVec3; 2]> {
    let low = points.iter().copied().reduce(DVec3::min)?;
    let high = points.iter().copied().reduce(DVec3::max)?;
    Some([low, high - low])
}
