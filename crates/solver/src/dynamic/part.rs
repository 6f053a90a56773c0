//! A part of a group of records, and the elements in it.

use pulp::Simd;

use super::lanes::{Lanes, Quad, Vectors, WIDTH};
use super::layout::{EdgeGroup, FaceGroup};

/// Squared lengths and areas are taken for no less, so that an element pressed to a point does nothing.
pub(super) const LEAST_SQUARE: f64 = 1e-280;

/// The part of a group that fills the lanes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Part<S: Simd> {
    pub(super) simd: S,
    pub(super) index: usize,
}

/// Edges, from their first end: to the second, to the apexes on the left and on the right.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge<S: Simd> {
    pub(super) e: Vectors<S>,
    pub(super) a: Vectors<S>,
    pub(super) b: Vectors<S>,
}

/// Triangles.
#[derive(Debug, Clone, Copy)]
pub(super) struct Face<S: Simd> {
    /// The sides opposite to the corners, counter-clockwise.
    pub(super) sides: [Vectors<S>; 3],
    /// At each corner the dot product of the sides that leave it.
    pub(super) dots: [Lanes<S>; 3],
    /// Twice the area, along the front normal.
    pub(super) normal: Vectors<S>,
    /// Its square.
    pub(super) square: Lanes<S>,
}

impl<S: Simd> Part<S> {
    #[inline(always)]
    pub(super) fn numbers(self, group: &[f64; WIDTH]) -> Lanes<S> {
        Lanes::load(self.simd, group, self.index)
    }

    /// The `numbers` at these `indices`.
    #[inline(always)]
    pub(super) fn gathered(self, numbers: &[f64], indices: &[u16; WIDTH]) -> Lanes<S> {
        let mut group = [0.0; WIDTH];
        for lane in 0..S::F64_LANES {
            group[lane] = numbers[indices[self.index * S::F64_LANES + lane] as usize];
        }
        Lanes::load(self.simd, &group, 0)
    }

    /// The `points` at these `indices`.
    #[inline(always)]
    pub(super) fn vectors(self, points: &[Quad], indices: &[u16; WIDTH]) -> Vectors<S> {
        let first = self.index * S::F64_LANES;
        Vectors::gather(self.simd, points, &indices[first..first + S::F64_LANES])
    }

    #[inline(always)]
    pub(super) fn edge(self, positions: &[Quad], record: &EdgeGroup) -> Edge<S> {
        let start = self.vectors(positions, &record.vertices[0]);
        Edge {
            e: self.vectors(positions, &record.vertices[1]) - start,
            a: self.vectors(positions, &record.vertices[2]) - start,
            b: self.vectors(positions, &record.vertices[3]) - start,
        }
    }

    #[inline(always)]
    pub(super) fn face(self, positions: &[Quad], record: &FaceGroup) -> Face<S> {
        let a = self.vectors(positions, &record.vertices[0]);
        let b = self.vectors(positions, &record.vertices[1]);
        let c = self.vectors(positions, &record.vertices[2]);
        let (ea, eb, ec) = (c - b, a - c, b - a);
        let normal = ec.cross(ea);
        let zero = Lanes::splat(self.simd, 0.0);
        Face {
            sides: [ea, eb, ec],
            dots: [zero - eb.dot(ec), zero - ec.dot(ea), zero - ea.dot(eb)],
            normal,
            square: normal.dot(normal).max(zero.constant(LEAST_SQUARE)),
        }
    }
}
