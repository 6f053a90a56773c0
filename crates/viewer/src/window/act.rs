//! The motion at hand, wherever it comes from, with all that the window shows of it.

use std::sync::Arc;

use foldmotion_check::{CollisionReport, FittedBox, PenetrationSpan, penetration_spans};
use foldmotion_geometry::RigidMotion;
use foldmotion_pattern::{Frame, LayerOrder, Motion};
use foldmotion_record::{Layers, positions_at};
use foldmotion_study::{Draft, Folded, Report, Study, UnitDraft};
use glam::DVec3;

use super::figures::curves;
use crate::timeline::{Curves, Marks};

/// Points of the profile that are drawn.
const PROFILE_POINTS: u32 = 240;

/// Where a motion comes from.
#[derive(Debug)]
pub(crate) enum Source {
    /// The exact deployed, planar and compact states of the scene; nothing between.
    Exact(Motion),
    /// Folded quickly, without contact, not checked.
    Preview(Motion),
    /// A run, checked.
    Run {
        study: Arc<Study>,
        folded: Arc<Folded>,
        report: Box<Report>,
    },
}

/// A motion with all that the window shows of it.
#[derive(Debug)]
pub(crate) struct Act {
    pub(crate) source: Source,
    /// Another number for each.
    pub(crate) key: u64,
    pub(crate) layers: Layers,
    pub(crate) curves: Curves,
    pub(crate) marks: Marks,
    spans: Vec<PenetrationSpan>,
    /// Where facets meet, one a span.
    meetings: Vec<DVec3>,
    /// Γ where the deployed state stands.
    pub(crate) profile: Vec<DVec3>,
    /// The lower corner and the sides of the measured box of the last state, and of the closed form.
    pub(crate) boxes: [Option<[DVec3; 2]>; 2],
}

impl Act {
    /// The exact states of a draft.
    pub(crate) fn exact(draft: &Draft, key: u64) -> Self {
        let mut states = vec![draft.start()];
        let mut compact_order = LayerOrder::default();
        let mut first = 1.0;
        if let Some(UnitDraft { units, .. }) = draft.units() {
            states.extend([units.sheet.planar(), units.compact()]);
            compact_order = units.compact_order_within(MOST_ORDERED).unwrap_or_default();
            first = 0.0;
        }
        let frames = states.into_iter().zip(0_u32..).map(|(positions, k)| Frame {
            time: first + f64::from(k),
            positions,
        });
        let motion = Motion {
            sheet: draft.sheet().clone(),
            frames: frames.collect(),
            compact_order,
        };
        Self::new(Source::Exact(motion), key).beside(draft)
    }

    /// A motion that was folded quickly.
    pub(crate) fn preview(draft: &Draft, motion: Motion, key: u64) -> Self {
        Self::new(Source::Preview(motion), key).beside(draft)
    }

    /// A run.
    pub(crate) fn run(draft: &Draft, study: Arc<Study>, folded: Arc<Folded>, key: u64) -> Self {
        let report = Box::new(study.report_of(&folded));
        let boxes = study.boxes(&folded.motion);
        let (unit, closed_form) = (study.unit_name, study.subject.closed_form());
        let source = Source::Run {
            study,
            folded: Arc::clone(&folded),
            report,
        };
        let mut act = Self::new(source, key).beside(draft);
        act.curves = curves(&folded.findings.series, &boxes, closed_form, unit);
        act.judge(&folded.findings.collision);
        act.marks.jam = folded.jam().map(|jam| jam.time);
        act
    }

    fn new(source: Source, key: u64) -> Self {
        let mut act = Self {
            source,
            key,
            layers: Layers::default(),
            curves: Curves::default(),
            marks: Marks::default(),
            spans: Vec::new(),
            meetings: Vec::new(),
            profile: Vec::new(),
            boxes: [None; 2],
        };
        let motion = act.motion();
        let last = motion.frames.last().map_or(&[][..], |frame| &frame.positions);
        let layers = Layers::new(&motion.sheet, &motion.compact_order, last);
        let measured = bounds(last);
        let frames: Vec<f64> = motion.frames.iter().map(|frame| frame.time).collect();
        act.marks.reached = frames.last().copied();
        act.marks.frames = frames;
        act.layers = layers;
        act.boxes[0] = measured;
        act
    }

    /// What the draft adds: the profile and the box of the closed form.
    fn beside(mut self, draft: &Draft) -> Self {
        let Some(units) = draft.units() else {
            return self;
        };
        let first = self.motion().frames.first();
        if let Some(first) = first.filter(|f| f.positions.len() == units.deployed.len()) {
            let place = RigidMotion::best_fit(&units.deployed, &first.positions);
            let point = |k: u32| {
                let p = units.profile.position(f64::from(k) / f64::from(PROFILE_POINTS));
                place.apply(DVec3::new(p.x, 0.0, p.y))
            };
            self.profile = (0..=PROFILE_POINTS).map(point).collect();
        }
        if units.closed_form.is_some() {
            // The last state lies where it best fits the exact one, so the exact one's box is in place.
            self.boxes[1] = bounds(&units.units.compact());
        }
        self
    }

    fn judge(&mut self, collision: &CollisionReport) {
        self.spans = penetration_spans(self.motion(), collision);
        self.meetings = collision.penetrations.iter().map(|p| p.point).collect();
        let mut times: Vec<f64> = self.spans.iter().map(|span| span.from).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        self.marks.penetrations = times;
    }

    /// The motion.
    pub(crate) fn motion(&self) -> &Motion {
        match &self.source {
            Source::Exact(motion) | Source::Preview(motion) => motion,
            Source::Run { folded, .. } => &folded.motion,
        }
    }

    /// The first and the last motion time that can be shown: those of the whole motion, however far it came.
    pub(crate) fn range(&self) -> [f64; 2] {
        let first = self.motion().frames.first().map_or(0.0, |frame| frame.time);
        [first.min(1.0), 2.0]
    }

    /// The state at motion time `t`; of exact states the nearest.
    pub(crate) fn state(&self, t: f64) -> Vec<DVec3> {
        let motion = self.motion();
        if matches!(self.source, Source::Exact(_)) {
            let distance = |frame: &&Frame| (frame.time - t).abs();
            let nearest = |a: &&Frame, b: &&Frame| distance(a).total_cmp(&distance(b));
            let frame = motion.frames.iter().min_by(nearest);
            return frame.map_or_else(Vec::new, |frame| frame.positions.clone());
        }
        positions_at(motion, t)
    }

    /// The triangles that penetrate at motion time `t`, and where they met.
    pub(crate) fn penetrating(&self, t: f64) -> (Vec<u32>, Vec<DVec3>) {
        let now = self.spans.iter().zip(&self.meetings);
        let now = now.filter(|(span, _)| span.from <= t && t <= span.to);
        let (mut faces, mut points) = (Vec::new(), Vec::new());
        for (span, &point) in now {
            faces.extend(span.faces);
            points.push(point);
        }
        (faces, points)
    }
}

/// Pairs of the order of the exact compact state, at most: it is built while a hand waits.
const MOST_ORDERED: usize = 2_000_000;

/// The lower corner and the sides of the box around `points`.
fn bounds(points: &[DVec3]) -> Option<[DVec3; 2]> {
    let low = points.iter().copied().reduce(DVec3::min)?;
    let high = points.iter().copied().reduce(DVec3::max)?;
    Some([low, high - low])
}
