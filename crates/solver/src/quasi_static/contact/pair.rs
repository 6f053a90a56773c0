//! A pair of primitives in contact: its barrier and the derivatives of it.
//!
//! With the separation δ = D − g, D the distance and g the gap of the pair, the barrier of Li et al. 2020 ("Incremental
//! potential contact"), offset by the gap as in Li, Kaufman, Jiang 2021 ("Codimensional incremental potential
//! contact"), is
//!
//! B = F d̂ β(δ/d̂),  β(y) = −(y − 1)² ln y for 0 < y < 1, 0 above,
//!
//! so that F is a force: the barrier pushes by 1.19 F at δ = d̂/2. For edges it is multiplied by the mollifier
//! m(c/ε), m(x) = 2x − x² below 1 and 1 above, of c = |u × v|², ε = 10⁻³ |u₀|²|v₀|²: parallel edges, between which the
//! closest points jump, leave their contact to the vertices at their ends.

use glam::{DMat3, DVec3};

use super::super::element_stiffness::Curvature;
use super::super::hinge_hessian::outer;
use super::closest::Closest;

/// Mollified are edges whose squared sine is below this (in the lengths of the sheet at rest).
const MOLLIFIED: f64 = 1e-3;

/// The kinds of primitives that meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum PairKind {
    /// Vertex x₀ and facet x₁x₂x₃.
    VertexFacet,
    /// Edges x₀x₁ and x₂x₃.
    EdgeEdge,
}

/// Two primitives that share no vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ContactPair {
    pub(super) kind: PairKind,
    pub(super) nodes: [u32; 4],
    /// The triangles it was found from.
    pub(super) faces: [u32; 2],
    /// The gap g of the barrier.
    pub(super) gap: f64,
    /// The reach d̂ of the barrier.
    pub(super) reach: f64,
    /// ε; 0 for a vertex and a facet.
    pub(super) mollifier: f64,
}

impl ContactPair {
    /// ε for edges of these rest lengths.
    pub(super) fn mollifier(lengths: [f64; 2]) -> f64 {
        MOLLIFIED * (lengths[0] * lengths[1]).powi(2)
    }

    #[inline]
    pub(super) fn corners(&self, positions: &[DVec3]) -> [DVec3; 4] {
        self.nodes.map(|v| positions[v as usize])
    }

    #[inline]
    pub(super) fn closest(&self, x: &[DVec3; 4]) -> Closest {
        match self.kind {
            PairKind::VertexFacet => Closest::vertex_facet(x),
            PairKind::EdgeEdge => Closest::edge_edge(x),
        }
    }

    /// A bound of how fast the distance changes while the corners move at the velocities `d`.
    #[inline]
    pub(super) fn speed(&self, d: &[DVec3; 4]) -> f64 {
        let mean = (d[0] + d[1] + d[2] + d[3]) * 0.25;
        let own = d.map(|v| (v - mean).length());
        match self.kind {
            PairKind::VertexFacet => own[0] + own[1].max(own[2]).max(own[3]),
            PairKind::EdgeEdge => own[0].max(own[1]) + own[2].max(own[3]),
        }
    }

    /// B m at the corners `x`; infinite where the gap is not kept.
    pub(super) fn energy(&self, x: &[DVec3; 4], force: f64) -> f64 {
        let y = (self.closest(x).distance - self.gap) / self.reach;
        if y >= 1.0 {
            return 0.0;
        }
        if y <= 0.0 {
            return f64::INFINITY;
        }
        force * self.reach * barrier(y)[0] * self.mollified(x).0
    }

    /// The force with which the pair is pressed together.
    pub(super) fn force(&self, x: &[DVec3; 4], force: f64) -> f64 {
        let y = (self.closest(x).distance - self.gap) / self.reach;
        if y <= 0.0 || y >= 1.0 {
            return 0.0;
        }
        -force * barrier(y)[1] * self.mollified(x).0
    }

