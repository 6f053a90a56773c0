//! A line of the crease pattern on paper.

use glam::DVec2;

use crate::Assignment;

/// What is done along a line, in the order in which it is done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum LineClass {
    /// Folded away from the front.
    Mountain,
    /// Folded towards the front.
    Valley,
    /// Creased, but folded in neither direction: a free hinge.
    Free,
    /// Where a quadrilateral facet is cut into triangles: not a crease.
    Facet,
    /// Cut: the border of the sheet; last, so that the sheet holds while it is creased.
    Cut,
}

impl LineClass {
    /// Every class, in the order in which they are drawn.
    pub const ALL: [Self; 5] = [Self::Mountain, Self::Valley, Self::Free, Self::Facet, Self::Cut];

    /// The class of an edge of the crease pattern.
    pub fn of(assignment: Assignment) -> Self {
        match assignment {
            Assignment::Mountain => Self::Mountain,
            Assignment::Valley => Self::Valley,
            Assignment::Free => Self::Free,
            Assignment::Facet => Self::Facet,
            Assignment::Border => Self::Cut,
        }
    }

    /// Its name: the id of its group in SVG and, in capitals, its layer in DXF.
    pub fn name(self) -> &'static str {
        match self {
            Self::Mountain => "mountain",
            Self::Valley => "valley",
            Self::Free => "free",
            Self::Facet => "facet",
            Self::Cut => "cut",
        }
    }
}

/// A line of one class.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CutLine {
    /// Whether the line is cut or folded, and how.
    pub class: LineClass,
    /// From where to where, mm, x to the right and y downwards.
    pub ends: [DVec2; 2],
    /// The fold angle the crease is to take, radians; 0 for lines that are not creases.
    pub fold_angle: f64,
}

impl CutLine {
    /// Its length, mm.
    pub fn length(&self) -> f64 {
        self.ends[0].distance(self.ends[1])
    }
}
