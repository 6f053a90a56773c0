//! Sheets in several pieces: which of them are read.

use std::collections::{BTreeMap, BTreeSet};

use super::assemble::{Assembled, assemble};
use super::drawing::{Line, Role};
use super::names::Names;
use super::open_cuts::{join, root};
use super::plan::{self, Plan};
use super::split::Graph;
use super::warning::{WarningKind, Warnings};
use super::{ImportError, Pieces, Source};
use crate::{Edge, Sheet};

/// The area of a main piece, in parts of that of the largest.
const MAIN: f64 = 0.5;

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
    let kept: BTreeSet<u32> = match wanted {
        Pieces::Named(name) => BTreeSet::from([pieces.named(name, plan, names)?]),
        Pieces::Largest => BTreeSet::from([pieces.largest()]),
        Pieces::Main | Pieces::All => pieces.main(),
    };
    if kept.len() == pieces.areas.len() {
        return Ok(assembled);
    }
    for (piece, first) in (0..).zip(pieces.first_sources(plan)) {
        if !kept.contains(&piece) {
            warnings.add(WarningKind::OtherPiece, &first);
        }
    }
    let facets = plan.facets.iter().zip(&pieces.of_facet);
    let facets = facets.filter(|(_, piece)| kept.contains(piece)).map(|(facet, _)| facet.clone());
    let part = Plan { facets: facets.collect(), ..plan.clone() };
    assemble(&part, warnings)
}

/// Leaves out the border lines inside the sheet, or makes them facet lines where creases end on them, if as cuts they would leave the largest piece with less than half of the
/// creases: they are a grid by which the pattern was drawn.
///
/// # Errors
/// Those of [`assemble`] and [`plan::plan`].
pub(super) fn keep_creases_together(
    plan: Plan,
    wanted: &Pieces,
    warnings: &mut Warnings,
) -> Result<Plan, ImportError> {
    let inner = inner_borders(&plan);
    if inner.is_empty() || !matches!(wanted, Pieces::Main | Pieces::Largest) {
        return Ok(plan);
    }
    let assembled = assemble(&plan, &mut Warnings::default())?;
    let pieces = PieceList::new(&plan, &assembled);
    let largest = pieces.largest();
    let creases = assembled.sheet.edges.iter().filter(|edge| edge.is_crease() && edge.is_hinge());
    let facet = |edge: &Edge| edge.faces[0].map(|face| assembled.sheet.face_facets[face as usize]);
    let of_piece = creases.map(|edge| facet(edge).map(|facet| pieces.of_facet[facet as usize]));
    let of_piece: Vec<Option<u32>> = of_piece.collect();
    let kept = of_piece.iter().filter(|piece| **piece == Some(largest)).count();
    if 2 * kept >= of_piece.len() {
        return Ok(plan);
    }
    let Plan { points, origins, mut lines, sources, mending, .. } = plan;
    for line in lines.iter_mut().filter(|line| inner.contains(&line.key())) {
        line.role = Role::Grid;
        warnings.add(WarningKind::InnerGrid, &sources[line.source as usize]);
    }
    let mut graph = Graph { points, origins, lines, mending, lost: 0 };
    graph.drop_grid(&sources, warnings);
    graph.join_straight(graph.mending.tolerance, &sources, warnings);
    plan::plan(graph, sources, warnings)
}

/// The ends of the border lines with facets on both sides.
fn inner_borders(plan: &Plan) -> BTreeSet<[u32; 2]> {
    let borders = plan.lines.iter().filter(|line| line.role == Role::Border);
    let borders: BTreeSet<[u32; 2]> = borders.map(Line::key).collect();
    let mut passed = BTreeSet::new();
    let mut inner = BTreeSet::new();
    for corners in plan.facets.iter().flatten() {
        let next = corners.iter().cycle().skip(1);
        for (&a, &b) in corners.iter().zip(next) {
            let key = [a.min(b), a.max(b)];
            if borders.contains(&key) && !passed.insert(key) {
                inner.insert(key);
            }
        }
    }
    inner
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

    /// The largest piece and those at least half as large.
    fn main(&self) -> BTreeSet<u32> {
        let largest = self.areas.iter().copied().fold(0.0, f64::max);
        let pieces = (0..).zip(&self.areas);
        pieces.filter(|(_, area)| **area >= MAIN * largest).map(|(piece, _)| piece).collect()
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
