//! Polygons cut into triangles.

use glam::{DVec2, DVec3};

use super::error::FoldError;
use crate::delaunay::delaunay;

/// The most corners of a face: far more than crease patterns have, few enough to bound the time that one face takes.
pub(super) const MOST_CORNERS: usize = 1024;

/// Twice the area below which a polygon counts as having none, in squares of its size.
const AREA_LIMIT: f64 = 1e-12;

/// The triangles of face `face` with `polygon` as corners, each oriented as the polygon is.
///
/// The polygon is seen in the plane normal to its area vector (Newell). A strictly convex outline becomes a fan from
/// its first corner, any other its constrained Delaunay triangulation. A triangle stays as it is.
///
/// # Errors
/// [`FoldError::ZeroArea`], or [`FoldError::NotSimple`] if the outline crosses or touches itself.
pub(super) fn triangulate(
    face: usize,
    polygon: &[u32],
    positions: &[DVec3],
) -> Result<Vec<[u32; 3]>, FoldError> {
    let corner =
        |i: usize| positions[polygon[i % polygon.len()] as usize] - positions[polygon[0] as usize];
    let area: DVec3 = (0..polygon.len()).map(|i| corner(i).cross(corner(i + 1))).sum();
    let size = (0..polygon.len()).map(|i| corner(i).length()).fold(0.0, f64::max);
    let limit = AREA_LIMIT * size * size;
    let length = area.length();
    if length.is_nan() || length <= limit {
        return Err(FoldError::ZeroArea { face, area: length, limit });
    }
    if let &[a, b, c] = polygon {
        return Ok(vec![[a, b, c]]);
    }
    let (x, y) = (area / length).any_orthonormal_pair();
    let plane: Vec<DVec2> =
        (0..polygon.len()).map(|i| DVec2::new(corner(i).dot(x), corner(i).dot(y))).collect();
    let outline = Outline { plane, limit };
    let triangles = outline.triangles().ok_or(FoldError::NotSimple { face })?;
    Ok(triangles.into_iter().map(|t| t.map(|i| polygon[i])).collect())
}

/// A polygon in its plane, counter-clockwise.
struct Outline {
    plane: Vec<DVec2>,
    /// Twice the area a triangle must exceed.
    limit: f64,
}

impl Outline {
    /// Whether twice the area of a triangle exceeds the limit.
    fn has_area(&self, [a, b, c]: [usize; 3]) -> bool {
        let [a, b, c] = [a, b, c].map(|corner| self.plane[corner]);
        (b - a).perp_dot(c - a) > self.limit
    }

    /// Whether every corner turns left and the outline winds once.
    fn is_convex(&self) -> bool {
        let n = self.plane.len();
        (0..n).all(|i| self.has_area([i, (i + 1) % n, (i + 2) % n]))
            && (1..n - 1).all(|i| self.has_area([0, i, i + 1]))
    }

    /// A fan from the first corner if the outline is strictly convex, otherwise the Delaunay triangulation.
    fn triangles(&self) -> Option<Vec<[usize; 3]>> {
        let n = self.plane.len();
        if self.is_convex() {
            return Some((1..n - 1).map(|i| [0, i, i + 1]).collect());
        }
        let corners = vec![(0..n as u32).collect()];
        let triangles = delaunay(&corners, &self.plane)?.into_iter();
        let triangles: Vec<_> = triangles.map(|t| t.map(|corner| corner as usize)).collect();
        let covers_all = triangles.len() == n - 2 && triangles.iter().all(|&t| self.has_area(t));
        covers_all.then_some(triangles)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(points: &[DVec3], t: &[u32; 3]) -> f64 {
        let [a, b, c] = t.map(|v| points[v as usize]);
        (b - a).cross(c - a).z / 2.0
    }

    fn outline(points: &[(f64, f64)]) -> (Vec<u32>, Vec<DVec3>) {
        let polygon = (0..points.len() as u32).collect();
        (polygon, points.iter().map(|&(x, y)| DVec3::new(x, y, 0.0)).collect())
    }

    #[test]
    fn triangles_cover_the_polygon_once_and_turn_as_it_does() {
        let cases: [(&[(f64, f64)], f64); 5] = [
            (&[(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)], 2.0),
            // An L, whose fan from the first corner would leave it.
            (&[(1.0, 1.0), (1.0, 2.0), (0.0, 2.0), (0.0, 0.0), (2.0, 0.0), (2.0, 1.0)], 3.0),
            // A corner on a straight side.
            (&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (0.0, 2.0)], 2.0),
            // A dart.
            (&[(0.0, 0.0), (2.0, 1.0), (0.0, 2.0), (0.5, 1.0)], 1.5),
            // Clockwise.
            (&[(0.0, 1.0), (2.0, 1.0), (2.0, 0.0), (0.0, 0.0)], -2.0),
        ];
        for (points, expected) in cases {
            let (polygon, points) = outline(points);
            let triangles = triangulate(0, &polygon, &points).unwrap();
            assert_eq!(triangles.len(), polygon.len() - 2);
            let areas: Vec<f64> = triangles.iter().map(|t| area(&points, t)).collect();
            assert!(areas.iter().all(|a| a * expected > 0.0), "{areas:?}");
            assert!((areas.iter().sum::<f64>() - expected).abs() < 1e-12, "{areas:?}");
        }
    }

    #[test]
    fn polygons_without_area_or_crossing_themselves_are_refused_by_number() {
        let (polygon, points) = outline(&[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)]);
        let flat = triangulate(7, &polygon, &points);
        assert!(matches!(flat, Err(FoldError::ZeroArea { face: 7, .. })), "{flat:?}");
        let (polygon, points) = outline(&[(0.0, 0.0), (3.0, 2.0), (3.0, 0.0), (0.0, 1.0)]);
        let crossed = triangulate(3, &polygon, &points);
        assert_eq!(crossed, Err(FoldError::NotSimple { face: 3 }));
    }
}
