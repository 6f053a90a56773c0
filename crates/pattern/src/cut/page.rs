//! One piece of paper: its lines and marks.

use glam::DVec2;

use super::{CutLine, CutPattern, LineClass};

/// The number of a page among the tiles of a pattern, counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PageNumber {
    /// Row of the page, counted from the top.
    pub row: usize,
    /// Column of the page, counted from the left.
    pub column: usize,
    /// The number of rows of pages.
    pub rows: usize,
    /// The number of columns of pages.
    pub columns: usize,
}

/// A page: its lines, and the marks by which tiles are put together.
#[derive(Debug, Clone, PartialEq)]
pub struct CutPage<'a> {
    pub(super) pattern: &'a CutPattern,
    /// Its number among the tiles; `None` for the whole pattern.
    pub number: Option<PageNumber>,
    /// Width and height of the paper, mm.
    pub size: DVec2,
    /// The position of the origin of the pattern on the page, mm.
    pub origin: DVec2,
    /// White space on every side, mm.
    pub(super) margin: f64,
    /// Lines in page coordinates, mm, y downwards, in the order of the pattern.
    pub lines: Vec<CutLine>,
    /// Marks in page coordinates: where the neighbouring pages begin, with ticks across.
    pub marks: Vec<[DVec2; 2]>,
}

impl CutPattern {
    /// The whole pattern on one page of its own size, with its margin around it.
    pub fn whole(&self) -> CutPage<'_> {
        CutPage::whole(self)
    }
}

impl<'a> CutPage<'a> {
    pub(super) fn whole(pattern: &'a CutPattern) -> Self {
        let margin = DVec2::splat(pattern.options.margin);
        let shifted = |line: &CutLine| CutLine { ends: line.ends.map(|end| end + margin), ..*line };
        Self {
            pattern,
            number: None,
            size: pattern.size + 2.0 * margin,
            origin: margin,
            margin: pattern.options.margin,
            lines: pattern.lines.iter().map(shifted).collect(),
            marks: Vec::new(),
        }
    }

    /// The lines of a class.
    pub fn of(&self, class: LineClass) -> impl Iterator<Item = &CutLine> {
        self.lines.iter().filter(move |line| line.class == class)
    }

    /// The label of a tile: its number among the others.
    pub(super) fn label(&self) -> Option<String> {
        let PageNumber { row, column, rows, columns } = self.number?;
        Some(format!("page {}-{} of {rows} x {columns} (row-column)", row + 1, column + 1))
    }

    /// The lower left corner of the label of a tile and the height of its letters, mm: in the margin if it has room.
    pub(super) fn label_position(&self) -> (DVec2, f64) {
        let margin = self.margin;
        let height = (self.size.min_element() / 40.0).min(4.0);
        let below = (margin - height).max(0.0) / 2.0;
        (DVec2::new(margin + height, self.size.y - below), height)
    }
}
