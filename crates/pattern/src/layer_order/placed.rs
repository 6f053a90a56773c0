//! Where reflections at the creases bring each triangle.

use std::collections::VecDeque;

use glam::{DAffine2, DMat2, DVec2};

use super::LayerError;
use crate::{Assignment, Edge, Sheet};

/// Boxes of pieces may lie on each other by this much, in mean edges, without one being moved.
const TOUCHING: f64 = 1e-6;

/// The maps of the triangles from the pattern to the flat state.
pub(super) struct Placed {
    places: Vec<DAffine2>,
}

/// A vertex that two facets bring to different positions.
pub(super) struct Misfit {
    pub(super) vertex: u32,
    pub(super) facets: [u32; 2],
    pub(super) distance: f64,
}

impl Placed {
    /// Walks over each piece of the sheet from its largest facet, nearest triangles first.
    ///
    /// # Errors
    /// [`LayerError::OddLoop`].
    pub(super) fn new(sheet: &Sheet) -> Result<Self, LayerError> {
        let mut walk = Walk::new(sheet);
        let mut apart = Apart::new(sheet);
        while let Some(root) = walk.largest_facet_triangle() {
            let piece = walk.piece(root)?;
            let shift = DAffine2::from_translation(apart.shift(&piece, &walk.places));
            for &face in &piece {
                let place = &mut walk.places[face as usize];
                *place = place.map(|place| shift * place);
            }
            apart.add(&piece, &walk.places);
        }
        Ok(Self { places: walk.places.into_iter().map(Option::unwrap_or_default).collect() })
    }

    /// Whether the front of each triangle faces down.
    pub(super) fn is_turned(&self) -> Vec<bool> {
        self.places.iter().map(is_turned).collect()
    }

    /// The mean position of each vertex, and the largest misfit.
    pub(super) fn positions(&self, sheet: &Sheet) -> (Vec<DVec2>, Misfit) {
        let count = sheet.vertices.len();
        let mut sums = vec![(DVec2::ZERO, 0.0); count];
        let mut first = vec![None; count];
        let mut worst = Misfit { vertex: 0, facets: [0; 2], distance: 0.0 };
        for (face, corners) in sheet.faces.iter().enumerate() {
            for &vertex in corners {
                let v = vertex as usize;
                let at = self.places[face].transform_point2(sheet.vertices[v]);
                sums[v].0 += at;
                sums[v].1 += 1.0;
                let (other, there) = *first[v].get_or_insert((face, at));
                let distance = at.distance(there);
                if distance > worst.distance {
                    let facets = [other, face].map(|f| sheet.face_facets[f]);
                    worst = Misfit { vertex, facets, distance };
                }
            }
        }
        let mean = |(sum, count): (DVec2, f64)| sum / count.max(1.0);
        (sums.into_iter().map(mean).collect(), worst)
    }
}

fn is_turned(place: &DAffine2) -> bool {
    place.matrix2.determinant() < 0.0
}

/// A walk over the sheet in progress.
struct Walk<'a> {
    sheet: &'a Sheet,
    /// The edges around each triangle, and the triangles beyond them.
    beside: Vec<Vec<(u32, u32)>>,
    /// Twice the area of each facet.
    areas: Vec<f64>,
    places: Vec<Option<DAffine2>>,
}

impl<'a> Walk<'a> {
    fn new(sheet: &'a Sheet) -> Self {
        let mut beside = vec![Vec::new(); sheet.faces.len()];
        for (index, edge) in (0u32..).zip(&sheet.edges) {
            if let [Some(f), Some(g)] = edge.faces {
                beside[f as usize].push((index, g));
                beside[g as usize].push((index, f));
            }
        }
        let mut areas = vec![0.0; sheet.facets.len()];
        for (&corners, &facet) in sheet.faces.iter().zip(&sheet.face_facets) {
            let [p, q, r] = corners.map(|v| sheet.vertices[v as usize]);
            areas[facet as usize] += (q - p).perp_dot(r - p);
        }
        Self { sheet, beside, areas, places: vec![None; sheet.faces.len()] }
    }

    /// A triangle of the facet with the largest area among those not reached, the first of equal ones.
    fn largest_facet_triangle(&self) -> Option<u32> {
        let faces = self.sheet.face_facets.iter().zip(&self.places).zip(0..);
        let open = faces.filter(|((_, place), _)| place.is_none());
        let open = open.map(|((&facet, _), face)| (self.areas[facet as usize], face));
        let most = open.clone().map(|(area, _)| area).fold(0.0, f64::max);
        // Areas that differ only by rounding tie.
        let mut largest = open.filter(|(area, _)| *area >= most * (1.0 - 1e-9));
        largest.next().map(|(_, face)| face)
    }

