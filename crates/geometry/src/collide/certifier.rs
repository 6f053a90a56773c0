//! Steps through time that certify a pair of moving triangles, or find where it crosses.

use glam::DVec3;

use super::{
    Axis, Effort, Feature, Limits, MovingPair, Outcome, PairCertificate, PairCrossing, PairPose,
    Side,
    pose::{are_linked, turned_along},
    separating::{separating, widest},
};

/// The shortest step: motions over it are far below τ.
const SHORTEST_STEP: f64 = 1.0 / (1u64 << 34) as f64;
/// Steps longer than this are halved before a pair that separates is left on an axis along which it still touches. Over
/// shorter steps, overlaps grow by less than τ, unless the motion exceeds 2²⁶ τ in the interval.
const PARTING_STEP: f64 = 1.0 / (1u64 << 26) as f64;
/// Steps longer than this are halved before all axes are tried.
const SEARCH_STEP: f64 = 1.0 / 8.0;
/// Steps longer than this are halved before a contact is assumed between two instants at which the triangles are apart.
const GRAZING_STEP: f64 = 1.0 / 1024.0;

/// Marks all axes that are linked to a marked one, directly or through others.
fn spread(axes: &[Axis], marked: &mut [bool], limits: &Limits) {
    let mut open: Vec<usize> = (0..axes.len()).filter(|&i| marked[i]).collect();
    while let Some(i) = open.pop() {
        for j in 0..axes.len() {
            if !marked[j] && are_linked(&axes[i], &axes[j], limits) {
                marked[j] = true;
                open.push(j);
            }
        }
    }
}

fn free_axis(pose: &PairPose, direction: DVec3) -> Axis {
    Axis { direction, overlap: pose.overlap(direction), feature: Feature::Free }
}

/// The state of a pair at `time`, certified up to there.
pub(super) struct Certifier<'a> {
    pair: &'a MovingPair,
    limits: &'a Limits,
    time: f64,
    pose: PairPose,
    side: Side,
    /// Whether the separating axis was chosen anew at `time`.
    is_fresh: bool,
    /// The axes that the path may be on at `time`, once computed.
    reached: Option<Vec<DVec3>>,
    /// The last time at which the triangles were known to be apart, and the axis.
    last_apart: Option<(f64, DVec3)>,
    /// The end of the step in which the present contact began.
    first_contact: f64,
    clearance: f64,
    in_contact: bool,
    effort: Effort,
}

impl<'a> Certifier<'a> {
    pub(super) fn new(pair: &'a MovingPair, side: Side, limits: &'a Limits) -> Self {
        let (last_apart, in_contact) = match &side {
            Side::Apart(direction) => (Some((0.0, *direction)), false),
            Side::Contact(_) => (None, true),
        };
        Self {
            pair,
            limits,
            time: 0.0,
            pose: pair.start,
            side,
            is_fresh: false,
            reached: None,
            last_apart,
            first_contact: 0.0,
            clearance: if in_contact { 0.0 } else { f64::INFINITY },
            in_contact,
            effort: Effort::AxisAtRest,
        }
    }

    /// Advances to t = 1 in dyadic steps of at most `first_step`.
    pub(super) fn run(mut self, first_step: f64) -> Outcome {
        let mut step = first_step;
        for _ in 0..self.limits.budget {
            if self.time >= 1.0 {
                return Outcome::Passed(PairCertificate {
                    side: self.side,
                    clearance: self.clearance,
                    in_contact: self.in_contact,
                    effort: self.effort,
                });
            }
            let end = self.pair.at(self.time + step);
            if let Some(side) = self.cross(&end, step) {
                self.land(side, end, step);
                // The time stays a multiple of the step.
                if step < first_step && (self.time / (2.0 * step)).fract() == 0.0 {
                    step *= 2.0;
                }
            } else if step > SHORTEST_STEP {
                step *= 0.5;
            } else {
                return self.examine(step);
            }
        }
        Outcome::Undecided { time: self.time }
    }

    fn land(&mut self, side: Side, pose: PairPose, step: f64) {
        self.time += step;
        self.pose = pose;
        if let Side::Apart(direction) = side {
            self.last_apart = Some((self.time, direction));
        } else if matches!(self.side, Side::Apart(_)) {
            self.first_contact = self.time;
        }
        self.side = side;
        self.is_fresh = false;
        self.reached = None;
    }

