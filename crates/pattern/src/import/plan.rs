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
#[derive(Debug, Clone)]
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
    /// Whether facets beside curved creases are cut along rulings.
    pub(super) has_rulings: bool,
    /// Whether the facets are the faces that the file lists, in its order.
    pub(super) are_listed: bool,
}

/// The sheet that a planar graph bounds: faces that an odd number of border lines parts from the plane around
/// everything. Lines at its edge become border; border lines inside it are cuts.
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
    let (has_rulings, are_listed) = (false, false);
    Ok(Plan { points, origins, lines: kept, facets, sources, mending, has_rulings, are_listed })
}

/// Which faces belong to the sheet: those inside the border lines; where these bound nothing, or not all around, those
/// that any line parts from the plane around everything.
pub(super) fn sheet_faces(graph: &Graph, faces: &Faces) -> Vec<bool> {
    let sides = |line: usize| [0, 1].map(|side| faces.face_of[2 * line + side]);
    let is_border = |line: usize| graph.lines[line].role == Role::Border;
    let by_border = Regions::new(graph, faces, is_border);
    let is_open = (0..graph.lines.len()).any(|line| {
        let [left, right] = sides(line);
        is_border(line) && left != right && [left, right].iter().all(|&f| by_border.is_outside(f))
    });
    let inside = by_border.inside();
    if !is_open && inside.contains(&true) {
        return inside;
    }
    let by_edge = Regions::new(graph, faces, |line| {
        let [left, right] = sides(line);
        is_border(line) || (left != right && (left == 0 || right == 0))
    });
    by_edge.inside()
}

/// Faces that no line that parts separates.
struct Regions {
    /// The region of each face.
    region: Vec<u32>,
    /// The least number of lines that part each region from face 0; `None` where none leads there.
    depth: Vec<Option<u32>>,
}

impl Regions {
    fn new(graph: &Graph, faces: &Faces, parts: impl Fn(usize) -> bool) -> Self {
        let count = faces.loops.len();
        let mut region: Vec<u32> = (0..count as u32).collect();
        let lines = 0..graph.lines.len();
        let sides = |line: usize| [0, 1].map(|side| faces.face_of[2 * line + side]);
        for line in lines.clone().filter(|&line| !parts(line)) {
            let [left, right] = sides(line);
            join(&mut region, left, right);
        }
        let region: Vec<u32> = (0..count as u32).map(|face| root(&mut region, face)).collect();
        let mut around = vec![Vec::new(); count];
        for line in lines {
            let [left, right] = sides(line).map(|face| region[face as usize]);
            if left != right {
                around[left as usize].push(right);
                around[right as usize].push(left);
            }
        }
        let mut depth = vec![None; count];
        depth[region[0] as usize] = Some(0);
        let mut reached = std::collections::VecDeque::from([(region[0], 0)]);
        while let Some((at, steps)) = reached.pop_front() {
            for &beyond in &around[at as usize] {
                if depth[beyond as usize].is_none() {
                    depth[beyond as usize] = Some(steps + 1);
                    reached.push_back((beyond, steps + 1));
                }
            }
        }
        Self { region, depth }
    }

    /// Whether a face and the plane around everything are one region.
    fn is_outside(&self, face: u32) -> bool {
        self.region[face as usize] == self.region[0]
    }

    /// Which faces an odd number of lines parts from face 0.
    fn inside(&self) -> Vec<bool> {
        let is_odd = |region: &u32| self.depth[*region as usize].is_some_and(|d| d % 2 == 1);
        self.region.iter().map(is_odd).collect()
    }
}
