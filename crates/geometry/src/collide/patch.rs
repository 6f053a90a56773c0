//! The difference of two moving features, and conservative proofs that the origin stays away from it.
//!
//! # Rounding
//!
//! u = 2⁻⁵³ is the unit roundoff, M_i the largest |coordinate i| of a corner of the patch at either end (`reach`). The
//! corners are differences of two given numbers, off by a factor 1 + u; scaling them by a power of two is exact. At a
//! dyadic t both t and 1 − t are exact, so that (1 − t) D_0 + t D_1 adds two products and a sum, 2 u M_i: a coordinate
//! is off by at most 4 u M_i, second-order terms included.
//!
//! - Height d·D: products and sums add 3 u Σ |d_i| M_i to the 4 u Σ |d_i| M_i of the coordinates, and the halving of a
//!   middle coefficient adds one more: 8 u Σ |d_i| M_i. [`HEIGHT_ERROR`] allows 12 u.
//! - Determinant: with P = M_x M_y M_z, the coordinates change it by 72 u P (six terms, three factors each), the
//!   subtractions and products by 30 u P, the mean of three by 18 u P: 120 u P. [`VOLUME_ERROR`] allows 128 u.
//!
//! [`TINY`] covers underflow.

use glam::DVec3;

use super::pose::{highest, lowest};

/// Rounding of a height, in units of Σ |d_i| M_i: 12 u.
const HEIGHT_ERROR: f64 = 6.0 * f64::EPSILON;
/// Rounding of a Bernstein coefficient of the volume, in units of M_x M_y M_z: 128 u.
const VOLUME_ERROR: f64 = 64.0 * f64::EPSILON;
/// A bound of all underflows of one evaluation together: 2⁻⁹⁶⁰.
const TINY: f64 = f64::from_bits(63 << 52);
/// A bound of the length of unit vectors as computed.
const LONGEST: f64 = 1.0 + 8.0 * f64::EPSILON;

/// The convex hull of N moving corners that lie in one plane at every instant, in order around it: a triangle or a
/// parallelogram.
///
/// Two features meet at t exactly if the patch of their differences contains the origin.
#[derive(Debug, Clone, Copy)]
pub(super) struct Patch<const N: usize> {
    start: [DVec3; N],
    end: [DVec3; N],
    /// M: a bound of every coordinate at every instant, before rounding of the interpolation.
    reach: DVec3,
    separation: f64,
}

impl<const N: usize> Patch<N> {
    /// The patch of differences `start` and `end`, scaled to coordinates below 1; `None` if one is not finite.
    pub(super) fn new(start: [DVec3; N], end: [DVec3; N], separation: f64) -> Option<Self> {
        let corners = start.iter().chain(&end);
        let reach = corners.fold(DVec3::ZERO, |reach, p| reach.max(p.abs()));
        let is_finite = start.iter().chain(&end).all(|p| p.is_finite());
        if !is_finite || !separation.is_finite() {
            return None;
        }
        let (once, again) = scale_to_one(reach.max_element());
        let scaled = |corners: [DVec3; N]| corners.map(|p| p * once * again);
        Some(Self {
            start: scaled(start),
            end: scaled(end),
            reach: reach * once * again,
            separation: separation * once * again,
        })
    }

    fn at(&self, t: f64) -> [DVec3; N] {
        std::array::from_fn(|k| self.start[k] * (1.0 - t) + self.end[k] * t)
    }

    /// Whether the origin is proved to stay farther than the separation from the patch over [t0, t1].
    ///
    /// Precondition: t0 and t1 are multiples of 2⁻⁵².
    pub(super) fn stays_clear(&self, t0: f64, t1: f64) -> bool {
        let (from, to) = (self.at(t0), self.at(t1));
        if self.is_clear_along_coordinates(&from, &to) || self.is_never_coplanar(&from, &to) {
            return true;
        }
        let (Some(d0), Some(d1)) = (direction_away(&from), direction_away(&to)) else {
            return false;
        };
        [(d0, d1), (d0, d0), (d1, d1)]
            .into_iter()
            .any(|(d0, d1)| self.is_clear_along(&from, &to, d0, d1))
    }

    fn is_clear_along_coordinates(&self, from: &[DVec3; N], to: &[DVec3; N]) -> bool {
        [DVec3::X, DVec3::Y, DVec3::Z].into_iter().any(|d| self.is_clear_along(from, to, d, d))
    }

    /// Whether every corner lies beyond the separation on one side along the direction moving from `d0` to `d1`.
    ///
    /// The height d(s)·D(s) is a quadratic that stays between its Bernstein coefficients d_0·D_0,
    /// (d_0·D_1 + d_1·D_0) / 2 and d_1·D_1; |d(s)| is at most that of the longer end.
    fn is_clear_along(&self, from: &[DVec3; N], to: &[DVec3; N], d0: DVec3, d1: DVec3) -> bool {
        let room = self.separation * LONGEST
            + HEIGHT_ERROR * d0.abs().max(d1.abs()).dot(self.reach)
            + TINY;
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for (p0, p1) in from.iter().zip(to) {
            let heights = [d0.dot(*p0), f64::midpoint(d0.dot(*p1), d1.dot(*p0)), d1.dot(*p1)];
            low = low.min(lowest(&heights));
            high = high.max(highest(&heights));
        }
        low > room || high < -room
    }

