//! The keys at the foot of a strip and their positions: a scale bar, samples of the lines, the meaning of colours.

use super::{FigureState, Legend, StripOptions};
use crate::RecordError;
use crate::drawing::words_width;
use foldmotion_pattern::Assignment;

/// The height of a row of keys in sizes of letters, with a scale of colours and without.
const ROW: [f64; 2] = [3.6, 2.0];

/// The part of the page's width that the bar of scale takes at most.
pub(super) const BAR: f64 = 0.2;

/// One thing at the foot.
pub(super) enum Key<'a> {
    Line(Assignment, &'static str),
    Mark,
    Spot,
    Values(&'a Legend),
}

impl Key<'_> {
    /// In sizes of letters, without the words.
    pub(super) fn sample(&self) -> f64 {
        match self {
            Self::Line(..) => 3.5,
            Self::Mark | Self::Spot => 1.6,
            Self::Values(_) => 14.0,
        }
    }

    pub(super) fn words(&self) -> &str {
        match self {
            Self::Line(_, words) => words,
            Self::Mark => "penetrating",
            Self::Spot => "penetrates first here",
            // The title is above.
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

/// The keys of the states in their order.
pub(super) fn keys<'a>(states: &[FigureState<'_>], options: &'a StripOptions) -> Vec<Key<'a>> {
    let mut keys = Vec::new();
    if options.has_key {
        keys.push(Key::Line(Assignment::Mountain, "mountain"));
        keys.push(Key::Line(Assignment::Valley, "valley"));
    }
    if states.iter().any(|state| state.marked.contains(&true)) {
        keys.push(Key::Mark);
    }
    if states.iter().any(|state| state.spot.is_some()) {
        keys.push(Key::Spot);
    }
    keys.extend(options.legend.as_ref().map(Key::Values));
    keys
}

/// For each key, and the bar of scale before them, its row and its distance from the left.
pub(super) fn positions(
    keys: &[Key<'_>],
    options: &StripOptions,
    letters: f64,
    inner: f64,
) -> Result<Vec<(usize, f64)>, RecordError> {
    let bar = if options.unit.is_empty() { 0.0 } else { BAR * inner + 2.0 * letters };
    let (mut row, mut x) = (0, bar);
    let mut positions = vec![(0, 0.0)];
    for key in keys {
        let width = key.width(letters)?;
        if x > 0.0 && x + width > inner {
            (row, x) = (row + 1, 0.0);
        }
        positions.push((row, x));
        x += width;
    }
    Ok(positions)
}

/// The height of a row.
pub(super) fn row(options: &StripOptions, letters: f64) -> f64 {
    ROW[usize::from(options.legend.is_none())] * letters
}

/// The height of the foot.
pub(super) fn height(
    states: &[FigureState<'_>],
    options: &StripOptions,
    letters: f64,
    inner: f64,
) -> Result<f64, RecordError> {
    let keys = keys(states, options);
    if keys.is_empty() && options.unit.is_empty() {
        return Ok(0.0);
    }
    let positions = positions(&keys, options, letters, inner)?;
    let rows = positions.last().map_or(0, |position| position.0) + 1;
    Ok(row(options, letters) * rows as f64)
}
