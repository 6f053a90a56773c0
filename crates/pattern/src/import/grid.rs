//! Which lines pass through which square of the drawing.

use glam::DVec2;

/// The most squares a side.
const MOST_SQUARES: usize = 256;
/// The most squares a line passes through on average.
const MOST_A_LINE: f64 = 16.0;

/// A grid over the drawing with the lines that pass through each square, by index in order.
#[derive(Debug)]
pub(super) struct Grid {
    low: DVec2,
    /// Size of a square.
    size: DVec2,
    side: usize,
    /// The distance from a line within which a square belongs to it.
    margin: f64,
    /// The index of the first line of each square.
    starts: Vec<u32>,
    lines: Vec<u32>,
}

impl Grid {
    /// The grid of `segments`; a square counts as passed through where a segment comes within `margin`.
    pub(super) fn new(segments: &[[DVec2; 2]], margin: f64) -> Self {
        let all: Vec<DVec2> = segments.iter().flatten().copied().collect();
        let [low, high] = super::drawing::bounds(&all).unwrap_or_default();
        let extent = (high - low).max(DVec2::splat(margin));
        let taxi = |[a, b]: &[DVec2; 2]| ((*b - *a).abs() / extent).element_sum();
        let total: f64 = segments.iter().map(taxi).sum();
        let count = segments.len().max(1) as f64;
        let side = count.sqrt().min(MOST_A_LINE * count / total.max(1e-9));
        #[expect(clippy::cast_sign_loss, reason = "counts are not negative")]
        let side = (side.ceil() as usize).clamp(1, MOST_SQUARES);
        let mut grid = Self {
            low,
            size: extent / side as f64,
            side,
            margin,
            starts: vec![0; side * side + 1],
            lines: Vec::new(),
        };
        grid.fill(segments);
        grid
    }

    fn fill(&mut self, segments: &[[DVec2; 2]]) {
        let mut counts = vec![0u32; self.side * self.side];
        for segment in segments {
            self.passed(segment, |square| counts[square] += 1);
        }
        for (square, count) in counts.iter().enumerate() {
            self.starts[square + 1] = self.starts[square] + count;
        }
        let mut next = self.starts.clone();
        let mut lines = vec![0; self.starts[counts.len()] as usize];
        for (line, segment) in segments.iter().enumerate() {
            self.passed(segment, |square| {
                lines[next[square] as usize] = line as u32;
                next[square] += 1;
            });
        }
        self.lines = lines;
    }

    #[expect(clippy::cast_sign_loss, reason = "raised to 0 before")]
    fn square_along(&self, along: f64, low: f64, size: f64) -> usize {
        (((along - low) / size).floor().max(0.0) as usize).min(self.side - 1)
    }

    /// Hands over every square the segment passes through, column by column.
    fn passed(&self, [a, b]: &[DVec2; 2], mut each: impl FnMut(usize)) {
        let (a, b) = if a.x <= b.x { (*a, *b) } else { (*b, *a) };
        let column = |x| self.square_along(x, self.low.x, self.size.x);
        let row = |y| self.square_along(y, self.low.y, self.size.y);
        let slope = (b.y - a.y) / (b.x - a.x);
        // Wider than the margin by what rounding can move.
        let pad = self.margin + 1e-9 * self.size.max_element();
        for c in column(a.x - pad)..=column(b.x + pad) {
            let left = self.low.x + c as f64 * self.size.x - pad;
            let right = left + self.size.x + 2.0 * pad;
            let at = |x: f64| {
                let y = a.y + slope * (x.clamp(a.x, b.x) - a.x);
                if y.is_finite() { y } else { a.y }
            };
            let (mut from, mut to) = (at(left), at(right));
            if right >= b.x {
                to = b.y;
            }
            if from > to {
                (from, to) = (to, from);
            }
            if b.x - a.x <= 2.0 * pad {
                (from, to) = (a.y.min(b.y), a.y.max(b.y));
            }
            for r in row(from - pad)..=row(to + pad) {
                each(r * self.side + c);
            }
        }
    }

    /// Squares in all.
    pub(super) fn squares(&self) -> usize {
        self.side * self.side
    }

    /// The lines through a square.
    pub(super) fn lines(&self, square: usize) -> &[u32] {
        &self.lines[self.starts[square] as usize..self.starts[square + 1] as usize]
    }

    /// The square a point lies in, the nearest one for a point beside the grid.
    pub(super) fn square(&self, point: DVec2) -> usize {
        let column = self.square_along(point.x, self.low.x, self.size.x);
        self.square_along(point.y, self.low.y, self.size.y) * self.side + column
    }

    /// The column of a square, from the left.
    pub(super) fn column(&self, square: usize) -> usize {
        square % self.side
    }

    /// The squares to the left of a point, its own first.
    pub(super) fn leftwards(&self, point: DVec2) -> impl Iterator<Item = usize> {
        let own = self.square(point);
        (0..=own % self.side).map(move |back| own - back)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_square_with_a_point_of_a_segment_has_the_segment() {
        let mut random = fastrand::Rng::with_seed(1);
        let mut segments: Vec<[DVec2; 2]> = (0..300)
            .map(|_| [0; 2].map(|_| DVec2::new(random.f64(), 3.0 * random.f64())))
            .collect();
        segments.push([DVec2::new(0.5, 0.0), DVec2::new(0.5, 3.0)]);
        segments.push([DVec2::new(0.0, 1.0), DVec2::new(1.0, 1.0)]);
        let grid = Grid::new(&segments, 1e-6);
        for (line, [a, b]) in segments.iter().enumerate() {
            for step in 0..=500 {
                let square = grid.square(a.lerp(*b, f64::from(step) / 500.0));
                assert!(grid.lines(square).contains(&(line as u32)));
            }
        }
    }
}
