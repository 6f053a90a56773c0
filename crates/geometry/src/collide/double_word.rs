//! Arithmetic on one and on two f64, for signs that plain f64 cannot determine.

use std::ops::{Add, Mul, Sub};

/// A number whose sums and products are rounded by at most [`Scalar::ROUNDOFF`] of their size.
pub(super) trait Scalar:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
    /// A bound of the relative error of one operation.
    const ROUNDOFF: f64;

    fn new(value: f64) -> Self;

    /// a − b, with the relative error of one operation.
    fn difference(a: f64, b: f64) -> Self;

    /// The nearest f64, or one of its neighbours.
    fn value(self) -> f64;
}

impl Scalar for f64 {
    const ROUNDOFF: Self = 0.5 * Self::EPSILON;

    fn new(value: f64) -> Self {
        value
    }

    fn difference(a: f64, b: f64) -> Self {
        a - b
    }

    fn value(self) -> f64 {
        self
    }
}

/// The sum of two f64, the second at most half a unit in the last place of the first: about 106 bits.
///
/// Dekker 1971, "A floating-point technique for extending the available precision"; the bounds of Joldes, Muller and
/// Popescu 2017, "Tight and rigorous error bounds for basic building blocks of double-word arithmetic": 3 u² for the
/// sum and 5 u² for the product, with u = 2⁻⁵³.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct DoubleWord {
    high: f64,
    low: f64,
}

/// a + b = sum + error, exactly (Knuth 1969).
fn two_sum(a: f64, b: f64) -> DoubleWord {
    let high = a + b;
    let shadow = high - a;
    let low = (a - (high - shadow)) + (b - shadow);
    DoubleWord { high, low }
}

/// a + b = sum + error, exactly, if |a| ≥ |b| (Dekker 1971).
fn fast_two_sum(a: f64, b: f64) -> DoubleWord {
    let high = a + b;
    let low = b - (high - a);
    DoubleWord { high, low }
}

impl Add for DoubleWord {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let s = two_sum(self.high, other.high);
        let t = two_sum(self.low, other.low);
        let v = fast_two_sum(s.high, s.low + t.high);
        fast_two_sum(v.high, t.low + v.low)
    }
}

impl Sub for DoubleWord {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        let negative = Self { high: -other.high, low: -other.low };
        self + negative
    }
}

impl Mul for DoubleWord {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let high = self.high * other.high;
        let error = f64::mul_add(self.high, other.high, -high);
        let cross = f64::mul_add(self.low, other.high, self.high * other.low);
        fast_two_sum(high, error + cross)
    }
}

impl Scalar for DoubleWord {
    /// The bound 8 u².
    const ROUNDOFF: f64 = 2.0 * f64::EPSILON * f64::EPSILON;

    fn new(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }

    fn difference(a: f64, b: f64) -> Self {
        two_sum(a, -b)
    }

    fn value(self) -> f64 {
        self.high + self.low
    }
}

#[cfg(test)]
mod tests {
    use num_bigint::BigInt;

    use super::*;
    use foldmotion_random::Random;

    /// The number times 2^300, exact for numbers that are multiples of 2^-300.
    fn whole(number: f64) -> BigInt {
        let mut exponent = 300;
        let mut scaled = number;
        while scaled.fract() != 0.0 {
            scaled *= 2.0;
            exponent -= 1;
        }
        BigInt::from(scaled as i128) << exponent
    }

    fn exact(number: DoubleWord) -> BigInt {
        whole(number.high) + whole(number.low)
    }

    fn is_within(off: BigInt, bound: &BigInt, size: &BigInt) -> bool {
        (off * bound).magnitude() <= size.magnitude()
    }

    #[test]
    fn sums_and_products_are_as_accurate_as_promised() {
        let mut random = Random::new(91);
        // 2^106 / 8: the error times this is below the size.
        let bound = BigInt::from(1) << 103;
        for _ in 0..2000 {
            let mut number = || DoubleWord::difference(random.number(), random.number() * 1e-3);
            let (a, b) = (number(), number());
            let sum: BigInt = exact(a) + exact(b);
            let off: BigInt = exact(a + b) - &sum;
            assert!(is_within(off, &bound, &sum));
            let product: BigInt = exact(a) * exact(b);
            let found: BigInt = exact(a * b) << 300;
            let off: BigInt = found - &product;
            assert!(is_within(off, &bound, &product));
        }
    }
}
