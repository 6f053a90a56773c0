//! A penetration found by the second proof, compared with the one that is stated.

use foldmotion_pattern::Sheet;
use glam::DVec3;

use crate::closest::{closest, on_triangle};
use crate::face_pair::FacePair;
use crate::follow::{SideCrossing, instants_after};
use crate::instant::axes;
use crate::instant::depth;
use crate::moving_pair::{MovingPair, PairPose};
use crate::parts::disjoint_parts;
use crate::side::Limits;
use foldmotion_check::{Penetration, PenetrationKind};

/// The share of an interval to which two proofs agree about the beginning of a contact and the time it gets too deep.
const TIME_ACCURACY: f64 = 1e-6;
/// The relative accuracy to which two proofs agree about a depth.
const DEPTH_ACCURACY: f64 = 1e-5;
/// Where a contact begins or a pair gets deeper than τ, the pair touches, and the stated point lies on the features
/// that meet, to within this multiple of τ.
pub(crate) const POINT_TOLERANCES: f64 = 16.0;

/// A pair that gets too deep in an interval.
#[derive(Debug)]
pub(crate) struct FoundPenetration {
    moving: MovingPair,
    pub(crate) frame: usize,
    /// The motion times at the ends of the interval.
    pub(crate) times: [f64; 2],
    pub(crate) crossing: SideCrossing,
}

impl FoundPenetration {
    pub(crate) fn new(moving: &MovingPair, frame: usize, crossing: SideCrossing) -> Self {
        Self { moving: *moving, frame, times: [0.0, 1.0], crossing }
    }

    pub(crate) fn at_first_frame(moving: &MovingPair, time: f64, depth: f64) -> Self {
        let crossing =
            SideCrossing { contact: 0.0, passed: 0.0, depth, reach: depth, side: Vec::new() };
        Self { times: [time; 2], ..Self::new(moving, 0, crossing) }
    }

    fn is_first_frame(&self) -> bool {
        self.times[0] == self.times[1]
    }

    pub(crate) fn at(&self, t: f64) -> f64 {
        self.times[0] + (self.times[1] - self.times[0]) * t
    }

    /// How much two proofs may differ about an instant: a millionth of the interval, or the time the corners take to
    /// move by half of τ relative to each other.
    fn time_slack(&self, limits: &Limits) -> f64 {
        let corners = || self.moving.a.iter().chain(&self.moving.b);
        let moved = corners().map(|p| (p[1] - p[0]).length()).fold(0.0, f64::max);
        let share = TIME_ACCURACY.max(0.25 * limits.tolerance / moved);
        let [start, end] = self.times;
        share.min(1.0) * (end - start) + 4.0 * f64::EPSILON * start.abs().max(end.abs())
    }

    /// The share of the interval at motion time `time`; `None` if it is outside.
    fn share(&self, time: f64) -> Option<f64> {
        let [start, end] = self.times;
        let is_within = start < end && (start..=end).contains(&time);
        is_within.then(|| (time - start) / (end - start))
    }

    /// The smallest overlap at motion time `time`, for triangles that share no vertex.
    fn overlap(&self, time: f64, pair: &FacePair) -> Option<f64> {
        let share = self.share(time).filter(|_| pair.shared == 0)?;
        Some(depth(&self.moving, &self.moving.at(share)))
    }

    /// Whether the contact may begin when stated. Pairs that graze each other, or stay within τ for a while, come into
    /// contact more than once; at the stated time they must touch, and must not be too deep before.
    fn may_begin(&self, stated: &Penetration, pair: &FacePair, limits: &Limits) -> bool {
        let near = POINT_TOLERANCES * limits.tolerance;
        let is_met = match self.share(stated.time) {
            None => false,
            Some(share) if pair.shared == 0 => {
                depth(&self.moving, &self.moving.at(share)).abs() <= near
            }
            Some(share) => disjoint_parts(&self.moving)
                .iter()
                .any(|part| closest(&part.at(share)).distance() <= near),
        };
        stated.time <= stated.passed && is_met
    }

