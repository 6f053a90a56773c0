//! Whether a part passes through an edge between triangles where and when it is stated to.

use foldmotion_pattern::Frame;
use glam::DVec3;

use crate::closest::{closest, on_triangle};
use crate::face_pair::FacePair;
use crate::follow::instants_after;
use crate::moving_pair::PairPose;
use crate::neighbourhood::{Neighbourhood, edges};
use crate::penetration::{POINT_TOLERANCES, is_kind_right, meeting_error};
use crate::piercing::Surface;
use foldmotion_check::{Penetration, PenetrationKind};

/// The number of instants examined in an interval, besides those that approach a passage.
const SAMPLES: u32 = 32;
/// The number of instants examined in each interval after the one at which something is stated.
const LATER_SAMPLES: u32 = 4;
/// The largest number of steps towards the instant at which the stated point is met.
const MOST_STEPS: u32 = 1 << 14;

/// An edge and a surface that it passes through.
pub(crate) type Piercing = ([u32; 2], Surface);

/// The field, what is stated, and what was found.
type Mismatch = (&'static str, String, &'static str);

/// The frames at both ends of the interval of a penetration.
pub(crate) struct Interval<'a> {
    pub(crate) around: &'a Neighbourhood,
    pub(crate) frames: [&'a Frame; 2],
    /// τ, a length.
    pub(crate) tolerance: f64,
    pub(crate) unit: f64,
}

