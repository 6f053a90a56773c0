//! Lines split where they cross and touch: from a drawing to a planar graph.

use glam::DVec2;

use super::drawing::{Drawing, Line, Role};
use super::grid::Grid;
use super::mending::Mending;
use super::options::MOST_PIECES;
use super::predicate::{cross, from_segment};
use super::vertices::Vertices;
use super::warning::{WarningKind, Warnings};
use super::{ImportError, Source};

/// The most times everything is split again: a vertex made for a crossing moves the lines through it by up to the
/// tolerance, which can make them meet others.
const MOST_PASSES: usize = 16;
/// How near a line a vertex lies on it in later passes, in parts of the tolerance: no more than half, so that the
/// pieces of a line split at a vertex beside it are shorter than the line, and splitting ends.
const ON_LINE: f64 = 0.5;
/// How far a point is moved without being said to be, in parts of the tolerance.
const EXACT: f64 = 1e-3;
/// The most pairs of lines held against each other.
const MOST_PAIRS: u64 = 1_000_000_000;

/// Lines that meet at their ends only, no two with the same ends.
#[derive(Debug, Clone)]
pub(super) struct Graph {
    pub(super) points: Vec<DVec2>,
    /// The point of the drawing each point comes from; `None` for crossings.
    pub(super) origins: Vec<Option<u32>>,
    pub(super) lines: Vec<Line>,
    /// What was done about lines that nearly meet.
    pub(super) mending: Mending,
    /// Lines that vanished or lie on others, and four times the ends that meet nothing.
    pub(super) lost: usize,
}

/// The lines being split, and the warnings about them.
struct Splitting<'a> {
    vertices: Vertices,
    /// The point of the drawing each vertex comes from.
    origins: Vec<u32>,
    tolerance: f64,
    sources: &'a [Source],
    warnings: &'a mut Warnings,
    pairs: u64,
    mending: Mending,
    lost: usize,
}

/// The planar graph of a drawing: ends within `tolerance` of each other are one vertex, ends within it of a line lie on
/// the line, and lines are split where they cross.
///
/// Guarantee: no two lines of the graph cross (exactly), no vertex lies within half of `tolerance` of a line it does
/// not end, no two lines have the same ends. Of lines on each other the one whose role comes first counts, then the
/// first.
///
/// # Errors
/// [`ImportError::TooMany`], [`ImportError::Tangled`].
pub(super) fn planar_graph(
    drawing: &Drawing,
    tolerance: f64,
    warnings: &mut Warnings,
) -> Result<Graph, ImportError> {
    let mut splitting = Splitting {
        vertices: Vertices::new(tolerance),
        origins: Vec::new(),
        tolerance,
        sources: &drawing.sources,
        warnings,
        pairs: 0,
        mending: Mending { tolerance, ..Mending::default() },
        lost: 0,
    };
    let mut lines = splitting.merged(drawing);
    for pass in 0..MOST_PASSES {
        let on_line = if pass == 0 { 1.0 } else { ON_LINE };
        let pieces = splitting.pieces(&lines, on_line * tolerance)?;
        let is_split = pieces.len() > lines.len();
        lines = splitting.unique(pieces);
        if !is_split {
            let points = splitting.vertices.points;
            let drawn = splitting.origins.into_iter().map(Some);
            let mut origins: Vec<_> = drawn.collect();
            origins.resize(points.len(), None);
            let Splitting { mut mending, lost, .. } = splitting;
            for line in &lines {
                mending.draw(line, &points);
            }
            return Ok(Graph { points, origins, lines, mending, lost });
        }
    }
    Err(ImportError::Tangled { passes: MOST_PASSES, tolerance })
}

