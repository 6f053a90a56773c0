//! How many facets coincide in the compact state, computed before a sheet is laid out.
//!
//! In case E all columns lie in one plane, and a map is one stack: the number of pairs is a polynomial of second degree
//! in the columns and, for rows of one parity, in the rows. Nine small sheets give it.

use crate::{Case, Folding, Unit, UnitSheet};

/// Columns and rows of the smallest of the small sheets: ends of a sheet no longer reach each other.
const FIRST: [usize; 2] = [3, 4];

/// Steps from one small sheet to the next.
const STEP: [usize; 2] = [1, 2];

impl UnitSheet {
    /// The number of entries of [`Self::compact_order`] of `rows` × `columns` of this `unit`; `None` if it is not known
    /// without laying them out (small sheets, and cases whose columns lie beside each other).
    pub fn count_compact_order(
        unit: Unit,
        rows: usize,
        columns: usize,
        folding: Folding,
    ) -> Option<f64> {
        let is_one_stack = folding == Folding::Map || unit.case == Case::E;
        let first_row = FIRST[1] + rows % 2;
        if !is_one_stack || columns < FIRST[0] || rows < first_row {
            return None;
        }
        let of = |rows: usize, columns: usize| -> Option<f64> {
            let sheet = Self::laid_out(&vec![unit; rows], columns, folding).ok()?;
            Some(sheet.compact_order().len() as f64)
        };
        let of_rows = |k: usize| {
            let rows = first_row + k * STEP[1];
            let counts = [0, 1, 2].map(|k| of(rows, FIRST[0] + k * STEP[0]));
            let [Some(a), Some(b), Some(c)] = counts else {
                return None;
            };
            Some(continued([a, b, c], (columns - FIRST[0]) / STEP[0]))
        };
        let [Some(a), Some(b), Some(c)] = [0, 1, 2].map(of_rows) else {
            return None;
        };
        Some(continued([a, b, c], (rows - first_row) / STEP[1]))
    }
}

/// The value at `k` of the polynomial of second degree that has these values at 0, 1 and 2 (Newton's forward
/// differences).
fn continued([a, b, c]: [f64; 3], k: usize) -> f64 {
    let k = k as f64;
    a + k * (b - a) + k * (k - 1.0) / 2.0 * (c - 2.0 * b + a)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_count_is_that_of_the_order_itself() {
        let square = Unit::new(Case::E, 1.0, 1.0, None, None).unwrap();
        let short = Unit::new(Case::Plain, 2.5, 1.0, None, None).unwrap();
        for (rows, columns) in [(4, 3), (5, 11), (7, 5), (12, 8), (9, 20)] {
            for (unit, folding) in
                [(square, Folding::Waterbomb), (square, Folding::Map), (short, Folding::Map)]
            {
                let sheet = UnitSheet::laid_out(&vec![unit; rows], columns, folding).unwrap();
                let exact = sheet.compact_order().len() as f64;
                let told = UnitSheet::count_compact_order(unit, rows, columns, folding);
                assert_eq!(told, Some(exact), "{rows} x {columns} {folding:?}");
            }
        }
    }

    #[test]
    fn columns_beside_each_other_are_not_counted() {
        let unit = Unit::new(Case::S, 1.6, 1.0, None, None).unwrap();
        let told = UnitSheet::count_compact_order(unit, 10, 10, Folding::Waterbomb);
        assert_eq!(told, None);
    }
}
