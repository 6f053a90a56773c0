//! Sheets in several pieces: which of them are read.

use std::collections::BTreeMap;

use super::assemble::{Assembled, assemble};
use super::names::Names;
use super::open_cuts::{join, root};
use super::plan::Plan;
use super::warning::{WarningKind, Warnings};
use super::{ImportError, Pieces, Source};
use crate::Sheet;

/// The sheet of the pieces asked for; `names`: of each source of the plan.
///
/// # Errors
/// [`ImportError::Piece`], and those of [`assemble`].
pub(super) fn chosen(
    plan: &Plan,
    wanted: &Pieces,
    names: &[Names],
    warnings: &mut Warnings,
) -> Result<Assembled, ImportError> {
    let assembled = assemble(plan, warnings)?;
    let pieces = PieceList::new(plan, &assembled);
    if pieces.areas.len() < 2 || *wanted == Pieces::All {
        return Ok(assembled);
    }
    let kept = match wanted {
        Pieces::Named(name) => pieces.named(name, plan, names)?,
        Pieces::Largest | Pieces::All => pieces.largest(),
    };
    for (piece, first) in (0..).zip(pieces.first_sources(plan)) {
        if piece != kept {
            warnings.add(WarningKind::OtherPiece, &first);
        }
    }
    let facets = plan.facets.iter().zip(&pieces.of_facet);
    let facets = facets.filter(|(_, piece)| **piece == kept).map(|(facet, _)| facet.clone());
    let part = Plan { facets: facets.collect(), ..plan.clone() };
    assemble(&part, warnings)
}

/// The pieces of a sheet, in the order of the first lines of the file that belong to them.
struct PieceList {
    /// The piece of each facet.
    of_facet: Vec<u32>,
    areas: Vec<f64>,
    /// The sources of the lines of each piece, in order.
    sources: Vec<Vec<u32>>,
}

impl PieceList {
    fn new(plan: &Plan, assembled: &Assembled) -> Self {
        let sheet = &assembled.sheet;
        let roots = vertex_roots(sheet);
        let mut number: BTreeMap<u32, u32> = BTreeMap::new();
        let mut sources: Vec<Vec<u32>> = Vec::new();
        let mut edges: Vec<(u32, u32)> = Vec::new();
        for (edge, line) in sheet.edges.iter().zip(&assembled.edge_lines) {
            if let Some(line) = line {
                let source = plan.lines[*line as usize].source;
                edges.push((source, roots[edge.vertices[0] as usize]));
            }
        }
        edges.sort_unstable();
        edges.dedup();
        for (source, root) in edges {
            let piece = *number.entry(root).or_insert_with(|| {
                sources.push(Vec::new());
                sources.len() as u32 - 1
            });
            sources[piece as usize].push(source);
        }
        let mut of_facet = vec![0; sheet.facets.len()];
        let mut areas = vec![0.0; sources.len()];
        for (corners, &facet) in sheet.faces.iter().zip(&sheet.face_facets) {
            let piece = number.get(&roots[corners[0] as usize]).copied().unwrap_or_default();
            of_facet[facet as usize] = piece;
            let [a, b, c] = corners.map(|v| sheet.vertices[v as usize]);
            if let Some(area) = areas.get_mut(piece as usize) {
                *area += (b - a).perp_dot(c - a) / 2.0;
            }
        }
        Self { of_facet, areas, sources }
    }

    /// The piece with the largest area; of equals the first.
    fn largest(&self) -> u32 {
        let by_area = |a: &usize, b: &usize| {
            // Areas that differ only by rounding are equal.
            let [p, q] = [self.areas[*a], self.areas[*b]];
            if (p - q).abs() <= 1e-9 * p.max(q) { b.cmp(a) } else { p.total_cmp(&q) }
        };
        (0..self.areas.len()).max_by(by_area).unwrap_or_default() as u32
    }

    fn named(&self, name: &str, plan: &Plan, names: &[Names]) -> Result<u32, ImportError> {
        if let Some(number) = name.parse::<u32>().ok().filter(|n| (*n as usize) < self.areas.len())
        {
            return Ok(number);
        }
        let is_called = |source: &u32| {
            let of = names.get(*source as usize);
            of.is_some_and(|n| n.ids.iter().chain(&n.classes).any(|known| known == name))
        };
        let found = self.sources.iter().position(|sources| sources.iter().any(is_called));
        found.map(|piece| piece as u32).ok_or_else(|| ImportError::Piece {
            name: name.to_owned(),
            sources: self.first_sources(plan),
        })
    }

    /// The first element of each piece.
    fn first_sources(&self, plan: &Plan) -> Vec<Source> {
        let first = |sources: &Vec<u32>| sources.first().copied().unwrap_or_default();
        self.sources.iter().map(|s| plan.sources[first(s) as usize].clone()).collect()
    }
}

/// For each vertex of a sheet the first one that edges join it with.
fn vertex_roots(sheet: &Sheet) -> Vec<u32> {
    let mut joined: Vec<u32> = (0..sheet.vertices.len() as u32).collect();
    for &[a, b, c] in &sheet.faces {
        join(&mut joined, a, b);
        join(&mut joined, b, c);
    }
    (0..joined.len() as u32).map(|vertex| root(&mut joined, vertex)).collect()
}
