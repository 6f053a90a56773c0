//! The sheet, its motion and its colours, as the page's scripts read them.
//!
//! Positions are whole numbers of steps, each key frame as the change from the one before: a step is an eighth of what
//! rounding may take of the tolerance at least, so that most changes fit a byte and deflate well.

use foldmotion_pattern::{Assignment, Edge, Motion};
use glam::DVec3;
use serde_json::{Value, json};

use super::payload::Payload;
use super::{Page, PageOptions, ROUNDING};
use crate::colour_map::colour_of;
use crate::{KeyFrames, Layers, Values, View};

/// Steps of the range of values; one more means no number.
const LEVELS: u8 = 254;

/// Samples of the colour map.
const COLOURS: usize = 32;

/// The header, and the arrays it describes.
pub(super) fn scene(page: &Page<'_>, options: &PageOptions, keys: &KeyFrames) -> (Value, Vec<u8>) {
    let motion = page.motion;
    let mut payload = Payload::default();
    let grid = Grid::new(motion, options.tolerance * motion.sheet.unit_length);
    payload.steps("positions", grid.changes(motion, keys));
    let kinds = add_sheet(motion, &mut payload);
    for (index, values) in page.values.iter().enumerate() {
        payload.bytes(&format!("values{index}"), levels(values));
    }
    let style = &options.style;
    let times: Vec<f64> = motion.frames.iter().map(|frame| frame.time).collect();
    let values = |v: &Values| json!({"title": v.title, "range": v.range});
    let header = json!({
        "arrays": payload.directory(),
        "origin": grid.origin.to_array(),
        "step": grid.step,
        "largestError": keys.error + grid.error(),
        "unitLength": motion.sheet.unit_length,
        "keys": keys.frames,
        "times": times,
        "kinds": kinds,
        "values": page.values.iter().map(values).collect::<Vec<_>>(),
        "levels": LEVELS,
        "colours": (0..COLOURS).map(|k| colour_of(k as f64 / (COLOURS - 1) as f64)).collect::<Vec<_>>(),
        "marks": marks(page),
        "seconds": options.seconds,
        "views": View::NAMES.map(|(name, view)| json!([name, axes(view)])),
        "start": axes(options.view),
        "style": {
            "front": style.front, "back": style.back, "mark": style.mark, "mountain": style.mountain,
            "valley": style.valley, "border": style.border, "lineWidth": style.line_width,
        },
    });
    (header, payload.bytes)
}

/// Adds the data that are the same in every state and returns the names of the kinds of facets.
fn add_sheet(motion: &Motion, payload: &mut Payload) -> Vec<Value> {
    let sheet = &motion.sheet;
    payload.indices("faces", sheet.faces.iter().flatten().copied());
    payload.indices("faceFacets", sheet.face_facets.iter().copied());
    let mut kinds: Vec<Value> = Vec::new();
    let facets = sheet.facets.iter().flat_map(|facet| {
        // The names of a kind always serialise.
        let name = serde_json::to_value(facet.kind).unwrap_or_default();
        let kind = kinds.iter().position(|k| *k == name).unwrap_or(kinds.len());
        if kind == kinds.len() {
            kinds.push(name);
        }
        [facet.row, facet.column, kind as u32]
    });
    payload.indices("facets", facets);
    payload.bytes("lines", lines(motion));
    let folded = motion.frames.last().map_or(&[][..], |f| &f.positions);
    let layers = Layers::new(&motion.sheet, &motion.compact_order, folded);
    payload.steps("lifts", layers.lifts);
    payload.indices("pairs", layers.pairs.into_iter().flatten());
    kinds
}

/// The line on the side opposite each corner of each triangle: 0 none, 1 mountain, 2 valley, 3 border.
fn lines(motion: &Motion) -> Vec<u8> {
    let sheet = &motion.sheet;
    let mut lines = vec![0; 3 * sheet.faces.len()];
    let line = |edge: &Edge| match edge.assignment {
        Assignment::Facet => 0,
        Assignment::Mountain => 1,
        Assignment::Valley => 2,
        Assignment::Border | Assignment::Free => 3,
    };
    for edge in &sheet.edges {
        for face in edge.faces.into_iter().flatten() {
            let corners = &sheet.faces[face as usize];
            if let Some(apex) = corners.iter().position(|v| !edge.vertices.contains(v)) {
                lines[3 * face as usize + apex] = line(edge);
            }
        }
    }
    lines
}

/// Values as steps of their range, each frame as the change from the one before, modulo 256.
fn levels(values: &Values) -> Vec<u8> {
    let [low, high] = values.range;
    #[expect(clippy::cast_sign_loss, reason = "clamped to 0 to LEVELS")]
    let level = |value: f64| {
        let part = ((value - low) / (high - low)).clamp(0.0, 1.0);
        if part.is_nan() { u8::MAX } else { (part * f64::from(LEVELS)).round() as u8 }
    };
    let mut before = vec![0_u8; values.frames.first().map_or(0, Vec::len)];
    let mut changes = Vec::with_capacity(before.len() * values.frames.len());
    for frame in &values.frames {
        for (&value, last) in frame.iter().zip(&mut before) {
            let now = level(value);
            changes.push(now.wrapping_sub(*last));
            *last = now;
        }
    }
    changes
}

/// The spans of marks within the motion, with their triangles.
fn marks(page: &Page<'_>) -> Vec<Value> {
    let times = page.motion.frames.iter().map(|frame| frame.time);
    let [first, last] = [f64::min, f64::max].map(|end| times.clone().fold(f64::NAN, end));
    let is_there = |&(span, face): &([f64; 2], u32)| {
        let [from, to] = span;
        from <= to && from <= last && to >= first && (face as usize) < page.motion.sheet.faces.len()
    };
    let marks = page.marks.spans().filter(is_there);
    let entry = |([from, to], face): ([f64; 2], u32)| json!([from.max(first), to.min(last), face]);
    marks.map(entry).collect()
}

/// Right, up and towards the viewer.
fn axes(view: View) -> [[f64; 3]; 3] {
    view.axes().map(|axis| axis.to_array())
}

/// Positions rounded to steps.
struct Grid {
    origin: DVec3,
    step: f64,
}

impl Grid {
    /// Steps that keep rounding within its part of `tolerance`, or 2^30 across the motion where those would be finer.
    fn new(motion: &Motion, tolerance: f64) -> Self {
        let points = || motion.frames.iter().flat_map(|f| &f.positions);
        let low = points().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = points().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        let span = (high - low).max_element();
        let step = (ROUNDING * tolerance).max(span * 0.5_f64.powi(30));
        Self { origin: low, step }
    }

    /// The largest distance of a rounded position from where it was.
    fn error(&self) -> f64 {
        0.5 * 3.0_f64.sqrt() * self.step
    }

    fn changes(&self, motion: &Motion, keys: &KeyFrames) -> Vec<i32> {
        let mut before = vec![[0_i32; 3]; motion.sheet.vertices.len()];
        let mut changes = Vec::with_capacity(3 * before.len() * keys.frames.len());
        for &key in &keys.frames {
            for (&position, last) in motion.frames[key].positions.iter().zip(&mut before) {
                let rounded = ((position - self.origin) / self.step).round();
                let now = rounded.to_array().map(|x| x as i32);
                changes.extend((0..3).map(|i| now[i] - last[i]));
                *last = now;
            }
        }
        changes
    }
}
