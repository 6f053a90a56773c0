//! Two triangles over a time interval, and the axes that may separate them.

use glam::DVec3;

use crate::path::Path;

/// Two triangles whose corners move straight from the first to the second of their positions.
///
/// `shared` corners (0, 1 or 2) are the same vertices and come first, in the same order, in both. Positions are
/// relative to a corner of the pair, so that rounding depends on the size of the pair and not on its position.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MovingPair {
    pub(crate) a: [[DVec3; 2]; 3],
    pub(crate) b: [[DVec3; 2]; 3],
    pub(crate) shared: usize,
    /// The point that positions are relative to.
    pub(crate) origin: DVec3,
    /// A bound of the distance between any two corners at any instant.
    pub(crate) size: f64,
    /// Whether a triangle is an edge or a point, represented with repeated corners.
    pub(crate) is_part: bool,
}

/// Two triangles at an instant.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PairPose {
    pub(crate) a: [DVec3; 3],
    pub(crate) b: [DVec3; 3],
}

/// The corners that lie exactly on the plane through the shared corners.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct OnPlane {
    pub(crate) a: [bool; 3],
    pub(crate) b: [bool; 3],
}

/// What an axis is built from; edge i runs from corner i to corner i + 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Feature {
    NormalA,
    NormalB,
    Edges(usize, usize),
    /// In the plane of A, normal to its edge.
    SideA(usize),
    SideB(usize),
    Coordinate(usize),
    /// In the plane of A, normal to an edge of B in it.
    AcrossA(usize),
    AcrossB(usize),
    /// In the plane of two edges, normal to that of A.
    BesideA,
    BesideB,
}

pub(crate) const COORDINATES: [DVec3; 3] = [DVec3::X, DVec3::Y, DVec3::Z];

impl MovingPair {
    /// `start`, `end`: the corners of A and of B at both ends of the interval.
    pub(crate) fn new(start: [[DVec3; 3]; 2], end: [[DVec3; 3]; 2], shared: usize) -> Self {
        let origin = start[0][0];
        let relative = |t: usize| [0, 1, 2].map(|i| [start[t][i] - origin, end[t][i] - origin]);
        let (a, b) = (relative(0), relative(1));
        let reach = a.iter().chain(&b).flatten().map(|p| p.length());
        Self { a, b, shared, origin, size: 2.0 * reach.fold(0.0, f64::max), is_part: false }
    }

    /// The features that can be axes: the face normals of A − B, the normals in the planes of the triangles, and three
    /// that never degenerate; for edges and points also those that replace degenerate ones.
    pub(crate) fn features(&self) -> impl Iterator<Item = Feature> + use<> {
        use Feature::{
            AcrossA, AcrossB, BesideA, BesideB, Coordinate, Edges, NormalA, NormalB, SideA, SideB,
        };
        let edges = (0..9).map(|k| Edges(k / 3, k % 3));
        let in_planes = (0..3).map(SideA).chain((0..3).map(SideB));
        let of_triangles = [NormalA, NormalB].into_iter().chain(edges).chain(in_planes);
        let across = (0..3).map(AcrossA).chain((0..3).map(AcrossB));
        let of_parts = across.chain([BesideA, BesideB]);
        let of_parts = self.is_part.then_some(of_parts).into_iter().flatten();
        of_triangles.chain((0..3).map(Coordinate)).chain(of_parts)
    }

    /// The positions at t in [0, 1].
    pub(crate) fn at(&self, t: f64) -> PairPose {
        let between = |c: [DVec3; 2]| {
            if t >= 1.0 { c[1] } else { c[0] + (c[1] - c[0]) * t }
        };
        PairPose { a: self.a.map(between), b: self.b.map(between) }
    }

    /// The pair between two instants; corners move straight there too.
    pub(crate) fn part(&self, from: &PairPose, to: &PairPose) -> Self {
        Self {
            a: [0, 1, 2].map(|i| [from.a[i], to.a[i]]),
            b: [0, 1, 2].map(|i| [from.b[i], to.b[i]]),
            ..*self
        }
    }

    /// The axis as a polynomial in time.
    pub(crate) fn path(&self, feature: Feature) -> Path {
        let edge = |corners: &[[DVec3; 2]; 3], i: usize| {
            let (p, q) = (corners[i], corners[(i + 1) % 3]);
            [q[0] - p[0], q[1] - p[1]]
        };
        let normal = |corners: &[[DVec3; 2]; 3]| Path::cross(edge(corners, 0), edge(corners, 1));
        match feature {
            Feature::NormalA => normal(&self.a),
            Feature::NormalB => normal(&self.b),
            Feature::Edges(i, j) => Path::cross(edge(&self.a, i), edge(&self.b, j)),
            Feature::SideA(i) => normal(&self.a).across(edge(&self.a, i)),
            Feature::SideB(j) => normal(&self.b).across(edge(&self.b, j)),
            Feature::AcrossA(j) => normal(&self.a).across(edge(&self.b, j)),
            Feature::AcrossB(i) => normal(&self.b).across(edge(&self.a, i)),
            Feature::BesideA | Feature::BesideB => {
                let (a, b) = (edge(&self.a, 0), edge(&self.b, 0));
                let along = if feature == Feature::BesideA { a } else { b };
                Path::cross(a, b).across(along)
            }
            Feature::Coordinate(k) => Path::straight(COORDINATES[k], COORDINATES[k]),
        }
    }

    /// Which corners lie on the plane of the axis through the shared corners, by construction.
    pub(crate) fn on_plane(&self, feature: Feature) -> OnPlane {
        let shared = [0, 1, 2].map(|i| i < self.shared);
        let mut on_plane = OnPlane { a: shared, b: shared };
        // Edges 0 and 2 start or end at corner 0.
        let mut lay = |is_b: bool, i: usize| {
            let corners = if is_b { &mut on_plane.b } else { &mut on_plane.a };
            corners[i] = true;
            corners[(i + 1) % 3] = true;
        };
        match feature {
            Feature::NormalA => on_plane.a = [true; 3],
            Feature::NormalB => on_plane.b = [true; 3],
            Feature::Edges(i, j) if i != 1 && j != 1 => {
                lay(false, i);
                lay(true, j);
            }
            Feature::SideA(i) if i != 1 => lay(false, i),
            Feature::SideB(j) if j != 1 => lay(true, j),
            _ => {}
        }
        on_plane
    }

    /// Both shared corners must lie on the plane: only these axes are normal to their edge.
    pub(crate) fn may_clear(&self, feature: Feature) -> bool {
        use Feature::{NormalA, NormalB, SideA, SideB};
        self.shared < 2 || matches!(feature, NormalA | NormalB | SideA(0) | SideB(0))
    }

    pub(crate) fn directed(&self, (feature, sign): (Feature, f64)) -> Path {
        let path = self.path(feature);
        if sign < 0.0 { path.reversed() } else { path }
    }
}

impl PairPose {
    /// The overlap max d·a − min d·b along a direction.
    pub(crate) fn overlap(&self, d: DVec3) -> f64 {
        let origin = self.a[0];
        let height = |p: DVec3| d.dot(p - origin);
        let ([p, q, r], [u, v, w]) = (self.a.map(height), self.b.map(height));
        p.max(q).max(r) - u.min(v).min(w)
    }
}
