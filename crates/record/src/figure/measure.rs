//! Dimension lines: a length with its words, beside the state it belongs to.

use glam::{DVec2, DVec3};

use super::FigureState;
use super::bounds::{INK, outer_edges};
use crate::drawing::words_width;
use crate::{Anchor, Camera, Drawing, RecordError, Stroke};

/// A length shorter than this on the page has no dimension line.
const SHORTEST: f64 = 2.0;

/// In sizes of letters: the distance of lines from what is measured, where the lines to their ends begin, how far these
/// go on, and how far words are from the line.
const OFF: f64 = 0.6;
const CLEAR: f64 = 0.15;
const BEYOND: f64 = 0.25;
const TO_WORDS: f64 = 0.55;

/// Half a tick along and across its line, in sizes of letters; less where what is measured is short.
const TICK: f64 = 0.2;

/// Words are at most this much wider than the font of the project makes them, where a viewer of SVG has it not.
const OTHER_FONT: f64 = 1.2;

/// The rise and the fall of letters about the middle of words, in sizes of letters.
const HALF: f64 = 0.5;

/// A dimension line in the view.
#[derive(Debug, Clone)]
pub(super) struct Measure<'a> {
    /// On the screen, y down.
    ends: [DVec2; 2],
    /// The direction from what is measured to the line.
    out: DVec2,
    words: &'a str,
}

/// The dimension lines of `state`, seen by `camera`.
pub(super) fn measures<'a>(state: &'a FigureState<'_>, camera: &Camera) -> Vec<Measure<'a>> {
    let project = |point: DVec3| camera.project(point).truncate();
    let own = state.dimensions.iter().map(|dimension| {
        let ends = dimension.ends.map(project);
        (ends, project(dimension.inside), &dimension.words)
    });
    let bounds = state.bounds.iter().flat_map(|bounds| {
        let edges = outer_edges(bounds, camera).into_iter();
        edges.zip(&bounds.sizes).map(|((ends, inside), words)| (ends, inside, words))
    });
    let measure = |([a, b], inside, words): ([DVec2; 2], DVec2, &'a String)| {
        let from_inside = 0.5 * (a + b) - inside;
        let out = from_inside.reject_from((b - a).normalize_or(DVec2::X));
        Measure { ends: [a, b], out: out.normalize_or(DVec2::Y), words }
    };
    let all = own.chain(bounds).filter(|(_, _, words)| !words.is_empty());
    all.map(measure).collect()
}

impl Measure<'_> {
    /// The points of the state at which something is drawn, each with the box around it that needs room.
    pub(super) fn boxes(&self, letters: f64) -> Result<[(DVec2, [DVec2; 2]); 3], RecordError> {
        let [a, b] = self.ends;
        let end = self.out * (OFF * letters);
        let tick = DVec2::splat(1.5 * TICK * letters);
        let around_end = [end - tick, end + tick];
        let middle = 0.5 * (a + b);
        Ok([(a, around_end), (b, around_end), (middle, self.words_box(letters)?)])
    }

    fn anchor(&self) -> Anchor {
        match self.out.x {
            x if x > 0.35 => Anchor::Start,
            x if x < -0.35 => Anchor::End,
            _ => Anchor::Middle,
        }
    }

    /// Where the words are anchored, from the middle of what is measured.
    fn to_words(&self, letters: f64) -> DVec2 {
        let far = match self.anchor() {
            Anchor::Middle => OFF + TO_WORDS + HALF,
            _ => OFF + TO_WORDS,
        };
        self.out * (far * letters)
    }

    /// The box of the words around the middle of what is measured.
    fn words_box(&self, letters: f64) -> Result<[DVec2; 2], RecordError> {
        let width = OTHER_FONT * words_width(self.words, letters)?;
        let [left, right] = match self.anchor() {
            Anchor::Start => [0.0, width],
            Anchor::Middle => [-0.5 * width, 0.5 * width],
            Anchor::End => [-width, 0.0],
        };
        let at = self.to_words(letters);
        let half = HALF * letters;
        Ok([at + DVec2::new(left, -half), at + DVec2::new(right, half)])
    }

    /// Draws it, moved by `shift`.
    pub(super) fn draw(&self, drawing: &mut Drawing, shift: DVec2, letters: f64, width: f64) {
        let [a, b] = self.ends.map(|end| end + shift);
        if a.distance(b) < SHORTEST {
            return;
        }
        let along = |part: f64| self.out * (part * letters);
        let leader = |end: DVec2| [end + along(CLEAR), end + along(OFF + BEYOND)];
        let line = [a + along(OFF), b + along(OFF)];
        // A tick across the line at 45°, as in drawings of buildings.
        let slant = (b - a).normalize_or(DVec2::X) + self.out;
        let half = slant * (TICK * letters).min(0.25 * a.distance(b));
        let tick = |end: DVec2| [end - half, end + half];
        let lines = vec![line, leader(a), leader(b)];
        drawing.lines(lines, Stroke::new(INK, width));
        drawing.lines(line.map(tick).to_vec(), Stroke::new(INK, 1.5 * width));
        // The base line lies below the middle of letters.
        let base = DVec2::new(0.0, 0.35 * letters);
        let at = 0.5 * (a + b) + self.to_words(letters) + base;
        drawing.words(at, self.words, letters, self.anchor());
    }
}
