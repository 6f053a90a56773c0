//! The closest points of a vertex and a facet, or of two edges, and the derivatives of their distance.
//!
//! With r = Σ w_i x_i from one closest point to the other, D = |r| is a minimum over the parameters t of the points
//! that lie inside their edge or facet. By the envelope theorem
//!
//! ∇_i ½D² = w_i r,  ∇_i∇_j ½D² = w_i w_j I − Σ_kl C_ik (K⁻¹)_kl C_jlᵀ
//!
//! with the tangents u_k = Σ (∂w_i/∂t_k) x_i, K_kl = u_k·u_l and C_ik = w_i u_k + (∂w_i/∂t_k) r: one formula for a
//! point nearest to a corner (no parameter), to an edge (one), to the inside of a facet and for crossing edges (two).

use glam::{DMat2, DMat3, DVec2, DVec3};

use super::super::hinge_hessian::outer;

/// Edges whose sine is below the root of this are treated as parallel.
const PARALLEL: f64 = 1e-12;

/// ∂w/∂t along the sides of a facet, and along two edges.
const AB: [f64; 4] = [0.0, 1.0, -1.0, 0.0];
const AC: [f64; 4] = [0.0, 1.0, 0.0, -1.0];
const BC: [f64; 4] = [0.0, 0.0, 1.0, -1.0];
const FIRST: [f64; 4] = [-1.0, 1.0, 0.0, 0.0];
const SECOND: [f64; 4] = [0.0, 0.0, 1.0, -1.0];

/// The closest points of a pair, as weights on its four nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Closest {
    /// w: the first closest point minus the second is Σ w_i x_i.
    pub(super) weights: [f64; 4],
    /// ∂w/∂t for each free parameter.
    tangents: [[f64; 4]; 2],
    free: usize,
    /// The difference r of the two nearest points.
    pub(super) apart: DVec3,
    /// The distance D of the two nearest points.
    pub(super) distance: f64,
}

impl Closest {
    #[inline]
    fn new(x: &[DVec3; 4], weights: [f64; 4], tangents: &[[f64; 4]]) -> Self {
        let apart = combine(&weights, x);
        let mut all = [[0.0; 4]; 2];
        all[..tangents.len()].copy_from_slice(tangents);
        Self { weights, tangents: all, free: tangents.len(), apart, distance: apart.length() }
    }

