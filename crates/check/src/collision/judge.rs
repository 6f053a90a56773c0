//! The judgement of one pair in one interval.

use foldmotion_geometry::{
    collide::{
        Approach, Axis, Crossing, Effort, Feature, Limits, MovingPair, Outcome, PairPose, Side,
        certify, closest_approach, enough_clearance,
    },
    segment_segment,
};
use glam::DVec3;

use super::{pair::Pair, report::PenetrationKind};

/// What an interval did to a pair.
#[derive(Debug)]
pub(super) enum Judgement {
    Passed {
        side: Side,
        effort: Effort,
        is_touching: bool,
        /// The closest approach, where it may be news.
        approach: Option<Approach>,
    },
    Penetrates(Witness),
    Undecided {
        time: f64,
    },
}

/// A penetration in the time and the coordinates of the interval.
#[derive(Debug)]
pub(super) struct Witness {
    pub(super) contact: f64,
    pub(super) passed: f64,
    pub(super) kind: PenetrationKind,
    pub(super) vertices: Vec<u32>,
    pub(super) point: DVec3,
    pub(super) depth: f64,
}

/// What a pair is asked.
#[derive(Debug, Clone, Copy)]
pub(super) struct Question<'a> {
    pub(super) limits: &'a Limits,
    /// The closest approach is wanted where it is nearer than this; none where the pair's facets share a vertex.
    pub(super) nearer_than: Option<f64>,
    /// Whether the pair is known to touch.
    pub(super) has_touched: bool,
}

impl Question<'_> {
    /// Judges a pair from its side; none stands for a pair that starts deeper than τ.
    pub(super) fn judge(&self, pair: &Pair, moving: &MovingPair, side: Option<&Side>) -> Judgement {
        let Some(side) = side else {
            return Judgement::Penetrates(starts_deep(pair, &moving.start));
        };
        let passage = match certify(moving, side, self.limits) {
            Outcome::Passed(passage) => passage,
            Outcome::Crossed(crossing) => {
                return Judgement::Penetrates(self.witness(pair, moving, &crossing));
            }
            Outcome::Undecided { time } => return Judgement::Undecided { time },
        };
        let tolerance = self.limits.tolerance;
        let may_touch = pair.shared == 0 && !self.has_touched && passage.clearance <= tolerance;
        let wanted = self.nearer_than.unwrap_or(0.0);
        let bound = if may_touch {
            wanted.max(2.0 * tolerance)
        } else {
            wanted
        };
        let is_news = pair.shared == 0 && passage.clearance < enough_clearance(bound, self.limits);
        let found = is_news.then(|| closest_approach(moving, bound, self.limits));
        let approach = found.and_then(|found| found.nearest);
        let distance = approach.map_or(f64::INFINITY, |approach| approach.closest.distance);
        // Free is claimed only where it is proved, to the hundredth of τ to which distances are searched.
        let is_proved_free =
            found.is_some_and(|found| found.is_complete) && distance > 1.01 * tolerance;
        Judgement::Passed {
            side: passage.side,
            effort: passage.effort,
            is_touching: passage.in_contact || (may_touch && !is_proved_free),
            approach: approach.filter(|_| distance < wanted),
        }
    }

    fn witness(&self, pair: &Pair, moving: &MovingPair, crossing: &Crossing) -> Witness {
        let pose = moving.at(crossing.confirmed);
        let is_deep = crossing.depth > self.limits.tolerance;
        let (vertices, point) = meeting(pair, &pose, &crossing.axis);
        let (kind, depth) = match pair.shared {
            0 if is_deep => (kind_of(&crossing.axis), crossing.depth),
            0 => (PenetrationKind::PassedThrough, crossing.depth.max(0.0)),
            1 => (PenetrationKind::AroundVertex, crossing.reach),
            _ => (PenetrationKind::FoldedThrough, crossing.reach),
        };
        Witness {
            contact: crossing.contact,
            passed: crossing.passed,
            kind,
            vertices,
            point,
            depth,
        }
    }
}

/// The witness of a pair that is deeper than τ at the start of an interval.
pub(super) fn starts_deep(pair: &Pair, pose: &PairPose) -> Witness {
    let axis = pose.depth();
    let (vertices, point) = meeting(pair, pose, &axis);
    Witness {
        contact: 0.0,
        passed: 0.0,
        kind: match pair.shared {
            0 => kind_of(&axis),
            1 => PenetrationKind::AroundVertex,
            _ => PenetrationKind::FoldedThrough,
        },
        vertices,
        point,
        depth: axis.overlap,
    }
}

fn kind_of(axis: &Axis) -> PenetrationKind {
    match axis.feature {
        Feature::Edges(..) => PenetrationKind::EdgeEdge,
        _ => PenetrationKind::VertexFacet,
    }
}

/// The vertices that meet along an axis, and where.
fn meeting(pair: &Pair, pose: &PairPose, axis: &Axis) -> (Vec<u32>, DVec3) {
    let height = |p: &DVec3| axis.direction.dot(*p);
    let extreme = |corners: &[DVec3; 3], sign: f64| {
        let by_height = |&i: &usize, &j: &usize| {
            (sign * height(&corners[i])).total_cmp(&(sign * height(&corners[j])))
        };
        (0..3).max_by(by_height).unwrap_or(0)
    };
    let (vertices, point) = match axis.feature {
        Feature::Edges(i, j) => {
            let ends = |i: u8| [usize::from(i), (usize::from(i) + 1) % 3];
            let (i, j) = (ends(i), ends(j));
            let meeting = segment_segment(i.map(|k| pose.a[k]), j.map(|k| pose.b[k]));
            let vertices = i.map(|k| pair.a[k]).into_iter().chain(j.map(|k| pair.b[k]));
            (vertices.collect(), meeting.on_a.midpoint(meeting.on_b))
        }
        Feature::NormalB | Feature::SideB(_) => {
            let i = extreme(&pose.a, 1.0);
            let vertices = [pair.a[i]].into_iter().chain(pair.b);
            (vertices.collect::<Vec<_>>(), pose.a[i])
        }
        Feature::NormalA | Feature::SideA(_) | Feature::Free => {
            let j = extreme(&pose.b, -1.0);
            let vertices = [pair.b[j]].into_iter().chain(pair.a);
            (vertices.collect(), pose.b[j])
        }
    };
    if pair.shared == 2 {
        return (vec![pair.a[0], pair.a[1], pair.a[2], pair.b[2]], point);
    }
    let mut distinct: Vec<u32> = Vec::with_capacity(4);
    for vertex in vertices {
        if !distinct.contains(&vertex) {
            distinct.push(vertex);
        }
    }
    (distinct, point)
}
