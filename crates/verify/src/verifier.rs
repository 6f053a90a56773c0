//! The second proof, frame by frame, holding two frames at a time.

use std::collections::{BTreeMap, BTreeSet};

use foldmotion_pattern::{Assignment, Frame, Motion, Sheet};
use glam::DVec3;
use rayon::prelude::*;

use crate::boxes::Boxes;
use crate::closest::closest;
use crate::distance::{DistanceProof, keeps_distance};
use crate::face_pair::{FacePair, assignments, front_normal};
use crate::findings::PairFindings;
use crate::follow::{FollowOutcome, SideCrossing, follow_leniently};
use crate::layer_state::LayerState;
use crate::line;
use crate::lost::{LostSide, PairSet};
use crate::moving_pair::MovingPair;
use crate::neighbourhood::Neighbourhood;
use crate::outcome::{Refutation, Unproved, Verification};
use crate::parts::disjoint_parts;
use crate::penetration::FoundPenetration;
use crate::side::{Limits, Side};
use crate::statement;
use crate::through::Piercing;
use foldmotion_check::{CollisionReport, Penetration, Verdict};

/// The largest number of steps spent on a pair in an interval.
const BUDGET: u32 = 1 << 16;
/// Pairs farther apart than this multiple of τ surely do not touch; the first proof resolves distances to τ/100.
pub(crate) const SURELY_APART: f64 = 1.02;
/// Pairs nearer than this multiple of τ surely touch: a verdict of *free* states that there are none.
pub(crate) const SURELY_TOUCHING: f64 = 0.98;
/// Twice a bound of the rounding error of a distance, in units of ε and the size of the pair.
const DISTANCE_ROUNDINGS: f64 = 512.0;
/// The largest number of refutations that are listed; further ones are about the same motion.
const MOST_LISTED: usize = 20;
/// The accuracy to which the stated points are attained, in units of length.
pub(crate) const POINT_ACCURACY: f64 = 1e-9;

/// Proves the statement of a collision report again, by other means.
#[derive(Debug)]
pub struct Verifier<'a> {
    pub(crate) sheet: &'a Sheet,
    pub(crate) claim: &'a CollisionReport,
    pub(crate) limits: Limits,
    pub(crate) last: Frame,
    /// The largest distance, in any frame, of a vertex from the first vertex of the first frame.
    reach: f64,
    reference: DVec3,
    /// The number of frames accepted so far.
    pub(crate) frames: usize,
    /// Whether a frame was given about which nothing is stated.
    pub(crate) is_over: bool,
    /// The sides of the pairs in contact, ordered by pair.
    pub(crate) sides: Vec<([u32; 2], Side)>,
    pub(crate) claimed: BTreeMap<[u32; 2], &'a Penetration>,
    pub(crate) undecided: BTreeSet<([u32; 2], usize)>,
    /// Pairs that have penetrated, and the number of intervals in which each was judged.
    pub(crate) dropped: BTreeMap<[u32; 2], usize>,
    pub(crate) around: Neighbourhood,
    /// Pairs that could not be followed to the end of the previous interval.
    pub(crate) lost: PairSet,
    /// For pairs with ambiguous sides, those that fit together with the sides beyond an edge.
    pub(crate) narrowed: BTreeMap<[u32; 2], Side>,
    /// Pairs at which a passage was found.
    pub(crate) accounted: PairSet,
    /// Pairs for which it is open whether something passes.
    pub(crate) questioned: PairSet,
    /// Whether an edge was found to pass through the sheet where nothing is listed.
    pub(crate) is_pierced: bool,
    /// Listed penetrations that have not been found yet, with the piercings at the end of the last interval.
    pub(crate) pending: Vec<(&'a Penetration, Vec<Piercing>)>,
    pub(crate) surely_touching: BTreeSet<[u32; 2]>,
    pub(crate) perhaps_touching: BTreeSet<[u32; 2]>,
    /// Why the stated closest approach is not attained; `None` if it is or has not been examined.
    pub(crate) separation_error: Option<String>,
    pub(crate) is_separation_met: bool,
    pub(crate) layer_state: LayerState,
    pub(crate) outcome: Verification,
}

/// Proves the statement of a collision report about a motion again; the file claims nothing about the order of layers.
///
/// Preconditions: those of [`Verifier::new`]; a motion without frames verifies nothing.
pub fn verify(motion: &Motion, claim: &CollisionReport) -> Verification {
    let mut frames = motion.frames.iter().cloned();
    let Some(first) = frames.next() else {
        return Verification::default();
    };
    let mut verifier = Verifier::new(&motion.sheet, first, claim);
    frames.for_each(|frame| verifier.advance(frame));
    verifier.finish()
}

