//! What is derived from a sheet and its state once, not once a frame.

use foldmotion_pattern::Sheet;
use foldmotion_record::{Layers, TIE_TOLERANCE};
use glam::DVec3;

use super::eye::Ball;
use super::picture::Picture;

/// Layers are moved apart by [`TIE_TOLERANCE`], but all of a stack by no more than this, in units of `unit_length`.
const HIGHEST_STACK: f64 = 0.2;

/// Cosines of the angle between neighbours of a stack: moved apart in full, and not at all.
const PARALLEL: [f64; 2] = [0.966, 0.866];

/// A sheet in a state.
#[derive(Debug)]
pub(super) struct State {
    sheet_key: u64,
    state_key: u64,
    /// Neighbours in a stack.
    pairs: Vec<[u32; 2]>,
    /// The largest lift.
    top: i32,
    /// Around the sheet.
    pub(super) ball: Ball,
    /// Half layers by which each triangle lies to the front of its stack, less where the stack is open.
    pub(super) lifts: Vec<f32>,
    /// Whether every place is finite.
    pub(super) is_finite: bool,
}

impl State {
    pub(super) fn new(picture: &Picture<'_>) -> Self {
        let mut state = Self {
            sheet_key: picture.sheet_key,
            state_key: picture.state_key,
            pairs: picture.layers.map(neighbours).unwrap_or_default(),
            top: picture.layers.map_or(0, highest),
            ball: Ball::around([]),
            lifts: Vec::new(),
            is_finite: false,
        };
        state.take(picture);
        state
    }

    /// Follows `picture`; whether another sheet came.
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
        self.ball = Ball::around(positions.iter().copied());
        self.lifts = match picture.layers {
            Some(layers) if picture.is_whole() => {
                closed(picture.sheet, positions, layers, &self.pairs)
            }
            _ => vec![0.0; picture.sheet.faces.len()],
        };
    }

    /// Half the distance of layers.
    pub(super) fn half_layer(&self, unit_length: f64) -> f64 {
        let most = HIGHEST_STACK / f64::from(self.top.max(1));
        unit_length * (0.5 * TIE_TOLERANCE).min(0.5 * most)
    }
}

fn highest(layers: &Layers) -> i32 {
    let lifts = layers.lifts.iter();
    lifts.map(|lift| lift.abs()).max().unwrap_or(0)
}

/// Pairs with nothing between them: those of all pairs would grow with the square of a stack.
fn neighbours(layers: &Layers) -> Vec<[u32; 2]> {
    let height = |face: u32| layers.heights.get(face as usize).copied();
    let is_next = |&&[f, g]: &&[u32; 2]| match (height(f), height(g)) {
        (Some(f), Some(g)) => f.abs_diff(g) == 1,
        _ => false,
    };
    layers.pairs.iter().filter(is_next).copied().collect()
}

/// The lift of each triangle, as far as it is parallel to a neighbour of its stack.
fn closed(sheet: &Sheet, positions: &[DVec3], layers: &Layers, pairs: &[[u32; 2]]) -> Vec<f32> {
    let normal = |face: &[u32; 3]| {
        let [a, b, c] = face.map(|v| positions[v as usize]);
        (b - a).cross(c - a).normalize_or_zero()
    };
    let normals: Vec<DVec3> = sheet.faces.iter().map(normal).collect();
    let mut parts = vec![0.0_f64; sheet.faces.len()];
    let [full, none] = PARALLEL;
    for &[f, g] in pairs {
        let [f, g] = [f as usize, g as usize];
        let cosine = normals[f].dot(normals[g]).abs();
        let part = ((cosine - none) / (full - none)).clamp(0.0, 1.0);
        parts[f] = parts[f].max(part);
        parts[g] = parts[g].max(part);
    }
    let lifts = layers.lifts.iter().chain(std::iter::repeat(&0));
    let lift = |(part, &lift): (f64, &i32)| (part * f64::from(lift)) as f32;
    parts.into_iter().zip(lifts).map(lift).collect()
}
