//! The times at which two moving features are within a distance of each other.

use glam::DVec3;

use super::{Limits, MovingPair, PairPose};
use crate::distance::{Closest, point_triangle, segment_segment, triangle_triangle};

/// Time intervals in which the features move by less than this share of the distance are judged by their ends.
const RESOLUTION: f64 = 1.0 / 64.0;
/// Time intervals shorter than this are not divided.
const SHORTEST: f64 = 1.0 / (1u64 << 44) as f64;
/// If closest points are nearer to each other than this share of the features' size, they do not determine a direction:
/// it is off by the rounding of the size over their distance, which shifts the ends of the features by more than the
/// distance.
const NO_DIRECTION: f64 = 1e-6;
/// Spans at a smaller angle than this count as parallel.
const PARALLEL: f64 = 1e-12;
/// The largest number of time intervals examined.
const BUDGET: u32 = 1 << 16;

/// The time intervals in which two features are within `distance` of each other, in order; they share no end.
///
/// A feature is a triangle with moving corners; an edge is one with two equal corners, a vertex one with three. In each
/// interval the features are within 65/64 of the distance throughout; outside, they are farther than 63/64 of it,
/// except for approaches shorter than 2⁻⁴⁴: features that are not shown to be near count as far apart. `None` if the
/// budget was exhausted.
pub fn contact_times(pair: &MovingPair, distance: f64, limits: &Limits) -> Option<Vec<[f64; 2]>> {
    if corners_stay_within(pair, distance) {
        return Some(vec![[0.0, 1.0]]);
    }
    let moved = greatest_motion(pair);
    let mut near: Vec<[f64; 2]> = Vec::new();
    let mut keep = |from: f64, to: f64| match near.last_mut() {
        Some(last) if last[1] == from => last[1] = to,
        _ => near.push([from, to]),
    };
    let mut open = vec![(Instant::new(pair, 0.0), Instant::new(pair, 1.0))];
    for _ in 0..BUDGET {
        let Some((from, to)) = open.pop() else {
            return Some(near);
        };
        if stays_within(&from, &to, distance) {
            keep(from.time, to.time);
            continue;
        }
        if stays_farther(&from, &to, distance, limits) {
            continue;
        }
        let length = to.time - from.time;
        if length * moved <= RESOLUTION * distance || length <= SHORTEST {
            if from.closest.distance.min(to.closest.distance) <= distance {
                keep(from.time, to.time);
            }
            continue;
        }
        let middle = Instant::new(pair, f64::midpoint(from.time, to.time));
        open.push((middle, to));
        open.push((from, middle));
    }
    None
}

/// Whether two features come within `distance` of each other; see [`contact_times`].
pub fn comes_within(pair: &MovingPair, distance: f64, limits: &Limits) -> bool {
    if corners_are_within(&pair.start, distance) || corners_are_within(&pair.end, distance) {
        return true;
    }
    let is_near = |instant: &Instant| instant.closest.distance <= distance;
    let ends = (Instant::new(pair, 0.0), Instant::new(pair, 1.0));
    if is_near(&ends.0) || is_near(&ends.1) {
        return true;
    }
    let moved = greatest_motion(pair);
    let mut open = vec![ends];
    for _ in 0..BUDGET {
        let Some((from, to)) = open.pop() else {
            return false;
        };
        let length = to.time - from.time;
        let is_short = length * moved <= RESOLUTION * distance || length <= SHORTEST;
        if is_short || stays_farther(&from, &to, distance, limits) {
            continue;
        }
        let middle = Instant::new(pair, f64::midpoint(from.time, to.time));
        if is_near(&middle) {
            return true;
        }
        open.push((middle, to));
        open.push((from, middle));
    }
    true
}

/// The distance of two features at an instant.
pub fn feature_distance(pose: &PairPose) -> f64 {
    closest(pose).distance
}

/// Whether a corner of one feature is within `distance` of a corner of the other, as in layers with coincident corners.
pub fn corners_are_within(pose: &PairPose, distance: f64) -> bool {
    let squared = distance * distance;
    let is_near = |p: &DVec3, q: &DVec3| p.distance_squared(*q) <= squared;
    pose.a.iter().any(|p| pose.b.iter().any(|q| is_near(p, q)))
}

/// Whether two corners are within `distance` of each other at both ends. As they move straight, they then are
/// throughout.
fn corners_stay_within(pair: &MovingPair, distance: f64) -> bool {
    let squared = distance * distance;
    let (start, end) = (&pair.start, &pair.end);
    let is_near = |i: usize, j: usize| {
        start.a[i].distance_squared(start.b[j]) <= squared
            && end.a[i].distance_squared(end.b[j]) <= squared
    };
    (0..3).any(|i| (0..3).any(|j| is_near(i, j)))
}