    /// Whether the pair may get too deep when stated. A contact that allows several sides may leave open which one the
    /// pair was on; then it must touch at the stated time and be too deep later in the interval.
    fn may_pass(&self, stated: &Penetration, pair: &FacePair, limits: &Limits) -> bool {
        let overlap = self.overlap(stated.passed, pair);
        let is_deep_later = self.share(stated.passed).is_some_and(|share| {
            instants_after(share)
                .any(|t| depth(&self.moving, &self.moving.at(t)) > limits.tolerance)
        });
        overlap.is_some_and(|o| o.abs() <= POINT_TOLERANCES * limits.tolerance) && is_deep_later
    }

    /// Whether the pair is as deep as stated.
    ///
    /// For triangles that share no vertex, the stated depth must equal the largest depth. Otherwise it must be at most
    /// the largest overlap at the instants examined: which axes count as the side of the pair is left to the first
    /// proof.
    fn is_as_deep(&self, stated: &Penetration, unit: f64, pair: &FacePair) -> bool {
        let is_close = |depth: f64| {
            let slack = DEPTH_ACCURACY * depth.abs() + 1e-9 * self.moving.size;
            (stated.depth * unit - depth).abs() <= slack
        };
        if is_close(self.depth(pair)) {
            return true;
        }
        if pair.shared == 0 {
            // The depth is taken at instants after the stated one, about which the two proofs agree only approximately.
            let depths = self.share(stated.passed).into_iter();
            let depths = depths.flat_map(instants_after);
            let depths = depths.map(|t| depth(&self.moving, &self.moving.at(t)));
            return is_close(depths.fold(0.0, f64::max));
        }
        let of_stated = self.share(stated.passed).into_iter();
        let instants = of_stated.chain([self.crossing.passed]).flat_map(instants_after);
        let overlaps = instants.flat_map(|t| {
            let pose = self.moving.at(t);
            let all = axes(&self.moving, &pose).into_iter();
            let along = all.map(|axis| axis.direction);
            let side = self.crossing.side.iter().copied();
            let both: Vec<f64> = along.chain(side).map(|d| pose.overlap(d)).collect();
            both
        });
        let largest = overlaps.fold(0.0, f64::max);
        stated.depth * unit <= (1.0 + DEPTH_ACCURACY) * largest
    }

    fn depth(&self, pair: &FacePair) -> f64 {
        match pair.shared {
            0 => self.crossing.depth.max(0.0),
            _ => self.crossing.reach,
        }
    }
}

