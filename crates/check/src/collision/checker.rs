//! The check, frame by frame: which pairs are judged in an interval, and what is remembered about them.

use std::collections::{BTreeMap, BTreeSet};

use foldmotion_geometry::{
    Aabb,
    collide::{Effort, Limits, MovingPair, Side, Tree, closest_approach},
    triangle_triangle,
};
use foldmotion_pattern::{Assignment, Frame, Sheet};
use glam::DVec3;
use rayon::prelude::*;

use super::{
    closest_approach::ClosestApproach,
    face_pair::{FacePair, facets_share_a_vertex},
    frame::CentredFrame,
    judge::{DistanceBounds, Judgement, PairTest, Suspect, may_be_near, starts_deep},
    report::{
        CollisionOptions, CollisionReport, FilterCounts, PairCounts, Penetration, Stopped, Verdict,
    },
};
use crate::{
    CheckError,
    crossings::CrossingCounter,
    layers::{Claims, FaceEdges, LayerPair, front_normal},
};

/// The tolerance must be at least this many bounds of rounding errors, so that the offsets that bring a motion into
/// general position, 1/4096 of the tolerance, exceed rounding.
const ROUNDINGS: f64 = 4096.0;
/// The number of pairs below which starting another thread does not pay.
const PAIRS_A_TASK: usize = 128;

/// Judges a motion frame by frame, holding two frames at a time.
#[derive(Debug)]
pub struct Checker<'a> {
    pub(super) sheet: &'a Sheet,
    pub(super) edges: FaceEdges,
    /// τ, a length.
    pub(super) tolerance: f64,
    budget: u32,
    /// Once more pairs than this have penetrated, no further frame is accepted; 0: no limit.
    stop_at: usize,
    pub(super) origin: DVec3,
    tree: Tree,
    pub(super) last: CentredFrame,
    /// The number of frames accepted so far.
    pub(super) frames: usize,
    /// The sides of the pairs judged in the last interval, ordered by pair.
    pub(super) sides: Vec<((u32, u32), Side)>,
    /// Pairs without a side whose boxes overlapped in the last interval: they have penetrated or could not be decided.
    pub(super) unfollowed: Vec<(u32, u32)>,
    /// The layers of the last frame, ordered by pair.
    pub(super) layers: Vec<LayerPair>,
    /// Layers whose order was claimed by the file or an assignment, for as long as they stay in contact.
    pub(super) claimed: BTreeSet<[u32; 2]>,
    /// Whether the layer rules have been tested at the last frame.
    pub(super) is_proved: bool,
    pub(super) penetrating: BTreeSet<(u32, u32)>,
    /// Pairs of layers whose order was found to contradict other orders.
    pub(super) contradicting: BTreeSet<[u32; 2]>,
    pub(super) touching: BTreeSet<(u32, u32)>,
    /// Pairs that may have been within τ in the last interval, in order.
    pub(super) near: Vec<[u32; 2]>,
    /// Pairs that left the side they were followed on although no instant shows them to be surely too deep, with the
    /// last interval in which they did. Whether they pass through each other is decided by the crossing counts.
    pub(super) suspects: BTreeMap<(u32, u32), Suspect>,
    pub(super) crossings: CrossingCounter,
    /// The closest approach so far.
    pub(super) nearest: ClosestApproach,
    pub(super) report: CollisionReport,
}

impl<'a> Checker<'a> {
    /// Accepts the first frame.
    ///
    /// # Errors
    /// A tolerance, unit of length, sheet or frame that cannot be used: see the variants of [`CheckError`].
    pub fn new(
        sheet: &'a Sheet,
        first: &Frame,
        options: &CollisionOptions,
    ) -> Result<Self, CheckError> {
        let value = options.touch_tolerance;
        if !(value > 0.0 && value < 0.1) {
            return Err(CheckError::ToleranceOutOfRange { value });
        }
        if !(sheet.unit_length > 0.0 && sheet.unit_length.is_finite()) {
            let value = sheet.unit_length;
            return Err(CheckError::UnitLength { value });
        }
        validate_faces(sheet)?;
        let hull = Aabb::around(first.positions.iter().copied());
        let centre = (hull.min + hull.max) * 0.5;
        let origin = if centre.is_finite() { centre } else { DVec3::ZERO };
        let last = CentredFrame::new(sheet, first, 0, origin)?;
        let tolerance = value * sheet.unit_length;
        let limits = limits_for(0, last.extent, tolerance, options.budget)?;
        let mut checker = Self {
            sheet,
            edges: FaceEdges::new(sheet),
            tolerance,
            budget: options.budget,
            stop_at: options.stop_at,
            origin,
            tree: Tree::new(&last.boxes),
            last,
            frames: 1,
            sides: Vec::new(),
            unfollowed: Vec::new(),
            layers: Vec::new(),
            claimed: BTreeSet::new(),
            is_proved: false,
            contradicting: BTreeSet::new(),
            penetrating: BTreeSet::new(),
            touching: BTreeSet::new(),
            near: Vec::new(),
            suspects: BTreeMap::new(),
            crossings: CrossingCounter::new(sheet, &limits),
            nearest: ClosestApproach::new(&limits),
            report: empty_report(value),
        };
        checker.measure_separation();
        checker.judge_first_frame(&limits)?;
        checker.count_crossings(None);
        checker.find_layers();
        Ok(checker)
    }