/// The largest displacement of a corner of one triangle relative to a corner of the other.
fn greatest_motion(pair: &MovingPair) -> f64 {
    let moved = |start: &[DVec3; 3], end: &[DVec3; 3]| [0, 1, 2].map(|i| end[i] - start[i]);
    let a = moved(&pair.start.a, &pair.end.a);
    let b = moved(&pair.start.b, &pair.end.b);
    let displacements = a.iter().flat_map(|u| b.iter().map(|v| u.distance(*v)));
    displacements.fold(0.0, f64::max)
}

/// The closest points, by the kinds of the features.
fn closest(pose: &PairPose) -> Closest {
    let (a, b) = (&pose.a, &pose.b);
    let is_segment = |t: &[DVec3; 3]| t[1] == t[2];
    match (is_segment(a), is_segment(b)) {
        (true, true) => segment_segment([a[0], a[1]], [b[0], b[1]]),
        (true, false) if a[0] == a[1] => point_triangle(a[0], b),
        (false, true) if b[0] == b[1] => {
            let Closest { distance, on_a, on_b } = point_triangle(b[0], a);
            Closest { distance, on_a: on_b, on_b: on_a }
        }
        _ => triangle_triangle(a, b),
    }
}

#[derive(Clone, Copy)]
struct Instant {
    time: f64,
    pose: PairPose,
    closest: Closest,
}

impl Instant {
    fn new(pair: &MovingPair, time: f64) -> Self {
        let pose = pair.at(time);
        Self { time, closest: closest(&pose), pose }
    }

    /// The direction along which the features are farthest apart, approximately.
    fn direction(&self) -> Option<DVec3> {
        let between = (self.closest.on_b - self.closest.on_a).try_normalize()?;
        let (a, b) = (&self.pose.a, &self.pose.b);
        let spans = [a[1] - a[0], a[2] - a[0], b[1] - b[0], b[2] - b[0]];
        let size = spans.iter().map(|s| s.length_squared()).fold(0.0, f64::max);
        if self.closest.distance * self.closest.distance > NO_DIRECTION * NO_DIRECTION * size {
            return Some(between);
        }
        let apart = |d: &DVec3| {
            let heights = |corners: &[DVec3; 3]| corners.map(|p| d.dot(p - a[0]));
            let ([p, q, r], [u, v, w]) = (heights(a), heights(b));
            u.min(v).min(w) - p.max(q).max(r)
        };
        let at_right_angles = normal_to(spans, between);
        let all = [Some(between), at_right_angles].into_iter().flatten();
        all.max_by(|d, e| apart(d).total_cmp(&apart(e)))
    }

    /// The barycentric coordinates of the closest points.
    fn shares(&self) -> [[f64; 3]; 2] {
        [shares(self.closest.on_a, &self.pose.a), shares(self.closest.on_b, &self.pose.b)]
    }
}

/// The direction nearest to another one that is perpendicular to the spans of the features: a normal to two spans, or
/// the component of the other direction perpendicular to one.
fn normal_to(spans: [DVec3; 4], nearest: DVec3) -> Option<DVec3> {
    let by_length = |s: &DVec3, t: &DVec3| s.length_squared().total_cmp(&t.length_squared());
    let longest = spans.into_iter().max_by(by_length)?;
    let along = longest.try_normalize()?;
    let normal = spans.map(|s| along.cross(s)).into_iter().max_by(by_length)?;
    if normal.length() <= PARALLEL * longest.length() {
        return (nearest - along * along.dot(nearest)).try_normalize();
    }
    let normal = normal.normalize();
    Some(if normal.dot(nearest) < 0.0 { -normal } else { normal })
}

/// Whether a direction shows that the features are farther apart than `distance` throughout.
fn stays_farther(from: &Instant, to: &Instant, distance: f64, limits: &Limits) -> bool {
    if from.closest.distance.min(to.closest.distance) <= distance {
        return false;
    }
    let (Some(d0), Some(d1)) = (from.direction(), to.direction()) else {
        return false;
    };
    let pair = MovingPair::new(from.pose, to.pose);
    let farther = distance + limits.margin;
    pair.least_gap_at_rest(d0, limits) > farther
        || pair.least_gap_at_rest(d1, limits) > farther
        || pair.least_gap(d0, d1, limits) > farther
}

