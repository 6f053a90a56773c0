//! The flat state: where each triangle comes to lie when the sheet is reflected at every crease.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

use super::LayerError;
use super::placed::{Misfit, Placed, is_folded};
use crate::vertex_check::LARGEST_MISFIT;
use crate::{Assignment, Edge, Frame, Sheet};

/// Targets may differ from 0° and ±180° by this much, radians.
const FLAT_ANGLE: f64 = 1e-6;
/// Overlaps narrower than this, in mean edges, are none, and lines nearer than this are one.
const LEAST_WIDTH: f64 = 1e-5;
/// The same in multiples of the misfit.
const MISFITS: f64 = 4.0;

/// A pattern folded flat: positions in the plane, without an order of layers.
#[derive(Debug, Clone, PartialEq)]
pub struct FlatState {
    /// The sheet. Assignments are those of the flat state: V and M where the target is 180° and −180°, U where a free
    /// hinge is folded to either side, F where nothing is folded.
    pub sheet: Sheet,
    /// The position of every vertex in the plane. The largest facet of each piece of the sheet stays in place, its front up;
    /// a piece that would come to lie on another is moved beside it.
    pub positions: Vec<DVec2>,
    /// Whether the front of each triangle faces down.
    pub is_turned: Vec<bool>,
    /// The largest distance between positions to which neighbouring facets bring a common vertex, a length. Positions
    /// are their means.
    pub misfit: f64,
    /// Overlaps narrower than this are none, and lines nearer than this are one: a length.
    pub width: f64,
}

impl FlatState {
    /// Folds a sheet flat.
    ///
    /// `targets`: the fold angle of every edge, radians. Free hinges are folded, to a side that is left open; where the
    /// sheet does not fold flat then, they are not folded.
    ///
    /// # Errors
    /// [`LayerError`] with the edge or vertex that does not fold flat.
    pub fn new(sheet: &Sheet, targets: &[f64]) -> Result<Self, LayerError> {
        let with_free = |free| assigned(sheet, targets, free).and_then(Self::folded);
        let first = with_free(Assignment::Free);
        let has_free = sheet.edges.iter().any(|edge| edge.assignment == Assignment::Free);
        match first {
            Err(error) if has_free => with_free(Assignment::Facet).map_err(|_| error),
            first => first,
        }
    }

    /// The state as the frame of a motion, in the plane z = 0.
    pub fn frame(&self) -> Frame {
        Frame { time: 2.0, positions: self.positions.iter().map(|p| p.extend(0.0)).collect() }
    }

    /// The corners of a triangle in the flat state, counter-clockwise seen from above.
    pub(super) fn triangle(&self, face: u32) -> [DVec2; 3] {
        let [p, q, r] = self.sheet.faces[face as usize].map(|v| self.positions[v as usize]);
        if self.is_turned[face as usize] { [p, r, q] } else { [p, q, r] }
    }

    fn folded(sheet: Sheet) -> Result<Self, LayerError> {
        let vertices = inner_vertices(&sheet);
        for vertex in &vertices {
            vertex.check_creases(&sheet)?;
        }
        let placed = Placed::new(&sheet)?;
        let limit = LARGEST_MISFIT * sheet.unit_length;
        let (positions, misfit) = placed.positions(&sheet);
        if misfit.distance > limit {
            let culprit =
                vertices.iter().map(|v| (v, v.misfit())).max_by(|a, b| a.1.total_cmp(&b.1));
            if let Some((vertex, _)) = culprit.filter(|(_, misfit)| *misfit > limit) {
                return Err(vertex.angle_error(&sheet));
            }
            let Misfit { vertex, facets, distance } = misfit;
            return Err(LayerError::NotClosed { vertex, facets, misfit: distance, limit });
        }
        let width = (LEAST_WIDTH * sheet.unit_length).max(MISFITS * misfit.distance);
        let is_turned = placed.is_turned();
        Ok(Self { sheet, positions, is_turned, misfit: misfit.distance, width })
    }
}

