//! The fold angle between two triangles that share an edge, and its gradient.
//!
//! A hinge has four points: the ends `e0`, `e1` of the shared edge, the apex `left` of the triangle on the left of e0 →
//! e1 seen from the front, and the apex `right` of the other. With e = e1 − e0, the front normals are n_l = e × (left −
//! e0) and n_r = (right − e0) × e, and
//!
//! θ = atan2((n_r × n_l)·e / |e|, n_l·n_r)
//!
//! so θ > 0 (valley) if the facets rise on their front sides.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

/// The fold angle in radians, in (−π, π].
///
/// Precondition: neither triangle is degenerate; a degenerate one gives 0.
pub fn fold_angle(e0: DVec3, e1: DVec3, left: DVec3, right: DVec3) -> f64 {
    let e = e1 - e0;
    let n_left = e.cross(left - e0);
    let n_right = (right - e0).cross(e);
    let length = e.length();
    let sine = n_right.cross(n_left).dot(e);
    f64::atan2(sine, n_left.dot(n_right) * length)
}

/// The gradient of [`fold_angle`] with respect to (e0, e1, left, right).
///
/// ∂θ/∂left = n̂_l / h_l and ∂θ/∂right = n̂_r / h_r with the apex heights h above the edge; the parts of e0 and e1
/// follow from invariance under translation and rotation (Schenk and Guest 2011; Bridson et al. 2003). Precondition:
/// both triangles have positive area.
pub fn fold_angle_gradient(e0: DVec3, e1: DVec3, left: DVec3, right: DVec3) -> [DVec3; 4] {
    let e = e1 - e0;
    let length_squared = e.length_squared();
    let length = length_squared.sqrt();
    let to_left = left - e0;
    let to_right = right - e0;
    let n_left = e.cross(to_left);
    let n_right = to_right.cross(e);
    // n̂ / h with h = |n| / |e|.
    let grad_left = n_left * (length / n_left.length_squared());
    let grad_right = n_right * (length / n_right.length_squared());
    let s_left = to_left.dot(e) / length_squared;
    let s_right = to_right.dot(e) / length_squared;
    [
        -(grad_left * (1.0 - s_left) + grad_right * (1.0 - s_right)),
        -(grad_left * s_left + grad_right * s_right),
        grad_left,
        grad_right,
    ]
}

/// The angle equal to `angle` modulo 2π that is nearest to `previous`: it follows a fold past ±π.
///
/// Precondition: the true angle has changed by less than π since `previous`.
pub fn nearest_turn(angle: f64, previous: f64) -> f64 {
    let turns = ((previous - angle) / TAU).round();
    let unwrapped = angle + turns * TAU;
    debug_assert!((unwrapped - previous).abs() <= PI + 1e-9, "one turn brings the angle within π");
    unwrapped
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hinge(theta: f64) -> [DVec3; 4] {
        [
            DVec3::new(0.1, 0.0, 0.0),
            DVec3::new(1.3, 0.0, 0.0),
            DVec3::new(0.4, 0.8 * theta.cos(), 0.8 * theta.sin()),
            DVec3::new(0.9, -0.5, 0.0),
        ]
    }

    #[test]
    fn the_fold_angle_is_the_angle_the_hinge_was_built_with() {
        for k in -17..=18 {
            let theta = f64::from(k) * PI / 18.0;
            let [a, b, c, d] = hinge(theta);
            let error = (fold_angle(a, b, c, d) - theta).abs();
            assert!(error < 1e-14, "{theta}: error {error}");
        }
    }

    #[test]
    fn the_gradient_agrees_with_central_differences_at_every_angle() {
        for k in -17..=17 {
            let points = hinge(f64::from(k) * PI / 18.0 + 0.01);
            let gradient = fold_angle_gradient(points[0], points[1], points[2], points[3]);
            for node in 0..4 {
                for axis in 0..3 {
                    let step = 1e-6;
                    let shifted = |sign: f64| {
                        let mut p = points;
                        p[node][axis] += sign * step;
                        fold_angle(p[0], p[1], p[2], p[3])
                    };
                    let centre = fold_angle(points[0], points[1], points[2], points[3]);
                    let difference = (nearest_turn(shifted(1.0), centre)
                        - nearest_turn(shifted(-1.0), centre))
                        / (2.0 * step);
                    assert!(
                        (difference - gradient[node][axis]).abs() < 1e-8,
                        "node {node} axis {axis}: {difference} != {}",
                        gradient[node][axis]
                    );
                }
            }
        }
    }

    #[test]
    fn the_nearest_turn_follows_a_fold_past_half_a_turn() {
        assert!((nearest_turn(-3.1, 3.1) - (TAU - 3.1)).abs() < 1e-15);
        assert!((nearest_turn(3.1, -3.1) + (TAU - 3.1)).abs() < 1e-15);
        assert_eq!(nearest_turn(0.2, 0.1), 0.2);
    }
}
