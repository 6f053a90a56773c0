//! The times at which the origin passes through a moving patch: isolated zeros of the volume with certain signs.
//!
//! # Rounding
//!
//! Let u be the relative error of an operation and M_i the largest |coordinate i| of a corner at either end. A
//! coordinate at a dyadic t is off by at most 5 u M_i (the difference, two products, a sum and 1 − t, which is exact).
//! A volume det(x, y, z), six terms of three coordinates, is off by at most 6 (3 · 5 + 5 + 3) u M_x M_y M_z, and a
//! Bernstein coefficient, the mean of three, by 3 u more: [`VOLUME_ERROR`] allows 256 u. A component of a cross
//! product, two terms of two coordinates, is off by 2 (2 · 5 + 3) u M_i M_j: [`CROSS_ERROR`] allows 64 u.

use glam::DVec3;

use super::double_word::Scalar;

const VOLUME_ERROR: f64 = 256.0;
const CROSS_ERROR: f64 = 64.0;
/// A bound of what underflows, for lengths scaled to at most 1.
const TINY: f64 = f64::from_bits(63 << 52);
/// Intervals shorter than this are not divided, so that times stay multiples of 2⁻⁵².
const SHORTEST_CUT: f64 = 1.0 / (1u64 << 46) as f64;
/// Intervals are divided until the time of a passage is known to this accuracy.
const RESOLUTION: f64 = 1.0 / (1u64 << 40) as f64;
/// The accuracy required at least: for edges that are nearly parallel, the sign of the volume is known only away from
/// its zero.
const COARSEST: f64 = 1.0 / (1u64 << 24) as f64;
/// The largest number of intervals examined.
const BUDGET: u32 = 1 << 14;

type Vector<T> = [T; 3];

/// The difference of two features at both ends of an interval: N corners in order around a plane patch.
#[derive(Debug, Clone, Copy)]
pub(super) struct MovingPatch<T, const N: usize> {
    ends: [[Vector<T>; N]; 2],
    reach: DVec3,
}

/// The position of the origin while it lies in the plane of the patch.
#[derive(Debug, Clone, Copy)]
enum Zero {
    /// Inside the patch, during this time interval.
    Inside([f64; 2]),
    Beside,
}

/// A time interval with the signs of the volume at its ends.
#[derive(Debug, Clone, Copy)]
struct SignedInterval {
    times: [f64; 2],
    signs: [i8; 2],
}

impl<T: Scalar, const N: usize> MovingPatch<T, N> {
    /// `corners`: for each end and each corner, the two points whose difference it is.
    pub(super) fn new(corners: [[[DVec3; 2]; N]; 2]) -> Self {
        let difference = |[p, q]: [DVec3; 2]| [0, 1, 2].map(|i| T::difference(p[i], q[i]));
        let ends = corners.map(|at| at.map(difference));
        let all = corners.iter().flatten().map(|[p, q]| (*p - *q).abs());
        let reach = all.fold(DVec3::ZERO, DVec3::max) * (1.0 + 4.0 * f64::EPSILON);
        Self { ends, reach }
    }

    fn at(&self, t: f64) -> [Vector<T>; N] {
        let (before, after) = (T::new(1.0 - t), T::new(t));
        std::array::from_fn(|k| {
            let [p, q] = [&self.ends[0][k], &self.ends[1][k]];
            std::array::from_fn(|i| p[i] * before + q[i] * after)
        })
    }

    /// The time intervals, each at most [`COARSEST`] long, in which the origin passes through the patch once, in order,
    /// with the sign of the volume afterwards; `None` if rounding hides a passage.
    ///
    /// `signs`: the exact signs of the volume at both ends. A zero is isolated if the volume is monotone and changes
    /// its sign; there the origin lies in the patch if all c_k × c_{k+1} point to one side.
    pub(super) fn passages(&self, signs: [i8; 2]) -> Option<Vec<([f64; 2], i8)>> {
        let mut found = Vec::new();
        let mut open = vec![SignedInterval { times: [0.0, 1.0], signs }];
        let mut budget = BUDGET;
        while let Some(interval) = open.pop() {
            budget = budget.checked_sub(1)?;
            let [from, to] = interval.times.map(|t| self.at(t));
            if self.is_clear(&from, &to) {
                continue;
            }
            if self.is_monotone(&from, &to) {
                if interval.signs[0] != interval.signs[1]
                    && let Zero::Inside(times) = self.passage_within(interval)?
                {
                    found.push((times, interval.signs[1]));
                }
                continue;
            }
            let (middle, sign) = self.cut(interval.times)?;
            let ([t0, t1], [s0, s1]) = (interval.times, interval.signs);
            open.push(SignedInterval { times: [middle, t1], signs: [sign, s1] });
            open.push(SignedInterval { times: [t0, middle], signs: [s0, sign] });
        }
        Some(found)
    }

