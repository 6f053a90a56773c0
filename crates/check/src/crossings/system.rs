//! Linear equations between whole numbers, added one by one.

use std::collections::BTreeMap;

/// The equations are solved modulo this prime, 2³¹ − 1: what is solvable in whole numbers is solvable so.
const PRIME: u64 = (1 << 31) - 1;

/// Equations in triangular form: each is solved for its last unknown.
#[derive(Debug, Default)]
pub(super) struct System {
    unknowns: u32,
    rows: BTreeMap<u32, Row>,
}

#[derive(Debug, Clone, Default)]
struct Row {
    /// Coefficients by unknown, none 0.
    terms: BTreeMap<u32, u64>,
    sum: u64,
}

impl System {
    pub(super) fn new_unknown(&mut self) -> u32 {
        self.unknowns += 1;
        self.unknowns - 1
    }

    /// Adds Σ coefficient · unknown = `sum`; false, and nothing is added, where that contradicts what is there.
    pub(super) fn add(&mut self, terms: &[(u32, i64)], sum: i64) -> bool {
        let mut row = Row {
            terms: BTreeMap::new(),
            sum: residue(sum),
        };
        for &(unknown, coefficient) in terms {
            row.add(unknown, residue(coefficient));
        }
        while let Some((&last, &coefficient)) = row.terms.last_key_value() {
            match self.rows.get(&last) {
                Some(solved) => row.subtract(solved, coefficient),
                None => {
                    row.divide(coefficient);
                    self.rows.insert(last, row);
                    return true;
                }
            }
        }
        row.sum == 0
    }
}

impl Row {
    fn add(&mut self, unknown: u32, coefficient: u64) {
        let sum = (self.terms.get(&unknown).copied().unwrap_or(0) + coefficient) % PRIME;
        if sum == 0 {
            self.terms.remove(&unknown);
        } else {
            self.terms.insert(unknown, sum);
        }
    }

    fn subtract(&mut self, other: &Self, times: u64) {
        let negative = PRIME - times;
        for (&unknown, &coefficient) in &other.terms {
            self.add(unknown, coefficient * negative % PRIME);
        }
        self.sum = (self.sum + other.sum * negative) % PRIME;
    }

    fn divide(&mut self, divisor: u64) {
        let inverse = power(divisor, PRIME - 2);
        for coefficient in self.terms.values_mut() {
            *coefficient = *coefficient * inverse % PRIME;
        }
        self.sum = self.sum * inverse % PRIME;
    }
}

fn residue(number: i64) -> u64 {
    number.rem_euclid(PRIME as i64).unsigned_abs()
}

fn power(base: u64, mut exponent: u64) -> u64 {
    let (mut result, mut square) = (1, base);
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = result * square % PRIME;
        }
        square = square * square % PRIME;
        exponent >>= 1;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equations_that_contradict_each_other_are_refused_and_others_are_not() {
        let mut system = System::default();
        let [x, y, z] = [(); 3].map(|()| system.new_unknown());
        assert!(system.add(&[(x, 1), (y, 1)], 1));
        assert!(system.add(&[(y, 1), (z, -1)], 0));
        assert!(!system.add(&[(x, 1), (z, 1)], 0), "x + y = 1 and y = z");
        assert!(system.add(&[(x, 1), (z, 1)], 1), "follows from the others");
        assert!(system.add(&[(x, 3), (y, -2)], -7));
        assert!(!system.add(&[(x, 1)], 0), "x = −1");
        assert!(system.add(&[(x, 1)], -1));
        assert!(!system.add(&[], 1) && system.add(&[], 0));
    }

    #[test]
    fn equations_with_a_known_solution_are_never_refused() {
        use crate::crossings::random::Random;
        let mut random = Random::new(3);
        let mut system = System::default();
        let solution: Vec<i64> = (0..40)
            .map(|_| {
                system.new_unknown();
                random.index(7) as i64 - 3
            })
            .collect();
        for _ in 0..200 {
            let terms: Vec<(u32, i64)> = (0..4)
                .map(|_| (random.index(40) as u32, random.index(3) as i64 - 1))
                .collect();
            let sum: i64 = terms.iter().map(|&(u, c)| c * solution[u as usize]).sum();
            assert!(system.add(&terms, sum));
            let is_trivial = system.rows.len() < 40;
            assert!(is_trivial || !system.add(&[(0, 1)], solution[0] + 1));
        }
    }
}
