//! The tolerance of merging, chosen from the drawing, and what it changed.

use glam::DVec2;

use super::drawing::{Drawing, Line, Role};
use super::grid::Grid;
use super::predicate::from_segment;
use super::split::{Graph, planar_graph};
use super::warning::Warnings;
use super::{ImportError, MergeTolerance, Source};

/// The tolerances that are tried, in parts of the diagonal; Origami Simulator's 3 units are 1/200 of one of 600. The
/// least ones come last: they are for a small sheet beside something far away.
const TRIED: [f64; 8] = [1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 1e-5, 1e-6];
/// A drawing that loses nothing, and whose vertices and lines keep this multiple of the tolerance apart, has no near
/// misses.
const CLEAR: f64 = 10.0;
/// The distance beyond which vertices and lines are apart, in parts of the diagonal.
const FARTHEST: f64 = 0.02;
/// The most creases left out that are named.
const MOST_NAMED: usize = 100;
/// The part of the length of the creases beyond which a pattern that loses it is refused.
const MOST_DROPPED: f64 = 0.5;

/// What was done about lines that nearly meet, and which creases were left out.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mending {
    /// How far apart two points may lie to be one vertex, in units of the file; 0 where the file lists facets that are
    /// kept as they are.
    pub tolerance: f64,
    /// Whether the tolerance was chosen from the drawing.
    pub chosen: bool,
    /// Ends of lines that became a vertex near them.
    pub merged: usize,
    /// Vertices beside a line that it now passes through.
    pub snapped: usize,
    /// The number of creases, or parts of creases, left out because they end nowhere or lie beside the sheet.
    pub dropped: usize,
    /// Their length in all, in units of the file.
    pub dropped_length: f64,
    /// Which: the first hundred.
    pub dropped_creases: Vec<DroppedCrease>,
    /// The length of all creases drawn, in units of the file.
    pub crease_length: f64,
}

/// A crease, or a part of one, that was left out.
#[derive(Debug, Clone, PartialEq)]
pub struct DroppedCrease {
    /// The element of the file.
    pub source: Source,
    /// The point half-way, in the coordinates of the sheet.
    pub middle: DVec2,
    /// Its length, in units of the file.
    pub length: f64,
}

impl Mending {
    /// Notes the length of a drawn line.
    pub(super) fn draw(&mut self, line: &Line, points: &[DVec2]) {
        if is_crease(line.role) {
            self.crease_length += length(line, points);
        }
    }

    /// Notes a line that is left out.
    pub(super) fn drop(&mut self, line: &Line, points: &[DVec2], sources: &[Source]) {
        if !is_crease(line.role) {
            return;
        }
        let length = length(line, points);
        self.dropped += 1;
        self.dropped_length += length;
        if self.dropped_creases.len() < MOST_NAMED {
            let [a, b] = line.ends.map(|v| points[v as usize]);
            let source = sources[line.source as usize].clone();
            self.dropped_creases.push(DroppedCrease { source, middle: a.midpoint(b), length });
        }
    }

    /// In units of the file, which are `scale` long.
    pub(super) fn in_units_of_file(&mut self, scale: f64) {
        let lengths = [&mut self.tolerance, &mut self.dropped_length, &mut self.crease_length];
        let named = self.dropped_creases.iter_mut().map(|crease| &mut crease.length);
        for length in lengths.into_iter().chain(named) {
            *length /= scale;
        }
    }

    /// Refuses a pattern that would lose most of its creases; `scale`: how long the unit of the file is.
    fn check(&self, scale: f64) -> Result<(), ImportError> {
        if self.dropped_length <= MOST_DROPPED * self.crease_length {
            return Ok(());
        }
        let sources = self.dropped_creases.iter().map(|crease| crease.source.clone());
        Err(ImportError::MostDropped {
            dropped: self.dropped_length / scale,
            length: self.crease_length / scale,
            tolerance: self.tolerance / scale,
            sources: sources.collect(),
        })
    }
}

fn is_crease(role: Role) -> bool {
    matches!(role, Role::Mountain | Role::Valley | Role::Free)
}

