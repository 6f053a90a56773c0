//! A system of linear equations in integers, to which equations are added one by one.

use std::collections::BTreeMap;

/// The equations are solved modulo each of these primes. A system with an integer solution has one modulo both. The
/// converse fails only if every rational solution needs a denominator divisible by another prime; contacts around a
/// Möbius band need the prime 2.
const PRIMES: [u64; 2] = [(1 << 31) - 1, 2];

/// Linear equations whose unknowns are integer numbers of turns.
#[derive(Debug)]
pub(super) struct EquationSystem {
    unknowns: u32,
    residues: [Triangular; 2],
}

/// Equations modulo a prime, each solved for its last unknown.
#[derive(Debug)]
struct Triangular {
    prime: u64,
    rows: BTreeMap<u32, Row>,
}

#[derive(Debug, Clone, Default)]
struct Row {
    /// The coefficients by unknown; none of them is 0.
    terms: BTreeMap<u32, u64>,
    sum: u64,
}

impl EquationSystem {
    pub(super) fn new() -> Self {
        Self {
            unknowns: 0,
            residues: PRIMES.map(|prime| Triangular { prime, rows: BTreeMap::new() }),
        }
    }

    pub(super) fn new_unknown(&mut self) -> u32 {
        self.unknowns += 1;
        self.unknowns - 1
    }

    /// Adds Σ coefficient · unknown = `sum`. Returns false, and adds nothing, if that contradicts the system.
    pub(super) fn add(&mut self, terms: &[(u32, i64)], sum: i64) -> bool {
        let reduced = self.residues.each_ref().map(|r| r.reduced(terms, sum));
        let is_possible = |row: &Row| row.sum == 0 || !row.terms.is_empty();
        if !reduced.iter().all(is_possible) {
            return false;
        }
        for (residue, row) in self.residues.iter_mut().zip(reduced) {
            if let Some((&last, _)) = row.terms.last_key_value() {
                residue.rows.insert(last, row);
            }
        }
        true
    }
}

impl Triangular {
    /// The equation reduced by all rows, its last coefficient scaled to 1.
    fn reduced(&self, terms: &[(u32, i64)], sum: i64) -> Row {
        let mut row = Row { terms: BTreeMap::new(), sum: self.residue(sum) };
        for &(unknown, coefficient) in terms {
            self.add(&mut row, unknown, self.residue(coefficient));
        }
        while let Some((&last, &coefficient)) = row.terms.last_key_value() {
            let Some(solved) = self.rows.get(&last) else {
                self.divide(&mut row, coefficient);
                break;
            };
            let negative = self.prime - coefficient;
            for (&unknown, &coefficient) in &solved.terms {
                self.add(&mut row, unknown, coefficient * negative % self.prime);
            }
            row.sum = (row.sum + solved.sum * negative) % self.prime;
        }
        row
    }

    fn residue(&self, number: i64) -> u64 {
        number.rem_euclid(self.prime.cast_signed()).unsigned_abs()
    }

    fn add(&self, row: &mut Row, unknown: u32, coefficient: u64) {
        let known = row.terms.get(&unknown).copied().unwrap_or(0);
        let sum = (known + coefficient) % self.prime;
        if sum == 0 {
            row.terms.remove(&unknown);
        } else {
            row.terms.insert(unknown, sum);
        }
    }

    fn divide(&self, row: &mut Row, divisor: u64) {
        let inverse = self.power(divisor, self.prime - 2);
        for coefficient in row.terms.values_mut() {
            *coefficient = *coefficient * inverse % self.prime;
        }
        row.sum = row.sum * inverse % self.prime;
    }

    fn power(&self, base: u64, mut exponent: u64) -> u64 {
        let (mut result, mut square) = (1, base);
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = result * square % self.prime;
            }
            square = square * square % self.prime;
            exponent >>= 1;
        }
        result
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equations_that_contradict_each_other_are_refused_and_others_are_not() {
        let mut system = EquationSystem::new();
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
    fn what_is_solvable_in_halves_only_is_refused() {
        let mut system = EquationSystem::new();
        let [x, y] = [(); 2].map(|()| system.new_unknown());
        assert!(system.add(&[(x, 1), (y, -1)], 0));
        assert!(!system.add(&[(x, 1), (y, 1)], 1), "2 x = 1");
        assert!(system.add(&[(x, 1), (y, 1)], 2));
    }

    #[test]
    fn equations_with_a_known_solution_are_never_refused() {
        use foldmotion_random::Random;
        let mut random = Random::new(3);
        let mut system = EquationSystem::new();
        let solution: Vec<i64> = (0..40)
            .map(|_| {
                system.new_unknown();
                random.integer(3)
            })
            .collect();
        let mut is_solved = false;
        for _ in 0..300 {
            let terms: Vec<(u32, i64)> =
                (0..4).map(|_| (random.index(40) as u32, random.integer(1))).collect();
            let sum: i64 = terms.iter().map(|&(u, c)| c * solution[u as usize]).sum();
            assert!(system.add(&terms, sum));
            if system.residues.iter().all(|r| r.rows.len() == 40) {
                is_solved = true;
                assert!(!system.add(&[(0, 1)], solution[0] + 1));
            }
        }
        assert!(is_solved);
    }
}
