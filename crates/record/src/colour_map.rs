//! The colours that show values.
//!
//! Cividis (Nuñez, Anderton and Renslow 2018, Optimizing colormaps with consideration for color vision deficiency,
//! PLoS ONE 13(7)): it looks nearly the same to people with red–green colour blindness, and its lightness rises evenly.

/// 32 samples of cividis at even distances from 0 to 1, of the 256 of matplotlib (public domain, CC0).
const SAMPLES: [[u8; 3]; 32] = [
    [0, 34, 78],
    [0, 40, 92],
    [0, 46, 107],
    [7, 51, 112],
    [28, 57, 111],
    [41, 63, 110],
    [51, 68, 108],
    [61, 74, 108],
    [69, 80, 108],
    [77, 85, 108],
    [85, 91, 109],
    [92, 97, 110],
    [99, 103, 112],
    [107, 109, 114],
    [114, 114, 116],
    [121, 120, 119],
    [128, 126, 120],
    [136, 133, 120],
    [144, 139, 120],
    [152, 145, 119],
    [160, 151, 117],
    [168, 158, 115],
    [176, 164, 113],
    [185, 171, 109],
    [193, 178, 106],
    [202, 185, 101],
    [211, 192, 96],
    [220, 200, 89],
    [229, 207, 82],
    [238, 215, 72],
    [248, 223, 60],
    [254, 232, 56],
];

/// The sRGB colour of `part`, 0 to 1; less and more get the first and the last colour, what is not a number the first.
#[expect(clippy::cast_sign_loss, reason = "clamped to 0 to 1 before")]
pub fn colour_of(part: f64) -> [u8; 3] {
    let position = part.clamp(0.0, 1.0) * (SAMPLES.len() - 1) as f64;
    let index = (position as usize).min(SAMPLES.len() - 2);
    let rest = (position - index as f64).max(0.0);
    let [low, high] = [SAMPLES[index], SAMPLES[index + 1]];
    std::array::from_fn(|c| {
        let (low, high) = (f64::from(low[c]), f64::from(high[c]));
        (low + (high - low) * rest).round() as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lightness_rises_from_the_first_to_the_last_colour() {
        let light = |part: f64| {
            let [r, g, b] = crate::shade::linear(colour_of(part)).to_array();
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        for k in 0..200_i32 {
            let part = f64::from(k) / 200.0;
            assert!(light(part) <= light(part + 0.005) + 1e-4, "{part}");
        }
        assert_eq!(colour_of(-1.0), SAMPLES[0]);
        assert_eq!(colour_of(2.0), SAMPLES[31]);
        assert_eq!(colour_of(f64::NAN), SAMPLES[0]);
    }
}