    /// Certifies the step to `end` and returns the side there.
    fn cross(&mut self, end: &PairPose, step: f64) -> Option<Side> {
        let Side::Apart(direction) = self.side else {
            let parts =
                widest(end, self.limits).is_some() && widest(&self.pose, self.limits).is_none();
            return if parts { self.part(end, step) } else { self.touch(end) };
        };
        let mut apart = self.glide(direction, end);
        if apart.is_none() && !self.is_fresh {
            self.is_fresh = true;
            if let Some(best) = widest(&self.pose, self.limits) {
                self.side = Side::Apart(best);
                apart = self.glide(best, end);
            }
        }
        if apart.is_some() || step > SEARCH_STEP {
            return apart.map(Side::Apart);
        }
        if self.pose.shared < 2 && widest(end, self.limits).is_some() {
            apart = self.switch(end);
            if apart.is_some() || step > GRAZING_STEP {
                return apart.map(Side::Apart);
            }
            return self.part(end, step);
        }
        self.touch(end)
    }

    /// Leaves contact during the step to `end`, where the triangles are apart.
    ///
    /// A path that ends on an axis along which they still touch may be in a part of D(t) that vanishes; a shorter step
    /// may find a path to an axis along which they are apart.
    fn part(&mut self, end: &PairPose, step: f64) -> Option<Side> {
        let before = (self.clearance, self.in_contact);
        let side = self.touch(end);
        if matches!(side, Some(Side::Contact(_))) && step > PARTING_STEP {
            (self.clearance, self.in_contact) = before;
            return None;
        }
        side
    }

    /// Stays strictly apart during the step to `end`, on an axis that is at rest or turns along with the triangles.
    fn glide(&mut self, direction: DVec3, end: &PairPose) -> Option<DVec3> {
        let (pose, limits) = (self.pose, self.limits);
        let step = MovingPair::new(pose, *end);
        if pose.shared == 2 {
            let is_open = step.hinge_stays_open(limits);
            return is_open.then(|| end.bisector().unwrap_or(direction));
        }
        let at_rest = step.least_gap_at_rest(direction, limits);
        // An axis with little room left is compared with turning axes, which may leave more.
        if at_rest > limits.tolerance {
            self.clearance = self.clearance.min(at_rest);
            return Some(direction);
        }
        let with_a = turned_along(direction, &pose.a, &end.a).unwrap_or(direction);
        let with_b = turned_along(direction, &pose.b, &end.b).unwrap_or(direction);
        let between = (with_a + with_b).normalize_or(with_a);
        let ends = [direction, between, with_a, with_b];
        let apart = self.best_of(&step, &[direction], &ends);
        if apart.is_some() {
            self.effort = self.effort.max(Effort::TurningAxis);
        }
        apart
    }

    /// Stays strictly apart during the step to `end`, from any axis that separates here to any that separates there.
    fn switch(&mut self, end: &PairPose) -> Option<DVec3> {
        self.effort = Effort::Search;
        let (pose, limits) = (self.pose, self.limits);
        let step = MovingPair::new(pose, *end);
        let here: Vec<_> = separating(&pose, limits).map(|(d, _)| d).collect();
        let there: Vec<_> = separating(end, limits).map(|(d, _)| d).collect();
        self.best_of(&step, &here, &there)
    }

    /// The end of the path that leaves the most room, if any leaves enough.
    fn best_of(&mut self, step: &MovingPair, here: &[DVec3], there: &[DVec3]) -> Option<DVec3> {
        let (mut best, mut room) = (None, self.limits.margin);
        for &d0 in here {
            for &d1 in there {
                let gap = step.least_gap(d0, d1, self.limits);
                if gap > room {
                    (best, room) = (Some(d1), gap);
                }
            }
        }
        if best.is_some() {
            self.clearance = self.clearance.min(room);
        }
        best
    }

    /// Stays within the tolerance during the step to `end`, from any axis reached here to any axis there.
    fn touch(&mut self, end: &PairPose) -> Option<Side> {
        self.effort = Effort::Search;
        let seeds = self.seeds().to_vec();
        let limits = self.limits;
        let within = limits.tolerance - limits.margin;
        let mut axes = end.axes_within(within, limits);
        let fresh = axes.len();
        let carried = seeds.iter().map(|&d| free_axis(end, d));
        axes.extend(carried.filter(|axis| axis.overlap <= within));
        let pose = self.pose;
        let step = MovingPair::new(pose, *end);
        let mut marked = vec![false; axes.len()];
        for i in 0..axes.len() {
            let to = axes[i].direction;
            if !marked[i] && seeds.iter().any(|&d| step.stays_within(d, to, limits)) {
                marked[i] = true;
                spread(&axes, &mut marked, limits);
            }
        }
        let reached: Vec<usize> = (0..axes.len()).filter(|&i| marked[i]).collect();
        if reached.is_empty() {
            return None;
        }
        self.in_contact = true;
        self.clearance = self.clearance.min(0.0);
        let is_apart = |&i: &usize| end.gap(axes[i].direction, limits) > limits.margin;
        if reached.iter().any(is_apart) {
            return widest(end, limits).map(Side::Apart);
        }
        // An axis carried over is kept only if no fresh axis of its part of D(t) was found.
        let is_covered = |i: usize| {
            let mut fresh_ones = reached.iter().filter(|&&j| j < fresh);
            i >= fresh && fresh_ones.any(|&j| are_linked(&axes[i], &axes[j], limits))
        };
        let kept = reached.iter().filter(|&&i| !is_covered(i));
        Some(Side::Contact(kept.map(|&i| axes[i].direction).collect()))
    }

