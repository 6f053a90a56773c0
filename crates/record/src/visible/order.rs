//! The sequence in which triangles are painted: those behind first.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A triangle that waits to be painted; the farthest is the greatest.
#[derive(Debug, PartialEq)]
struct Waiting {
    depth: f64,
    face: u32,
}

impl Eq for Waiting {}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_depth = other.depth.total_cmp(&self.depth);
        by_depth.then(other.face.cmp(&self.face))
    }
}

/// The place of each triangle in the sequence, 0 first: each after all that it hides in part, as far as these relations
/// run in no circle; of those that are free, the farthest first.
///
/// `hidden_by`: for each triangle those that hide a part of it. `depths`: one a triangle, larger is nearer.
pub(super) fn places(hidden_by: &[Vec<u32>], depths: &[f64]) -> Vec<u32> {
    let mut open = vec![0_u32; depths.len()];
    for &front in hidden_by.iter().flatten() {
        open[front as usize] += 1;
    }
    let waiting = |face: u32| Waiting {
        depth: depths[face as usize],
        face,
    };
    let mut all: Vec<Waiting> = (0..depths.len() as u32).map(waiting).collect();
    all.sort_unstable();
    let free = |face: &Waiting| open[face.face as usize] == 0;
    let mut heap: BinaryHeap<Waiting> = all
        .iter()
        .filter(|face| free(face))
        .map(|face| waiting(face.face))
        .collect();
    let mut places = vec![u32::MAX; depths.len()];
    let mut next = 0;
    // In a circle the farthest goes first.
    while let Some(Waiting { face, .. }) = heap.pop().or_else(|| all.pop()) {
        if places[face as usize] != u32::MAX {
            continue;
        }
        places[face as usize] = next;
        next += 1;
        for &front in &hidden_by[face as usize] {
            let count = &mut open[front as usize];
            *count -= 1;
            if *count == 0 {
                heap.push(waiting(front));
            }
        }
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_hidden_is_painted_first_whatever_its_depth() {
        let hidden_by = [vec![1], vec![2], vec![], vec![0]];
        assert_eq!(places(&hidden_by, &[3.0, 2.0, 1.0, 9.0]), [1, 2, 3, 0]);
    }

    #[test]
    fn free_triangles_follow_their_depth_and_circles_are_broken_at_the_farthest() {
        assert_eq!(
            places(&[vec![], vec![], vec![]], &[5.0, 1.0, 3.0]),
            [2, 0, 1]
        );
        let circle = [vec![1], vec![2], vec![0]];
        assert_eq!(places(&circle, &[2.0, 1.0, 3.0]), [2, 0, 1]);
    }
}
