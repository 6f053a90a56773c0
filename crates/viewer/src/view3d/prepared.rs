//! What is derived once from a sheet and its state, rather than in every frame.

use foldmotion_pattern::Sheet;
use foldmotion_record::{Layers, TIE_TOLERANCE};
use glam::DVec3;

use super::picture::Picture;
use super::projection::Sphere;

/// The largest depth of the lowest layer of a stack, in units of `unit_length`; in high stacks, layers are closer than
/// [`TIE_TOLERANCE`].
const DEEPEST: f64 = 0.2;

/// Cosines of the angle between neighbouring triangles of a stack at which they are separated fully and not at all.
const PARALLEL: [f64; 2] = [0.966, 0.866];

/// A sheet in a state, prepared for drawing.
#[derive(Debug)]
pub(super) struct PreparedSheet {
    sheet_key: u64,
    state_key: u64,
    /// Each triangle of a stack with its nearest neighbour.
    pairs: Vec<[u32; 2]>,
    /// The largest number of layers in front of a triangle.
    most: i32,
    /// A sphere around the sheet.
    pub(super) sphere: Sphere,
    /// The number of layers in front of each triangle, seen from its front and from its back; smaller where the stack
    /// is open.
    pub(super) before: Vec<[f32; 2]>,
    /// Whether all positions are finite.
    pub(super) is_finite: bool,
}

impl PreparedSheet {
    pub(super) fn new(picture: &Picture<'_>) -> Self {
        let mut prepared = Self {
            sheet_key: picture.sheet_key,
            state_key: picture.state_key,
            pairs: picture.layers.map(neighbours).unwrap_or_default(),
            most: picture.layers.map_or(0, most_before),
            sphere: Sphere::around([]),
            before: Vec::new(),
            is_finite: false,
        };
        prepared.take(picture);
        prepared
    }

    /// Follows `picture`; returns whether the sheet has changed.
    pub(super) fn follow(&mut self, picture: &Picture<'_>) -> bool {
        if self.sheet_key != picture.sheet_key {
            *self = Self::new(picture);
            return true;
        }
        if self.state_key != picture.state_key {
            self.take(picture);
        }
        false
    }

    fn take(&mut self, picture: &Picture<'_>) {
        self.state_key = picture.state_key;
        let positions = picture.positions;
        self.is_finite = positions.iter().all(|p| p.is_finite());
        self.sphere = Sphere::around(positions.iter().copied());
        self.before = match picture.layers {
            Some(layers) if picture.is_whole() && picture.has_layers() => {
                layers_in_front(picture.sheet, positions, layers, &self.pairs)
            }
            _ => vec![[0.0; 2]; picture.sheet.faces.len()],
        };
    }

    /// The distance between layers.
    pub(super) fn layer(&self, unit_length: f64) -> f64 {
        unit_length * TIE_TOLERANCE.min(DEEPEST / f64::from(self.most.max(1)))
    }

    /// How far triangle `face` is moved behind the first of its stack, if its front (`side` > 0) or its back is
    /// visible.
    pub(super) fn depth_offset(&self, face: usize, side: f64, unit_length: f64) -> f64 {
        let [front, back] = self.before.get(face).copied().unwrap_or_default();
        f64::from(if side > 0.0 { front } else { back }) * self.layer(unit_length)
    }
}

fn most_before(layers: &Layers) -> i32 {
    layers.before.iter().flatten().copied().max().unwrap_or(0)
}

/// Each triangle of a stack with the one that has the fewest layers between. All pairs would grow with the square of
/// the stack.
fn neighbours(layers: &Layers) -> Vec<[u32; 2]> {
    let mut nearest: Vec<Option<(u32, u32)>> = vec![None; layers.heights.len()];
    for &[f, g] in &layers.pairs {
        let heights = [f, g].map(|face| layers.heights.get(face as usize));
        let [Some(of_f), Some(of_g)] = heights else {
            continue;
        };
        let apart = of_f.abs_diff(*of_g);
        for (one, other) in [(f, g), (g, f)] {
            let place = &mut nearest[one as usize];
            if place.is_none_or(|(least, _)| apart < least) {
                *place = Some((apart, other));
            }
        }
    }
    let pairs = (0..).zip(nearest);
    pairs.filter_map(|(face, nearest)| Some([face, nearest?.1])).collect()
}

/// The number of layers in front of each triangle, reduced where it is not parallel to its neighbour.
fn layers_in_front(
    sheet: &Sheet,
    positions: &[DVec3],
    layers: &Layers,
    pairs: &[[u32; 2]],
) -> Vec<[f32; 2]> {
    let normal = |face: u32| {
        let [a, b, c] = sheet.faces[face as usize].map(|v| positions[v as usize]);
        (b - a).cross(c - a).normalize_or_zero()
    };
    let mut before = vec![[0.0; 2]; sheet.faces.len()];
    let [full, none] = PARALLEL;
    for &[face, other] in pairs {
        let cosine = normal(face).dot(normal(other)).abs();
        let part = ((cosine - none) / (full - none)).clamp(0.0, 1.0) as f32;
        before[face as usize] = layers.before[face as usize].map(|count| part * count as f32);
    }
    before
}
