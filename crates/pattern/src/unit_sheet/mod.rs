//! The sheet of Nr × Nc units: its lines, vertices, facets and creases.
//!
//! Lines run across the rows at the breaks of every column, E | P | Q | Q | P | E; lines that coincide are one. In an
//! even row (the paper's U^O) the corner lines are P and the mid lines Q; in an odd row (U^E) they swap. E lines, at
//! the two borders of a sheet with side pads, behave as P.

mod builder;
mod join;
mod lines;
mod middle_nodes;

use self::builder::Builder;
use self::join::join;
use self::lines::lines;
use crate::facet_model::{CutFacets, MiddleNode};
use crate::{Case, FacetModel, Folding, PatternError, Sheet, Unit, clashes};

pub(crate) use self::builder::VertexLocation;
pub(crate) use self::lines::{Family, Line, is_mid};

/// Counts are limited so that every index fits into 32 bits with room to spare.
const MOST_UNITS: usize = 50_000_000;

/// A sheet of units with what its states and its report need to know about every vertex.
#[derive(Debug, Clone, PartialEq)]
pub struct UnitSheet {
    /// The unit; where rows have their own heights, one with the parts all rows share and their mean height.
    pub unit: Unit,
    /// How the sheet folds: unit by unit or like a map.
    pub folding: Folding,
    /// Nr.
    pub rows: usize,
    /// Nc.
    pub columns: usize,
    /// The triangulated crease pattern.
    pub sheet: Sheet,
    /// The unit of each row.
    pub(crate) row_units: Vec<Unit>,
    /// x of each boundary between rows, both ends included.
    pub(crate) boundaries: Vec<f64>,
    pub(crate) lines: Vec<Line>,
    /// How its quadrilaterals are cut into triangles.
    pub(crate) facet_model: FacetModel,
    /// The line and the location of each vertex of the crease pattern.
    pub(crate) locations: Vec<(u32, VertexLocation)>,
    /// The vertices after those.
    pub(crate) middle_nodes: Vec<MiddleNode>,
    /// The fold angle of every edge in the compact state, radians; 0 for edges that are not creases.
    pub(crate) compact_angles: Vec<f64>,
}

impl UnitSheet {
    /// Lays out `rows` × `columns` units, with quadrilaterals cut by one diagonal ([`Self::with_facet_model`] cuts them
    /// otherwise).
    ///
    /// # Errors
    /// Counts of 0 or beyond what 32-bit indices hold.
    pub fn new(unit: Unit, rows: usize, columns: usize) -> Result<Self, PatternError> {
        require_counts(rows, columns)?;
        Self::with_rows(&vec![unit; rows], columns)
    }

    /// Lays out one row for each of `units`, in `columns` columns: rows of their own heights that share the widths w,
    /// a, s and 2d ([`common_flap`](crate::common_flap), or [`own_cases`](crate::own_cases) where those meet).
    ///
    /// Equal units give the sheet of [`Self::new`], bit for bit.
    ///
    /// # Errors
    /// [`PatternError::RowsClash`] where the creases of two neighbouring rows do not meet; counts as in [`Self::new`].
    pub fn with_rows(units: &[Unit], columns: usize) -> Result<Self, PatternError> {
        Self::laid_out(units, columns, Folding::Waterbomb)
    }

    pub(crate) fn laid_out(
        units: &[Unit],
        columns: usize,
        folding: Folding,
    ) -> Result<Self, PatternError> {
        let rows = units.len();
        require_counts(rows, columns)?;
        if let Some(clash) = clashes(units).into_iter().next() {
            return Err(clash.into());
        }
        let first = units[0];
        if units.iter().all(|&unit| unit == first) {
            let boundaries = (0..=rows).map(|k| -(k as f64) * first.height).collect();
            return Ok(Self::assemble(
                first,
                units.to_vec(),
                boundaries,
                columns,
                folding,
                FacetModel::OneDiagonal,
            ));
        }
        let mut boundaries = vec![0.0];
        for (row, unit) in units.iter().enumerate() {
            boundaries.push(boundaries[row] - unit.height);
        }
        let has_pads = first.compact_width() > 0.0;
        let unit = Unit {
            case: if has_pads { Case::SII } else { Case::T },
            height: -boundaries[rows] / rows as f64,
            split: units.iter().any(|unit| unit.split),
            ..first
        };
        Ok(Self::assemble(
            unit,
            units.to_vec(),
            boundaries,
            columns,
            folding,
            FacetModel::OneDiagonal,
        ))
    }

    pub(crate) fn assemble(
        unit: Unit,
        row_units: Vec<Unit>,
        boundaries: Vec<f64>,
        columns: usize,
        folding: Folding,
        facet_model: FacetModel,
    ) -> Self {
        let rows = row_units.len();
        let (lines, strips) = lines(&unit, columns, folding);
        let mut builder = Builder::new(&row_units, &boundaries, &lines);
        for row in 0..rows as u32 {
            for (left, &strip) in strips.iter().enumerate() {
                builder.add_strip(row, left, strip);
            }
        }
        let Builder { mut vertices, locations, facets, .. } = builder;
        let CutFacets { triangles, middle_nodes } =
            CutFacets::new(facet_model, &mut vertices, &facets);
        let (sheet, compact_angles) = join(&unit, &lines, &locations, vertices, facets, &triangles);
        let mut units = Self {
            unit,
            folding,
            rows,
            columns,
            sheet,
            row_units,
            boundaries,
            lines,
            facet_model,
            locations,
            middle_nodes,
            compact_angles,
        };
        if folding == Folding::Map {
            units.fold_between_units();
        }
        units
    }

    /// The unit of each row: its own height and case, the same widths as every other.
    pub fn row_units(&self) -> &[Unit] {
        &self.row_units
    }

    /// Whether every row has the same height.
    pub fn has_equal_rows(&self) -> bool {
        self.row_units.iter().all(|unit| *unit == self.unit)
    }

    /// The names of the rows' cases, joined by `+` where they differ, such as `E+T`.
    pub fn case_name(&self) -> String {
        let mut names: Vec<&str> = Vec::new();
        for name in self.row_units.iter().map(|unit| unit.case.name()) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names.sort_by_key(|name| (name.len(), *name));
        names.join("+")
    }

    /// The narrowest of the parts that any row has ([`Unit::thinnest_part`]).
    pub fn thinnest_part(&self) -> f64 {
        let parts = self.row_units.iter().map(Unit::thinnest_part);
        parts.fold(f64::INFINITY, f64::min)
    }

    /// h of a row.
    pub(crate) fn row_height(&self, row: usize) -> f64 {
        self.row_units[row].height
    }

    /// The fold angle of every edge in the compact state, radians (geometry of the paper's figures 2c, 3h, 4h, 5f);
    /// 0 for edges that are not creases.
    pub fn compact_angles(&self) -> &[f64] {
        &self.compact_angles
    }

    /// The name of the unit's kind in a row: the paper's U^O for its odd rows (rows 0, 2, … here), else U^E.
    pub fn unit_name(row: u32) -> &'static str {
        if row.is_multiple_of(2) { "U^O" } else { "U^E" }
    }
}

fn require_counts(rows: usize, columns: usize) -> Result<(), PatternError> {
    for (name, value, other) in [("rows", rows, columns), ("columns", columns, rows)] {
        let limit = MOST_UNITS / other.max(1);
        if value == 0 || value > limit {
            return Err(PatternError::CountOutOfRange { name, value, limit });
        }
    }
    Ok(())
}
