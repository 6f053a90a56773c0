//! The method of Douglas and Peucker on a profile.
//!
//! Of all segments, the one from which the curve between its ends deviates most is split at the farthest point. In this
//! order, the splits of the paper's second method (Douglas and Peucker 1973) give any number of segments, and stopping
//! below a tolerance gives the polygon that its recursion gives.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use glam::DVec2;

use crate::{GeometryError, Profile};

/// The smallest number of samples of the curve for each segment, and altogether.
const SAMPLES_PER_SEGMENT: usize = 64;
const FEWEST_SAMPLES: usize = 4096;
const MOST_SAMPLES: usize = 4_000_000;

/// The parameters of the segments, from 0 to 1. Splits until there are `segments`, or the curve is within `tolerance`
/// (a length) of them.
///
/// # Errors
/// Without a tolerance: nothing is left to split before there are enough segments.
pub(crate) fn split(
    profile: &Profile,
    segments: usize,
    tolerance: f64,
) -> Result<Vec<f64>, GeometryError> {
    let wanted = segments.saturating_mul(SAMPLES_PER_SEGMENT);
    let count = if tolerance > 0.0 {
        profile.curve().breakpoints().len() * SAMPLES_PER_SEGMENT
    } else {
        wanted
    }
    .clamp(FEWEST_SAMPLES, MOST_SAMPLES);
    let points: Vec<_> = (0..=count).map(|k| profile.position(k as f64 / count as f64)).collect();
    let mut kept = vec![0, count];
    let mut pending: BinaryHeap<_> = farthest(&points, 0, count).into_iter().collect();
    // A deviation below rounding counts as none.
    let least = tolerance.max(16.0 * f64::EPSILON * profile.magnitude());
    while kept.len() <= segments {
        match pending.pop() {
            Some(worst) if worst.distance > least => {
                kept.push(worst.at);
                pending.extend(farthest(&points, worst.ends[0], worst.at));
                pending.extend(farthest(&points, worst.at, worst.ends[1]));
            }
            _ if tolerance > 0.0 => break,
            _ => {
                return Err(GeometryError::NothingToSplit {
                    count: segments,
                    possible: kept.len() - 1,
                });
            }
        }
    }
    kept.sort_unstable();
    Ok(kept.iter().map(|&k| k as f64 / count as f64).collect())
}

/// A segment and the sample between its ends that is farthest from it.
struct Farthest {
    distance: f64,
    ends: [usize; 2],
    at: usize,
}

fn farthest(points: &[DVec2], start: usize, end: usize) -> Option<Farthest> {
    let mut worst: Option<Farthest> = None;
    for at in start + 1..end {
        let distance = distance_to_segment(points[at], points[start], points[end]);
        if worst.as_ref().is_none_or(|w| distance > w.distance) {
            worst = Some(Farthest { distance, ends: [start, end], at });
        }
    }
    worst
}

/// The distance of p from the segment a b, which may be a point.
pub(crate) fn distance_to_segment(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let squared = (b - a).length_squared();
    let share = if squared > 0.0 { ((p - a).dot(b - a) / squared).clamp(0.0, 1.0) } else { 0.0 };
    p.distance(a + share * (b - a))
}

/// Ordered by distance; of equal ones, the first along the curve is the greatest.
impl Ord for Farthest {
    fn cmp(&self, other: &Self) -> Ordering {
        (self.distance.total_cmp(&other.distance)).then(other.at.cmp(&self.at))
    }
}

impl PartialOrd for Farthest {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Farthest {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Farthest {}
