//! The sheet of Nr × Nc units: its lines, vertices, facets and creases.
//!
//! Lines run across the rows at the breaks of every column, E | P | Q | Q | P | E; lines that coincide are one. In an
//! even row (the paper's U^O) the corner lines are P and the mid lines Q; in an odd row (U^E) they swap. E lines, at
//! the two borders of a sheet with side pads, behave as P.

use std::collections::BTreeMap;

use glam::DVec2;

use crate::facet_model::{CutFacets, MiddleNode};
use crate::{
    Assignment, Case, CreaseKind, Edge, Facet, FacetKind, FacetModel, Folding, PatternError, Sheet,
    Unit, clashes,
};

/// Counts are limited so that every index fits into 32 bits with room to spare.
const MOST_UNITS: usize = 50_000_000;

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

/// What lies between two neighbouring lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Strip {
    /// Half a unit; one of its lines is a corner line, the other a mid line.
    Half,
    /// A pad, with its column (the smaller index for one between two).
    Pad(u32),
}

/// Where a vertex lies in the layout.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Place {
    /// On the boundary above row `boundary`.
    Boundary { boundary: u32 },
    /// A mid vertex of `row`: the upper (M1) or the lower one (M2), or both in one.
    Mid { row: u32, lower: bool, both: bool },
}

/// A sheet of units with what its states and its report need to know of every vertex.
#[derive(Debug, Clone, PartialEq)]
pub struct UnitSheet {
    /// The unit; where rows have their own heights, one with the parts all rows share and their mean height.
    pub unit: Unit,
    /// How it folds.
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
    /// How its quadrilaterals are cut.
    pub(crate) facet_model: FacetModel,
    /// The line and the place of each vertex of the crease pattern.
    pub(crate) places: Vec<(u32, Place)>,
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

