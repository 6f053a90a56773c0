//! What was found to pass through the sheet, held against what is listed.

use std::collections::BTreeMap;

use foldmotion_pattern::Frame;
use rayon::prelude::*;

use crate::coupling::{Beside, Followed, Through, uncoupled};
use crate::distance::{Nearness, keeps_distance};
use crate::outcome::Unproved;
use crate::pair::Pair;
use crate::parts::disjoint_parts;
use crate::penetration::Found;
use crate::span::Span;
use crate::trail::Trail;
use crate::verifier::{Judged, SURELY_APART, SURELY_TOUCHING, Verifier};
use crate::lost::Lost;
use crate::walk::{Walked, walk_leniently};
use foldmotion_check::Verdict;

/// The most steps for the distance of parts.
const PART_BUDGET: u32 = 1 << 12;

/// Something that passes through the sheet.
#[derive(Debug)]
pub(crate) struct Evidence {
    /// Pairs of triangles at which it does.
    pairs: [[u32; 2]; 2],
    what: String,
    /// Whether it surely does.
    is_sure: bool,
}

impl Verifier<'_> {
    /// Follows a pair from the sides that fit together with others.
    pub(crate) fn follow_narrowed(&self, pair: &Pair, span: &Span, judged: &mut Judged) {
        let Some(side) = self.narrowed.get(&pair.faces) else {
            return;
        };
        match walk_leniently(span, side, &self.limits) {
            Walked::Clean { side, trail } => {
                judged.narrowed = (!side.is_apart).then_some(side);
                judged.trail = trail.or(judged.trail.take());
            }
            Walked::Crosses(crossing) => {
                let found = Found::new(span, self.frames - 1, crossing);
                let lost = Lost::new(span, (side, false), Some(found), &self.limits);
                judged.lost_narrowed = Some(lost).filter(|lost| lost.is_clear);
            }
            Walked::Undecided { .. } => {}
        }
    }

    /// Whether a listed penetration accounts for what passes through around a pair up to a time.
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

    /// Takes in what passes through in the interval that begins at `start`.
    pub(crate) fn account(&mut self, start: &Frame, pairs: &[Pair], judged: &mut [Judged]) {
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

    pub(crate) fn evidence_of(&self, faces: [u32; 2], lost: &Lost) -> Evidence {
        let when = lost.found.as_ref().map(|f| f.at(f.crossing.passed));
        let when = when.map_or_else(String::new, |t| format!(", t = {t}"));
        let frame = self.frames - 1;
        Evidence {
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

    /// A deep pair that is not listed at this frame.
    pub(crate) fn drop_deep(&mut self, faces: [u32; 2], lost: &Lost) {
        let evidence = self.evidence_of(faces, lost);
        let stated = self.claimed.get(&faces).map(|p| p.frame);
        match stated {
            Some(frame) => self.refute(
                &format!("penetrations[{faces:?}].frames"),
                frame,
                self.frames - 1,
            ),
            // Where nothing around is listed either, it was refuted as it was taken in.
            None if self.is_listed_around(faces, self.last.time) => {
                self.refute("penetrations", "not all of them", evidence.what);
            }
            None => {}
        }
        self.dropped.insert(faces, self.frames);
    }

    /// Refutes a list that has nothing around.
    pub(crate) fn take(&mut self, evidence: Evidence) {
        let time = self.last.time;
        if evidence.pairs.iter().all(|p| self.accounted.contains(p)) {
            return;
        }
        let is_listed = evidence
            .pairs
            .iter()
            .any(|&p| self.is_listed_around(p, time));
        if !is_listed && !evidence.is_sure {
            if self.questioned.insert(evidence.pairs[0]) {
                self.leave_open(evidence.pairs[0], &format!("whether {}", evidence.what));
            }
            return;
        }
        if !is_listed {
            self.refute("penetrations", "none of them", evidence.what);
        }
        self.accounted.extend(evidence.pairs);
    }

    /// Where the sides of pairs in contact do not fit together across an edge.
    fn uncoupled(&self, start: &Frame, pairs: &[Pair], judged: &[Judged]) -> Vec<Evidence> {
        let beside = |faces: [u32; 2]| {
            let index = pairs.binary_search_by(|pair| pair.faces.cmp(&faces));
            let pair = Pair::new(self.sheet, faces);
            let span = pair.span(&start.positions, &self.last.positions);
            let known = match index.map(|index| &judged[index]) {
                Ok(judged) if judged.lost.is_some() || judged.is_skipped => Beside::Lost,
                Ok(judged) => judged.trail.as_ref().map_or(Beside::Apart, Beside::Contact),
                Err(_) if pair.shared > 2 || self.dropped.contains_key(&faces) => Beside::Lost,
                Err(_) => Beside::Apart,
            };
            (pair, span, known)
        };
        let both = pairs.par_iter().zip(judged).with_min_len(16);
        let through: Vec<Through> = both
            .flat_map_iter(|(pair, judged)| {
                let trail = judged.trail.as_ref();
                let trail = trail.filter(|_| !self.accounted.contains(&pair.faces));
                let found = trail.map(|trail| {
                    let followed = Followed {
                        pair,
                        span: pair.span(&start.positions, &self.last.positions),
                        trail,
                        tolerance: self.limits.tolerance,
                    };
                    uncoupled(&followed, &self.around, &beside)
                });
                found.unwrap_or_default()
            })
            .collect();
        let times = [start.time, self.last.time];
        through.iter().map(|t| Evidence::of(t, times)).collect()
    }

    /// Likewise at the first frame.
    pub(crate) fn uncoupled_at_rest(&mut self, near: &[[u32; 2]]) {
        let pairs: Vec<Pair> = near
            .iter()
            .map(|&faces| Pair::new(self.sheet, faces))
            .filter(|pair| pair.shared < 3)
            .collect();
        let judged: Vec<Judged> = pairs
            .iter()
            .map(|pair| {
                let known = self.sides.binary_search_by(|(f, _)| f.cmp(&pair.faces));
                let side = known.ok().map(|index| &self.sides[index].1);
                let is_skipped = self.lost.contains(&pair.faces);
                Judged::at_rest(side.map(Trail::at_rest), is_skipped)
            })
            .collect();
        let first = self.last.clone();
        for evidence in self.uncoupled(&first, &pairs, &judged) {
            self.take(evidence);
        }
    }

    /// Whether what two triangles that share vertices do not share comes within τ, where something depends on it.
    pub(crate) fn measure_parts(&self, span: &Span, judged: &mut Judged) {
        let tolerance = self.limits.tolerance;
        let least = |limit: f64| {
            let parts = disjoint_parts(span);
            let nearest =
                parts
                    .iter()
                    .filter_map(|part| match keeps_distance(part, limit, PART_BUDGET) {
                        Nearness::Kept => None,
                        Nearness::Nearer { distance, .. } => Some(distance),
                        Nearness::Unproved => Some(limit),
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

    /// What is to be said of a motion of one frame.
    pub(crate) fn finish_at_rest(&mut self) {
        let first = self.last.clone();
        self.meet_claims(&first, &BTreeMap::new());
        for faces in self.near_pairs(&first.positions) {
            let pair = Pair::new(self.sheet, faces);
            let mut judged = Judged::apart();
            if pair.shared == 1 || pair.shared == 2 {
                let span = pair.span(&first.positions, &first.positions);
                self.measure_parts(&span, &mut judged);
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

impl Evidence {
    fn of(through: &Through, times: [f64; 2]) -> Self {
        let Through {
            face,
            between: [f, g],
            time,
            is_sure,
        } = *through;
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
