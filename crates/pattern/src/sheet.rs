//! The sheet: a triangulated crease pattern.

use foldmotion_geometry::fold_angle;
use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

/// What an edge of the crease pattern is (the letters of FOLD 1.2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Assignment {
    /// B: the border of the sheet.
    #[serde(rename = "B")]
    Border,
    /// M: folds away from the front; negative fold angles.
    #[serde(rename = "M")]
    Mountain,
    /// V: folds towards the front; positive fold angles.
    #[serde(rename = "V")]
    Valley,
    /// F: not a crease; inside a facet, where a quadrilateral is split into triangles.
    #[serde(rename = "F")]
    Facet,
    /// U: a hinge that nothing drives and nothing holds.
    #[serde(rename = "U")]
    Free,
}

impl Assignment {
    /// The letter in a FOLD file.
    pub fn letter(self) -> char {
        match self {
            Self::Border => 'B',
            Self::Mountain => 'M',
            Self::Valley => 'V',
            Self::Facet => 'F',
            Self::Free => 'U',
        }
    }
}

/// The position of an edge in the unit, by which a schedule names it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum CreaseKind {
    /// On the boundary between two rows: the only creases bent in the deployed state.
    Row,
    /// Between a flap and a tuck.
    Diagonal,
    /// Along a corner or a mid line, between two flaps or two tucks.
    Vertical,
    /// Beside or across a pad: flap–pad, tuck–wall, wall–wall, wall–bottom pad.
    Pad,
    /// Between two columns, where the sheet folds like a map.
    Column,
    /// Part of an imported sheet, which has no units.
    Imported,
    /// The border of the sheet.
    Border,
    /// A line inside a facet, no crease.
    Facet,
}

/// An edge of the triangulated sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// The vertices at its ends.
    pub vertices: [u32; 2],
    /// Mountain, valley, border, inside a facet or a free hinge.
    pub assignment: Assignment,
    /// The position of the edge in its unit.
    pub kind: CreaseKind,
    /// The row it lies in; an edge on a boundary between rows carries the row below the boundary (the later one).
    pub row: u32,
    /// The column it lies in (the one with the smaller index for an edge between two).
    pub column: u32,
    /// The triangles on the left and on the right of `vertices[0]` → `vertices[1]`, seen from the front.
    pub faces: [Option<u32>; 2],
}

impl Edge {
    /// Whether two triangles meet here, so that it has a fold angle.
    pub fn is_hinge(&self) -> bool {
        self.faces[0].is_some() && self.faces[1].is_some()
    }

    /// Whether it is drawn and driven as a crease.
    pub fn is_crease(&self) -> bool {
        matches!(self.assignment, Assignment::Mountain | Assignment::Valley)
    }
}

/// What a facet is in the unit (the names of the unit's parts).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FacetKind {
    /// Between a corner line and M1–M2.
    Flap,
    /// Between a mid line and a row boundary.
    Tuck,
    /// Lies on the upper skin plane in the compact state.
    TopPad,
    /// Lies on the lower skin plane in the compact state.
    BottomPad,
    /// Stands between the skin planes in the compact state.
    Wall,
    /// A whole unit, its creases held flat: of a sheet that folds like a map.
    Unit,
    /// Part of an imported sheet, which has no units.
    Plain,
}

impl FacetKind {
    /// The name in words, for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Flap => "flap",
            Self::Tuck => "tuck",
            Self::TopPad => "top pad",
            Self::BottomPad => "bottom pad",
            Self::Wall => "wall",
            Self::Unit => "unit",
            Self::Plain => "facet",
        }
    }
}

/// A facet of the crease pattern: a triangle, a quadrilateral, or a whole unit; of an imported sheet any polygon.
#[derive(Debug, Clone, PartialEq)]
pub struct Facet {
    /// Its corners, counter-clockwise seen from the front; of a facet with holes those of its outer border.
    pub polygon: Vec<u32>,
    /// The row of the unit, counted from 0.
    pub row: u32,
    /// The column; a pad between two columns carries the smaller one.
    pub column: u32,
    /// The part of the unit.
    pub kind: FacetKind,
}

/// A triangulated crease pattern.
///
/// Guarantees of every constructor in this crate: all indices are in range, triangles are counter-clockwise and have
/// positive area, every edge joins one or two triangles, quadrilaterals are split by the shorter diagonal (ties by
/// the lowest vertex).
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet {
    /// Positions in the crease pattern, rows along −x and the width along +y.
    pub vertices: Vec<DVec2>,
    /// Every edge of the triangulation, once.
    pub edges: Vec<Edge>,
    /// The triangles, counter-clockwise seen from the front.
    pub faces: Vec<[u32; 3]>,
    /// The facet each triangle belongs to.
    pub face_facets: Vec<u32>,
    /// The facets of the crease pattern.
    pub facets: Vec<Facet>,
    /// The length tolerances are stated in: h for a sheet of units, the mean edge length for an imported one.
    pub unit_length: f64,
}

impl Sheet {
    /// The corner of triangle `face` that does not lie on `edge`.
    pub fn apex(&self, face: u32, edge: &Edge) -> Option<u32> {
        self.faces[face as usize].into_iter().find(|v| !edge.vertices.contains(v))
    }

    /// The four points of a hinge, [e0, e1, left apex, right apex]; `None` for a border edge.
    pub fn hinge_vertices(&self, edge: &Edge) -> Option<[u32; 4]> {
        let [left, right] = edge.faces;
        Some([
            edge.vertices[0],
            edge.vertices[1],
            self.apex(left?, edge)?,
            self.apex(right?, edge)?,
        ])
    }

    /// The fold angle of every edge in radians in (−π, π]; `None` for border edges.
    ///
    /// `positions`: one for each vertex.
    pub fn fold_angles(&self, positions: &[DVec3]) -> Vec<Option<f64>> {
        let angle = |edge: &Edge| {
            let [e0, e1, left, right] = self.hinge_vertices(edge)?.map(|v| positions[v as usize]);
            Some(fold_angle(e0, e1, left, right))
        };
        self.edges.iter().map(angle).collect()
    }

    /// The planar state: the crease pattern in the plane z = 0.
    pub fn planar(&self) -> Vec<DVec3> {
        self.vertices.iter().map(|v| v.extend(0.0)).collect()
    }
}
