//! What the certificate states about the order of layers, compared with what was found.

use crate::closest::on_triangle;
use crate::cluster::{Contradiction, FoundCluster};
use crate::layer::corners;
use crate::outcome::Unproved;
use crate::verifier::Verifier;
use foldmotion_check::{Cluster, LayerConflict, LayerProof};
use foldmotion_check::{Penetration, PenetrationKind};

/// The stated point lies within this multiple of τ of all triangles concerned.
const POINT_TOLERANCES: f64 = 20.0;

const NONE: &str = "no such cluster";

fn name(faces: &[u32], frames: [usize; 2]) -> String {
    format!("{} triangles from {:?} at frames {frames:?}", faces.len(), faces.first())
}

impl Verifier<'_> {
    /// Checks that every contradiction stated at a frame is found, and that every one found is stated, there or earlier
    /// for the same pair.
    pub(crate) fn compare_contradictions(
        &mut self,
        frame: usize,
        contradictions: &[Contradiction],
    ) {
        let claim = self.claim;
        let conflicts = claim.penetrations.iter().filter_map(|p| Some((p, p.conflict.as_ref()?)));
        for (stated, conflict) in conflicts.clone().filter(|(p, _)| p.frame == frame) {
            let is_it = |f: &&Contradiction| f.rule == conflict.rule && f.faces == conflict.faces;
            let what = match contradictions.iter().find(is_it) {
                None => Some("these layers do not break this rule"),
                Some(contradiction) => self.difference_in(stated, conflict, contradiction),
            };
            if let Some(what) = what {
                let stated = format!("{:?} of {:?}", conflict.rule, conflict.faces);
                self.refute_at(frame, "penetrations.layers", &stated, what);
            }
        }
        for contradiction in contradictions {
            let is_named = |(p, _): (&Penetration, _)| {
                p.frame <= frame && p.faces.iter().all(|f| contradiction.faces.contains(f))
            };
            if !conflicts.clone().any(is_named) {
                let what = format!(
                    "{:?} of triangles {:?} at frame {frame}",
                    contradiction.rule, contradiction.faces
                );
                self.refute_at(frame, "penetrations", "none that accounts for this", &what);
            }
        }
    }

    /// The first difference between a stated contradiction and the one found.
    fn difference_in(
        &self,
        stated: &Penetration,
        conflict: &LayerConflict,
        contradiction: &Contradiction,
    ) -> Option<&'static str> {
        let mut vertices = stated.vertices.clone();
        vertices.sort_unstable();
        let is_of_one = conflict.faces.iter().any(|&face| {
            let mut corners = self.sheet.faces[face as usize];
            corners.sort_unstable();
            vertices == corners
        });
        let has_vertices = if contradiction.vertices.is_empty() {
            is_of_one
        } else {
            vertices == contradiction.vertices
        };
        let near = POINT_TOLERANCES * self.limits.tolerance;
        let is_there = conflict.faces.iter().all(|&face| {
            let triangle = corners(self.sheet, &self.last.positions, face);
            on_triangle(stated.point, &triangle).distance(stated.point) <= near
        });
        let is_pair = stated.faces.iter().all(|f| conflict.faces.contains(f))
            && self.layer_state.order(stated.faces).is_some();
        if stated.kind != PenetrationKind::LayerOrder || stated.depth != 0.0 {
            Some("a contradiction of layers has kind layer-order and depth 0")
        } else if [stated.time, stated.passed] != [self.last.time; 2] {
            Some("a contradiction of layers is found at the time of a frame")
        } else if !is_pair {
            Some("the pair is not among these layers")
        } else if !has_vertices {
            Some("the vertices are not those of the creases and layers that meet")
        } else if !is_there {
            Some("the layers do not meet at the point")
        } else {
            None
        }
    }

    /// Refutes a statement about a frame, or names it as open if the frame is in doubt.
    fn refute_at(&mut self, frame: usize, field: &str, stated: &str, found: &str) {
        match self.layer_state.doubts.get(&frame) {
            Some(&(faces, what)) => self.outcome.unproved.push(Unproved {
                faces,
                frame,
                what: format!("{what}: {field} states {stated}, found {found}"),
            }),
            None => self.refute(field, stated, found),
        }
    }

    /// The first of these frames that is in doubt.
    fn first_doubt(&self, [from, to]: [usize; 2]) -> Option<usize> {
        let mut doubtful = self.layer_state.doubts.range(from..=to.max(from));
        doubtful.next().map(|(&frame, _)| frame)
    }

    /// Compares the stated clusters and claims with those found.
    pub(crate) fn compare_clusters(&mut self) {
        let (stated, found) = (self.claim.claims, self.layer_state.claims);
        let mut clusters = std::mem::take(&mut self.layer_state.clusters);
        clusters.sort_by(|p, q| (p.frames, &p.faces).cmp(&(q.frames, &q.faces)));
        let listed = &self.claim.clusters;
        for k in 0..clusters.len().max(listed.len()) {
            let (frames, differences) = match (listed.get(k), clusters.get(k)) {
                (Some(stated), Some(found)) => {
                    let is_open = self.first_doubt(found.frames).is_some();
                    (found.frames, found.differences(stated, is_open))
                }
                (Some(s), None) => (s.frames, vec![(name(&s.faces, s.frames), NONE.to_owned())]),
                (None, Some(f)) => (f.frames, vec![(NONE.to_owned(), name(&f.faces, f.frames))]),
                (None, None) => continue,
            };
            let frame = self.first_doubt(frames).unwrap_or(frames[0]);
            for (stated, found) in differences {
                self.refute_at(frame, "clusters", &stated, &found);
            }
        }
        if stated != found {
            let frame = self.layer_state.doubts.keys().next().copied().unwrap_or(0);
            let [stated, found] = [stated, found].map(|claims| format!("{claims:?}"));
            self.refute_at(frame, "layer_orders", &stated, &found);
        }
        let last = self.frames - 1;
        let late = |p: &&Penetration| p.conflict.is_some() && p.frame > last;
        if let Some(p) = self.claim.penetrations.iter().find(late) {
            self.refute("penetrations.frames", p.frame, format!("the last frame is {last}"));
        }
    }
}

impl FoundCluster {
    /// The differences between a stated cluster and the one found: stated, found. `is_open`: sides are in doubt there,
    /// and a stated order of *unproved* is accepted.
    fn differences(&self, stated: &Cluster, is_open: bool) -> Vec<(String, String)> {
        let mut differences = Vec::new();
        let mut require = |is_so: bool, stated: String, found: String| {
            if !is_so {
                differences.push((stated, found));
            }
        };
        let is_same = stated.faces == self.faces && stated.frames == self.frames;
        require(
            is_same && stated.times == self.times,
            format!("{}, t = {:?}", name(&stated.faces, stated.frames), stated.times),
            format!("{}, t = {:?}", name(&self.faces, self.frames), self.times),
        );
        require(
            (2..=self.layers).contains(&stated.layers),
            format!("{} layers", stated.layers),
            format!("2 to {}", self.layers),
        );
        require(
            stated.pairs == self.pairs,
            format!("{} pairs", stated.pairs),
            self.pairs.to_string(),
        );
        require(
            stated.order == self.order || (is_open && stated.order == LayerProof::Unproved),
            format!("order {:?}", stated.order),
            format!("{:?}", self.order),
        );
        differences
    }
}
