//! Polynomials in t with integer coefficients, their real roots in (0, 1), and signs at such roots, all exact.

use std::cmp::Ordering;

use num_bigint::{BigInt, Sign};

/// The coefficients, the constant first; the last is not zero.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Polynomial(Vec<BigInt>);

/// The rational number `numerator` / 2^`shift`.
#[derive(Debug, Clone)]
pub(crate) struct Dyadic {
    numerator: BigInt,
    shift: usize,
}

/// A real number at which signs can be determined.
#[derive(Debug, Clone)]
pub(crate) enum Number {
    /// A dyadic rational number.
    Dyadic(Dyadic),
    /// The only root of a polynomial in an open interval, at whose ends it does not vanish.
    Root(Polynomial, Dyadic, Dyadic),
}

fn ordering(number: &BigInt) -> Ordering {
    match number.sign() {
        Sign::Minus => Ordering::Less,
        Sign::NoSign => Ordering::Equal,
        Sign::Plus => Ordering::Greater,
    }
}

impl Dyadic {
    pub(crate) fn new(numerator: impl Into<BigInt>, shift: usize) -> Self {
        let numerator = numerator.into();
        Self { numerator, shift }
    }

    /// `self` + (`other` − `self`) · `part` / 8.
    fn towards(&self, other: &Self, part: i32) -> Self {
        let shift = self.shift.max(other.shift);
        let at = |d: &Self| &d.numerator << (shift - d.shift);
        Self::new(at(self) * (8 - part) + at(other) * part, shift + 3)
    }
}

impl Polynomial {
    pub(crate) fn new(mut coefficients: Vec<BigInt>) -> Self {
        while coefficients.last().is_some_and(|c| c.sign() == Sign::NoSign) {
            coefficients.pop();
        }
        Self(coefficients)
    }

    pub(crate) fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    fn degree(&self) -> usize {
        self.0.len().saturating_sub(1)
    }

    fn coefficient(&self, k: usize) -> BigInt {
        self.0.get(k).cloned().unwrap_or_default()
    }

    fn combine(&self, other: &Self, with: impl Fn(BigInt, BigInt) -> BigInt) -> Self {
        let count = self.0.len().max(other.0.len());
        let both = |k| with(self.coefficient(k), other.coefficient(k));
        Self::new((0..count).map(both).collect())
    }

    pub(crate) fn plus(&self, other: &Self) -> Self {
        self.combine(other, |a, b| a + b)
    }

    pub(crate) fn minus(&self, other: &Self) -> Self {
        self.combine(other, |a, b| a - b)
    }

    pub(crate) fn times(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::new(Vec::new());
        }
        let mut product = vec![BigInt::default(); self.0.len() + other.0.len() - 1];
        for (i, a) in self.0.iter().enumerate() {
            for (j, b) in other.0.iter().enumerate() {
                product[i + j] += a * b;
            }
        }
        Self::new(product)
    }

    fn derivative(&self) -> Self {
        let terms = self.0.iter().enumerate().skip(1);
        Self::new(terms.map(|(k, c)| c * k).collect())
    }

    /// A positive multiple of the remainder of division by `divisor`, without its common power of two.
    fn remainder(&self, divisor: &Self) -> Self {
        let mut rest = self.clone();
        let lead = divisor.coefficient(divisor.degree());
        let size = BigInt::from(lead.magnitude().clone());
        while !rest.is_zero() && rest.degree() >= divisor.degree() {
            let gap = rest.degree() - divisor.degree();
            let mut factor = rest.coefficient(rest.degree());
            let mut scaled = rest.0;
            for c in &mut scaled {
                *c *= &size;
            }
            if lead.sign() == Sign::Minus {
                factor = -factor;
            }
            for (k, c) in divisor.0.iter().enumerate() {
                scaled[k + gap] -= c * &factor;
            }
            rest = Self::new(scaled);
        }
        let zeros = rest.0.iter().filter_map(BigInt::trailing_zeros).min();
        Self::new(rest.0.iter().map(|c| c >> zeros.unwrap_or(0)).collect())
    }

    pub(crate) fn sign_at_dyadic(&self, t: &Dyadic) -> Ordering {
        let mut sum = BigInt::default();
        for (k, c) in self.0.iter().rev().enumerate() {
            sum = sum * &t.numerator + (c << (k * t.shift));
        }
        ordering(&sum)
    }

    /// The sign at a number.
    pub(crate) fn sign_at(&self, number: &Number) -> Ordering {
        match number {
            Number::Dyadic(t) => self.sign_at_dyadic(t),
            Number::Root(root_of, low, high) => {
                let sequence = Remainders::new(root_of, &root_of.derivative().times(self));
                sequence.query(low, high).cmp(&0)
            }
        }
    }

    /// The roots in (0, 1); none for the zero polynomial.
    pub(crate) fn roots_inside(&self) -> Vec<Number> {
        let mut rest = self.clone();
        for end in [Dyadic::new(0, 0), Dyadic::new(1, 0)] {
            while !rest.is_zero() && rest.sign_at_dyadic(&end) == Ordering::Equal {
                rest = rest.without_root_at(&end);
            }
        }
        if rest.degree() == 0 || rest.keeps_its_sign_inside() {
            return Vec::new();
        }
        let sequence = Remainders::new(&rest, &rest.derivative());
        let mut roots = Vec::new();
        let mut open = vec![(Dyadic::new(0, 0), Dyadic::new(1, 0))];
        while let Some((low, high)) = open.pop() {
            match sequence.query(&low, &high) {
                0 => {}
                1 => roots.push(Number::Root(rest.clone(), low, high)),
                _ => {
                    // There are at most six roots: one of seven points is not a root.
                    let inner = [4, 3, 5, 2, 6, 1, 7].map(|part| low.towards(&high, part));
                    let is_free = |t: &Dyadic| rest.sign_at_dyadic(t) != Ordering::Equal;
                    if let Some(middle) = inner.into_iter().find(is_free) {
                        open.push((middle.clone(), high));
                        open.push((low, middle));
                    }
                }
            }
        }
        roots
    }

    /// The quotient by t or by 1 − t, which must divide it.
    fn without_root_at(&self, end: &Dyadic) -> Self {
        if end.numerator.sign() == Sign::NoSign {
            return Self::new(self.0[1..].to_vec());
        }
        // Synthetic division: the quotient by 1 − t has the partial sums as coefficients.
        let mut sum = BigInt::default();
        let partial = self.0[..self.degree()].iter().map(|c| {
            sum += c;
            sum.clone()
        });
        Self::new(partial.collect())
    }

    /// Descartes' rule for (1 + s)^n q(1 / (1 + s)): no change of sign, no root in (0, 1).
    fn keeps_its_sign_inside(&self) -> bool {
        let mut shifted: Vec<BigInt> = self.0.iter().rev().cloned().collect();
        let count = shifted.len();
        for pass in 0..count {
            for k in (pass..count - 1).rev() {
                let above = shifted[k + 1].clone();
                shifted[k] += above;
            }
        }
        let has = |sign| shifted.iter().any(|c| c.sign() == sign);
        !(has(Sign::Plus) && has(Sign::Minus))
    }
}

