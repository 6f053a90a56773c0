//! A direction that moves as a polynomial in time, and the heights of moving points along it, in Bernstein form.

use glam::DVec3;

/// A bound of the roundings in a height, with room to spare: see [`Path::margin`].
const ROUNDINGS: f64 = 256.0;

/// n(t) = Σ N_k B_k(t), t in [0, 1], of degree 0 to 3, in Bernstein form.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Path {
    coefficients: [DVec3; 4],
    pub(crate) degree: usize,
    /// The number of lengths multiplied in n: |N_k| ≤ size^power.
    power: i32,
}

impl Path {
    /// From one direction straight to another; constant if they are equal. Precondition: their lengths are at most 1.
    pub(crate) fn straight(from: DVec3, to: DVec3) -> Self {
        Self {
            coefficients: [from, to, DVec3::ZERO, DVec3::ZERO],
            degree: usize::from(from != to),
            power: 0,
        }
    }

    /// u × v of two vectors that move straight.
    pub(crate) fn cross(u: [DVec3; 2], v: [DVec3; 2]) -> Self {
        let middle = (u[0].cross(v[1]) + u[1].cross(v[0])) * 0.5;
        Self {
            coefficients: [u[0].cross(v[0]), middle, u[1].cross(v[1]), DVec3::ZERO],
            degree: 2,
            power: 2,
        }
    }

    /// n × v of a quadratic path and a vector that moves straight.
    pub(crate) fn across(self, v: [DVec3; 2]) -> Self {
        let n = self.coefficients;
        let coefficients = [
            n[0].cross(v[0]),
            (n[1].cross(v[0]) * 2.0 + n[0].cross(v[1])) / 3.0,
            (n[2].cross(v[0]) + n[1].cross(v[1]) * 2.0) / 3.0,
            n[2].cross(v[1]),
        ];
        Self { coefficients, degree: 3, power: 3 }
    }

    pub(crate) fn reversed(mut self) -> Self {
        for n in &mut self.coefficients {
            *n = -*n;
        }
        self
    }

    /// The direction at t = 0 and at t = 1.
    pub(crate) fn ends(&self) -> [DVec3; 2] {
        [self.coefficients[0], self.coefficients[self.degree]]
    }

    /// The Bernstein coefficients of n(t)·v(t), whose degree is one higher; v moves straight.
    ///
    /// c_k = ((m − k) N_k·v_0 + k N_{k−1}·v_1) / m with m = degree + 1 (Farin 2002, product of Bernstein forms).
    pub(crate) fn heights(&self, v: [DVec3; 2]) -> [f64; 5] {
        let m = self.degree + 1;
        let mut heights = [0.0; 5];
        for (k, height) in heights.iter_mut().enumerate().take(m + 1) {
            let mut sum = 0.0;
            if k < m {
                sum += (m - k) as f64 * self.coefficients[k].dot(v[0]);
            }
            if k > 0 {
                sum += k as f64 * self.coefficients[k - 1].dot(v[1]);
            }
            *height = sum / m as f64;
        }
        heights
    }

    /// A bound of the rounding error of a height n·v, if no vector is longer than `size`.
    ///
    /// The corners come from one subtraction and one interpolation, a path multiplies at most three vectors, a height
    /// one more: fewer than 100 roundings, each of at most ε size^(power + 1).
    pub(crate) fn margin(&self, size: f64) -> f64 {
        ROUNDINGS * f64::EPSILON * size.powi(self.power + 1)
    }

    /// A lower bound of |n(t)|, its component along the sum of its coefficients, and an upper bound, the longest of
    /// them.
    pub(crate) fn lengths(&self) -> (f64, f64) {
        let used = &self.coefficients[..=self.degree];
        let along = used.iter().sum::<DVec3>().normalize_or_zero();
        let least = used.iter().map(|n| n.dot(along)).fold(f64::INFINITY, f64::min);
        let longest = used.iter().map(|n| n.length()).fold(0.0, f64::max);
        (least, longest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use foldmotion_random::Random;

    /// n(t) by its definition (de Casteljau's algorithm).
    fn de_casteljau(path: &Path, t: f64) -> DVec3 {
        let mut points = path.coefficients[..=path.degree].to_vec();
        while points.len() > 1 {
            points = points.windows(2).map(|w| w[0].lerp(w[1], t)).collect();
        }
        points[0]
    }

    fn value(coefficients: &[f64], t: f64) -> f64 {
        let mut values = coefficients.to_vec();
        while values.len() > 1 {
            values = values.windows(2).map(|w| w[0] + (w[1] - w[0]) * t).collect();
        }
        values[0]
    }

    fn straight(random: &mut Random) -> [DVec3; 2] {
        [random.vector(), random.vector()]
    }

    fn at(v: [DVec3; 2], t: f64) -> DVec3 {
        v[0].lerp(v[1], t)
    }

    #[test]
    fn the_coefficients_are_those_of_the_products_and_bound_them() {
        let mut random = Random::new(5);
        for _ in 0..400 {
            let [u, v, w, p] = [(); 4].map(|()| straight(&mut random));
            let normal = Path::cross(u, v);
            let side = normal.across(w);
            let line = Path::straight(u[0], u[1]);
            for k in 0..=20 {
                let t = f64::from(k) / 20.0;
                let n = at(u, t).cross(at(v, t));
                let cases = [(&normal, n), (&side, n.cross(at(w, t))), (&line, at(u, t))];
                for (path, expected) in cases {
                    assert!((de_casteljau(path, t) - expected).length() < 1e-14);
                    let heights = &path.heights(p)[..path.degree + 2];
                    let height = expected.dot(at(p, t));
                    assert!((value(heights, t) - height).abs() < 1e-14);
                    let low = heights.iter().copied().fold(f64::INFINITY, f64::min);
                    let high = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                    assert!(low <= height + 1e-14 && height <= high + 1e-14);
                    let (shortest, longest) = path.lengths();
                    let length = expected.length();
                    assert!(shortest <= length + 1e-14 && length <= longest + 1e-14);
                }
            }
        }
    }

    #[test]
    fn halving_a_path_is_exact() {
        let mut random = Random::new(6);
        for _ in 0..200 {
            let [u, v, p] = [(); 3].map(|()| straight(&mut random));
            let half = |w: [DVec3; 2]| [w[0], w[0].midpoint(w[1])];
            let whole = Path::cross(u, v).heights(p);
            let halved = Path::cross(half(u), half(v)).heights(half(p));
            for k in 0..=10 {
                let t = f64::from(k) / 10.0;
                let difference = value(&halved[..4], t) - value(&whole[..4], t / 2.0);
                assert!(difference.abs() < 1e-14);
            }
        }
    }
}
