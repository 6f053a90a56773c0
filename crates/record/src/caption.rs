//! Words and scales laid over a picture.

use glam::DVec2;

use crate::colour_map::colour_of;
use crate::{Anchor, Drawing, Image, PIXELS_A_UNIT, RecordError, Values};

/// The height of letters as a part of the picture's height.
const LETTERS: f64 = 0.034;

/// The least height of letters in pixels.
const LEAST_LETTERS: f64 = 9.0;

/// The overlay of a picture: how much of which ink each pixel takes.
#[derive(Debug, Clone)]
pub(crate) struct Overlay {
    at: [u32; 2],
    words: Image,
    /// Left, top, width and height of the colour scale.
    scale: Option<[u32; 4]>,
}

impl Overlay {
    /// The stage and the time, or `ending` instead, in the lower left corner.
    #[expect(clippy::cast_sign_loss, reason = "letters have a height")]
    pub(crate) fn caption(
        time: f64,
        ending: Option<&str>,
        size: [u32; 2],
    ) -> Result<Self, RecordError> {
        let text = ending.map_or_else(|| format!("{}, t = {time:.2}", stage(time)), str::to_owned);
        let letters = letters(size);
        let height = (2.0 * letters).round() as u32;
        let words = written(&[(0.5 * letters, &text)], [size[0], height], letters)?;
        Ok(Self { at: [0, size[1].saturating_sub(height)], words, scale: None })
    }

    /// The colour scale of `values` with their title and range, in the upper left corner.
    #[expect(clippy::cast_sign_loss, reason = "letters have a height")]
    pub(crate) fn legend(values: &Values, size: [u32; 2]) -> Result<Self, RecordError> {
        let letters = letters(size);
        let [left, thick] = [0.5 * letters, 0.7 * letters].map(|l| l.round() as u32);
        let width = (size[0] / 3).max(1);
        let [low, high] = values.range.map(short);
        let top = (1.7 * letters).round() as u32;
        let height = (3.8 * letters).round() as u32;
        let mut page = page([size[0], height])?;
        let line = |page: &mut Drawing, x: f64, y: f64, text: &str, anchor| {
            let unit = f64::from(PIXELS_A_UNIT);
            page.words(DVec2::new(x, y) / unit, text, letters / unit, anchor);
        };
        let right = f64::from(left + width);
        let (start, below) = (f64::from(left), 3.4 * letters);
        line(&mut page, start, 1.3 * letters, &values.title, Anchor::Start);
        line(&mut page, start, below, &low, Anchor::Start);
        line(&mut page, right, below, &high, Anchor::End);
        Ok(Self { at: [0, 0], words: page.image()?, scale: Some([left, top, width, thick]) })
    }

    /// Lays it over `image`; `alpha`, where given, covers what is written on.
    #[expect(clippy::cast_sign_loss, reason = "between two bytes")]
    pub(crate) fn draw(&self, image: &mut Image, mut alpha: Option<&mut [u8]>, ground: [u8; 3]) {
        let ink = ink(ground);
        let mut put = |x: u32, y: u32, colour: [u8; 3], part: f64| {
            let [x, y] = [x + self.at[0], y + self.at[1]];
            if x >= image.width || y >= image.height {
                return;
            }
            let index = (y * image.width + x) as usize;
            let mix = |from: u8, to: u8| {
                (f64::from(from) + (f64::from(to) - f64::from(from)) * part).round() as u8
            };
            let pixel = &mut image.pixels[index];
            *pixel = std::array::from_fn(|c| mix(pixel[c], colour[c]));
            if let Some(alpha) = &mut alpha {
                alpha[index] = mix(alpha[index], u8::MAX);
            }
        };
        for (index, pixel) in (0..).zip(&self.words.pixels) {
            let part = f64::from(u8::MAX - pixel[1]) / 217.0;
            if part > 0.0 {
                let [x, y] = [index % self.words.width, index / self.words.width];
                put(x, y, ink, part.min(1.0));
            }
        }
        let [left, top, width, height] = self.scale.unwrap_or_default();
        for x in 0..width {
            let colour = colour_of((f64::from(x) + 0.5) / f64::from(width));
            (0..height).for_each(|y| put(left + x, top + y, colour, 1.0));
        }
    }
}

/// Dark words on light ground, light ones on dark.
pub(crate) fn ink(ground: [u8; 3]) -> [u8; 3] {
    let [r, g, b] = ground.map(u32::from);
    if 2 * r + 4 * g + b > 7 * 110 { [38, 38, 42] } else { [235; 3] }
}

fn letters(size: [u32; 2]) -> f64 {
    (LETTERS * f64::from(size[1])).max(LEAST_LETTERS)
}

/// An empty page of at least `size` pixels.
fn page(size: [u32; 2]) -> Result<Drawing, RecordError> {
    Drawing::new(size.map(|side| side.div_ceil(PIXELS_A_UNIT)))
}

/// `lines` (left end, text) on one page, in pixels.
fn written(lines: &[(f64, &str)], size: [u32; 2], letters: f64) -> Result<Image, RecordError> {
    let mut page = page(size)?;
    let unit = f64::from(PIXELS_A_UNIT);
    for &(left, text) in lines {
        let at = DVec2::new(left, 1.3 * letters) / unit;
        page.words(at, text, letters / unit, Anchor::Start);
    }
    page.image()
}

/// A number in few digits.
fn short(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || (1e-3..1e4).contains(&size) {
        let text = format!("{value:.4}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        format!("{value:.2e}")
    }
}

/// The stage that a motion time belongs to.
pub(crate) fn stage(time: f64) -> &'static str {
    match time {
        t if t <= 0.0 => "deployed",
        t if t < 1.0 => "deployed to planar",
        t if t <= 1.0 => "planar",
        t if t < 2.0 => "planar to compact",
        t if t <= 2.0 => "compact",
        _ => "settling",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn captions_leave_ink_only_along_the_lower_edge_and_name_the_stage() {
        let mut image = Image { width: 121, height: 90, pixels: vec![[255; 3]; 121 * 90] };
        let overlay = Overlay::caption(0.5, None, [121, 90]).unwrap();
        overlay.draw(&mut image, None, [255; 3]);
        let dark = |rows: std::ops::Range<usize>| {
            let part = &image.pixels[rows.start * 121..rows.end * 121];
            part.iter().filter(|p| p[1] < 128).count()
        };
        assert!(dark(72..90) > 30 && dark(0..72) == 0);
        let ended = Overlay::caption(2.0, Some("jammed at t = 1.2"), [121, 90]).unwrap();
        let compact = Overlay::caption(2.0, None, [121, 90]).unwrap();
        assert_ne!(ended.words.pixels, compact.words.pixels);
        let names = [0.0, 0.5, 1.0, 1.5, 2.0, 2.1].map(stage);
        assert!(names.is_sorted_by(|a, b| a != b), "{names:?}");
    }

    #[test]
    fn numbers_are_short() {
        let texts = [0.0, 0.25, 1.0, -120.0, 1.0e-5].map(short);
        assert_eq!(texts, ["0", "0.25", "1", "-120", "1.00e-5"]);
    }
}