    /// ∇(B m); `None` if the pair is out of reach.
    pub(super) fn gradient(&self, x: &[DVec3; 4], force: f64) -> Option<[DVec3; 4]> {
        let closest = self.closest(x);
        let y = (closest.distance - self.gap) / self.reach;
        if y >= 1.0 {
            return None;
        }
        let [value, slope, _] = barrier(y);
        let (m, by_cross) = self.mollified(x);
        let mut gradient = closest.gradient().map(|g| g * (force * slope * m));
        if by_cross > 0.0 {
            let cross = Cross::new(x);
            for (g, c) in gradient.iter_mut().zip(cross.gradient()) {
                *g += c * (by_cross * force * self.reach * value);
            }
        }
        Some(gradient)
    }

    /// Writes ∇∇(B m), or its positive semidefinite part m B″ ∇D ∇Dᵀ; false where the pair is out of reach.
    pub(super) fn hessian(
        &self,
        x: &[DVec3; 4],
        force: f64,
        curvature: Curvature,
        hessian: &mut [[DMat3; 4]; 4],
    ) -> bool {
        let closest = self.closest(x);
        let y = (closest.distance - self.gap) / self.reach;
        if y >= 1.0 {
            return false;
        }
        let [value, slope, bend] = barrier(y);
        let (m, by_cross) = self.mollified(x);
        let normals = closest.gradient();
        let stiff = normals.map(|normal| normal * (m * force * bend / self.reach));
        for (row, &stiff) in hessian.iter_mut().zip(&stiff) {
            *row = normals.map(|normal| outer(stiff, normal));
        }
        if curvature == Curvature::Convex {
            return true;
        }
        closest.add_hessian(x, m * force * slope, hessian);
        if by_cross > 0.0 {
            let cross = Cross::new(x);
            let c = cross.gradient();
            let mixed = product(&c, &normals, by_cross * force * slope);
            let mixed_back = product(&normals, &c, by_cross * force * slope);
            let own = force * self.reach * value;
            let by_cross_twice = -2.0 / (self.mollifier * self.mollifier);
            let square = product(&c, &c, by_cross_twice * own);
            let bent = cross.hessian();
            for i in 0..4 {
                for j in 0..4 {
                    hessian[i][j] += mixed(i, j)
                        + mixed_back(i, j)
                        + square(i, j)
                        + bent[i][j] * (by_cross * own);
                }
            }
        }
        true
    }

    /// m and dm/dc.
    fn mollified(&self, x: &[DVec3; 4]) -> (f64, f64) {
        if self.kind == PairKind::VertexFacet {
            return (1.0, 0.0);
        }
        let ratio = (x[1] - x[0]).cross(x[3] - x[2]).length_squared() / self.mollifier;
        if ratio >= 1.0 {
            return (1.0, 0.0);
        }
        (ratio * (2.0 - ratio), 2.0 * (1.0 - ratio) / self.mollifier)
    }
}

/// β, β′ and β″ at 0 < y < 1.
fn barrier(y: f64) -> [f64; 3] {
    let (d, log) = (y - 1.0, y.ln());
    [-d * d * log, -2.0 * d * log - d * d / y, -2.0 * log - 4.0 * d / y + (d / y).powi(2)]
}

/// The blocks scale × u_i v_jᵀ.
fn product<'a>(
    u: &'a [DVec3; 4],
    v: &'a [DVec3; 4],
    scale: f64,
) -> impl Fn(usize, usize) -> DMat3 + 'a {
    move |i, j| outer(u[i], v[j]) * scale
}

fn blocks(block: impl Fn(usize, usize) -> DMat3) -> [[DMat3; 4]; 4] {
    std::array::from_fn(|i| std::array::from_fn(|j| block(i, j)))
}

/// c = |u × v|² = |u|²|v|² − (u·v)² of the edges u = x₁ − x₀ and v = x₃ − x₂.
struct Cross {
    u: DVec3,
    v: DVec3,
}

impl Cross {
    fn new(x: &[DVec3; 4]) -> Self {
        Self { u: x[1] - x[0], v: x[3] - x[2] }
    }

    fn gradient(&self) -> [DVec3; 4] {
        let Self { u, v } = *self;
        let by_u = (u * v.length_squared() - v * u.dot(v)) * 2.0;
        let by_v = (v * u.length_squared() - u * u.dot(v)) * 2.0;
        [-by_u, by_u, -by_v, by_v]
    }