    /// Accepts the next frame and judges the interval before it. Once more pairs have penetrated than
    /// [`CollisionOptions::stop_at`], it does nothing, and [`Self::is_stopped`] returns true from then on.
    ///
    /// # Errors
    /// A frame that cannot be judged: see the variants of [`CheckError`]. The checker is then unchanged.
    pub fn advance(&mut self, frame: &Frame) -> Result<(), CheckError> {
        if self.stops() {
            return Ok(());
        }
        let next = CentredFrame::new(self.sheet, frame, self.frames, self.origin)?;
        let (before, time) = (self.last.time, next.time);
        if time.partial_cmp(&before) != Some(std::cmp::Ordering::Greater) {
            return Err(CheckError::TimeOrder { frame: self.frames, time, before });
        }
        let extent = self.last.extent.max(next.extent);
        let limits = limits_for(self.frames, extent, self.tolerance, self.budget)?;
        self.nearest.extend(&limits);
        self.prove_layers();
        let start = std::mem::replace(&mut self.last, next);
        self.measure_separation();
        self.judge_interval(&start, &limits);
        self.count_crossings(Some(&start));
        self.frames += 1;
        self.find_layers();
        Ok(())
    }

    /// Whether a frame was refused because too many pairs had penetrated.
    pub fn is_stopped(&self) -> bool {
        self.report.stopped.is_some()
    }

    /// Ends the check at the last frame if too many pairs have penetrated. Returns whether the check has ended.
    fn stops(&mut self) -> bool {
        if self.stop_at > 0 && self.penetrating.len() > self.stop_at {
            self.report.stopped = Some(Stopped {
                frame: self.frames - 1,
                time: self.last.time,
                stop_at: self.stop_at,
            });
        }
        self.is_stopped()
    }

    /// The report about the frames accepted so far.
    pub fn finish(mut self) -> CollisionReport {
        self.prove_layers();
        if self.frames == 1 {
            self.bound_only_frame();
        }
        let by_time = |p: &Penetration, q: &Penetration| {
            let by_times = p.time.total_cmp(&q.time).then(p.passed.total_cmp(&q.passed));
            by_times.then(p.faces.cmp(&q.faces))
        };
        self.report.penetrations.sort_by(by_time);
        let unit = self.sheet.unit_length;
        let mut report = self.report;
        report.clusters.sort_by(|p, q| p.frames.cmp(&q.frames).then(p.faces.cmp(&q.faces)));
        report.first = report.penetrations.first().cloned();
        report.touching_pairs = self.touching.len();
        report.min_separation = self.nearest.separation(unit, self.origin);
        let nearest = report.min_separation.as_ref();
        let is_close = nearest.is_some_and(|nearest| nearest.distance <= report.tolerance);
        report.verdict = if report.first.is_some() {
            Verdict::Penetrating
        } else if !report.undecided.is_empty() {
            Verdict::Undecided
        } else if report.touching_pairs > 0 || is_close {
            Verdict::Touching
        } else {
            Verdict::Free
        };
        report
    }

    /// Measures the exact separation at the last frame.
    fn measure_separation(&mut self) {
        let hint = self.nearest.faces();
        let Some((closest, faces)) = self.last.nearest(self.sheet, &mut self.tree, hint) else {
            return;
        };
        let unit = self.sheet.unit_length;
        self.report.separation_series.push(closest.distance / unit);
        self.nearest.keep(faces, self.last.time, closest);
    }