    /// The closest points of vertex x₀ and facet x₁x₂x₃ (Ericson 2005, section 5.1.5).
    pub(super) fn vertex_facet(x: &[DVec3; 4]) -> Self {
        let [p, a, b, c] = *x;
        let (ab, ac) = (b - a, c - a);
        let at = |b: f64, c: f64| [1.0, b + c - 1.0, -b, -c];
        let (d1, d2) = (ab.dot(p - a), ac.dot(p - a));
        if d1 <= 0.0 && d2 <= 0.0 {
            return Self::new(x, at(0.0, 0.0), &[]);
        }
        let (d3, d4) = (ab.dot(p - b), ac.dot(p - b));
        if d3 >= 0.0 && d4 <= d3 {
            return Self::new(x, at(1.0, 0.0), &[]);
        }
        let (d5, d6) = (ab.dot(p - c), ac.dot(p - c));
        if d6 >= 0.0 && d5 <= d6 {
            return Self::new(x, at(0.0, 1.0), &[]);
        }
        let vc = d1 * d4 - d3 * d2;
        if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
            return Self::new(x, at(d1 / (d1 - d3), 0.0), &[AB]);
        }
        let vb = d5 * d2 - d1 * d6;
        if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
            return Self::new(x, at(0.0, d2 / (d2 - d6)), &[AC]);
        }
        let va = d3 * d6 - d5 * d4;
        if va <= 0.0 && d4 >= d3 && d5 >= d6 {
            let t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
            return Self::new(x, at(1.0 - t, t), &[BC]);
        }
        let sum = va + vb + vc;
        Self::new(x, at(vb / sum, vc / sum), &[AB, AC])
    }

    /// The closest points of edges x₀x₁ and x₂x₃ (Ericson 2005, section 5.1.9).
    pub(super) fn edge_edge(x: &[DVec3; 4]) -> Self {
        let (u, v, r) = (x[1] - x[0], x[3] - x[2], x[0] - x[2]);
        let (a, e, b) = (u.length_squared(), v.length_squared(), u.dot(v));
        let (c, f) = (u.dot(r), v.dot(r));
        let determinant = a * e - b * b;
        let mut s = if determinant > PARALLEL * a * e {
            ((b * f - c * e) / determinant).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let mut t = (b * s + f) / e;
        if !(0.0..=1.0).contains(&t) {
            t = t.clamp(0.0, 1.0);
            s = ((b * t - c) / a).clamp(0.0, 1.0);
        }
        let weights = [1.0 - s, s, t - 1.0, -t];
        let is_inside = |p: f64| p > 0.0 && p < 1.0;
        match (is_inside(s), is_inside(t)) {
            (true, true) if determinant > PARALLEL * a * e => {
                Self::new(x, weights, &[FIRST, SECOND])
            }
            (true, _) => Self::new(x, weights, &[FIRST]),
            (false, true) => Self::new(x, weights, &[SECOND]),
            (false, false) => Self::new(x, weights, &[]),
        }
    }

    /// The foot of vertex x₀ on the plane of facet x₁x₂x₃.
    pub(super) fn vertex_plane(x: &[DVec3; 4]) -> Self {
        let [p, a, b, c] = *x;
        let (ab, ac, ap) = (b - a, c - a, p - a);
        let metric = DMat2::from_cols(
            DVec2::new(ab.length_squared(), ab.dot(ac)),
            DVec2::new(ab.dot(ac), ac.length_squared()),
        );
        let t = metric.inverse() * DVec2::new(ab.dot(ap), ac.dot(ap));
        Self::new(x, [1.0, t.x + t.y - 1.0, -t.x, -t.y], &[AB, AC])
    }

    /// The closest points of the lines through edges x₀x₁ and x₂x₃, which are not parallel.
    pub(super) fn lines(x: &[DVec3; 4]) -> Self {
        let (u, v, r) = (x[1] - x[0], x[3] - x[2], x[0] - x[2]);
        let (a, e, b) = (u.length_squared(), v.length_squared(), u.dot(v));
        let (c, f) = (u.dot(r), v.dot(r));
        let s = (b * f - c * e) / (a * e - b * b);
        let t = (b * s + f) / e;
        Self::new(x, [1.0 - s, s, t - 1.0, -t], &[FIRST, SECOND])
    }

    /// Whether the closest points lie inside both primitives.
    #[inline]
    pub(super) fn is_inside(&self) -> bool {
        self.free == 2
    }

    /// ∇D, one vector a node. Precondition: D > 0.
    pub(super) fn gradient(&self) -> [DVec3; 4] {
        let normal = self.apart / self.distance;
        self.weights.map(|w| normal * w)
    }

    /// Adds `scale` ∇∇D, by blocks of nodes. Precondition: D > 0.
    pub(super) fn add_hessian(&self, x: &[DVec3; 4], scale: f64, sum: &mut [[DMat3; 4]; 4]) {
        let tangents: [DVec3; 2] = [0, 1].map(|k| combine(&self.tangents[k], x));
        let inverse = self.inverse_metric(&tangents);
        // C by parameters and nodes, and C K⁻¹; 0 for parameters that are not free.
        let coupling = [0, 1].map(|k| {
            let tangent = &self.tangents[k];
            [0, 1, 2, 3].map(|i| tangents[k] * self.weights[i] + self.apart * tangent[i])
        });
        let weighted = [0, 1].map(|k| {
            let weights = inverse.col(k);
            [0, 1, 2, 3].map(|i| coupling[0][i] * weights.x + coupling[1][i] * weights.y)
        });
        let normal = self.apart / self.distance;
        let across = DMat3::IDENTITY - outer(normal, normal);
        let scale = scale / self.distance;
        for i in 0..4 {
            for j in 0..=i {
                // ∇∇D = (∇∇½D² − ∇D ∇Dᵀ) / D.
                let mut block = across * (self.weights[i] * self.weights[j]);
                for k in 0..self.free {
                    block -= outer(weighted[k][i], coupling[k][j]);
                }
                block *= scale;
                sum[i][j] += block;
                if i != j {
                    sum[j][i] += block.transpose();
                }
            }
        }
    }

    /// K⁻¹.
    fn inverse_metric(&self, tangents: &[DVec3; 2]) -> DMat2 {
        let [u, v] = *tangents;
        match self.free {
            0 => DMat2::ZERO,
            1 => DMat2::from_diagonal(DVec2::new(1.0 / u.length_squared(), 0.0)),
            _ => {
                let mixed = u.dot(v);
                DMat2::from_cols(
                    DVec2::new(u.length_squared(), mixed),
                    DVec2::new(mixed, v.length_squared()),
                )
                .inverse()
            }
        }
    }
}

