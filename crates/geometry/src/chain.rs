//! Chains of equal chords continued along a curve, from a short chain at its start to one that ends at its end.
//!
//! N points t_1 < … < t_N after t_0 = 0 with equal chords h_k = |Γ(t_k) − Γ(t_{k−1})| satisfy the N − 1 equations
//! h_{k+1} = h_k. Where these are regular, the chains form curves in ℝᴺ. On a curve Γ that does not meet itself, a
//! chain that starts with all points at Γ(0) cannot come back there, nor end before t_N = 1. So continuing it leads to
//! an equal division, past sharp turns too, where single points move backwards and the common chord shrinks for a
//! while.
//!
//! The method is pseudo-arclength continuation (Allgower and Georg 1990, *Numerical Continuation Methods*, chapters 2
//! to 6): a step along the tangent, then Newton steps of least norm. Both come from one QR factorisation of the banded
//! Jacobian by Givens rotations, O(N). The sign of the determinant of the Jacobian bordered by the tangent stays the
//! same along the curve, which distinguishes forward from backward; a step after which the signs differ has jumped and
//! is halved.

use glam::DVec2;

use crate::Profile;
use crate::chords::dot;
use crate::compass::Samples;
use crate::length_table::LengthTable;

/// The number of steps, and of chords in all steps together, after which the search is abandoned.
const MOST_STEPS: usize = 20_000;
const MOST_CHORDS: usize = 1_000_000;
/// Chords count as equal if they differ by at most this share of the mean chord.
const EQUAL: f64 = 1e-9;
/// The number of Newton steps after each step along the tangent.
const CORRECTIONS: usize = 5;
/// The length of a chain, relative to the curve, below which it has shrunk into a seam.
const SHORTEST_CHAIN: f64 = 1e-3;
/// The number of steps after which a chain can be back where it started.
const FEWEST_STEPS_OF_A_LOOP: usize = 20;
/// The smallest cosine of the angle between consecutive tangents.
const STRAIGHTNESS: f64 = 0.9;
/// The longest and the shortest step of a point, relative to the mean chord.
const LONGEST_STEP: f64 = 0.25;
const SHORTEST_STEP: f64 = 1e-9;
/// Points move as if the speed of the curve were at least this share of its mean speed, so that they pass cusps of the
/// parametrisation.
const SLOWEST: f64 = 0.05;

/// The openings of the compasses with which chains are started, relative to the widest that fits. A wide one starts
/// near the end, but may lie on a closed curve of chains.
const OPENINGS: [f64; 7] = [0.98, 0.8, 0.5, 0.25, 0.1, 0.03, 0.01];

/// Nearly equal divisions, found on demand by continuing chains from the start of the profile, then from its end.
pub(crate) fn divisions(
    profile: &Profile,
    segments: usize,
    table: &LengthTable,
) -> impl Iterator<Item = Vec<f64>> {
    let length = table.total();
    let along = move |profile: Profile, samples: Samples| {
        let widest = samples.widest_opening(segments, length);
        OPENINGS.into_iter().filter_map(move |share| {
            follow(&profile, samples.walk(segments, share * widest), length)
        })
    };
    let backwards = |mut u: Vec<f64>| {
        u.reverse();
        u.iter().map(|u| 1.0 - u).collect()
    };
    let reversed = profile.reversed();
    let samples = table.samples(profile);
    let turned = samples.reversed();
    along(profile.clone(), samples).chain(along(reversed, turned).map(backwards))
}

/// Continues the chain that starts near `start` (t_1 … t_N, increasing, t_N < 1) towards longer chords, until it ends
/// at u = 1.
///
/// Returns the parameters of the division, 0 and 1 included, with chords equal to about 1e-9; `None` if the chains come
/// back to the start, shrink into an acute seam of a closed profile, or are too many.
fn follow(profile: &Profile, start: Vec<f64>, length: f64) -> Option<Vec<f64>> {
    let mut chain = Chain::new(profile, start, SLOWEST * length)?;
    let mut tangent = chain.corrected()?;
    // The common chord grows if the first point moves away from the start.
    let direction = (tangent[0] * chain.slopes[0][1]).signum();
    for z in &mut tangent {
        *z *= direction;
    }
    let first = chain.clone();
    let (mut step, mut taken) = (LONGEST_STEP, 0);
    for _ in 0..MOST_STEPS.min(MOST_CHORDS / chain.parameters.len()) {
        let ahead = chain.moved(&tangent, step * chain.mean);
        let past_the_end = ahead.as_ref().is_some_and(|next| next.end() >= 1.0);
        if past_the_end && let Some(ended) = chain.clone().ended() {
            return Some(ended);
        }
        match ahead.and_then(|next| chain.accepted(next, &tangent, direction, step)) {
            Some(next) => {
                (chain, tangent) = next;
                taken += 1;
                step = LONGEST_STEP.min(1.5 * step);
            }
            None => step *= 0.5,
        }
        let has_shrunk = chain.mean * chain.chords.len() as f64 <= SHORTEST_CHAIN * length;
        let is_back = taken > FEWEST_STEPS_OF_A_LOOP
            && chain.farthest_from(&first) < LONGEST_STEP * chain.mean;
        if step < SHORTEST_STEP || is_back || has_shrunk {
            return None;
        }
    }
    None
}

