//! A drawing: lines that mean something, before they are one sheet.

use glam::DVec2;

use super::Source;
use crate::Assignment;

/// What a line means; of two lines on each other the lesser one counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Role {
    Border,
    Cut,
    Mountain,
    Valley,
    Free,
    Facet,
    /// Drawn as border, but of the paper's grid: border where it is the edge of the sheet, nothing elsewhere.
    Grid,
}

impl Role {
    /// Its name in warnings.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Border => "border",
            Self::Cut => "cut",
            Self::Mountain => "mountain",
            Self::Valley => "valley",
            Self::Free => "free hinge",
            Self::Facet => "facet line",
            Self::Grid => "grid line",
        }
    }

    /// The assignment of an edge of this role between two triangles, a cut having opened into borders.
    pub(super) fn assignment(self) -> Assignment {
        match self {
            Self::Border => Assignment::Border,
            Self::Mountain => Assignment::Mountain,
            Self::Valley => Assignment::Valley,
            Self::Facet | Self::Grid => Assignment::Facet,
            Self::Cut | Self::Free => Assignment::Free,
        }
    }
}

/// A straight line between two points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Line {
    pub(super) ends: [u32; 2],
    pub(super) role: Role,
    /// The fold angle it is to take, radians; 0 unless it is a crease.
    pub(super) target: f64,
    /// Where it comes from: an index into the list of sources.
    pub(super) source: u32,
    /// Whether it is a chord of a curve.
    pub(super) is_curved: bool,
}

impl Line {
    /// Its ends, the smaller first.
    pub(super) fn key(&self) -> [u32; 2] {
        let [a, b] = self.ends;
        [a.min(b), a.max(b)]
    }
}

/// Lines that may cross, touch and lie on each other.
#[derive(Debug, Default)]
pub(super) struct Drawing {
    pub(super) points: Vec<DVec2>,
    pub(super) lines: Vec<Line>,
    pub(super) sources: Vec<Source>,
}

impl Drawing {
    /// The lower left and the upper right corner of the lines; `None` without lines.
    pub(super) fn bounds(&self) -> Option<[DVec2; 2]> {
        let ends = self.lines.iter().flat_map(|line| line.ends);
        let points: Vec<DVec2> = ends.map(|v| self.points[v as usize]).collect();
        bounds(&points)
    }
}

/// The lower left and the upper right corner; `None` without points.
pub(super) fn bounds(points: &[DVec2]) -> Option<[DVec2; 2]> {
    let first = *points.first()?;
    let grown = |[low, high]: [DVec2; 2], p: &DVec2| [low.min(*p), high.max(*p)];
    Some(points.iter().fold([first, first], grown))
}