    /// Places all triangles that edges join with `root`, which stays in place.
    fn piece(&mut self, root: u32) -> Result<Vec<u32>, LayerError> {
        self.places[root as usize] = Some(DAffine2::IDENTITY);
        let mut piece = vec![root];
        let mut reached = VecDeque::from([root]);
        while let Some(face) = reached.pop_front() {
            let Some(place) = self.places[face as usize] else { continue };
            for &(index, next) in &self.beside[face as usize] {
                let edge = &self.sheet.edges[index as usize];
                let is_reflected = is_folded(edge);
                let there = if is_reflected { place * reflection(self.sheet, edge) } else { place };
                match &mut self.places[next as usize] {
                    unplaced @ None => {
                        *unplaced = Some(there);
                        piece.push(next);
                        reached.push_back(next);
                    }
                    Some(known) if is_turned(known) != is_turned(&there) => {
                        return Err(LayerError::OddLoop { edge: index });
                    }
                    Some(_) => {}
                }
            }
        }
        Ok(piece)
    }
}

/// Whether a sheet with assignments of a flat state is folded at an edge.
pub(super) fn is_folded(edge: &Edge) -> bool {
    edge.is_crease() || edge.assignment == Assignment::Free
}

fn reflection(sheet: &Sheet, edge: &Edge) -> DAffine2 {
    let [a, b] = edge.vertices.map(|v| sheet.vertices[v as usize]);
    let along = (b - a).normalize_or_zero();
    let turn = DMat2::from_cols(2.0 * along.x * along, 2.0 * along.y * along) - DMat2::IDENTITY;
    DAffine2::from_mat2_translation(turn, a - turn * a)
}

/// The pieces that are placed, to keep the next one apart from them.
struct Apart<'a> {
    sheet: &'a Sheet,
    /// Where each vertex lies.
    positions: Vec<Option<DVec2>>,
    /// The lower left and the upper right corner of each piece.
    boxes: Vec<[DVec2; 2]>,
}

impl<'a> Apart<'a> {
    fn new(sheet: &'a Sheet) -> Self {
        Self { sheet, positions: vec![None; sheet.vertices.len()], boxes: Vec::new() }
    }

    /// How far a piece is to be moved: to the vertex that it shares with another or, if it shares none and would come to lie
    /// on another, to the right of all.
    fn shift(&self, piece: &[u32], places: &[Option<DAffine2>]) -> DVec2 {
        let corners = self.corners(piece, places);
        for &(vertex, at) in &corners {
            if let Some(known) = self.positions[vertex as usize] {
                return known - at;
            }
        }
        let [low, high] = bounds(&corners);
        let unit = self.sheet.unit_length;
        let is_on = |[from, to]: &[DVec2; 2]| {
            (high.min(*to) - low.max(*from)).min_element() > TOUCHING * unit
        };
        if !self.boxes.iter().any(is_on) {
            return DVec2::ZERO;
        }
        let right = self.boxes.iter().map(|[_, to]| to.x).fold(f64::NEG_INFINITY, f64::max);
        DVec2::new(right + unit - low.x, 0.0)
    }

    fn add(&mut self, piece: &[u32], places: &[Option<DAffine2>]) {
        let corners = self.corners(piece, places);
        for &(vertex, at) in &corners {
            self.positions[vertex as usize].get_or_insert(at);
        }
        self.boxes.push(bounds(&corners));
    }

    /// The vertices of a piece with their positions.
    fn corners(&self, piece: &[u32], places: &[Option<DAffine2>]) -> Vec<(u32, DVec2)> {
        let mut corners = Vec::with_capacity(3 * piece.len());
        for &face in piece {
            let place = places[face as usize].unwrap_or_default();
            let at = |v: u32| (v, place.transform_point2(self.sheet.vertices[v as usize]));
            corners.extend(self.sheet.faces[face as usize].map(at));
        }
        corners
    }
}

fn bounds(corners: &[(u32, DVec2)]) -> [DVec2; 2] {
    let start = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    corners.iter().fold(start, |[low, high], (_, at)| [low.min(*at), high.max(*at)])
}
