//! The vertices and facets of a sheet of units.

use std::collections::BTreeMap;

use glam::DVec2;

use super::lines::{Line, Strip, is_mid};
use crate::{Facet, FacetKind, Unit};

/// The position of a vertex in the rows of units.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum VertexLocation {
    /// On the boundary above row `boundary`.
    Boundary { boundary: u32 },
    /// A mid vertex of `row`: the upper (M1) or the lower one (M2), or both in one.
    Mid { row: u32, lower: bool, both: bool },
}

/// Vertices and facets, added strip by strip.
pub(super) struct Builder<'a> {
    units: &'a [Unit],
    boundaries: &'a [f64],
    lines: &'a [Line],
    pub(super) vertices: Vec<DVec2>,
    pub(super) locations: Vec<(u32, VertexLocation)>,
    index: BTreeMap<(u32, u32, u8), u32>,
    pub(super) facets: Vec<Facet>,
}

impl<'a> Builder<'a> {
    /// Numbers the vertices row by row, so that neighbours lie close in memory.
    pub(super) fn new(units: &'a [Unit], boundaries: &'a [f64], lines: &'a [Line]) -> Self {
        let rows = units.len();
        let mut builder = Self {
            units,
            boundaries,
            lines,
            vertices: Vec::new(),
            locations: Vec::new(),
            index: BTreeMap::new(),
            facets: Vec::new(),
        };
        for row in 0..=rows as u32 {
            for line in 0..lines.len() as u32 {
                builder.add_vertex(line, VertexLocation::Boundary { boundary: row }, row, 0);
            }
            if row == rows as u32 {
                break;
            }
            let is_mid_line = |&line: &u32| is_mid(lines[line as usize].family, row);
            for line in (0..lines.len() as u32).filter(is_mid_line) {
                let both = !units[row as usize].split;
                builder.add_vertex(line, VertexLocation::Mid { row, lower: false, both }, row, 1);
                if !both {
                    builder.add_vertex(
                        line,
                        VertexLocation::Mid { row, lower: true, both },
                        row,
                        2,
                    );
                }
            }
        }
        builder
    }

    fn add_vertex(&mut self, line: u32, location: VertexLocation, row: u32, part: u8) {
        let at = |boundary: u32| self.boundaries[boundary as usize];
        let mid_distance = |row: u32| self.units[row as usize].mid_distance();
        let x = match location {
            VertexLocation::Boundary { boundary } => at(boundary),
            VertexLocation::Mid { row, lower: false, .. } => at(row) - mid_distance(row),
            VertexLocation::Mid { row, lower: true, .. } => at(row + 1) + mid_distance(row),
        };
        self.index.insert((row, line, part), self.vertices.len() as u32);
        self.vertices.push(DVec2::new(x, self.lines[line as usize].y));
        self.locations.push((line, location));
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
        (upper, self.index.get(&(row, line, 2)).copied().unwrap_or(upper))
    }

    pub(super) fn add_strip(&mut self, row: u32, left: usize, strip: Strip) {
        let (l, r) = (left as u32, left as u32 + 1);
        let left_is_mid = is_mid(self.lines[left].family, row);
        match (strip, left_is_mid) {
            (Strip::Half, true) => self.add_half(row, r, l),
            (Strip::Half, false) => self.add_half(row, l, r),
            (Strip::Pad(column), true) => self.add_walls(row, column, l, r),
            (Strip::Pad(column), false) => {
                let pad =
                    [self.top(row, l), self.top(row, r), self.bottom(row, r), self.bottom(row, l)];
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
            self.add_facet(row, column, FacetKind::Flap, &[corner_top, m1, corner_bottom]);
        } else {
            self.add_facet(row, column, FacetKind::Flap, &[corner_top, m1, m2, corner_bottom]);
        }
        self.add_facet(row, column, FacetKind::Tuck, &[corner_bottom, m2, mid_bottom]);
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
        self.facets.push(Facet { polygon, row, column, kind });
    }
}

fn signed_area(vertices: &[DVec2], polygon: &[u32]) -> f64 {
    let point = |i: usize| vertices[polygon[i % polygon.len()] as usize];
    (0..polygon.len()).map(|i| point(i).perp_dot(point(i + 1))).sum::<f64>() / 2.0
}