/// The signed remainder sequence of q and p (Basu, Pollack and Roy 2006, "Algorithms in Real Algebraic Geometry",
/// section 2.2).
struct Remainders(Vec<Polynomial>);

impl Remainders {
    fn new(q: &Polynomial, p: &Polynomial) -> Self {
        let mut sequence = vec![q.clone(), p.remainder(q)];
        loop {
            let count = sequence.len();
            if sequence[count - 1].is_zero() {
                sequence.pop();
                return Self(sequence);
            }
            let rest = sequence[count - 2].remainder(&sequence[count - 1]);
            let zero = Polynomial::new(Vec::new());
            sequence.push(zero.minus(&rest));
        }
    }

    fn variations(&self, t: &Dyadic) -> i32 {
        let mut last = Ordering::Equal;
        let mut count = 0;
        for polynomial in &self.0 {
            let sign = polynomial.sign_at_dyadic(t);
            if sign != Ordering::Equal {
                count += i32::from(last == sign.reverse() && last != Ordering::Equal);
                last = sign;
            }
        }
        count
    }

    /// With p = q' r: the number of roots of q in (low, high) at which r > 0 less those at which r < 0 (Sturm and
    /// Tarski; loc. cit., theorem 2.62). q must not vanish at the ends.
    fn query(&self, low: &Dyadic, high: &Dyadic) -> i32 {
        self.variations(low) - self.variations(high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polynomial(coefficients: &[i32]) -> Polynomial {
        Polynomial::new(coefficients.iter().copied().map(BigInt::from).collect())
    }

    /// Π (denominator t − numerator).
    fn with_roots(roots: &[(i32, i32)]) -> Polynomial {
        roots
            .iter()
            .map(|&(n, d)| polynomial(&[-n, d]))
            .fold(polynomial(&[1]), |product, factor| product.times(&factor))
    }

    #[test]
    fn the_roots_inside_are_counted_once_each_and_those_at_the_ends_not_at_all() {
        let count = |roots: &[(i32, i32)]| with_roots(roots).roots_inside().len();
        assert_eq!(count(&[(1, 2), (1, 3), (2, 3)]), 3);
        assert_eq!(count(&[(1, 2), (1, 2), (2, 3)]), 2);
        assert_eq!(count(&[(0, 1), (1, 1), (2, 1), (1, 8), (-1, 8)]), 1);
        assert_eq!(count(&[(0, 1), (0, 1), (1, 1)]), 0);
        assert_eq!(count(&[(1000, 2001), (1000, 2000), (1000, 1999)]), 3);
        assert_eq!(polynomial(&[1, 0, 4]).roots_inside().len(), 0);
        assert_eq!(polynomial(&[]).roots_inside().len(), 0);
    }

    #[test]
    fn signs_at_an_irrational_root_are_exact() {
        // 1/√2 is the root of 2 t² − 1.
        let root = polynomial(&[-1, 0, 2]).roots_inside().remove(0);
        assert_eq!(polynomial(&[-1, 0, 2]).sign_at(&root), Ordering::Equal);
        assert_eq!(polynomial(&[0, -1, 0, 2]).sign_at(&root), Ordering::Equal);
        // Neighbouring convergents of 1/√2.
        assert_eq!(polynomial(&[-408, 577]).sign_at(&root), Ordering::Greater);
        assert_eq!(polynomial(&[-985, 1393]).sign_at(&root), Ordering::Less);
        assert_eq!(polynomial(&[408, -577]).sign_at(&root), Ordering::Less);
    }

    #[test]
    fn signs_at_a_double_root_are_exact() {
        let square = with_roots(&[(1, 3), (1, 3)]);
        let root = square.roots_inside().remove(0);
        assert_eq!(square.sign_at(&root), Ordering::Equal);
        assert_eq!(polynomial(&[-1, 3]).sign_at(&root), Ordering::Equal);
        assert_eq!(polynomial(&[-1_000_000, 3_000_001]).sign_at(&root), Ordering::Greater);
    }
}
