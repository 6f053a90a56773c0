//! The sheet without its background.
//!
//! A pixel is the mean of 16 samples in linear light; some of them see the sheet: C = F + (1 − a) B with the light F
//! of those and the background B. Drawn before two backgrounds the differences tell 1 − a, and since a is a multiple of
//! 1/16 they tell it exactly in spite of rounded bytes.

use glam::Vec3;

use crate::shade::{encoded, linear};
use crate::square::SAMPLES;
use crate::{Image, Style};

/// How far each pixel of `image`, drawn with `style`, covers its background; `draw` draws it in another style.
#[expect(clippy::cast_sign_loss, reason = "clamped to 0 to 255 before")]
pub(crate) fn uncovered(image: &Image, style: &Style, draw: impl Fn(&Style) -> Image) -> Vec<u8> {
    let far = |byte: u8| if byte < 128 { u8::MAX } else { 0 };
    let other = Style { background: style.background.map(far), ..style.clone() };
    let range = linear(style.background) - linear(other.background);
    let whole = range.abs().element_sum();
    let alpha = |(a, b): (&[u8; 3], &[u8; 3])| {
        if a == b {
            return u8::MAX;
        }
        let shown = (linear(*a) - linear(*b)).abs().element_sum() / whole;
        let samples = SAMPLES as f32;
        let covered = 1.0 - (shown * samples).round() / samples;
        (covered.clamp(0.0, 1.0) * 255.0).round() as u8
    };
    let drawn = draw(&other);
    image.pixels.iter().zip(&drawn.pixels).map(alpha).collect()
}

/// The colour of the sheet alone in a pixel, of which it covers the part `alpha` before `background`.
pub(crate) fn lifted(pixel: [u8; 3], alpha: u8, background: Vec3) -> [u8; 4] {
    let [r, g, b] = match alpha {
        0 => [0; 3],
        u8::MAX => pixel,
        _ => {
            let a = f32::from(alpha) / 255.0;
            encoded(((linear(pixel) - (1.0 - a) * background) / a).max(Vec3::ZERO))
        }
    };
    [r, g, b, alpha]
}
