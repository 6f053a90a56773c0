//! The levels in which triangles are painted: those behind first.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::VisibleParts;

/// A triangle that waits to be painted; the farthest is the greatest.
#[derive(Debug, PartialEq)]
struct Unpainted {
    depth: f64,
    face: u32,
}

impl Eq for Unpainted {}

impl PartialOrd for Unpainted {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Unpainted {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_depth = other.depth.total_cmp(&self.depth);
        by_depth.then(other.face.cmp(&self.face))
    }
}

/// The level of each triangle: above those of all that it hides in part, as far as these relations run in no circle;
/// circles are broken at the farthest.
///
/// `depths`: one for each triangle, larger is nearer.
pub(super) fn levels(seen: &[VisibleParts], depths: &[f64]) -> Vec<u32> {
    let mut open = vec![0_u32; depths.len()];
    for occluder in seen.iter().flat_map(|seen| &seen.occluders) {
        open[occluder.face as usize] += 1;
    }
    let waiting = |face: u32| Unpainted { depth: depths[face as usize], face };
    let mut all: Vec<Unpainted> = (0..depths.len() as u32).map(waiting).collect();
    let free = |face: &&Unpainted| open[face.face as usize] == 0;
    let free = all.iter().filter(free).map(|face| waiting(face.face));
    let mut heap: BinaryHeap<Unpainted> = free.collect();
    all.sort_unstable();
    let (mut levels, mut is_done) = (vec![0; depths.len()], vec![false; depths.len()]);
    // In a circle the farthest goes first.
    while let Some(Unpainted { face, .. }) = heap.pop().or_else(|| all.pop()) {
        if std::mem::replace(&mut is_done[face as usize], true) {
            continue;
        }
        for occluder in &seen[face as usize].occluders {
            let front = occluder.face as usize;
            if !is_done[front] {
                levels[front] = levels[front].max(levels[face as usize] + 1);
            }
            open[front] -= 1;
            if open[front] == 0 {
                heap.push(waiting(occluder.face));
            }
        }
    }
    levels
}

#[cfg(test)]
mod tests {
    use super::super::Occluder;
    use super::*;

    fn seen(hidden_by: &[&[u32]]) -> Vec<VisibleParts> {
        let occluder = |&face: &u32| Occluder { face, by_order: false };
        let seen = |fronts: &&[u32]| VisibleParts {
            pieces: Vec::new(),
            occluders: fronts.iter().map(occluder).collect(),
        };
        hidden_by.iter().map(seen).collect()
    }

    #[test]
    fn what_hides_lies_above_what_it_hides_whatever_the_depths() {
        let all = seen(&[&[1, 2], &[2], &[], &[0], &[]]);
        assert_eq!(levels(&all, &[3.0, 2.0, 1.0, 9.0, 5.0]), [1, 2, 3, 0, 0]);
    }

    #[test]
    fn circles_are_broken_at_the_farthest() {
        let circle = seen(&[&[1], &[2], &[0]]);
        assert_eq!(levels(&circle, &[2.0, 1.0, 3.0]), [2, 0, 1]);
    }
}
