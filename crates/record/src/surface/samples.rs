//! What triangles and lines show at the samples of a pixel, in the vectors of the machine.
//!
//! The loops over samples have no branches; each is compiled for several instruction sets and the machine's is taken at
//! run time. Products and sums are never fused, so the picture is the same with all of them.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into the function of an instruction set is compiled for it"
)]

use glam::DVec2;
use pulp::{Simd, WithSimd};

use super::{Layer, Surface};
use crate::screen_face::ScreenFace;
use crate::square::{CORNER, Mask, SAMPLES, Square, at_samples, mask, members, sample};

/// The lines of `edges` at the samples of the pixel around `centre`.
pub(super) struct FindLines<'a> {
    pub(super) surface: &'a Surface<'a>,
    pub(super) edges: &'a [u32],
    pub(super) centre: DVec2,
    pub(super) found: &'a mut Vec<(u32, Mask)>,
}

impl WithSimd for FindLines<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { surface, edges, centre, found } = self;
        let mut nearest = [surface.half_width * surface.half_width; SAMPLES];
        for &edge in edges {
            if !surface.may_have_line(edge, &Square::pixel(centre)) {
                continue;
            }
            let segment = &surface.segments[edge as usize];
            let distances = at_samples(centre, |point| segment.nearest(point).0);
            let mut nearer = 0;
            for (k, least) in nearest.iter_mut().enumerate() {
                let is_nearer = distances[k] < *least;
                nearer |= Mask::from(is_nearer) << k;
                *least = if is_nearer { distances[k] } else { *least };
            }
            for (_, farther) in &mut *found {
                *farther &= !nearer;
            }
            found.push((edge, nearer));
        }
    }
}

/// Triangle `face` at the samples of the pixel around `centre`, added to `layers` where it may be seen.
pub(super) struct FindLayer<'a> {
    pub(super) surface: &'a Surface<'a>,
    pub(super) face: u32,
    pub(super) centre: DVec2,
    pub(super) layers: &'a mut Vec<Layer>,
}

impl WithSimd for FindLayer<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { surface, face, centre, layers } = self;
        let screen = surface.face(face);
        let covered = covered(screen, centre);
        let mut outlined = 0;
        let mut outlines = [0.0; SAMPLES];
        if covered != Mask::MAX && screen.reach > 0.0 {
            outlined = find_outlines(surface, face, centre, !covered, &mut outlines);
        }
        if covered | outlined == 0 {
            return;
        }
        let mut depths = at_samples(centre, |point| screen.depth(point));
        for k in members(outlined) {
            depths[k] = outlines[k];
        }
        layers.push(Layer { face, covered, outlined, depths });
    }
}

/// The samples of the pixel around `centre` that `face` covers.
#[inline(always)]
fn covered(face: &ScreenFace, centre: DVec2) -> Mask {
    let mut covered = Mask::MAX;
    for side in face.sides() {
        let middle = side.distance(centre);
        if middle > CORNER {
            continue;
        }
        if middle < -CORNER {
            return 0;
        }
        let distances = at_samples(centre, |point| side.distance(point));
        covered &= mask(&distances, |distance| distance >= 0.0);
    }
    covered
}

/// The depth of the nearest outline of `face` that covers each of the samples `asked` of the pixel around `centre`;
/// answers where there is one.
#[inline(always)]
fn find_outlines(
    surface: &Surface<'_>,
    face: u32,
    centre: DVec2,
    asked: Mask,
    depths: &mut [f64; SAMPLES],
) -> Mask {
    let half_width = surface.half_width;
    let reach = half_width + Square::pixel(centre).corner();
    let mut nearest = [half_width * half_width; SAMPLES];
    let mut found = 0;
    for segment in surface.outlines(face) {
        if segment.nearest(centre).0 > reach * reach {
            continue;
        }
        let distances = at_samples(centre, |point| segment.nearest(point).0);
        for k in members(asked) {
            if distances[k] <= nearest[k] {
                nearest[k] = distances[k];
                depths[k] = segment.depth(segment.nearest(sample(centre, k)).1);
                found |= 1 << k;
            }
        }
    }
    found
}
