//! Transitivity: the order of the layers over a region has no cycle.

use glam::DVec2;

use super::flat;

/// The layers of a cluster, projected into its plane.
#[derive(Debug)]
pub(super) struct LayerStack {
    /// The corners of each layer, counter-clockwise.
    pub(super) triangles: Vec<[DVec2; 3]>,
    /// For each layer, the layers known to lie above it, in increasing order.
    pub(super) above: Vec<Vec<usize>>,
}

impl LayerStack {
    /// Every three layers that lie above each other in a cycle over a common region wider than `width`, the lowest
    /// index first, with a point of that region.
    ///
    /// If the layers have a linear order there is no such cycle. Layers that are lowest or highest are removed
    /// repeatedly, and the rest is searched, because layers may form a cycle if they have no region in common.
    pub(super) fn cycles(&self, width: f64) -> Vec<([usize; 3], DVec2)> {
        let is_left = self.unsorted();
        let mut found = Vec::new();
        let next = |i: usize| self.above[i].iter().copied().filter(|&j| is_left[j]);
        for i in (0..self.above.len()).filter(|&i| is_left[i]) {
            for j in next(i).filter(|&j| j > i) {
                for k in next(j).filter(|&k| k > i) {
                    if self.above[k].binary_search(&i).is_err() {
                        continue;
                    }
                    let region = flat::common(&[i, j, k].map(|l| self.triangles[l]));
                    if flat::is_wide(&region, width) {
                        found.push(([i, j, k], flat::middle(&region)));
                    }
                }
            }
        }
        found
    }

    /// Which layers are left after repeatedly removing the lowest and then the highest ones.
    fn unsorted(&self) -> Vec<bool> {
        let count = self.above.len();
        let mut below = vec![Vec::new(); count];
        for (i, above) in self.above.iter().enumerate() {
            for &j in above {
                below[j].push(i);
            }
        }
        let mut is_left = vec![true; count];
        for (under, over) in [(&below, &self.above), (&self.above, &below)] {
            let still =
                |is_left: &[bool], i: usize| under[i].iter().filter(|&&j| is_left[j]).count();
            let mut held: Vec<usize> = (0..count).map(|i| still(&is_left, i)).collect();
            let mut free: Vec<usize> = (0..count).filter(|&i| is_left[i] && held[i] == 0).collect();
            while let Some(i) = free.pop() {
                is_left[i] = false;
                for &j in over[i].iter().filter(|&&j| is_left[j]) {
                    held[j] -= 1;
                    if held[j] == 0 {
                        free.push(j);
                    }
                }
            }
        }
        is_left
    }

    /// The largest number of layers over the centre of a layer, or over the centre of the common region of two layers,
    /// counting those whose sides are farther than `margin` from it.
    pub(super) fn depth(&self, neighbours: &[Vec<usize>], margin: f64) -> usize {
        let count = |i: usize, point: DVec2| {
            let others = neighbours[i].iter();
            1 + others.filter(|&&k| flat::holds(&self.triangles[k], point, margin)).count()
        };
        let at = |i: usize| {
            let own = count(i, flat::middle(&self.triangles[i]));
            let shared = neighbours[i].iter().filter(|&&j| j > i).map(|&j| {
                let region = flat::common(&[self.triangles[i], self.triangles[j]]);
                count(i, flat::middle(&region))
            });
            shared.max().map_or(own, |most| most.max(own))
        };
        (0..self.triangles.len()).map(at).max().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDTH: f64 = 1e-5;

    fn stack(triangles: Vec<[DVec2; 3]>, above: &[(usize, usize)]) -> LayerStack {
        let mut lists = vec![Vec::new(); triangles.len()];
        for &(low, high) in above {
            lists[low].push(high);
            lists[low].sort_unstable();
        }
        LayerStack { triangles, above: lists }
    }

    fn plate(at: DVec2) -> [DVec2; 3] {
        [at, at + DVec2::X, at + DVec2::Y]
    }

    #[test]
    fn three_layers_in_a_cycle_over_one_region_are_found_and_sorted_ones_are_not() {
        let plates = || (0..4).map(|k| plate(DVec2::splat(0.01 * f64::from(k)))).collect();
        let sorted = [(0, 1), (0, 2), (1, 2), (2, 3), (1, 3), (0, 3)];
        assert!(stack(plates(), &sorted).cycles(WIDTH).is_empty());
        let circle = [(0, 1), (2, 0), (1, 2), (2, 3), (1, 3), (0, 3)];
        let found = stack(plates(), &circle).cycles(WIDTH);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].0, [0, 1, 2]);
        assert!(flat::holds(&plate(DVec2::splat(0.02)), found[0].1, 0.0));
    }

    #[test]
    fn a_pinwheel_may_form_a_cycle_if_its_blades_share_no_region() {
        // Three long blades around an empty centre, each over the next.
        let turn = |k: u32| DVec2::from_angle(f64::from(k) * std::f64::consts::TAU / 3.0);
        let blade = [DVec2::new(-2.0, 0.5), DVec2::new(2.0, 0.5), DVec2::new(2.0, 0.9)];
        let blades: Vec<_> = (0..3).map(|k| blade.map(|p| turn(k).rotate(p))).collect();
        assert!(flat::overlap(&blades[0], &blades[1], WIDTH));
        assert!(stack(blades, &[(0, 1), (1, 2), (2, 0)]).cycles(WIDTH).is_empty());
    }

    #[test]
    fn the_depth_of_shifted_plates_is_their_number() {
        let plates: Vec<_> = (0..5).map(|k| plate(DVec2::X * 0.1 * f64::from(k))).collect();
        let neighbours: Vec<Vec<usize>> =
            (0..5).map(|i| (0..5).filter(|&j| j != i).collect()).collect();
        assert_eq!(stack(plates, &[]).depth(&neighbours, 1e-5), 5);
    }
}