/// A chain, its chords and their derivatives.
#[derive(Clone)]
struct Chain<'a> {
    profile: &'a Profile,
    /// The parameters t_1 … t_N of the points.
    parameters: Vec<f64>,
    /// |Γ'(t_k)|, or `slowest` if that is larger: a unit of unknown k changes the parameter by 1 over this.
    speeds: Vec<f64>,
    slowest: f64,
    chords: Vec<f64>,
    mean: f64,
    /// The derivatives of chord k with respect to the unknowns k − 1 and k.
    slopes: Vec<[f64; 2]>,
}

impl<'a> Chain<'a> {
    /// `None` if the parameters do not increase strictly from 0.
    fn new(profile: &'a Profile, parameters: Vec<f64>, slowest: f64) -> Option<Self> {
        let before = std::iter::once(0.0).chain(parameters.iter().copied());
        if !before.zip(&parameters).all(|(a, &b)| a < b) {
            return None;
        }
        let mut chain = Self {
            profile,
            speeds: Vec::with_capacity(parameters.len()),
            slowest,
            chords: Vec::with_capacity(parameters.len()),
            mean: 0.0,
            slopes: Vec::with_capacity(parameters.len()),
            parameters,
        };
        let (mut p, mut v) = (profile.position(0.0), DVec2::ZERO);
        for &t in &chain.parameters {
            let (q, velocity) = beyond_the_end(profile, t);
            let speed = velocity.length().max(slowest);
            let w = velocity / speed;
            let chord = q.distance(p);
            let direction = (q - p) / chord;
            chain.slopes.push([-direction.dot(v), direction.dot(w)]);
            chain.chords.push(chord);
            chain.speeds.push(speed);
            (p, v) = (q, w);
        }
        chain.mean = chain.chords.iter().sum::<f64>() / chain.chords.len() as f64;
        Some(chain)
    }

    fn end(&self) -> f64 {
        self.parameters[self.parameters.len() - 1]
    }

    /// The chain with its unknowns changed by `share` times `change`.
    fn moved(&self, change: &[f64], share: f64) -> Option<Self> {
        let parameters = (self.parameters.iter().zip(&self.speeds))
            .zip(change)
            .map(|((t, speed), z)| t + share * z / speed)
            .collect();
        Self::new(self.profile, parameters, self.slowest)
    }

    /// The largest move of a point between two chains, measured along the curve.
    fn farthest_from(&self, other: &Self) -> f64 {
        (self.parameters.iter().zip(&other.parameters))
            .zip(&self.speeds)
            .fold(0.0, |far: f64, ((a, b), speed)| far.max((a - b).abs() * speed))
    }

    /// The chain after a step, corrected, with its tangent; `None` if the step was too long.
    fn accepted(
        &self,
        mut next: Self,
        tangent: &[f64],
        direction: f64,
        step: f64,
    ) -> Option<(Self, Vec<f64>)> {
        let mut turned = next.corrected()?;
        for z in &mut turned {
            *z *= direction;
        }
        let near = next.farthest_from(self) < 2.0 * step * self.mean;
        let smooth = near && next.end() < 1.0 && cosine(&turned, tangent) > STRAIGHTNESS;
        smooth.then_some((next, turned))
    }

    fn inequality(&self) -> f64 {
        let worst = self.chords.windows(2).map(|h| (h[1] - h[0]).abs());
        worst.fold(0.0, f64::max) / self.mean
    }

    /// Makes the chords equal by Newton steps of least norm. Returns the tangent there, its largest entry 1.
    fn corrected(&mut self) -> Option<Vec<f64>> {
        for _ in 0..CORRECTIONS {
            let factors = Factors::new(self);
            let tangent = factors.tangent();
            if self.inequality() <= EQUAL {
                return Some(tangent);
            }
            let mut change = factors.solve(0.0);
            let share = dot(&change, &tangent) / dot(&tangent, &tangent);
            for (change, z) in change.iter_mut().zip(&tangent) {
                *change -= share * z;
            }
            *self = self.moved(&change, 1.0)?;
        }
        None
    }