    fn hessian(&self) -> [[DMat3; 4]; 4] {
        let Self { u, v } = *self;
        let eye = DMat3::IDENTITY;
        let uu = (eye * v.length_squared() - outer(v, v)) * 2.0;
        let vv = (eye * u.length_squared() - outer(u, u)) * 2.0;
        let uv = (outer(u, v) * 2.0 - eye * u.dot(v) - outer(v, u)) * 2.0;
        let in_edges = [[uu, uv], [uv.transpose(), vv]];
        let sign = |i: usize| if i.is_multiple_of(2) { -1.0 } else { 1.0 };
        blocks(|i, j| in_edges[i / 2][j / 2] * (sign(i) * sign(j)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pairs at about half of their reach: a vertex over a facet, crossing edges, nearly parallel edges.
    fn cases() -> [(ContactPair, [DVec3; 4]); 3] {
        let v = DVec3::new;
        let pair = |kind, mollifier| ContactPair {
            kind,
            nodes: [0, 1, 2, 3],
            faces: [0, 1],
            gap: 1e-2,
            reach: 2e-2,
            mollifier,
        };
        let edges = pair(PairKind::EdgeEdge, ContactPair::mollifier([1.0, 1.0]));
        let z = 0.018;
        [
            (
                pair(PairKind::VertexFacet, 0.0),
                [v(0.3, 0.3, z), v(0.0, 0.0, 0.0), v(1.0, 0.1, 0.0), v(0.0, 1.0, 0.0)],
            ),
            (edges, [v(0.0, 0.0, 0.0), v(1.0, 0.1, 0.0), v(0.4, -0.5, z), v(0.6, 0.7, z)]),
            (edges, [v(0.0, 0.0, 0.0), v(1.0, 0.0, 0.001), v(0.1, -0.01, z), v(1.1, 0.01, z)]),
        ]
    }

    #[test]
    fn the_gradient_of_the_barrier_agrees_with_central_differences() {
        for (pair, x) in cases() {
            let gradient = pair.gradient(&x, 3.0).unwrap();
            for node in 0..4 {
                for axis in 0..3 {
                    let energy = |sign: f64| {
                        let mut y = x;
                        y[node][axis] += sign * 1e-7;
                        pair.energy(&y, 3.0)
                    };
                    let difference = (energy(1.0) - energy(-1.0)) / 2e-7;
                    let error = (difference - gradient[node][axis]).abs();
                    assert!(error < 1e-5, "{:?} {node} {axis}: {error}", pair.kind);
                }
            }
        }
    }

    #[test]
    fn the_hessian_of_the_barrier_agrees_with_differences_of_the_gradient() {
        for (pair, x) in cases() {
            let mut hessian = [[DMat3::ZERO; 4]; 4];
            assert!(pair.hessian(&x, 3.0, Curvature::Exact, &mut hessian));
            for node in 0..4 {
                for axis in 0..3 {
                    let gradient = |sign: f64| {
                        let mut y = x;
                        y[node][axis] += sign * 1e-7;
                        pair.gradient(&y, 3.0).unwrap()
                    };
                    let (above, below) = (gradient(1.0), gradient(-1.0));
                    for row in 0..4 {
                        let difference = (above[row] - below[row]) / 2e-7;
                        let column = hessian[row][node].col(axis);
                        let error = difference.distance(column);
                        assert!(error < 1e-3 * (1.0 + column.length()), "{:?} {error}", pair.kind);
                    }
                }
            }
        }
    }

    #[test]
    fn the_barrier_is_infinite_at_the_gap_and_nothing_out_of_reach() {
        let (pair, mut x) = cases()[0];
        x[0].z = 0.0099;
        assert_eq!(pair.energy(&x, 1.0), f64::INFINITY);
        x[0].z = 0.0301;
        assert_eq!(pair.energy(&x, 1.0), 0.0);
        assert!(pair.gradient(&x, 1.0).is_none());
    }
}