impl<'a> Verifier<'a> {
    /// Accepts the first frame. `claim`: what the certificate states; its counts of work and of touching pairs, and its
    /// series of separations, are ignored.
    ///
    /// Preconditions: the corners of the sheet are in range; every frame has a finite position for every vertex.
    pub fn new(sheet: &'a Sheet, first: Frame, claim: &'a CollisionReport) -> Self {
        let unit = sheet.unit_length;
        let of_pairs = claim.penetrations.iter().filter(|p| p.conflict.is_none());
        let mut verifier = Self {
            sheet,
            claim,
            limits: Limits { tolerance: claim.tolerance * unit, budget: BUDGET },
            reach: 0.0,
            reference: first.positions[0],
            last: first,
            frames: 1,
            is_over: false,
            sides: Vec::new(),
            claimed: of_pairs.map(|p| (p.faces, p)).collect(),
            undecided: claim.undecided.iter().map(|u| (u.faces, u.frame)).collect(),
            dropped: BTreeMap::new(),
            around: Neighbourhood::new(sheet),
            lost: BTreeSet::new(),
            accounted: BTreeSet::new(),
            questioned: BTreeSet::new(),
            is_pierced: false,
            pending: Vec::new(),
            narrowed: BTreeMap::new(),
            surely_touching: BTreeSet::new(),
            perhaps_touching: BTreeSet::new(),
            separation_error: None,
            is_separation_met: claim.min_separation.is_none(),
            layer_state: LayerState::new(line::hinges(sheet)),
            outcome: Verification::default(),
        };
        verifier.begin();
        verifier
    }

    /// Accepts the next frame and proves the interval before it. Nothing is stated, or proved, about frames after the
    /// one at which the check stopped.
    pub fn advance(&mut self, frame: Frame) {
        let last = self.claim.stopped.map(|stopped| stopped.frame);
        if last.is_some_and(|last| self.frames > last) {
            self.is_over = true;
            return;
        }
        self.prove_layers();
        let start = std::mem::replace(&mut self.last, frame);
        self.extend_reach();
        self.meet_separation(&start);
        let near = self.near_pairs(&start.positions);
        self.outcome.near += near.len() as u64;
        self.search_unlisted(&start, &near);
        let pairs: Vec<FacePair> = near
            .iter()
            .filter(|faces| !self.dropped.contains_key(*faces))
            .map(|&faces| FacePair::new(self.sheet, faces))
            .filter(|pair| pair.shared < 3)
            .collect();
        let mut judged: Vec<PairFindings> =
            pairs.par_iter().with_min_len(64).map(|pair| self.judge(pair, &start)).collect();
        self.sides.clear();
        let times = [start.time, self.last.time];
        self.account(&start, &pairs, &mut judged);
        self.narrowed.clear();
        let mut open = self.lost.clone();
        for (pair, judged) in pairs.iter().zip(judged) {
            if judged.unproved.is_some() {
                open.insert(pair.faces);
            }
            self.record(pair, judged, times);
        }
        self.narrow_sides();
        let faces = self.sheet.faces.len() as u64;
        self.outcome.pairs += faces * faces.saturating_sub(1) / 2;
        self.frames += 1;
        self.find_layers(&near, &open);
    }

    /// The result of the verification.
    pub fn finish(mut self) -> Verification {
        if self.frames == 1 {
            self.finish_at_rest();
        }
        self.leave_pending_open();
        self.prove_layers();
        self.compare_clusters();
        if let Some(separation) = self.claim.min_separation.filter(|_| !self.is_separation_met) {
            let mismatch = self.separation_error.take();
            let found =
                mismatch.unwrap_or_else(|| "the motion does not include this time".to_owned());
            self.refute(
                "min_separation",
                format!("{:e} at t = {}", separation.attained, separation.time),
                found,
            );
        }
        let missing: Vec<_> = self
            .claimed
            .iter()
            .filter(|(faces, _)| !self.dropped.contains_key(*faces))
            .map(|(_, p)| (p.faces, p.frame))
            .collect();
        for (faces, frame) in missing {
            let open = self.outcome.unproved.iter();
            let is_open = open.into_iter().any(|u| u.faces == faces && u.frame == frame);
            if !is_open {
                self.refute(
                    "penetrations",
                    format!("triangles {faces:?} penetrate after frame {frame}"),
                    "they do not",
                );
            }
        }
        self.outcome.touching = [self.surely_touching.len(), self.perhaps_touching.len()];
        let facts = statement::Findings {
            sheet: self.sheet,
            last: (self.frames - 1, self.last.time),
            touching: self.outcome.touching,
            rounding: DISTANCE_ROUNDINGS * f64::EPSILON * self.reach / self.sheet.unit_length,
        };
        for refutation in statement::consistency(self.claim, &facts) {
            self.outcome.refuted.push(refutation);
        }
        for undecided in &self.claim.undecided {
            self.outcome.unproved.push(Unproved {
                faces: undecided.faces,
                frame: undecided.frame,
                what: "the certificate leaves the pair undecided".to_owned(),
            });
        }
        self.outcome
    }

