//! A pattern cut into pages that are glued together.

use glam::DVec2;

use super::{CutError, CutLine, CutPage, CutPattern, PageNumber};

/// The most pages of a pattern.
const MOST_PAGES: usize = 1000;
/// A line along the side of a page and no farther from it than this, mm, lies on it: both pages of a seam draw it,
/// whatever the rounding.
const SEAM: f64 = 1e-6;
/// Half the length of a tick across the line where two pages meet, mm.
const TICK: f64 = 3.0;

/// How pages are laid out. Lengths in mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PageLayout {
    /// Width and height of the paper.
    pub paper: DVec2,
    /// White space on every side, which printers cannot reach.
    pub margin: f64,
    /// How far neighbouring pages repeat each other: the strip to glue on.
    pub overlap: f64,
}

/// The pages of a pattern, row by row.
///
/// Between its margins every page shows a window of the pattern; neighbouring windows overlap by the layout's
/// overlap, and what lies in the overlap is drawn on both pages. Together the windows cover the pattern.
#[derive(Debug, Clone)]
pub struct Tiles<'a> {
    pattern: &'a CutPattern,
    layout: PageLayout,
    window: DVec2,
    columns: usize,
    rows: usize,
}

impl CutPattern {
    /// The pattern cut into pages.
    ///
    /// # Errors
    /// [`CutError`]: no room between the margins, too much overlap, more than 1000 pages.
    pub fn tiles(&self, layout: PageLayout) -> Result<Tiles<'_>, CutError> {
        Tiles::new(self, layout)
    }
}

impl<'a> Tiles<'a> {
    pub(super) fn new(pattern: &'a CutPattern, layout: PageLayout) -> Result<Self, CutError> {
        let PageLayout { paper, margin, overlap } = layout;
        if !(margin >= 0.0 && margin.is_finite()) {
            return Err(CutError::Negative { name: "the margin", value: margin });
        }
        let window = paper - DVec2::splat(2.0 * margin);
        if !(window.min_element() > 0.0 && window.is_finite()) {
            return Err(CutError::PaperTooSmall { paper: paper.to_array(), margin });
        }
        let limit = window.min_element() / 2.0;
        if !(0.0..=limit).contains(&overlap) {
            return Err(CutError::Overlap { value: overlap, limit });
        }
        let step = window - DVec2::splat(overlap);
        // A sliver of rounding needs no page of its own: the last window reaches to the end of the pattern.
        let more = ((pattern.size - window) / step - 1e-9).ceil().max(DVec2::ZERO);
        let counts = more + DVec2::ONE;
        let pages = counts.x * counts.y;
        if pages > MOST_PAGES as f64 {
            return Err(CutError::TooManyPages { pages, limit: MOST_PAGES });
        }
        #[expect(clippy::cast_sign_loss, reason = "at least 1, at most 1000")]
        let [columns, rows] = counts.to_array().map(|count| count as usize);
        Ok(Self { pattern, layout, window, columns, rows })
    }

    /// Columns and rows of pages.
    pub fn counts(&self) -> [usize; 2] {
        [self.columns, self.rows]
    }

    /// Every page, row by row from the upper left.
    pub fn pages(&self) -> impl Iterator<Item = CutPage<'a>> + '_ {
        let columns = 0..self.columns;
        (0..self.rows)
            .flat_map(move |row| columns.clone().map(move |column| self.page(row, column)))
    }