    /// Whether the plane of the patch is proved to stay farther than the separation from the origin.
    ///
    /// With three corners x, y, z of the patch, f = det(x, y, z) = x·n is a cubic in time, n = (y − x) × (z − x). A
    /// point q of the plane has q·n = f, so that |q| ≤ δ requires |f| ≤ δ |n|, and |n| ≤ 4 |M|².
    fn is_never_coplanar(&self, from: &[DVec3; N], to: &[DVec3; N]) -> bool {
        let ([x0, y0, z0], [x1, y1, z1]) = (spanning(from), spanning(to));
        let volume = |x: DVec3, y: DVec3, z: DVec3| x.dot(y.cross(z));
        let coefficients = [
            volume(x0, y0, z0),
            (volume(x1, y0, z0) + volume(x0, y1, z0) + volume(x0, y0, z1)) / 3.0,
            (volume(x0, y1, z1) + volume(x1, y0, z1) + volume(x1, y1, z0)) / 3.0,
            volume(x1, y1, z1),
        ];
        let room = VOLUME_ERROR * self.reach.element_product()
            + self.separation * LONGEST * 4.0 * self.reach.length_squared() * LONGEST
            + TINY;
        lowest(&coefficients) > room || highest(&coefficients) < -room
    }
}

fn spanning<const N: usize>(corners: &[DVec3; N]) -> [DVec3; 3] {
    [corners[0], corners[1], corners[N - 1]]
}

/// Two powers of two whose product scales `size` into [1/4, 1], each of them representable.
fn scale_to_one(size: f64) -> (f64, f64) {
    if size == 0.0 {
        return (1.0, 1.0);
    }
    let exponent = -(size.log2().floor() as i32 + 1);
    let half = exponent / 2;
    (2.0_f64.powi(half), 2.0_f64.powi(exponent - half))
}

/// The unit direction along which the patch is farthest from the origin, on its positive side; `None` if every
/// candidate fails.
///
/// The nearest point of a convex polygon lies inside it, on an edge or at a corner: the candidates are its normal, the
/// perpendiculars to its edges through the origin, and its corners. Built from edges, not from the nearest point, they
/// stay well-conditioned however near the patch is.
fn direction_away<const N: usize>(corners: &[DVec3; N]) -> Option<DVec3> {
    let [x, y, z] = spanning(corners);
    let mut best: Option<DVec3> = None;
    let mut farthest = 0.0;
    let mut consider = |candidate: DVec3| {
        let Some(d) = candidate.try_normalize() else {
            return;
        };
        let heights = corners.map(|p| d.dot(p));
        let (low, high) = (lowest(&heights), highest(&heights));
        if low > farthest {
            (best, farthest) = (Some(d), low);
        } else if -high > farthest {
            (best, farthest) = (Some(-d), -high);
        }
    };
    consider((y - x).cross(z - x));
    for (k, &corner) in corners.iter().enumerate() {
        let edge = corners[(k + 1) % N] - corner;
        consider(edge.cross(corner.cross(edge)));
        consider(corner);
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use foldmotion_random::Random;

    #[test]
    fn the_direction_away_reaches_the_distance_of_the_nearest_point() {
        let mut random = Random::new(61);
        for case in 0..400 {
            let shift = random.vector() * 1.5;
            let triangle = random.triangle(1.0).map(|p| p + shift);
            let origin = [DVec3::ZERO; 3];
            let distance = crate::triangle_triangle(&triangle, &origin).distance;
            let d = direction_away(&triangle).unwrap();
            let least = lowest(&triangle.map(|p| d.dot(p)));
            assert!((least - distance).abs() < 1e-12, "{case}: {least} {distance}");
        }
    }

    #[test]
    fn no_patch_that_stays_clear_holds_a_point_within_the_separation() {
        let mut random = Random::new(62);
        let (mut clear, mut near) = (0, 0);
        for case in 0..3000 {
            let shift = random.vector();
            let mut corners = || random.triangle(1.0).map(|p| p + shift);
            let separation = [0.0, 0.1, 0.5][case % 3];
            let patch = Patch::new(corners(), corners(), separation).unwrap();
            let nearest = (0..=40)
                .map(|k| patch.at(f64::from(k) / 40.0))
                .map(|p| crate::triangle_triangle(&p, &[DVec3::ZERO; 3]).distance)
                .fold(f64::INFINITY, f64::min);
            if patch.stays_clear(0.0, 1.0) {
                clear += 1;
                assert!(nearest > patch.separation, "case {case}: {nearest}");
            } else {
                near += usize::from(nearest <= patch.separation);
            }
        }
        assert!(clear > 300 && near > 300, "both occur: {clear} {near}");
    }

    #[test]
    fn sizes_are_scaled_into_reach_of_one_from_the_smallest_to_the_largest() {
        for size in [5e-324, 1e-310, 1e-3, 0.5, 1.0, 1.5, 1e300, f64::MAX] {
            let (once, again) = scale_to_one(size);
            let scaled = size * once * again;
            assert!((0.25..=1.0).contains(&scaled), "{size} becomes {scaled}");
        }
    }
}
