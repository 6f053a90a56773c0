//! Follows a pair through an interval on the side it came from.

use glam::DVec3;

use crate::arcs;
use crate::instant::{Axis, axes, depth, inner, joined};
use crate::moving_pair::{MovingPair, OnPlane, PairPose};
use crate::path::Path;
use crate::side::{Limits, Side, clear_of, clearance};
use crate::trail::{StepDirection, Trail};

/// Sides that are lost at τ are tried again at this multiple of τ: the first proof counts at 31/32 τ.
const LENIENCE: f64 = 33.0 / 32.0;
/// The longest steps of the attempts, in turn.
const FIRST_STEPS: [f64; 4] = [1.0, 1.0, 1.0 / 16.0, 1.0 / 256.0];
/// Steps are at most this share of the time left to the instant at which an earlier attempt failed.
const APPROACH: f64 = 1.0 / 8.0;
/// The shortest step, as a share of the interval.
pub(crate) const SHORTEST_STEP: f64 = 1.0 / (1u64 << 34) as f64;
/// Steps longer than this are halved before every axis is tried.
const SEARCH_STEP: f64 = 1.0 / 8.0;
/// Steps longer than this are halved before triangles that are apart at both ends are assumed to touch in between.
const GRAZING_STEP: f64 = 1.0 / 1024.0;
/// The number of axes that a long step tries.
const FAVOURITES: usize = 4;

/// A pair that gets deeper than τ on its side.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SideCrossing {
    /// The time at which the contact began, as a share of the interval; 0 if it began before.
    pub(crate) contact: f64,
    /// The time up to which the pair is certified, as a share of the interval.
    pub(crate) passed: f64,
    /// The largest depth at the instants passed + 2^(k − 34), and at 1.
    pub(crate) depth: f64,
    /// The largest overlap, seen from its side, at those instants.
    pub(crate) reach: f64,
    /// The directions in which it could continue, up to `passed`.
    pub(crate) side: Vec<DVec3>,
}

/// The result of following a pair.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum FollowOutcome {
    Clean {
        side: Side,
        /// The directions along which it was kept on its side; `None` if it was never in contact.
        trail: Option<Trail>,
    },
    Crosses(SideCrossing),
    Undecided {
        /// The time up to which the pair is certified, as a share of the interval.
        time: f64,
    },
}

/// A direction along which the triangles are strictly apart, among those near a side.
fn strictly_apart(axes: &[Axis], side: &[DVec3]) -> Option<DVec3> {
    let apart = axes.iter().filter(|axis| axis.room > 0.0);
    let mut apart = apart.map(|axis| axis.direction);
    apart.find(|d| side.iter().any(|s| s.dot(*d) > 0.5))
}

/// Follows a pair as [`follow`] does, but with a slightly larger tolerance if it loses its side at τ.
pub(crate) fn follow_leniently(moving: &MovingPair, side: &Side, limits: &Limits) -> FollowOutcome {
    let followed = follow(moving, side, limits);
    let is_deep = |c: &SideCrossing| moving.shared == 0 && c.depth > limits.tolerance;
    match &followed {
        FollowOutcome::Clean { .. } => followed,
        FollowOutcome::Crosses(crossing) if is_deep(crossing) => followed,
        _ => {
            let lenient = Limits { tolerance: LENIENCE * limits.tolerance, ..*limits };
            match follow(moving, side, &lenient) {
                clean @ FollowOutcome::Clean { .. } => clean,
                _ => followed,
            }
        }
    }
}