/// The field, what is stated, and what was found.
type Difference = (&'static str, String, String);

/// The differences between a stated penetration and the one found.
pub(crate) fn compare(
    stated: &Penetration,
    found: &FoundPenetration,
    pair: &FacePair,
    sheet: &Sheet,
    limits: &Limits,
) -> Vec<Difference> {
    let unit = sheet.unit_length;
    let mut differences = Vec::new();
    let mut differ =
        |field, stated: String, found: String| differences.push((field, stated, found));
    if stated.frame != found.frame {
        differ("frames", stated.frame.to_string(), found.frame.to_string());
        return differences;
    }
    let slack = found.time_slack(limits);
    let is_near = |time: f64, t: f64| (time - found.at(t)).abs() <= slack;
    if !is_near(stated.time, found.crossing.contact) && !found.may_begin(stated, pair, limits) {
        let contact = found.at(found.crossing.contact);
        differ("t", stated.time.to_string(), contact.to_string());
    }
    if !is_near(stated.passed, found.crossing.passed) && !found.may_pass(stated, pair, limits) {
        let passed = found.at(found.crossing.passed);
        differ("passed_t", stated.passed.to_string(), passed.to_string());
    }
    if !found.is_as_deep(stated, unit, pair) {
        let depth = found.depth(pair) / unit;
        differ("depth", format!("{:e}", stated.depth), format!("{depth:e}"));
    }
    if !is_kind_right(stated, pair, limits.tolerance / unit) {
        differ(
            "kind",
            format!("{:?}", stated.kind),
            "it does not agree with the shared vertices and the depth".to_owned(),
        );
    }
    let passed = found.share(stated.passed);
    let pose = found.moving.at(passed.unwrap_or(found.crossing.passed));
    let point = stated.point - found.moving.origin;
    let near = POINT_TOLERANCES * limits.tolerance;
    if let Some(mismatch) =
        meeting_error(stated, pair, &pose, point, (near, found.is_first_frame()))
    {
        differ("point", stated.point.to_string(), mismatch.to_owned());
    }
    differences
}

pub(crate) fn is_kind_right(stated: &Penetration, pair: &FacePair, tolerance: f64) -> bool {
    use PenetrationKind::{
        AroundVertex, EdgeEdge, FoldedThrough, PassedThrough, ThroughEdge, VertexFacet,
    };
    match (pair.shared, stated.kind) {
        (0, PassedThrough) => stated.depth <= tolerance,
        (0, VertexFacet | EdgeEdge) | (1, AroundVertex) | (2, FoldedThrough) => {
            stated.depth > tolerance
        }
        (0..=2, ThroughEdge) => stated.depth >= 0.0,
        _ => false,
    }
}

/// Why the stated vertices do not meet at the stated point; `None` if they do.
///
/// `near`: the distance that counts as meeting. At the first frame (`is_far`) the triangles may already be far through
/// each other: then the point is the vertex itself, or halfway between the edges.
pub(crate) fn meeting_error(
    stated: &Penetration,
    pair: &FacePair,
    pose: &PairPose,
    point: DVec3,
    (near, is_far): (f64, bool),
) -> Option<&'static str> {
    let mut vertices = stated.vertices.clone();
    vertices.sort_unstable();
    let is_named = |features: &[u32]| {
        let mut named = features.to_vec();
        named.sort_unstable();
        named.dedup();
        pair.shared == 2 || named == vertices
    };
    if pair.shared == 2 {
        let mut hinge = [pair.a[0], pair.a[1], pair.a[2], pair.b[2]];
        hinge.sort_unstable();
        if vertices != hinge {
            return Some("the vertices are not those of the two triangles");
        }
    }
    let is_vertex_on = |v: &[u32; 3], p: &[DVec3; 3], facet: &[u32; 3], t: &[DVec3; 3]| {
        (pair.shared..3).any(|i| {
            is_named(&[v[i], facet[0], facet[1], facet[2]])
                && p[i].distance(point) <= near
                && (is_far || on_triangle(point, t).distance(point) <= near)
        })
    };
    let off_edge = |p: &[DVec3; 3], i: usize| {
        let (u, v) = (p[i], p[(i + 1) % 3]);
        on_triangle(point, &[u, v, v]).distance(point)
    };
    let are_edges = || {
        (0..9).any(|k| {
            let (i, j) = (k / 3, k % 3);
            let ends = [pair.a[i], pair.a[(i + 1) % 3], pair.b[j], pair.b[(j + 1) % 3]];
            let (off_a, off_b) = (off_edge(&pose.a, i), off_edge(&pose.b, j));
            let is_between =
                if is_far { (off_a - off_b).abs() <= near } else { off_a.max(off_b) <= near };
            is_named(&ends) && is_between
        })
    };
    let is_vertex = is_vertex_on(&pair.a, &pose.a, &pair.b, &pose.b)
        || is_vertex_on(&pair.b, &pose.b, &pair.a, &pose.a);
    let is_met = match stated.kind {
        PenetrationKind::VertexFacet => is_vertex,
        PenetrationKind::EdgeEdge => are_edges(),
        _ => is_vertex || are_edges(),
    };
    (!is_met).then_some("the named vertices do not meet there")
}
