//! The facets of a pattern, before they are cut into triangles.

use glam::DVec2;

use super::drawing::{Line, Role};
use super::loops::{Faces, faces};
use super::split::Graph;
use super::warning::{WarningKind, Warnings};
use super::{ImportError, Source};

/// Facets that cover a sheet in the plane.
#[derive(Debug)]
pub(super) struct Plan {
    pub(super) points: Vec<DVec2>,
    /// The vertex of the file each point is; `None` for crossings.
    pub(super) origins: Vec<Option<u32>>,
    /// Each pair of ends once.
    pub(super) lines: Vec<Line>,
    /// For each facet its loops of vertices, the facet on their left: the outer border first, then those around what
    /// lies inside; a vertex may be passed more than once.
    pub(super) facets: Vec<Vec<Vec<u32>>>,
    pub(super) sources: Vec<Source>,
}

/// The sheet that a planar graph bounds: faces that an odd number of border lines parts from the plane around
/// everything. Lines at its edge become border.
///
/// # Errors
/// [`ImportError::NoFaces`], [`ImportError::BorderInside`].
pub(super) fn plan(
    graph: Graph,
    sources: Vec<Source>,
    warnings: &mut Warnings,
) -> Result<Plan, ImportError> {
    let faces = faces(&graph);
    let is_sheet = sheet_faces(&graph, &faces, &sources)?;
    let Graph { points, origins, lines } = graph;
    let mut kept = Vec::with_capacity(lines.len());
    for (index, mut line) in lines.into_iter().enumerate() {
        let sides = [0, 1].map(|side| is_sheet[faces.face_of[2 * index + side] as usize]);
        let source = &sources[line.source as usize];
        if sides == [false, false] {
            warnings.add(WarningKind::Outside, source);
            continue;
        }
        if sides.contains(&false) && line.role != Role::Border {
            warnings.add(WarningKind::MadeBorder, source);
            (line.role, line.target) = (Role::Border, 0.0);
        }
        kept.push(line);
    }
    let loops = faces.loops.into_iter().zip(is_sheet);
    let facets: Vec<_> = loops.filter(|(_, is)| *is).map(|(l, _)| l).collect();
    if facets.is_empty() {
        return Err(ImportError::NoFaces);
    }
    Ok(Plan { points, origins, lines: kept, facets, sources })
}

/// Which faces belong to the sheet: those inside the border lines; where these bound nothing, or not all around, those
/// that any line parts from the plane around everything.
fn sheet_faces(graph: &Graph, faces: &Faces, sources: &[Source]) -> Result<Vec<bool>, ImportError> {
    let sides = |line: usize| [0, 1].map(|side| faces.face_of[2 * line + side]);
    let is_border = |line: usize| graph.lines[line].role == Role::Border;
    let by_border = colour(graph, faces, is_border);
    if let Ok(is_sheet) = &by_border
        && is_sheet.contains(&true)
    {
        return Ok(is_sheet.clone());
    }
    let by_edge = colour(graph, faces, |line| {
        let [left, right] = sides(line);
        is_border(line) || (left != right && (left == 0 || right == 0))
    });
    let wrong = match (by_edge, by_border) {
        (Ok(is_sheet), _) => return Ok(is_sheet),
        (Err(line), Ok(_)) | (Err(_), Err(line)) => line,
    };
    Err(ImportError::BorderInside { element: sources[graph.lines[wrong].source as usize].clone() })
}

/// Which faces an odd number of lines that part parts from face 0; otherwise the first line that contradicts the
/// others.
fn colour(graph: &Graph, faces: &Faces, parts: impl Fn(usize) -> bool) -> Result<Vec<bool>, usize> {
    let lines = 0..graph.lines.len();
    let sides = |line: usize| [0, 1].map(|side| faces.face_of[2 * line + side] as usize);
    let mut around = vec![Vec::new(); faces.loops.len()];
    for line in lines.clone() {
        let [left, right] = sides(line);
        around[left].push((right, parts(line)));
        around[right].push((left, parts(line)));
    }
    let mut is_inside = vec![None; faces.loops.len()];
    is_inside[0] = Some(false);
    let mut reached = std::collections::VecDeque::from([0]);
    while let Some(face) = reached.pop_front() {
        for &(beyond, parts) in &around[face] {
            if is_inside[beyond].is_none() {
                is_inside[beyond] = is_inside[face].map(|is| is != parts);
                reached.push_back(beyond);
            }
        }
    }
    let is_inside: Vec<bool> = is_inside.into_iter().map(|is| is == Some(true)).collect();
    let contradicts = |line: &usize| {
        let [left, right] = sides(*line);
        if left == right {
            // A border beside the sheet bounds nothing and does no harm.
            return parts(*line) && is_inside[left];
        }
        parts(*line) != (is_inside[left] != is_inside[right])
    };
    match lines.clone().find(contradicts) {
        Some(line) => Err(line),
        None => Ok(is_inside),
    }
}
