//! Two triangles whose corners move on straight lines, and bounds that hold over the whole interval.

use glam::DVec3;

use super::{
    Limits, PairPose,
    pose::{gap_of, overlap_of, shortest_between},
};

/// Triangles A and B, each corner moving on a straight line at constant speed for t in [0, 1].
///
/// Along a direction that also moves straight, d(t) = (1 − t) d_0 + t d_1, each height d(t)·p(t) is a quadratic with the
/// Bernstein coefficients d_0·p_0, (d_0·p_1 + d_1·p_0) / 2 and d_1·p_1, and stays between the smallest and the largest.
#[derive(Debug, Clone, Copy)]
pub struct MovingPair {
    /// The positions at t = 0.
    pub start: PairPose,
    /// The positions at t = 1.
    pub end: PairPose,
}

impl MovingPair {
    /// A pair that moves from one pose to another.
    pub fn new(start: PairPose, end: PairPose) -> Self {
        Self { start, end }
    }

    /// A pair that does not move.
    pub fn at_rest(pose: PairPose) -> Self {
        Self::new(pose, pose)
    }

    /// The positions at t in [0, 1].
    pub fn at(&self, t: f64) -> PairPose {
        if t <= 0.0 {
            return self.start;
        }
        if t >= 1.0 {
            return self.end;
        }
        let between = |p: &[DVec3; 3], q: &[DVec3; 3]| [0, 1, 2].map(|i| p[i].lerp(q[i], t));
        PairPose {
            a: between(&self.start.a, &self.end.a),
            b: between(&self.start.b, &self.end.b),
            shared: self.start.shared,
        }
    }

    /// The three Bernstein coefficients of every corner's height along the direction moving from `d0` to `d1`.
    fn heights(&self, d0: DVec3, d1: DVec3) -> [([f64; 3], [f64; 3]); 3] {
        let middle = |p0: &[DVec3; 3], p1: &[DVec3; 3]| {
            [0, 1, 2].map(|i| f64::midpoint(d0.dot(p1[i]), d1.dot(p0[i])))
        };
        [
            self.start.projections(d0),
            (middle(&self.start.a, &self.end.a), middle(&self.start.b, &self.end.b)),
            self.end.projections(d1),
        ]
    }

    /// Whether the overlap stays within the tolerance along the direction moving from `d0` to `d1`.
    pub(super) fn stays_within(&self, d0: DVec3, d1: DVec3, limits: &Limits) -> bool {
        let Some(shortest) = shortest_between(d0, d1) else {
            return false;
        };
        let allowed = limits.tolerance * shortest - limits.margin;
        self.heights(d0, d1).iter().all(|(a, b)| overlap_of(a, b) <= allowed)
    }

    /// A lower bound of the gap along the direction moving from `d0` to `d1`; if positive, the triangles are apart
    /// throughout.
    ///
    /// As |d(s)| ≤ 1, it is also a lower bound of the distance of triangles that share no vertex.
    pub(super) fn least_gap(&self, d0: DVec3, d1: DVec3, limits: &Limits) -> f64 {
        if shortest_between(d0, d1).is_none() {
            return f64::NEG_INFINITY;
        }
        self.heights(d0, d1)
            .iter()
            .map(|(a, b)| gap_of(a, b, self.start.shared, limits))
            .fold(f64::INFINITY, f64::min)
    }

    /// [`Self::least_gap`] for a direction at rest: a linear function of time has its minimum at an end.
    pub(super) fn least_gap_at_rest(&self, d: DVec3, limits: &Limits) -> f64 {
        self.start.gap(d, limits).min(self.end.gap(d, limits))
    }

    /// Whether two triangles that share an edge e stay off each other, which means that they are never folded to ±180°.
    ///
    /// With l and r from the start of e to the apexes, sin θ has the sign of f = det(e, l, r), a cubic in time, and cos
    /// θ the opposite sign of g = (e × l)·(e × r), a quartic. By the Bernstein coefficients, either f ≠ 0 throughout or
    /// g < 0 throughout (the fold angle stays within ±90°).
    pub(super) fn hinge_stays_open(&self, limits: &Limits) -> bool {
        let hinge = Hinge::new(self);
        let f = hinge.sines();
        let margin = 8.0 * limits.margin * hinge.squared;
        f.iter().all(|&c| c > margin)
            || f.iter().all(|&c| c < -margin)
            || hinge.stays_within_right_angle(limits)
    }

