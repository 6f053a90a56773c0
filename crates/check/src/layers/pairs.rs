//! Which triangles are layers of each other at a frame, and in which order.

use foldmotion_geometry::collide::Side;
use foldmotion_pattern::{LayerOrder, Sheet};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::{NARROW, flat};

/// A direction points to a side of a layer if its cosine with the normal is greater than this: it is within 60° of the
/// normal.
const CLEAR: f64 = 0.5;

/// Two triangles that lie on each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LayerPair {
    /// The two triangles, the smaller index first.
    pub(crate) faces: [u32; 2],
    /// The unit normal along which the first lies below the second; `None` if the order is unknown.
    pub(crate) up: Option<DVec3>,
    /// Whether they have passed through each other, so that their order has no meaning.
    pub(crate) is_lost: bool,
}

pub(crate) fn front_normal(sheet: &Sheet, face: u32, positions: &[DVec3]) -> DVec3 {
    let [p, q, r] = sheet.faces[face as usize].map(|v| positions[v as usize]);
    (q - p).cross(r - p).normalize_or_zero()
}

/// The pairs among `sides` that are layers, in the order of `sides`. A pair without a side gets no order.
pub(crate) fn layer_pairs(
    sheet: &Sheet,
    positions: &[DVec3],
    sides: &[((u32, u32), Option<&Side>)],
    tolerance: f64,
) -> Vec<LayerPair> {
    let faces = 0..sheet.faces.len() as u32;
    let normals: Vec<DVec3> = faces.map(|f| front_normal(sheet, f, positions)).collect();
    let corners = |face: u32| sheet.faces[face as usize].map(|v| positions[v as usize]);
    let layers = |&((f, g), side): &((u32, u32), Option<&Side>)| {
        let [n, m] = [f, g].map(|face| normals[face as usize]);
        if n.dot(m).abs() < CLEAR {
            return None;
        }
        let (a, b) = (corners(f), corners(g));
        let is_near = |t: &[DVec3; 3], at: DVec3, normal: DVec3| {
            t.iter().all(|p| normal.dot(*p - at).abs() <= tolerance)
        };
        if !is_near(&b, a[0], n) && !is_near(&a, b[0], m) {
            return None;
        }
        let (x, y) = n.any_orthonormal_pair();
        let flat = |t: [DVec3; 3]| t.map(|p| DVec2::new(x.dot(p - a[0]), y.dot(p - a[0])));
        flat::overlap(&flat(a), &flat(b), NARROW * tolerance).then(|| LayerPair {
            faces: [f, g],
            up: side.and_then(|side| upward(side, n)),
            is_lost: false,
        })
    };
    sides.par_iter().with_min_len(256).filter_map(layers).collect()
}

/// `normal` or its opposite, whichever side all directions point to; `None` if they disagree.
fn upward(side: &Side, normal: DVec3) -> Option<DVec3> {
    let agree = |axes: &[DVec3], normal: DVec3| axes.iter().all(|d| d.dot(normal) > CLEAR);
    let axes = match side {
        Side::Apart(axis) => std::slice::from_ref(axis),
        Side::Contact(axes) => axes,
    };
    [normal, -normal].into_iter().find(|&n| agree(axes, n))
}

/// A point of the region that two layers have in common.
pub(crate) fn layer_point(sheet: &Sheet, positions: &[DVec3], [f, g]: [u32; 2]) -> DVec3 {
    let corners = |face: u32| sheet.faces[face as usize].map(|v| positions[v as usize]);
    let origin = corners(f)[0];
    let (x, y) = front_normal(sheet, f, positions).any_orthonormal_pair();
    let triangles = [f, g].map(|face| {
        let flat = |p: DVec3| DVec2::new(x.dot(p - origin), y.dot(p - origin));
        flat::counter_clockwise(corners(face).map(flat))
    });
    let middle = flat::middle(&flat::common(&triangles));
    origin + x * middle.x + y * middle.y
}

/// The known orders of `pairs` with the signs of FOLD, in both directions.
pub(crate) fn order_of(sheet: &Sheet, positions: &[DVec3], pairs: &[LayerPair]) -> LayerOrder {
    let mut order = LayerOrder::default();
    for pair in pairs {
        let Some(up) = pair.up else { continue };
        let [f, g] = pair.faces;
        let sign = |face: u32, towards: DVec3| {
            let is_front = front_normal(sheet, face, positions).dot(towards) > 0.0;
            if is_front { 1 } else { -1 }
        };
        order.insert(g, f, sign(f, up));
        order.insert(f, g, sign(g, -up));
    }
    order
}
