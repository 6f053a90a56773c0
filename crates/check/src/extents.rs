//! The box of a state, compared with that of an exact state.

use foldmotion_geometry::{Aabb, RigidMotion};
use glam::{DMat3, DVec3};
use serde::Serialize;

/// The box of a state, after the rigid motion that best fits it to the exact state or along its principal axes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FittedBox {
    /// The extents along x, y and z of the exact state, or along the principal axes in order of decreasing spread.
    pub extents: DVec3,
    /// The area x · z covered by the box.
    pub area: f64,
    /// The volume x · y · z of the box.
    pub volume: f64,
    /// The root mean square distance of the vertices from the exact state; `None` if there is no exact state.
    pub rms_to_exact: Option<f64>,
}

/// Fits `positions` to `exact` by a rotation and a translation (no reflection) and measures the box.
///
/// Precondition: both have the same length. Without positions, all values are 0.
pub fn fitted_box(positions: &[DVec3], exact: &[DVec3]) -> FittedBox {
    let fit = RigidMotion::best_fit(positions, exact);
    let fitted = || positions.iter().map(|&p| fit.apply(p));
    let squared: f64 = fitted().zip(exact).map(|(p, &q)| p.distance_squared(q)).sum();
    let rms = (squared / positions.len().max(1) as f64).sqrt();
    measured(Aabb::around(fitted()), Some(rms))
}

/// Measures the box along the coordinate axes, without moving the state.
pub fn upright_box(positions: &[DVec3]) -> FittedBox {
    measured(Aabb::around(positions.iter().copied()), None)
}

fn measured(bounds: Aabb, rms_to_exact: Option<f64>) -> FittedBox {
    let extents = bounds.extents().max(DVec3::ZERO);
    FittedBox {
        extents,
        area: extents.x * extents.z,
        volume: extents.x * extents.y * extents.z,
        rms_to_exact,
    }
}

/// Measures the box of a sheet along its principal axes, those of the second moments of its area.
///
/// `faces`: the triangles of the sheet. Precondition: their corners are indices into `positions`. If the sheet has no
/// area, the axes are x, y and z.
pub fn principal_box(positions: &[DVec3], faces: &[[u32; 3]]) -> FittedBox {
    let corners = || faces.iter().map(|face| face.map(|v| positions[v as usize]));
    let area = |[a, b, c]: [DVec3; 3]| 0.5 * (b - a).cross(c - a).length();
    let total: f64 = corners().map(area).sum();
    if total <= 0.0 {
        return measured(Aabb::around(positions.iter().copied()), None);
    }
    let middle = |t: [DVec3; 3]| (t[0] + t[1] + t[2]) / 3.0;
    let centre = corners().map(|t| middle(t) * area(t)).sum::<DVec3>() / total;
    let square = |p: DVec3| DMat3::from_cols(p * p.x, p * p.y, p * p.z);
    // ∫ p pᵀ over a triangle with middle m is its area times (a aᵀ + b bᵀ + c cᵀ + 9 m mᵀ) / 12.
    let moments = corners().fold(DMat3::ZERO, |sum, t| {
        let [a, b, c] = t.map(|p| square(p - centre));
        sum + (a + b + c + square(middle(t) - centre) * 9.0) * (area(t) / 12.0)
    });
    let motion = RigidMotion::to_principal_axes(centre, moments);
    measured(Aabb::around(positions.iter().map(|&p| motion.apply(p))), None)
}

/// How far a measured box is from its closed form.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct RelativeError {
    /// The relative error of each extent.
    pub extents: DVec3,
    /// The relative error of the area x · z.
    pub area: f64,
    /// The relative error of the volume x · y · z.
    pub volume: f64,
}

/// (measured − closed form), each divided by the closed form or, if that is 0, by h, h² or h³.
///
/// `extents`: those of the closed form; its area and volume follow from them. `unit_length`: h.
pub fn relative_error(measured: &FittedBox, extents: DVec3, unit_length: f64) -> RelativeError {
    let relative = |value: f64, exact: f64, unit: f64| {
        (value - exact) / if exact == 0.0 { unit } else { exact }
    };
    let of_extent = |i: usize| relative(measured.extents[i], extents[i], unit_length);
    RelativeError {
        extents: DVec3::new(of_extent(0), of_extent(1), of_extent(2)),
        area: relative(measured.area, extents.x * extents.z, unit_length.powi(2)),
        volume: relative(measured.volume, extents.x * extents.y * extents.z, unit_length.powi(3)),
    }
}

#[cfg(test)]
mod tests {
    use glam::DQuat;

    use super::*;

    fn brick() -> Vec<DVec3> {
        (0..8)
            .map(|i| {
                DVec3::new(
                    f64::from(i & 1) * 3.0,
                    f64::from(i >> 1 & 1) * 2.0,
                    f64::from(i >> 2) * 0.5,
                )
            })
            .collect()
    }

    #[test]
    fn the_box_does_not_depend_on_where_the_state_lies() {
        let turn = DQuat::from_axis_angle(DVec3::new(1.0, -2.0, 0.4).normalize(), 2.1);
        let moved: Vec<_> =
            brick().into_iter().map(|p| turn * p + DVec3::new(5.0, 1.0, -9.0)).collect();
        let measured = fitted_box(&moved, &brick());
        assert!(measured.extents.distance(DVec3::new(3.0, 2.0, 0.5)) < 1e-12);
        assert!((measured.area - 1.5).abs() < 1e-12 && (measured.volume - 3.0).abs() < 1e-12);
        assert!(measured.rms_to_exact.unwrap() < 1e-12);
        let error = relative_error(&measured, DVec3::new(3.0, 2.0, 0.5), 1.0);
        assert!(error.extents.length() + error.area.abs() + error.volume.abs() < 1e-11);
    }

    #[test]
    fn a_rectangle_has_its_sides_as_principal_extents_however_it_is_cut_and_turned() {
        let turn = DQuat::from_axis_angle(DVec3::new(1.0, -2.0, 0.4).normalize(), 2.1);
        let at = |x: f64, y: f64| turn * DVec3::new(x, y, 0.0) + DVec3::new(5.0, 1.0, -9.0);
        let positions = [at(0.0, 0.0), at(2.0, 0.0), at(2.0, 5.0), at(0.0, 5.0), at(0.1, 0.7)];
        let halves = [[0, 1, 2], [0, 2, 3]];
        let fan = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
        for FittedBox { extents, .. } in
            [principal_box(&positions, &halves), principal_box(&positions, &fan)]
        {
            assert!(extents.distance(DVec3::new(5.0, 2.0, 0.0)) < 1e-12, "{extents}");
        }
        assert_eq!(principal_box(&[], &[]).extents, DVec3::ZERO);
    }

    #[test]
    fn an_extent_whose_closed_form_is_zero_is_measured_in_units_of_h() {
        let measured = FittedBox {
            extents: DVec3::new(4.0, 0.2, 1.1),
            area: 4.4,
            volume: 0.88,
            rms_to_exact: None,
        };
        let error = relative_error(&measured, DVec3::new(4.0, 0.0, 1.0), 2.0);
        assert_eq!(error.extents.y, 0.1);
        assert!((error.extents.z - 0.1).abs() < 1e-15 && (error.area - 0.1).abs() < 1e-15);
        assert_eq!(error.volume, 0.11);
    }

    #[test]
    fn a_state_that_is_not_the_exact_one_has_a_distance_to_it() {
        let mut bent = brick();
        bent[7].z += 0.3;
        assert!(fitted_box(&bent, &brick()).rms_to_exact.unwrap() > 0.05);
    }
}
