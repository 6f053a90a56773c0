//! The penetrations that are listed, compared with what was found.

use std::collections::BTreeMap;

use foldmotion_pattern::Frame;

use crate::face_pair::FacePair;
use crate::lost::{LostSide, depth_at};
use crate::moving_pair::MovingPair;
use crate::outcome::Unproved;
use crate::parts::disjoint_parts;
use crate::penetration::{FoundPenetration, compare};
use crate::through;
use crate::verifier::Verifier;
use foldmotion_check::{Penetration, PenetrationKind};

impl<'a> Verifier<'a> {
    /// Compares what is listed at the interval that begins at `start` with what was found.
    pub(crate) fn meet_claims(&mut self, start: &Frame, found: &BTreeMap<[u32; 2], LostSide>) {
        let frame = self.frames - 1;
        let listed: Vec<&'a Penetration> = self
            .claimed
            .values()
            .copied()
            .filter(|p| p.frame == frame && self.are_faces(p.faces))
            .filter(|p| !self.dropped.contains_key(&p.faces))
            .filter(|p| !self.undecided.contains(&(p.faces, frame)))
            .collect();
        for stated in listed {
            let pair = FacePair::new(self.sheet, stated.faces);
            self.meet_claim(stated, &pair, start, found.get(&stated.faces));
            self.dropped.insert(stated.faces, self.frames);
        }
    }

    fn meet_claim(
        &mut self,
        stated: &'a Penetration,
        pair: &FacePair,
        start: &Frame,
        lost: Option<&LostSide>,
    ) {
        use PenetrationKind::{EdgeEdge, ThroughEdge, VertexFacet};
        let own = lost.and_then(|lost| lost.found.as_ref());
        let is_deep = matches!(stated.kind, EdgeEdge | VertexFacet);
        if let Some(found) = own.filter(|_| stated.kind != ThroughEdge) {
            self.compare(stated, found, pair);
            return;
        }
        if is_deep && lost.is_none() {
            self.refute(
                "penetrations",
                format!("triangles {:?} penetrate after frame {}", pair.faces, stated.frame),
                "they do not",
            );
            return;
        }
        let interval = self.interval(start);
        let mismatch = interval.mismatch(stated, pair);
        let is_found = self.is_accounted_around(stated) || interval.is_pierced_around(stated);
        if let Some((field, stated_value, found)) = mismatch {
            let field = format!("penetrations[{:?}].{field}", pair.faces);
            self.refute(&field, stated_value, found);
        } else if !is_found {
            let piercings = interval.piercings_at_end(stated);
            self.pending.push((stated, piercings));
        }
    }

    fn interval<'b>(&'b self, start: &'b Frame) -> through::Interval<'b> {
        through::Interval {
            around: &self.around,
            frames: [start, &self.last],
            tolerance: self.limits.tolerance,
            unit: self.sheet.unit_length,
        }
    }

    fn is_accounted_around(&self, stated: &Penetration) -> bool {
        let mut all = self.accounted.iter();
        all.any(|&faces| self.around.is_around(stated.faces, faces))
    }

    /// Follows listed penetrations of earlier intervals that pass through the sheet by less than τ, until they do so by
    /// more or not at all.
    pub(crate) fn meet_pending(&mut self, start: &Frame) {
        let pending = std::mem::take(&mut self.pending);
        for (stated, mut piercings) in pending {
            let is_found = self.is_accounted_around(stated)
                || self.interval(start).is_pierced_later(&mut piercings);
            if !is_found {
                self.pending.push((stated, piercings));
            }
        }
    }

    /// Names the listed penetrations that were not found.
    pub(crate) fn leave_pending_open(&mut self) {
        let pending = std::mem::take(&mut self.pending).into_iter();
        self.outcome.unproved.extend(pending.map(|(stated, _)| Unproved {
            faces: stated.faces,
            frame: stated.frame,
            what: "whether they penetrate as listed".to_owned(),
        }));
    }

    fn compare(&mut self, stated: &Penetration, found: &FoundPenetration, pair: &FacePair) {
        for (field, stated, found) in compare(stated, found, pair, self.sheet, &self.limits) {
            let field = format!("penetrations[{:?}].{field}", pair.faces);
            self.refute(&field, stated, found);
        }
    }

    /// Handles a pair without a side at the first frame.
    pub(crate) fn starts_lost(&mut self, pair: &FacePair, moving: &MovingPair) {
        let deepest = depth_at(moving, 0.0);
        let found = FoundPenetration::at_first_frame(moving, self.last.time, deepest);
        let parts = disjoint_parts(moving);
        let deep_parts = parts.iter().map(|part| depth_at(part, 0.0));
        let lost = LostSide {
            is_deep: pair.shared == 0,
            is_clear: deep_parts.fold(0.0, f64::max) > self.limits.tolerance,
            are_parts_clean: false,
            found: Some(found),
        };
        let first = self.last.time;
        let is_here = |stated: &Penetration| stated.frame == 0 && stated.passed == first;
        self.lost.insert(pair.faces);
        if lost.is_clear {
            let evidence = self.evidence_of(pair.faces, &lost);
            self.take(evidence);
        }
        let stated = self.claimed.get(&pair.faces).copied();
        let stated = stated.filter(|p| is_here(p) && p.kind != PenetrationKind::ThroughEdge);
        if let (Some(stated), Some(found)) = (stated, &lost.found) {
            self.compare(stated, found, pair);
            self.dropped.insert(pair.faces, 0);
        } else if lost.is_deep {
            self.drop_deep(pair.faces, &lost);
        }
    }
}
