//! A grid over the screen: which triangles may lie near a box.

use glam::DVec2;

/// At most this many cells along a side.
const MAX_SIDE: f64 = 512.0;

/// Boxes by the cells they touch.
#[derive(Debug)]
pub(super) struct Grid {
    low: DVec2,
    /// Cells a pixel.
    density: DVec2,
    sides: [usize; 2],
    /// Where the list of each cell starts, and where the last one ends.
    starts: Vec<usize>,
    members: Vec<u32>,
}

impl Grid {
    /// The grid of `boxes`, each from its low to its high corner; about as many cells as boxes.
    #[expect(clippy::cast_sign_loss, reason = "clamped to at least 1 before")]
    pub(super) fn new(boxes: &[[DVec2; 2]]) -> Self {
        let corners = boxes.iter().flatten();
        let (low, high) = corners
            .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(l, h), p| (l.min(*p), h.max(*p)));
        let size = (high - low).max(DVec2::splat(f64::MIN_POSITIVE));
        let side = (boxes.len() as f64).sqrt().ceil().clamp(1.0, MAX_SIDE);
        let mut grid = Self {
            low,
            density: side / size,
            sides: [side as usize; 2],
            starts: vec![0; side as usize * side as usize + 1],
            members: Vec::new(),
        };
        for corners in boxes {
            for cell in grid.cells(corners) {
                grid.starts[cell + 1] += 1;
            }
        }
        for cell in 1..grid.starts.len() {
            grid.starts[cell] += grid.starts[cell - 1];
        }
        grid.members = vec![0; grid.starts[grid.starts.len() - 1]];
        let mut next = grid.starts.clone();
        for (index, corners) in (0..).zip(boxes) {
            for cell in grid.cells(corners) {
                grid.members[next[cell]] = index;
                next[cell] += 1;
            }
        }
        grid
    }

    fn cells(&self, [low, high]: &[DVec2; 2]) -> impl Iterator<Item = usize> + use<> {
        let [across, down] = self.sides;
        #[expect(clippy::cast_sign_loss, reason = "clamped to 0 and above")]
        let cell = |p: DVec2| {
            let cell = ((p - self.low) * self.density).max(DVec2::ZERO);
            [(cell.x as usize).min(across - 1), (cell.y as usize).min(down - 1)]
        };
        let (first, last) = (cell(*low), cell(*high));
        (first[1]..=last[1]).flat_map(move |y| (first[0]..=last[0]).map(move |x| y * across + x))
    }

    /// The boxes that may touch the box `corners`, each once, in order.
    pub(super) fn near(&self, corners: &[DVec2; 2], found: &mut Vec<u32>) {
        found.clear();
        for cell in self.cells(corners) {
            found.extend(&self.members[self.starts[cell]..self.starts[cell + 1]]);
        }
        found.sort_unstable();
        found.dedup();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_box_that_touches_another_is_found_and_none_twice() {
        let corner = |k: i32| DVec2::new(f64::from(k * 37 % 101), f64::from(k * 53 % 89));
        let size = |k: i32| DVec2::new(f64::from(k % 7), f64::from(k % 11));
        let boxes: Vec<_> = (0..200).map(|k| [corner(k), corner(k) + size(k)]).collect();
        let grid = Grid::new(&boxes);
        let mut found = Vec::new();
        for [low, high] in &boxes {
            grid.near(&[*low, *high], &mut found);
            assert!(found.is_sorted_by(|a, b| a < b));
            for (index, other) in (0..).zip(&boxes) {
                let touches = low.cmple(other[1]).all() && other[0].cmple(*high).all();
                assert!(!touches || found.contains(&index));
            }
        }
        grid.near(&[DVec2::splat(-9.0), DVec2::splat(-8.0)], &mut found);
        assert!(found.len() < boxes.len(), "a far box does not find them all");
    }

    #[test]
    fn a_grid_of_nothing_finds_nothing() {
        let mut found = vec![7];
        Grid::new(&[]).near(&[DVec2::ZERO; 2], &mut found);
        assert!(found.is_empty());
    }
}
