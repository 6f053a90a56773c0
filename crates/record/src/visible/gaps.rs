//! Where every triangle is hidden by another.
//!
//! Noise and layer order may contradict each other in a circle: f before g before h before f. Such a point belongs to
//! the nearest triangle f or to one that the order lifts before it; what neither leaves is a gap.

use glam::DVec2;

use super::hiding::{hidden_part, triangle};
use super::plane::{outside, tidy};
use super::{LEAST_AREA, Scene, VisibleParts};

/// The gaps over triangle `face`, where it is the nearest: convex, each with the triangle that is seen in its middle.
pub(super) fn over(scene: &Scene<'_>, face: u32, all: &[VisibleParts]) -> Vec<(u32, Vec<DVec2>)> {
    let seen = &all[face as usize];
    if !seen.occluders.iter().any(|occluder| occluder.by_order) {
        return Vec::new();
    }
    let mut near = Vec::new();
    scene.grid.near(&scene.boxes[face as usize], &mut near);
    let nearer = near.iter().filter(|&&other| other != face);
    let mut clips: Vec<Vec<DVec2>> =
        nearer.filter_map(|&other| hidden_part(scene.surface, other, face, 0.0)).collect();
    clips.extend(seen.pieces.iter().cloned());
    for occluder in seen.occluders.iter().filter(|occluder| occluder.by_order) {
        clips.extend(all[occluder.face as usize].pieces.iter().cloned());
    }
    clips.iter_mut().for_each(tidy);
    let mut left = vec![triangle(scene.surface, face).to_vec()];
    for clip in &clips {
        for piece in std::mem::take(&mut left) {
            outside(piece, clip, LEAST_AREA, &mut left);
        }
    }
    let mut found = Vec::new();
    let filled = left.into_iter().filter_map(|piece| {
        let middle = piece.iter().sum::<DVec2>() / piece.len() as f64;
        let front = scene.surface.front_covering(&near, middle, &mut found)?;
        Some((front.face, piece))
    });
    filled.collect()
}
