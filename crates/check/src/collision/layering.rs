//! The layers of each frame: finding them, applying the claims of the file, testing the rules.

use std::collections::BTreeSet;

use foldmotion_geometry::collide::Side;
use foldmotion_pattern::{Assignment, LayerOrder};
use glam::DVec3;

use super::{
    checker::{Checker, on_side},
    face_pair::FacePair,
    report::{Penetration, PenetrationKind},
};
use crate::CheckError;
use crate::layers::{
    Contradiction, FaceStack, LayerConflict, LayerPair, LayerProof, LayerRule, front_normal,
    layer_pairs, layer_point, order_of, prove, unused_claims,
};

impl Checker<'_> {
    /// The order, in both directions, of the triangles that coincide at the last frame, as the motion leaves it. Pairs
    /// whose order is unknown are left out.
    pub fn layer_order(&self) -> LayerOrder {
        order_of(self.sheet, &self.last.positions, &self.layers)
    }

    /// Whether nothing has penetrated up to the last frame.
    pub fn is_clean(&self) -> bool {
        self.report.penetrations.is_empty()
    }

    /// Applies the claims of a file about the order of layers at the last frame; at most once for each frame. Does
    /// nothing once the check [has stopped](Self::is_stopped).
    ///
    /// `face_of`: the face of the file that a triangle belongs to; `order` refers to these faces. A claim about two
    /// layers whose order is known from the motion must agree with it, otherwise it is reported as a penetration. If
    /// the motion leaves both sides open, as at the first frame, the claim decides, also for the frames to come. A
    /// claim about facets that are stacked a gap apart must agree with their heights. Claims about other facets are
    /// counted and ignored.
    ///
    /// # Errors
    /// [`CheckError::FalseOrder`] if facets that lie a gap apart are stacked the other way round in a motion that has
    /// not penetrated.
    pub fn claim(
        &mut self,
        order: &LayerOrder,
        face_of: &dyn Fn(u32) -> u32,
    ) -> Result<(), CheckError> {
        if self.is_stopped() {
            return Ok(());
        }
        let mut used = BTreeSet::new();
        for index in 0..self.layers.len() {
            let pair = self.layers[index];
            let [f, g] = pair.faces;
            let [a, b] = [f, g].map(face_of);
            if pair.is_lost || a == b {
                continue;
            }
            // The sign of (a, b) refers to the front of b, above which f lies; that of (b, a) to the front of a, above
            // which g lies.
            let of_first = order.sign(a, b).map(|sign| ((a, b), -f64::from(sign), g));
            let of_second = order.sign(b, a).map(|sign| ((b, a), f64::from(sign), f));
            for (claim, sign, face) in [of_first, of_second].into_iter().flatten() {
                used.insert(claim);
                let up = front_normal(self.sheet, face, &self.last.positions) * sign;
                self.apply_claim(index, up);
            }
        }
        let stacked =
            self.stack(face_of).compare(unused_claims(order, |claim| used.contains(claim)));
        self.report.claims.claimed += order.len();
        self.report.claims.ignored += order.len() - used.len() - stacked.held;
        match stacked.refuted {
            Some((f, g, sign)) if self.is_clean() => {
                Err(CheckError::FalseOrder { frame: self.frames - 1, f, g, sign })
            }
            _ => Ok(()),
        }
    }

    /// `order`, which refers to triangles, without the claims that are false at the last frame: facets that lie a gap
    /// apart may be stacked the other way round, as in a motion that jammed.
    pub fn without_false(&self, order: &LayerOrder) -> LayerOrder {
        self.stack(&|triangle| triangle).without_false(order)
    }

    fn stack<'b>(&'b self, face_of: &'b dyn Fn(u32) -> u32) -> FaceStack<'b> {
        FaceStack {
            sheet: self.sheet,
            positions: &self.last.positions,
            face_of,
            tolerance: self.tolerance,
        }
    }

    /// Applies the claim that the first layer of a pair lies below the second along `up`.
    fn apply_claim(&mut self, index: usize, up: DVec3) {
        let LayerPair { faces, up: known, .. } = self.layers[index];
        match known {
            Some(known) if known.dot(up) < 0.0 => {
                let rule = self.claim_rule(faces);
                let contradiction = Contradiction {
                    faces,
                    conflict: LayerConflict { rule, faces: faces.to_vec() },
                    vertices: self.sheet.faces[faces[0] as usize].to_vec(),
                    point: layer_point(self.sheet, &self.last.positions, faces),
                };
                self.record_contradiction(contradiction);
            }
            Some(_) => {}
            None => {
                self.layers[index].up = Some(up);
                self.claimed.insert(faces);
                self.keep_side(faces, up);
            }
        }
    }

    /// Restricts the side of a pair to `up` from now on.
    fn keep_side(&mut self, [f, g]: [u32; 2], up: DVec3) {
        let Ok(found) = self.sides.binary_search_by(|(pair, _)| pair.cmp(&(f, g))) else {
            return;
        };
        let pose = FacePair::new(self.sheet, f, g).pose(&self.last.positions);
        let side = &mut self.sides[found].1;
        match side {
            Side::Contact(axes) => *axes = on_side(axes, up),
            // The gap on the other side is below τ, and so is the overlap on this one.
            Side::Apart(axis) if axis.dot(up) < 0.0 && pose.overlap(up) < self.tolerance => {
                *side = Side::Contact(vec![up]);
            }
            Side::Apart(_) => {}
        }
    }

    /// The rule that a contradicted claim breaks. At the first frame the only known orders are those of creases folded
    /// flat, from their assignments.
    fn claim_rule(&self, faces: [u32; 2]) -> LayerRule {
        if self.frames == 1 && self.crease_between(faces).is_some() {
            LayerRule::Crease
        } else {
            LayerRule::Claim
        }
    }

    /// The normal of the first face that points to the second according to the assignment of the crease between them;
    /// `None` if there is no such crease.
    fn assigned_side(&self, faces: [u32; 2]) -> Option<DVec3> {
        let front = front_normal(self.sheet, faces[0], &self.last.positions);
        match self.sheet.edges[self.crease_between(faces)? as usize].assignment {
            Assignment::Valley => Some(front),
            Assignment::Mountain => Some(-front),
            _ => None,
        }
    }

    fn crease_between(&self, [f, g]: [u32; 2]) -> Option<u32> {
        let mut hinges = (0..3).filter_map(|i| self.edges.hinge(self.sheet, f, i));
        let (edge, _) = hinges.find(|&(_, beyond)| beyond == g)?;
        self.sheet.edges[edge as usize].is_crease().then_some(edge)
    }

    /// Finds the layers of the last frame.
    ///
    /// Triangles closer than τ may lie on either side of each other: a gap that small shows no order. So a pair without
    /// an order gets one only after it was seen apart, and at the first frame only creases folded flat have an order.
    pub(super) fn find_layers(&mut self) {
        let followed = self.sides.iter().map(|(pair, side)| (*pair, Some(side)));
        let unfollowed = self.unfollowed.iter().map(|&pair| (pair, None));
        let mut sides: Vec<_> = followed.chain(unfollowed).collect();
        sides.sort_by_key(|(pair, _)| *pair);
        let mut layers = layer_pairs(self.sheet, &self.last.positions, &sides, self.tolerance);
        for pair in &mut layers {
            let [f, g] = pair.faces;
            pair.is_lost = self.penetrating.contains(&(f, g));
            let earlier = self.layers.binary_search_by(|p| p.faces.cmp(&pair.faces));
            match earlier {
                Ok(index) if self.layers[index].up.is_none() => pair.up = None,
                Err(_) if self.frames == 1 => pair.up = self.assigned_side(pair.faces),
                _ => {}
            }
        }
        self.layers = layers;
        self.is_proved = false;
        if self.frames == 1 {
            for LayerPair { faces, up, .. } in self.layers.clone() {
                if let Some(up) = up {
                    self.claimed.insert(faces);
                    self.keep_side(faces, up);
                }
            }
        }
    }

    /// Tests the layer rules at the last frame, once.
    pub(super) fn prove_layers(&mut self) {
        if std::mem::replace(&mut self.is_proved, true) || self.layers.is_empty() {
            return;
        }
        let positions = &self.last.positions;
        let proof = prove(self.sheet, &self.edges, positions, &self.layers, self.tolerance);
        let frame = self.frames - 1;
        let (counted, open): (Vec<_>, Vec<_>) =
            proof.contradictions.into_iter().partition(|contradiction| self.counts(contradiction));
        for mut cluster in proof.clusters {
            let holds = |c: &Contradiction| cluster.faces.binary_search(&c.faces[0]).is_ok();
            if open.iter().any(holds) && !counted.iter().any(holds) {
                cluster.order = LayerProof::Unproved;
            }
            cluster.frames = [frame; 2];
            cluster.times = [self.last.time; 2];
            let before =
                |c: &&mut crate::Cluster| c.frames[1] + 1 == frame && c.faces == cluster.faces;
            match self.report.clusters.iter_mut().rev().find(before) {
                Some(earlier) => earlier.extend(&cluster),
                None => self.report.clusters.push(cluster),
            }
        }
        for contradiction in counted {
            self.record_contradiction(contradiction);
        }
    }

    /// Whether a contradiction between layers shows that the sheet penetrates.
    ///
    /// Whether creases and layers pass through each other along a line is decided by the crossing counts, which
    /// consider every way of leaving a contact; the side on which a pair was followed is only one of them. Orders that
    /// are claimed by the file or an assignment do not follow from the motion: for them the rules decide.
    fn counts(&self, contradiction: &Contradiction) -> bool {
        use LayerRule::{Bent, TacoTaco, TacoTortilla, TortillaTortilla};
        let conflict = &contradiction.conflict;
        let is_along_line =
            matches!(conflict.rule, TacoTaco | TacoTortilla | TortillaTortilla | Bent);
        let is_among = |pair: &[u32; 2]| pair.iter().all(|face| conflict.faces.contains(face));
        !is_along_line || self.claimed.iter().any(is_among)
    }

    /// Records the first contradiction of every pair.
    fn record_contradiction(&mut self, found: Contradiction) {
        if !self.contradicting.insert(found.faces) {
            return;
        }
        self.report.penetrations.push(Penetration {
            time: self.last.time,
            passed: self.last.time,
            frame: self.frames - 1,
            faces: found.faces,
            vertices: found.vertices,
            point: found.point + self.origin,
            depth: 0.0,
            kind: PenetrationKind::LayerOrder,
            conflict: Some(found.conflict),
        });
    }
}
