//! The exact states of a sheet of units: deployed, planar (see [`Sheet::planar`](crate::Sheet::planar)), compact.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use std::collections::VecDeque;

use foldmotion_geometry::RigidMotion;
use glam::{DMat3, DQuat, DVec2, DVec3};

use crate::unit_sheet::{Family, VertexLocation};
use crate::{Case, CreaseKind, Folding, PatternError, Sheet, UnitSheet};

/// The side of the profile, seen along it from its start, on which the flaps are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Facing {
    /// On the left in the x–z plane with x to the right and z up.
    #[default]
    Left,
    /// On the right.
    Right,
}

impl UnitSheet {
    /// The deployed state: row i lies on the segment from `polygon[i]` to `polygon[i + 1]`, only the hinges between
    /// rows are bent (section 2 of the paper).
    ///
    /// `polygon`: Nr + 1 points (x, z), neighbours their row's h apart. Isometric to the sheet as far as they are.
    ///
    /// # Errors
    /// A polygon of another number of points.
    pub fn deployed(&self, polygon: &[DVec2], facing: Facing) -> Result<Vec<DVec3>, PatternError> {
        self.require_polygon(polygon)?;
        let width = self.unit.width * self.columns as f64;
        let position = |&(line, location): &(u32, VertexLocation)| {
            let at = match location {
                VertexLocation::Boundary { boundary } => polygon[boundary as usize],
                VertexLocation::Mid { row, lower, .. } => {
                    let unit = &self.row_units[row as usize];
                    let fraction = unit.mid_distance() / unit.height;
                    let (from, to) = (polygon[row as usize], polygon[row as usize + 1]);
                    from.lerp(to, if lower { 1.0 - fraction } else { fraction })
                }
            };
            let y = self.lines[line as usize].y;
            let y = match facing {
                Facing::Left => y,
                Facing::Right => width - y,
            };
            DVec3::new(at.x, y, at.y)
        };
        Ok(self.with_middle_nodes(self.locations.iter().map(position).collect()))
    }

    /// The fold angle of every edge in the deployed state, radians: the turn of the polygon at the hinges between
    /// rows (positive where it turns towards the front), exactly 0 at every other edge.
    ///
    /// # Errors
    /// A polygon of another number of points.
    pub fn deployed_angles(
        &self,
        polygon: &[DVec2],
        facing: Facing,
    ) -> Result<Vec<f64>, PatternError> {
        self.require_polygon(polygon)?;
        // The front lies on the right of the profile if the flaps are on its left.
        let sign = match facing {
            Facing::Left => -1.0,
            Facing::Right => 1.0,
        };
        let turns: Vec<f64> =
            polygon.windows(3).map(|p| sign * turn(p[1] - p[0], p[2] - p[1])).collect();
        let angle = |edge: &crate::Edge| match edge.kind {
            CreaseKind::Row => turns[edge.row as usize - 1],
            _ => 0.0,
        };
        Ok(self.sheet.edges.iter().map(angle).collect())
    }

    fn require_polygon(&self, polygon: &[DVec2]) -> Result<(), PatternError> {
        if polygon.len() == self.rows + 1 {
            Ok(())
        } else {
            Err(PatternError::WrongPolygon { found: polygon.len(), rows: self.rows })
        }
    }

    /// The exact compact state: growing along −x from the first row, the width along y, flaps along −z.
    ///
    /// For `plain` every crease lies at ±180°, each row turned against the row before (figures 3d, 4d); the first
    /// row lies as in case E. A map lies in the plane z = 0 with unit (0, 0) facing up.
    pub fn compact(&self) -> Vec<DVec3> {
        if self.folding == Folding::Map {
            return self.compact_map();
        }
        if self.unit.case == Case::Plain {
            return self.compact_plain();
        }
        let a = self.unit.flap;
        // x of the P and the Q lines on every boundary.
        let (mut p, mut q) = (vec![0.0], vec![-a]);
        for row in 0..self.rows {
            let (corner, mid) = if row % 2 == 0 { (&mut p, &mut q) } else { (&mut q, &mut p) };
            corner.push(corner[row] - self.row_height(row));
            mid.push(corner[row + 1] + a);
        }
        let position = |&(line, location): &(u32, VertexLocation)| {
            let line = &self.lines[line as usize];
            let (own, other) = if line.family == Family::P { (&p, &q) } else { (&q, &p) };
            let (x, z) = match location {
                VertexLocation::Boundary { boundary } => (own[boundary as usize], 0.0),
                // A mid line's corner line is the other family.
                VertexLocation::Mid { row, both: true, .. } => {
                    (f64::midpoint(other[row as usize], other[row as usize + 1]), -a)
                }
                VertexLocation::Mid { row, lower: false, .. } => (other[row as usize] - a, -a),
                VertexLocation::Mid { row, lower: true, .. } => (other[row as usize + 1] + a, -a),
            };
            DVec3::new(x, line.compact_y, z)
        };
        self.with_middle_nodes(self.locations.iter().map(position).collect())
    }

