//! A binary tree of boxes: split once at medians, refitted as the boxes move.

use crate::Aabb;

const LEAF_SIZE: usize = 4;

#[derive(Debug, Clone, Copy)]
struct Node {
    hull: Aabb,
    /// The index of the first item in `items` (leaf), or of the first child in `nodes` (the second follows it).
    first: u32,
    /// The number of items of a leaf; 0 for an inner node.
    count: u32,
}

/// A hierarchy over boxes numbered 0, 1, 2, …
///
/// The answers to its queries depend only on the boxes, never on the shape of the tree: after a refit to boxes that
/// have moved far it is slower, but not wrong.
#[derive(Debug, Clone)]
pub struct Tree {
    /// The nodes, parents before children.
    nodes: Vec<Node>,
    items: Vec<u32>,
}

impl Tree {
    /// Splits at the median of the box centres along the longest side, down to leaves of four.
    pub fn new(boxes: &[Aabb]) -> Self {
        let mut items: Vec<u32> = (0..boxes.len() as u32).collect();
        let mut nodes = vec![Node { hull: Aabb::EMPTY, first: 0, count: 0 }];
        let mut open = vec![(0usize, 0usize, items.len())];
        while let Some((node, start, end)) = open.pop() {
            if end - start <= LEAF_SIZE {
                nodes[node].first = start as u32;
                nodes[node].count = (end - start) as u32;
                continue;
            }
            let middle = usize::midpoint(start, end);
            split(&mut items[start..end], middle - start, boxes);
            let child = nodes.len();
            nodes[node].first = child as u32;
            nodes.extend([nodes[node]; 2]);
            open.push((child, start, middle));
            open.push((child + 1, middle, end));
        }
        let mut tree = Self { nodes, items };
        tree.refit(boxes);
        tree
    }

    /// Fits the tree to boxes that have moved. Precondition: as many boxes as the tree was built from.
    pub fn refit(&mut self, boxes: &[Aabb]) {
        debug_assert_eq!(boxes.len(), self.items.len(), "the boxes move, none comes");
        for node in (0..self.nodes.len()).rev() {
            let Node { first, count, .. } = self.nodes[node];
            let first = first as usize;
            self.nodes[node].hull = if self.is_leaf(node) {
                let items = &self.items[first..first + count as usize];
                items.iter().fold(Aabb::EMPTY, |hull, &i| hull.union(&boxes[i as usize]))
            } else {
                self.nodes[first].hull.union(&self.nodes[first + 1].hull)
            };
        }
    }

    /// Every pair (i, j), i < j, whose boxes overlap, in increasing order.
    ///
    /// `boxes`: those to which the tree was last fitted.
    pub fn overlapping_pairs(&self, boxes: &[Aabb]) -> Vec<(u32, u32)> {
        let mut pairs = Vec::new();
        self.visit_overlapping(boxes, |i, j| pairs.push((i, j)));
        pairs.sort_unstable();
        pairs
    }

    /// Calls `visit(i, j)` for the [`overlapping_pairs`](Self::overlapping_pairs), in an order that depends on the
    /// shape of the tree.
    pub fn visit_overlapping(&self, boxes: &[Aabb], mut visit: impl FnMut(u32, u32)) {
        let touching = |a: &Aabb, b: &Aabb| a.overlaps(b);
        self.visit_pairs(touching, |i, j| {
            if boxes[i as usize].overlaps(&boxes[j as usize]) {
                visit(i, j);
            }
        });
    }

    /// Branch and bound: calls `measure(i, j, bound)` for pairs whose boxes are nearer than the bound it last returned.
    ///
    /// `measure` returns the bound to continue with. Every pair whose boxes are nearer than the final bound is
    /// measured.
    pub fn visit_near(
        &self,
        boxes: &[Aabb],
        bound: f64,
        mut measure: impl FnMut(u32, u32, f64) -> f64,
    ) {
        let bound = std::cell::Cell::new(bound);
        let near = |a: &Aabb, b: &Aabb| a.distance_squared(b) < bound.get() * bound.get();
        self.visit_pairs(near, |i, j| {
            if near(&boxes[i as usize], &boxes[j as usize]) {
                bound.set(measure(i, j, bound.get()));
            }
        });
    }

