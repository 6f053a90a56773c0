//! Seeded random numbers for the tests.

use glam::DVec3;

pub(super) struct Random(u64);

impl Random {
    pub(super) fn new(seed: u64) -> Self {
        Self(seed << 32)
    }

    fn number(&mut self) -> f64 {
        self.0 += 1;
        super::perturbation::scattered(self.0)
    }

    pub(super) fn index(&mut self, count: usize) -> usize {
        self.0 += 1;
        (super::perturbation::scrambled(self.0) % count as u64) as usize
    }

    /// An integer from −`most` to `most`.
    pub(super) fn whole(&mut self, most: i32) -> i64 {
        let count = 2 * most.unsigned_abs() as usize + 1;
        i64::from(self.index(count) as u32) - i64::from(most)
    }

    pub(super) fn vector(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number())
    }
}
