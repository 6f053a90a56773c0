//! One state of a strip.

use foldmotion_pattern::{LayerOrder, Motion, Sheet};
use glam::DVec3;

use crate::caption::stage;
use crate::{Marks, RecordError, positions_at};

/// A box around a state, with its sizes.
#[derive(Debug, Clone, PartialEq)]
pub struct Bounds {
    /// The corner with the least coordinates.
    pub low: DVec3,
    /// The corner with the largest.
    pub high: DVec3,
    /// The text at an edge along x, y and z; empty: none.
    pub sizes: [String; 3],
    /// The text below the label, such as a closed form.
    pub words: String,
}

/// A length of a state, written beside it.
#[derive(Debug, Clone, PartialEq)]
pub struct Dimension {
    /// The two points whose distance is measured.
    pub ends: [DVec3; 2],
    /// A point on the other side than the words, such as the middle of the state.
    pub inside: DVec3,
    /// The text at the line, such as "h = 1 m".
    pub words: String,
}

/// One state of a strip.
#[derive(Debug, Clone, PartialEq)]
pub struct FigureState<'a> {
    /// One position for each vertex.
    pub positions: Vec<DVec3>,
    /// The order of the triangles that coincide.
    pub order: &'a LayerOrder,
    /// The label below the state.
    pub label: String,
    /// For each triangle whether it takes the colour of marks; empty: none does.
    pub marked: Vec<bool>,
    /// One value for each triangle, shown as its colour; one that is not a number shows the paper. Empty: none.
    pub values: Vec<f64>,
    /// One value for each edge, shown as the line's colour; one that is not a number shows the line. Empty: none.
    pub bars: Vec<f64>,
    /// A curve to compare with, drawn over the state; empty: none.
    pub target: Vec<DVec3>,
    /// The box around the state.
    pub bounds: Option<Bounds>,
    /// Lengths written beside it.
    pub dimensions: Vec<Dimension>,
    /// A point that takes a ring.
    pub spot: Option<DVec3>,
}

impl<'a> FigureState<'a> {
    /// The state at `positions` with `label` and nothing else.
    pub fn new(positions: Vec<DVec3>, order: &'a LayerOrder, label: impl Into<String>) -> Self {
        Self {
            positions,
            order,
            label: label.into(),
            marked: Vec::new(),
            values: Vec::new(),
            bars: Vec::new(),
            target: Vec::new(),
            bounds: None,
            dimensions: Vec::new(),
            spot: None,
        }
    }

    /// The state of `motion` at motion time `time`, labelled with time and stage, and with what `marks` mark then.
    ///
    /// Precondition: the times of the motion increase.
    pub fn at(motion: &'a Motion, marks: &Marks, time: f64) -> Self {
        let positions = positions_at(motion, time);
        let label = format!("t = {time}, {}", stage(time));
        let marked =
            if marks.is_empty() { Vec::new() } else { marks.at(&motion.sheet, time, time) };
        Self {
            marked,
            spot: marks.spot_at(&motion.sheet, &positions, time),
            ..Self::new(positions, &motion.compact_order, label)
        }
    }

    /// Refuses lists that do not fit `sheet`, and points that are not finite.
    pub(super) fn check(&self, sheet: &Sheet, frame: usize) -> Result<(), RecordError> {
        let lists = [
            (self.marked.len(), sheet.faces.len()),
            (self.values.len(), sheet.faces.len()),
            (self.bars.len(), sheet.edges.len()),
        ];
        for (found, expected) in lists {
            if found != 0 && found != expected {
                return Err(RecordError::ValueCount { frame, found, expected });
            }
        }
        let corners = self.bounds.iter().flat_map(|b| [b.low, b.high]);
        let ends = (self.dimensions.iter()).flat_map(|d| [d.ends[0], d.ends[1], d.inside]);
        let others = corners.chain(ends).chain(self.spot);
        let mut points = self.target.iter().copied().chain(others).enumerate();
        match points.find(|(_, p)| !p.is_finite()) {
            None => Ok(()),
            Some((vertex, position)) => {
                Err(RecordError::NotFinite { frame, vertex, position: position.to_array() })
            }
        }
    }

    /// All points that are shown.
    pub(super) fn points(&self) -> impl Iterator<Item = DVec3> {
        let corners = self.bounds.iter().flat_map(Bounds::corners);
        let points = self.positions.iter().chain(&self.target).copied();
        let ends = self.dimensions.iter().flat_map(|d| d.ends);
        points.chain(corners).chain(ends)
    }

    /// The lines of text below the state.
    pub(super) fn captions(&self) -> impl Iterator<Item = &str> {
        let words = self.bounds.as_ref().map(|bounds| &bounds.words[..]);
        let lines = [Some(&self.label[..]), words].into_iter().flatten();
        lines.filter(|line| !line.is_empty())
    }
}

impl Bounds {
    /// Corner k has the larger coordinate i where bit i of k is set.
    pub(super) fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|k| {
            let pick = |i: usize| {
                if k >> i & 1 == 1 { self.high[i] } else { self.low[i] }
            };
            DVec3::new(pick(0), pick(1), pick(2))
        })
    }
}