    pub(crate) fn refute(&mut self, field: &str, stated: impl ToString, found: impl ToString) {
        if self.outcome.refuted.len() < MOST_LISTED {
            let refutation = Refutation::new(field, stated, found);
            self.outcome.refuted.push(refutation);
        }
    }

    /// Handles the first frame: which sides are possible, and which pairs are too deep already.
    fn begin(&mut self) {
        self.extend_reach();
        let first = self.last.positions.clone();
        let assignments = assignments(self.sheet);
        let near = self.near_pairs(&first);
        for &faces in &near {
            let pair = FacePair::new(self.sheet, faces);
            if pair.shared > 2 {
                self.refute(
                    "triangles",
                    "each triangle once",
                    format!("{faces:?} have the same corners"),
                );
                continue;
            }
            let moving = pair.moving(&first, &first);
            match Side::at_start(&moving, &self.limits) {
                Some(side) if side.is_apart => {}
                Some(mut side) => {
                    let parts = disjoint_parts(&moving).into_iter();
                    let distances = parts.map(|part| closest(&part.at(0.0)).distance());
                    let least = distances.fold(f64::INFINITY, f64::min);
                    let limits = [SURELY_TOUCHING, SURELY_APART];
                    let touching = limits.map(|share| least < share * self.limits.tolerance);
                    self.note_touching(faces, touching);
                    let front = front_normal(self.sheet, faces[0], &first);
                    let towards = match assignments.get(&faces) {
                        Some(Assignment::Valley) => front,
                        Some(Assignment::Mountain) => -front,
                        _ => DVec3::ZERO,
                    };
                    let keeps = |d: &DVec3| d.dot(towards) > 0.5;
                    if side.directions.iter().any(keeps) {
                        side.directions.retain(keeps);
                    }
                    self.sides.push((faces, side));
                }
                None => self.starts_lost(&pair, &moving),
            }
        }
        self.find_layers(&near, &BTreeSet::new());
        self.uncoupled_at_rest(&near);
        self.narrow_sides();
        let first = self.last.clone();
        self.search_unlisted(&first, &near);
        self.meet_separation(&first);
    }

    fn extend_reach(&mut self) {
        let far = self.last.positions.iter();
        let far = far.map(|p| p.distance(self.reference));
        self.reach = far.fold(self.reach, f64::max);
    }

    /// The pairs whose swept boxes come as near as τ or the stated closest approach.
    pub(crate) fn near_pairs(&self, start: &[DVec3]) -> Vec<[u32; 2]> {
        let stated = self.claim.min_separation.map_or(0.0, |s| s.distance);
        let unit = self.sheet.unit_length;
        let radius = 0.5 * (SURELY_APART * self.limits.tolerance).max(stated * unit);
        // Relative to a vertex, so that rounding to f32 depends on the size of the sheet and not on its position.
        let origin = start[0];
        let mut boxes = Boxes::default();
        for corners in &self.sheet.faces {
            let swept = corners.iter().flat_map(|&v| {
                [start[v as usize] - origin, self.last.positions[v as usize] - origin]
            });
            boxes.push(swept, radius);
        }
        boxes.overlapping()
    }

    fn judge(&self, pair: &FacePair, start: &Frame) -> PairFindings {
        let moving = pair.moving(&start.positions, &self.last.positions);
        let known = self.sides.binary_search_by(|(faces, _)| faces.cmp(&pair.faces));
        let known = known.ok().map(|index| &self.sides[index].1);
        let interval = self.frames - 1;
        if self.undecided.contains(&(pair.faces, interval)) {
            return PairFindings { is_skipped: true, ..PairFindings::default() };
        }
        let mut judged = PairFindings::default();
        let mut is_apart = false;
        if pair.shared == 0 {
            is_apart = self.measure(pair, &moving, &mut judged);
        }
        if is_apart && known.is_none() {
            return judged;
        }
        self.follow(pair, &moving, known, &mut judged);
        judged
    }

