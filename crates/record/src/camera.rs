//! The camera: a parallel projection, because papers compare states at equal scale.

use glam::{DQuat, DVec2, DVec3};

use crate::RecordError;
use crate::image::check_size;

/// The direction from which the sheet is seen, in the frame of the motion: growing direction along x, width along y, z
/// up.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum View {
    /// From above, the front and the right, turned a little so that diagonals of square units stay apart.
    #[default]
    Iso,
    /// Along +y: the profile, x to the right and z up.
    Front,
    /// Along −x: y to the right and z up.
    Side,
    /// Along −z: x to the right and y up.
    Top,
    /// From anywhere around, in degrees.
    Around {
        /// Counter-clockwise seen from above, from +x to the viewer: −90 is [`View::Front`], 0 [`View::Side`].
        azimuth: f64,
        /// Above the plane z = 0: 90 is seen from above, with azimuth −90 as [`View::Top`].
        elevation: f64,
    },
}

impl View {
    /// Every view by its name in a scene file.
    pub const NAMES: [(&'static str, Self); 4] =
        [("iso", Self::Iso), ("front", Self::Front), ("side", Self::Side), ("top", Self::Top)];

    /// The view called `name` in a scene file.
    pub fn from_name(name: &str) -> Option<Self> {
        let mut names = Self::NAMES.into_iter();
        names.find(|(n, _)| *n == name).map(|(_, view)| view)
    }

    /// Right, up and towards the viewer, unit vectors.
    pub(crate) fn axes(self) -> [DVec3; 3] {
        let (toward, up) = match self {
            Self::Iso => (DVec3::new(0.42, -0.74, 0.53), DVec3::Z),
            Self::Front => (DVec3::NEG_Y, DVec3::Z),
            Self::Side => (DVec3::X, DVec3::Z),
            Self::Top => (DVec3::Z, DVec3::Y),
            Self::Around { azimuth, elevation } => return around(azimuth, elevation),
        };
        let toward = toward.normalize();
        let right = up.cross(toward).normalize();
        [right, toward.cross(right), toward]
    }

    /// The least and the largest position of `points` across the view, to the right and up, in their unit.
    ///
    /// No points give an infinite, a point that is not finite a NaN extent.
    pub fn extent(self, points: impl IntoIterator<Item = DVec3>) -> [DVec2; 2] {
        let [right, up, _] = self.axes();
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let mut is_finite = true;
        for point in points {
            let across = DVec2::new(right.dot(point), up.dot(point));
            is_finite &= across.is_finite();
            low = low.min(across);
            high = high.max(across);
        }
        if is_finite { [low, high] } else { [DVec2::NAN; 2] }
    }
}

/// The axes of a view from `azimuth` and `elevation` in degrees; right stays level, also straight from above.
fn around(azimuth: f64, elevation: f64) -> [DVec3; 3] {
    let (sin, cos) = azimuth.to_radians().sin_cos();
    let (rise, across) = elevation.to_radians().sin_cos();
    let toward = DVec3::new(across * cos, across * sin, rise);
    let right = DVec3::new(-sin, cos, 0.0);
    [right, toward.cross(right), toward]
}

/// A parallel projection of the world onto the screen.
///
/// The screen is the world turned, scaled alike in all three directions and mirrored to let y run down, so angles and
/// ratios of lengths hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    right: DVec3,
    up: DVec3,
    toward: DVec3,
    scale: f64,
    origin: DVec2,
}

impl Camera {
    /// The camera that shows all `points` as large as they fit, centred.
    ///
    /// `margin`: the part of the picture's sides kept free on each side, 0 ≤ margin < 0.5. Points that all project to
    /// one point are shown at one pixel a unit.
    ///
    /// # Errors
    /// [`RecordError::Size`], [`RecordError::Margin`], and [`RecordError::Extent`] where the points are none, not
    /// finite or too far apart.
    pub fn fit(
        view: View,
        points: impl IntoIterator<Item = DVec3>,
        size: [u32; 2],
        margin: f64,
    ) -> Result<Self, RecordError> {
        if !(0.0..0.5).contains(&margin) {
            return Err(RecordError::Margin { value: margin });
        }
        let [low, high] = view.extent(points);
        let pixels = DVec2::from(size.map(f64::from));
        let room = pixels * (1.0 - 2.0 * margin);
        let fitting = (room / (high - low)).min_element();
        let scale = if high == low { 1.0 } else { fitting };
        Self::centred(view, [low, high], size, scale)
    }