    /// The chain with its last point at u = 1, if Newton's method finds it from here.
    fn ended(mut self) -> Option<Vec<f64>> {
        let last = self.parameters.len() - 1;
        for _ in 0..2 * CORRECTIONS {
            if self.end() == 1.0 && self.inequality() <= EQUAL {
                let mut parameters = vec![0.0];
                parameters.extend(&self.parameters);
                return Some(parameters);
            }
            let to_end = (1.0 - self.end()) * self.speeds[last];
            let change = Factors::new(&self).solve(to_end);
            let mut parameters: Vec<_> = (self.parameters.iter().zip(&self.speeds))
                .zip(&change)
                .map(|((t, speed), z)| t + z / speed)
                .collect();
            parameters[last] = 1.0;
            self = Self::new(self.profile, parameters, self.slowest)?;
        }
        None
    }
}

/// Γ and Γ' at t, continued straight beyond t = 1.
fn beyond_the_end(profile: &Profile, t: f64) -> (DVec2, DVec2) {
    let velocity = profile.derivative(t);
    (profile.position(t) + velocity * (t - 1.0).max(0.0), velocity)
}

/// The Jacobian of the equations h_{k+1} − h_k = 0 as Q R: R has three diagonals and one column more than rows.
struct Factors {
    rows: Vec<[f64; 3]>,
    /// Qᵀ times the residuals, with the opposite sign.
    right: Vec<f64>,
}

impl Factors {
    fn new(chain: &Chain<'_>) -> Self {
        let count = chain.chords.len() - 1;
        let mut rows = Vec::with_capacity(count);
        let mut right: Vec<f64> = Vec::with_capacity(count);
        for k in 0..count {
            let ([before, here], [next, after]) = (chain.slopes[k], chain.slopes[k + 1]);
            let mut row = [next - here, after, 0.0];
            let mut value = chain.chords[k] - chain.chords[k + 1];
            if let (Some(above), Some(above_value)) = (rows.last_mut(), right.last_mut()) {
                rotate(above, above_value, -before, &mut row, &mut value);
            }
            rows.push(row);
            right.push(value);
        }
        for row in &mut rows {
            if row[0].abs() < f64::EPSILON {
                row[0] = f64::EPSILON.copysign(row[0]);
            }
        }
        Self { rows, right }
    }

    /// The solution of J x = −(residuals) whose last entry is given.
    fn solve(&self, last: f64) -> Vec<f64> {
        self.back_substituted(last, |k| self.right[k])
    }

    /// The solution of J z = 0 with largest entry ±1 that makes the determinant of J bordered by z positive.
    fn tangent(&self) -> Vec<f64> {
        let negative = self.rows.iter().filter(|row| row[0] < 0.0).count();
        let sign = if negative % 2 == 1 { -1.0 } else { 1.0 };
        let mut z = self.back_substituted(sign, |_| 0.0);
        let largest = z.iter().fold(0.0, |max: f64, z| max.max(z.abs()));
        for entry in &mut z {
            *entry /= largest;
        }
        z
    }

    fn back_substituted(&self, last: f64, right: impl Fn(usize) -> f64) -> Vec<f64> {
        let count = self.rows.len();
        let mut x = vec![last; count + 1];
        for (k, row) in self.rows.iter().enumerate().rev() {
            let beyond = x.get(k + 2).map_or(0.0, |x| row[2] * x);
            x[k] = (right(k) - row[1] * x[k + 1] - beyond) / row[0];
        }
        x
    }
}

/// Rotates two rows so that the entry `below` of the lower one, under the first of the upper one, vanishes.
fn rotate(
    upper: &mut [f64; 3],
    upper_value: &mut f64,
    below: f64,
    lower: &mut [f64; 3],
    lower_value: &mut f64,
) {
    let size = upper[0].hypot(below);
    if size == 0.0 {
        return;
    }
    let (cosine, sine) = (upper[0] / size, below / size);
    let (u, l) = (*upper, *lower);
    *upper = [size, cosine * u[1] + sine * l[0], cosine * u[2] + sine * l[1]];
    lower[0] = cosine * l[0] - sine * u[1];
    lower[1] = cosine * l[1] - sine * u[2];
    let (a, b) = (*upper_value, *lower_value);
    *upper_value = cosine * a + sine * b;
    *lower_value = cosine * b - sine * a;
}

fn cosine(a: &[f64], b: &[f64]) -> f64 {
    dot(a, b) / (dot(a, a) * dot(b, b)).sqrt()
}
