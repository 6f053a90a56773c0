//! Seeded random numbers for the tests.

use glam::DVec3;

pub(super) struct Random(u64);

impl Random {
    pub(super) fn new(seed: u64) -> Self {
        Self(seed << 32)
    }

    fn number(&mut self) -> f64 {
        self.0 += 1;
        super::scattered(self.0)
    }

    pub(super) fn index(&mut self, count: usize) -> usize {
        ((self.number() + 1.0) * 0.5 * count as f64) as usize % count
    }

    pub(super) fn vector(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number())
    }
}