    pub(super) fn is_measured(&self, pair: &FacePair) -> bool {
        let [f, g] = pair.faces;
        pair.shared == 0 && !facets_share_a_vertex(self.sheet, f, g)
    }

    /// Computes the lower bound of the separation for a motion of a single frame.
    fn bound_only_frame(&mut self) {
        let (Some(nearest), Ok(limits)) =
            (self.nearest.distance(), limits_for(0, self.last.extent, self.tolerance, self.budget))
        else {
            return;
        };
        let (radius, time) = (0.5 * nearest, self.last.time);
        let boxes: Vec<_> = self.last.boxes.iter().map(|b| b.inflated(radius)).collect();
        self.tree.refit(&boxes);
        for (f, g) in self.tree.overlapping_pairs(&boxes) {
            let pair = FacePair::new(self.sheet, f, g);
            if self.is_measured(&pair) {
                let still = MovingPair::at_rest(pair.pose(&self.last.positions));
                let distance = DistanceBounds::from(closest_approach(&still, nearest, &limits));
                self.nearest.record(pair.faces, [time; 2], &distance);
            }
        }
    }

    /// Pairs whose boxes, swept from `start` to the last frame, come within τ or within the smallest separation so far.
    fn candidates(&mut self, start: &CentredFrame) -> Vec<FacePair> {
        let nearest = self.nearest.distance().unwrap_or(0.0);
        let radius = 0.5 * nearest.max(self.tolerance);
        let swept: Vec<_> = start
            .boxes
            .iter()
            .zip(&self.last.boxes)
            .map(|(p, q)| p.union(q).inflated(radius))
            .collect();
        self.tree.refit(&swept);
        let pairs = self.tree.overlapping_pairs(&swept);
        pairs.into_iter().map(|(f, g)| FacePair::new(self.sheet, f, g)).collect()
    }

    /// Determines the sides at the first frame.
    fn judge_first_frame(&mut self, limits: &Limits) -> Result<(), CheckError> {
        let swept: Vec<_> = self.last.boxes.iter().map(|b| b.inflated(self.tolerance)).collect();
        self.tree.refit(&swept);
        let assignments = assignments(self.sheet);
        for (f, g) in self.tree.overlapping_pairs(&swept) {
            let pair = FacePair::new(self.sheet, f, g);
            if pair.shared == 3 {
                return Err(CheckError::DuplicateFace { f, g });
            }
            let pose = pair.pose(&self.last.positions);
            if may_be_near(&pair, &MovingPair::at_rest(pose), 0.0, limits) {
                self.near.push([f, g]);
                // For triangles without a common vertex, the distance over the intervals decides whether they touch.
                if pair.shared > 0 || triangle_triangle(&pose.a, &pose.b).distance <= self.tolerance
                {
                    self.touching.insert((f, g));
                }
            }
            match Side::at_start(&pose, limits) {
                Some(Side::Contact(axes)) => {
                    let front = front_normal(self.sheet, f, &self.last.positions);
                    let kept = match assignments.get(&(f, g)) {
                        Some(Assignment::Valley) => on_side(&axes, front),
                        Some(Assignment::Mountain) => on_side(&axes, -front),
                        _ => axes,
                    };
                    self.sides.push(((f, g), Side::Contact(kept)));
                }
                Some(apart) => self.sides.push(((f, g), apart)),
                None => {
                    let times = [self.last.time; 2];
                    self.record_lost_side(&pair, times, starts_deep(&pair, &pose, limits));
                }
            }
        }
        Ok(())
    }

    fn judge_interval(&mut self, start: &CentredFrame, limits: &Limits) {
        let mut pairs = self.candidates(start);
        let faces = self.sheet.faces.len() as u64;
        let all = faces * faces.saturating_sub(1) / 2;
        self.report.decided_by.boxes += all - pairs.len() as u64;
        self.unfollowed.clear();
        self.near.clear();
        pairs.retain(|pair| {
            let is_lost = self.penetrating.contains(&pair.key());
            if is_lost {
                self.unfollowed.push(pair.key());
            }
            !is_lost
        });
        let judged: Vec<Judgement> = pairs
            .par_iter()
            .with_min_len(PAIRS_A_TASK)
            .map(|pair| self.judge(pair, start, limits))
            .collect();
        let times = [start.time, self.last.time];
        self.sides.clear();
        for (pair, judgement) in pairs.iter().zip(judged) {
            self.record(pair, judgement, times);
        }
    }