/// Follows a pair through t in [0, 1] from the side it is on at 0.
///
/// A long step may lose a side that a short one keeps. If an attempt fails at some instant, the next one approaches
/// that instant in ever shorter steps.
pub(crate) fn follow(moving: &MovingPair, side: &Side, limits: &Limits) -> FollowOutcome {
    let mut followed = FollowOutcome::Undecided { time: 0.0 };
    let mut lost = Vec::with_capacity(FIRST_STEPS.len());
    for first_step in FIRST_STEPS {
        followed = Follower::new(moving, side.clone(), limits).run(first_step, &lost);
        match &followed {
            FollowOutcome::Clean { .. } => break,
            FollowOutcome::Crosses(crossing) if crossing.depth > limits.tolerance => break,
            FollowOutcome::Crosses(crossing) => lost.push(crossing.passed),
            FollowOutcome::Undecided { time } => lost.push(*time),
        }
    }
    followed
}

struct Follower<'a> {
    moving: &'a MovingPair,
    limits: &'a Limits,
    time: f64,
    pose: PairPose,
    side: Side,
    /// The axes that can be reached at `time`, once computed.
    reached: Option<Vec<Axis>>,
    /// Other directions that can be reached at `time`.
    others: Vec<DVec3>,
    last_apart: Option<(f64, DVec3)>,
    /// The end of the step in which the present contact began.
    first_contact: f64,
    is_in_contact: bool,
    has_touched: bool,
    trail: Trail,
}

/// A step that is proved.
struct Step {
    side: Side,
    /// A direction along which the pair is strictly apart at the end of the step.
    apart: Option<DVec3>,
    /// The directions along which the pair is kept on its side, if it is in contact.
    directions: Vec<StepDirection>,
}

impl<'a> Follower<'a> {
    fn new(moving: &'a MovingPair, side: Side, limits: &'a Limits) -> Self {
        let last_apart = if side.is_apart {
            Some(first_direction(&side))
        } else {
            strictly_apart(&axes(moving, &moving.at(0.0)), &side.directions)
        };
        Self {
            moving,
            limits,
            time: 0.0,
            pose: moving.at(0.0),
            has_touched: !side.is_apart,
            trail: Trail::new(&side),
            side,
            reached: None,
            others: Vec::new(),
            last_apart: last_apart.map(|direction| (0.0, direction)),
            first_contact: 0.0,
            is_in_contact: last_apart.is_none(),
        }
    }

    /// `lost`: the instants at which earlier attempts failed.
    fn run(mut self, first_step: f64, lost: &[f64]) -> FollowOutcome {
        let mut step = first_step;
        for _ in 0..self.limits.budget {
            if self.time >= 1.0 {
                return FollowOutcome::Clean {
                    side: self.side,
                    trail: self.has_touched.then_some(self.trail),
                };
            }
            let left = lost.iter().map(|t| t - self.time);
            let nearest = left.filter(|&t| t > 0.0).fold(f64::INFINITY, f64::min);
            while step > SHORTEST_STEP.max(APPROACH * nearest) {
                step *= 0.5;
            }
            let end = self.moving.at(self.time + step);
            if let Some(leg) = self.cross(&end, step) {
                self.land(leg, end, step);
                // The time stays a multiple of the step.
                if step < first_step && (self.time / (2.0 * step)).fract() == 0.0 {
                    step *= 2.0;
                }
            } else if step > SHORTEST_STEP {
                step *= 0.5;
            } else {
                return self.examine();
            }
        }
        FollowOutcome::Undecided { time: self.time }
    }

    fn land(&mut self, Step { side, apart, directions }: Step, pose: PairPose, step: f64) {
        self.trail.push([self.time, self.time + step], directions);
        self.time += step;
        self.pose = pose;
        if let Some(direction) = apart {
            self.last_apart = Some((self.time, direction));
            self.is_in_contact = false;
        } else if !std::mem::replace(&mut self.is_in_contact, true) {
            self.first_contact = self.time;
        }
        self.side = side;
        self.reached = None;
    }

    fn cross(&mut self, end: &PairPose, step: f64) -> Option<Step> {
        let part = self.moving.part(&self.pose, end);
        if self.side.is_apart {
            if let Some(direction) = self.stay_apart(&part, step) {
                return Some(Step {
                    side: Side::apart(direction),
                    apart: Some(direction),
                    directions: Vec::new(),
                });
            }
            let limit = clearance(self.moving, self.limits);
            let may_graze = || clear_of(&axes(self.moving, end), limit).is_none();
            if step > SEARCH_STEP || (step > GRAZING_STEP && !may_graze()) {
                return None;
            }
        }
        self.stay_within(&part, end)
    }