    fn page(&self, row: usize, column: usize) -> CutPage<'a> {
        let step = self.window - DVec2::splat(self.layout.overlap);
        let start = DVec2::new(column as f64, row as f64) * step;
        let mut end = start + self.window;
        if column + 1 == self.columns {
            end.x = end.x.max(self.pattern.size.x);
        }
        if row + 1 == self.rows {
            end.y = end.y.max(self.pattern.size.y);
        }
        let origin = DVec2::splat(self.layout.margin) - start;
        let seen = |line: &CutLine| {
            let ends = clip(line.ends, start, end)?.map(|p| p + origin);
            Some(CutLine { ends, ..*line })
        };
        let number = PageNumber { row, column, rows: self.rows, columns: self.columns };
        CutPage {
            pattern: self.pattern,
            number: Some(number),
            size: self.layout.paper,
            origin,
            margin: self.layout.margin,
            lines: self.pattern.lines.iter().filter_map(seen).collect(),
            marks: self.marks(number),
        }
    }

    /// The lines where this page and its neighbours begin, each with two ticks across it. A line that two pages
    /// share is drawn on both at the same position in the pattern.
    fn marks(&self, number: PageNumber) -> Vec<[DVec2; 2]> {
        let low = DVec2::splat(self.layout.margin);
        let high = low + self.window;
        let glue = high - DVec2::splat(self.layout.overlap);
        let mut marks = Vec::new();
        let mut mark = |at: f64, from: f64, to: f64, turn: fn(f64, f64) -> DVec2| {
            marks.push([turn(at, from), turn(at, to)]);
            for share in [0.25, 0.75] {
                let along = from + share * (to - from);
                marks.push([turn(at - TICK, along), turn(at + TICK, along)]);
            }
        };
        if number.column > 0 {
            mark(low.x, low.y, high.y, DVec2::new);
        }
        if number.column + 1 < number.columns {
            mark(glue.x, low.y, high.y, DVec2::new);
        }
        if number.row > 0 {
            mark(low.y, low.x, high.x, |y, x| DVec2::new(x, y));
        }
        if number.row + 1 < number.rows {
            mark(glue.y, low.x, high.x, |y, x| DVec2::new(x, y));
        }
        marks.into_iter().filter_map(|ends| clip(ends, DVec2::ZERO, self.layout.paper)).collect()
    }
}

/// The part of a line inside a box, in the same direction; `None` if it has no length there.
///
/// A line along a side of the box and within [`SEAM`] of it is inside. Ends that lie inside are kept bit for bit; new
/// ends lie exactly on the side of the box that cuts the line. Source: Liang & Barsky 1984, "A new concept and method
/// for line clipping".
fn clip([from, to]: [DVec2; 2], low: DVec2, high: DVec2) -> Option<[DVec2; 2]> {
    let along = to - from;
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let (start, step) = (from[axis], along[axis]);
        if step == 0.0 {
            if start < low[axis] - SEAM || start > high[axis] + SEAM {
                return None;
            }
            continue;
        }
        let (near, far) =
            if step > 0.0 { (low[axis], high[axis]) } else { (high[axis], low[axis]) };
        enter = enter.max((near - start) / step);
        leave = leave.min((far - start) / step);
    }
    let at = |share: f64| match share {
        0.0 => from,
        1.0 => to,
        _ => (from + share * along).clamp(low, high),
    };
    let ends = [at(enter), at(leave)];
    (enter < leave && ends[0] != ends[1]).then_some(ends)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clipped(ends: [[f64; 2]; 2]) -> Option<[[f64; 2]; 2]> {
        let ends = clip(ends.map(DVec2::from), DVec2::ZERO, DVec2::new(3.0, 2.0))?;
        Some(ends.map(|p| p.to_array()))
    }

    #[test]
    fn a_line_is_cut_exactly_where_it_leaves_the_box() {
        assert_eq!(clipped([[-1.0, 1.0], [5.0, 1.0]]), Some([[0.0, 1.0], [3.0, 1.0]]));
        assert_eq!(clipped([[4.0, 3.0], [0.0, -1.0]]), Some([[3.0, 2.0], [1.0, 0.0]]));
        let third = 1.0 / 3.0;
        assert_eq!(clipped([[third, third], [2.0, 0.7]]), Some([[third, third], [2.0, 0.7]]));
        let [from, to] = clipped([[0.1, 0.2], [7.3, 9.1]]).unwrap();
        assert_eq!((from, to[1]), ([0.1, 0.2], 2.0));
    }

    #[test]
    fn lines_outside_and_touching_points_are_left_out() {
        for ends in [
            [[-1.0, 0.5], [-0.1, 0.5]],
            [[0.5, 2.5], [2.0, 2.1]],
            [[-1.0, 1.0], [1.0, -1.0]],
            [[3.0, 2.0], [4.0, 3.0]],
            [[2.9, 3.0], [4.0, 1.9]],
        ] {
            assert_eq!(clipped(ends), None, "{ends:?}");
        }
    }

    #[test]
    fn a_line_on_the_side_of_the_box_is_inside() {
        assert_eq!(clipped([[0.0, -1.0], [0.0, 5.0]]), Some([[0.0, 0.0], [0.0, 2.0]]));
    }
}
