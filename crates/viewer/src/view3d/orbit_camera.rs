//! The camera that the user moves around the sheet.

use foldmotion_record::View;
#[cfg(test)]
use foldmotion_record::{Camera, RecordError};
use glam::{DVec2, DVec3};

/// Duration of a transition to another view, seconds.
const TRANSITION_SECONDS: f64 = 0.15;

/// The fraction of the view left free on each side of fitted points, as in films.
const MARGIN: f64 = 0.05;

/// Distance of the eye in perspective, in widths of the view: about that of a 50 mm lens.
const EYE_DISTANCE: f64 = 1.4;

/// Direction, centre and width of the view.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct OrbitCamera {
    /// Azimuth in degrees, as in [`View::Around`].
    pub(crate) azimuth: f64,
    /// Elevation in degrees, as in [`View::Around`].
    pub(crate) elevation: f64,
    /// The point in the centre of the view.
    pub(crate) centre: DVec3,
    /// The length that the view shows across its width, at the depth of the centre.
    pub(crate) width: f64,
    /// Whether the projection is a perspective; otherwise it is parallel, as in films.
    pub(crate) perspective: bool,
}

impl Default for OrbitCamera {
    fn default() -> Self {
        let [azimuth, elevation] = direction(View::Iso);
        Self { azimuth, elevation, centre: DVec3::ZERO, width: 1.0, perspective: false }
    }
}

/// Azimuth and elevation of `view`, in degrees.
fn direction(view: View) -> [f64; 2] {
    match view {
        View::Front => [-90.0, 0.0],
        View::Side => [0.0, 0.0],
        View::Top => [-90.0, 90.0],
        View::Around { azimuth, elevation } => [azimuth, elevation],
        // The direction of the isometric view of films.
        View::Iso => [
            f64::atan2(-0.74, 0.42).to_degrees(),
            f64::atan2(0.53, f64::hypot(0.42, 0.74)).to_degrees(),
        ],
    }
}

impl OrbitCamera {
    /// The same direction for films and figures.
    pub(crate) fn view(&self) -> View {
        View::Around { azimuth: self.azimuth, elevation: self.elevation }
    }

    /// Unit vectors to the right, up and towards the viewer.
    pub(crate) fn axes(&self) -> [DVec3; 3] {
        let (sin, cos) = self.azimuth.to_radians().sin_cos();
        let (rise, across) = self.elevation.to_radians().sin_cos();
        let toward = DVec3::new(across * cos, across * sin, rise);
        let right = DVec3::new(-sin, cos, 0.0);
        [right, toward.cross(right), toward]
    }

    /// The camera of a film of `size` pixels that shows the same as this one, without its perspective.
    ///
    /// # Errors
    /// Those of [`Camera::centred`].
    #[cfg(test)]
    pub(super) fn camera(&self, size: [u32; 2]) -> Result<Camera, RecordError> {
        let middle = self.view().extent([self.centre]);
        Camera::centred(self.view(), middle, size, f64::from(size[0]) / self.width)
    }

    /// Looks from the direction of `view`; `pivot` stays where it is on the screen.
    pub(crate) fn set_view(&mut self, view: View, pivot: DVec3) {
        self.look_from(direction(view), pivot);
    }

    /// Turns by degrees; `pivot` stays where it is on the screen.
    pub(crate) fn turn(&mut self, azimuth: f64, elevation: f64, pivot: DVec3) {
        let azimuth = (self.azimuth + azimuth + 180.0).rem_euclid(360.0) - 180.0;
        let elevation = (self.elevation + elevation).clamp(-90.0, 90.0);
        self.look_from([azimuth, elevation], pivot);
    }

    fn look_from(&mut self, [azimuth, elevation]: [f64; 2], pivot: DVec3) {
        let aside = self.axes().map(|axis| axis.dot(self.centre - pivot));
        [self.azimuth, self.elevation] = [azimuth, elevation];
        let axes = self.axes();
        self.centre = pivot + (0..3).map(|i| axes[i] * aside[i]).sum::<DVec3>();
    }

    /// Moves the contents of the view by `by`, lengths to the right and up.
    pub(crate) fn pan(&mut self, by: DVec2) {
        let [right, up, _] = self.axes();
        self.centre -= right * by.x + up * by.y;
    }

    /// Enlarges the view by `factor`; the point at `at`, lengths right and up of the centre, stays where it is on the
    /// screen.
    pub(crate) fn zoom(&mut self, factor: f64, at: DVec2, limits: [f64; 2]) {
        let width = (self.width / factor).clamp(limits[0], limits[1]);
        self.pan(-at * (1.0 - width / self.width));
        self.width = width;
    }

    /// Shows all `points` as large as possible in a view of `size`. Without points, or if one is not finite, nothing
    /// changes.
    pub(crate) fn fit(&mut self, points: impl IntoIterator<Item = DVec3> + Clone, size: DVec2) {
        let [right, up, toward] = self.axes();
        let [low, high] = self.view().extent(points.clone());
        let (mut near, mut far) = (f64::NEG_INFINITY, f64::INFINITY);
        for point in points {
            near = near.max(toward.dot(point));
            far = far.min(toward.dot(point));
        }
        let middle = 0.5 * (low + high);
        let needed = (high - low) / (size * (1.0 - 2.0 * MARGIN));
        let width = needed.max_element() * size.x;
        if !(width.is_finite() && middle.is_finite()) {
            return;
        }
        let depth = 0.5 * (near + far);
        self.centre = right * middle.x + up * middle.y + toward * depth;
        if width > 0.0 {
            // Near points look larger in perspective.
            let bulge = if self.perspective { 0.5 * (near - far) / EYE_DISTANCE } else { 0.0 };
            self.width = width + bulge;
        }
    }

