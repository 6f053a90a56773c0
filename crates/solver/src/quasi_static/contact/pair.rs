//! A pair of primitives that can meet.

use glam::DVec3;

use super::closest::Closest;

/// Edges push less where their squared sine is below this (in the lengths of the sheet at rest): between parallel edges
/// the closest points jump.
const MOLLIFIED: f64 = 1e-3;

/// The kinds of primitives that meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum PairKind {
    /// Vertex x₀ and facet x₁x₂x₃.
    VertexFacet,
    /// Edges x₀x₁ and x₂x₃.
    EdgeEdge,
}

impl PairKind {
    /// The closest points of two primitives with the corners `x`.
    #[inline]
    pub(super) fn closest(self, x: &[DVec3; 4]) -> Closest {
        match self {
            Self::VertexFacet => Closest::vertex_facet(x),
            Self::EdgeEdge => Closest::edge_edge(x),
        }
    }
}

/// Two primitives that share no vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ContactPair {
    pub(super) kind: PairKind,
    pub(super) nodes: [u32; 4],
    /// The triangles it was found from.
    pub(super) faces: [u32; 2],
    /// The gap g.
    pub(super) gap: f64,
    /// ε; 0 for a vertex and a facet.
    pub(super) mollifier: f64,
    /// λ of the last equilibrium.
    pub(super) multiplier: f64,
    /// κ over that of pairs whose multiplier alone suffices.
    pub(super) stiffening: f64,
    /// Whether its last plane was that of its facet.
    pub(super) is_on_facet: bool,
    /// Whether its last plane pushed.
    pub(super) pushes: bool,
    /// Whether a plane is held for it in this step.
    pub(super) has_plane: bool,
}

impl ContactPair {
    pub(super) fn new(
        kind: PairKind,
        nodes: [u32; 4],
        faces: [u32; 2],
        gap: f64,
        mollifier: f64,
    ) -> Self {
        Self {
            kind,
            nodes,
            faces,
            gap,
            mollifier,
            multiplier: 0.0,
            stiffening: 1.0,
            is_on_facet: false,
            pushes: false,
            has_plane: false,
        }
    }

    /// Whether anything is known of it that a new search has to carry over.
    pub(super) fn is_known(&self) -> bool {
        self.multiplier > 0.0 || self.is_on_facet || self.pushes || self.has_plane
    }

    /// ε for edges of these rest lengths.
    pub(super) fn mollifier(lengths: [f64; 2]) -> f64 {
        MOLLIFIED * (lengths[0] * lengths[1]).powi(2)
    }

    pub(super) fn key(&self) -> (PairKind, [u32; 4]) {
        (self.kind, self.nodes)
    }

    #[inline]
    pub(super) fn corners(&self, positions: &[DVec3]) -> [DVec3; 4] {
        self.nodes.map(|v| positions[v as usize])
    }

    #[inline]
    pub(super) fn closest(&self, x: &[DVec3; 4]) -> Closest {
        self.kind.closest(x)
    }

    /// A lower bound of the distance: between the boxes of the two.
    #[inline]
    pub(super) fn least_distance(&self, x: &[DVec3; 4]) -> f64 {
        let ([low, high], [other_low, other_high]) = match self.kind {
            PairKind::VertexFacet => {
                ([x[0], x[0]], [x[1].min(x[2]).min(x[3]), x[1].max(x[2]).max(x[3])])
            }
            PairKind::EdgeEdge => {
                ([x[0].min(x[1]), x[0].max(x[1])], [x[2].min(x[3]), x[2].max(x[3])])
            }
        };
        (low - other_high).max(other_low - high).max(DVec3::ZERO).length()
    }

    /// By how much the first of the two lies further along the unit vector `along` than the second.
    #[inline]
    pub(super) fn separation_along(&self, along: DVec3, x: &[DVec3; 4]) -> f64 {
        let [a, b, c, d] = x.map(|corner| along.dot(corner));
        match self.kind {
            PairKind::VertexFacet => a - b.max(c).max(d),
            PairKind::EdgeEdge => a.min(b) - c.max(d),
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

    /// The share of the stiffness that edges have at their angle: m(|u × v|²/ε), m(x) = 2x − x² below 1 and 1 above
    /// (the mollifier of Li et al. 2020, "Incremental potential contact").
    pub(super) fn share(&self, x: &[DVec3; 4]) -> f64 {
        let ratio = (x[1] - x[0]).cross(x[3] - x[2]).length_squared() / self.mollifier;
        if ratio >= 1.0 { 1.0 } else { ratio * (2.0 - ratio) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edges(x: &[DVec3; 4]) -> ContactPair {
        let lengths = [x[0].distance(x[1]), x[2].distance(x[3])];
        let mollifier = ContactPair::mollifier(lengths);
        ContactPair::new(PairKind::EdgeEdge, [0, 1, 2, 3], [0, 1], 1e-3, mollifier)
    }

    fn random_pair(random: &mut fastrand::Rng) -> (ContactPair, [DVec3; 4]) {
        let x: [DVec3; 4] =
            std::array::from_fn(|_| DVec3::from_array(std::array::from_fn(|_| random.f64())));
        let mut pair = edges(&x);
        if random.bool() {
            pair.kind = PairKind::VertexFacet;
        }
        (pair, x)
    }

    #[test]
    fn edges_push_with_all_their_stiffness_unless_they_are_nearly_parallel() {
        let v = DVec3::new;
        let at = |sine: f64| {
            let x = [v(0.0, 0.0, 0.0), v(1.0, 0.0, 0.0), v(0.0, 0.0, 0.1), v(1.0, sine, 0.1)];
            edges(&x).share(&x)
        };
        assert_eq!(at(0.5), 1.0);
        assert_eq!(at(0.0), 0.0);
        assert!(at(0.01) > 0.1 && at(0.01) < 0.3, "{}", at(0.01));
    }

    #[test]
    fn the_distance_is_never_below_its_lower_bound() {
        let mut random = fastrand::Rng::with_seed(3);
        for _ in 0..500 {
            let (pair, x) = random_pair(&mut random);
            assert!(pair.least_distance(&x) <= pair.closest(&x).distance + 1e-12);
        }
    }

    #[test]
    fn the_distance_never_changes_faster_than_the_bound_of_the_speed() {
        let mut random = fastrand::Rng::with_seed(4);
        for _ in 0..500 {
            let (pair, x) = random_pair(&mut random);
            let (_, d) = random_pair(&mut random);
            let moved = std::array::from_fn(|i| x[i] + d[i]);
            let change = pair.closest(&moved).distance - pair.closest(&x).distance;
            assert!(change.abs() <= pair.speed(&d) + 1e-12);
        }
    }
}
