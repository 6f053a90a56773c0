//! Pairs that leave the side they were followed on are suspects; the crossing counts decide whether they penetrate.

use super::{
    checker::Checker,
    face_pair::FacePair,
    frame::CentredFrame,
    judge::{DistanceBounds, PenetrationEvidence, Suspect},
    report::{Penetration, PenetrationKind, Undecided},
};
use crate::crossings;

impl Checker<'_> {
    /// Records that a pair is deeper than τ or has left the side it was followed on.
    pub(super) fn record_lost_side(
        &mut self,
        pair: &FacePair,
        times: [f64; 2],
        evidence: PenetrationEvidence,
    ) {
        let frame = self.frames - 1;
        self.unfollowed.push(pair.key());
        self.nearest.record(pair.faces, times, &evidence.distance);
        // A side that was claimed is the only possible one.
        if evidence.is_sure(self.tolerance) || self.claimed.contains(&pair.faces) {
            self.record_penetration(pair.faces, frame, times, evidence);
            return;
        }
        self.touching.insert(pair.key());
        self.near.push(pair.faces);
        self.suspects.insert(pair.key(), Suspect { frame, times, evidence });
    }

    /// Counts the passages of the sheet through itself in the interval that begins at `start`; `None`: at the first
    /// frame.
    pub(super) fn count_crossings(&mut self, start: Option<&CentredFrame>) {
        self.near.sort_unstable();
        self.near.dedup();
        let first = start.unwrap_or(&self.last);
        let times = [first.time, self.last.time];
        let interval = crossings::Interval {
            times,
            positions: [&first.positions, &self.last.positions],
            near: &self.near,
            is_lost: &|[f, g]| self.penetrating.contains(&(f, g)),
        };
        let found = match start {
            None => self.crossings.begin(&interval),
            Some(_) => self.crossings.advance(&interval),
        };
        let frame = self.frames - 1;
        for crossing in found.crossings {
            self.record_crossing(crossing, frame);
        }
        self.name_uncounted(frame);
        self.unfollow_penetrating();
        for [f, g] in found.unsure {
            if !self.penetrating.contains(&(f, g)) {
                self.report.undecided.push(Undecided { time: times[0], frame, faces: [f, g] });
            }
        }
    }

    /// Pairs that penetrate no longer have a side.
    fn unfollow_penetrating(&mut self) {
        let penetrating = &self.penetrating;
        let lost = self.sides.extract_if(.., |(pair, _)| penetrating.contains(pair));
        self.unfollowed.extend(lost.map(|(pair, _)| pair));
    }

    /// Reports the pairs that left their side in this interval where nothing is counted. Passages next to a pair that
    /// already penetrates are not counted; there the evidence of the pair itself decides.
    fn name_uncounted(&mut self, frame: usize) {
        let is_lost = |[f, g]: [u32; 2]| self.penetrating.contains(&(f, g));
        let is_uncounted = |&((f, g), suspect): &(&(u32, u32), &Suspect)| {
            suspect.frame == frame
                && !is_lost([*f, *g])
                && !self.crossings.counts([*f, *g], &is_lost)
        };
        let found = self.suspects.iter().filter(is_uncounted);
        let named: Vec<_> = found.map(|(pair, s)| (*pair, s.clone())).collect();
        for ((f, g), suspect) in named {
            self.record_penetration([f, g], suspect.frame, suspect.times, suspect.evidence);
        }
    }

    /// Records a crossing of the sheet: with the evidence of a suspect pair if there is one, otherwise as a passage
    /// beside each of the triangles.
    fn record_crossing(&mut self, crossing: crossings::SheetCrossing, frame: usize) {
        let mut is_named = false;
        for &[f, g] in &crossing.pairs {
            let suspect = self.suspects.get(&(f, g));
            let is_known = self.penetrating.contains(&(f, g));
            is_named |= is_known;
            let is_meant = |suspect: &&Suspect| {
                suspect.times[1] >= crossing.since && suspect.evidence.is_in_contact(self.tolerance)
            };
            if let Some(suspect) = suspect.filter(is_meant).filter(|_| !is_known) {
                let Suspect { frame, times, evidence } = suspect.clone();
                self.record_penetration([f, g], frame, times, evidence);
                is_named = true;
            }
        }
        if is_named {
            return;
        }
        let Some(&faces) = crossing.pairs.first() else {
            return;
        };
        self.mark_penetrating(faces, [crossing.since, crossing.passed]);
        self.report.penetrations.push(Penetration {
            time: crossing.since,
            passed: crossing.passed,
            frame,
            faces,
            vertices: crossing.evidence.vertices,
            point: crossing.evidence.point + self.origin,
            depth: crossing.evidence.depth / self.sheet.unit_length,
            kind: PenetrationKind::ThroughEdge,
            conflict: None,
        });
    }

    /// Marks a pair as penetrating: it is in contact somewhere, and is not followed any more.
    fn mark_penetrating(&mut self, faces: [u32; 2], times: [f64; 2]) {
        self.penetrating.insert((faces[0], faces[1]));
        if self.is_measured(&FacePair::new(self.sheet, faces[0], faces[1])) {
            let met = DistanceBounds { approach: None, at_least: 0.0 };
            self.nearest.record(faces, times, &met);
        }
    }

    fn record_penetration(
        &mut self,
        faces: [u32; 2],
        frame: usize,
        times: [f64; 2],
        evidence: PenetrationEvidence,
    ) {
        let at = |t: f64| times[0] + (times[1] - times[0]) * t;
        self.mark_penetrating(faces, times);
        self.report.penetrations.push(Penetration {
            time: at(evidence.contact),
            passed: at(evidence.passed),
            frame,
            faces,
            vertices: evidence.vertices,
            point: evidence.point + self.origin,
            depth: evidence.depth / self.sheet.unit_length,
            kind: evidence.kind,
            conflict: None,
        });
    }
}
