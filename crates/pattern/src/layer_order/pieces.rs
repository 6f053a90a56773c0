//! The convex pieces that are put in order, and the lines at which they are joined.

use glam::DVec2;

use super::FlatState;
use super::convex::Convex;
use super::placed::is_folded;
use crate::Sheet;

/// Corners of a facet may turn the other way by this much of the product of the lengths of their sides.
const STRAIGHT: f64 = 1e-9;

/// A convex piece of the flat state: a facet, or a triangle of one that is not convex.
#[derive(Debug, Clone)]
pub(super) struct Piece {
    pub(super) facet: u32,
    /// Whether its front faces down.
    pub(super) is_turned: bool,
    /// Where it lies.
    pub(super) place: Convex,
}

/// A line at which two pieces are joined.
#[derive(Debug, Clone, Copy)]
pub(super) struct Joint {
    /// The edge of the sheet.
    pub(super) edge: u32,
    pub(super) pieces: [u32; 2],
    /// Whether the sheet is folded here, so that both pieces lie on one side of the line.
    pub(super) is_folded: bool,
    pub(super) ends: [DVec2; 2],
}

/// All pieces and joints.
#[derive(Debug)]
pub(super) struct Pieces {
    pub(super) list: Vec<Piece>,
    pub(super) joints: Vec<Joint>,
    /// The piece of each triangle.
    pub(super) of_triangle: Vec<u32>,
}

impl Pieces {
    pub(super) fn new(state: &FlatState) -> Self {
        let sheet = &state.sheet;
        let is_whole = whole_facets(sheet);
        let mut of_facet = vec![None; sheet.facets.len()];
        let mut list: Vec<Piece> = Vec::new();
        let mut of_triangle = Vec::with_capacity(sheet.faces.len());
        for (face, &facet) in (0..).zip(&sheet.face_facets) {
            if !is_whole[facet as usize] {
                of_triangle.push(list.len() as u32);
                list.push(piece(state, face, &sheet.faces[face as usize]));
                continue;
            }
            let known = *of_facet[facet as usize].get_or_insert_with(|| {
                list.push(piece(state, face, &sheet.facets[facet as usize].polygon));
                list.len() as u32 - 1
            });
            of_triangle.push(known);
        }
        let mut joints = Vec::new();
        for (index, edge) in (0..).zip(&sheet.edges) {
            let [Some(f), Some(g)] = edge.faces else { continue };
            let pieces = [f, g].map(|face| of_triangle[face as usize]);
            if pieces[0] != pieces[1] {
                let ends = edge.vertices.map(|v| state.positions[v as usize]);
                joints.push(Joint { edge: index, pieces, is_folded: is_folded(edge), ends });
            }
        }
        Self { list, joints, of_triangle }
    }
}

fn piece(state: &FlatState, face: u32, corners: &[u32]) -> Piece {
    let is_turned = state.is_turned[face as usize];
    let mut place: Vec<DVec2> = corners.iter().map(|&v| state.positions[v as usize]).collect();
    if is_turned {
        place.reverse();
    }
    let facet = state.sheet.face_facets[face as usize];
    Piece { facet, is_turned, place: Convex::new(place) }
}

/// Which facets are convex polygons without folds inside.
fn whole_facets(sheet: &Sheet) -> Vec<bool> {
    let mut triangles = vec![0; sheet.facets.len()];
    for &facet in &sheet.face_facets {
        triangles[facet as usize] += 1;
    }
    let is_convex = |(facet, &count): (&crate::Facet, &usize)| {
        let corners = &facet.polygon;
        let at = |i: usize| sheet.vertices[corners[i % corners.len()] as usize];
        let turns = |i: usize| {
            let (along, next) = (at(i + 1) - at(i), at(i + 2) - at(i + 1));
            along.perp_dot(next) >= -STRAIGHT * along.length() * next.length()
        };
        corners.len() == count + 2 && (0..corners.len()).all(turns)
    };
    let mut is_whole: Vec<bool> = sheet.facets.iter().zip(&triangles).map(is_convex).collect();
    for edge in sheet.edges.iter().filter(|edge| is_folded(edge)) {
        if let [Some(f), Some(g)] = edge.faces.map(|face| Some(sheet.face_facets[face? as usize]))
            && f == g
        {
            is_whole[f as usize] = false;
        }
    }
    is_whole
}
