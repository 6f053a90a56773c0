//! What is seen of a sheet, as polygons and line segments.
//!
//! Two triangles are compared by [`Surface`], as in pictures of pixels: g hides f where its depth exceeds that of f by
//! more than a threshold that depends on their layer order alone (0 without an order, ± the window of coincidence with
//! one). Both depths are linear on the screen, so the part of f that g hides is a convex polygon, the overlap of both
//! cut by one line more. What is seen of f is f without these polygons; what is seen of a line is what no triangle
//! hides on at least one side of it. So facets that penetrate each other are cut where their planes meet.

mod gaps;
mod grid;
mod hiding;
mod lines;
mod order;
mod plane;

use foldmotion_pattern::Assignment;
use glam::DVec2;
use rayon::prelude::*;

use self::grid::Grid;
use self::hiding::hidden_part;
use self::plane::outside;
use self::plane::{Plane, Rings};
pub(crate) use self::plane::{doubled_area, perimeter};
use crate::Surface;
use crate::screen_face::ScreenFace;

/// Visible parts whose doubled area is smaller are rounding, in square pixels.
const LEAST_AREA: f64 = 1e-7;

/// Visible parts and holes narrower than this are rounding, in pixels.
const LEAST_WIDTH: f64 = 1e-4;

/// The visible part of a triangle.
#[derive(Debug, Clone, PartialEq)]
pub struct VisibleArea {
    /// The index of the triangle.
    pub face: u32,
    /// Above the levels of all that the triangle hides: painted in this order, what is in front lies on top.
    pub level: u32,
    /// Closed rings in pixels; those of holes run opposite to the ones around them.
    pub rings: Vec<Vec<DVec2>>,
}

/// A visible part of an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VisibleLine {
    /// The index of the edge in the sheet.
    pub edge: u32,
    /// The triangle on whose side it is seen, the front one of two.
    pub face: u32,
    /// Whether it is seen on the triangles to its left and to its right, see [`foldmotion_pattern::Edge`].
    pub seen: [bool; 2],
    /// The level of the triangle.
    pub level: u32,
    /// Its start and end, pixels, from the edge's first vertex towards its second.
    pub ends: [DVec2; 2],
}

/// The visible areas and lines of a sheet.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Visible {
    /// Areas that do not overlap, by level.
    pub areas: Vec<VisibleArea>,
    /// Creases, the border, and edges inside a facet where the facet turns over, by level.
    pub lines: Vec<VisibleLine>,
}

impl Surface<'_> {
    /// The visible parts of all triangles and lines, whatever the width of lines.
    ///
    /// Exact but for parts narrower than 1e-4 pixels and rounding to about a 2⁻²⁶th of the picture's sides. Every point
    /// belongs to the triangle that [`Surface::front_at`] finds there for lines without width. Where noise and layer
    /// order contradict each other in a circle, so that every triangle is hidden by another, one point decides for a
    /// convex part, and no lines are seen in it. Takes about n + k time for n triangles and
    /// k pairs that overlap on the screen. Positions that do not project to finite pixels show nothing.
    pub fn visible(&self) -> Visible {
        let points = self.points().iter();
        let Some(plane) = Plane::new(points.map(|p| p.truncate())) else {
            return Visible::default();
        };
        let boxes: Vec<_> = self.faces().iter().map(ScreenFace::extent).collect();
        let scene = Scene { surface: self, plane, grid: Grid::new(&boxes), boxes };
        scene.visible()
    }
}

/// A surface while its visible parts are found.
struct Scene<'a> {
    surface: &'a Surface<'a>,
    plane: Plane,
    grid: Grid,
    boxes: Vec<[DVec2; 2]>,
}

/// A triangle that hides a part of another.
#[derive(Debug, Clone, Copy)]
struct Occluder {
    face: u32,
    /// Whether the layer order says so, not the depth.
    by_order: bool,
}

/// The visible part of a triangle: convex pieces.
#[derive(Debug, Default)]
struct VisibleParts {
    pieces: Rings,
    occluders: Vec<Occluder>,
}

impl Scene<'_> {
    fn visible(&self) -> Visible {
        let faces = || (0..self.boxes.len() as u32).into_par_iter();
        let mut seen: Vec<VisibleParts> = faces().map(|face| self.seen_of(face)).collect();
        let depths: Vec<f64> = self.surface.faces().iter().map(ScreenFace::middle).collect();
        let levels = order::levels(&seen, &depths);
        let level = |face: u32| levels[face as usize];
        let gaps: Vec<_> = faces().flat_map_iter(|face| gaps::over(self, face, &seen)).collect();
        for (face, piece) in gaps {
            seen[face as usize].pieces.push(piece);
        }
        let areas = faces().zip(seen).map(|(face, seen)| VisibleArea {
            face,
            level: level(face),
            rings: self.joined(seen.pieces),
        });
        let mut areas: Vec<_> = areas.filter(|area| !area.rings.is_empty()).collect();
        areas.sort_by_key(|area| (area.level, area.face));
        let edges = (0..self.surface.paper().sheet.edges.len() as u32).into_par_iter();
        let drawn = edges.filter(|&edge| self.is_drawn(edge));
        let mut lines: Vec<VisibleLine> =
            drawn.flat_map_iter(|edge| lines::seen_of(self, edge, &level)).collect();
        lines.sort_by_key(|line| (line.level, line.edge));
        Visible { areas, lines }
    }

    /// Convex pieces as one polygon.
    fn joined(&self, pieces: Rings) -> Rings {
        if pieces.len() < 2 {
            return pieces;
        }
        let mut rings = self.plane.union(&pieces);
        rings.retain(|ring| doubled_area(ring).abs() > LEAST_WIDTH * perimeter(ring));
        rings
    }

    /// Whether `edge` is a line: every edge but those inside a facet that is seen from one side.
    fn is_drawn(&self, edge: u32) -> bool {
        let edge = &self.surface.paper().sheet.edges[edge as usize];
        let [Some(left), Some(right)] = edge.faces else {
            return true;
        };
        let [left, right] = [left, right].map(|face| self.surface.face(face));
        let turns_over = left.faces_viewer() != right.faces_viewer()
            && !left.is_edge_on()
            && !right.is_edge_on();
        edge.assignment != Assignment::Facet || turns_over
    }

    /// The visible part of triangle `face`, and the triangles that hide a part of it.
    fn seen_of(&self, face: u32) -> VisibleParts {
        let (mut near, mut occluders, mut clips) = (Vec::new(), Vec::new(), Vec::new());
        if self.surface.face(face).is_edge_on() {
            return VisibleParts::default();
        }
        self.grid.near(&self.boxes[face as usize], &mut near);
        for &other in near.iter().filter(|&&other| other != face) {
            let threshold = self.surface.threshold(other, face);
            if let Some(part) = hidden_part(self.surface, other, face, threshold) {
                let by_order = threshold < 0.0;
                occluders.push(Occluder { face: other, by_order });
                clips.push(part);
            }
        }
        // Most that are hidden at all are hidden by the largest.
        clips.sort_by(|a, b| doubled_area(b).total_cmp(&doubled_area(a)));
        let mut pieces = vec![hiding::triangle(self.surface, face).to_vec()];
        for clip in &clips {
            for piece in std::mem::take(&mut pieces) {
                outside(piece, clip, LEAST_AREA, &mut pieces);
            }
        }
        VisibleParts { pieces, occluders }
    }
}
