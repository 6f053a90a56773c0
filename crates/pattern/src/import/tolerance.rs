//! The tolerance of merging, chosen from the drawing.

use glam::DVec2;

use super::drawing::{Drawing, Line};
use super::grid::Grid;
use super::predicate::from_segment;
use super::split::{Graph, planar_graph};
use super::warning::Warnings;
use super::{ImportError, MergeTolerance};

/// The tolerances that are tried, in parts of the diagonal; Origami Simulator's 3 units are 1/200 of one of 600. The
/// least ones come last: they are for a small sheet beside something far away.
const TRIED: [f64; 8] = [1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 1e-5, 1e-6];
/// A drawing that loses nothing, and whose vertices and lines keep this multiple of the tolerance apart, has no near
/// misses.
const CLEAR: f64 = 10.0;
/// The distance beyond which vertices and lines are apart, in parts of the diagonal.
const FARTHEST: f64 = 0.02;

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
    let Attempt { mut graph, warnings: found, .. } = best(drawing, merge, diagonal, scale)?;
    warnings.append(found);
    graph.drop_grid(&drawing.sources, warnings);
    graph.mending.chosen = matches!(merge, MergeTolerance::Chosen { .. });
    if !graph.lines.is_empty() {
        graph.mending.check(scale)?;
    }
    Ok(graph)
}

/// The tolerance with which [`mended`] merges a drawing.
///
/// # Errors
/// [`ImportError::Tolerance`], [`ImportError::TooMany`], [`ImportError::Tangled`].
pub(super) fn chosen(
    drawing: &Drawing,
    merge: MergeTolerance,
    diagonal: f64,
    scale: f64,
) -> Result<f64, ImportError> {
    Ok(best(drawing, merge, diagonal, scale)?.graph.mending.tolerance)
}

fn best(
    drawing: &Drawing,
    merge: MergeTolerance,
    diagonal: f64,
    scale: f64,
) -> Result<Attempt, ImportError> {
    let least = merge.length(diagonal, scale)?;
    let is_chosen = matches!(merge, MergeTolerance::Chosen { .. });
    let attempt = |tolerance: f64| Attempt::new(drawing, tolerance, FARTHEST * diagonal);
    let mut best = attempt(least);
    let others = TRIED.into_iter().map(|part| part * diagonal).filter(|&t| t != least);
    for tolerance in others.filter(|_| is_chosen) {
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
    best
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
