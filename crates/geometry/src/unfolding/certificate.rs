//! A proof that a chain whose turns change does not cross itself, or the point at which it does.
//!
//! During a sweep every turn changes linearly from one value to another. Seen from the middle of the chain between
//! them, segments i < j approach each other no faster than V = Σ |dτ_k| · lever, over the joints k between them, where
//! the lever is at most the shorter distance along the chain from the joint to the far end of either segment. So a
//! distance d at the middle of an interval of width w keeps the two apart throughout if d > V w / 2; otherwise the
//! interval is halved. Neighbours meet only if their turn reaches ±π, which the ends of the sweep exclude for all of
//! it.

use std::f64::consts::PI;

use glam::DVec2;

use super::chain::{Chain, segment_distance, sums};
use super::seam::seam_opens_until;

/// Intervals of a sweep shorter than this are not divided.
const SHORTEST: f64 = 1e-10;
/// How far ahead an intersection is searched for once two segments cannot be told apart.
const LOOK_AHEAD: f64 = 1e-5;
/// The largest number of distances computed for one certificate.
const BUDGET: u64 = 200_000_000;

/// What is known about a sweep; fractions run from 0 at its start to 1 at its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SweepVerdict {
    /// It is proved that no two segments meet, other than neighbours at their joints and the ends of a closed chain at
    /// its start.
    Clear,
    /// Two segments meet at this fraction (to 1e-10); up to 1e-5 before it, the chain is proved to be clear.
    Crosses {
        /// The fraction of the sweep at which they meet.
        fraction: f64,
        /// The indices of the segments, from 0, in increasing order.
        segments: [usize; 2],
    },
    /// The chain is proved to be clear up to this fraction; there two segments come so close that neither answer can be
    /// given, or the budget of distances was exhausted.
    Undecided {
        /// The fraction of the sweep up to which it is proved.
        fraction: f64,
        /// The indices of the segments, from 0, in increasing order.
        segments: [usize; 2],
    },
}

/// Whether `chain` crosses itself while its turns change linearly from `from` to `to`.
///
/// Rounding is bounded, not ignored: distances count if they exceed n² ε (1 + the largest heading) mean segments. Ends
/// of a closed chain that coincide at the start must separate for the verdict to be clear.
///
/// Precondition: both have n − 1 turns within (−π, π), and the chain does not cross itself at `from`.
pub fn certify(chain: &Chain, from: &[f64], to: &[f64]) -> SweepVerdict {
    Sweep::new(chain, from, to).run(0.0, BUDGET)
}

/// A sweep, with bounds of the speed at which its segments approach each other.
pub(super) struct Sweep<'a> {
    chain: &'a Chain,
    from: &'a [f64],
    /// The change of each turn over the sweep, in radians.
    change: Vec<f64>,
    /// The cumulative sums of |change| and of |change| · arc over the joints.
    turned: Vec<f64>,
    moments: Vec<f64>,
    rounding: f64,
    /// The fraction up to which the ends of a closed chain are known to separate.
    seam_until: f64,
}

impl<'a> Sweep<'a> {
    pub(super) fn new(chain: &'a Chain, from: &'a [f64], to: &[f64]) -> Self {
        let change: Vec<f64> = from.iter().zip(to).map(|(a, b)| b - a).collect();
        let turned: Vec<f64> = change.iter().map(|c| c.abs()).collect();
        let joints = &chain.arcs[1..];
        let moments: Vec<f64> = turned.iter().zip(joints).map(|(c, s)| c * s).collect();
        let rounding = chain.rounding(from).max(chain.rounding(to));
        let seam_until =
            if chain.is_closed() { seam_opens_until(chain, from, &change, rounding) } else { 0.0 };
        Self {
            chain,
            from,
            turned: sums(&turned),
            moments: sums(&moments),
            change,
            rounding,
            seam_until,
        }
    }

