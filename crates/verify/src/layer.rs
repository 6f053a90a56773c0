//! Which triangles lie on each other at an instant.

use foldmotion_pattern::Sheet;
use glam::DVec3;
use rayon::prelude::*;

use crate::plane::{self, Plane};

/// Overlaps, and distances of lines, up to this multiple of τ count as none.
pub(crate) const NARROW: f64 = 10.0;
/// The cosine of 60°: a direction points to a side of a triangle if it is within 60° of its normal, and planes that
/// differ by less count as parallel.
pub(crate) const CLEAR: f64 = 0.5;

/// Two triangles that lie on each other.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Layer {
    /// The two triangles, the smaller index first.
    pub(crate) faces: [u32; 2],
    /// The normal of the first triangle along which the first lies below the second; `None` if the order is unknown.
    pub(crate) up: Option<DVec3>,
    /// Whether they passed through each other.
    pub(crate) is_lost: bool,
    /// Why another proof may judge the pair differently.
    pub(crate) doubt: Option<&'static str>,
}

/// The tolerances used at an instant.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LayerTolerances {
    /// τ, a length.
    pub(crate) tolerance: f64,
    /// Values nearer than this to a limit may be on either side of it.
    pub(crate) slack: f64,
}

impl LayerTolerances {
    pub(crate) fn new(tolerance: f64, positions: &[DVec3]) -> Self {
        let extent = positions.iter().map(|p| p.length()).fold(0.0, f64::max);
        Self { tolerance, slack: (1e-6 * tolerance).max(64.0 * f64::EPSILON * extent) }
    }

    /// Lines nearer than this count as one, and smaller overlaps of layers count as none.
    pub(crate) fn narrow(&self) -> f64 {
        NARROW * self.tolerance
    }
}

pub(crate) fn corners(sheet: &Sheet, positions: &[DVec3], face: u32) -> [DVec3; 3] {
    sheet.faces[face as usize].map(|v| positions[v as usize])
}

/// The layers among some pairs, without their order.
///
/// Two triangles are layers if the corners of one lie within τ of the plane of the other, and the two overlap by more
/// than 10 τ, projected along the normal of the first.
pub(crate) fn find(
    sheet: &Sheet,
    positions: &[DVec3],
    near: &[[u32; 2]],
    scale: &LayerTolerances,
) -> Vec<Layer> {
    let found = near.par_iter().with_min_len(256).filter_map(|&faces| {
        let [a, b] = faces.map(|f| corners(sheet, positions, f));
        let margin = margin(&a, &b, scale);
        let doubt = (margin.abs() <= scale.slack).then_some("whether they lie on each other");
        (margin >= -scale.slack).then_some(Layer { faces, up: None, is_lost: false, doubt })
    });
    found.collect()
}

/// The margin of the condition for layers that is closest to failing, a length; negative if it fails.
fn margin(a: &[DVec3; 3], b: &[DVec3; 3], scale: &LayerTolerances) -> f64 {
    let (Some(p), Some(q)) = (Plane::of(a), Plane::of(b)) else {
        return f64::NEG_INFINITY;
    };
    let highest = |plane: &Plane, t: &[DVec3; 3]| {
        let heights = t.iter().map(|&c| plane.height(c).abs());
        heights.fold(0.0, f64::max)
    };
    let near = scale.tolerance - highest(&p, b).min(highest(&q, a));
    let along = (p.normal.dot(q.normal).abs() - CLEAR) * scale.tolerance;
    if near.min(along) < -scale.slack {
        return near.min(along);
    }
    let overlap = plane::overlap(&p.triangle(a), &p.triangle(b));
    near.min(along).min(overlap - scale.narrow())
}

/// `normal` or its opposite, whichever all directions point along; `None` if they do not agree.
pub(crate) fn side_of(normal: DVec3, directions: &[DVec3]) -> Option<DVec3> {
    let points = |n: DVec3| directions.iter().all(|d| d.dot(n) > CLEAR);
    [normal, -normal].into_iter().find(|&n| !directions.is_empty() && points(n))
}