/// The sheet with the assignments of its flat state. `free`: what a free hinge becomes.
fn assigned(sheet: &Sheet, targets: &[f64], free: Assignment) -> Result<Sheet, LayerError> {
    let mut sheet = sheet.clone();
    for ((index, edge), &target) in (0..).zip(&mut sheet.edges).zip(targets) {
        edge.assignment = match edge.assignment {
            Assignment::Border => continue,
            Assignment::Free if target == 0.0 => free,
            _ if target.abs() <= FLAT_ANGLE => Assignment::Facet,
            _ if (target.abs() - PI).abs() > FLAT_ANGLE => {
                let degrees = target.to_degrees();
                return Err(LayerError::TargetNotFlat { edge: index, degrees });
            }
            _ if target > 0.0 => Assignment::Valley,
            _ => Assignment::Mountain,
        };
    }
    Ok(sheet)
}

/// The folded creases around a vertex inside the sheet.
struct InnerVertex {
    vertex: u32,
    assignments: Vec<Assignment>,
    /// The angles between neighbouring creases, radians.
    sectors: Vec<f64>,
    /// The longest crease.
    length: f64,
}

/// The vertices inside the sheet at which it is folded.
fn inner_vertices(sheet: &Sheet) -> Vec<InnerVertex> {
    let mut edges = vec![Vec::new(); sheet.vertices.len()];
    let mut is_inner = vec![true; sheet.vertices.len()];
    for edge in &sheet.edges {
        for v in edge.vertices {
            is_inner[v as usize] &= edge.is_hinge();
            if is_folded(edge) {
                edges[v as usize].push(edge);
            }
        }
    }
    let inner = (0..).zip(edges).filter(|(v, edges)| is_inner[*v as usize] && !edges.is_empty());
    inner.map(|(vertex, edges)| InnerVertex::new(sheet, vertex, &edges)).collect()
}

impl InnerVertex {
    fn new(sheet: &Sheet, vertex: u32, edges: &[&Edge]) -> Self {
        let at = sheet.vertices[vertex as usize];
        let ray = |edge: &&Edge| {
            let [a, b] = edge.vertices;
            let other = if a == vertex { b } else { a };
            let towards = sheet.vertices[other as usize] - at;
            (towards.to_angle(), towards.length(), edge.assignment)
        };
        let mut rays: Vec<_> = edges.iter().map(ray).collect();
        rays.sort_by(|a, b| a.0.total_cmp(&b.0));
        let count = rays.len();
        let sector = |i: usize| (rays[(i + 1) % count].0 - rays[i].0).rem_euclid(TAU);
        Self {
            vertex,
            sectors: (0..count).map(sector).collect(),
            assignments: rays.iter().map(|ray| ray.2).collect(),
            length: rays.iter().map(|ray| ray.1).fold(0.0, f64::max),
        }
    }

    /// # Errors
    /// [`LayerError::OddCreases`], [`LayerError::MountainsAndValleys`].
    fn check_creases(&self, sheet: &Sheet) -> Result<(), LayerError> {
        let (vertex, position) = (self.vertex, sheet.vertices[self.vertex as usize].to_array());
        let creases = self.assignments.len();
        if !creases.is_multiple_of(2) {
            return Err(LayerError::OddCreases { vertex, position, creases });
        }
        let count = |kind| self.assignments.iter().filter(|&&a| a == kind).count();
        let [mountains, valleys] = [Assignment::Mountain, Assignment::Valley].map(count);
        if mountains + valleys == creases && mountains.abs_diff(valleys) != 2 {
            return Err(LayerError::MountainsAndValleys { vertex, position, mountains, valleys });
        }
        Ok(())
    }

    /// The sums of every other angle, radians.
    fn sums(&self) -> [f64; 2] {
        [0, 1].map(|start| self.sectors.iter().skip(start).step_by(2).sum())
    }

    /// How far its longest crease misses itself, a length.
    fn misfit(&self) -> f64 {
        let [a, b] = self.sums();
        self.length * (a - b).abs()
    }

    fn angle_error(&self, sheet: &Sheet) -> LayerError {
        LayerError::AngleSums {
            vertex: self.vertex,
            position: sheet.vertices[self.vertex as usize].to_array(),
            sums: self.sums().map(f64::to_degrees),
        }
    }
}
