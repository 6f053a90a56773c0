//! Cubic B-spline curves in the x–z plane.
//!
//! A NURBS curve whose weights are all one, as the paper's profiles are (section 2), is a polynomial B-spline:
//! C(u) = Σ N_{i,3}(u) P_i, because Σ N_{i,3} = 1. Weights are therefore not stored.
//! Source: Piegl and Tiller 1997, *The NURBS Book*, chapters 2 and 3.

use glam::DVec2;

use crate::GeometryError;

const DEGREE: usize = 3;
/// Coordinates up to this size can be squared and multiplied again without overflow.
pub(crate) const LARGEST_COORDINATE: f64 = 1e100;
/// Two knots are equal or at least this far apart, relative to the knot range.
pub(crate) const NARROWEST_SPAN: f64 = 1e-9;

/// A cubic B-spline curve (NURBS of unit weights) over u ∈ [0, 1]; points are (x, z).
#[derive(Debug, Clone, PartialEq)]
pub struct Nurbs {
    control_points: Vec<DVec2>,
    knots: Vec<f64>,
}

impl Nurbs {
    /// The curve with clamped uniform knots: it starts at the first control point and ends at the last.
    ///
    /// # Errors
    /// Fewer than 4 control points, or one that is not finite or larger than 1e100.
    pub fn clamped(control_points: Vec<DVec2>) -> Result<Self, GeometryError> {
        check_control_points(&control_points)?;
        let spans = control_points.len() - DEGREE;
        let inner = (1..spans).map(|k| k as f64 / spans as f64);
        let knots = std::iter::repeat_n(0.0, DEGREE + 1)
            .chain(inner)
            .chain(std::iter::repeat_n(1.0, DEGREE + 1))
            .collect();
        Ok(Self { control_points, knots })
    }

    /// The curve with the caller's knots U_0 … U_{n+3} for n control points, mapped so that its domain
    /// [U_3, U_n] becomes [0, 1]. The knots need not be clamped.
    ///
    /// # Errors
    /// As [`Nurbs::clamped`]; knots that are not n + 4 finite, non-decreasing numbers, an empty domain, knots repeated
    /// more than 3 times inside the domain or 4 times at its ends, and knots closer than 1e-9 of the domain but
    /// not equal.
    pub fn with_knots(
        control_points: Vec<DVec2>,
        mut knots: Vec<f64>,
    ) -> Result<Self, GeometryError> {
        check_control_points(&control_points)?;
        check_knots(&knots, control_points.len())?;
        let (start, end) = (knots[DEGREE], knots[control_points.len()]);
        if !(end > start && (end - start).is_finite()) {
            return Err(GeometryError::KnotRange { start, end });
        }
        for knot in &mut knots {
            *knot = (*knot - start) / (end - start);
        }
        check_knot_spacing(&knots)?;
        Ok(Self { control_points, knots })
    }

    /// The control points P_i as (x, z).
    pub fn control_points(&self) -> &[DVec2] {
        &self.control_points
    }

    /// The normalised knots, four more than there are control points.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// The ends of the knot spans, strictly increasing from 0 to 1: the curve is a single cubic between two of them.
    pub fn breakpoints(&self) -> Vec<f64> {
        let mut domain = self.knots[DEGREE..=self.control_points.len()].to_vec();
        domain.dedup();
        domain
    }

    /// The point C(u); u outside [0, 1] is clamped to the nearer end.
    ///
    /// Rounding: within a few units in the last place of the largest nearby control point, and exactly that point at a
    /// clamped end.
    pub fn position(&self, u: f64) -> DVec2 {
        let (span, u) = self.span(u);
        let basis = self.basis::<4>(span, u);
        let first = span - DEGREE;
        (0..4).map(|j| basis[j] * self.control_points[first + j]).sum()
    }

    /// The derivative dC/du, from the right at a corner of the curve, from the left at u = 1.
    pub fn derivative(&self, u: f64) -> DVec2 {
        let (span, u) = self.span(u);
        let basis = self.basis::<3>(span, u);
        (0..3).map(|j| basis[j] * self.velocity(span - DEGREE + j)).sum()
    }

    /// The second derivative d²C/du², from the right at knots where it jumps, from the left at u = 1.
    pub fn second_derivative(&self, u: f64) -> DVec2 {
        let (span, u) = self.span(u);
        let basis = self.basis::<2>(span, u);
        let acceleration = |i: usize| {
            2.0 * (self.velocity(i + 1) - self.velocity(i))
                / (self.knots[i + 4] - self.knots[i + 2])
        };
        (0..2).map(|j| basis[j] * acceleration(span - DEGREE + j)).sum()
    }

