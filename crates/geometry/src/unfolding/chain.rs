//! A planar chain, described by its lengths and turns.

use std::f64::consts::PI;

use glam::DVec2;

use crate::{GeometryError, first_crossing};

/// The largest number of segments: work and memory grow with its square.
const MOST_SEGMENTS: usize = 2000;

/// A planar polyline of n segments of fixed length, free of crossings, whose n − 1 turns can be changed.
///
/// Lengths are in units of the mean segment, so that nothing depends on the size of the input. The ends of a closed
/// chain coincide at the start, at the seam, where it may open.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// The segment lengths, relative to their mean.
    pub(super) lengths: Vec<f64>,
    /// The arc length of each point along the chain; one more than there are segments.
    pub(super) arcs: Vec<f64>,
    turns: Vec<f64>,
    is_closed: bool,
}

impl Chain {
    /// The chain through `points` ((x, z), any unit, finite). The last point of a `closed` chain equals its first.
    ///
    /// # Errors
    /// [`GeometryError::SegmentCount`] for no segment or more than 2000, [`GeometryError::RepeatedPoint`] for a segment
    /// without length, [`GeometryError::PolygonCrosses`] if the chain crosses or touches itself elsewhere than at its
    /// seam.
    pub fn new(points: &[DVec2], is_closed: bool) -> Result<Self, GeometryError> {
        let count = points.len().saturating_sub(1);
        let minimum = if is_closed { 3 } else { 1 };
        if !(minimum..=MOST_SEGMENTS).contains(&count) {
            return Err(GeometryError::SegmentCount { count, minimum, maximum: MOST_SEGMENTS });
        }
        let segments: Vec<DVec2> = points.windows(2).map(|p| p[1] - p[0]).collect();
        if let Some(index) = segments.iter().position(|s| s.length() == 0.0) {
            let DVec2 { x, y: z } = points[index];
            return Err(GeometryError::RepeatedPoint { index, x, z });
        }
        if let Some(crossing) = first_crossing(points, is_closed) {
            return Err(GeometryError::PolygonCrosses {
                segments: crossing.segments,
                point: crossing.point,
            });
        }
        let mean = segments.iter().map(|s| s.length()).sum::<f64>() / count as f64;
        let lengths: Vec<f64> = segments.iter().map(|s| s.length() / mean).collect();
        let turn = |pair: &[DVec2]| pair[0].perp_dot(pair[1]).atan2(pair[0].dot(pair[1]));
        Ok(Self {
            arcs: sums(&lengths),
            lengths,
            turns: segments.windows(2).map(turn).collect(),
            is_closed,
        })
    }

    /// The number n of segments.
    pub fn segment_count(&self) -> usize {
        self.lengths.len()
    }

    /// The n − 1 turns with which it starts, in (−π, π), positive counter-clockwise.
    pub fn turns(&self) -> &[f64] {
        &self.turns
    }

    /// Whether its ends coincide at the start.
    pub fn is_closed(&self) -> bool {
        self.is_closed
    }

    /// The n + 1 points of the chain with the given n − 1 turns, in units of the mean segment: the first at the origin,
    /// the first segment along +x.
    pub fn points(&self, turns: &[f64]) -> Vec<DVec2> {
        let mut point = DVec2::ZERO;
        let mut points = vec![point];
        for (heading, length) in sums(turns).into_iter().zip(&self.lengths) {
            point += DVec2::from_angle(heading) * *length;
            points.push(point);
        }
        points
    }

    /// A bound of the rounding error of a distance between [`Self::points`]: each heading is a sum of n turns, each
    /// point a sum of n segments.
    pub(super) fn rounding(&self, turns: &[f64]) -> f64 {
        let count = self.segment_count() as f64;
        let largest = sums(turns).into_iter().fold(0.0, |a: f64, h| a.max(h.abs()));
        f64::EPSILON * count * count * (1.0 + largest)
    }

    /// Whether the headings lie within less than a half turn (by 1 %): scaling the turns then straightens the chain
    /// without a crossing.
    pub(super) fn is_monotone(turns: &[f64]) -> bool {
        let headings = sums(turns);
        let lowest = headings.iter().copied().fold(f64::INFINITY, f64::min);
        let highest = headings.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        highest - lowest < 0.99 * PI
    }
}

/// The cumulative sums of the values, starting with 0.
pub(super) fn sums(values: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let running = values.iter().map(|value| {
        sum += value;
        sum
    });
    std::iter::once(0.0).chain(running).collect()
}

/// The distance of two segments in the plane; 0 if they share a point.
pub(super) fn segment_distance(a: [DVec2; 2], b: [DVec2; 2]) -> f64 {
    let side = |[p, q]: [DVec2; 2], x: DVec2| (q - p).perp_dot(x - p);
    let [a0, a1] = [side(b, a[0]), side(b, a[1])];
    let [b0, b1] = [side(a, b[0]), side(a, b[1])];
    if a0 * a1 < 0.0 && b0 * b1 < 0.0 {
        return 0.0;
    }
    let ends = [
        squared_distance_to(b, a[0]),
        squared_distance_to(b, a[1]),
        squared_distance_to(a, b[0]),
        squared_distance_to(a, b[1]),
    ];
    ends.into_iter().fold(f64::INFINITY, f64::min).sqrt()
}

fn squared_distance_to([p, q]: [DVec2; 2], point: DVec2) -> f64 {
    let along = q - p;
    let share = (point - p).dot(along) / along.length_squared();
    (point - p - along * share.clamp(0.0, 1.0)).length_squared()
}
