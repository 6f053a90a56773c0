//! The profile: the curve Γ in the x–z plane that the sheet approximates.

use glam::DVec2;

use crate::arc_length::arc_length;
use crate::closure::Closure;
use crate::interpolation::interpolate;
use crate::polygon::first_crossing;
use crate::{GeometryError, Nurbs};

/// The smallest number of control points of a profile.
const FEWEST_CONTROL_POINTS: usize = 4;
/// The number of samples by which [`Profile::check_simple`] tests each knot span at least, and all of them together.
const SAMPLES_PER_SPAN: usize = 8;
const SAMPLES: usize = 1024;

/// The curve Γ of section 2 of the paper: cubic, unit weights, parameter u ∈ [0, 1], points (x, z).
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    curve: Nurbs,
    closure: Closure,
}

impl Profile {
    /// The profile with uniform knots through or near its control points.
    ///
    /// `Open` and `Corner` are clamped; `Corner` repeats the first control point as the last unless it is already
    /// there. `Smooth` is the periodic uniform B-spline; a last control point equal to the first counts as that
    /// repetition and is dropped.
    ///
    /// # Errors
    /// Fewer than 4 control points, or one that is not finite or larger than 1e100.
    pub fn new(control_points: &[DVec2], closure: Closure) -> Result<Self, GeometryError> {
        check_count(control_points)?;
        let curve = match closure {
            Closure::Open => Nurbs::clamped(control_points.to_vec())?,
            Closure::Corner => Nurbs::clamped(returning(control_points))?,
            Closure::Smooth => periodic(control_points)?,
        };
        Ok(Self { curve, closure })
    }

    /// The profile with the caller's knots: one for each control point (a repeated closing point included) and 4 more.
    ///
    /// # Errors
    /// As for [`Profile::new`] and [`Nurbs::with_knots`]; `Smooth`, whose knots are uniform; `Corner` with knots that
    /// are not clamped, so that the curve does not return to its start.
    pub fn with_knots(
        control_points: &[DVec2],
        knots: &[f64],
        closure: Closure,
    ) -> Result<Self, GeometryError> {
        check_count(control_points)?;
        let points = match closure {
            Closure::Open => control_points.to_vec(),
            Closure::Corner => returning(control_points),
            Closure::Smooth => return Err(GeometryError::KnotsOfSmoothProfile),
        };
        let curve = Nurbs::with_knots(points, knots.to_vec())?;
        let gap = curve.position(0.0).distance(curve.position(1.0));
        if closure == Closure::Corner && gap > 0.0 {
            return Err(GeometryError::NotClosed { gap });
        }
        Ok(Self { curve, closure })
    }

    /// The profile that passes through `points` in order: a C² cubic spline, represented as a NURBS with unit weights.
    ///
    /// The parameters of the points are centripetal (proportional to the square roots of the chords, Lee 1989), and
    /// they are the knots: the curve is a single cubic from point to point, however many there are, at a cost linear in
    /// their number. `Open` and `Corner` end without curvature (natural spline); `Corner` and `Smooth` return to the
    /// first point, which may be repeated as the last. The curve passes through every point, noise included: thin out
    /// or smooth a scan first.
    ///
    /// # Errors
    /// Fewer than 2 points, or 3 distinct ones for a closed profile; more than 20 000; one that is not finite, larger
    /// than 1e100, or equal to the one before it; points so unevenly spaced that parameters are closer than 1e-9; a
    /// closed profile whose last point is farther from its start than twice the longest step before.
    pub fn through(points: &[DVec2], closure: Closure) -> Result<Self, GeometryError> {
        let curve = interpolate(points, closure)?;
        Ok(Self { curve, closure })
    }

    /// The curve behind the profile.
    pub fn curve(&self) -> &Nurbs {
        &self.curve
    }

    /// How the profile ends.
    pub fn closure(&self) -> Closure {
        self.closure
    }

    /// Whether it returns to its start.
    pub fn is_closed(&self) -> bool {
        self.closure != Closure::Open
    }

    /// The point Γ(u); for a closed profile Γ(1) is bitwise Γ(0).
    pub fn position(&self, u: f64) -> DVec2 {
        if self.is_closed() && u >= 1.0 { self.curve.position(0.0) } else { self.curve.position(u) }
    }