    /// Calls `visit(i, j)`, i < j, for all pairs in leaves for which their hulls and those of all their ancestors are
    /// `close`.
    fn visit_pairs(&self, close: impl Fn(&Aabb, &Aabb) -> bool, mut visit: impl FnMut(u32, u32)) {
        let mut open = vec![(0usize, 0usize)];
        while let Some((p, q)) = open.pop() {
            if p != q && !close(&self.nodes[p].hull, &self.nodes[q].hull) {
                continue;
            }
            match (self.is_leaf(p), self.is_leaf(q)) {
                (true, true) => self.visit_leaves(p, q, &mut visit),
                (false, _) if p == q => {
                    let child = self.nodes[p].first as usize;
                    open.extend([(child, child), (child, child + 1), (child + 1, child + 1)]);
                }
                (p_is_leaf, q_is_leaf) => {
                    let larger_p = self.nodes[p].hull.diagonal() >= self.nodes[q].hull.diagonal();
                    if q_is_leaf || (!p_is_leaf && larger_p) {
                        let child = self.nodes[p].first as usize;
                        open.extend([(child, q), (child + 1, q)]);
                    } else {
                        let child = self.nodes[q].first as usize;
                        open.extend([(p, child), (p, child + 1)]);
                    }
                }
            }
        }
    }

    fn visit_leaves(&self, p: usize, q: usize, visit: &mut impl FnMut(u32, u32)) {
        for (position, &i) in self.leaf(p).iter().enumerate() {
            let others = if p == q { &self.leaf(p)[position + 1..] } else { self.leaf(q) };
            for &j in others {
                visit(i.min(j), i.max(j));
            }
        }
    }

    fn is_leaf(&self, node: usize) -> bool {
        // The root is nobody's child, so an inner node never points to itself.
        self.nodes[node].count > 0 || self.items.is_empty()
    }

    fn leaf(&self, node: usize) -> &[u32] {
        let Node { first, count, .. } = self.nodes[node];
        &self.items[first as usize..(first + count) as usize]
    }
}

/// Moves the `middle` items with the lowest centres along the longest side to the front.
fn split(items: &mut [u32], middle: usize, boxes: &[Aabb]) {
    let centre = |i: u32| boxes[i as usize].min + boxes[i as usize].max;
    let extents = Aabb::around(items.iter().map(|&i| centre(i))).extents();
    let axis = (0..3).max_by(|&i, &j| extents[i].total_cmp(&extents[j])).unwrap_or(0);
    items.select_nth_unstable_by(middle, |&i, &j| {
        let by_centre = centre(i)[axis].total_cmp(&centre(j)[axis]);
        by_centre.then(i.cmp(&j))
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use foldmotion_random::Random;

    fn boxes(random: &mut Random, count: usize, size: f64) -> Vec<Aabb> {
        (0..count)
            .map(|_| {
                let shift = random.vector() * 2.0;
                Aabb::around(random.triangle(size).map(|p| p + shift))
            })
            .collect()
    }

    fn brute_force(boxes: &[Aabb]) -> Vec<(u32, u32)> {
        let n = boxes.len() as u32;
        (0..n)
            .flat_map(|i| (i + 1..n).map(move |j| (i, j)))
            .filter(|&(i, j)| boxes[i as usize].overlaps(&boxes[j as usize]))
            .collect()
    }

    #[test]
    fn the_tree_finds_the_pairs_that_brute_force_finds_also_after_a_refit() {
        let mut random = Random::new(11);
        for count in [0, 1, 2, 4, 5, 9, 64, 201] {
            let first = boxes(&mut random, count, 0.4);
            let mut tree = Tree::new(&first);
            assert_eq!(tree.overlapping_pairs(&first), brute_force(&first));
            let moved = boxes(&mut random, count, 0.4);
            tree.refit(&moved);
            assert_eq!(tree.overlapping_pairs(&moved), brute_force(&moved));
        }
    }

    #[test]
    fn branch_and_bound_ends_at_the_nearest_pair_of_boxes() {
        let mut random = Random::new(12);
        let all = boxes(&mut random, 120, 0.05);
        let mut tree = Tree::new(&boxes(&mut random, 120, 0.05));
        tree.refit(&all);
        let mut least = f64::INFINITY;
        tree.visit_near(&all, f64::INFINITY, |i, j, bound| {
            least = bound.min(all[i as usize].distance_squared(&all[j as usize]).sqrt());
            least
        });
        let brute = (0..120)
            .flat_map(|i| (i + 1..120).map(move |j| (i, j)))
            .map(|(i, j)| all[i].distance_squared(&all[j]).sqrt())
            .fold(f64::INFINITY, f64::min);
        assert_eq!(least, brute);
    }
}
