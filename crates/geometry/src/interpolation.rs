//! Cubic splines through given points, as B-splines.
//!
//! With knots u_k, points p_k and spacings c_k = u_{k+1} − u_k, the second derivatives M_k of the C² cubic spline solve
//!
//! c_{k−1} M_{k−1} + 2 (c_{k−1} + c_k) M_k + c_k M_{k+1} = 6 ((p_{k+1} − p_k) / c_k − (p_k − p_{k−1}) / c_{k−1})
//!
//! (de Boor 1978, *A Practical Guide to Splines*, chapter IV). The control point of the knots u_{k−1}, u_k, u_{k+1} is the
//! polar form of the cubic there (Ramshaw 1989): with d_k the first derivative, a = u_k − u_{k−1} and c = u_{k+1} − u_k,
//!
//! P = p_k + d_k (c − a) / 3 − M_k a c / 6.

use glam::DVec2;

use crate::closure::Closure;
use crate::nurbs::{LARGEST_COORDINATE, NARROWEST_SPAN};
use crate::tridiagonal::Tridiagonal;
use crate::{GeometryError, Nurbs};

/// The largest number of points of a curve.
const MOST_POINTS: usize = 20_000;

/// The C² cubic spline through `points` with centripetal parameters; see [`Profile::through`](crate::Profile::through).
pub(crate) fn interpolate(points: &[DVec2], closure: Closure) -> Result<Nurbs, GeometryError> {
    let points = checked(points, closure)?;
    let parameters = centripetal(&points)?;
    let spacings: Vec<_> = parameters.windows(2).map(|u| u[1] - u[0]).collect();
    match closure {
        Closure::Open | Closure::Corner => natural(&points, &parameters, &spacings),
        Closure::Smooth => periodic(&points, &parameters, &spacings),
    }
}

/// The points, with the first repeated as the last if the curve is closed.
fn checked(points: &[DVec2], closure: Closure) -> Result<Vec<DVec2>, GeometryError> {
    let closed = closure != Closure::Open;
    let mut points = points.to_vec();
    let in_range = |c: f64| c.abs() <= LARGEST_COORDINATE;
    if let Some(index) = points.iter().position(|p| !(in_range(p.x) && in_range(p.y))) {
        return Err(GeometryError::Point {
            index,
            x: points[index].x,
            z: points[index].y,
            limit: LARGEST_COORDINATE,
        });
    }
    let minimum = if closed { 3 } else { 2 };
    let repeated = closed && points.len() > 1 && points.first() == points.last();
    if !(minimum..=MOST_POINTS).contains(&(points.len() - usize::from(repeated))) {
        return Err(GeometryError::PointCount {
            count: points.len(),
            minimum,
            maximum: MOST_POINTS,
        });
    }
    if closed && !repeated {
        let gap = points[0].distance(points[points.len() - 1]);
        let longest =
            points.windows(2).fold(0.0, |longest: f64, p| longest.max(p[0].distance(p[1])));
        if gap > 2.0 * longest {
            return Err(GeometryError::EndsApart { gap, longest });
        }
        points.push(points[0]);
    }
    Ok(points)
}

/// Parameters from 0 to 1 whose spacings are proportional to the square roots of the chords (Lee 1989, *Computer-Aided
/// Design* 21).
fn centripetal(points: &[DVec2]) -> Result<Vec<f64>, GeometryError> {
    let mut parameters = vec![0.0];
    let mut sum = 0.0;
    for pair in points.windows(2) {
        sum += pair[0].distance(pair[1]).sqrt();
        parameters.push(sum);
    }
    let last = parameters.len() - 1;
    for parameter in &mut parameters[..last] {
        *parameter /= sum;
    }
    parameters[last] = 1.0;
    match parameters.windows(2).position(|u| u[1] - u[0] < NARROWEST_SPAN || sum == 0.0) {
        None => Ok(parameters),
        Some(index) => {
            Err(GeometryError::RepeatedPoint { index, x: points[index].x, z: points[index].y })
        }
    }
}