    /// Whether the pair stays farther apart than τ; also records whether it comes nearer than stated.
    fn measure(&self, pair: &FacePair, moving: &MovingPair, judged: &mut PairFindings) -> bool {
        let apart = SURELY_APART * self.limits.tolerance;
        let limit = self
            .least_distance()
            .filter(|_| pair.is_measured(self.sheet))
            .map(|limit| limit - DISTANCE_ROUNDINGS * f64::EPSILON * moving.size);
        if let Some(limit) = limit.filter(|&limit| limit > 0.0) {
            match keeps_distance(moving, limit, BUDGET) {
                DistanceProof::Kept if limit >= apart => return true,
                DistanceProof::Kept => {}
                DistanceProof::Nearer { time, distance } => judged.nearer = Some((time, distance)),
                DistanceProof::Unproved => judged.unproved = Some("the closest approach"),
            }
        }
        if self.surely_touching.contains(&pair.faces) {
            return false;
        }
        let is_sure = match keeps_distance(moving, apart, BUDGET) {
            DistanceProof::Kept => return true,
            DistanceProof::Nearer { distance, .. } => {
                distance < SURELY_TOUCHING * self.limits.tolerance
            }
            DistanceProof::Unproved => false,
        };
        judged.touching = [is_sure, true];
        if !is_sure && self.claim.verdict == Verdict::Free {
            self.keeps_free(moving, judged);
        }
        false
    }

    /// Tests whether a pair near τ stays as far apart as a verdict of *free* states.
    fn keeps_free(&self, moving: &MovingPair, judged: &mut PairFindings) {
        match keeps_distance(moving, SURELY_TOUCHING * self.limits.tolerance, BUDGET) {
            DistanceProof::Kept => {}
            DistanceProof::Nearer { .. } => judged.touching = [true, true],
            DistanceProof::Unproved => judged.unproved = Some("whether they touch"),
        }
    }

    /// The lower bound to be proved for all distances: the stated one, to the accuracy of this proof.
    fn least_distance(&self) -> Option<f64> {
        let stated = self.claim.min_separation?.distance * self.sheet.unit_length;
        Some(stated - (1e-3 * self.limits.tolerance).max(1e-5 * stated))
    }

    fn follow(
        &self,
        pair: &FacePair,
        moving: &MovingPair,
        known: Option<&Side>,
        judged: &mut PairFindings,
    ) {
        judged.is_followed = true;
        let fresh = Side { is_apart: true, directions: Vec::new() };
        let was_undecided =
            self.frames > 1 && self.undecided.contains(&(pair.faces, self.frames - 2));
        let was_lost = was_undecided || self.lost.contains(&pair.faces);
        let anew = was_lost.then(|| Side::at_start(moving, &self.limits)).flatten();
        let side = known.or(anew.as_ref()).unwrap_or(&fresh);
        let lost = |crossing: Option<SideCrossing>| {
            let found =
                crossing.map(|crossing| FoundPenetration::new(moving, self.frames - 1, crossing));
            let is_open = self.frames == 1 || was_lost;
            LostSide::new(moving, (side, is_open), found, &self.limits)
        };
        match follow_leniently(moving, side, &self.limits) {
            FollowOutcome::Clean { side, trail } => {
                if pair.shared > 0 {
                    self.measure_parts(moving, judged);
                }
                judged.side = (!side.is_apart).then_some(side);
                judged.trail = trail;
                self.follow_narrowed(pair, moving, judged);
            }
            FollowOutcome::Crosses(crossing) => {
                let lost = lost(Some(crossing));
                judged.touching =
                    if lost.is_deep { [false; 2] } else { [judged.touching[0], true] };
                judged.lost = Some(lost);
            }
            FollowOutcome::Undecided { .. } => {
                judged.touching[1] = true;
                judged.lost = Some(lost(None));
            }
        }
    }

    fn record(&mut self, pair: &FacePair, judged: PairFindings, times: [f64; 2]) {
        let faces = pair.faces;
        let at = |t: f64| times[0] + (times[1] - times[0]) * t;
        self.outcome.followed += u64::from(judged.is_followed);
        self.note_touching(faces, judged.touching);
        if let Some((time, distance)) = judged.nearer {
            let unit = self.sheet.unit_length;
            let stated = self.claim.min_separation.map_or(0.0, |s| s.distance);
            let found =
                format!("triangles {faces:?} are {:e} apart at t = {}", distance / unit, at(time));
            self.refute("min_separation.distance", format!("{stated:e}"), found);
        }
        if let Some(what) = judged.unproved {
            self.leave_open(faces, what);
        }
        if let Some(side) = judged.side {
            self.sides.push((faces, side));
        }
        if let Some(side) = judged.narrowed {
            self.narrowed.insert(faces, side);
        }
    }
}
