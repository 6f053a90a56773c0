//! The projection of a view: from space to the screen and back, and its coefficients for the shader.

use glam::{DVec2, DVec3};

use super::OrbitCamera;

/// A sphere around everything that is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sphere {
    pub(super) middle: DVec3,
    pub(super) radius: f64,
}

impl Sphere {
    /// The sphere around the bounding box of `points`; the unit sphere if there are none.
    pub(super) fn around(points: impl IntoIterator<Item = DVec3>) -> Self {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for point in points {
            low = low.min(point);
            high = high.max(point);
        }
        let (middle, radius) = (0.5 * (low + high), 0.5 * (high - low).length());
        if middle.is_finite() && radius.is_finite() {
            return Self { middle, radius };
        }
        Self { middle: DVec3::ZERO, radius: 1.0 }
    }

    /// A sphere with the same centre that contains `points` too.
    pub(super) fn with(self, points: impl IntoIterator<Item = DVec3>) -> Self {
        let distances = points.into_iter().map(|p| (p - self.middle).length());
        let radius = distances.filter(|d| d.is_finite()).fold(self.radius, f64::max);
        Self { radius, ..self }
    }
}

/// The projection of a view of a given size.
///
/// A point at depth d from the centre towards the viewer is divided by w = 1 − d / D, where D is the distance of the
/// eye (1 / D = 0 in a parallel projection). Its nearness d / w is linear over every plane on the screen and grows with
/// d.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Projection {
    axes: [DVec3; 3],
    centre: DVec3,
    /// Points on the screen per unit of length, at the depth of the centre.
    scale: f64,
    size: DVec2,
    /// 1 / D, zero in a parallel projection.
    inverse_distance: f64,
    sphere: Sphere,
}

impl Projection {
    /// `size` is the size of the view in points.
    pub(super) fn new(orbit: &OrbitCamera, size: DVec2, sphere: Sphere) -> Self {
        let distance = orbit.eye_distance(sphere.middle, sphere.radius);
        Self {
            axes: orbit.axes(),
            centre: orbit.centre,
            scale: size.x / orbit.width,
            size,
            inverse_distance: if orbit.perspective { 1.0 / distance } else { 0.0 },
            sphere,
        }
    }

    /// The position on the screen, in points right and down from the upper left corner, and the nearness.
    pub(super) fn project(&self, point: DVec3) -> DVec3 {
        let [x, y, depth] = self.axes.map(|axis| axis.dot(point - self.centre));
        let w = 1.0 - depth * self.inverse_distance;
        let (x, y) = (self.scale * x / w, self.scale * y / w);
        DVec3::new(0.5 * self.size.x + x, 0.5 * self.size.y - y, depth / w)
    }

    /// The point at screen position `at` in the plane through `point` parallel to the screen.
    pub(super) fn beside(&self, point: DVec3, at: DVec2) -> DVec3 {
        let [right, up, toward] = self.axes;
        let depth = toward.dot(point - self.centre);
        let across = (at - 0.5 * self.size) * (1.0 - depth * self.inverse_distance) / self.scale;
        self.centre + right * across.x - up * across.y + toward * depth
    }

    /// Unit vectors to the right, up and towards the viewer.
    pub(super) fn axes(&self) -> [DVec3; 3] {
        self.axes
    }

    /// The first four rows of the shader's `View`, for positions relative to `origin`.
    pub(super) fn rows(&self, origin: DVec3) -> [[f32; 4]; 4] {
        let row = |axis: DVec3| {
            let [x, y, z] = axis.as_vec3().to_array();
            [x, y, z, axis.dot(origin - self.centre) as f32]
        };
        let [right, up, toward] = self.axes.map(row);
        let across = 2.0 * self.scale / self.size;
        let middle = self.axes[2].dot(self.sphere.middle - self.centre);
        // A tenth more than the sphere, for layers and lines.
        let ends = [-1.1, 1.1].map(|side| {
            let depth = middle + side * self.sphere.radius;
            (depth / (1.0 - depth * self.inverse_distance)).abs()
        });
        let range = 0.5 / ends[0].max(ends[1]).max(f64::MIN_POSITIVE);
        let scale = [across.x, across.y, range, self.inverse_distance].map(|x| x as f32);
        [right, up, toward, scale]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn projection(perspective: bool) -> Projection {
        let orbit = OrbitCamera {
            centre: DVec3::new(1.0, 2.0, 3.0),
            width: 8.0,
            perspective,
            ..OrbitCamera::default()
        };
        Projection::new(
            &orbit,
            DVec2::new(400.0, 300.0),
            Sphere::around([DVec3::ZERO, DVec3::ONE * 5.0]),
        )
    }

    #[test]
    fn a_parallel_projection_is_that_of_the_camera_of_films() {
        let orbit =
            OrbitCamera { centre: DVec3::new(1.0, 2.0, 3.0), width: 8.0, ..OrbitCamera::default() };
        let camera = orbit.camera([400, 300]).unwrap();
        for point in [DVec3::ZERO, DVec3::X, DVec3::new(-2.0, 5.0, 1.0)] {
            let apart = (camera.project(point) - projection(false).project(point)).truncate();
            assert!(apart.length() < 1e-9);
        }
    }

    #[test]
    fn a_point_found_on_the_screen_has_the_given_depth_and_projects_back() {
        for perspective in [false, true] {
            let projection = projection(perspective);
            let (point, at) = (DVec3::new(2.0, 1.0, 4.0), DVec2::new(33.0, 250.0));
            let beside = projection.beside(point, at);
            assert!((projection.project(beside).truncate() - at).length() < 1e-9);
            assert!((projection.axes()[2].dot(beside - point)).abs() < 1e-12);
        }
    }

    #[test]
    fn the_eye_in_perspective_stays_outside_the_sheet_at_any_zoom() {
        for width in [1e-3, 1.0, 50.0] {
            let orbit = OrbitCamera {
                centre: DVec3::splat(2.5),
                width,
                perspective: true,
                ..OrbitCamera::default()
            };
            let sphere = Sphere::around([DVec3::ZERO, DVec3::ONE * 5.0]);
            let projection = Projection::new(&orbit, DVec2::ONE, sphere);
            let nearest = sphere.middle + projection.axes()[2] * sphere.radius;
            let behind = projection.project(sphere.middle - projection.axes()[2]);
            assert!(projection.project(nearest).z > projection.project(sphere.middle).z, "{width}");
            assert!(behind.z < projection.project(sphere.middle).z);
        }
    }
}