    /// The axes that the path may be on now.
    fn seeds(&mut self) -> &[DVec3] {
        let (side, pose, limits) = (&self.side, &self.pose, self.limits);
        self.reached.get_or_insert_with(|| match side {
            Side::Contact(axes) => axes.clone(),
            Side::Apart(direction) => reached_from_apart(*direction, pose, limits),
        })
    }

    /// Called when no step succeeds: searches for an instant that proves a crossing.
    fn examine(&mut self, step: f64) -> Outcome {
        let seeds = self.seeds().to_vec();
        let too_deep = self.limits.tolerance + self.limits.margin;
        let mut found = None;
        let (mut reach, mut depth) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        let mut after = step;
        loop {
            let instant = (self.time + after).min(1.0);
            let pose = self.pair.at(instant);
            let deepest = pose.depth();
            let from_side = overlap_from_side(&pose, &seeds, self.limits);
            reach = reach.max(from_side.overlap);
            depth = depth.max(deepest.overlap);
            let witness = [deepest, from_side].into_iter().find(|axis| axis.overlap > too_deep);
            found = found.or(witness.map(|axis| (instant, axis)));
            if instant >= 1.0 {
                break;
            }
            after *= 2.0;
        }
        let Some((confirmed, axis)) = found else {
            return Outcome::Undecided { time: self.time };
        };
        Outcome::Crossed(PairCrossing {
            contact: self.contact_start(),
            passed: self.time,
            confirmed,
            axis,
            reach,
            depth,
        })
    }

    /// The time at which the present contact began, by bisection of the step in which the triangles met.
    fn contact_start(&self) -> f64 {
        let Some((mut apart, direction)) = self.last_apart else {
            return 0.0;
        };
        // They met in a step that could not be certified at all, or in the one that ended in contact.
        let mut contact = match self.side {
            Side::Apart(_) => self.time,
            Side::Contact(_) => self.first_contact,
        };
        // Triangles that are apart along some direction are on the side of every direction along which they are apart.
        let last = self.pair.at(apart);
        let before = separating(&last, self.limits).map(|(d, _)| d);
        let before: Vec<DVec3> = before.chain([direction]).collect();
        for _ in 0..40 {
            let middle = f64::midpoint(apart, contact);
            let pose = self.pair.at(middle);
            let is_before = |d: DVec3| before.iter().any(|b| b.dot(d) > 0.5);
            if separating(&pose, self.limits).any(|(d, _)| is_before(d)) {
                apart = middle;
            } else {
                contact = middle;
            }
        }
        contact
    }
}

/// The axes that can be reached from a separating one without changing sides.
fn reached_from_apart(direction: DVec3, pose: &PairPose, limits: &Limits) -> Vec<DVec3> {
    let within = limits.tolerance - limits.margin;
    let mut axes = pose.axes_within(within, limits);
    let held = free_axis(pose, direction);
    if held.overlap <= within {
        axes.push(held);
    }
    let is_apart = |axis: &Axis| pose.gap(axis.direction, limits) > limits.margin;
    let mut marked: Vec<_> = axes.iter().map(is_apart).collect();
    if !marked.contains(&true) && held.overlap <= within {
        // A crease folded to within rounding of ±180°: its side is known, but no axis separates by the margin.
        marked[axes.len() - 1] = true;
    }
    spread(&axes, &mut marked, limits);
    let reached = axes.iter().zip(marked).filter(|&(_, is_marked)| is_marked);
    reached.map(|(axis, _)| axis.direction).collect()
}

/// The smallest overlap among the axes within 60° of those the pair was followed on.
fn overlap_from_side(pose: &PairPose, seeds: &[DVec3], limits: &Limits) -> Axis {
    let is_near = |axis: &Axis| seeds.iter().any(|d| d.dot(axis.direction) > 0.5);
    let all = pose.axes_within(f64::INFINITY, limits);
    let carried = seeds.iter().map(|&d| free_axis(pose, d));
    all.into_iter()
        .filter(is_near)
        .chain(carried)
        .reduce(|least, next| if next.overlap < least.overlap { next } else { least })
        .unwrap_or_else(|| pose.depth())
}