impl Interval<'_> {
    fn times(&self) -> [f64; 2] {
        self.frames.map(|frame| frame.time)
    }

    fn position(&self, v: u32, t: f64) -> DVec3 {
        let [p, q] = self.frames.map(|frame| frame.positions[v as usize]);
        p + (q - p) * t
    }

    /// The share of the interval at a motion time, clamped to [0, 1].
    fn share(&self, time: f64) -> f64 {
        let [start, end] = self.times();
        if end > start { ((time - start) / (end - start)).clamp(0.0, 1.0) } else { 0.0 }
    }

    /// Whether, at one of the instants examined, an edge near the stated triangles pierces the sheet so far that no
    /// push by τ undoes it.
    pub(crate) fn is_pierced_around(&self, stated: &Penetration) -> bool {
        let samples = (0..=SAMPLES).map(|k| f64::from(k) / f64::from(SAMPLES));
        let mut instants = samples.chain(instants_after(self.share(stated.passed)));
        let all = self.piercings(stated);
        instants.any(|t| all.iter().any(|piercing| self.is_sure(piercing, t)))
    }

    /// The edges near the stated triangles that pass through a surface at the end of the interval, possibly by less
    /// than τ.
    pub(crate) fn piercings_at_end(&self, stated: &Penetration) -> Vec<Piercing> {
        let mut all = self.piercings(stated);
        all.retain(|piercing| self.is_through(piercing, 1.0));
        all
    }

    /// Whether a piercing of the previous interval continues in this one until no push by τ undoes it; those that end
    /// are dropped.
    pub(crate) fn is_pierced_later(&self, piercings: &mut Vec<Piercing>) -> bool {
        let samples = || (1..=LATER_SAMPLES).map(|k| f64::from(k) / f64::from(LATER_SAMPLES));
        let lasts = |piercing: &Piercing| {
            let mut while_through = samples().take_while(|&t| self.is_through(piercing, t));
            while_through.any(|t| self.is_sure(piercing, t))
        };
        if piercings.iter().any(lasts) {
            return true;
        }
        piercings.retain(|piercing| samples().all(|t| self.is_through(piercing, t)));
        false
    }

    /// The edges around each triangle, paired with the surfaces around the other.
    fn piercings(&self, stated: &Penetration) -> Vec<Piercing> {
        let corners = stated.faces.map(|f| *self.around.corners(f));
        let mut all = Vec::new();
        for (a, b) in [(0, 1), (1, 0)] {
            let edges = self.around.edges_at(&corners[a]);
            for surface in self.around.surfaces_at(&corners[b]) {
                all.extend(edges.iter().map(|&edge| (edge, surface.clone())));
            }
        }
        all
    }

    fn is_sure(&self, (edge, surface): &Piercing, t: f64) -> bool {
        surface.is_pierced(*edge, &|v| self.position(v, t), self.tolerance)
    }

    fn is_through(&self, (edge, surface): &Piercing, t: f64) -> bool {
        surface.is_met(*edge, &|v| self.position(v, t), self.tolerance)
    }

    /// What is wrong with a stated penetration, independently of what passes through.
    pub(crate) fn mismatch(&self, stated: &Penetration, pair: &FacePair) -> Option<Mismatch> {
        let [_, end] = self.times();
        if !(stated.time <= stated.passed && stated.passed <= end) {
            let found =
                "the contact must begin before that, and no later than the end of the interval";
            return Some(("passed_t", stated.passed.to_string(), found));
        }
        if !is_kind_right(stated, pair, self.tolerance / self.unit) {
            let found = "it does not agree with the shared vertices and the depth";
            return Some(("kind", format!("{:?}", stated.kind), found));
        }
        if stated.kind != PenetrationKind::ThroughEdge {
            return self.meeting_error(stated, pair);
        }
        let from = self.share(stated.passed);
        let all = Self::features(stated, pair).into_iter();
        let nearest = all.min_by(|&p, &q| self.apart(p, from).total_cmp(&self.apart(q, from)));
        let Some([a, b]) = nearest else {
            let found = "these are not two simplices of the triangles without a common vertex";
            return Some(("vertices", format!("{:?}", stated.vertices), found));
        };
        let near = POINT_TOLERANCES * self.tolerance;
        if stated.passed >= self.times()[0] && self.apart([a, b], from) > near {
            let found = "the named vertices do not meet then";
            return Some(("passed_t", stated.passed.to_string(), found));
        }
        if !self.is_met(stated.point, [a, b], from) {
            let found = "the named vertices do not meet there";
            return Some(("point", stated.point.to_string(), found));
        }
        let most = self.deepest(stated) + near;
        if !(stated.depth >= 0.0 && stated.depth * self.unit <= most) {
            let found = "no edge nearby lies so far beyond a triangle nearby";
            return Some(("depth", format!("{:e}", stated.depth), found));
        }
        None
    }

    fn meeting_error(&self, stated: &Penetration, pair: &FacePair) -> Option<Mismatch> {
        let [start, end] = self.frames.map(|frame| &frame.positions[..]);
        let moving = pair.moving(start, end);
        let pose = moving.at(self.share(stated.passed));
        let near = POINT_TOLERANCES * self.tolerance;
        let point = stated.point - moving.origin;
        let found = meeting_error(stated, pair, &pose, point, (near, false))?;
        Some(("point", stated.point.to_string(), found))
    }

    /// The simplices that the vertices may name, each as a triangle with repeated corners: one in each triangle of the
    /// pair.
    fn features(stated: &Penetration, pair: &FacePair) -> Vec<[[u32; 3]; 2]> {
        let v = &stated.vertices;
        let mut splits: Vec<[[u32; 3]; 2]> = match **v {
            [a, b, c, d] => vec![[[a, a, a], [b, c, d]], [[a, b, b], [c, d, d]]],
            [a, b, c, d, e] => vec![[[a, b, b], [c, d, e]]],
            [a, b, c] => vec![[[a, a, a], [b, c, c]]],
            _ => Vec::new(),
        };
        let lies = |part: &[u32; 3], corners: &[u32; 3]| part.iter().all(|v| corners.contains(v));
        splits.retain(|[a, b]| {
            let is_disjoint = !a.iter().any(|v| b.contains(v));
            let is_so = |p, q| lies(a, p) && lies(b, q);
            is_disjoint && (is_so(&pair.a, &pair.b) || is_so(&pair.b, &pair.a))
        });
        splits
    }

    fn pose(&self, features: [[u32; 3]; 2], t: f64) -> PairPose {
        let [a, b] = features.map(|corners| corners.map(|v| self.position(v, t)));
        PairPose { a, b }
    }

    fn apart(&self, features: [[u32; 3]; 2], t: f64) -> f64 {
        closest(&self.pose(features, t)).distance()
    }

    /// Whether a point lies on both features at some instant from `from` on.
    ///
    /// The distance of the point from a feature changes no faster than the fastest corner moves.
    fn is_met(&self, point: DVec3, features: [[u32; 3]; 2], from: f64) -> bool {
        let near = POINT_TOLERANCES * self.tolerance;
        let moves = features.iter().flatten();
        let moves = moves.map(|&v| self.position(v, 0.0).distance(self.position(v, 1.0)));
        let speed = moves.fold(0.0, f64::max);
        let mut t = from;
        for _ in 0..MOST_STEPS {
            let pose = self.pose(features, t);
            let off = |corners: &[DVec3; 3]| on_triangle(point, corners).distance(point);
            let far = off(&pose.a).max(off(&pose.b));
            if far <= near {
                return true;
            }
            if t >= 1.0 || speed == 0.0 {
                return false;
            }
            t = (t + (far - 0.5 * near) / speed).min(1.0);
        }
        true
    }

    /// A bound of how far an edge nearby lies beyond a triangle nearby, at the instants examined and between them.
    fn deepest(&self, stated: &Penetration) -> f64 {
        let corners = stated.faces.map(|f| *self.around.corners(f));
        let faces = self.around.faces_at(&corners.concat());
        let all: Vec<[u32; 2]> =
            faces.iter().flat_map(|&face| edges(self.around.corners(face))).collect();
        let beyond = |t: f64| {
            let heights = faces.iter().flat_map(|&face| {
                let [p, q, r] = self.around.corners(face).map(|v| self.position(v, t));
                let normal = (q - p).cross(r - p).normalize_or_zero();
                all.iter().map(move |edge| {
                    let [above, below] = edge.map(|v| normal.dot(self.position(v, t) - p));
                    above.min(-below).max(below.min(-above))
                })
            });
            heights.fold(0.0, f64::max)
        };
        let samples = (0..=SAMPLES).map(|k| beyond(f64::from(k) / f64::from(SAMPLES)));
        let largest = samples.fold(0.0, f64::max);
        let moves = corners.iter().flatten();
        let moves = moves.map(|&v| self.position(v, 0.0).distance(self.position(v, 1.0)));
        largest + 2.0 * moves.fold(0.0, f64::max) / f64::from(SAMPLES)
    }
}