    /// Whether all segments that are not neighbours stay farther apart than `clearance`, within `budget` distances.
    pub(super) fn run(&self, clearance: f64, budget: u64) -> SweepVerdict {
        if let Some(joint) = self.folded_back() {
            return SweepVerdict::Undecided { fraction: 0.0, segments: [joint, joint + 1] };
        }
        let count = self.chain.segment_count();
        let all = (0..count).flat_map(|i| (i + 2..count).map(move |j| [i, j]));
        let mut pending = vec![(0.0, 1.0, all.collect::<Vec<_>>())];
        let mut spent = 0;
        // Earlier halves come first, so that the interval taken next follows everything that is proved.
        while let Some((start, end, pairs)) = pending.pop() {
            let middle = 0.5 * (start + end);
            let points = self.points(middle);
            spent += pairs.len() as u64;
            let is_open = |pair: &[usize; 2]| {
                let reach = clearance + self.rounding + 0.5 * (end - start) * self.approach(*pair);
                !self.is_parting_seam(*pair, end) && is_within(&points, *pair, reach)
            };
            let open: Vec<[usize; 2]> = pairs.into_iter().filter(is_open).collect();
            let Some(&segments) = open.first() else {
                continue;
            };
            if end - start < SHORTEST || spent > budget {
                return self.meeting_after(start, segments);
            }
            pending.push((middle, end, open.clone()));
            pending.push((start, middle, open));
        }
        SweepVerdict::Clear
    }

    /// Whether `segments`, which come close at `start`, meet shortly after it.
    fn meeting_after(&self, start: f64, segments: [usize; 2]) -> SweepVerdict {
        let meets = |fraction: f64| is_within(&self.points(fraction), segments, 0.0);
        let mut ahead = SHORTEST;
        while ahead < LOOK_AHEAD && !meets((start + ahead).min(1.0)) {
            ahead *= 2.0;
        }
        let mut met = (start + ahead).min(1.0);
        if !meets(met) {
            return SweepVerdict::Undecided { fraction: start, segments };
        }
        let mut apart = start;
        while met - apart > SHORTEST {
            let middle = 0.5 * (apart + met);
            if meets(middle) {
                met = middle;
            } else {
                apart = middle;
            }
        }
        SweepVerdict::Crosses { fraction: met, segments }
    }

    /// A joint that is folded back at an end of the sweep; `None` if there is none.
    fn folded_back(&self) -> Option<usize> {
        let ends = self.from.iter().zip(&self.change);
        ends.into_iter()
            .position(|(&from, &change)| from.abs() >= PI || (from + change).abs() >= PI)
    }

    fn points(&self, fraction: f64) -> Vec<DVec2> {
        let turns: Vec<f64> = self
            .from
            .iter()
            .zip(&self.change)
            .map(|(from, change)| from + change * fraction)
            .collect();
        self.chain.points(&turns)
    }

    fn is_parting_seam(&self, pair: [usize; 2], end: f64) -> bool {
        pair == [0, self.chain.segment_count() - 1] && end <= self.seam_until
    }

    /// V of a pair: a bound of the speed at which it approaches, per unit of the sweep.
    pub(super) fn approach(&self, [i, j]: [usize; 2]) -> f64 {
        let arcs = &self.chain.arcs;
        let (start, end) = (arcs[i], arcs[j + 1]);
        // Joint k, at arcs[k], has index k − 1 among the turns; joints i + 1 … j lie between the two segments. Those in
        // the first half turn the first segment, the others the second.
        let half = arcs[i + 1..=j].partition_point(|&arc| arc - start < end - arc) + i;
        let turned = |from: usize, to: usize| self.turned[to] - self.turned[from];
        let moment = |from: usize, to: usize| self.moments[to] - self.moments[from];
        let first = moment(i, half) - start * turned(i, half);
        let second = end * turned(half, j) - moment(half, j);
        // The differences of sums may be off by their rounding.
        first + second + 1e-13 * self.moments[self.moments.len() - 1]
    }
}

/// Whether the distance of two segments is at most `reach`.
fn is_within(points: &[DVec2], [i, j]: [usize; 2], reach: f64) -> bool {
    let (a, b) = ([points[i], points[i + 1]], [points[j], points[j + 1]]);
    let apart = (a[0] + a[1]).distance(b[0] + b[1]);
    let halves = a[0].distance(a[1]) + b[0].distance(b[1]);
    apart - halves <= 2.0 * reach && segment_distance(a, b) <= reach
}
