//! Which lines pass through which square of the drawing.

use glam::DVec2;

/// The most columns, and the most rows.
const MOST_SQUARES: usize = 512;
/// The most squares a line passes through on average.
const MOST_A_LINE: usize = 16;

/// A grid over the drawing with the lines that pass through each square, by index in order.
///
/// Half of the columns are equally wide; the others part the ends of the lines into equal numbers, so that the squares are
/// small where the lines are dense. So do the rows.
#[derive(Debug)]
pub(super) struct Grid {
    /// Where one column ends and the next begins, ascending.
    columns: Vec<f64>,
    /// The same of the rows.
    rows: Vec<f64>,
    /// The distance from a line within which a square belongs to it.
    margin: f64,
    /// The index of the first line of each square.
    starts: Vec<u32>,
    lines: Vec<u32>,
}

impl Grid {
    /// The grid of `segments`; a square counts as passed through where a segment comes within `margin`.
    pub(super) fn new(segments: &[[DVec2; 2]], margin: f64) -> Self {
        let sorted = |along: fn(DVec2) -> f64| {
            let mut ends: Vec<f64> = segments.iter().flatten().map(|&p| along(p)).collect();
            ends.sort_by(f64::total_cmp);
            ends
        };
        let ends = [sorted(|p| p.x), sorted(|p| p.y)];
        let with = |side: usize| {
            let [columns, rows] = [&ends[0], &ends[1]].map(|ends| breaks(ends, side));
            Self { columns, rows, margin, starts: Vec::new(), lines: Vec::new() }
        };
        let count = segments.len().max(1);
        let side = count.isqrt().clamp(1, MOST_SQUARES);
        let mut grid = with(side);
        let passed: usize = segments.iter().map(|segment| grid.steps(segment)).sum();
        if passed > MOST_A_LINE * count {
            grid = with((side * MOST_A_LINE * count / passed).max(1));
        }
        grid.starts = vec![0; grid.squares() + 1];
        grid.fill(segments);
        grid
    }

    /// About as many squares as a segment passes through.
    fn steps(&self, [a, b]: &[DVec2; 2]) -> usize {
        let [p, q] = [a, b].map(|p| [place(&self.columns, p.x), place(&self.rows, p.y)]);
        1 + p[0].abs_diff(q[0]) + p[1].abs_diff(q[1])
    }

    fn fill(&mut self, segments: &[[DVec2; 2]]) {
        let mut counts = vec![0u32; self.squares()];
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

    /// Hands over every square the segment passes through, column by column.
    fn passed(&self, [a, b]: &[DVec2; 2], mut each: impl FnMut(usize)) {
        let (a, b) = if a.x <= b.x { (*a, *b) } else { (*b, *a) };
        let slope = (b.y - a.y) / (b.x - a.x);
        // Wider than the margin by what rounding can move.
        let pad = self.margin + 1e-12 * a.abs().max(b.abs()).max_element();
        for c in place(&self.columns, a.x - pad)..=place(&self.columns, b.x + pad) {
            let before = c.checked_sub(1).map(|before| self.columns[before]);
            let left = before.unwrap_or(f64::NEG_INFINITY) - pad;
            let right = self.columns.get(c).copied().unwrap_or(f64::INFINITY) + pad;
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
            for r in place(&self.rows, from - pad)..=place(&self.rows, to + pad) {
                each(r * self.side() + c);
            }
        }
    }

    /// How many columns there are.
    fn side(&self) -> usize {
        self.columns.len() + 1
    }

    /// Squares in all.
    pub(super) fn squares(&self) -> usize {
        self.side() * (self.rows.len() + 1)
    }

    /// The lines through a square.
    pub(super) fn lines(&self, square: usize) -> &[u32] {
        &self.lines[self.starts[square] as usize..self.starts[square + 1] as usize]
    }

    /// The square a point lies in, the nearest one for a point beside the grid.
    pub(super) fn square(&self, point: DVec2) -> usize {
        place(&self.rows, point.y) * self.side() + place(&self.columns, point.x)
    }

    /// The column of a square, from the left.
    pub(super) fn column(&self, square: usize) -> usize {
        square % self.side()
    }

    /// The squares to the left of a point, its own first.
    pub(super) fn leftwards(&self, point: DVec2) -> impl Iterator<Item = usize> {
        let own = self.square(point);
        (0..=own % self.side()).map(move |back| own - back)
    }
}

/// Where to part `sorted` coordinates into about `side` columns.
fn breaks(sorted: &[f64], side: usize) -> Vec<f64> {
    let [Some(&low), Some(&high)] = [sorted.first(), sorted.last()] else {
        return Vec::new();
    };
    let half = side.div_ceil(2);
    let even = (1..half).map(|k| low + (high - low) * k as f64 / half as f64);
    let dense = (1..half).map(|k| sorted[sorted.len() * k / half]);
    let mut breaks: Vec<f64> = even.chain(dense).collect();
    breaks.sort_by(f64::total_cmp);
    breaks.dedup();
    breaks
}

/// The column of a coordinate.
fn place(breaks: &[f64], along: f64) -> usize {
    breaks.partition_point(|&end| end <= along)
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

    #[test]
    fn squares_are_small_where_lines_are_dense() {
        // All but one of the lines in a millionth of the extent.
        let at = |k: usize| DVec2::new((k % 50) as f64, (k / 50) as f64);
        let mut segments: Vec<[DVec2; 2]> =
            (0..2500).map(|k| [at(k), at(k) + DVec2::new(0.9, 0.4)]).collect();
        segments.push([DVec2::splat(5e7), DVec2::splat(5e7 + 1.0)]);
        let grid = Grid::new(&segments, 1e-6);
        let most = (0..grid.squares()).map(|square| grid.lines(square).len()).max();
        assert!(most < Some(50), "{most:?}");
    }
}
