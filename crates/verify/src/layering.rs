//! The order of layers, followed from frame to frame.

use std::collections::BTreeSet;

use foldmotion_check::{LayerProof, LayerRule};
use foldmotion_pattern::{Assignment, LayerOrder};
use glam::DVec3;

use crate::cluster::{Contradiction, prove};
use crate::face_pair::FacePair;
use crate::instant::{axes, roomiest};
use crate::layer::{self, Layer, LayerTolerances, corners, side_of};
use crate::plane::Plane;
use crate::side::Side;
use crate::stacked::SheetState;
use crate::verifier::Verifier;

impl Verifier<'_> {
    /// Applies the claims of the file about the order at the last frame; at most once for each frame.
    ///
    /// `face_of`: the face of the file that a triangle belongs to; `order` refers to these faces.
    pub fn claim(&mut self, order: &LayerOrder, face_of: &dyn Fn(u32) -> u32) {
        if self.is_over {
            return;
        }
        let mut used = BTreeSet::new();
        for index in 0..self.layer_state.layers.len() {
            let Layer { faces, is_lost, .. } = self.layer_state.layers[index];
            let [f, g] = faces.map(face_of);
            if is_lost || f == g {
                continue;
            }
            // In FOLD, the sign tells on which side of the front of the second face the first lies.
            for (claim, above, front) in [((g, f), 1.0, faces[0]), ((f, g), -1.0, faces[1])] {
                let Some(sign) = order.sign(claim.0, claim.1) else {
                    continue;
                };
                used.insert(claim);
                if let Some(up) = self.front(front) {
                    self.claim_pair(index, up * above * f64::from(sign));
                }
            }
        }
        let state = SheetState {
            sheet: self.sheet,
            positions: &self.last.positions,
            face_of,
            scale: LayerTolerances::new(self.limits.tolerance, &self.last.positions),
        };
        let stacked = state.judge(order, |claim| !used.contains(&claim));
        let frame = self.frames - 1;
        if let Some(faces) = stacked.doubtful {
            let doubt = (faces, "whether they are stacked as the file claims");
            self.layer_state.doubts.entry(frame).or_insert(doubt);
        }
        self.layer_state.claims.claimed += order.len();
        self.layer_state.claims.ignored += order.len() - used.len() - stacked.held;
        if let Some(entry) = stacked.refuted.filter(|_| self.claim.penetrations.is_empty()) {
            let found = format!("the faces are stacked the other way round at frame {frame}");
            self.refute("faceOrders", format!("{entry:?}"), found);
        }
    }

    /// Applies the claim that the first layer lies below the second along `up`.
    fn claim_pair(&mut self, index: usize, up: DVec3) {
        let layer = &mut self.layer_state.layers[index];
        let faces = layer.faces;
        let Some(known) = layer.up else {
            layer.up = Some(up);
            self.layer_state.claimed.insert(faces);
            self.keep_side(faces, up);
            return;
        };
        if known.dot(up) < 0.0 {
            let is_crease = self.frames == 1 && self.assigned(faces).is_some();
            let rule = if is_crease { LayerRule::Crease } else { LayerRule::Claim };
            self.layer_state.contradictions.push(Contradiction {
                rule,
                faces: faces.to_vec(),
                vertices: Vec::new(),
            });
        }
    }

    /// Restricts the side of a pair from now on.
    fn keep_side(&mut self, faces: [u32; 2], up: DVec3) {
        match self.sides.binary_search_by(|(pair, _)| pair.cmp(&faces)) {
            Ok(index) => {
                let directions = &mut self.sides[index].1.directions;
                if directions.iter().any(|d| d.dot(up) > 0.5) {
                    directions.retain(|d| d.dot(up) > 0.5);
                }
            }
            Err(index) => {
                let moving = FacePair::new(self.sheet, faces)
                    .moving(&self.last.positions, &self.last.positions);
                let pose = moving.at(0.0);
                let apart = roomiest(&axes(&moving, &pose));
                let is_beyond = apart.is_some_and(|d| d.dot(up) < 0.0);
                // The gap on the other side is below τ, and so is the overlap on this one.
                if is_beyond && pose.overlap(up) < self.limits.tolerance {
                    self.sides.insert(index, (faces, Side::contact(vec![up])));
                }
            }
        }
    }

    fn front(&self, face: u32) -> Option<DVec3> {
        Plane::of(&corners(self.sheet, &self.last.positions, face)).map(|plane| plane.normal)
    }

    /// The normal of the first triangle that points to the second according to the assignment of the crease between
    /// them.
    fn assigned(&self, [f, g]: [u32; 2]) -> Option<DVec3> {
        let mut hinges = self.layer_state.hinges[f as usize].iter().flatten();
        let &(edge, _) = hinges.find(|&&(_, beyond)| beyond == g)?;
        let front = self.front(f)?;
        match self.sheet.edges[edge as usize].assignment {
            Assignment::Valley => Some(front),
            Assignment::Mountain => Some(-front),
            _ => None,
        }
    }

    /// Finds the layers of the last frame among nearby pairs, and their order from the sides that were followed.
    ///
    /// A pair in contact since the first frame has the order of its crease, or the one claimed, if any. It gets another
    /// only after it was seen not to be a layer. `open`: pairs that this proof could not decide.
    pub(crate) fn find_layers(&mut self, near: &[[u32; 2]], open: &BTreeSet<[u32; 2]>) {
        let scale = LayerTolerances::new(self.limits.tolerance, &self.last.positions);
        let mut layers = layer::find(self.sheet, &self.last.positions, near, &scale);
        for layer in &mut layers {
            let faces = layer.faces;
            layer.is_lost = self.dropped.contains_key(&faces);
            let before = self.layer_state.order(faces);
            if self.frames == 1 {
                layer.up = self.assigned(faces);
            } else if let Some(before) = before.filter(|before| before.up.is_none()) {
                layer.doubt = layer.doubt.or(before.doubt);
            } else if open.contains(&faces) {
                layer.doubt = Some("on which side of each other they are");
            } else if !layer.is_lost && !self.undecided.contains(&(faces, self.frames - 2)) {
                let (up, is_sure) = self.followed_side(faces);
                layer.up = up;
                let unclear = (!is_sure).then_some("on which side of each other they are");
                layer.doubt = layer.doubt.or(unclear);
            }
            if let Some(doubt) = layer.doubt {
                let frame = self.frames - 1;
                self.layer_state.doubts.entry(frame).or_insert((faces, doubt));
            }
        }
        self.layer_state.layers = layers;
        self.layer_state.is_proved = false;
        if self.frames == 1 {
            for Layer { faces, up, .. } in self.layer_state.layers.clone() {
                if let Some(up) = up {
                    self.layer_state.claimed.insert(faces);
                    self.keep_side(faces, up);
                }
            }
        }
    }

    /// The side of the first triangle on which the second was followed to the last frame, and whether it is the only
    /// one. If both are possible, it is the one on which the triangles are strictly apart.
    fn followed_side(&self, faces: [u32; 2]) -> (Option<DVec3>, bool) {
        let Some(normal) = self.front(faces[0]) else {
            return (None, false);
        };
        let side = self.sides.binary_search_by(|(pair, _)| pair.cmp(&faces));
        let side = side.map(|index| &self.sides[index].1.directions[..]);
        if let Some(up) = side.ok().and_then(|side| side_of(normal, side)) {
            return (Some(up), true);
        }
        let positions = &self.last.positions;
        let moving = FacePair::new(self.sheet, faces).moving(positions, positions);
        let apart = roomiest(&axes(&moving, &moving.at(0.0)));
        let up = apart.and_then(|apart| side_of(normal, &[apart]));
        (up, up.is_some() && side.is_err())
    }

    /// Proves the order at the last frame, once, and compares it with what is stated.
    pub(crate) fn prove_layers(&mut self) {
        if std::mem::replace(&mut self.layer_state.is_proved, true) {
            return;
        }
        let positions = &self.last.positions;
        let scale = LayerTolerances::new(self.limits.tolerance, positions);
        let state = &self.layer_state;
        let clusters = prove(self.sheet, &state.hinges, positions, &state.layers, scale);
        let frame = self.frames - 1;
        let mut contradictions = std::mem::take(&mut self.layer_state.contradictions);
        for mut cluster in clusters {
            let found = std::mem::take(&mut cluster.contradictions).into_iter();
            let (mut sure, of_sides): (Vec<_>, Vec<_>) = found.partition(|f| self.is_sure(f));
            if sure.is_empty() && !of_sides.is_empty() {
                cluster.order = LayerProof::Unproved;
            }
            contradictions.append(&mut sure);
            for contradiction in of_sides {
                self.leave_order_open(&contradiction);
            }
            cluster.frames = [frame; 2];
            cluster.times = [self.last.time; 2];
            let mut known = self.layer_state.clusters.iter_mut().rev();
            let earlier = known.find(|c| c.frames[1] + 1 == frame && c.faces == cluster.faces);
            match earlier {
                Some(earlier) => earlier.go_on(&cluster),
                None => self.layer_state.clusters.push(cluster),
            }
        }
        self.compare_contradictions(frame, &contradictions);
    }

    /// Whether a contradiction shows that the sheet penetrates: it involves a claim, or is over one point.
    ///
    /// Along a line, sides as they were followed may contradict each other although the sheet can be pushed apart,
    /// because a contact may be left in another way. Passages there are shown by the sides coupled across edges.
    fn is_sure(&self, contradiction: &Contradiction) -> bool {
        let is_among = |pair: &[u32; 2]| pair.iter().all(|face| contradiction.faces.contains(face));
        contradiction.rule == LayerRule::Transitivity
            || self.layer_state.claimed.iter().any(is_among)
    }

    /// Names layers whose sides contradict each other, unless something passes through around them, or the side of two
    /// of them is ambiguous, so that it may be the other one.
    fn leave_order_open(&mut self, contradiction: &Contradiction) {
        let faces = &contradiction.faces;
        let pairs = || {
            let later = |(k, &f): (usize, &u32)| faces[k + 1..].iter().map(move |&g| [f, g]);
            faces.iter().enumerate().flat_map(later)
        };
        let is_doubtful = |layer: &Layer| layer.doubt.is_some();
        let is_explained = pairs().any(|pair| {
            self.layer_state.order(pair).is_some_and(is_doubtful)
                || self.is_listed_around(pair, self.last.time)
        });
        if let (Some(first), false) = (pairs().next(), is_explained) {
            let what = format!("whether the layers {faces:?} can have this order");
            self.leave_open(first, &what);
        }
    }
}