impl Splitting<'_> {
    fn warn(&mut self, kind: WarningKind, line: &Line) {
        self.warnings.add(kind, &self.sources[line.source as usize]);
    }

    /// The lines between vertices; those of a drawing with near ends made one.
    fn merged(&mut self, drawing: &Drawing) -> Vec<Line> {
        let mut lines = Vec::with_capacity(drawing.lines.len());
        let mut is_moved = vec![false; drawing.points.len()];
        for line in &drawing.lines {
            let points = line.ends.map(|v| drawing.points[v as usize]);
            let mut ends = [0; 2];
            for (end, point) in ends.iter_mut().zip(line.ends) {
                *end = self.vertices.add(drawing.points[point as usize]);
                if *end as usize == self.origins.len() {
                    self.origins.push(point);
                }
            }
            for ((point, drawn), vertex) in points.iter().zip(line.ends).zip(ends) {
                let moved = self.vertices.points[vertex as usize].distance(*point);
                is_moved[drawn as usize] |= moved > EXACT * self.tolerance;
            }
            if ends[0] == ends[1] {
                self.warn(WarningKind::TooShort, line);
                self.lost += 1;
                continue;
            }
            if line.ends.iter().any(|&drawn| is_moved[drawn as usize]) {
                self.warn(WarningKind::Merged, line);
            }
            lines.push(Line { ends, ..*line });
        }
        self.mending.merged = is_moved.iter().filter(|moved| **moved).count();
        self.unique(lines)
    }

    /// Each line cut at the vertices on it and at its crossings with others.
    fn pieces(&mut self, lines: &[Line], on_line: f64) -> Result<Vec<Line>, ImportError> {
        let segments: Vec<[DVec2; 2]> = lines.iter().map(|line| self.segment(line)).collect();
        let grid = Grid::new(&segments, self.tolerance);
        let mut on = vec![Vec::new(); lines.len()];
        self.vertices_on(lines, &segments, &grid, on_line, &mut on);
        self.crossings(lines, &segments, &grid, &mut on)?;
        let total = lines.len() + on.iter().map(Vec::len).sum::<usize>();
        check_pieces(total)?;
        let mut pieces = Vec::with_capacity(total);
        for ((line, segment), on) in lines.iter().zip(&segments).zip(on) {
            let [from, to] = line.ends;
            let points = &self.vertices.points;
            let along = |v: u32| from_segment(*segment, points[v as usize]).1;
            let mut stops: Vec<(f64, u32)> = on.into_iter().map(|v| (along(v), v)).collect();
            stops.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let mut stops: Vec<u32> = stops.into_iter().map(|(_, v)| v).collect();
            stops.insert(0, from);
            stops.push(to);
            stops.dedup();
            if stops.len() > 2 {
                self.warn(WarningKind::Split, line);
            }
            pieces.extend(stops.windows(2).map(|ends| Line { ends: [ends[0], ends[1]], ..*line }));
        }
        Ok(pieces)
    }

    fn segment(&self, line: &Line) -> [DVec2; 2] {
        line.ends.map(|v| self.vertices.points[v as usize])
    }

    /// Finds the vertices within `on_line` of each line.
    fn vertices_on(
        &mut self,
        lines: &[Line],
        segments: &[[DVec2; 2]],
        grid: &Grid,
        on_line: f64,
        on: &mut [Vec<u32>],
    ) {
        let mut is_end = vec![false; self.vertices.points.len()];
        for &v in lines.iter().flat_map(|line| &line.ends) {
            is_end[v as usize] = true;
        }
        let ends = self.vertices.points.iter().enumerate();
        let mut snapped = 0;
        for (vertex, &point) in ends.filter(|(v, _)| is_end[*v]) {
            for &line in grid.lines(grid.square(point)) {
                let is_own = lines[line as usize].ends.contains(&(vertex as u32));
                let segment = segments[line as usize];
                if is_own {
                    continue;
                }
                let (off, _) = from_segment(segment, point);
                if off <= on_line {
                    on[line as usize].push(vertex as u32);
                    snapped += usize::from(off > EXACT * self.tolerance);
                }
            }
        }
        self.mending.snapped += snapped;
    }

    /// Makes a vertex of each crossing.
    fn crossings(
        &mut self,
        lines: &[Line],
        segments: &[[DVec2; 2]],
        grid: &Grid,
        on: &mut [Vec<u32>],
    ) -> Result<(), ImportError> {
        let mut found = 0;
        for square in 0..grid.squares() {
            let through = grid.lines(square);
            self.pairs += (through.len() as u64).pow(2) / 2;
            if self.pairs > MOST_PAIRS {
                return Err(ImportError::TooMany {
                    what: "pairs of lines near each other",
                    found: self.pairs as usize,
                    limit: MOST_PAIRS as usize,
                });
            }
            for (index, &s) in through.iter().enumerate() {
                for &t in &through[index + 1..] {
                    let [s, t] = [s as usize, t as usize];
                    let share_end = lines[s].ends.iter().any(|v| lines[t].ends.contains(v));
                    if share_end || !cross(segments[s], segments[t]) {
                        continue;
                    }
                    let vertex = self.vertices.add(crossing(segments[s], segments[t]));
                    for line in [s, t] {
                        // Pairs that share several squares are found in each.
                        if !lines[line].ends.contains(&vertex) && !on[line].contains(&vertex) {
                            on[line].push(vertex);
                            found += 1;
                        }
                    }
                    check_pieces(lines.len() + found)?;
                }
            }
        }
        Ok(())
    }

    /// The lines with one for each pair of ends.
    fn unique(&mut self, mut lines: Vec<Line>) -> Vec<Line> {
        // Stable: those that come first count first.
        lines.sort_by_key(|line| (line.key(), line.role));
        let mut kept: Vec<Line> = Vec::with_capacity(lines.len());
        for line in lines {
            match kept.last() {
                Some(last) if last.key() == line.key() && line.role == Role::Grid => {}
                Some(last) if last.key() == line.key() => {
                    self.lost += 1;
                    let is_same = last.role == line.role && last.target == line.target;
                    if last.source != line.source {
                        self.warn(
                            if is_same { WarningKind::Duplicate } else { WarningKind::Conflict },
                            &line,
                        );
                    }
                }
                _ => kept.push(line),
            }
        }
        kept.sort_by_key(|line| (line.source, line.key()));
        kept
    }
}

fn check_pieces(found: usize) -> Result<(), ImportError> {
    if found <= MOST_PIECES {
        return Ok(());
    }
    Err(ImportError::TooMany {
        what: "lines after splitting at their crossings",
        found,
        limit: MOST_PIECES,
    })
}

/// The point in which two segments that cross do so.
fn crossing([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> DVec2 {
    let (u, v) = (b - a, d - c);
    let share = (c - a).perp_dot(v) / u.perp_dot(v);
    // Nearly parallel lines may put it anywhere on them.
    if share.is_finite() { a + u * share.clamp(0.0, 1.0) } else { a.midpoint(b) }
}