#[inline]
fn combine(weights: &[f64; 4], x: &[DVec3; 4]) -> DVec3 {
    weights.iter().zip(x).map(|(&w, &p)| p * w).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Sample {
        name: &'static str,
        is_facet: bool,
        x: [DVec3; 4],
        free: usize,
    }

    impl Sample {
        fn closest(&self, x: &[DVec3; 4]) -> Closest {
            if self.is_facet { Closest::vertex_facet(x) } else { Closest::edge_edge(x) }
        }
    }

    fn samples() -> Vec<Sample> {
        let v = DVec3::new;
        let facet = |name, p, free| Sample {
            name,
            is_facet: true,
            x: [p, v(0.0, 0.1, 0.0), v(1.0, -0.1, 0.1), v(0.2, 1.1, -0.1)],
            free,
        };
        let edges = |name, c, d, free| Sample {
            name,
            is_facet: false,
            x: [v(0.0, 0.0, 0.0), v(1.0, 0.1, 0.0), c, d],
            free,
        };
        let far = v(0.6, 0.7, 0.03);
        vec![
            facet("inside a facet", v(0.4, 0.4, 0.03), 2),
            facet("beside an edge", v(0.5, -0.3, 0.05), 1),
            facet("beside another edge", v(-0.3, 0.6, 0.05), 1),
            facet("beside the third edge", v(0.9, 0.8, 0.05), 1),
            facet("off a corner", v(-0.5, -0.3, 0.05), 0),
            facet("off another corner", v(1.5, -0.5, 0.05), 0),
            facet("off the third corner", v(0.2, 1.6, 0.05), 0),
            edges("crossing edges", v(0.4, -0.5, 0.02), far, 2),
            edges("an edge and an end", v(0.4, 0.2, 0.02), far, 1),
            edges("two ends", v(1.4, 0.2, 0.02), v(1.6, 0.7, 0.03), 0),
        ]
    }

    #[test]
    fn every_kind_of_closest_points_has_the_parameters_it_should() {
        for sample in samples() {
            assert_eq!(sample.closest(&sample.x).free, sample.free, "{}", sample.name);
        }
    }

    #[test]
    fn the_distance_is_the_least_over_dense_samples() {
        for sample in samples() {
            let x = &sample.x;
            let found = sample.closest(x).distance;
            let mut least = f64::INFINITY;
            let n = 300;
            for (i, j) in (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j))) {
                let (s, t) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(n));
                let r = if sample.is_facet {
                    x[0] - x[1] - (x[2] - x[1]) * (s * (1.0 - t)) - (x[3] - x[1]) * t
                } else {
                    x[0].lerp(x[1], s) - x[2].lerp(x[3], t)
                };
                least = least.min(r.length());
            }
            let name = sample.name;
            assert!(found <= least + 1e-12 && found > least - 2e-3, "{name}: {found} {least}");
        }
    }

    #[test]
    fn gradient_and_hessian_agree_with_central_differences() {
        for sample in samples() {
            let gradient = sample.closest(&sample.x).gradient();
            let mut hessian = [[DMat3::ZERO; 4]; 4];
            let closest = sample.closest(&sample.x);
            closest.add_hessian(&sample.x, 1.0, &mut hessian);
            for (node, axis) in (0..4).flat_map(|node| (0..3).map(move |axis| (node, axis))) {
                let h = 1e-6;
                let shifted = |sign: f64| {
                    let mut y = sample.x;
                    y[node][axis] += sign * h;
                    sample.closest(&y)
                };
                let (above, below) = (shifted(1.0), shifted(-1.0));
                let slope = (above.distance - below.distance) / (2.0 * h);
                assert!((slope - gradient[node][axis]).abs() < 1e-8, "{}", sample.name);
                for (row, blocks) in hessian.iter().enumerate() {
                    let change = (above.gradient()[row] - below.gradient()[row]) / (2.0 * h);
                    let error = change.distance(blocks[node].col(axis));
                    assert!(error < 1e-5, "{} {row} {node}: {error}", sample.name);
                }
            }
        }
    }
}
