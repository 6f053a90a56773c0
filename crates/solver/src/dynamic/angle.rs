//! The angle of a vector in the plane, in lanes.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use pulp::Simd;

use super::lanes::Lanes;

/// tan π/8.
const TAN_PI_8: f64 = std::f64::consts::SQRT_2 - 1.0;

/// (atan t − t) / t³ as a polynomial in t², lowest power first: the one that agrees at the Chebyshev nodes of
/// [0, tan² π/8]. Relative to t its error is below 1e-17.
const ARC_TANGENT: [f64; 11] = [
    -0.333_333_333_333_333_3,
    0.199_999_999_999_955_2,
    -0.142_857_142_846_665_42,
    0.111_111_110_152_563_61,
    -0.090_909_045_781_239_03,
    0.076_921_831_908_260_87,
    -0.066_645_114_473_819_48,
    0.058_581_489_128_022_1,
    -0.050_854_497_379_402_6,
    0.039_231_658_295_587_19,
    -0.019_176_887_119_062_26,
];

/// The angle of (x, y) in [−π, π], as [`f64::atan2`] has it, within three units in the last place.
///
/// 0 or ±π for the zero vector, by the signs of its zeros. Precondition: no number is infinite.
#[inline(always)]
pub(super) fn atan2<S: Simd>(y: Lanes<S>, x: Lanes<S>) -> Lanes<S> {
    let (across, along) = (y.abs(), x.abs());
    let swapped = along.select_below(across, along, across);
    let longer = along.max(across).max(x.constant(f64::MIN_POSITIVE));
    // atan(s/l) = π/4 + atan((s − l) / (s + l)): one division whichever is nearer.
    let steep = longer * x.constant(TAN_PI_8);
    let numerator = steep.select_below(swapped, swapped - longer, swapped);
    let denominator = steep.select_below(swapped, swapped + longer, longer);
    let tangent = numerator.over(denominator);
    let base = steep.select_below(swapped, x.constant(FRAC_PI_4), x.constant(0.0));
    let square = tangent * tangent;
    let [.., highest] = ARC_TANGENT;
    let mut series = x.constant(highest);
    for power in (0..ARC_TANGENT.len() - 1).rev() {
        series = series.mul_add(square, x.constant(ARC_TANGENT[power]));
    }
    let small = base + (series * square).mul_add(tangent, tangent);
    let first = along.select_below(across, x.constant(FRAC_PI_2) - small, small);
    // The sign bit tells −0 from 0 as atan2 does.
    let behind = x.constant(PI) - first;
    let is_behind = x.constant(1.0).times_sign_of(x);
    is_behind.select_below(x.constant(0.0), behind, first).times_sign_of(y)
}

#[cfg(test)]
mod tests {
    use pulp::{Arch, WithSimd};

    use super::super::lanes::WIDTH;
    use super::*;

    struct Angles<'a> {
        y: &'a [f64; WIDTH],
        x: &'a [f64; WIDTH],
    }

    impl WithSimd for Angles<'_> {
        type Output = [f64; WIDTH];

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> [f64; WIDTH] {
            let mut out = [0.0; WIDTH];
            for part in 0..Lanes::<S>::PARTS {
                let angle = atan2(Lanes::load(simd, self.y, part), Lanes::load(simd, self.x, part));
                angle.store(&mut out, part);
            }
            out
        }
    }

    fn largest_error(vectors: &[(f64, f64)]) -> f64 {
        let mut worst = 0.0f64;
        for &(y, x) in vectors {
            let found = Arch::new().dispatch(Angles { y: &[y; WIDTH], x: &[x; WIDTH] });
            let exact = f64::atan2(y, x);
            for angle in found {
                assert_eq!(
                    angle.is_sign_negative(),
                    exact.is_sign_negative(),
                    "{y} {x}: {angle}, not {exact}"
                );
                let unit = f64::EPSILON * exact.abs().max(f64::MIN_POSITIVE);
                worst = worst.max((angle - exact).abs() / unit);
            }
        }
        worst
    }

    #[test]
    fn angles_are_those_of_the_library_all_around_and_at_every_scale() {
        let mut vectors = Vec::new();
        for index in 0..100_000 {
            let angle = f64::from(index) * 1e-4 - 5.0;
            let scale = f64::powi(10.0, index % 61 - 30);
            vectors.push((scale * angle.sin(), scale * angle.cos()));
            // Close to the axes.
            vectors.push((scale * 1e-12 * angle.sin(), angle.cos()));
            vectors.push((angle.sin(), scale * 1e-12 * angle.cos()));
        }
        let worst = largest_error(&vectors);
        assert!(worst < 3.0, "{worst} units in the last place");
    }

    #[test]
    fn axes_and_zeros_have_the_angles_of_the_library() {
        let numbers = [0.0, -0.0, 1.0, -1.0, 1e-300, -1e-300, 1e150, -1e150];
        let vectors: Vec<_> = numbers.iter().flat_map(|&y| numbers.map(|x| (y, x))).collect();
        assert!(largest_error(&vectors) < 3.0);
    }
}
