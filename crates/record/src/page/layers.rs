//! The layers of the compact state as heights.

use std::collections::VecDeque;

use foldmotion_pattern::Motion;
use glam::DVec3;

/// Where each triangle lies in its stack, and which lie on each other.
#[derive(Debug, PartialEq)]
pub(super) struct Layers {
    /// Layers by which each triangle lies to the front of the middle of its stack, seen along its own front normal.
    /// 0 for triangles of no stack.
    pub(super) lifts: Vec<i32>,
    /// Triangles that lie on each other, each pair once.
    pub(super) pairs: Vec<[u32; 2]>,
}

/// The heights that keep the order of the compact state.
///
/// A stack is all that known orders join. One of its triangles tells which way is up; a triangle's height is the
/// longest chain of triangles below it. Orders that run in a circle have no heights: what they reach is left
/// as high as its lower neighbours were found to be.
pub(super) fn layers(motion: &Motion) -> Layers {
    let count = motion.sheet.faces.len();
    let orders: Vec<(u32, u32, i8)> = (motion.compact_order.iter())
        .filter(|&(f, g, _)| f != g && (f.max(g) as usize) < count)
        .collect();
    let mut around = vec![Vec::new(); count];
    for &(f, g, _) in &orders {
        around[f as usize].push(g as usize);
        around[g as usize].push(f as usize);
    }
    let (stacks, facings) = stacks(motion, &around);
    let mut above = vec![Vec::new(); count];
    for &(f, g, sign) in &orders {
        let (f, g) = (f as usize, g as usize);
        let [low, high] = if f64::from(sign) * facings[g] > 0.0 {
            [g, f]
        } else {
            [f, g]
        };
        above[low].push(high);
    }
    let heights = heights(&mut above);
    let mut tops = vec![0; count];
    for face in 0..count {
        tops[stacks[face]] = heights[face].max(tops[stacks[face]]);
    }
    let lift = |face: usize| {
        let height = 2 * heights[face] - tops[stacks[face]];
        if facings[face] > 0.0 { height } else { -height }
    };
    let pairs = orders.iter().map(|&(f, g, _)| [f.min(g), f.max(g)]);
    let mut pairs: Vec<[u32; 2]> = pairs.collect();
    pairs.sort_unstable();
    pairs.dedup();
    Layers {
        lifts: (0..count).map(lift).collect(),
        pairs,
    }
}

/// For each triangle the first one of its stack, and 1 or −1: whether it faces the same way in the last frame.
fn stacks(motion: &Motion, around: &[Vec<usize>]) -> (Vec<usize>, Vec<f64>) {
    let normals = normals(motion);
    let mut stacks: Vec<usize> = (0..around.len()).collect();
    let mut facings = vec![0.0; around.len()];
    for first in 0..around.len() {
        if facings[first] != 0.0 {
            continue;
        }
        facings[first] = 1.0;
        let mut waiting = VecDeque::from([first]);
        while let Some(face) = waiting.pop_front() {
            for &next in &around[face] {
                if facings[next] == 0.0 {
                    let is_alike = normals[face].dot(normals[next]) >= 0.0;
                    facings[next] = if is_alike {
                        facings[face]
                    } else {
                        -facings[face]
                    };
                    stacks[next] = first;
                    waiting.push_back(next);
                }
            }
        }
    }
    (stacks, facings)
}

fn normals(motion: &Motion) -> Vec<DVec3> {
    let positions = motion.frames.last().map_or(&[][..], |f| &f.positions);
    let normal = |face: &[u32; 3]| {
        let [a, b, c] = face.map(|v| positions.get(v as usize).copied().unwrap_or_default());
        (b - a).cross(c - a)
    };
    motion.sheet.faces.iter().map(normal).collect()
}

/// The longest chain below each triangle (Kahn 1962, Topological sorting of large networks).
fn heights(above: &mut [Vec<usize>]) -> Vec<i32> {
    let mut below = vec![0_usize; above.len()];
    for list in above.iter_mut() {
        list.sort_unstable();
        list.dedup();
        for &high in list.iter() {
            below[high] += 1;
        }
    }
    let mut heights = vec![0; above.len()];
    let mut ready: VecDeque<usize> = (0..above.len()).filter(|&f| below[f] == 0).collect();
    while let Some(low) = ready.pop_front() {
        for &high in &above[low] {
            heights[high] = heights[high].max(heights[low] + 1);
            below[high] -= 1;
            if below[high] == 0 {
                ready.push_back(high);
            }
        }
    }
    heights
}