    /// Tries to keep the triangles strictly apart along one axis throughout the step; returns its direction at the end.
    fn stay_apart(&self, part: &MovingPair, step: f64) -> Option<DVec3> {
        let limit = clearance(self.moving, self.limits);
        let free = |from: DVec3, to: DVec3| {
            let bound = Path::straight(from, to).bound(part, corners(part));
            (part.shared < 2 && bound.room > limit).then_some(to)
        };
        let carried = self.side.directions.iter();
        if let Some(direction) = carried.copied().find_map(|d| free(d, d)) {
            return Some(direction);
        }
        let middle = part.at(0.5);
        let mut all = axes(part, &middle);
        let centre = inner(part, &all);
        all.retain(|axis| axis.room > limit);
        all.sort_by(|p, q| q.room.total_cmp(&p.room));
        let tried = if step > SEARCH_STEP { FAVOURITES } else { all.len() };
        for axis in all.iter().take(tried) {
            if part.bound(axis.feature).room > limit {
                return unit_end(part, axis);
            }
            if let Some(direction) = free(axis.direction, axis.direction) {
                return Some(direction);
            }
        }
        let centre_at = |t: f64| {
            let pose = part.at(t);
            inner(part, &axes(part, &pose))
        };
        let centre = centre.and_then(|d| free(d, d));
        centre.or_else(|| free(centre_at(0.0)?, centre_at(1.0)?))
    }

    /// Tries to keep the overlap within τ along one reachable axis throughout the step.
    fn stay_within(&mut self, part: &MovingPair, end: &PairPose) -> Option<Step> {
        let limit = self.limits.tolerance;
        self.reach();
        let reached = self.reached.as_deref().unwrap_or_default();
        let mut landed: Vec<DVec3> = Vec::new();
        let mut directions: Vec<StepDirection> = Vec::new();
        let mut keep = |direction: DVec3, step_direction: StepDirection| {
            if landed.iter().all(|d| d.dot(direction) < 1.0 - 1e-13) {
                landed.push(direction);
                directions.push(step_direction);
            }
        };
        for axis in reached {
            if part.bound(axis.feature).gap >= -limit
                && let Some(direction) = unit_end(part, axis)
            {
                keep(direction, StepDirection::Along(axis.feature));
            }
        }
        for &direction in self.side.directions.iter().chain(&self.others) {
            let fixed = Path::straight(direction, direction);
            if fixed.bound(part, corners(part)).gap >= -limit {
                keep(direction, StepDirection::Fixed(direction));
            }
        }
        if landed.is_empty() {
            return None;
        }
        self.has_touched = true;
        let there = axes(part, end);
        let clear = clearance(self.moving, self.limits);
        let joined = clear_of(&there, clear).is_some().then(|| joined(end, &there, &landed, limit));
        let way_out = joined.and_then(|joined| clear_of(&joined, clear));
        let apart = way_out.or_else(|| strictly_apart(&there, &landed));
        Some(Step {
            apart,
            side: way_out.map_or_else(|| Side::contact(landed), Side::apart),
            directions,
        })
    }

    /// Computes the directions that can be reached at the present instant.
    fn reach(&mut self) {
        if self.reached.is_some() {
            return;
        }
        let all = axes(self.moving, &self.pose);
        let mut seeds = self.side.directions.clone();
        if self.side.is_apart {
            let clear = clearance(self.moving, self.limits);
            let apart = all.iter().filter(|axis| axis.room > clear);
            seeds.extend(apart.map(|axis| axis.direction));
        }
        let limit = self.limits.tolerance;
        let reached = joined(&self.pose, &all, &seeds, limit);
        self.others.clear();
        if reached.is_empty() {
            // If triangles are almost edges, their axes are lost to rounding.
            let nodes = arcs::normals(&self.pose);
            let is_reached = arcs::reached(&self.pose, &nodes, &seeds, limit);
            let both = nodes.into_iter().zip(is_reached);
            let within = both.filter(|&(d, is_reached)| {
                is_reached || (self.side.is_apart && self.pose.overlap(d) <= limit)
            });
            self.others = within.map(|(d, _)| d).collect();
        }
        self.reached = Some(reached);
    }