    /// The camera that shows the middle of `extent`, see [`View::extent`], in the middle of the picture, `scale` pixels
    /// a unit: pictures of one scale can be compared.
    ///
    /// # Errors
    /// [`RecordError::Size`], and [`RecordError::Extent`] where extent and scale do not project to finite pixels.
    pub fn centred(
        view: View,
        [low, high]: [DVec2; 2],
        size: [u32; 2],
        scale: f64,
    ) -> Result<Self, RecordError> {
        check_size(size)?;
        let centre = (low + high) * 0.5 * scale;
        if !(scale.is_normal() && scale > 0.0 && centre.is_finite()) {
            let [width, height] = (high - low).to_array();
            return Err(RecordError::Extent { width, height });
        }
        let pixels = DVec2::from(size.map(f64::from));
        let [right, up, toward] = view.axes();
        Ok(Self {
            right,
            up,
            toward,
            scale,
            origin: pixels * 0.5 + DVec2::new(-centre.x, centre.y),
        })
    }

    /// The camera that shows all `points` while it turns about the vertical through `middle`, see [`Self::turned`].
    ///
    /// # Errors
    /// Those of [`Self::fit`].
    pub fn fit_turning(
        view: View,
        points: impl IntoIterator<Item = DVec3>,
        middle: DVec3,
        size: [u32; 2],
        margin: f64,
    ) -> Result<Self, RecordError> {
        let [right, up, _] = view.axes();
        let sides = [right, up].map(|axis| {
            let flat = DVec3::new(axis.x, axis.y, 0.0);
            flat.normalize_or_zero()
        });
        // A point runs along a circle; its ends across the view are these four.
        let ends = |point: DVec3| {
            let radius = (point - middle).truncate().length();
            let foot = DVec3::new(middle.x, middle.y, point.z);
            [-radius, radius].map(|r| sides.map(|side| foot + r * side))
        };
        let points = points.into_iter().flat_map(|p| ends(p).into_iter().flatten());
        Self::fit(view, points, size, margin)
    }

    /// The camera with `centre` in the middle of the picture and the length `width` across it, of a picture of `size`;
    /// where one is none, it stays as it is.
    ///
    /// # Errors
    /// [`RecordError::Extent`] where they do not project to finite pixels.
    pub fn aimed(
        self,
        centre: Option<DVec3>,
        width: Option<f64>,
        size: [u32; 2],
    ) -> Result<Self, RecordError> {
        let pixels = DVec2::from(size.map(f64::from));
        let middle = pixels * 0.5;
        let scale = width.map_or(self.scale, |width| pixels.x / width);
        let across = match centre {
            Some(centre) => DVec2::new(self.right.dot(centre), -self.up.dot(centre)),
            None => (middle - self.origin) / self.scale,
        };
        let origin = middle - scale * across;
        if !(scale.is_normal() && scale > 0.0 && origin.is_finite()) {
            let [width, height] = (pixels / scale).to_array();
            return Err(RecordError::Extent { width, height });
        }
        Ok(Self { scale, origin, ..self })
    }

    /// The camera turned by `degrees`, counter-clockwise seen from above, about the vertical through `middle`, which
    /// stays where it is on the screen.
    #[must_use]
    pub fn turned(&self, degrees: f64, middle: DVec3) -> Self {
        if degrees == 0.0 {
            return *self;
        }
        let turn = DQuat::from_rotation_z(degrees.to_radians());
        let [right, up, toward] = [self.right, self.up, self.toward].map(|axis| turn * axis);
        let moved = |old: DVec3, new: DVec3| self.scale * (old - new).dot(middle);
        Self {
            right,
            up,
            toward,
            scale: self.scale,
            origin: self.origin + DVec2::new(moved(self.right, right), -moved(self.up, up)),
        }
    }

    /// The camera that shows `part` of the sides of a picture of `size`, around `middle`, pixels from its middle.
    ///
    /// Precondition: `part` is above 0.
    pub(crate) fn framed(&self, middle: DVec2, part: f64, size: [u32; 2]) -> Self {
        let centre = DVec2::from(size.map(f64::from)) * 0.5;
        Self {
            scale: self.scale / part,
            origin: centre + (self.origin - centre - middle) / part,
            ..*self
        }
    }

