//! Seeded random numbers and shapes for the tests (`SplitMix64`, Steele, Lea and Flood 2014).
//!
//! Scenes of the oracles are named by their number, so the sequence for a seed must never change.

use glam::DVec3;

/// A stream of pseudo-random numbers.
#[derive(Debug, Clone)]
pub struct Random(u64);

impl Random {
    /// The stream that belongs to a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number in [−1, 1).
    pub fn number(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// An index from 0 to `count` − 1.
    pub fn index(&mut self, count: usize) -> usize {
        (self.bits() % count as u64) as usize
    }

    /// An integer from −`most` to `most`.
    pub fn integer(&mut self, most: i64) -> i64 {
        let count = 2 * most.unsigned_abs() + 1;
        (self.bits() % count).cast_signed() - most
    }

    /// A vector in the cube [−1, 1)³.
    pub fn vector(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number())
    }

    /// A triangle with corners in the cube [−`size`, `size`)³.
    pub fn triangle(&mut self, size: f64) -> [DVec3; 3] {
        [(); 3].map(|()| self.vector() * size)
    }
}
