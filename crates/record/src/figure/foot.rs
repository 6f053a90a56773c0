//! The foot of a strip, drawn.

use glam::DVec2;

use super::keys::{BAR, Key, keys, positions, row};
use super::layout::Layout;
use super::spot::ring;
use super::{FigureState, Legend, StripOptions};
use crate::{Anchor, Drawing, RecordError, Stroke, colour_of};

/// The colour of bars and ticks.
const INK: [u8; 3] = [38, 38, 42];

/// Steps of the colour scale.
const STEPS: u32 = 64;

/// Draws the foot.
pub(super) fn draw(
    drawing: &mut Drawing,
    states: &[FigureState<'_>],
    options: &StripOptions,
    layout: &Layout,
) -> Result<(), RecordError> {
    let (corner, inner) = layout.foot;
    let keys = keys(states, options);
    let positions = positions(&keys, options, layout.letters, inner)?;
    let high = row(options, layout.letters);
    let mut ats = positions.into_iter().map(|(row, x)| {
        let y = high * (row as f64 + 0.5);
        corner + DVec2::new(x, y)
    });
    if let Some(at) = ats.next().filter(|_| !options.unit.is_empty()) {
        scale_bar(drawing, at, options, layout);
    }
    for (key, at) in keys.iter().zip(ats) {
        draw_key(drawing, key, at, options, layout);
    }
    Ok(())
}

/// A bar of 1, 2 or 5 times a power of ten, at most [`BAR`] of the page's width.
fn scale_bar(drawing: &mut Drawing, at: DVec2, options: &StripOptions, layout: &Layout) {
    let letters = layout.letters;
    let most = (BAR * layout.foot.1 - 5.0 * letters).max(letters) / layout.scale;
    let decade = 10.0_f64.powf(most.log10().floor());
    let steps = [5.0, 2.0, 1.0].into_iter().map(|step| step * decade);
    let length = steps.into_iter().find(|&l| l <= most).unwrap_or(decade);
    let end = at + DVec2::new(length * layout.scale, 0.0);
    let stroke = Stroke::new(INK, 1.5 * layout.line_width);
    let tick = DVec2::new(0.0, 0.35 * letters);
    let ticks = [at, end].map(|p| [p - tick, p + tick]);
    drawing.lines(vec![[at, end], ticks[0], ticks[1]], stroke);
    let words = format!("{} {}", short(length), options.unit);
    let beside = end + DVec2::new(0.6 * letters, 0.35 * letters);
    drawing.words(beside, words, letters, Anchor::Start);
}

fn draw_key(
    drawing: &mut Drawing,
    key: &Key<'_>,
    at: DVec2,
    options: &StripOptions,
    layout: &Layout,
) {
    let letters = layout.letters;
    let end = at + DVec2::new(key.sample() * letters, 0.0);
    let half = DVec2::new(0.0, 0.5 * letters);
    match key {
        Key::Line(assignment, _) => {
            let color = options.style.line(*assignment);
            let width = 1.5 * layout.line_width;
            let stroke = options.lines.stroke(*assignment, color, width, 0);
            drawing.lines(vec![[at, end]], stroke);
        }
        Key::Mark => {
            let ring = [at - half, end - half, end + half, at + half];
            drawing.area(ring, options.style.mark);
        }
        Key::Spot => ring(drawing, 0.5 * (at + end), options.style.mark, letters),
        Key::Values(legend) => return values(drawing, legend, [at, end], letters),
    }
    let beside = end + DVec2::new(0.5 * letters, 0.35 * letters);
    drawing.words(beside, key.words(), letters, Anchor::Start);
}

/// The colours between two points, the title above, the range below.
fn values(drawing: &mut Drawing, legend: &Legend, [start, end]: [DVec2; 2], letters: f64) {
    let step = (end - start) / f64::from(STEPS);
    let half = DVec2::new(0.0, 0.3 * letters);
    for k in 0..STEPS {
        let (left, right) = (f64::from(k), f64::from(k + 1));
        let [a, b] = [left, right].map(|k| start + step * k);
        let ring = vec![a - half, b - half, b + half, a + half];
        let part = f64::from(k) / f64::from(STEPS - 1);
        drawing.shape(vec![ring], colour_of(part), 0.1);
    }
    let above = start - DVec2::new(0.0, 0.7 * letters);
    drawing.words(above, legend.title.clone(), letters, Anchor::Start);
    let below = DVec2::new(0.0, 1.3 * letters);
    let [low, high] = legend.range.map(short);
    drawing.words(start + below, low, 0.9 * letters, Anchor::Start);
    drawing.words(end + below, high, 0.9 * letters, Anchor::End);
}

/// Three digits.
fn short(value: f64) -> String {
    let size = value.abs();
    if value != 0.0 && !(1e-3..1e5).contains(&size) {
        return format!("{value:.1e}");
    }
    let decimals = (2.0 - size.max(1e-3).log10().floor()).clamp(0.0, 5.0);
    #[expect(clippy::cast_sign_loss, reason = "clamped to 0 to 5 before")]
    let text = format!("{value:.*}", decimals as usize);
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_three_digits() {
        let numbers = [0.0, 1.0, 0.2, 12.345, -0.005, 1234.5, 3e-7, 2e9];
        let expected = ["0", "1", "0.2", "12.3", "-0.005", "1234", "3.0e-7", "2.0e9"];
        assert_eq!(numbers.map(short), expected);
    }
}