    /// The point on the screen: pixels to the right, pixels down, depth in pixels (larger is nearer to the viewer).
    pub fn project(&self, point: DVec3) -> DVec3 {
        DVec3::new(
            self.origin.x + self.scale * self.right.dot(point),
            self.origin.y - self.scale * self.up.dot(point),
            self.scale * self.toward.dot(point),
        )
    }

    /// Pixels a unit of length.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// The unit vector towards the viewer.
    pub fn toward(&self) -> DVec3 {
        self.toward
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_name_the_fixed_views_and_every_view_has_a_right_handed_frame() {
        let named = [(View::Front, -90.0, 0.0), (View::Side, 0.0, 0.0), (View::Top, -90.0, 90.0)];
        for (view, azimuth, elevation) in named {
            let (found, expected) = (View::Around { azimuth, elevation }.axes(), view.axes());
            for (a, b) in found.into_iter().zip(expected) {
                assert!((a - b).length() < 1e-15, "{view:?}: {found:?}");
            }
        }
        for k in 0..500 {
            let (azimuth, elevation) = (f64::from(k) * 7.3 - 900.0, f64::from(k) * 1.9 - 90.0);
            let [right, up, toward] = View::Around { azimuth, elevation }.axes();
            assert!((right.cross(up) - toward).length() < 1e-14);
            assert!((right.length() - 1.0).abs() < 1e-14 && right.z == 0.0);
        }
        let nowhere = View::Around { azimuth: f64::NAN, elevation: 0.0 };
        assert!(Camera::fit(nowhere, [DVec3::ONE], [9, 9], 0.0).is_err());
    }

    #[test]
    fn an_aimed_camera_shows_its_centre_in_the_middle_and_its_width_across() {
        let points = [DVec3::ZERO, DVec3::new(3.0, 1.0, 0.5)];
        let (centre, size) = (DVec3::new(2.0, -1.0, 0.3), [400, 100]);
        let view = View::Around { azimuth: -37.0, elevation: 21.0 };
        let fitted = Camera::fit(view, points, size, 0.1).unwrap();
        let camera = fitted.aimed(Some(centre), Some(8.0), size).unwrap();
        let project = |point: DVec3| camera.project(point).truncate();
        assert!((project(centre) - DVec2::new(200.0, 50.0)).length() < 1e-9);
        let [right, up, _] = view.axes();
        assert!((project(centre + 4.0 * right) - DVec2::new(400.0, 50.0)).length() < 1e-9);
        assert!((project(centre + up) - DVec2::ZERO - DVec2::new(200.0, 0.0)).length() < 1e-9);
        // What is not asked for stays.
        let same = fitted.aimed(None, None, size).unwrap();
        assert!((same.project(points[1]) - fitted.project(points[1])).length() < 1e-9);
        let wider = fitted.aimed(None, Some(1.0), size).unwrap();
        let middle = |camera: Camera| (DVec2::new(200.0, 50.0) - camera.origin) / camera.scale;
        assert!((middle(wider) - middle(fitted)).length() < 1e-12);
        for width in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-320] {
            assert!(fitted.aimed(None, Some(width), size).is_err(), "{width}");
        }
        let lost = DVec3::new(f64::NAN, 0.0, 0.0);
        assert!(fitted.aimed(Some(lost), None, size).is_err());
    }

    #[test]
    fn a_turning_camera_keeps_its_middle_and_sees_all_points_all_around() {
        let points = [(0.0, 0.0, 0.0), (3.0, 1.0, 0.5), (1.0, -2.0, 2.0)].map(DVec3::from);
        let (middle, size) = (DVec3::new(1.0, 0.5, 1.0), [200, 150]);
        for view in View::NAMES.map(|(_, view)| view) {
            let camera = Camera::fit_turning(view, points, middle, size, 0.0).unwrap();
            for degrees in (0..360).map(f64::from) {
                let turned = camera.turned(degrees, middle);
                let apart = turned.project(middle) - camera.project(middle);
                assert!(apart.truncate().length() < 1e-9, "{view:?} {degrees}");
                for point in points {
                    let point = turned.project(point).truncate();
                    let room = DVec2::new(200.0, 150.0) + 1e-9;
                    assert!(point.cmpge(DVec2::splat(-1e-9)).all() && point.cmple(room).all());
                }
            }
            let plain = Camera::fit(view, points, size, 0.0).unwrap();
            assert!(plain.scale() >= camera.scale(), "room to turn costs scale");
        }
    }
}
