//! Arc length of a curve by Gauss–Legendre quadrature.

use crate::Nurbs;

/// Abscissae ≥ 0 and weights of the five-point Gauss–Legendre rule on [−1, 1] (exact for polynomials of degree 9).
const GAUSS_5: [(f64, f64); 3] = [
    (0.0, 128.0 / 225.0),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.906_179_845_938_664, 0.236_926_885_056_189_08),
];
/// The largest number of times a knot span is halved; only next to a cusp are more than a few needed.
const DEEPEST: u32 = 40;

/// ∫ |C'(u)| du over [a, b] by one five-point rule. Precondition: [a, b] lies in one knot span.
pub(crate) fn piece_length(curve: &Nurbs, a: f64, b: f64) -> f64 {
    let (centre, half) = (f64::midpoint(a, b), 0.5 * (b - a));
    let speed = |u: f64| curve.derivative(u).length();
    let sum: f64 = GAUSS_5
        .iter()
        .map(|&(x, weight)| match x {
            0.0 => weight * speed(centre),
            _ => weight * (speed(centre - half * x) + speed(centre + half * x)),
        })
        .sum();
    half * sum
}

/// The length of the curve. Each knot span is halved until the rule for it and for its two halves agree within its
/// share of `accuracy`, or within the rounding of the speeds.
pub(crate) fn arc_length(curve: &Nurbs, accuracy: f64) -> f64 {
    let breakpoints = curve.breakpoints();
    let share = accuracy / (breakpoints.len() - 1) as f64;
    breakpoints
        .windows(2)
        .map(|span| {
            let (a, b) = (span[0], span[1]);
            let fastest = (0..=4)
                .map(|k| curve.derivative(a + 0.25 * f64::from(k) * (b - a)).length())
                .fold(0.0, f64::max);
            let rounding = 64.0 * f64::EPSILON * fastest * (b - a);
            let whole = piece_length(curve, a, b);
            refined(curve, [a, b], whole, share.max(rounding), DEEPEST)
        })
        .sum()
}

fn refined(curve: &Nurbs, [a, b]: [f64; 2], whole: f64, accuracy: f64, depth: u32) -> f64 {
    let middle = f64::midpoint(a, b);
    let left = piece_length(curve, a, middle);
    let right = piece_length(curve, middle, b);
    if depth == 0 || (left + right - whole).abs() <= accuracy {
        return left + right;
    }
    refined(curve, [a, middle], left, 0.5 * accuracy, depth - 1)
        + refined(curve, [middle, b], right, 0.5 * accuracy, depth - 1)
}