    /// The derivative dΓ/du, see [`Nurbs::derivative`].
    pub fn derivative(&self, u: f64) -> DVec2 {
        self.curve.derivative(u)
    }

    /// The second derivative d²Γ/du², see [`Nurbs::second_derivative`].
    pub fn second_derivative(&self, u: f64) -> DVec2 {
        self.curve.second_derivative(u)
    }

    /// The largest absolute coordinate of a control point, to which rounding in positions is relative.
    pub fn magnitude(&self) -> f64 {
        self.curve.control_points().iter().fold(0.0, |size: f64, p| size.max(p.abs().max_element()))
    }

    /// The length ∫ |Γ'| du, within `accuracy` (absolute, in the unit of the profile), but no better than rounding
    /// allows.
    pub fn arc_length(&self, accuracy: f64) -> f64 {
        arc_length(&self.curve, accuracy)
    }

    /// The profile with every point multiplied by `factor`.
    ///
    /// # Errors
    /// A factor that is not positive and finite, or that takes a control point above 1e100.
    pub fn scaled(&self, factor: f64) -> Result<Self, GeometryError> {
        if !(factor > 0.0 && factor.is_finite()) {
            return Err(GeometryError::Scale { factor });
        }
        Ok(Self { curve: self.curve.scaled(factor)?, closure: self.closure })
    }

    /// The same profile in the opposite direction.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self { curve: self.curve.reversed(), closure: self.closure }
    }

    /// Checks that the profile does not meet itself, apart from the common start and end of a closed one.
    ///
    /// The check is exact for a polyline of n samples in each knot span: 1024 over the number of spans, at least 8. So
    /// a loop smaller than about 1/n of a span can be missed, and two strands closer than the sagitta of a sample
    /// (about κ (span length / n)² / 8) can be taken for a crossing. [`divide`](crate::divide) also checks its polygon
    /// exactly.
    ///
    /// # Errors
    /// `CurveCrosses` with one point at which it does; touching counts as crossing.
    pub fn check_simple(&self) -> Result<(), GeometryError> {
        let (parameters, points) = self.samples();
        let Some(crossing) = first_crossing(&points, self.is_closed()) else {
            return Ok(());
        };
        let at = |segment: usize| {
            let (a, b) = (points[segment], points[segment + 1]);
            let share = (crossing.point - a).dot(b - a) / (b - a).length_squared();
            let width = parameters[segment + 1] - parameters[segment];
            parameters[segment] + width * share.clamp(0.0, 1.0)
        };
        Err(GeometryError::CurveCrosses {
            parameters: crossing.segments.map(at),
            point: crossing.point,
        })
    }

    /// Parameters and points along the curve, without repeated points.
    fn samples(&self) -> (Vec<f64>, Vec<DVec2>) {
        let breakpoints = self.curve.breakpoints();
        let count = SAMPLES_PER_SPAN.max(SAMPLES.div_ceil(breakpoints.len() - 1));
        let inner = breakpoints.windows(2).flat_map(|span| {
            let (start, width) = (span[0], span[1] - span[0]);
            (0..count).map(move |k| start + width * (k as f64 / count as f64))
        });
        let mut samples: Vec<_> = inner.chain([1.0]).map(|u| (u, self.position(u))).collect();
        samples.dedup_by(|b, a| a.1 == b.1);
        samples.into_iter().unzip()
    }
}

fn check_count(control_points: &[DVec2]) -> Result<(), GeometryError> {
    if control_points.len() < FEWEST_CONTROL_POINTS {
        return Err(GeometryError::TooFewControlPoints {
            count: control_points.len(),
            minimum: FEWEST_CONTROL_POINTS,
        });
    }
    Ok(())
}

/// The control points, with the first repeated as the last.
fn returning(control_points: &[DVec2]) -> Vec<DVec2> {
    let mut points = control_points.to_vec();
    if points.first() != points.last() {
        points.extend(control_points.first());
    }
    points
}

/// The periodic uniform B-spline: the first three control points are repeated after the last.
fn periodic(control_points: &[DVec2]) -> Result<Nurbs, GeometryError> {
    let n = control_points.len() - usize::from(control_points.first() == control_points.last());
    let points: Vec<_> = (0..n + 3).map(|i| control_points[i % n]).collect();
    let knots = (0..n + 7).map(|k| k as f64).collect();
    Nurbs::with_knots(points, knots)
}
