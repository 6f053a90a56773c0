//! Map folding: the grid of Nr × Nc units folded to one unit (discussion of the paper; Lunnon 1971, "Multi-dimensional
//! map-folding").
//!
//! The creases inside the units are held flat and the lines between units become the creases. Of the many orders in
//! which a map folds, this is the plainest: the columns fold like an accordion, then the stack of them folds like an
//! accordion row by row. Unit (i, j) then lies at rank i·Nc + j in even rows and i·Nc + (Nc − 1 − j) in odd ones,
//! counted from unit (0, 0), whose front faces up; the fronts of neighbours face opposite directions.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use glam::DVec3;

use crate::unit_sheet::VertexLocation;
use crate::{
    Assignment, CompactBox, CreaseKind, Facet, FacetKind, Folding, PatternError, Unit, UnitSheet,
};

impl UnitSheet {
    /// The sheet of [`Self::with_rows`] folded like a map: one facet a unit, creases between units only, also between
    /// the columns of cases S and SII.
    ///
    /// # Errors
    /// As [`Self::with_rows`].
    pub fn map_folded(units: &[Unit], columns: usize) -> Result<Self, PatternError> {
        Self::laid_out(units, columns, Folding::Map)
    }

    /// Turns a sheet of waterbomb units into a map.
    pub(crate) fn fold_between_units(&mut self) {
        self.unite_facets();
        self.crease_between_units();
    }

    /// Nr·Nc layers of a map; `None` for a sheet that folds unit by unit.
    pub fn map_layers(&self) -> Option<usize> {
        (self.folding == Folding::Map).then_some(self.rows * self.columns)
    }

    /// The rank of unit (i, j) in the stack of a folded map, counted upwards from unit (0, 0).
    pub fn map_rank(&self, row: u32, column: u32) -> u64 {
        let columns = self.columns as u64;
        let (row, column) = (u64::from(row), u64::from(column));
        let within = if row.is_multiple_of(2) { column } else { columns - 1 - column };
        row * columns + within
    }

    /// One facet a unit, its corners and what else lies on its border.
    fn unite_facets(&mut self) {
        let columns = self.columns as u32;
        let index = |facet: &Facet| facet.row * columns + facet.column;
        let sheet = &mut self.sheet;
        for facet in &mut sheet.face_facets {
            *facet = index(&sheet.facets[*facet as usize]);
        }
        let count = self.rows * self.columns;
        let mut next: Vec<BTreeMap<u32, u32>> = vec![BTreeMap::new(); count];
        for edge in &sheet.edges {
            let of = edge.faces.map(|face| face.map(|f| sheet.face_facets[f as usize]));
            if of[0] == of[1] {
                continue;
            }
            let [from, to] = edge.vertices;
            for (unit, from, to) in [(of[0], from, to), (of[1], to, from)] {
                if let Some(unit) = unit {
                    next[unit as usize].insert(from, to);
                }
            }
        }
        let facet = |(unit, next): (usize, BTreeMap<u32, u32>)| Facet {
            polygon: loop_of(&next),
            row: unit as u32 / columns,
            column: unit as u32 % columns,
            kind: FacetKind::Unit,
        };
        sheet.facets = next.into_iter().enumerate().map(facet).collect();
    }

    fn crease_between_units(&mut self) {
        for index in 0..self.sheet.edges.len() {
            let edge = &self.sheet.edges[index];
            let [Some(left), Some(right)] = edge.faces else {
                continue;
            };
            let of = [left, right].map(|f| {
                let facet = &self.sheet.facets[self.sheet.face_facets[f as usize] as usize];
                (facet.row, facet.column)
            });
            let (kind, angle) = if of[0] == of[1] {
                (CreaseKind::Facet, 0.0)
            } else {
                let (lower, upper) = (of[0].min(of[1]), of[0].max(of[1]));
                let kind = if lower.0 == upper.0 { CreaseKind::Column } else { CreaseKind::Row };
                // A valley lays the facets front on front: the upper one on the front of one that faces up.
                let is_above = self.map_rank(upper.0, upper.1) > self.map_rank(lower.0, lower.1);
                let faces_up = (lower.0 + lower.1).is_multiple_of(2);
                (kind, if is_above == faces_up { PI } else { -PI })
            };
            let edge = &mut self.sheet.edges[index];
            edge.kind = kind;
            edge.assignment = match kind {
                CreaseKind::Facet => Assignment::Facet,
                _ if angle > 0.0 => Assignment::Valley,
                _ => Assignment::Mountain,
            };
            self.compact_angles[index] = angle;
        }
    }

    /// Folded flat: columns over columns, rows over rows, all in the plane z = 0.
    pub(crate) fn compact_map(&self) -> Vec<DVec3> {
        let starts = self.map_boundaries();
        let width = self.unit.width;
        let position = |&(line, location): &(u32, VertexLocation)| {
            let line = &self.lines[line as usize];
            let from_start = line.y - f64::from(line.column) * width;
            let y = if line.column.is_multiple_of(2) { from_start } else { width - from_start };
            let x = match location {
                VertexLocation::Boundary { boundary } => starts[boundary as usize],
                VertexLocation::Mid { row, lower, .. } => {
                    let unit = &self.row_units[row as usize];
                    let fraction = unit.mid_distance() / unit.height;
                    let fraction = if lower { 1.0 - fraction } else { fraction };
                    let (from, to) = (starts[row as usize], starts[row as usize + 1]);
                    from + (to - from) * fraction
                }
            };
            DVec3::new(x, y, 0.0)
        };
        self.with_middle_nodes(self.locations.iter().map(position).collect())
    }

    /// The box of a folded map: x spans the zigzag of the rows (h where they are equal), y one column.
    pub(crate) fn map_box(&self) -> CompactBox {
        let starts = self.map_boundaries();
        let low = starts.iter().copied().fold(f64::INFINITY, f64::min);
        let high = starts.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        CompactBox { extents: [high - low, self.unit.width, 0.0], area: 0.0, volume: 0.0 }
    }

    /// x of each row boundary in the folded map.
    fn map_boundaries(&self) -> Vec<f64> {
        let mut starts = vec![0.0];
        for (row, unit) in self.row_units.iter().enumerate() {
            let step = if row.is_multiple_of(2) { -unit.height } else { unit.height };
            starts.push(starts[row] + step);
        }
        starts
    }
}

/// The closed loop that `next` leads through, from its lowest vertex.
fn loop_of(next: &BTreeMap<u32, u32>) -> Vec<u32> {
    let mut polygon: Vec<u32> = next.keys().next().copied().into_iter().collect();
    while let Some(&to) = polygon.last().and_then(|from| next.get(from)) {
        if to == polygon[0] || polygon.len() > next.len() {
            break;
        }
        polygon.push(to);
    }
    polygon
}
