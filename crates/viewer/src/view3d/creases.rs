//! The choice of creases that are drawn.

use foldmotion_pattern::{Assignment, CreaseKind, Edge, Sheet};
use serde::{Deserialize, Serialize};

/// The classes of creases that are drawn: an edge is drawn if both its assignment and its kind are on. Diagonals inside
/// facets are never drawn.
#[expect(clippy::struct_excessive_bools, reason = "each is a switch in the window")]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct CreaseClasses {
    pub(crate) mountains: bool,
    pub(crate) valleys: bool,
    pub(crate) border: bool,
    /// Hinges that nothing drives.
    pub(crate) free: bool,
    /// Creases on the boundary between two rows.
    pub(crate) row: bool,
    /// Creases between a flap and a tuck.
    pub(crate) diagonal: bool,
    /// Creases along a corner line or a middle line.
    pub(crate) vertical: bool,
    /// Creases beside or across a pad.
    pub(crate) pad: bool,
    /// Creases between two columns.
    pub(crate) column: bool,
}

impl Default for CreaseClasses {
    fn default() -> Self {
        Self::uniform(true)
    }
}

impl CreaseClasses {
    pub(crate) const NONE: Self = Self::uniform(false);

    const fn uniform(is_drawn: bool) -> Self {
        Self {
            mountains: is_drawn,
            valleys: is_drawn,
            border: is_drawn,
            free: is_drawn,
            row: is_drawn,
            diagonal: is_drawn,
            vertical: is_drawn,
            pad: is_drawn,
            column: is_drawn,
        }
    }

    pub(crate) fn shows(&self, edge: &Edge) -> bool {
        let assigned = match edge.assignment {
            Assignment::Mountain => self.mountains,
            Assignment::Valley => self.valleys,
            Assignment::Border => self.border,
            Assignment::Free => self.free,
            Assignment::Facet => false,
        };
        let of_kind = match edge.kind {
            CreaseKind::Row => self.row,
            CreaseKind::Diagonal => self.diagonal,
            CreaseKind::Vertical => self.vertical,
            CreaseKind::Pad => self.pad,
            CreaseKind::Column => self.column,
            CreaseKind::Imported | CreaseKind::Border | CreaseKind::Facet => true,
        };
        assigned && of_kind
    }

    /// The records that the shader's `crease_vertex` reads, one per crease: its two ends, the third corners of the
    /// triangles on its left and right, the indices of these triangles, and the index of its colour.
    pub(super) fn lines(&self, sheet: &Sheet) -> Vec<[u32; 7]> {
        let line = |edge: &Edge| {
            let [a, b] = edge.vertices;
            let faces = edge.faces;
            let apex = |face: Option<u32>| face.and_then(|face| sheet.apex(face, edge));
            let [left, right] = faces.map(|face| apex(face).unwrap_or(a));
            let [of_left, of_right] = faces.map(|face| face.unwrap_or(u32::MAX));
            [a, b, left, right, of_left, of_right, ink(edge.assignment)]
        };
        let shown = sheet.edges.iter().filter(|edge| self.shows(edge));
        shown.map(line).collect()
    }
}

/// The index of the colour in the shader's `inks`.
pub(super) fn ink(assignment: Assignment) -> u32 {
    match assignment {
        Assignment::Mountain => 1,
        Assignment::Valley => 2,
        Assignment::Border | Assignment::Facet | Assignment::Free => 0,
    }
}

#[cfg(test)]
mod tests {
    use foldmotion_pattern::{Case, Unit, UnitSheet};

    use super::*;

    #[test]
    fn a_class_that_is_off_hides_only_its_creases_and_facet_diagonals_are_never_drawn() {
        let unit = Unit::new(Case::S, 1.6, 1.0, None, None).unwrap();
        let sheet = UnitSheet::new(unit, 3, 2).unwrap().sheet;
        let count = |is: &dyn Fn(&Edge) -> bool| sheet.edges.iter().filter(|edge| is(edge)).count();
        let drawn = count(&|edge| edge.assignment != Assignment::Facet);
        let all = CreaseClasses::default();
        assert_eq!(all.lines(&sheet).len(), drawn);
        let without = CreaseClasses { valleys: false, row: false, ..all };
        let taken = count(&|edge| {
            edge.assignment != Assignment::Facet
                && (edge.assignment == Assignment::Valley || edge.kind == CreaseKind::Row)
        });
        assert!(taken > 0);
        assert_eq!(without.lines(&sheet).len(), drawn - taken);
    }

    #[test]
    fn a_line_names_the_third_corners_of_its_triangles() {
        let unit = Unit::new(Case::E, 1.0, 1.0, None, None).unwrap();
        let sheet = UnitSheet::new(unit, 2, 1).unwrap().sheet;
        for [a, b, left, right, of_left, of_right, _] in CreaseClasses::default().lines(&sheet) {
            for (apex, face) in [(left, of_left), (right, of_right)] {
                if face == u32::MAX {
                    continue;
                }
                let mut corners = sheet.faces[face as usize];
                let mut named = [a, b, apex];
                corners.sort_unstable();
                named.sort_unstable();
                assert_eq!(corners, named);
            }
        }
    }
}