    /// Whether two triangles that share an edge are proved to stay folded by less than 90°.
    pub fn hinge_stays_within_right_angle(&self, limits: &Limits) -> bool {
        Hinge::new(self).stays_within_right_angle(limits)
    }
}

/// Two triangles that share an edge: the Bernstein coefficients of their normals, whose lengths are twice the areas.
struct Hinge {
    normals: [[DVec3; 3]; 2],
    /// From the start of the edge to the second apex, at both ends of the interval.
    r: [DVec3; 2],
    /// The largest squared length of a vector from the start of the edge.
    squared: f64,
}

impl Hinge {
    fn new(pair: &MovingPair) -> Self {
        let vectors = |p: &PairPose| [p.a[1] - p.a[0], p.a[2] - p.a[0], p.b[2] - p.a[0]];
        let ([e0, l0, r0], [e1, l1, r1]) = (vectors(&pair.start), vectors(&pair.end));
        let normal = |v0: DVec3, v1: DVec3| {
            [e0.cross(v0), (e0.cross(v1) + e1.cross(v0)) * 0.5, e1.cross(v1)]
        };
        let all = [e0, l0, r0, e1, l1, r1].map(DVec3::length_squared);
        Self {
            normals: [normal(l0, l1), normal(r0, r1)],
            r: [r0, r1],
            squared: all.into_iter().fold(0.0, f64::max),
        }
    }

    /// The Bernstein coefficients of f = det(e, l, r).
    fn sines(&self) -> [f64; 4] {
        let ([n, _], [r0, r1]) = (self.normals, self.r);
        [
            n[0].dot(r0),
            (n[0].dot(r1) + 2.0 * n[1].dot(r0)) / 3.0,
            (2.0 * n[1].dot(r1) + n[2].dot(r0)) / 3.0,
            n[2].dot(r1),
        ]
    }

    /// Whether g = (e × l)·(e × r) < 0 throughout.
    fn stays_within_right_angle(&self, limits: &Limits) -> bool {
        let [n, m] = self.normals;
        let g = [
            n[0].dot(m[0]),
            f64::midpoint(n[0].dot(m[1]), n[1].dot(m[0])),
            (n[0].dot(m[2]) + 4.0 * n[1].dot(m[1]) + n[2].dot(m[0])) / 6.0,
            f64::midpoint(n[1].dot(m[2]), n[2].dot(m[1])),
            n[2].dot(m[2]),
        ];
        let margin = 8.0 * limits.margin * self.squared * self.squared.sqrt();
        g.iter().all(|&c| c < -margin)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use foldmotion_random::Random;

    const LIMITS: Limits = Limits { tolerance: 1e-6, margin: 1e-13, budget: 1000 };

    fn random_pair(random: &mut Random, shared: usize) -> MovingPair {
        let mut pose = || {
            let a = random.triangle(1.0);
            let mut b = random.triangle(1.0);
            b[..shared].copy_from_slice(&a[..shared]);
            PairPose { a, b, shared }
        };
        MovingPair { start: pose(), end: pose() }
    }

    #[test]
    fn the_least_gap_bounds_the_gap_at_every_sampled_instant() {
        let mut random = Random::new(31);
        for case in 0..500 {
            let pair = random_pair(&mut random, case % 2);
            let d0 = random.vector().normalize();
            let d1 = (d0 + random.vector() * 0.5).normalize();
            let bound = pair.least_gap(d0, d1, &LIMITS);
            for k in 0..=50 {
                let s = f64::from(k) / 50.0;
                let d = d0.lerp(d1, s);
                let gap = pair.at(s).gap(d, &LIMITS);
                assert!(gap >= bound - 1e-14, "{gap} < {bound}");
            }
        }
    }

    #[test]
    fn a_hinge_said_to_stay_open_is_never_folded_flat_at_a_sampled_instant() {
        let mut random = Random::new(32);
        let mut open = 0;
        for _ in 0..4000 {
            let pair = random_pair(&mut random, 2);
            if !pair.hinge_stays_open(&LIMITS) {
                continue;
            }
            open += 1;
            let angle = |t: f64| {
                let p = pair.at(t);
                crate::fold_angle(p.a[0], p.a[1], p.a[2], p.b[2])
            };
            for k in 0..200 {
                let step = angle(f64::from(k + 1) / 200.0) - angle(f64::from(k) / 200.0);
                assert!(step.abs() < std::f64::consts::PI, "jumped through ±180°");
            }
        }
        assert!(open > 100, "the filter decides some: {open}");
    }
}
