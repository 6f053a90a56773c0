//! What is seen of a sheet, as polygons and line segments.
//!
//! Two triangles are compared by [`Surface`], as in pictures of pixels: g hides f where its depth exceeds that of f by
//! more than a threshold that depends on their layer order alone (0 without an order, ± the window of coincidence with
//! one). Both depths are linear on the screen, so the part of f that g hides is a convex polygon, the overlap of both
//! cut by one line more. What is seen of f is f without these polygons; what is seen of a line is what no triangle hides
//! on at least one side of it. So facets that penetrate each other are cut where their planes meet.

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
pub(crate) use self::plane::{Plane, Rings, doubled_area};
use crate::Surface;

/// Visible parts smaller than this are rounding, in square pixels.
const LEAST_AREA: f64 = 1e-7;

/// So many hiding polygons are subtracted at once: few, because most triangles that are hidden at all are hidden by the
/// largest of them.
const BATCH: usize = 12;

/// The visible part of a triangle.
#[derive(Debug, Clone, PartialEq)]
pub struct VisibleArea {
    /// The triangle.
    pub face: u32,
    /// Closed rings in pixels; those of holes run the other way round than the ones around them.
    pub rings: Vec<Vec<DVec2>>,
}

/// A visible part of an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VisibleLine {
    /// The edge of the sheet.
    pub edge: u32,
    /// The triangle on whose side it is seen, the front one of two.
    pub face: u32,
    /// Where it begins and ends, pixels, from the edge's first vertex towards its second.
    pub ends: [DVec2; 2],
}

/// What is seen of a sheet.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Visible {
    /// Areas that do not overlap; each after those that its triangle hides in part.
    pub areas: Vec<VisibleArea>,
    /// Creases, the border, and edges inside a facet where the facet turns over; in the same sequence.
    pub lines: Vec<VisibleLine>,
}

impl Surface<'_> {
    /// The visible parts of all triangles and lines, whatever the width of lines.
    ///
    /// Exact up to a grid of about a 2⁻²⁶th of the picture's sides. Every point belongs to the triangle that
    /// [`Surface::front_at`] finds there for lines without width; where noise and layer order contradict each other in
    /// a circle, so that every triangle is hidden by another, this is sampled. Takes about n + k time for n triangles and
    /// k pairs that overlap on the screen. Positions that do not project to finite pixels show nothing.
    pub fn visible(&self) -> Visible {
        let points = self.points().iter();
        let Some(plane) = Plane::new(points.map(|p| p.truncate())) else {
            return Visible::default();
        };
        let boxes: Vec<_> = self.faces().iter().map(|face| face.extent()).collect();
        let scene = Scene {
            surface: self,
            plane,
            grid: Grid::new(&boxes),
            boxes,
        };
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

impl Scene<'_> {
    fn visible(&self) -> Visible {
        let faces = (0..self.boxes.len() as u32).into_par_iter();
        let (rings, hidden_by): (Vec<Rings>, Vec<Vec<u32>>) =
            faces.map(|face| self.seen_of(face)).unzip();
        let depths: Vec<f64> = self.surface.faces().iter().map(|f| f.middle()).collect();
        let places = order::places(&hidden_by, &depths);
        let place = |face: u32| places[face as usize];
        let mut areas: Vec<VisibleArea> = (0..)
            .zip(rings)
            .map(|(face, rings)| VisibleArea { face, rings })
            .collect();
        gaps::fill(self, &mut areas);
        areas.retain(|area| !area.rings.is_empty());
        areas.sort_by_key(|area| place(area.face));
        let edges = (0..self.surface.paper().sheet.edges.len() as u32).into_par_iter();
        let drawn = edges.filter(|&edge| self.is_drawn(edge));
        let mut lines: Vec<VisibleLine> = drawn
            .flat_map_iter(|edge| lines::seen_of(self, edge, &place))
            .collect();
        lines.sort_by_key(|line| (place(line.face), line.edge));
        Visible { areas, lines }
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

    /// What is seen of triangle `face`, and which triangles hide a part of it.
    fn seen_of(&self, face: u32) -> (Rings, Vec<u32>) {
        let (mut near, mut hiders, mut clips) = (Vec::new(), Vec::new(), Vec::new());
        if self.surface.face(face).is_edge_on() {
            return (Vec::new(), hiders);
        }
        self.grid.near(&self.boxes[face as usize], &mut near);
        for &other in near.iter().filter(|&&other| other != face) {
            if let Some(part) = hidden_part(self.surface, other, face) {
                hiders.push(other);
                clips.push(part);
            }
        }
        clips.sort_by(|a, b| doubled_area(b).total_cmp(&doubled_area(a)));
        let mut seen = vec![hiding::triangle(self.surface, face).to_vec()];
        for batch in clips.chunks(BATCH) {
            seen = self.plane.without(&seen, batch);
            if seen.is_empty() {
                break;
            }
        }
        seen.retain(|ring| doubled_area(ring).abs() > LEAST_AREA);
        (seen, hiders)
    }
}