    /// Called when no step succeeds: searches for an instant at which the pair is deeper than τ on its side.
    fn examine(mut self) -> FollowOutcome {
        self.reach();
        let reached = self.reached.take().unwrap_or_default();
        let mut seeds: Vec<_> = reached.iter().map(|axis| axis.direction).collect();
        seeds.extend(&self.side.directions);
        let (mut reach, mut deepest) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        for instant in instants_after(self.time) {
            let pose = self.moving.at(instant);
            deepest = deepest.max(depth(self.moving, &pose));
            let from_side = overlaps_from_side(self.moving, &pose, &seeds);
            reach = reach.max(from_side.fold(f64::INFINITY, f64::min));
        }
        let rounding = 1e-12 * self.moving.size;
        if reach.max(deepest) <= self.limits.tolerance + rounding {
            return FollowOutcome::Undecided { time: self.time };
        }
        FollowOutcome::Crosses(SideCrossing {
            contact: self.contact_start(),
            passed: self.time,
            depth: deepest,
            reach,
            side: seeds,
        })
    }

    /// The time at which the present contact began, by bisection.
    fn contact_start(&self) -> f64 {
        let Some((mut apart, direction)) = self.last_apart else {
            return 0.0;
        };
        let mut contact = if self.is_in_contact { self.first_contact } else { self.time };
        let parting = |t: f64| {
            let all = axes(self.moving, &self.moving.at(t)).into_iter();
            all.filter(|axis| axis.room > 0.0).map(|axis| axis.direction)
        };
        // The step that ended in contact was proved along one of the directions along which the triangles were apart.
        let before: Vec<DVec3> = parting(apart).chain([direction]).collect();
        for _ in 0..40 {
            let middle = f64::midpoint(apart, contact);
            if parting(middle).any(|d| before.iter().any(|b| b.dot(d) > 0.5)) {
                apart = middle;
            } else {
                contact = middle;
            }
        }
        contact
    }
}

/// The corners on the plane of an axis that is not built from the triangles: the shared ones.
fn corners(moving: &MovingPair) -> OnPlane {
    let shared = [0, 1, 2].map(|i| i < moving.shared);
    OnPlane { a: shared, b: shared }
}

fn first_direction(side: &Side) -> DVec3 {
    side.directions.first().copied().unwrap_or(DVec3::ZERO)
}

/// The direction of an axis at the end of a step.
fn unit_end(part: &MovingPair, axis: &Axis) -> Option<DVec3> {
    part.directed(axis.feature).ends()[1].try_normalize()
}

/// The instants time + 2^(k − 34) for k = 0, 1, … that are less than 1, and 1 itself.
pub(crate) fn instants_after(time: f64) -> impl Iterator<Item = f64> {
    let later = std::iter::successors(Some(SHORTEST_STEP), |after| Some(2.0 * after));
    let within = later.map(move |after| time + after).take_while(|&t| t < 1.0);
    within.chain([1.0])
}

/// The overlaps along the axes within 60° of the side, and along the side itself.
fn overlaps_from_side(
    moving: &MovingPair,
    pose: &PairPose,
    side: &[DVec3],
) -> impl Iterator<Item = f64> {
    let all = axes(moving, pose).into_iter().map(|axis| axis.direction);
    let near = all.filter(|d| side.iter().any(|s| s.dot(*d) > 0.5));
    near.chain(side.iter().copied()).map(|d| pose.overlap(d))
}
