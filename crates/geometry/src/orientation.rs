//! On which side of a line a point lies, decided without rounding error.

use std::cmp::Ordering;

use glam::DVec2;

/// The sign of (a − c) × (b − c): `Greater` if a, b, c turn counter-clockwise, `Equal` if they are exactly collinear.
///
/// The determinant is evaluated in f64 and trusted if it exceeds its rounding error bound (3 + 16ε)ε(|l| + |r|), with ε
/// = 2⁻⁵³; otherwise the six products are expanded and summed exactly (Shewchuk 1997, "Adaptive precision
/// floating-point arithmetic and fast robust geometric predicates", sections 2 and 4.2). Precondition for exactness:
/// products of coordinates neither overflow nor underflow.
pub(crate) fn orientation(a: DVec2, b: DVec2, c: DVec2) -> Ordering {
    let left = (a.x - c.x) * (b.y - c.y);
    let right = (a.y - c.y) * (b.x - c.x);
    let determinant = left - right;
    let unit = 0.5 * f64::EPSILON;
    let bound = (3.0 + 16.0 * unit) * unit * (left.abs() + right.abs());
    let sign =
        if determinant.abs() > bound { determinant } else { exact_determinant_sign(a, b, c) };
    sign.total_cmp(&0.0)
}

/// A number with exactly the sign of a.x b.y − a.y b.x + b.x c.y − b.y c.x + c.x a.y − c.y a.x.
fn exact_determinant_sign(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let mut expansion = Vec::with_capacity(12);
    for (p, q) in [(a.x, b.y), (-a.y, b.x), (b.x, c.y), (-b.y, c.x), (c.x, a.y), (-c.y, a.x)] {
        let product = p * q;
        add(&mut expansion, f64::mul_add(p, q, -product));
        add(&mut expansion, product);
    }
    // The largest component outweighs all below it; + 0.0 turns −0.0 into 0.0.
    let largest = expansion.iter().rev().find(|&&part| part != 0.0);
    largest.copied().unwrap_or(0.0) + 0.0
}

/// Adds a number to an expansion of increasing, non-overlapping parts (GROW-EXPANSION by two-sums).
fn add(expansion: &mut Vec<f64>, number: f64) {
    let mut carried = number;
    for part in expansion.iter_mut() {
        let sum = carried + *part;
        let shadow = sum - carried;
        *part = (carried - (sum - shadow)) + (*part - shadow);
        carried = sum;
    }
    expansion.push(carried);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_an_ulp_beside_a_line_are_told_from_points_on_it() {
        // The line z = x; 0.5 and 12, 24 are the classic points at which plain f64 gives arbitrary answers.
        let (b, c) = (DVec2::splat(12.0), DVec2::splat(24.0));
        let ulp = f64::EPSILON / 2.0;
        for i in -8..=8 {
            for j in -8..=8 {
                let a = DVec2::new(0.5 + f64::from(i) * ulp, 0.5 + f64::from(j) * ulp);
                // c → b runs down the line, so points below the line lie on its left.
                let expected = a.x.total_cmp(&a.y);
                assert_eq!(orientation(c, b, a), expected, "{i} {j}");
            }
        }
    }

    #[test]
    fn swapping_two_points_turns_the_sign_even_of_tiny_triangles() {
        let (a, b) = (DVec2::new(0.1, 0.3), DVec2::new(0.7, 0.9));
        let mut collinear = 0;
        for k in 0..200 {
            let t = f64::from(k) / 199.0;
            let c = a + t * (b - a);
            assert_eq!(orientation(a, b, c), orientation(b, a, c).reverse());
            assert_eq!(orientation(a, b, c), orientation(b, c, a));
            collinear += usize::from(orientation(a, b, c) == Ordering::Equal);
        }
        assert!(collinear < 200, "rounded points must not all count as collinear");
    }
}