/// The spline whose second derivative vanishes at both ends, with clamped knots.
fn natural(points: &[DVec2], u: &[f64], c: &[f64]) -> Result<Nurbs, GeometryError> {
    let last = points.len() - 1;
    let factors = Tridiagonal::factor(
        c.windows(2).map(|c| 2.0 * (c[0] + c[1])),
        c[1..].iter().take(last.saturating_sub(2)).copied(),
    );
    let right: Vec<_> =
        (1..last).map(|k| bend(points[k - 1], points[k], points[k + 1], c[k - 1], c[k])).collect();
    let inner = if last > 1 { solve(&factors, &right) } else { Vec::new() };
    let mut bends = vec![DVec2::ZERO];
    bends.extend(inner);
    bends.push(DVec2::ZERO);
    let control = |k: usize| {
        let before = if k > 0 { c[k - 1] } else { 0.0 };
        let after = c.get(k).copied().unwrap_or(0.0);
        let slope = if k < last {
            (points[k + 1] - points[k]) / c[k] - c[k] / 6.0 * (2.0 * bends[k] + bends[k + 1])
        } else {
            (points[k] - points[k - 1]) / c[k - 1]
                + c[k - 1] / 6.0 * (bends[k - 1] + 2.0 * bends[k])
        };
        points[k] + slope * ((after - before) / 3.0) - bends[k] * (before * after / 6.0)
    };
    let mut control_points = vec![points[0]];
    control_points.extend((0..=last).map(control));
    control_points.push(points[last]);
    let knots = std::iter::repeat_n(0.0, 3)
        .chain(u.iter().copied())
        .chain(std::iter::repeat_n(1.0, 3))
        .collect();
    Nurbs::with_knots(control_points, knots)
}

/// The spline that returns to its first point with both derivatives; its knots repeat beyond both ends.
fn periodic(points: &[DVec2], u: &[f64], c: &[f64]) -> Result<Nurbs, GeometryError> {
    let count = points.len() - 1;
    let before = |k: usize| (k + count - 1) % count;
    let after = |k: usize| (k + 1) % count;
    let right: Vec<_> = (0..count)
        .map(|k| bend(points[before(k)], points[k], points[after(k)], c[before(k)], c[k]))
        .collect();
    let bends = solve_cyclic(c, &right);
    let control = |k: usize| {
        let (a, b) = (c[before(k)], c[k]);
        let slope =
            (points[after(k)] - points[k]) / b - b / 6.0 * (2.0 * bends[k] + bends[after(k)]);
        points[k] + slope * ((b - a) / 3.0) - bends[k] * (a * b / 6.0)
    };
    // The control points of u_{−1} … u_{count+1}, over the knots u_{−3} … u_{count+3}.
    let control_points = (0..count + 3).map(|i| control((i + count - 1) % count)).collect();
    let knots = (0..count + 7)
        .map(|i| {
            let (turns, k) = ((i + 2 * count - 3) / count, (i + 2 * count - 3) % count);
            u[k] + turns as f64 - 2.0
        })
        .collect();
    Nurbs::with_knots(control_points, knots)
}

/// The right-hand side at a point: six times the change of slope there.
fn bend(previous: DVec2, point: DVec2, next: DVec2, a: f64, c: f64) -> DVec2 {
    6.0 * ((next - point) / c - (point - previous) / a)
}

fn solve(factors: &Tridiagonal, right: &[DVec2]) -> Vec<DVec2> {
    let along = |pick: fn(&DVec2) -> f64| {
        let side: Vec<_> = right.iter().map(pick).collect();
        factors.solve(&side)
    };
    let (x, z) = (along(|p| p.x), along(|p| p.y));
    x.into_iter().zip(z).map(|(x, z)| DVec2::new(x, z)).collect()
}

/// Solves the cyclic system, which is tridiagonal except for its corners; they are removed as a matrix of rank one
/// (Sherman–Morrison).
fn solve_cyclic(c: &[f64], right: &[DVec2]) -> Vec<DVec2> {
    let count = c.len();
    let corner = c[count - 1];
    // A = T + corner (e_0 + e_n)(e_0 + e_n)ᵀ; T stays diagonally dominant.
    let diagonal = (0..count).map(|k| {
        let inner = 2.0 * (c[(k + count - 1) % count] + c[k]);
        if k == 0 || k == count - 1 { inner - corner } else { inner }
    });
    let factors = Tridiagonal::factor(diagonal, c[..count - 1].iter().copied());
    let mut ends = vec![0.0; count];
    ends[0] = 1.0;
    ends[count - 1] = 1.0;
    let y = factors.solve(&ends);
    let x = solve(&factors, right);
    let share = (x[0] + x[count - 1]) * (corner / (1.0 + corner * (y[0] + y[count - 1])));
    x.iter().zip(y).map(|(x, y)| *x - share * y).collect()
}