    /// Whether a coordinate or the volume keeps one sign.
    fn is_clear(&self, from: &[Vector<T>; N], to: &[Vector<T>; N]) -> bool {
        let keeps_sign = |axis: usize| {
            let error = 8.0 * T::ROUNDOFF * self.reach[axis] + TINY;
            let heights = from.iter().chain(to).map(|corner| corner[axis].value());
            let (low, high) = range(heights);
            low > error || high < -error
        };
        let (low, high) = range(volumes(from, to).into_iter());
        let error = self.volume_error();
        (0..3).any(keeps_sign) || low > error || high < -error
    }

    fn volume_error(&self) -> f64 {
        VOLUME_ERROR * T::ROUNDOFF * self.reach.element_product() + TINY
    }

    /// The position of the origin at the only zero of the volume in an interval; `None` if rounding hides it.
    fn passage_within(&self, interval: SignedInterval) -> Option<Zero> {
        let mut times = interval.times;
        let mut is_known = false;
        loop {
            if !is_known {
                let [from, to] = times.map(|t| self.at(t));
                match self.is_origin_inside(&from, &to) {
                    Some(false) => return Some(Zero::Beside),
                    inside => is_known = inside.is_some(),
                }
            }
            let length = times[1] - times[0];
            if is_known && length <= RESOLUTION {
                return Some(Zero::Inside(times));
            }
            let Some((middle, sign)) = self.cut(times) else {
                return (is_known && length <= COARSEST).then_some(Zero::Inside(times));
            };
            times[usize::from(sign != interval.signs[0])] = middle;
        }
    }

    /// A time inside an interval at which the sign of the volume is certain; `None` if the interval is too short.
    fn cut(&self, [from, to]: [f64; 2]) -> Option<(f64, i8)> {
        let length = to - from;
        if length < SHORTEST_CUT {
            return None;
        }
        let error = self.volume_error();
        [0.5, 0.375, 0.625, 0.4375].into_iter().find_map(|share| {
            let time = from + share * length;
            let corners = self.at(time);
            let [x, y, z] = spanning(&corners);
            let value = determinant(x, y, z).value();
            (value.abs() > error).then_some((time, if value > 0.0 { 1 } else { -1 }))
        })
    }

    fn is_monotone(&self, from: &[Vector<T>; N], to: &[Vector<T>; N]) -> bool {
        let v = volumes(from, to);
        let (low, high) = range([v[1] - v[0], v[2] - v[1], v[3] - v[2]].into_iter());
        let rounding = f64::EPSILON * v.into_iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        let error = 2.0 * self.volume_error() + 2.0 * rounding;
        low > error || high < -error
    }

    /// Whether the origin, while it lies in the plane of the patch, is inside the patch; `None` if that is uncertain.
    fn is_origin_inside(&self, from: &[Vector<T>; N], to: &[Vector<T>; N]) -> Option<bool> {
        let mut is_outside = false;
        for axis in 0..3 {
            let others = self.reach[(axis + 1) % 3] * self.reach[(axis + 2) % 3];
            let error = CROSS_ERROR * T::ROUNDOFF * others + TINY;
            let mut counts = [0; 2];
            for k in 0..N {
                let next = (k + 1) % N;
                let turn = |p: &Vector<T>, q: &Vector<T>| cross(p, q, axis);
                let middle = turn(&from[k], &to[next]) + turn(&to[k], &from[next]);
                let turns = [
                    turn(&from[k], &from[next]).value(),
                    0.5 * middle.value(),
                    turn(&to[k], &to[next]).value(),
                ];
                let (low, high) = range(turns.into_iter());
                counts[0] += usize::from(low > error);
                counts[1] += usize::from(high < -error);
            }
            if counts.contains(&N) {
                return Some(true);
            }
            is_outside |= counts[0] > 0 && counts[1] > 0;
        }
        is_outside.then_some(false)
    }
}

fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
}

fn spanning<T: Scalar, const N: usize>(corners: &[Vector<T>; N]) -> [&Vector<T>; 3] {
    [&corners[0], &corners[1], &corners[N - 1]]
}

/// Component `axis` of the cross product p × q.
fn cross<T: Scalar>(p: &Vector<T>, q: &Vector<T>, axis: usize) -> T {
    let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
    p[i] * q[j] - p[j] * q[i]
}

fn determinant<T: Scalar>(x: &Vector<T>, y: &Vector<T>, z: &Vector<T>) -> T {
    x[0] * cross(y, z, 0) + x[1] * cross(y, z, 1) + x[2] * cross(y, z, 2)
}

/// The Bernstein coefficients of the volume det(x, y, z) of three corners that span the patch.
fn volumes<T: Scalar, const N: usize>(from: &[Vector<T>; N], to: &[Vector<T>; N]) -> [f64; 4] {
    let ([x0, y0, z0], [x1, y1, z1]) = (spanning(from), spanning(to));
    let first = determinant(x1, y0, z0) + determinant(x0, y1, z0) + determinant(x0, y0, z1);
    let second = determinant(x0, y1, z1) + determinant(x1, y0, z1) + determinant(x1, y1, z0);
    [
        determinant(x0, y0, z0).value(),
        first.value() / 3.0,
        second.value() / 3.0,
        determinant(x1, y1, z1).value(),
    ]
}
