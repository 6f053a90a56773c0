//! Which part of a triangle another one hides.

use glam::DVec2;

use super::LEAST_AREA;
use super::plane::{cut, doubled_area, tidy};
use crate::Surface;

/// Depths closer than this are equal, in pixels: of triangles in one plane without an order the first is in front.
const EQUAL_DEPTH: f64 = 1e-7;

/// The corners of triangle `face` on the screen, so that it runs along growing angles from x to y.
pub(super) fn triangle(surface: &Surface<'_>, face: u32) -> [DVec2; 3] {
    let corners = surface.paper().sheet.faces[face as usize];
    let [a, b, c] = corners.map(|v| surface.points()[v as usize].truncate());
    if (b - a).perp_dot(c - a) < 0.0 { [a, c, b] } else { [a, b, c] }
}

/// The convex part of triangle `back` that triangle `front` hides if it does so where it is nearer by `threshold`.
pub(super) fn hidden_part(
    surface: &Surface<'_>,
    front: u32,
    back: u32,
    threshold: f64,
) -> Option<Vec<DVec2>> {
    let [screen_front, screen_back] = [front, back].map(|face| surface.face(face));
    let ([low, high], [other_low, other_high]) = (screen_front.extent(), screen_back.extent());
    let is_apart = low.cmpgt(other_high).any() || high.cmplt(other_low).any();
    if is_apart || screen_front.is_edge_on() {
        return None;
    }
    let mut part = triangle(surface, front).to_vec();
    for side in screen_back.sides() {
        cut(&mut part, |p| side.distance(p));
    }
    if part.is_empty() {
        return None;
    }
    let gap = |p: DVec2| screen_front.plane(p) - screen_back.plane(p);
    if threshold == 0.0 && part.iter().all(|&p| gap(p).abs() < EQUAL_DEPTH) {
        part.truncate(if front < back { part.len() } else { 0 });
    } else {
        cut(&mut part, |p| gap(p) - threshold);
    }
    tidy(&mut part);
    (doubled_area(&part) > LEAST_AREA).then_some(part)
}
