//! Passages through the sheet that were found, compared with the penetrations that are listed.

use std::collections::BTreeMap;

use foldmotion_pattern::Frame;
use rayon::prelude::*;

use crate::coupling::{ContactPair, EdgePassage, NeighbourState, uncoupled};
use crate::distance::{DistanceProof, keeps_distance};
use crate::face_pair::FacePair;
use crate::findings::PairFindings;
use crate::follow::{FollowOutcome, follow_leniently};
use crate::lost::LostSide;
use crate::moving_pair::MovingPair;
use crate::outcome::Unproved;
use crate::parts::disjoint_parts;
use crate::penetration::FoundPenetration;
use crate::trail::Trail;
use crate::verifier::{SURELY_APART, SURELY_TOUCHING, Verifier};
use foldmotion_check::Verdict;

/// The largest number of steps for the distance between parts of triangles.
const PART_BUDGET: u32 = 1 << 12;

/// Evidence that something passes through the sheet.
#[derive(Debug)]
pub(crate) struct PassageEvidence {
    /// The pairs of triangles at which it passes.
    pairs: [[u32; 2]; 2],
    what: String,
    /// Whether it surely passes.
    is_sure: bool,
}

impl Verifier<'_> {
    /// Follows a pair from those of its sides that fit together with the sides of other pairs.
    pub(crate) fn follow_narrowed(
        &self,
        pair: &FacePair,
        moving: &MovingPair,
        judged: &mut PairFindings,
    ) {
        let Some(side) = self.narrowed.get(&pair.faces) else {
            return;
        };
        match follow_leniently(moving, side, &self.limits) {
            FollowOutcome::Clean { side, trail } => {
                judged.narrowed = (!side.is_apart).then_some(side);
                judged.trail = trail.or(judged.trail.take());
            }
            FollowOutcome::Crosses(crossing) => {
                let found = FoundPenetration::new(moving, self.frames - 1, crossing);
                let lost = LostSide::new(moving, (side, false), Some(found), &self.limits);
                judged.lost_narrowed = Some(lost).filter(|lost| lost.is_clear);
            }
            FollowOutcome::Undecided { .. } => {}
        }
    }

    /// Whether a listed penetration accounts for passages around a pair up to a time.
    pub(crate) fn is_listed_around(&self, faces: [u32; 2], time: f64) -> bool {
        self.claimed.values().any(|stated| {
            stated.time <= time
                && self.are_faces(stated.faces)
                && self.around.is_around(stated.faces, faces)
        })
    }

    pub(crate) fn are_faces(&self, [f, g]: [u32; 2]) -> bool {
        f < g && (g as usize) < self.sheet.faces.len()
    }

    /// Evaluates the passages in the interval that begins at `start`.
    pub(crate) fn account(
        &mut self,
        start: &Frame,
        pairs: &[FacePair],
        judged: &mut [PairFindings],
    ) {
        let mut evidence = self.uncoupled(start, pairs, judged);
        let mut found = BTreeMap::new();
        self.lost.clear();
        for (pair, judged) in pairs.iter().zip(judged) {
            if let Some(mut lost) = judged.lost_narrowed.take() {
                if let Some(found) = &mut lost.found {
                    found.times = [start.time, self.last.time];
                }
                evidence.push(self.evidence_of(pair.faces, &lost));
            }
            let Some(mut lost) = judged.lost.take() else {
                continue;
            };
            self.lost.insert(pair.faces);
            if let Some(found) = &mut lost.found {
                found.times = [start.time, self.last.time];
            }
            if lost.is_clear {
                evidence.push(self.evidence_of(pair.faces, &lost));
            } else if !lost.are_parts_clean && !self.is_listed_around(pair.faces, self.last.time) {
                self.leave_open(pair.faces, "whether they penetrate");
            }
            found.insert(pair.faces, lost);
        }
        for evidence in evidence {
            self.take(evidence);
        }
        self.meet_pending(start);
        self.meet_claims(start, &found);
        for (faces, lost) in found {
            if lost.is_deep && !self.dropped.contains_key(&faces) {
                self.drop_deep(faces, &lost);
            }
        }
    }

    pub(crate) fn evidence_of(&self, faces: [u32; 2], lost: &LostSide) -> PassageEvidence {
        let when = lost.found.as_ref().map(|f| f.at(f.crossing.passed));
        let when = when.map_or_else(String::new, |t| format!(", t = {t}"));
        let frame = self.frames - 1;
        PassageEvidence {
            pairs: [faces; 2],
            what: format!("triangles {faces:?} penetrate after frame {frame}{when}"),
            is_sure: true,
        }
    }

    pub(crate) fn leave_open(&mut self, faces: [u32; 2], what: &str) {
        self.outcome.unproved.push(Unproved {
            faces,
            frame: self.frames - 1,
            what: what.to_owned(),
        });
    }

    /// Handles a deep pair that is not listed at this frame.
    pub(crate) fn drop_deep(&mut self, faces: [u32; 2], lost: &LostSide) {
        let evidence = self.evidence_of(faces, lost);
        let stated = self.claimed.get(&faces).map(|p| p.frame);
        match stated {
            Some(frame) => {
                self.refute(&format!("penetrations[{faces:?}].frames"), frame, self.frames - 1);
            }
            // If nothing nearby is listed either, that was refuted when the evidence was evaluated.
            None if self.is_listed_around(faces, self.last.time) => {
                self.refute("penetrations", "an incomplete list", evidence.what);
            }
            None => {}
        }
        self.dropped.insert(faces, self.frames);
    }

    /// Refutes the list of penetrations if nothing on it accounts for the evidence.
    pub(crate) fn take(&mut self, evidence: PassageEvidence) {
        let time = self.last.time;
        if evidence.pairs.iter().all(|p| self.accounted.contains(p)) {
            return;
        }
        let is_listed = evidence.pairs.iter().any(|&p| self.is_listed_around(p, time));
        if !is_listed && !evidence.is_sure {
            if self.questioned.insert(evidence.pairs[0]) {
                self.leave_open(evidence.pairs[0], &format!("whether {}", evidence.what));
            }
            return;
        }
        if !is_listed {
            self.refute("penetrations", "none that accounts for this", evidence.what);
        }
        self.accounted.extend(evidence.pairs);
    }

    /// Passages of pairs in contact whose sides do not fit together across an edge.
    fn uncoupled(
        &self,
        start: &Frame,
        pairs: &[FacePair],
        judged: &[PairFindings],
    ) -> Vec<PassageEvidence> {
        let beside = |faces: [u32; 2]| {
            let index = pairs.binary_search_by(|pair| pair.faces.cmp(&faces));
            let pair = FacePair::new(self.sheet, faces);
            let moving = pair.moving(&start.positions, &self.last.positions);
            let known = match index.map(|index| &judged[index]) {
                Ok(judged) if judged.lost.is_some() || judged.is_skipped => NeighbourState::Lost,
                Ok(judged) => {
                    judged.trail.as_ref().map_or(NeighbourState::Apart, NeighbourState::Contact)
                }
                Err(_) if pair.shared > 2 || self.dropped.contains_key(&faces) => {
                    NeighbourState::Lost
                }
                Err(_) => NeighbourState::Apart,
            };
            (pair, moving, known)
        };
        let both = pairs.par_iter().zip(judged).with_min_len(16);
        let through: Vec<EdgePassage> = both
            .flat_map_iter(|(pair, judged)| {
                let trail = judged.trail.as_ref();
                let trail = trail.filter(|_| !self.accounted.contains(&pair.faces));
                let found = trail.map(|trail| {
                    let followed = ContactPair {
                        pair,
                        moving: pair.moving(&start.positions, &self.last.positions),
                        trail,
                        tolerance: self.limits.tolerance,
                    };
                    uncoupled(&followed, &self.around, &beside)
                });
                found.unwrap_or_default()
            })
            .collect();
        let times = [start.time, self.last.time];
        through.iter().map(|t| PassageEvidence::of(t, times)).collect()
    }

    /// Evaluates whether sides fit together at the first frame.
    pub(crate) fn uncoupled_at_rest(&mut self, near: &[[u32; 2]]) {
        let pairs: Vec<FacePair> = near
            .iter()
            .map(|&faces| FacePair::new(self.sheet, faces))
            .filter(|pair| pair.shared < 3)
            .collect();
        let judged: Vec<PairFindings> = pairs
            .iter()
            .map(|pair| {
                let known = self.sides.binary_search_by(|(f, _)| f.cmp(&pair.faces));
                let side = known.ok().map(|index| &self.sides[index].1);
                let is_skipped = self.lost.contains(&pair.faces);
                PairFindings {
                    trail: side.map(Trail::at_rest),
                    is_skipped,
                    ..PairFindings::default()
                }
            })
            .collect();
        let first = self.last.clone();
        for evidence in self.uncoupled(&first, &pairs, &judged) {
            self.take(evidence);
        }
    }

    /// Measures whether the parts that two triangles do not share come within τ, if the verdict depends on it.
    pub(crate) fn measure_parts(&self, moving: &MovingPair, judged: &mut PairFindings) {
        let tolerance = self.limits.tolerance;
        let least = |limit: f64| {
            let parts = disjoint_parts(moving);
            let nearest =
                parts.iter().filter_map(|part| match keeps_distance(part, limit, PART_BUDGET) {
                    DistanceProof::Kept => None,
                    DistanceProof::Nearer { distance, .. } => Some(distance),
                    DistanceProof::Unproved => Some(limit),
                });
            nearest.fold(f64::INFINITY, f64::min)
        };
        match self.claim.verdict {
            Verdict::Touching if self.perhaps_touching.is_empty() => {
                judged.touching[1] |= least(SURELY_APART * tolerance).is_finite();
            }
            Verdict::Free => {
                let limit = SURELY_TOUCHING * tolerance;
                judged.touching[0] |= least(limit) < limit;
                judged.touching[1] |= judged.touching[0];
            }
            _ => {}
        }
    }

    /// Finishes the proof of a motion of a single frame.
    pub(crate) fn finish_at_rest(&mut self) {
        let first = self.last.clone();
        self.meet_claims(&first, &BTreeMap::new());
        for faces in self.near_pairs(&first.positions) {
            let pair = FacePair::new(self.sheet, faces);
            let mut judged = PairFindings::default();
            if pair.shared == 1 || pair.shared == 2 {
                let moving = pair.moving(&first.positions, &first.positions);
                self.measure_parts(&moving, &mut judged);
            }
            self.note_touching(faces, judged.touching);
        }
    }

    pub(crate) fn note_touching(&mut self, faces: [u32; 2], [sure, possible]: [bool; 2]) {
        if sure {
            self.surely_touching.insert(faces);
        }
        if possible {
            self.perhaps_touching.insert(faces);
        }
    }
}

impl PassageEvidence {
    fn of(through: &EdgePassage, times: [f64; 2]) -> Self {
        let EdgePassage { face, between: [f, g], time, is_sure } = *through;
        let t = times[0] + (times[1] - times[0]) * time;
        Self {
            pairs: [f, g].map(|other| [face.min(other), face.max(other)]),
            what: format!(
                "triangle {face} passes through the edge between {f} and {g}, seen at t = {t}"
            ),
            is_sure,
        }
    }
}
