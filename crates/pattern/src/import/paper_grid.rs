//! A grid on which a pattern was drawn, in the colour of the border.

use std::collections::BTreeSet;

use super::drawing::{Drawing, Line, Role, bounds};
use super::loops::faces;
use super::plan::sheet_faces;
use super::split::{Graph, planar_graph};
use super::vertices::Vertices;
use super::warning::{WarningKind, Warnings};
use super::{ImportError, Source};

/// The fewest border lines that can be a grid.
const LEAST_GRID: usize = 6;

/// Finds border lines that cross each other more often than there are such lines: they are a grid on which the pattern
/// was drawn.
///
/// If the other border lines close around the creases and no crease ends on the grid, it is left out: all lines that
/// cross others or, if these close nothing without them, those of them that end at no corner, for the sides of the sheet
/// cross a grid that goes on beyond it. Otherwise the grid may draw the edge of the sheet, and [`Graph::drop_grid`] leaves
/// out what is not edge.
pub(super) fn find(
    drawing: &mut Drawing,
    tolerance: f64,
    warnings: &mut Warnings,
) -> Result<(), ImportError> {
    let borders = part(drawing, |line| line.role == Role::Border);
    let of_border: BTreeSet<u32> = borders.lines.iter().map(|line| line.source).collect();
    if of_border.len() < LEAST_GRID {
        return Ok(());
    }
    let (crossings, crossing) = crossing_sources(&borders, tolerance)?;
    if crossings <= of_border.len() {
        return Ok(());
    }
    let cornered = cornered_sources(&borders, tolerance);
    let no_sides = crossing.difference(&cornered).copied().collect();
    let mut grid = crossing;
    let mut is_apart = closes_without(drawing, &grid, tolerance)?;
    if !is_apart && closes_without(drawing, &no_sides, tolerance)? {
        (grid, is_apart) = (no_sides, true);
    }
    for line in &mut drawing.lines {
        if line.role == Role::Border && grid.contains(&line.source) {
            line.role = Role::Grid;
            warnings.add(WarningKind::InnerGrid, &drawing.sources[line.source as usize]);
        }
    }
    if is_apart {
        let clean = part(drawing, |line| line.role != Role::Grid);
        if dropped_length(&clean, tolerance)? <= dropped_length(drawing, tolerance)? {
            drawing.lines = clean.lines;
        }
    }
    Ok(())
}

/// The length of the creases that end nowhere.
fn dropped_length(drawing: &Drawing, tolerance: f64) -> Result<f64, ImportError> {
    let mut graph = planar_graph(drawing, tolerance, &mut Warnings::default())?;
    graph.drop_strays(&drawing.sources, &mut Warnings::default());
    Ok(graph.mending.dropped_length)
}

fn part(drawing: &Drawing, is_kept: impl Fn(&Line) -> bool) -> Drawing {
    Drawing {
        points: drawing.points.clone(),
        lines: drawing.lines.iter().copied().filter(is_kept).collect(),
        sources: drawing.sources.clone(),
    }
}

/// The number of points where lines of several sources go through, and these sources.
fn crossing_sources(
    borders: &Drawing,
    tolerance: f64,
) -> Result<(usize, BTreeSet<u32>), ImportError> {
    let graph = planar_graph(borders, tolerance, &mut Warnings::default())?;
    let mut crossing: BTreeSet<u32> = BTreeSet::new();
    let mut crossings = 0;
    for lines in graph.lines_at() {
        let mut sources: Vec<u32> =
            lines.iter().map(|line| graph.lines[*line as usize].source).collect();
        sources.sort_unstable();
        // Lines that go on beyond the point.
        let through = sources.chunk_by(|a, b| a == b).filter(|lines| lines.len() == 2);
        let through: Vec<u32> = through.map(|lines| lines[0]).collect();
        if through.len() > 1 {
            crossings += 1;
            crossing.extend(through);
        }
    }
    Ok((crossings, crossing))
}

/// The sources of lines that end where a line of another source does.
fn cornered_sources(borders: &Drawing, tolerance: f64) -> BTreeSet<u32> {
    let mut vertices = Vertices::new(tolerance);
    let mut ending: Vec<BTreeSet<u32>> = Vec::new();
    for line in &borders.lines {
        for end in line.ends {
            let vertex = vertices.add(borders.points[end as usize]) as usize;
            ending.resize(vertices.points.len(), BTreeSet::new());
            ending[vertex].insert(line.source);
        }
    }
    ending.into_iter().filter(|sources| sources.len() > 1).flatten().collect()
}

/// Whether the border lines without some of them close around most creases.
fn closes_without(
    drawing: &Drawing,
    grid: &BTreeSet<u32>,
    tolerance: f64,
) -> Result<bool, ImportError> {
    let rest = part(drawing, |l| l.role == Role::Border && !grid.contains(&l.source));
    let graph = planar_graph(&rest, tolerance, &mut Warnings::default())?;
    let faces = faces(&graph);
    let closed = faces.loops.iter().skip(1).flatten().flatten();
    let closed: Vec<_> = closed.map(|&v| graph.points[v as usize]).collect();
    let Some([low, high]) = bounds(&closed) else { return Ok(false) };
    let is_crease =
        |line: &&Line| matches!(line.role, Role::Mountain | Role::Valley | Role::Free | Role::Cut);
    let middle = |line: &Line| {
        let [a, b] = line.ends.map(|v| drawing.points[v as usize]);
        a.midpoint(b)
    };
    let creases: Vec<_> = drawing.lines.iter().filter(is_crease).map(middle).collect();
    let inside = creases.iter().filter(|p| p.cmpge(low).all() && p.cmple(high).all());
    Ok(2 * inside.count() > creases.len())
}

impl Graph {
    /// Leaves out lines of a grid that are no edge of the sheet; the others become border. If creases would end nowhere
    /// without them, they stay as facet lines.
    pub(super) fn drop_grid(&mut self, sources: &[Source], warnings: &mut Warnings) {
        if self.lines.iter().all(|line| line.role != Role::Grid) {
            return;
        }
        let faces = faces(self);
        let is_sheet = sheet_faces(self, &faces);
        for (index, line) in self.lines.iter_mut().enumerate() {
            let sides = [0, 1].map(|side| is_sheet[faces.face_of[2 * index + side] as usize]);
            if line.role == Role::Grid && sides[0] != sides[1] {
                line.role = Role::Border;
            }
        }
        let mut clean = self.clone();
        let mut found = Warnings::default();
        clean.lines.retain(|line| line.role != Role::Grid);
        clean.drop_strays(sources, &mut found);
        if clean.mending.dropped == self.mending.dropped {
            warnings.append(found);
            *self = clean;
        } else {
            for line in self.lines.iter_mut().filter(|line| line.role == Role::Grid) {
                line.role = Role::Facet;
            }
        }
    }
}