    fn compact_plain(&self) -> Vec<DVec3> {
        let (mut positions, root) = fold(&self.sheet, &self.compact_angles);
        // The first flap: corner-top at the origin, corner-bottom along −x, the mid vertex towards −z.
        let [a, b, c] = self.sheet.faces[root as usize].map(|v| v as usize);
        let corners: Vec<usize> = {
            let mut corners = vec![a, b, c];
            // Of the first half unit's flap, the mid vertex is the only one off the boundary.
            corners
                .sort_by_key(|&v| (matches!(self.locations[v].1, VertexLocation::Mid { .. }), v));
            corners
        };
        let source: Vec<DVec3> = corners.iter().map(|&v| positions[v]).collect();
        let target = [
            DVec3::ZERO,
            DVec3::new(-self.unit.height, 0.0, 0.0),
            DVec3::new(-self.unit.height / 2.0, 0.0, -self.unit.flap),
        ];
        let motion = RigidMotion::best_fit(&source, &target);
        for position in &mut positions {
            *position = motion.apply(*position);
        }
        positions
    }
}

/// The angle from one direction to another, in (−π, π]; keeps its digits near 0, unlike an arccosine.
fn turn(from: DVec2, to: DVec2) -> f64 {
    from.perp_dot(to).atan2(from.dot(to))
}

/// Folds the sheet by the given fold angles (radians, one for each edge), facet by facet from the first flap outwards,
/// each turned about the edge over which it is reached. Returns the positions and the triangle that stayed in the
/// plane.
///
/// The result is a state of the sheet only where the angles close around every vertex; the caller checks that.
fn fold(sheet: &Sheet, angles: &[f64]) -> (Vec<DVec3>, u32) {
    let root = sheet
        .face_facets
        .iter()
        .position(|&f| sheet.facets[f as usize].kind == crate::FacetKind::Flap)
        .unwrap_or(0) as u32;
    let mut across: Vec<Vec<(u32, usize)>> = vec![Vec::new(); sheet.faces.len()];
    for (index, edge) in sheet.edges.iter().enumerate() {
        if let [Some(left), Some(right)] = edge.faces {
            across[left as usize].push((right, index));
            across[right as usize].push((left, index));
        }
    }
    let mut placed: Vec<Option<(DMat3, DVec3)>> = vec![None; sheet.faces.len()];
    placed[root as usize] = Some((DMat3::IDENTITY, DVec3::ZERO));
    let mut queue = VecDeque::from([root]);
    let mut positions = vec![DVec3::ZERO; sheet.vertices.len()];
    while let Some(face) = queue.pop_front() {
        let Some((rotation, shift)) = placed[face as usize] else {
            continue;
        };
        for vertex in sheet.faces[face as usize] {
            positions[vertex as usize] =
                rotation * sheet.vertices[vertex as usize].extend(0.0) + shift;
        }
        for &(next, index) in &across[face as usize] {
            if placed[next as usize].is_some() {
                continue;
            }
            let edge = &sheet.edges[index];
            let [e0, e1] = edge.vertices.map(|v| positions[v as usize]);
            // Seen from a fixed right facet a positive angle turns the left one about e0 → e1; seen from the left
            // facet it turns the right one in the opposite direction.
            let turn = if edge.faces[0] == Some(next) { angles[index] } else { -angles[index] };
            let spin = DMat3::from_quat(DQuat::from_axis_angle((e1 - e0).normalize(), turn));
            placed[next as usize] = Some((spin * rotation, spin * (shift - e0) + e0));
            queue.push_back(next);
        }
    }
    (positions, root)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Unit;

    /// Positions of one state fitted onto another: the largest distance left.
    fn misfit(a: &[DVec3], b: &[DVec3]) -> f64 {
        let motion = RigidMotion::best_fit(a, b);
        a.iter().zip(b).map(|(&p, &q)| motion.apply(p).distance(q)).fold(0.0, f64::max)
    }

    #[test]
    fn folding_every_crease_to_its_compact_angle_gives_the_closed_form_of_the_compact_state() {
        for (case, width, lambda, offset) in [
            (Case::E, 1.0, None, None),
            (Case::T, 0.7, None, None),
            (Case::S, 1.6, None, None),
            (Case::SII, 1.6, Some(0.7), None),
            (Case::SII, 2.3, Some(0.4), Some(0.0)),
            (Case::SII, 1.2, Some(0.9), Some(0.1)),
        ] {
            let unit = Unit::new(case, width, 1.0, lambda, offset).unwrap();
            for (rows, columns) in [(1, 1), (2, 1), (3, 2), (7, 3)] {
                let sheet = UnitSheet::new(unit, rows, columns).unwrap();
                let (folded, _) = fold(&sheet.sheet, sheet.compact_angles());
                let error = misfit(&folded, &sheet.compact());
                assert!(error < 1e-13, "{case:?} {rows} x {columns}: {error}");
            }
        }
    }

    #[test]
    fn a_wrong_angle_is_not_the_compact_state() {
        let sheet =
            UnitSheet::new(Unit::new(Case::S, 1.6, 1.0, None, None).unwrap(), 3, 2).unwrap();
        let mut angles = sheet.compact_angles().to_vec();
        let crease = sheet.sheet.edges.iter().position(|e| e.kind == CreaseKind::Diagonal).unwrap();
        angles[crease] -= 0.1;
        let (folded, _) = fold(&sheet.sheet, &angles);
        assert!(misfit(&folded, &sheet.compact()) > 1e-3);
    }
}
