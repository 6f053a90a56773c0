//! The closest approach of two moving triangles, between two bounds.

use std::{cmp::Ordering, collections::BinaryHeap};

use super::{Limits, MovingPair, PairPose, clearest::Clearest};
use crate::distance::{Closest, triangle_triangle};

/// Time intervals shorter than this are not divided further.
const SHORTEST_STRETCH: f64 = 1.0 / (1u64 << 46) as f64;

/// An instant of closest approach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Approach {
    /// The time t in [0, 1] of the approach.
    pub time: f64,
    /// The distance and the points at which it is attained.
    pub closest: Closest,
}

/// Bounds of the smallest distance, as far as it is below a limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ApproachBounds {
    /// The nearest instant found, an upper bound of the smallest distance; `None` if none is nearer than the limit.
    pub nearest: Option<Approach>,
    /// A lower bound of the distance over all t in [0, 1]: at least 0, at most the limit.
    pub at_least: f64,
    /// Whether the two bounds are as close to each other as [`accuracy`] requires.
    pub is_complete: bool,
}

/// The accuracy to which the bounds of a distance are computed: the largest of τ / 100, a ten thousandth of the
/// distance, and four margins of rounding.
pub fn accuracy(distance: f64, limits: &Limits) -> f64 {
    let share = (0.01 * limits.tolerance).max(1e-4 * distance);
    share.max(4.0 * limits.margin)
}

/// The lower bound of the distance from which on a search below `bound` is unnecessary, according to [`accuracy`].
pub fn enough_clearance(bound: f64, limits: &Limits) -> f64 {
    if bound == f64::INFINITY {
        return bound;
    }
    bound - accuracy(bound, limits)
}

/// The closest approach over t in [0, 1], as far as it is nearer than `bound`.
///
/// Branch and bound over time; the interval with the smallest lower bound comes first. At an instant, the distance is
/// bounded from above by closest points and from below by the gap along a direction; over an interval, by the gap along
/// the directions of its two ends, at rest and turning from one to the other.
///
/// Precondition: the triangles share no corner.
pub fn closest_approach(pair: &MovingPair, bound: f64, limits: &Limits) -> ApproachBounds {
    Search { pair, limits, bound, nearest: None, instants: Vec::new(), open: BinaryHeap::new() }
        .run()
}

/// The triangles at an instant.
#[derive(Debug)]
struct Instant {
    time: f64,
    pose: PairPose,
    /// The clearest direction; `None` if the triangles intersect.
    clearest: Option<Clearest>,
}

/// The time between two instants, given by their indices, and a lower bound of the distance over it.
#[derive(Debug)]
struct Stretch {
    at_least: f64,
    ends: [usize; 2],
}

impl Ord for Stretch {
    /// The interval with the smallest bound is the greatest; of equal ones, the one found first.
    fn cmp(&self, other: &Self) -> Ordering {
        let by_bound = other.at_least.total_cmp(&self.at_least);
        by_bound.then(other.ends.cmp(&self.ends))
    }
}

impl PartialOrd for Stretch {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Stretch {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Stretch {}

struct Search<'a> {
    pair: &'a MovingPair,
    limits: &'a Limits,
    /// The distance of `nearest`, or the limit of the search.
    bound: f64,
    nearest: Option<Approach>,
    instants: Vec<Instant>,
    open: BinaryHeap<Stretch>,
}

impl Search<'_> {
    fn run(mut self) -> ApproachBounds {
        let ends = [self.measure(0.0), self.measure(1.0)];
        self.add(ends, 0.0);
        for _ in 0..self.limits.budget {
            if !self.divide() {
                break;
            }
        }
        let open = self.open.peek().map_or(0.0, |stretch| stretch.at_least);
        let at_least = open.min(self.bound - self.limits.margin).max(0.0);
        ApproachBounds { nearest: self.nearest, at_least, is_complete: self.is_enough(at_least) }
    }