    /// Lays out one row for each of `units`, in `columns` columns: rows of their own heights that share the widths w, a,
    /// s and 2d ([`common_flap`](crate::common_flap), or [`own_cases`](crate::own_cases) where those meet).
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
        let Builder {
            mut vertices,
            places,
            facets,
            ..
        } = builder;
        let CutFacets {
            triangles,
            middle_nodes,
        } = CutFacets::new(facet_model, &mut vertices, &facets);
        let (sheet, compact_angles) = join(&unit, &lines, &places, vertices, facets, &triangles);
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
            places,
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

/// Whether lines of `family` are mid lines in `row`.
pub(crate) fn is_mid(family: Family, row: u32) -> bool {
    (family == Family::Q) == row.is_multiple_of(2)
}

/// A map is creased between its columns, so that their pads end there; else pads of two neighbouring columns are one.
fn lines(unit: &Unit, columns: usize, folding: Folding) -> (Vec<Line>, Vec<Strip>) {
    let is_map = folding == Folding::Map;
    let mut lines = Vec::new();
    let mut strips = Vec::new();
    let has_sides = unit.side_pad > 0.0;
    let mut compact_y = 0.0;
    for column in 0..columns as u32 {
        let start = f64::from(column) * unit.width;
        let end = f64::from(column + 1) * unit.width;
        let line = |family, y, compact_y| Line {
            family,
            y,
            compact_y,
            column,
        };
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
        lines.push(line(
            Family::Q,
            start + unit.side_pad + unit.flap,
            compact_y,
        ));
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

struct Builder<'a> {
    units: &'a [Unit],
    boundaries: &'a [f64],
    lines: &'a [Line],
    vertices: Vec<DVec2>,
    places: Vec<(u32, Place)>,
    index: BTreeMap<(u32, u32, u8), u32>,
    facets: Vec<Facet>,
}

impl<'a> Builder<'a> {
    /// Numbers the vertices row by row, so that neighbours lie close in memory.
    fn new(units: &'a [Unit], boundaries: &'a [f64], lines: &'a [Line]) -> Self {
        let rows = units.len();
        let mut builder = Self {
            units,
            boundaries,
            lines,
            vertices: Vec::new(),
            places: Vec::new(),
            index: BTreeMap::new(),
            facets: Vec::new(),
        };
        for row in 0..=rows as u32 {
            for line in 0..lines.len() as u32 {
                builder.add_vertex(line, Place::Boundary { boundary: row }, row, 0);
            }
            if row == rows as u32 {
                break;
            }
            let is_mid_line = |&line: &u32| is_mid(lines[line as usize].family, row);
            for line in (0..lines.len() as u32).filter(is_mid_line) {
                let both = !units[row as usize].split;
                builder.add_vertex(
                    line,
                    Place::Mid {
                        row,
                        lower: false,
                        both,
                    },
                    row,
                    1,
                );
                if !both {
                    builder.add_vertex(
                        line,
                        Place::Mid {
                            row,
                            lower: true,
                            both,
                        },
                        row,
                        2,
                    );
                }
            }
        }
        builder
    }

    fn add_vertex(&mut self, line: u32, place: Place, row: u32, part: u8) {
        let at = |boundary: u32| self.boundaries[boundary as usize];
        let mid_distance = |row: u32| self.units[row as usize].mid_distance();
        let x = match place {
            Place::Boundary { boundary } => at(boundary),
            Place::Mid {
                row, lower: false, ..
            } => at(row) - mid_distance(row),
            Place::Mid {
                row, lower: true, ..
            } => at(row + 1) + mid_distance(row),
        };
        self.index
            .insert((row, line, part), self.vertices.len() as u32);
        self.vertices
            .push(DVec2::new(x, self.lines[line as usize].y));
        self.places.push((line, place));
    }

    fn top(&self, row: u32, line: u32) -> u32 {
        self.index[&(row, line, 0)]
    }

    fn bottom(&self, row: u32, line: u32) -> u32 {
        self.index[&(row + 1, line, 0)]
    }

    /// (M1, M2) of a mid line; the same vertex twice where it is not split.
    fn mids(&self, row: u32, line: u32) -> (u32, u32) {
        let upper = self.index[&(row, line, 1)];
        (
            upper,
            self.index.get(&(row, line, 2)).copied().unwrap_or(upper),
        )
    }

    fn add_strip(&mut self, row: u32, left: usize, strip: Strip) {
        let (l, r) = (left as u32, left as u32 + 1);
        let left_is_mid = is_mid(self.lines[left].family, row);
        match (strip, left_is_mid) {
            (Strip::Half, true) => self.add_half(row, r, l),
            (Strip::Half, false) => self.add_half(row, l, r),
            (Strip::Pad(column), true) => self.add_walls(row, column, l, r),
            (Strip::Pad(column), false) => {
                let pad = [
                    self.top(row, l),
                    self.top(row, r),
                    self.bottom(row, r),
                    self.bottom(row, l),
                ];
                self.add_facet(row, column, FacetKind::TopPad, &pad);
            }
        }
    }

    fn add_half(&mut self, row: u32, corner: u32, mid: u32) {
        let (corner_top, mid_top) = (self.top(row, corner), self.top(row, mid));
        let (corner_bottom, mid_bottom) = (self.bottom(row, corner), self.bottom(row, mid));
        let (m1, m2) = self.mids(row, mid);
        // Of its two lines the right one always lies in the half unit's own column.
        let column = self.lines[corner.max(mid) as usize].column;
        self.add_facet(row, column, FacetKind::Tuck, &[corner_top, mid_top, m1]);
        if m1 == m2 {
            self.add_facet(
                row,
                column,
                FacetKind::Flap,
                &[corner_top, m1, corner_bottom],
            );
        } else {
            self.add_facet(
                row,
                column,
                FacetKind::Flap,
                &[corner_top, m1, m2, corner_bottom],
            );
        }
        self.add_facet(
            row,
            column,
            FacetKind::Tuck,
            &[corner_bottom, m2, mid_bottom],
        );
    }

    fn add_walls(&mut self, row: u32, column: u32, l: u32, r: u32) {
        let ((l1, l2), (r1, r2)) = (self.mids(row, l), self.mids(row, r));
        let upper = [self.top(row, l), self.top(row, r), r1, l1];
        let lower = [l2, r2, self.bottom(row, r), self.bottom(row, l)];
        self.add_facet(row, column, FacetKind::Wall, &upper);
        if l1 != l2 {
            self.add_facet(row, column, FacetKind::BottomPad, &[l1, r1, r2, l2]);
        }
        self.add_facet(row, column, FacetKind::Wall, &lower);
    }

    fn add_facet(&mut self, row: u32, column: u32, kind: FacetKind, polygon: &[u32]) {
        let mut polygon = polygon.to_vec();
        if signed_area(&self.vertices, &polygon) < 0.0 {
            polygon.reverse();
        }
        self.facets.push(Facet {
            polygon,
            row,
            column,
            kind,
        });
    }
}

fn signed_area(vertices: &[DVec2], polygon: &[u32]) -> f64 {
    let point = |i: usize| vertices[polygon[i % polygon.len()] as usize];
    (0..polygon.len())
        .map(|i| point(i).perp_dot(point(i + 1)))
        .sum::<f64>()
        / 2.0
}

/// Joins the triangles of the facets by edges.
fn join(
    unit: &Unit,
    lines: &[Line],
    places: &[(u32, Place)],
    vertices: Vec<DVec2>,
    facets: Vec<Facet>,
    triangles: &[Vec<[u32; 3]>],
) -> (Sheet, Vec<f64>) {
    let faces = triangles.concat();
    let of_facet = |(facet, triangles): (usize, &Vec<_>)| vec![facet as u32; triangles.len()];
    let face_facets: Vec<u32> = triangles.iter().enumerate().flat_map(of_facet).collect();
    let mut sides: BTreeMap<[u32; 2], [Option<u32>; 2]> = BTreeMap::new();
    for (face, &[a, b, c]) in faces.iter().enumerate() {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let side = usize::from(from > to);
            sides.entry([from.min(to), from.max(to)]).or_default()[side] = Some(face as u32);
        }
    }
    let mut edges = Vec::with_capacity(sides.len());
    let mut compact_angles = Vec::with_capacity(sides.len());
    for (ends, around) in sides {
        let facet_of = |face: Option<u32>| face.map(|f| face_facets[f as usize]);
        let (kind, angle) = match (facet_of(around[0]), facet_of(around[1])) {
            (Some(a), Some(b)) if a == b => (CreaseKind::Facet, 0.0),
            (Some(a), Some(b)) => {
                let (a, b) = (&facets[a as usize], &facets[b as usize]);
                crease(a, b, lines, places, ends)
            }
            _ => (CreaseKind::Border, 0.0),
        };
        let assignment = match kind {
            CreaseKind::Border => Assignment::Border,
            CreaseKind::Facet => Assignment::Facet,
            _ if angle > 0.0 => Assignment::Valley,
            _ => Assignment::Mountain,
        };
        let near = around
            .iter()
            .flatten()
            .map(|&f| &facets[face_facets[f as usize] as usize]);
        let row = near.clone().map(|f| f.row).max().unwrap_or(0);
        let column = near.map(|f| f.column).min().unwrap_or(0);
        edges.push(Edge {
            vertices: ends,
            assignment,
            kind,
            row,
            column,
            faces: around,
        });
        compact_angles.push(angle);
    }
    let sheet = Sheet {
        vertices,
        edges,
        faces,
        face_facets,
        facets,
        unit_length: unit.height,
    };
    (sheet, compact_angles)
}

/// Triangles of a facet, counter-clockwise: a quadrilateral is split by the shorter diagonal (ties by the lowest vertex).
pub(crate) fn split(vertices: &[DVec2], polygon: &[u32]) -> Vec<[u32; 3]> {
    let &[a, b, c, d] = polygon else {
        return vec![[polygon[0], polygon[1], polygon[2]]];
    };
    let length = |i: u32, j: u32| vertices[i as usize].distance(vertices[j as usize]);
    let (ac, bd) = (length(a, c), length(b, d));
    // Lengths that differ only by rounding tie.
    let tie = (ac - bd).abs() <= 1e-12 * ac.max(bd);
    let lowest_on_ac = a.min(c) < b.min(d);
    if (tie && lowest_on_ac) || (!tie && ac < bd) {
        vec![[a, b, c], [a, c, d]]
    } else {
        vec![[a, b, d], [b, c, d]]
    }
}

/// The kind of the crease between two facets and its fold angle in the compact state, radians.
fn crease(
    a: &Facet,
    b: &Facet,
    lines: &[Line],
    places: &[(u32, Place)],
    ends: [u32; 2],
) -> (CreaseKind, f64) {
    use FacetKind::{BottomPad, Flap, Tuck, Wall};
    use std::f64::consts::{FRAC_PI_2, PI};
    let either = |kind| a.kind == kind || b.kind == kind;
    let both = |kind| a.kind == kind && b.kind == kind;
    if a.row != b.row {
        // Tuck–tuck, or top pad–wall.
        return (CreaseKind::Row, if both(Tuck) { -PI } else { -FRAC_PI_2 });
    }
    if both(Tuck) {
        (CreaseKind::Vertical, -PI)
    } else if both(Flap) {
        let family = lines[places[ends[0] as usize].0 as usize].family;
        (
            CreaseKind::Vertical,
            if is_mid(family, a.row) { PI } else { -PI },
        )
    } else if both(Wall) {
        (CreaseKind::Pad, PI)
    } else if either(BottomPad) {
        (CreaseKind::Pad, FRAC_PI_2)
    } else if either(Flap) && either(Tuck) {
        (CreaseKind::Diagonal, PI)
    } else {
        // Flap–top pad, tuck–wall.
        (CreaseKind::Pad, -FRAC_PI_2)
    }
}
