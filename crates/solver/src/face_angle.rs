//! The angle at a corner of a triangle, and its gradient.

use glam::DVec3;

/// The angle at `a` between `b` and `c`, in [0, π].
///
/// Precondition: neither side has length 0.
pub(crate) fn face_angle(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    let (u, v) = (b - a, c - a);
    f64::atan2(u.cross(v).length(), u.dot(v))
}

/// The gradient of [`face_angle`] with respect to (a, b, c).
///
/// With n the unit normal along (b − a) × (c − a): ∂α/∂b = −n × (b − a) / |b − a|²,
/// ∂α/∂c = n × (c − a) / |c − a|², and ∂α/∂a balances them. 0 for a triangle without area.
pub(crate) fn face_angle_gradient(a: DVec3, b: DVec3, c: DVec3) -> [DVec3; 3] {
    let (u, v) = (b - a, c - a);
    let normal = u.cross(v).normalize_or_zero();
    let grad_b = u.cross(normal) / u.length_squared();
    let grad_c = normal.cross(v) / v.length_squared();
    [-(grad_b + grad_c), grad_b, grad_c]
}
