//! A ring around a point of a picture.

use glam::DVec2;

use crate::Image;

/// Its radius as a part of the picture's shorter side, and the least one and the least half width of its line in
/// pixels.
const RADIUS: f64 = 0.035;
const LEAST_RADIUS: f64 = 5.0;
const LEAST_HALF: f64 = 0.75;

/// The width of its line, and of the light line on each side of it, as parts of the radius.
const WIDTH: f64 = 0.2;
const HALO: f64 = 0.12;

/// Draws a ring of colour `color` around `centre` over `image`; `alpha`, where given, covers what is drawn on.
#[expect(clippy::cast_sign_loss, reason = "kept within the picture's sides")]
pub(crate) fn ring(image: &mut Image, mut alpha: Option<&mut [u8]>, centre: DVec2, color: [u8; 3]) {
    let [width, height] = [image.width, image.height].map(f64::from);
    let radius = (RADIUS * width.min(height)).max(LEAST_RADIUS);
    let [half, halo] = [(0.5 * WIDTH * radius).max(LEAST_HALF), HALO * radius];
    let reach = radius + half + halo + 1.0;
    let range = |middle: f64, side: f64| {
        let end = |x: f64| x.clamp(0.0, side) as u32;
        end(middle - reach)..end((middle + reach).ceil())
    };
    for y in range(centre.y, height) {
        for x in range(centre.x, width) {
            let point = DVec2::new(f64::from(x), f64::from(y)) + 0.5;
            let off = (point.distance(centre) - radius).abs();
            let line = (half - off + 0.5).clamp(0.0, 1.0);
            let around = (half + halo - off + 0.5).clamp(0.0, 1.0);
            let index = (y * image.width + x) as usize;
            let mix = |from: u8, to: u8, part: f64| {
                (f64::from(from) + (f64::from(to) - f64::from(from)) * part).round() as u8
            };
            let pixel = &mut image.pixels[index];
            *pixel = std::array::from_fn(|c| mix(mix(pixel[c], u8::MAX, around), color[c], line));
            if let Some(alpha) = &mut alpha {
                alpha[index] = mix(alpha[index], u8::MAX, around);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ring_leaves_its_middle_and_all_beyond_it_and_stays_in_the_picture() {
        let ground = [10, 20, 30];
        let drawn = |centre: DVec2| {
            let mut image = Image { width: 200, height: 100, pixels: vec![ground; 200 * 100] };
            let mut alpha = vec![0; 200 * 100];
            ring(&mut image, Some(&mut alpha), centre, [233, 30, 160]);
            (image, alpha)
        };
        let centre = DVec2::new(120.5, 50.5);
        let (image, alpha) = drawn(centre);
        assert_eq!(image.pixel(120, 50), ground);
        assert_eq!(image.pixel(125, 50), [233, 30, 160]);
        for (index, (pixel, alpha)) in image.pixels.iter().zip(&alpha).enumerate() {
            let point = DVec2::new((index % 200) as f64, (index / 200) as f64) + 0.5;
            let is_far = point.distance(centre) > 7.5;
            assert!(!is_far || (*pixel == ground && *alpha == 0), "{point}");
        }
        for outside in [DVec2::splat(-500.0), DVec2::splat(1e9)] {
            assert!(drawn(outside).0.pixels.iter().all(|&p| p == ground));
        }
    }
}
