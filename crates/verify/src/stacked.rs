//! The claims of the file about faces that lie a gap apart.

use std::collections::BTreeMap;

use foldmotion_pattern::{LayerOrder, Sheet};
use glam::{DVec2, DVec3};

use crate::layer::{LayerTolerances, corners};
use crate::plane::{self, Plane};

/// Faces are stacked if their planes are within 20° of each other (the cosine), and they come within this many units of
/// length of each other somewhere.
const PARALLEL: f64 = 0.94;
const NEAR: f64 = 0.1;
/// Conditions that are met or missed by less than this share may be judged differently by another proof.
const DOUBTFUL: f64 = 1e-3;

/// What became of the claims about faces that are not layers in contact.
#[derive(Debug, Default)]
pub(crate) struct StackingResult {
    /// The number of claims that hold.
    pub(crate) held: usize,
    /// The first false claim: the two faces and the sign.
    pub(crate) refuted: Option<[i64; 3]>,
    /// The triangles of the first claim that another proof may judge differently.
    pub(crate) doubtful: Option<[u32; 2]>,
}

/// The heights of the first of two triangles above the front of the second.
struct HeightRange {
    triangles: [u32; 2],
    low: f64,
    high: f64,
    is_doubtful: bool,
}

/// A state of the sheet, with the faces of the file.
pub(crate) struct SheetState<'a> {
    pub(crate) sheet: &'a Sheet,
    pub(crate) positions: &'a [DVec3],
    pub(crate) face_of: &'a dyn Fn(u32) -> u32,
    pub(crate) scale: LayerTolerances,
}

impl SheetState<'_> {
    /// Judges the entries of `order` for which `is_open` returns true.
    pub(crate) fn judge(
        &self,
        order: &LayerOrder,
        is_open: impl Fn((u32, u32)) -> bool,
    ) -> StackingResult {
        let mut stacked = StackingResult::default();
        let open: Vec<_> = order.iter().filter(|&(f, g, _)| is_open((f, g))).collect();
        if open.is_empty() {
            return stacked;
        }
        let mut triangles: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for triangle in 0..self.sheet.faces.len() as u32 {
            let face = (self.face_of)(triangle);
            triangles.entry(face).or_default().push(triangle);
        }
        let of = |face| triangles.get(&face).into_iter().flatten().copied();
        for (f, g, sign) in open {
            let ranges: Vec<HeightRange> =
                of(f).flat_map(|a| of(g).filter_map(move |b| self.heights(a, b))).collect();
            let sign_of = |height: f64| height * f64::from(sign);
            let ends = ranges.iter().flat_map(|s| [sign_of(s.low), sign_of(s.high)]);
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            for end in ends {
                (low, high) = (low.min(end), high.max(end));
            }
            let tolerance = self.scale.tolerance;
            if low >= -tolerance && high > tolerance {
                stacked.held += 1;
            } else if high <= tolerance && low < -tolerance {
                let entry = [i64::from(f), i64::from(g), i64::from(sign)];
                stacked.refuted = stacked.refuted.or(Some(entry));
            }
            let is_close = |height: f64| (height.abs() - tolerance).abs() <= DOUBTFUL * tolerance;
            let doubtful = ranges.iter().find(|s| s.is_doubtful || is_close(low) || is_close(high));
            stacked.doubtful = stacked.doubtful.or(doubtful.map(|s| s.triangles));
        }
        stacked
    }

    /// The heights of triangle `a` above the front of `b`, where both overlap; `None` if they are not stacked.
    fn heights(&self, a: u32, b: u32) -> Option<HeightRange> {
        let triangles = [a, b];
        let [a, b] = triangles.map(|face| corners(self.sheet, self.positions, face));
        let (of_a, of_b) = (Plane::of(&a)?, Plane::of(&b)?);
        let along = of_a.normal.dot(of_b.normal).abs() / PARALLEL - 1.0;
        let (seen_a, seen_b) = (of_b.triangle(&a), of_b.triangle(&b));
        let overlap = plane::overlap(&seen_a, &seen_b) / self.scale.narrow() - 1.0;
        if along.min(overlap) < -DOUBTFUL {
            return None;
        }
        let lifted = a.map(|p| (of_b.seen(p), of_b.height(p)));
        let common = plane::within(&seen_a, &seen_b);
        let heights = common.into_iter().map(|point| height_at(point, &lifted));
        let (low, high) =
            heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        let gap = low.max(-high).max(0.0);
        let near = 1.0 - gap / (NEAR * self.sheet.unit_length);
        let least = along.min(overlap).min(near);
        (least >= 0.0).then_some(HeightRange {
            triangles,
            low,
            high,
            is_doubtful: least <= DOUBTFUL,
        })
    }
}

/// The height at `point` of the plane through three points with heights.
fn height_at(point: DVec2, [(p, at_p), (q, at_q), (r, at_r)]: &[(DVec2, f64); 3]) -> f64 {
    let area = (*q - *p).perp_dot(*r - *p);
    let of_q = (point - *p).perp_dot(*r - *p) / area;
    let of_r = (*q - *p).perp_dot(point - *p) / area;
    at_p + of_q * (at_q - at_p) + of_r * (at_r - at_p)
}