    fn is_enough(&self, at_least: f64) -> bool {
        at_least >= enough_clearance(self.bound, self.limits)
    }

    /// Halves the interval with the smallest bound; false if there is nothing left to do.
    fn divide(&mut self) -> bool {
        let Some(stretch) = self.open.pop() else {
            return false;
        };
        let [from, to] = stretch.ends;
        let times = [self.instants[from].time, self.instants[to].time];
        if self.is_enough(stretch.at_least) || times[1] - times[0] <= SHORTEST_STRETCH {
            self.open.push(stretch);
            return false;
        }
        let middle = self.measure(f64::midpoint(times[0], times[1]));
        self.add([from, middle], stretch.at_least);
        self.add([middle, to], stretch.at_least);
        true
    }

    fn measure(&mut self, time: f64) -> usize {
        let pose = self.pair.at(time);
        let closest = triangle_triangle(&pose.a, &pose.b);
        if closest.distance < self.bound {
            self.bound = closest.distance;
            self.nearest = Some(Approach { time, closest });
        }
        let slack = 0.1 * accuracy(closest.distance, self.limits);
        let clearest = Clearest::of(&pose, &closest, slack, self.limits);
        self.instants.push(Instant { time, pose, clearest });
        self.instants.len() - 1
    }

    /// `known`: a lower bound over a longer interval.
    fn add(&mut self, ends: [usize; 2], known: f64) {
        let [from, to] = ends.map(|i| &self.instants[i]);
        let at_least = least_distance(from, to, self.limits).max(known);
        self.open.push(Stretch { at_least, ends });
    }
}

/// A lower bound of the distance between two instants; 0 or less if there is none.
fn least_distance(from: &Instant, to: &Instant, limits: &Limits) -> f64 {
    let pair = MovingPair::new(from.pose, to.pose);
    let gap_of = |d| pair.least_gap_at_rest(d, limits);
    let gap = match (from.clearest, to.clearest) {
        (Some(first), Some(last)) => {
            let first_gaps = [first.gap, to.pose.gap(first.direction, limits)];
            let last_gaps = [from.pose.gap(last.direction, limits), last.gap];
            let turning = pair.least_gap(first.direction, last.direction, limits);
            least_of_greater(first_gaps, last_gaps).max(turning)
        }
        (Some(one), None) | (None, Some(one)) => gap_of(one.direction),
        (None, None) => return 0.0,
    };
    gap - limits.margin
}

/// The minimum over s in [0, 1] of the larger of two linear functions, given their values at 0 and 1.
///
/// The gap along a direction at rest is concave in time, so it is at least linear between its ends. The larger of two
/// linear functions is convex, and has its minimum at an end or where they are equal.
fn least_of_greater(p: [f64; 2], q: [f64; 2]) -> f64 {
    let least = p[0].max(q[0]).min(p[1].max(q[1]));
    let (before, after) = (p[0] - q[0], p[1] - q[1]);
    if (before > 0.0) == (after > 0.0) || before == after {
        return least;
    }
    let s = before / (before - after);
    least.min(p[0] + (p[1] - p[0]) * s)
}

#[cfg(test)]
mod tests {
    use super::*;
    use foldmotion_random::Random;

    #[test]
    fn the_least_of_the_greater_of_two_lines_is_met_by_sampling() {
        let mut random = Random::new(46);
        for _ in 0..200 {
            let [p, q] = [(); 2].map(|()| [random.number(), random.number()]);
            let at = |l: [f64; 2], s: f64| l[0] + (l[1] - l[0]) * s;
            let samples = (0..=1000).map(|k| f64::from(k) / 1000.0);
            let least = samples.map(|s| at(p, s).max(at(q, s))).fold(f64::INFINITY, f64::min);
            let found = least_of_greater(p, q);
            assert!(found <= least + 1e-15 && found >= least - 4e-3, "{found} {least}");
        }
    }
}
