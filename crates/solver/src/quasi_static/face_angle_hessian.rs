//! The second derivative of the angle at a corner of a triangle.
//!
//! The angle depends on its three points through u = b − a and v = c − a alone. With n the unit normal along u × v, the
//! in-plane directions û, p = n × û, v̂, q = n × v̂, and α itself,
//!
//! ∂²α/∂u² = (cot α n nᵀ + û pᵀ + p ûᵀ) / |u|²,
//! ∂²α/∂v² = (cot α n nᵀ − v̂ qᵀ − q v̂ᵀ) / |v|²,
//! ∂²α/∂u∂v = −n nᵀ / |u × v|.
//!
//! In the plane α is the difference of the directions of v and of u, so nothing mixes them; out of it, raising both
//! ends in proportion turns the triangle and leaves α as it is.

use glam::{DMat3, DVec3};

use super::hinge_hessian::outer;

/// The second derivative of the angle at `a` between `b` and `c` in (a, b, c), as 3 × 3 blocks.
///
/// 0 for a triangle without area, like its gradient.
pub(super) fn face_angle_hessian(a: DVec3, b: DVec3, c: DVec3) -> [[DMat3; 3]; 3] {
    let (u, v) = (b - a, c - a);
    let area = u.cross(v).length();
    if area == 0.0 {
        return [[DMat3::ZERO; 3]; 3];
    }
    let normal = u.cross(v) / area;
    let across = outer(normal, normal);
    let cotangent = across * (u.dot(v) / area);
    let own = |side: DVec3, sign: f64| {
        // |side|² times û pᵀ.
        let turning = outer(side, normal.cross(side)) * (sign / side.length_squared());
        (cotangent + turning + turning.transpose()) * (1.0 / side.length_squared())
    };
    let (by_u, by_v) = (own(u, 1.0), own(v, -1.0));
    let mixed = across * (-1.0 / area);
    // u and v fall with a as they rise with b and c.
    [
        [by_u + by_v + mixed * 2.0, -(by_u + mixed), -(by_v + mixed)],
        [-(by_u + mixed), by_u, mixed],
        [-(by_v + mixed), mixed, by_v],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::face_angle::{face_angle, face_angle_gradient};

    /// Acute, right, obtuse and flat corners, none in a coordinate plane.
    fn corners() -> [[DVec3; 3]; 4] {
        [0.4_f64, std::f64::consts::FRAC_PI_2, 2.3, 3.1].map(|angle| {
            let (x, y) = (DVec3::new(2.0, -1.0, 2.0) / 3.0, DVec3::new(2.0, 2.0, -1.0) / 3.0);
            let a = DVec3::new(0.3, -0.2, 0.5);
            [a, a + x * 1.3, a + (x * angle.cos() + y * angle.sin()) * 0.7]
        })
    }

    /// The derivative of `of` in one coordinate of one point.
    fn difference<T: std::ops::Sub<Output = T> + std::ops::Mul<f64, Output = T>>(
        points: [DVec3; 3],
        node: usize,
        axis: usize,
        of: impl Fn([DVec3; 3]) -> T,
    ) -> T {
        let step = 1e-6;
        let shifted = |by: f64| {
            let mut p = points;
            p[node][axis] += by;
            of(p)
        };
        (shifted(step) - shifted(-step)) * (0.5 / step)
    }

    /// The nine coordinates, by point and axis.
    fn coordinates() -> impl Iterator<Item = (usize, usize)> {
        (0..3).flat_map(|node| (0..3).map(move |axis| (node, axis)))
    }

    #[test]
    fn the_gradient_agrees_with_differences_of_the_angle() {
        for points in corners() {
            let [a, b, c] = points;
            let gradient = face_angle_gradient(a, b, c);
            for (node, axis) in coordinates() {
                let expected = difference(points, node, axis, |[a, b, c]| face_angle(a, b, c));
                let error = (gradient[node][axis] - expected).abs();
                assert!(error < 1e-8, "{points:?} {node} {axis}: {error}");
            }
        }
    }

    #[test]
    fn the_hessian_agrees_with_differences_of_the_gradient() {
        for points in corners() {
            let [a, b, c] = points;
            for (row, blocks) in face_angle_hessian(a, b, c).iter().enumerate() {
                let slope = |[a, b, c]: [DVec3; 3]| face_angle_gradient(a, b, c)[row];
                for (node, axis) in coordinates() {
                    let expected = difference(points, node, axis, slope);
                    let error = (blocks[node].col(axis) - expected).length();
                    assert!(error < 1e-6, "{points:?} {row} {node} {axis}: {error}");
                }
            }
        }
    }

    #[test]
    fn a_triangle_without_area_has_none() {
        let [a, b] = [DVec3::ZERO, DVec3::X];
        assert_eq!(face_angle_hessian(a, b, b * 2.0), [[DMat3::ZERO; 3]; 3]);
    }
}