    /// The distance of the eye from the centre in perspective, always outside the sphere around `middle`.
    pub(crate) fn eye_distance(&self, middle: DVec3, radius: f64) -> f64 {
        let [_, _, toward] = self.axes();
        let ahead = toward.dot(middle - self.centre);
        (EYE_DISTANCE * self.width).max(ahead + 1.5 * radius)
    }

    /// The camera at `part` of the transition to `to`, turning the shorter way round.
    fn between(&self, to: &Self, part: f64) -> Self {
        let mix = |a: f64, b: f64| a + (b - a) * part;
        let around = (to.azimuth - self.azimuth + 180.0).rem_euclid(360.0) - 180.0;
        Self {
            azimuth: self.azimuth + around * part,
            elevation: mix(self.elevation, to.elevation),
            centre: self.centre.lerp(to.centre, part),
            width: self.width * (to.width / self.width).powf(part),
            perspective: to.perspective,
        }
    }
}

/// A short transition from one camera to another.
#[derive(Debug, Clone, Copy)]
pub(super) struct CameraTransition {
    from: OrbitCamera,
    to: OrbitCamera,
    passed: f64,
}

impl CameraTransition {
    pub(super) fn new(from: OrbitCamera, to: OrbitCamera) -> Self {
        Self { from, to, passed: 0.0 }
    }

    /// The camera at the end of the transition.
    pub(super) fn end(&self) -> OrbitCamera {
        self.to
    }

    /// The camera `seconds` later, and whether the transition has ended.
    pub(super) fn step(&mut self, seconds: f64) -> (OrbitCamera, bool) {
        self.passed += seconds;
        let part = (self.passed / TRANSITION_SECONDS).clamp(0.0, 1.0);
        if part >= 1.0 {
            return (self.to, true);
        }
        let eased = part * part * (3.0 - 2.0 * part);
        (self.from.between(&self.to, eased), false)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const POINTS: [DVec3; 4] = [
        DVec3::new(0.0, 0.0, 0.0),
        DVec3::new(3.0, 1.0, 0.5),
        DVec3::new(1.0, -2.0, 2.0),
        DVec3::new(-1.0, 4.0, -3.0),
    ];

    #[test]
    fn standard_views_put_every_point_on_the_same_pixel_as_films() {
        let size = [640, 400];
        for (name, view) in View::NAMES {
            let film = Camera::fit(view, POINTS, size, MARGIN).unwrap();
            let mut orbit = OrbitCamera::default();
            orbit.set_view(view, DVec3::ZERO);
            orbit.fit(POINTS, DVec2::new(640.0, 400.0));
            let camera = orbit.camera(size).unwrap();
            for point in POINTS {
                let apart = (film.project(point) - camera.project(point)).truncate();
                assert!(apart.length() < 1e-9, "{name}: {apart}");
            }
        }
    }

    #[test]
    fn a_turn_keeps_its_pivot_and_a_zoom_what_is_under_the_pointer() {
        let size = [500, 300];
        let at = |orbit: &OrbitCamera, point| orbit.camera(size).unwrap().project(point).truncate();
        let mut orbit = OrbitCamera::default();
        orbit.fit(POINTS, DVec2::new(500.0, 300.0));
        let before = at(&orbit, POINTS[1]);
        orbit.turn(67.0, -20.0, POINTS[1]);
        assert!((at(&orbit, POINTS[1]) - before).length() < 1e-9);
        let place = at(&orbit, POINTS[2]);
        let lengths = (place - DVec2::new(250.0, 150.0)) * orbit.width / 500.0;
        let width = orbit.width;
        orbit.zoom(3.0, DVec2::new(lengths.x, -lengths.y), [1e-3, 1e3]);
        assert!((at(&orbit, POINTS[2]) - place).length() < 1e-9);
        assert!((orbit.width * 3.0 - width).abs() < 1e-12);
        orbit.turn(0.0, 500.0, DVec3::ZERO);
        assert!(orbit.elevation == 90.0);
    }

    #[test]
    fn a_transition_turns_the_shorter_way_round_and_ends() {
        let from = OrbitCamera { azimuth: 170.0, ..OrbitCamera::default() };
        let to = OrbitCamera { azimuth: -170.0, ..from };
        let mut transition = CameraTransition::new(from, to);
        let (half, arrived) = transition.step(0.5 * TRANSITION_SECONDS);
        assert!((half.azimuth - 180.0).abs() < 1e-9 && !arrived);
        assert_eq!(transition.step(1.0), (to, true));
    }

    #[test]
    fn nothing_to_fit_changes_nothing() {
        let mut orbit = OrbitCamera::default();
        orbit.fit([], DVec2::new(5.0, 3.0));
        orbit.fit([DVec3::NAN], DVec2::new(5.0, 3.0));
        assert_eq!(orbit, OrbitCamera::default());
    }
}
