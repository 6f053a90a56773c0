//! A square of the screen.

use glam::DVec2;

/// Samples a pixel.
pub(crate) const SAMPLES: usize = 16;

/// One bit a sample of a pixel.
pub(crate) type Mask = u16;

/// How far the corners of a pixel are from its centre.
pub(crate) const CORNER: f64 = 0.5 * std::f64::consts::SQRT_2;

/// The offsets of the samples of a pixel from its centre, x and y: a Hammersley set, which has one in each of the 4 × 4
/// cells and in each of 16 rows and columns, so that steep and flat edges get 16 steps where a regular grid has 4.
const OFFSETS: [[f64; SAMPLES]; 2] = {
    let mut offsets = [[0.0; SAMPLES]; 2];
    let mut k = 0;
    while k < SAMPLES {
        let mirrored = (k.reverse_bits() >> (usize::BITS - SAMPLES.ilog2())) & (SAMPLES - 1);
        offsets[0][k] = (k as f64 + 0.5) / SAMPLES as f64 - 0.5;
        offsets[1][k] = (mirrored as f64 + 0.5) / SAMPLES as f64 - 0.5;
        k += 1;
    }
    offsets
};

/// The points within `half` of `centre` along x and y, in pixels.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Square {
    pub(crate) centre: DVec2,
    pub(crate) half: f64,
}

impl Square {
    /// The pixel around `centre`.
    pub(crate) fn pixel(centre: DVec2) -> Self {
        Self { centre, half: 0.5 }
    }

    /// How far its corners are from its centre.
    pub(crate) fn corner(&self) -> f64 {
        2.0 * CORNER * self.half
    }
}

/// Sample `k` of the pixel around `centre`.
#[inline]
pub(crate) fn sample(centre: DVec2, k: usize) -> DVec2 {
    DVec2::new(centre.x + OFFSETS[0][k], centre.y + OFFSETS[1][k])
}

/// `value` at the samples of the pixel around `centre`: one loop without branches, so that it runs in vector registers.
#[inline]
pub(crate) fn at_samples<T: Copy + Default>(
    centre: DVec2,
    value: impl Fn(DVec2) -> T,
) -> [T; SAMPLES] {
    let mut values = [T::default(); SAMPLES];
    for (k, found) in values.iter_mut().enumerate() {
        *found = value(sample(centre, k));
    }
    values
}

/// The samples whose values pass `test`.
#[inline]
pub(crate) fn mask(values: &[f64; SAMPLES], test: impl Fn(f64) -> bool) -> Mask {
    let mut mask = 0;
    for (k, &value) in values.iter().enumerate() {
        mask |= Mask::from(test(value)) << k;
    }
    mask
}

/// The samples in `mask`, in order.
pub(crate) fn members(mut mask: Mask) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let k = mask.trailing_zeros() as usize;
        mask &= mask.wrapping_sub(1);
        (k < SAMPLES).then_some(k)
    })
}
