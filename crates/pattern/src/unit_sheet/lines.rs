//! The lines across the rows of a sheet of units.

use crate::{Folding, Unit};

/// Which of the two families a line belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Family {
    P,
    Q,
}

/// One line across the rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Line {
    pub(crate) family: Family,
    /// Position across the width in the crease pattern.
    pub(crate) y: f64,
    /// Position across the width in the compact state.
    pub(crate) compact_y: f64,
    /// The column on its left (its own for a line inside a column).
    pub(crate) column: u32,
}

/// The part of a unit between two neighbouring lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Strip {
    /// Half a unit; one of its lines is a corner line, the other a mid line.
    Half,
    /// A pad, with its column (the smaller index for one between two).
    Pad(u32),
}

/// Whether lines of `family` are mid lines in `row`.
pub(crate) fn is_mid(family: Family, row: u32) -> bool {
    (family == Family::Q) == row.is_multiple_of(2)
}

/// A map is creased between its columns, so that their pads end there; else pads of two neighbouring columns are one.
pub(super) fn lines(unit: &Unit, columns: usize, folding: Folding) -> (Vec<Line>, Vec<Strip>) {
    let is_map = folding == Folding::Map;
    let mut lines = Vec::new();
    let mut strips = Vec::new();
    let has_sides = unit.side_pad > 0.0;
    let mut compact_y = 0.0;
    for column in 0..columns as u32 {
        let start = f64::from(column) * unit.width;
        let end = f64::from(column + 1) * unit.width;
        let line = |family, y, compact_y| Line { family, y, compact_y, column };
        if column == 0 {
            lines.push(line(Family::P, 0.0, 0.0));
        }
        if has_sides {
            compact_y += unit.side_pad;
            let is_own = is_map || column == 0;
            strips.push(Strip::Pad(if is_own { column } else { column - 1 }));
            lines.push(line(Family::P, start + unit.side_pad, compact_y));
        }
        strips.push(Strip::Half);
        lines.push(line(Family::Q, start + unit.side_pad + unit.flap, compact_y));
        if unit.centre_pad > 0.0 {
            compact_y += unit.centre_pad;
            strips.push(Strip::Pad(column));
            lines.push(line(Family::Q, end - unit.side_pad - unit.flap, compact_y));
        }
        strips.push(Strip::Half);
        lines.push(line(Family::P, end - unit.side_pad, compact_y));
        if has_sides {
            compact_y += unit.side_pad;
            if is_map || column + 1 == columns as u32 {
                strips.push(Strip::Pad(column));
                lines.push(line(Family::P, end, compact_y));
            }
        }
    }
    (lines, strips)
}
