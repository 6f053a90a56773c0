//! What was done about lines that nearly meet, and which creases are lost.

use glam::DVec2;

use super::drawing::{Line, Role};
use super::{ImportError, Source};

/// The most creases left out that are named.
const MOST_NAMED: usize = 100;
/// The part of the length of the creases beyond which a pattern that loses it is refused.
const MOST_DROPPED: f64 = 0.5;

/// What was done about lines that nearly meet, and which creases were left out.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mending {
    /// How far apart two points may lie to be one vertex, in units of the file; 0 where the file lists facets that are
    /// kept as they are.
    pub tolerance: f64,
    /// Whether the tolerance was chosen from the drawing.
    pub chosen: bool,
    /// Ends of lines that became a vertex near them.
    pub merged: usize,
    /// Vertices beside a line that it now passes through.
    pub snapped: usize,
    /// The number of creases, or parts of creases, left out because they end nowhere or lie beside the sheet.
    pub dropped: usize,
    /// Their length in all, in units of the file.
    pub dropped_length: f64,
    /// Which: the first hundred.
    pub dropped_creases: Vec<DroppedCrease>,
    /// The length of all creases drawn, in units of the file.
    pub crease_length: f64,
}

/// A crease, or a part of one, that was left out.
#[derive(Debug, Clone, PartialEq)]
pub struct DroppedCrease {
    /// The element of the file.
    pub source: Source,
    /// The point half-way, in the coordinates of the sheet.
    pub middle: DVec2,
    /// Its length, in units of the file.
    pub length: f64,
}

impl Mending {
    /// Notes the length of a drawn line.
    pub(super) fn draw(&mut self, line: &Line, points: &[DVec2]) {
        if is_crease(line.role) {
            self.crease_length += length(line, points);
        }
    }

    /// Notes a line that is left out.
    pub(super) fn drop(&mut self, line: &Line, points: &[DVec2], sources: &[Source]) {
        if !is_crease(line.role) {
            return;
        }
        let length = length(line, points);
        self.dropped += 1;
        self.dropped_length += length;
        if self.dropped_creases.len() < MOST_NAMED {
            let [a, b] = line.ends.map(|v| points[v as usize]);
            let source = sources[line.source as usize].clone();
            self.dropped_creases.push(DroppedCrease { source, middle: a.midpoint(b), length });
        }
    }

    /// In units of the file, which are `scale` long.
    pub(super) fn in_units_of_file(&mut self, scale: f64) {
        let lengths = [&mut self.tolerance, &mut self.dropped_length, &mut self.crease_length];
        let named = self.dropped_creases.iter_mut().map(|crease| &mut crease.length);
        for length in lengths.into_iter().chain(named) {
            *length /= scale;
        }
    }

    /// Refuses a pattern that would lose most of its creases; `scale`: how long the unit of the file is.
    pub(super) fn check(&self, scale: f64) -> Result<(), ImportError> {
        if self.dropped_length <= MOST_DROPPED * self.crease_length {
            return Ok(());
        }
        let sources = self.dropped_creases.iter().map(|crease| crease.source.clone());
        Err(ImportError::MostDropped {
            dropped: self.dropped_length / scale,
            length: self.crease_length / scale,
            tolerance: self.tolerance / scale,
            sources: sources.collect(),
        })
    }
}

fn is_crease(role: Role) -> bool {
    matches!(role, Role::Mountain | Role::Valley | Role::Free)
}

fn length(line: &Line, points: &[DVec2]) -> f64 {
    let [a, b] = line.ends.map(|v| points[v as usize]);
    a.distance(b)
}