/// Whether two points, one on each feature, whose barycentric coordinates change linearly are within `distance`
/// throughout.
///
/// Their difference is a quadratic in time that stays in the hull of its Bernstein coefficients.
fn stays_within(from: &Instant, to: &Instant, distance: f64) -> bool {
    if from.closest.distance.max(to.closest.distance) > distance {
        return false;
    }
    let ([a0, b0], [a1, b1]) = (from.shares(), to.shares());
    let at = |shares: &[f64; 3], corners: &[DVec3; 3]| {
        corners[0] * shares[0] + corners[1] * shares[1] + corners[2] * shares[2]
    };
    let (p, q) = (&from.pose, &to.pose);
    let middle = (at(&a0, &q.a) + at(&a1, &p.a) - at(&b0, &q.b) - at(&b1, &p.b)) * 0.5;
    middle.length() <= distance
}

/// Barycentric coordinates of a point of a triangle, approximately.
fn shares(point: DVec3, corners: &[DVec3; 3]) -> [f64; 3] {
    let [p, q, r] = *corners;
    let (u, v, w) = (q - p, r - p, point - p);
    let n = u.cross(v);
    let squared = n.length_squared();
    if squared > 0.0 {
        let y = w.cross(v).dot(n) / squared;
        let z = u.cross(w).dot(n) / squared;
        return clamped([1.0 - y - z, y, z]);
    }
    let far = if u.length_squared() >= v.length_squared() { 1 } else { 2 };
    let along = corners[far] - p;
    let squared = along.length_squared();
    let share = if squared > 0.0 { w.dot(along) / squared } else { 0.0 };
    let mut shares = [1.0 - share, 0.0, 0.0];
    shares[far] = share;
    clamped(shares)
}

fn clamped(shares: [f64; 3]) -> [f64; 3] {
    let inside = shares.map(|s| s.clamp(0.0, 1.0));
    let sum: f64 = inside.iter().sum();
    inside.map(|s| s / sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use foldmotion_random::Random;

    const LIMITS: Limits = Limits { tolerance: 1e-6, margin: 1e-13, budget: 1000 };

    fn feature(random: &mut Random, corners: usize) -> [DVec3; 3] {
        let p = [(); 3].map(|()| random.vector());
        [p[0], p[1.min(corners - 1)], p[2.min(corners - 1)]]
    }

    #[test]
    fn features_are_near_exactly_in_the_reported_intervals() {
        let mut random = Random::new(81);
        let mut stretches = 0;
        for case in 0..400 {
            let (m, n) = (1 + case % 3, 1 + case / 3 % 3);
            let mut pose =
                || PairPose { a: feature(&mut random, m), b: feature(&mut random, n), shared: 0 };
            let pair = MovingPair::new(pose(), pose());
            let distance = 0.3;
            let near = contact_times(&pair, distance, &LIMITS).unwrap();
            stretches += near.len();
            assert!(near.windows(2).all(|w| w[0][1] < w[1][0]), "{near:?}");
            for k in 0..=300 {
                let t = f64::from(k) / 300.0;
                let pose = pair.at(t);
                let found = triangle_triangle(&pose.a, &pose.b).distance;
                if near.iter().any(|s| s[0] <= t && t <= s[1]) {
                    assert!(found <= distance * 65.0 / 64.0 + 1e-9, "{case} {t} {found}");
                } else {
                    assert!(found >= distance * 63.0 / 64.0 - 1e-9, "{case} {t} {found}");
                }
            }
        }
        assert!(stretches > 100, "{stretches}");
    }

    #[test]
    fn a_point_that_slides_far_along_a_plate_in_contact_is_near_in_one_interval() {
        let plate = [DVec3::ZERO, DVec3::X * 4.0, DVec3::Y * 4.0];
        let at = |x: f64| PairPose { a: [DVec3::new(x, 0.5, 4e-7); 3], b: plate, shared: 0 };
        let pair = MovingPair::new(at(0.25), at(3.0));
        assert_eq!(contact_times(&pair, 1e-6, &LIMITS).unwrap(), [[0.0, 1.0]]);
    }

    /// Edges that come to lie across each other tangentially: their distance is a third of the square of the remaining
    /// time.
    #[test]
    fn edges_that_lie_down_on_each_other_are_near_from_when_on_to_the_end() {
        let [start, end] = [1.0, 0.0].map(|left| {
            let along = DVec3::new(3.0, left, 0.0);
            PairPose {
                a: [DVec3::ZERO, along, along],
                b: [DVec3::X, DVec3::new(0.0, 1.0, left), DVec3::new(0.0, 1.0, left)],
                shared: 0,
            }
        });
        for distance in [1e-6, 1e-7, 3e-8, 1e-9, 1e-10] {
            let near = contact_times(&MovingPair { start, end }, distance, &LIMITS).unwrap();
            let [[from, to]] = near[..] else {
                panic!("{near:?}");
            };
            let left = (3.0 * distance).sqrt();
            assert_eq!(to, 1.0);
            assert!((0.98..1.02).contains(&((1.0 - from) / left)), "{near:?}");
        }
    }
}
