//! The layers of the compact state as heights: what a depth buffer needs to keep their order.

use std::collections::VecDeque;

use foldmotion_pattern::{LayerOrder, Sheet};
use glam::DVec3;

/// The height of each triangle in its stack, and the pairs that lie on each other.
///
/// A depth buffer cannot tell layers that coincide, nor such as cross each other by what a motion without contact
/// leaves ([`crate::TIE_TOLERANCE`]). A triangle shifted towards the viewer in proportion to its lift, reversed where
/// its back is seen, is hidden by the layers above it from either side.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Layers {
    /// Half layers by which each triangle lies to the front of the middle of its stack, seen along its own front
    /// normal: neighbours in a stack of four have lifts −3, −1, 1 and 3 where they face alike. 0 for triangles of no
    /// stack.
    pub lifts: Vec<i32>,
    /// Triangles in the longest chain below each one in its stack, which has one upper side for all.
    pub heights: Vec<i32>,
    /// Triangles in the longest chains before each one in its stack, as a viewer of its front and of its back sees it.
    /// Sunk by these, a stack's outermost layer stays where it is.
    pub before: Vec<[i32; 2]>,
    /// Triangles that lie on each other, each pair once.
    pub pairs: Vec<[u32; 2]>,
}

impl Layers {
    /// The heights that keep `order` in a state at `folded`, one position for each vertex, where its triangles
    /// coincide.
    ///
    /// A stack is all that known orders join. One of its triangles tells which way is up; a triangle's height is the
    /// longest chain of triangles below it. Orders that run in a circle have no heights: what they reach is left
    /// as high as its lower neighbours were found to be. Orders of triangles that `sheet` has not are passed over;
    /// a missing position counts as the origin.
    pub fn new(sheet: &Sheet, order: &LayerOrder, folded: &[DVec3]) -> Self {
        let count = sheet.faces.len();
        let orders: Vec<(u32, u32, i8)> =
            (order.iter()).filter(|&(f, g, _)| f != g && (f.max(g) as usize) < count).collect();
        let mut around = vec![Vec::new(); count];
        for &(f, g, _) in &orders {
            around[f as usize].push(g as usize);
            around[g as usize].push(f as usize);
        }
        let (stacks, facings) = stacks(sheet, folded, &around);
        let mut above = vec![Vec::new(); count];
        for &(f, g, sign) in &orders {
            let (f, g) = (f as usize, g as usize);
            let [low, high] = if f64::from(sign) * facings[g] > 0.0 { [g, f] } else { [f, g] };
            above[low].push(high);
        }
        let mut below = reversed(&above);
        let [heights, depths] = [&mut above, &mut below].map(|arrows| heights(arrows));
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
        let before = |face: usize| {
            let [above, below] = [depths[face], heights[face]];
            if facings[face] > 0.0 { [above, below] } else { [below, above] }
        };
        Self {
            lifts: (0..count).map(lift).collect(),
            before: (0..count).map(before).collect(),
            heights,
            pairs,
        }
    }
}

/// For each triangle the first one of its stack, and 1 or −1: whether it has the same orientation when folded.
fn stacks(sheet: &Sheet, folded: &[DVec3], around: &[Vec<usize>]) -> (Vec<usize>, Vec<f64>) {
    let normals = normals(sheet, folded);
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
                    facings[next] = if is_alike { facings[face] } else { -facings[face] };
                    stacks[next] = first;
                    waiting.push_back(next);
                }
            }
        }
    }
    (stacks, facings)
}

fn normals(sheet: &Sheet, folded: &[DVec3]) -> Vec<DVec3> {
    let normal = |face: &[u32; 3]| {
        let [a, b, c] = face.map(|v| folded.get(v as usize).copied().unwrap_or_default());
        (b - a).cross(c - a)
    };
    sheet.faces.iter().map(normal).collect()
}

/// The same arrows, each from its end to its start.
fn reversed(arrows: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let mut reversed = vec![Vec::new(); arrows.len()];
    for (start, ends) in arrows.iter().enumerate() {
        for &end in ends {
            reversed[end].push(start);
        }
    }
    reversed
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

#[cfg(test)]
mod tests {
    use foldmotion_pattern::{Case, Unit, UnitSheet};

    use super::*;

    #[test]
    fn lifts_and_layers_before_keep_every_order_of_every_case_from_both_sides() {
        for (case, width) in [(Case::E, 1.0), (Case::T, 0.8), (Case::S, 1.6), (Case::SII, 1.7)] {
            let unit =
                Unit::new(case, width, 1.0, (case == Case::SII).then_some(0.7), None).unwrap();
            let units = UnitSheet::new(unit, 5, 2).unwrap();
            let (order, folded) = (units.compact_order(), units.compact());
            let layers = Layers::new(&units.sheet, &order, &folded);
            let normals = normals(&units.sheet, &folded);
            assert!(!order.is_empty());
            for (f, g, sign) in order.iter() {
                let [f, g] = [f as usize, g as usize];
                let facing = if normals[f].dot(normals[g]) > 0.0 { 1 } else { -1 };
                let above = facing * layers.lifts[f] - layers.lifts[g];
                assert!(above * i32::from(sign) > 0, "{case:?} {f} over {g}");
                // From g's front, and from behind it.
                let of_f = if facing > 0 { [0, 1] } else { [1, 0] }.map(|k| layers.before[f][k]);
                let [front, back] = [0, 1].map(|k| layers.before[g][k] - of_f[k]);
                assert!(front * i32::from(sign) > 0 && back * i32::from(sign) < 0);
            }
        }
    }

    #[test]
    fn orders_of_triangles_that_are_not_there_are_passed_over() {
        let unit = Unit::new(Case::E, 1.0, 1.0, None, None).unwrap();
        let sheet = UnitSheet::new(unit, 1, 1).unwrap().sheet;
        let mut order = LayerOrder::default();
        order.insert(0, u32::MAX, 1);
        let layers = Layers::new(&sheet, &order, &[]);
        assert!(layers.lifts.iter().all(|&lift| lift == 0) && layers.pairs.is_empty());
    }
}
