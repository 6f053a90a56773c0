//! The sheet as triangles in space: its surface, or a closed solid of some thickness.

use std::collections::{BTreeMap, BTreeSet};

use foldmotion_pattern::Sheet;
use glam::DVec3;

use crate::RecordError;
use crate::raster::check_positions;

/// Triangles in space.
#[derive(Debug, Clone, PartialEq)]
pub struct Solid {
    /// The corners, in metres.
    pub vertices: Vec<DVec3>,
    /// The triangles, counter-clockwise seen from outside (of a surface: from its front).
    pub faces: Vec<[u32; 3]>,
}

impl Solid {
    /// The enclosed volume by the divergence theorem, Σ a·(b × c) / 6; of a closed solid.
    pub fn volume(&self) -> f64 {
        let origin = self.vertices.first().copied().unwrap_or_default();
        let part = |face: &[u32; 3]| {
            let [a, b, c] = face.map(|v| self.vertices[v as usize] - origin);
            a.dot(b.cross(c)) / 6.0
        };
        self.faces.iter().map(part).sum()
    }

    /// The unit normal of triangle `face`; zero where it has no area.
    pub fn normal(&self, face: [u32; 3]) -> DVec3 {
        let [a, b, c] = face.map(|v| self.vertices[v as usize]);
        (b - a).cross(c - a).normalize_or_zero()
    }
}

/// The surface of `sheet` with its vertices at `positions`: its own vertices and triangles, the front outside.
///
/// # Errors
/// [`RecordError::VertexCount`], [`RecordError::NotFinite`].
pub fn surface_of(sheet: &Sheet, positions: &[DVec3]) -> Result<Solid, RecordError> {
    check_positions(sheet, 0, positions)?;
    Ok(Solid { vertices: positions.to_vec(), faces: sheet.faces.clone() })
}

/// `sheet` with its vertices at `positions` as a closed solid of `thickness`.
///
/// Every facet is offset by half the thickness to both sides and becomes a plate of its own: the front and the back at
/// full size, closed by walls along its outline. A triangle is offset along the normal of its facet at each corner
/// (the mean of the facet's triangles there, weighted by their areas), so a flat facet of area A has volume
/// A × thickness.
///
/// Every edge has exactly two triangles, in opposite directions, and the outside is outward: each plate is watertight.
/// Limits: neighbouring plates are not joined. In the flat state they touch along their walls; at a folded
/// crease they overlap on the inner side and leave a wedge open on the outer side, both about thickness / 2 ×
/// tan(fold angle / 2) wide; layers closer than the thickness overlap. Slicers for printing unite overlapping plates;
/// the plates of a folded sheet hold together only where they overlap.
///
/// # Errors
/// [`RecordError::NotPositive`], [`RecordError::VertexCount`], [`RecordError::NotFinite`].
pub fn solid(sheet: &Sheet, positions: &[DVec3], thickness: f64) -> Result<Solid, RecordError> {
    if !(thickness.is_finite() && thickness > 0.0) {
        let (name, value) = ("thickness", thickness);
        return Err(RecordError::NotPositive { name, value });
    }
    check_positions(sheet, 0, positions)?;
    let mut plates: Vec<Vec<[u32; 3]>> = vec![Vec::new(); sheet.facets.len()];
    for (face, &facet) in sheet.faces.iter().zip(&sheet.face_facets) {
        plates[facet as usize].push(*face);
    }
    let mut solid = Solid { vertices: Vec::new(), faces: Vec::new() };
    for faces in &plates {
        solid.push_plate(faces, positions, 0.5 * thickness);
    }
    Ok(solid)
}

impl Solid {
    /// Adds the triangles `faces` of one facet, offset by `half` to both sides and closed.
    fn push_plate(&mut self, faces: &[[u32; 3]], positions: &[DVec3], half: f64) {
        let mut normals: BTreeMap<u32, DVec3> = BTreeMap::new();
        for face in faces {
            let [a, b, c] = face.map(|v| positions[v as usize]);
            let normal = (b - a).cross(c - a);
            for &vertex in face {
                *normals.entry(vertex).or_default() += normal;
            }
        }
        let first = self.vertices.len() as u32;
        let mut indices = BTreeMap::new();
        for (index, (&vertex, normal)) in (first..).step_by(2).zip(&normals) {
            let offset = normal.normalize_or(DVec3::Z) * half;
            let middle = positions[vertex as usize];
            self.vertices.extend([middle + offset, middle - offset]);
            indices.insert(vertex, index);
        }
        for face in faces {
            let [a, b, c] = face.map(|v| indices[&v]);
            self.faces.extend([[a, b, c], [c + 1, b + 1, a + 1]]);
        }
        let edges = |face: &[u32; 3]| [0, 1, 2].map(|i| [face[i], face[(i + 1) % 3]]);
        let all: BTreeSet<[u32; 2]> = faces.iter().flat_map(edges).collect();
        for &[a, b] in all.iter().filter(|[a, b]| !all.contains(&[*b, *a])) {
            let [a, b] = [indices[&a], indices[&b]];
            self.faces.extend([[a, a + 1, b + 1], [a, b + 1, b]]);
        }
    }
}
