//! What the walk over the frames does with what passes through the sheet: pairs that leave their side are suspects, and what
//! is counted on the sheet decides.

use super::{
    checker::Checker,
    frame::Placed,
    judge::{Nearness, Suspect, Witness},
    pair::Pair,
    report::{Penetration, PenetrationKind, Undecided},
};
use crate::crossings;

impl Checker<'_> {
    /// Takes in that a pair is deeper than τ, or else not where it was followed to.
    pub(super) fn leaves_its_side(&mut self, pair: &Pair, times: [f64; 2], witness: Witness) {
        let frame = self.frames - 1;
        self.unfollowed.push(pair.key());
        self.nearest.record(pair.faces, times, &witness.nearness);
        // The side that a claim names is the only one.
        if witness.is_sure(self.tolerance) || self.claimed.contains(&pair.faces) {
            self.penetrates(pair.faces, frame, times, witness);
            return;
        }
        self.touching.insert(pair.key());
        self.near.push(pair.faces);
        self.suspects.insert(
            pair.key(),
            Suspect {
                frame,
                times,
                witness,
            },
        );
    }

    /// Counts the passages of the sheet through itself in the interval that begins at `start`, or at the first frame.
    pub(super) fn count_crossings(&mut self, start: Option<&Placed>) {
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
            self.crosses(crossing, frame);
        }
        self.name_uncounted(frame);
        self.unfollow_penetrating();
        for [f, g] in found.unsure {
            if !self.penetrating.contains(&(f, g)) {
                self.report.undecided.push(Undecided {
                    time: times[0],
                    frame,
                    faces: [f, g],
                });
            }
        }
    }

    /// Pairs that penetrate have no side any more.
    fn unfollow_penetrating(&mut self) {
        let penetrating = &self.penetrating;
        let lost = self
            .sides
            .extract_if(.., |(pair, _)| penetrating.contains(pair));
        self.unfollowed.extend(lost.map(|(pair, _)| pair));
    }

    /// Names the pairs that left their side in this interval where the counts are silent, as what passes there is not counted
    /// beside a pair that penetrates: there the pair's own finding stands.
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
            self.penetrates([f, g], suspect.frame, suspect.times, suspect.witness);
        }
    }

    /// Records what passes through the sheet: as its pair of triangles was found to, or else beside each of them.
    fn crosses(&mut self, crossing: crossings::Crossing, frame: usize) {
        let mut is_named = false;
        for &[f, g] in &crossing.pairs {
            let suspect = self.suspects.get(&(f, g));
            let is_known = self.penetrating.contains(&(f, g));
            is_named |= is_known;
            let is_meant = |suspect: &&Suspect| {
                suspect.times[1] >= crossing.since && suspect.witness.meets(self.tolerance)
            };
            if let Some(suspect) = suspect.filter(is_meant).filter(|_| !is_known) {
                let Suspect {
                    frame,
                    times,
                    witness,
                } = suspect.clone();
                self.penetrates([f, g], frame, times, witness);
                is_named = true;
            }
        }
        if is_named {
            return;
        }
        let Some(&faces) = crossing.pairs.first() else {
            return;
        };
        self.meets(faces, [crossing.since, crossing.passed]);
        self.report.penetrations.push(Penetration {
            time: crossing.since,
            passed: crossing.passed,
            frame,
            faces,
            vertices: crossing.witness.vertices,
            point: crossing.witness.point + self.origin,
            depth: crossing.witness.depth / self.sheet.unit_length,
            kind: PenetrationKind::ThroughEdge,
            conflict: None,
        });
    }

    /// A pair penetrates: it meets somewhere, and is not looked at afterwards.
    fn meets(&mut self, faces: [u32; 2], times: [f64; 2]) {
        self.penetrating.insert((faces[0], faces[1]));
        if self.is_measured(&Pair::new(self.sheet, faces[0], faces[1])) {
            let met = Nearness {
                approach: None,
                at_least: 0.0,
            };
            self.nearest.record(faces, times, &met);
        }
    }

    fn penetrates(&mut self, faces: [u32; 2], frame: usize, times: [f64; 2], witness: Witness) {
        let at = |t: f64| times[0] + (times[1] - times[0]) * t;
        self.meets(faces, times);
        self.report.penetrations.push(Penetration {
            time: at(witness.contact),
            passed: at(witness.passed),
            frame,
            faces,
            vertices: witness.vertices,
            point: witness.point + self.origin,
            depth: witness.depth / self.sheet.unit_length,
            kind: witness.kind,
            conflict: None,
        });
    }
}
