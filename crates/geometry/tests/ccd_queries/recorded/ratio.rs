//! The f64 nearest to a ratio of integers.

use num_bigint::{BigInt, BigUint, Sign};

/// The f64 nearest to a ratio, ties to even, and whether it is the ratio exactly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Nearest {
    pub(crate) value: f64,
    pub(crate) is_exact: bool,
}

/// The number of bits of a mantissa, without the implicit one.
const FRACTION: i64 = 52;
/// The exponent of the smallest positive f64, which is the smallest of an integer mantissa.
const LEAST: i64 = -1074;
/// The largest exponent of an integer mantissa.
const LARGEST: i64 = 971;

/// `numerator` / `denominator` rounded; `None` if the denominator is 0 or the ratio is too large for an f64.
pub(crate) fn nearest(numerator: &BigInt, denominator: &BigInt) -> Option<Nearest> {
    let zero = BigUint::default();
    let (n, d) = (numerator.magnitude(), denominator.magnitude());
    if *d == zero {
        return None;
    }
    if *n == zero {
        let (value, is_exact) = (0.0, true);
        return Some(Nearest { value, is_exact });
    }
    // n / d lies between 2^(length − 1) and 2^(length + 1).
    let length = n.bits().cast_signed() - d.bits().cast_signed();
    let divided = |exponent: i64| {
        let up = |x: &BigUint, by: i64| x << by.max(0).cast_unsigned();
        let (n, d) = (up(n, -exponent), up(d, exponent));
        (&n / &d, n, d)
    };
    let mut exponent = (length - 1 - FRACTION).max(LEAST);
    let mut parts = divided(exponent);
    if parts.0.bits() > FRACTION.cast_unsigned() + 1 {
        exponent += 1;
        parts = divided(exponent);
    }
    let (whole, n, d) = parts;
    let rest = n - &whole * &d;
    let is_exact = rest == zero;
    let mut mantissa = u64::try_from(whole).ok()?;
    let twice: BigUint = rest << 1u32;
    if twice > d || (twice == d && mantissa % 2 == 1) {
        mantissa += 1;
    }
    if exponent > LARGEST {
        return None;
    }
    // The implicit bit of the mantissa adds one to the exponent; below it the number is subnormal.
    let bits = ((exponent - LEAST).cast_unsigned() << FRACTION) + mantissa;
    let magnitude = f64::from_bits(bits);
    let is_negative = (numerator.sign() == Sign::Minus) != (denominator.sign() == Sign::Minus);
    let value = if is_negative { -magnitude } else { magnitude };
    value.is_finite().then_some(Nearest { value, is_exact })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ratio(numerator: &str, denominator: &str) -> Option<Nearest> {
        nearest(&numerator.parse().unwrap(), &denominator.parse().unwrap())
    }

    fn assert_is(found: Option<Nearest>, value: f64, is_exact: bool) {
        let found = found.unwrap();
        assert_eq!(found.value.to_bits(), value.to_bits(), "{found:?} {value:e}");
        assert_eq!(found.is_exact, is_exact, "{value:e}");
    }

    #[test]
    fn ratios_that_are_f64_values_are_read_exactly() {
        assert_is(ratio("-1", "8388608"), -1.0 / 8_388_608.0, true);
        assert_is(ratio("3", "-4"), -0.75, true);
        assert_is(ratio("0", "7"), 0.0, true);
        assert_is(ratio("30", "10"), 3.0, true);
        let least = format!("{}", BigInt::from(1) << 1074u32);
        assert_is(ratio("1", &least), 5e-324, true);
        let largest = format!("{}", BigInt::from((1u64 << 53) - 1) << 971u32);
        assert_is(ratio(&largest, "1"), f64::MAX, true);
    }

    #[test]
    fn other_ratios_are_rounded_to_the_nearest_and_marked() {
        assert_is(ratio("1", "3"), 1.0 / 3.0, false);
        assert_is(ratio("-2", "3"), -2.0 / 3.0, false);
        assert_is(ratio("1", "10"), 0.1, false);
        let two_53 = 9_007_199_254_740_992.0;
        assert_is(ratio("9007199254740993", "1"), two_53, false);
        assert_is(ratio("9007199254740995", "1"), two_53 + 4.0, false);
        assert_is(ratio("18014398509481983", "2"), two_53, false);
        let three_halves = format!("{}", BigInt::from(1) << 1075u32);
        assert_is(ratio("3", &three_halves), 1e-323, false);
        assert_is(ratio("1", &three_halves), 0.0, false);
    }

    #[test]
    fn what_is_near_no_f64_is_refused() {
        assert_eq!(ratio("1", "0"), None);
        let too_large = format!("{}", BigInt::from(1) << 1024u32);
        assert_eq!(ratio(&too_large, "1"), None);
        let rounds_up = format!("{}", (BigInt::from(1) << 1024u32) - 1);
        assert_eq!(ratio(&rounds_up, "1"), None);
    }

    #[test]
    fn every_sum_of_a_f64_and_less_than_half_an_ulp_rounds_to_it() {
        for k in 0..2000u64 {
            let bits = k.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 2;
            let value = f64::from_bits(bits);
            // value = m 2^e with e ≥ −1074, plus a third of its last bit.
            let biased = (bits >> 52).max(1);
            let fraction = bits & ((1 << 52) - 1);
            let mantissa = if bits >> 52 == 0 { fraction } else { fraction | (1 << 52) };
            let numerator = (BigInt::from(mantissa) * 3 + 1) << biased;
            let denominator = BigInt::from(3) << 1075u32;
            assert_is(nearest(&numerator, &denominator), value, false);
            let numerator = BigInt::from(mantissa) << biased;
            assert_is(nearest(&numerator, &(BigInt::from(1) << 1075u32)), value, true);
        }
    }
}
