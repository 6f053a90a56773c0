//! Whether facets that lie a gap apart are stacked as a file claims.

use std::collections::BTreeMap;

use foldmotion_pattern::{LayerOrder, Sheet};
use glam::{DVec2, DVec3};

use super::{NARROW, flat, front_normal};

/// Facets are stacked only if the cosine of the angle between their planes is at least this: 20°.
const PARALLEL: f64 = 0.94;
/// Facets are stacked only if the gap between them is at most this somewhere, in unit lengths of the sheet.
const NEAR: f64 = 0.1;

/// How the claims about facets that are not layers in contact compare with a state of the sheet.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct StackingResult {
    /// The number of claims that hold.
    pub(crate) held: usize,
    /// The first false claim: the two faces and the sign.
    pub(crate) refuted: Option<(u32, u32, i8)>,
}

/// A state of the sheet, with the faces of the file that its triangles belong to.
pub(crate) struct FaceStack<'a> {
    pub(crate) sheet: &'a Sheet,
    pub(crate) positions: &'a [DVec3],
    pub(crate) face_of: &'a dyn Fn(u32) -> u32,
    /// τ, in the unit of the positions.
    pub(crate) tolerance: f64,
}

impl FaceStack<'_> {
    /// Compares `claims`, faces with the sign of FOLD, with the heights of the first face above the front of the second
    /// where both cover the same points.
    pub(crate) fn compare(&self, claims: impl Iterator<Item = (u32, u32, i8)>) -> StackingResult {
        let mut claims = claims.peekable();
        let mut stacked = StackingResult::default();
        if claims.peek().is_none() {
            // Most frames have no such claims; then the faces need not be sorted.
            return stacked;
        }
        let triangles = self.triangles();
        for claim in claims {
            match self.holds(&triangles, claim) {
                Some(true) => stacked.held += 1,
                Some(false) => stacked.refuted = stacked.refuted.or(Some(claim)),
                None => {}
            }
        }
        stacked
    }

    /// `order` without the claims that are false.
    pub(crate) fn without_false(&self, order: &LayerOrder) -> LayerOrder {
        let triangles = self.triangles();
        let mut kept = LayerOrder::default();
        for claim @ (f, g, sign) in order.iter() {
            if self.holds(&triangles, claim) != Some(false) {
                kept.insert(f, g, sign);
            }
        }
        kept
    }

    /// The triangles of each face of the file.
    fn triangles(&self) -> BTreeMap<u32, Vec<u32>> {
        let mut triangles: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for triangle in 0..self.sheet.faces.len() as u32 {
            let face = (self.face_of)(triangle);
            triangles.entry(face).or_default().push(triangle);
        }
        triangles
    }

    /// Whether a claim holds: it is true if all of the first face lies on the claimed side, up to τ, and false if all
    /// of it lies on the other side. `None` if the faces are not stacked, or cross.
    fn holds(
        &self,
        triangles: &BTreeMap<u32, Vec<u32>>,
        (f, g, sign): (u32, u32, i8),
    ) -> Option<bool> {
        let of = |face: u32| triangles.get(&face).map_or(&[][..], Vec::as_slice);
        let pairs = of(f).iter().flat_map(|&a| of(g).iter().map(move |&b| (a, b)));
        let heights = pairs.filter_map(|(a, b)| self.heights(a, b));
        let spans = heights.map(|[low, high]| match sign {
            1 => [low, high],
            _ => [-high, -low],
        });
        let empty = [f64::INFINITY, f64::NEG_INFINITY];
        let [low, high] = spans.fold(empty, |a, b| [a[0].min(b[0]), a[1].max(b[1])]);
        if low >= -self.tolerance && high > self.tolerance {
            Some(true)
        } else if high <= self.tolerance && low < -self.tolerance {
            Some(false)
        } else {
            None
        }
    }

    /// The smallest and the largest height of triangle `a` above the front of `b`, where both cover the plane of `b`;
    /// `None` if they are not stacked.
    fn heights(&self, a: u32, b: u32) -> Option<[f64; 2]> {
        let corners =
            |face: u32| self.sheet.faces[face as usize].map(|v| self.positions[v as usize]);
        let [n, m] = [a, b].map(|face| front_normal(self.sheet, face, self.positions));
        if n.dot(m).abs() < PARALLEL {
            return None;
        }
        let (a, b) = (corners(a), corners(b));
        let (x, y) = m.any_orthonormal_pair();
        let flat = |t: [DVec3; 3]| {
            let points = t.map(|p| DVec2::new(x.dot(p - b[0]), y.dot(p - b[0])));
            flat::counter_clockwise(points)
        };
        let both = [flat(a), flat(b)];
        if !flat::overlap(&both[0], &both[1], NARROW * self.tolerance) {
            return None;
        }
        let height = |p: DVec2| n.dot(a[0] - (b[0] + x * p.x + y * p.y)) / n.dot(m);
        let heights = flat::common(&both).into_iter().map(height);
        let empty = [f64::INFINITY, f64::NEG_INFINITY];
        let [low, high] = heights.fold(empty, |[low, high], h| [low.min(h), high.max(h)]);
        let gap = if low <= 0.0 && high >= 0.0 { 0.0 } else { low.abs().min(high.abs()) };
        (gap <= NEAR * self.sheet.unit_length).then_some([low, high])
    }
}

/// The claims of `order` about pairs of faces that are not in `used`.
pub(crate) fn unused_claims(
    order: &LayerOrder,
    used: impl Fn(&(u32, u32)) -> bool,
) -> impl Iterator<Item = (u32, u32, i8)> {
    order.iter().filter(move |&(f, g, _)| !used(&(f, g)))
}