fn length(line: &Line, points: &[DVec2]) -> f64 {
    let [a, b] = line.ends.map(|v| points[v as usize]);
    a.distance(b)
}

/// The planar graph of a drawing without lines that end nowhere; `scale`: how long its own unit is in those of its points.
///
/// A tolerance that is to be chosen is the one at which the fewest lines end nowhere, vanish or fall on each other; of
/// several the one that vertices and lines keep apart by the largest multiple of, so that near misses lie below it
/// and features above. One below the least is taken only where that loses lines.
///
/// # Errors
/// [`ImportError::Tolerance`], [`ImportError::TooMany`], [`ImportError::Tangled`], [`ImportError::MostDropped`].
pub(super) fn mended(
    drawing: &Drawing,
    merge: MergeTolerance,
    diagonal: f64,
    scale: f64,
    warnings: &mut Warnings,
) -> Result<Graph, ImportError> {
    let least = merge.length(diagonal, scale)?;
    let chosen = matches!(merge, MergeTolerance::Chosen { .. });
    let attempt = |tolerance: f64| Attempt::new(drawing, tolerance, FARTHEST * diagonal);
    let mut best = attempt(least);
    let others = TRIED.into_iter().map(|part| part * diagonal).filter(|&t| t != least);
    for tolerance in others.filter(|_| chosen) {
        if best.as_ref().map_or_else(|error| !error.is_tangle(), Attempt::is_clear) {
            break;
        }
        let other = attempt(tolerance);
        let is_better = match (&other, &best) {
            (Ok(other), Ok(best)) if tolerance < least => other.graph.lost < best.graph.lost,
            (Ok(other), Ok(best)) => other.is_better(best),
            (Ok(_), Err(_)) => true,
            (Err(_), _) => false,
        };
        if is_better {
            best = other;
        }
    }
    let Attempt { mut graph, warnings: found, .. } = best?;
    warnings.append(found);
    graph.mending.chosen = chosen;
    if !graph.lines.is_empty() {
        graph.mending.check(scale)?;
    }
    Ok(graph)
}

/// The least distance of a vertex from a line it does not end, and of the ends of a line from each other; at most `reach`.
fn separation(graph: &Graph, reach: f64) -> f64 {
    let ends = |line: &Line| line.ends.map(|v| graph.points[v as usize]);
    let segments: Vec<[DVec2; 2]> = graph.lines.iter().map(ends).collect();
    let grid = Grid::new(&segments, reach);
    let mut least = reach;
    for (line, segment) in graph.lines.iter().zip(&segments) {
        least = least.min(segment[0].distance(segment[1]));
        for (vertex, point) in line.ends.iter().zip(segment) {
            for &other in grid.lines(grid.square(*point)) {
                if !graph.lines[other as usize].ends.contains(vertex) {
                    least = least.min(from_segment(segments[other as usize], *point).0);
                }
            }
        }
    }
    least
}

/// A drawing merged with one tolerance.
struct Attempt {
    graph: Graph,
    warnings: Warnings,
    /// How near a vertex lies to a line it does not end, or to the other end of its own, over the tolerance.
    clearance: f64,
}

impl Attempt {
    /// `farthest`: the distance beyond which it does not matter how far apart vertices and lines are.
    fn new(drawing: &Drawing, tolerance: f64, farthest: f64) -> Result<Self, ImportError> {
        let mut warnings = Warnings::default();
        let mut graph = planar_graph(drawing, tolerance, &mut warnings)?;
        graph.drop_strays(&drawing.sources, &mut warnings);
        let reach = farthest.min(CLEAR * tolerance).max(tolerance);
        let clearance = separation(&graph, reach) / tolerance;
        Ok(Self { graph, warnings, clearance })
    }

    fn is_clear(&self) -> bool {
        self.graph.lost == 0 && self.clearance >= CLEAR
    }

    fn is_better(&self, other: &Self) -> bool {
        let [lost, of_other] = [self.graph.lost, other.graph.lost];
        lost < of_other || (lost == of_other && self.clearance > other.clearance)
    }
}