    fn judge(&self, pair: &FacePair, start: &CentredFrame, limits: &Limits) -> Judgement {
        let moving = MovingPair::new(pair.pose(&start.positions), pair.pose(&self.last.positions));
        let found = self.sides.binary_search_by(|(k, _)| k.cmp(&pair.key()));
        let fresh;
        let side = if let Ok(index) = found {
            Some(&self.sides[index].1)
        } else {
            fresh = Side::at_start(&moving.start, limits);
            fresh.as_ref()
        };
        let nearest = self.nearest.distance().unwrap_or(f64::INFINITY);
        let question = PairTest {
            limits,
            nearer_than: self.is_measured(pair).then_some(nearest),
            has_touched: self.touching.contains(&pair.key()),
        };
        question.judge(pair, &moving, side)
    }

    fn record(&mut self, pair: &FacePair, judgement: Judgement, times: [f64; 2]) {
        let counts = &mut self.report.pairs_tested;
        match pair.shared {
            0 => counts.disjoint += 1,
            1 => counts.shared_vertex += 1,
            _ => counts.shared_crease += 1,
        }
        let decided_by = &mut self.report.decided_by;
        match judgement {
            Judgement::Passed { side, effort, is_touching, is_near, distance } => {
                if is_near {
                    self.near.push(pair.faces);
                }
                match effort {
                    Effort::AxisAtRest => decided_by.axis_at_rest += 1,
                    Effort::TurningAxis => decided_by.turning_axis += 1,
                    Effort::Search => decided_by.search += 1,
                }
                if is_touching {
                    self.touching.insert(pair.key());
                }
                if matches!(side, Side::Apart(_)) {
                    self.claimed.remove(&pair.faces);
                }
                self.sides.push((pair.key(), side));
                self.nearest.record(pair.faces, times, &distance);
            }
            Judgement::Penetrates(evidence) => {
                decided_by.search += 1;
                self.record_lost_side(pair, times, evidence);
            }
            Judgement::Undecided { is_near, distance } => {
                self.nearest.record(pair.faces, times, &distance);
                // Whatever the sides are, the crossing counts decide whether something passes through.
                decided_by.search += 1;
                self.unfollowed.push(pair.key());
                if is_near {
                    self.near.push(pair.faces);
                    self.touching.insert(pair.key());
                }
            }
        }
    }
}

/// The limits used for the verdict up to a frame.
fn limits_for(
    frame: usize,
    extent: f64,
    tolerance: f64,
    budget: u32,
) -> Result<Limits, CheckError> {
    let margin = Limits::margin_for(extent);
    if margin * ROUNDINGS > tolerance {
        return Err(CheckError::ToleranceBelowRounding { frame, extent, margin, tolerance });
    }
    Ok(Limits { tolerance, margin, budget })
}

fn empty_report(tolerance: f64) -> CollisionReport {
    CollisionReport {
        verdict: Verdict::Free,
        tolerance,
        first: None,
        penetrations: Vec::new(),
        touching_pairs: 0,
        stopped: None,
        undecided: Vec::new(),
        min_separation: None,
        separation_series: Vec::new(),
        pairs_tested: PairCounts::default(),
        decided_by: FilterCounts::default(),
        clusters: Vec::new(),
        claims: Claims::default(),
    }
}

fn validate_faces(sheet: &Sheet) -> Result<(), CheckError> {
    let vertices = sheet.vertices.len();
    for (face, corners) in sheet.faces.iter().enumerate() {
        if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= vertices) {
            return Err(CheckError::CornerOutOfRange { face, vertex, vertices });
        }
    }
    Ok(())
}

/// The assignment of the edge between two triangles.
fn assignments(sheet: &Sheet) -> BTreeMap<(u32, u32), Assignment> {
    let mut between = BTreeMap::new();
    for edge in &sheet.edges {
        if let [Some(f), Some(g)] = edge.faces {
            between.insert((f.min(g), f.max(g)), edge.assignment);
        }
    }
    between
}

/// The axes that point to the side of `normal`; all of them if none does.
pub(super) fn on_side(axes: &[DVec3], normal: DVec3) -> Vec<DVec3> {
    let kept: Vec<_> = axes.iter().copied().filter(|d| d.dot(normal) > 0.5).collect();
    if kept.is_empty() { axes.to_vec() } else { kept }
}