    /// The same curve in the opposite direction: u ↦ C(1 − u).
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self {
            control_points: self.control_points.iter().rev().copied().collect(),
            knots: self.knots.iter().rev().map(|u| 1.0 - u).collect(),
        }
    }

    /// The curve with every control point multiplied by `factor`.
    pub(crate) fn scaled(&self, factor: f64) -> Result<Self, GeometryError> {
        let control_points: Vec<_> = self.control_points.iter().map(|p| *p * factor).collect();
        check_control_points(&control_points)?;
        Ok(Self { control_points, knots: self.knots.clone() })
    }

    /// Control point i of the derivative, of degree 2: 3 (P_{i+1} − P_i) / (U_{i+4} − U_{i+1}) (equation 3.4).
    fn velocity(&self, i: usize) -> DVec2 {
        3.0 * (self.control_points[i + 1] - self.control_points[i])
            / (self.knots[i + 4] - self.knots[i + 1])
    }

    /// The span i with U_i ≤ u < U_{i+1}, the last one for u = 1 (algorithm A2.1), and u clamped to [0, 1].
    fn span(&self, u: f64) -> (usize, f64) {
        let u = u.clamp(0.0, 1.0);
        let n = self.control_points.len();
        let above = self.knots.partition_point(|&knot| knot <= u);
        let mut span = above.clamp(DEGREE + 1, n) - 1;
        while span > DEGREE && self.knots[span] == self.knots[span + 1] {
            span -= 1;
        }
        (span, u)
    }

    /// The N basis functions of degree N − 1 that are not zero on the span (algorithm A2.2, in convex combinations, so
    /// that they are exact at the ends and never negative).
    fn basis<const N: usize>(&self, span: usize, u: f64) -> [f64; N] {
        let mut basis = [0.0; N];
        basis[0] = 1.0;
        for degree in 1..N {
            let mut carried = 0.0;
            for (r, entry) in basis[..degree].iter_mut().enumerate() {
                let right = self.knots[span + 1 + r] - u;
                let left = u - self.knots[span + 1 + r - degree];
                let share = right / (right + left);
                let value = *entry;
                *entry = carried + share * value;
                carried = (1.0 - share) * value;
            }
            basis[degree] = carried;
        }
        basis
    }
}

fn check_control_points(points: &[DVec2]) -> Result<(), GeometryError> {
    if points.len() <= DEGREE {
        return Err(GeometryError::TooFewControlPoints {
            count: points.len(),
            minimum: DEGREE + 1,
        });
    }
    // NaN fails the comparison too.
    let in_range = |c: f64| c.abs() <= LARGEST_COORDINATE;
    match points.iter().position(|p| !(in_range(p.x) && in_range(p.y))) {
        None => Ok(()),
        Some(index) => Err(GeometryError::ControlPoint {
            index,
            x: points[index].x,
            z: points[index].y,
            limit: LARGEST_COORDINATE,
        }),
    }
}

fn check_knots(knots: &[f64], control_points: usize) -> Result<(), GeometryError> {
    if knots.len() != control_points + DEGREE + 1 {
        return Err(GeometryError::KnotCount {
            count: knots.len(),
            control_points,
            expected: control_points + DEGREE + 1,
        });
    }
    for (index, &value) in knots.iter().enumerate() {
        if !value.is_finite() {
            return Err(GeometryError::KnotNotFinite { index, value });
        }
        if index > 0 && value < knots[index - 1] {
            return Err(GeometryError::KnotsDecrease { index, previous: knots[index - 1], value });
        }
    }
    Ok(())
}

/// Checks the multiplicities and distances of normalised knots.
fn check_knot_spacing(knots: &[f64]) -> Result<(), GeometryError> {
    for group in knots.chunk_by(|a, b| a == b) {
        let u = group[0];
        let limit = if u > 0.0 && u < 1.0 { DEGREE } else { DEGREE + 1 };
        if group.len() > limit {
            return Err(GeometryError::KnotMultiplicity { u, count: group.len(), limit });
        }
    }
    for (index, pair) in knots.windows(2).enumerate() {
        let width = pair[1] - pair[0];
        if width > 0.0 && width < NARROWEST_SPAN {
            return Err(GeometryError::KnotSpanTooNarrow { index, width, minimum: NARROWEST_SPAN });
        }
    }
    Ok(())
}
