//! The foot of a strip: a bar of scale, samples of the lines, what colours stand for.

use foldmotion_pattern::Assignment;
use glam::DVec2;

use super::layout::Layout;
use super::{Legend, Pose, StripOptions};
use crate::drawing::words_width;
use crate::{Anchor, Drawing, RecordError, Stroke, colour_of};

/// The height of a row of keys in sizes of letters, with a scale of colours and without.
const ROW: [f64; 2] = [3.6, 2.0];

/// The colour of bars and ticks.
const INK: [u8; 3] = [38, 38, 42];

/// The radius of a ring in sizes of letters, and its sides.
const RING: f64 = 0.5;
const RING_SIDES: u32 = 32;

/// Steps of the colour scale.
const STEPS: u32 = 64;

/// The part of the page's width that the bar of scale takes at most.
const BAR: f64 = 0.2;

/// One thing at the foot.
enum Key<'a> {
    Line(Assignment, &'static str),
    Mark,
    Spot,
    Values(&'a Legend),
}

impl Key<'_> {
    /// In sizes of letters, without the words.
    fn sample(&self) -> f64 {
        match self {
            Self::Line(..) => 3.5,
            Self::Mark | Self::Spot => 1.6,
            Self::Values(_) => 14.0,
        }
    }

    fn words(&self) -> &str {
        match self {
            Self::Line(_, words) => words,
            Self::Mark => "penetrating",
            Self::Spot => "penetrates first here",
            // The title stands above.
            Self::Values(_) => "",
        }
    }

    fn width(&self, letters: f64) -> Result<f64, RecordError> {
        let beside = (self.sample() + 2.0) * letters + words_width(self.words(), letters)?;
        match self {
            Self::Values(legend) => {
                let title = words_width(&legend.title, letters)? + 2.0 * letters;
                Ok(beside.max(title))
            }
            _ => Ok(beside),
        }
    }
}

fn keys<'a>(poses: &[Pose<'_>], options: &'a StripOptions) -> Vec<Key<'a>> {
    let mut keys = Vec::new();
    if options.has_key {
        keys.push(Key::Line(Assignment::Mountain, "mountain"));
        keys.push(Key::Line(Assignment::Valley, "valley"));
    }
    if poses.iter().any(|pose| pose.marked.contains(&true)) {
        keys.push(Key::Mark);
    }
    if poses.iter().any(|pose| pose.spot.is_some()) {
        keys.push(Key::Spot);
    }
    keys.extend(options.legend.as_ref().map(Key::Values));
    keys
}

/// For each key, and the bar of scale before them, its row and its distance from the left.
fn places(
    keys: &[Key<'_>],
    options: &StripOptions,
    letters: f64,
    inner: f64,
) -> Result<Vec<(usize, f64)>, RecordError> {
    let bar = if options.unit.is_empty() {
        0.0
    } else {
        BAR * inner + 2.0 * letters
    };
    let (mut row, mut x) = (0, bar);
    let mut places = vec![(0, 0.0)];
    for key in keys {
        let width = key.width(letters)?;
        if x > 0.0 && x + width > inner {
            (row, x) = (row + 1, 0.0);
        }
        places.push((row, x));
        x += width;
    }
    Ok(places)
}

/// The height of a row.
fn row(options: &StripOptions, letters: f64) -> f64 {
    ROW[usize::from(options.legend.is_none())] * letters
}

/// The height of the foot.
pub(super) fn height(
    poses: &[Pose<'_>],
    options: &StripOptions,
    letters: f64,
    inner: f64,
) -> Result<f64, RecordError> {
    let keys = keys(poses, options);
    if keys.is_empty() && options.unit.is_empty() {
        return Ok(0.0);
    }
    let places = places(&keys, options, letters, inner)?;
    let rows = places.last().map_or(0, |place| place.0) + 1;
    Ok(row(options, letters) * rows as f64)
}

/// Draws the foot.
pub(super) fn draw(
    drawing: &mut Drawing,
    poses: &[Pose<'_>],
    options: &StripOptions,
    layout: &Layout,
) -> Result<(), RecordError> {
    let (corner, inner) = layout.foot;
    let keys = keys(poses, options);
    let places = places(&keys, options, layout.letters, inner)?;
    let high = row(options, layout.letters);
    let mut ats = places.into_iter().map(|(row, x)| {
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

/// A ring around `centre`, between light lines so that it shows on any ground.
pub(super) fn ring(drawing: &mut Drawing, centre: DVec2, color: [u8; 3], letters: f64) {
    let point = |k: u32| {
        let turn = f64::from(k) / f64::from(RING_SIDES) * std::f64::consts::TAU;
        centre + DVec2::from_angle(turn) * (RING * letters)
    };
    for (color, width) in [([u8::MAX; 3], 0.35), (color, 0.18)] {
        let stroke = Stroke::new(color, width * letters);
        drawing.line((0..=RING_SIDES).map(point), stroke);
    }
}

/// The colours between two points, the title above, the range below.
fn values(drawing: &mut Drawing, legend: &Legend, [start, end]: [DVec2; 2], letters: f64) {
    let step = (end - start) / f64::from(STEPS);
    let half = DVec2::new(0.0, 0.3 * letters);
    for k in 0..STEPS {
        let (left, right) = (f64::from(k), f64::from(k + 1));
        let [a, b] = [left, right].map(|place| start + step * place);
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
