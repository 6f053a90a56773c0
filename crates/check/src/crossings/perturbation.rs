//! Fixed random offsets that bring a motion into general position.

use glam::DVec3;

/// Offsets are at most this share of τ in each coordinate.
const OFFSET: f64 = 1.0 / 4096.0;

/// The offset of each of `count` vertices, at most `tolerance` / 4096 in each coordinate.
pub(super) fn offsets(count: usize, tolerance: f64) -> Vec<DVec3> {
    let offset = OFFSET * tolerance;
    let vertices = 0..count as u64;
    vertices.map(|v| [0, 1, 2].map(|k| offset * scattered(3 * v + k)).into()).collect()
}

/// A pseudo-random number in [−1, 1), the same on every machine.
pub(super) fn scattered(number: u64) -> f64 {
    (scrambled(number) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// The output function of `SplitMix64` (Steele, Lea and Flood 2014).
pub(super) fn scrambled(number: u64) -> u64 {
    let mut z = number.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
