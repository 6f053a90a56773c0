//! The names the paper gives the vertices of a unit (figures 3, 4 and 5a–b).

use crate::UnitSheet;
use crate::unit_sheet::{Family, VertexLocation};

impl UnitSheet {
    /// The paper's name of a vertex as part of the unit at (`row`, `column`): C1 … C7 in a unit U^O, D1 … D8 in a
    /// unit U^E, with the superscripts 1 and 2 for the two halves of a split vertex, such as `C4^1`.
    ///
    /// `None` for vertices of other units, the outer corners of pads, and units with a centre pad, whose two mid lines
    /// share the names.
    pub fn vertex_name(&self, vertex: u32, row: u32, column: u32) -> Option<String> {
        let &(line, location) = self.locations.get(vertex as usize)?;
        let line = self.lines[line as usize];
        if self.unit.centre_pad > 0.0 {
            return None;
        }
        let side = self.side_of(line.family, line.y, column)?;
        let even = row.is_multiple_of(2);
        let number = match (location, side) {
            (VertexLocation::Boundary { boundary }, side) if boundary == row => 1 + side,
            (VertexLocation::Boundary { boundary }, side) if boundary == row + 1 => {
                5 + side + u32::from(!even)
            }
            (VertexLocation::Mid { row: of, .. }, 1) if of == row && even => 4,
            (VertexLocation::Mid { row: of, .. }, side) if of == row && !even => 4 + side / 2,
            _ => return None,
        };
        let letter = if even { 'C' } else { 'D' };
        let half = match location {
            VertexLocation::Mid { both: false, lower, .. } => {
                if lower {
                    "^2"
                } else {
                    "^1"
                }
            }
            _ => "",
        };
        Some(format!("{letter}{number}{half}"))
    }

    /// 0, 1, 2 for the first corner line, the middle and the last corner line of a column.
    fn side_of(&self, family: Family, y: f64, column: u32) -> Option<u32> {
        let start = f64::from(column) * self.unit.width;
        let sides = match family {
            Family::P => vec![(0, self.unit.side_pad), (2, self.unit.width - self.unit.side_pad)],
            Family::Q => vec![(1, self.unit.width / 2.0)],
        };
        let near = |&(_, at): &(u32, f64)| (y - start - at).abs() < 1e-9 * self.unit.width;
        sides.into_iter().find(near).map(|(side, _)| side)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Case, Unit};
    use std::collections::BTreeSet;

    fn names(case: Case, width: f64, row: u32, column: u32) -> BTreeSet<String> {
        let units = UnitSheet::new(Unit::new(case, width, 1.0, None, None).unwrap(), 3, 3).unwrap();
        let all = 0..units.sheet.vertices.len() as u32;
        all.filter_map(|v| units.vertex_name(v, row, column)).collect()
    }

    #[test]
    fn every_unit_has_the_names_of_its_figure_once() {
        let expected = |list: &str| list.split(' ').map(str::to_owned).collect::<BTreeSet<_>>();
        for column in 0..3 {
            assert_eq!(names(Case::E, 1.0, 0, column), expected("C1 C2 C3 C4 C5 C6 C7"));
            assert_eq!(names(Case::S, 1.6, 1, column), expected("D1 D2 D3 D4 D5 D6 D7 D8"));
            assert_eq!(names(Case::T, 0.7, 2, column), expected("C1 C2 C3 C4^1 C4^2 C5 C6 C7"));
        }
    }

    #[test]
    fn c2_and_c6_are_the_ends_of_the_mid_line_of_a_unit() {
        let units =
            UnitSheet::new(Unit::new(Case::Plain, 2.5, 1.0, None, None).unwrap(), 1, 1).unwrap();
        let named = |name: &str| {
            let found = (0..units.sheet.vertices.len() as u32)
                .find(|&v| units.vertex_name(v, 0, 0).as_deref() == Some(name));
            units.sheet.vertices[found.unwrap() as usize]
        };
        assert_eq!((named("C2").y, named("C6").y), (1.25, 1.25));
        assert_eq!((named("C2").x, named("C6").x), (0.0, -1.0));
        assert_eq!((named("C1").y, named("C3").y), (0.0, 2.5));
    }
}
