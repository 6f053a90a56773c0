//! The facets of a pattern, before they are cut into triangles.

use glam::DVec2;

use super::drawing::{Line, Role};
use super::loops::{Faces, faces};
use super::mending::Mending;
use super::open_cuts::{join, root};
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
    /// What was done about lines that nearly meet.
    pub(super) mending: Mending,
}

/// The sheet that a planar graph bounds: faces that an odd number of border lines parts from the plane around
/// everything. Lines at its edge become border, border lines inside it cuts.
///
/// # Errors
/// [`ImportError::NoFaces`].
pub(super) fn plan(
    graph: Graph,
    sources: Vec<Source>,
    warnings: &mut Warnings,
) -> Result<Plan, ImportError> {
    let faces = faces(&graph);
    let is_sheet = sheet_faces(&graph, &faces);
    let Graph { points, origins, lines, mut mending, .. } = graph;
    let mut kept = Vec::with_capacity(lines.len());
    for (index, mut line) in lines.into_iter().enumerate() {
        let sides = [0, 1].map(|side| is_sheet[faces.face_of[2 * index + side] as usize]);
        let source = &sources[line.source as usize];
        if sides == [false, false] {
            warnings.add(WarningKind::Outside, source);
            mending.drop(&line, &points, &sources);
            continue;
        }
        if sides == [true, true] && line.role == Role::Border {
            warnings.add(WarningKind::BorderInside, source);
            line.role = Role::Cut;
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
    Ok(Plan { points, origins, lines: kept, facets, sources, mending })
}

/// Which faces belong to the sheet: those inside the border lines; where these bound nothing, or not all around, those
/// that any line parts from the plane around everything.
fn sheet_faces(graph: &Graph, faces: &Faces) -> Vec<bool> {
    let sides = |line: usize| [0, 1].map(|side| faces.face_of[2 * line + side]);
    let is_border = |line: usize| graph.lines[line].role == Role::Border;
    let by_border = Regions::new(graph, faces, is_border);
    if by_border.bounds_all && by_border.is_inside.contains(&true) {
        return by_border.is_inside;
    }
    let by_edge = Regions::new(graph, faces, |line| {
        let [left, right] = sides(line);
        is_border(line) || (left != right && (left == 0 || right == 0))
    });
    by_edge.is_inside
}

/// Faces that lines part into regions.
struct Regions {
    /// Whether an odd number of the lines that part lies between a face and face 0, on the shortest way.
    is_inside: Vec<bool>,
    /// Whether no such line has the region of face 0 on both sides.
    bounds_all: bool,
}

impl Regions {
    fn new(graph: &Graph, faces: &Faces, parts: impl Fn(usize) -> bool) -> Self {
        let lines = 0..graph.lines.len();
        let sides = |line: usize| [0, 1].map(|side| faces.face_of[2 * line + side]);
        let mut joined: Vec<u32> = (0..faces.loops.len() as u32).collect();
        for [left, right] in lines.clone().filter(|&line| !parts(line)).map(sides) {
            join(&mut joined, left, right);
        }
        let region_of: Vec<u32> =
            (0..faces.loops.len() as u32).map(|face| root(&mut joined, face)).collect();
        let mut beside = vec![Vec::new(); faces.loops.len()];
        let mut bounds_all = true;
        for line in lines.filter(|&line| parts(line)) {
            let faces = sides(line);
            let [left, right] = faces.map(|face| region_of[face as usize]);
            bounds_all &= left != right || left != 0 || faces[0] == faces[1];
            beside[left as usize].push(right);
            beside[right as usize].push(left);
        }
        let mut is_region_inside = vec![None; faces.loops.len()];
        is_region_inside[0] = Some(false);
        let mut reached = std::collections::VecDeque::from([0]);
        while let Some(region) = reached.pop_front() {
            let beyond = is_region_inside[region as usize].map(|is_inside: bool| !is_inside);
            for &next in &beside[region as usize] {
                if is_region_inside[next as usize].is_none() {
                    is_region_inside[next as usize] = beyond;
                    reached.push_back(next);
                }
            }
        }
        let is_inside = |region: &u32| is_region_inside[*region as usize] == Some(true);
        Self { is_inside: region_of.iter().map(is_inside).collect(), bounds_all }
    }
}
